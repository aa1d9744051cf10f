//! Matrices as problem files store them.

use super::Csr;

/// A matrix in the storage that its file has.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix {
    /// How many rows there are.
    pub rows: usize,
    /// How many columns there are.
    pub columns: usize,
    /// The entries.
    pub storage: Storage,
}

/// The ways to store a matrix. Indices count from zero; entries at one place are added.
#[derive(Clone, Debug, PartialEq)]
pub enum Storage {
    /// All entries, column after column.
    Dense(Vec<f64>),
    /// Dense blocks.
    Blocks(Blocks),
    /// Single entries: three lists of one length.
    Triplets {
        /// The row of each entry.
        rows: Vec<usize>,
        /// The column of each entry.
        columns: Vec<usize>,
        /// The value of each entry.
        values: Vec<f64>,
    },
    /// Compressed columns.
    Columns {
        /// Where each column begins, and where the last one ends: columns + 1 numbers.
        starts: Vec<usize>,
        /// The row of each entry.
        rows: Vec<usize>,
        /// The value of each entry.
        values: Vec<f64>,
    },
    /// Compressed rows.
    Rows {
        /// Where each row begins, and where the last one ends: rows + 1 numbers.
        starts: Vec<usize>,
        /// The column of each entry.
        columns: Vec<usize>,
        /// The value of each entry.
        values: Vec<f64>,
    },
}

/// Compressed rows of dense blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks {
    /// The row after each row of blocks: increasing, the last is the number of rows.
    pub row_ends: Vec<usize>,
    /// The column after each column of blocks: increasing, the last is the number of columns.
    pub column_ends: Vec<usize>,
    /// The first block of each row of blocks, and last how many blocks there are.
    pub starts: Vec<usize>,
    /// Of each block, which column of blocks it is in.
    pub columns: Vec<usize>,
    /// The blocks one after another, each column by column.
    pub values: Vec<f64>,
}

/// An iterator over entries: row, column, value.
pub type Entries<'a> = Box<dyn Iterator<Item = (usize, usize, f64)> + 'a>;

impl SparseMatrix {
    /// From entries (row, column, value), as triplets.
    pub fn from_entries(rows: usize, columns: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> Self {
        let (mut at_rows, mut at_columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (i, j, value) in entries {
            at_rows.push(i);
            at_columns.push(j);
            values.push(value);
        }
        Self { rows, columns, storage: Storage::Triplets { rows: at_rows, columns: at_columns, values } }
    }

    /// The entries in the order of storage, explicit zeros among them. Only a matrix that passes [`SparseMatrix::check`] is
    /// sure to have all of them.
    pub fn entries(&self) -> Entries<'_> {
        match &self.storage {
            Storage::Dense(values) => {
                let rows = self.rows.max(1);
                Box::new(values.iter().enumerate().map(move |(k, &value)| (k % rows, k / rows, value)))
            }
            Storage::Blocks(blocks) => Box::new(blocks.entries()),
            Storage::Triplets { rows, columns, values } => {
                Box::new(rows.iter().zip(columns).zip(values).map(|((&i, &j), &value)| (i, j, value)))
            }
            Storage::Columns { starts, rows, values } => Box::new(compressed(starts, rows, values).map(|(j, i, v)| (i, j, v))),
            Storage::Rows { starts, columns, values } => Box::new(compressed(starts, columns, values)),
        }
    }

    /// In canonical form: duplicates added, zeros dropped.
    pub fn csr(&self) -> Csr {
        Csr::from_entries(self.rows, self.columns, self.entries())
    }

    /// Whether the lists have the lengths, the indices the range, and the values are finite.
    ///
    /// # Errors
    ///
    /// Says in words what is wrong and what would be right.
    pub fn check(&self) -> Result<(), String> {
        match &self.storage {
            Storage::Dense(values) => {
                if self.rows.checked_mul(self.columns) != Some(values.len()) {
                    return Err(format!("{} values for {} × {} entries", values.len(), self.rows, self.columns));
                }
            }
            Storage::Blocks(blocks) => blocks.check(self.rows, self.columns)?,
            Storage::Triplets { rows, columns, values } => {
                if rows.len() != values.len() || columns.len() != values.len() {
                    let (i, j, v) = (rows.len(), columns.len(), values.len());
                    return Err(format!("{i} rows, {j} columns and {v} values; the lists of triplets have one length"));
                }
                check_range(rows, self.rows, "row")?;
                check_range(columns, self.columns, "column")?;
            }
            Storage::Columns { starts, rows, values } => {
                check_starts(starts, self.columns, rows.len(), values.len())?;
                check_range(rows, self.rows, "row")?;
            }
            Storage::Rows { starts, columns, values } => {
                check_starts(starts, self.rows, columns.len(), values.len())?;
                check_range(columns, self.columns, "column")?;
            }
        }
        self.values().iter().position(|x| !x.is_finite()).map_or(Ok(()), |k| Err(format!("value {k} is not finite")))
    }

    /// The values as they are stored.
    pub(crate) fn values(&self) -> &[f64] {
        match &self.storage {
            Storage::Dense(values)
            | Storage::Blocks(Blocks { values, .. })
            | Storage::Triplets { values, .. }
            | Storage::Columns { values, .. }
            | Storage::Rows { values, .. } => values,
        }
    }
}

impl From<Csr> for SparseMatrix {
    fn from(csr: Csr) -> Self {
        let storage = Storage::Rows { starts: csr.starts, columns: csr.indices, values: csr.values };
        Self { rows: csr.rows, columns: csr.columns, storage }
    }
}

impl Blocks {
    /// The rows and columns that block (i, j) covers: where they begin and how many there are.
    fn extent(&self, i: usize, j: usize) -> (usize, usize, usize, usize) {
        let span = |ends: &[usize], k: usize| {
            let start = if k == 0 { 0 } else { ends.get(k - 1).copied().unwrap_or(0) };
            (start, ends.get(k).copied().unwrap_or(start).saturating_sub(start))
        };
        let ((row, height), (column, width)) = (span(&self.row_ends, i), span(&self.column_ends, j));
        (row, height, column, width)
    }

    /// The blocks in order: first row, height, first column, width, and where its values begin.
    pub(crate) fn places(&self) -> impl Iterator<Item = (usize, usize, usize, usize, usize)> + '_ {
        let mut offset = 0_usize;
        indexed(&self.starts, &self.columns).map(move |(i, &j)| {
            let (row, height, column, width) = self.extent(i, j);
            let begin = offset;
            offset = offset.saturating_add(height.saturating_mul(width));
            (row, height, column, width, begin)
        })
    }

    fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        self.places().flat_map(move |(row, height, column, width, begin)| {
            let end = begin.saturating_add(height.saturating_mul(width));
            let values = self.values.get(begin..end).unwrap_or(&[]);
            values.iter().enumerate().map(move |(k, &value)| (row + k % height, column + k / height, value))
        })
    }

    /// How many values each block has, after a look at the indices that say so.
    pub(crate) fn sizes(&self) -> Result<Vec<usize>, String> {
        check_rising(&self.row_ends, "row")?;
        check_rising(&self.column_ends, "column")?;
        check_starts(&self.starts, self.row_ends.len(), self.columns.len(), self.columns.len())?;
        check_range(&self.columns, self.column_ends.len(), "column of blocks")?;
        Ok(self.places().map(|(_, height, _, width, _)| height.saturating_mul(width)).collect())
    }

    fn check(&self, rows: usize, columns: usize) -> Result<(), String> {
        let size = self.sizes()?.into_iter().try_fold(0_usize, usize::checked_add);
        for (ends, size, name) in [(&self.row_ends, rows, "row"), (&self.column_ends, columns, "column")] {
            let last = ends.last().copied().unwrap_or(0);
            if last != size {
                return Err(format!("the last {name} end is {last}; {size}, the number of {name}s, is right"));
            }
        }
        if size != Some(self.values.len()) {
            return Err(format!("{} values do not fill the {} blocks", self.values.len(), self.columns.len()));
        }
        Ok(())
    }
}

/// The pairs (k, item) where item is in the k-th stretch that `starts` cuts out of `items`.
fn indexed<'a, T>(starts: &'a [usize], items: &'a [T]) -> impl Iterator<Item = (usize, &'a T)> + 'a {
    starts.windows(2).enumerate().flat_map(move |(k, ends)| {
        let range = items.get(ends[0]..ends[1]).unwrap_or(&[]);
        range.iter().map(move |item| (k, item))
    })
}

/// The entries (stretch, index, value) of compressed storage.
fn compressed<'a>(
    starts: &'a [usize],
    indices: &'a [usize],
    values: &'a [f64],
) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
    indexed(starts, indices).zip(values).map(|((k, &index), &value)| (k, index, value))
}

fn check_range(indices: &[usize], end: usize, name: &str) -> Result<(), String> {
    match indices.iter().position(|&i| i >= end) {
        Some(k) => Err(format!("entry {k} is in {name} {}, and there are {end}, counted from 0", indices[k])),
        None => Ok(()),
    }
}

/// Starts of compressed storage: one more than stretches, from 0, never falling, to the number of entries.
pub(crate) fn check_starts(starts: &[usize], stretches: usize, indices: usize, values: usize) -> Result<(), String> {
    if stretches.checked_add(1) != Some(starts.len()) {
        return Err(format!("{} starts for {stretches} rows or columns; one more is right", starts.len()));
    }
    if let Some(k) = starts.windows(2).position(|ends| ends[0] > ends[1]) {
        return Err(format!("the starts fall from {} to {} at number {k}; they never fall", starts[k], starts[k + 1]));
    }
    let (first, last) = (starts[0], starts[stretches]);
    if first != 0 || last != indices || indices != values {
        return Err(format!(
            "starts from {first} to {last} for {indices} indices and {values} values; 0 to their number is right"
        ));
    }
    Ok(())
}

fn check_rising(ends: &[usize], name: &str) -> Result<(), String> {
    match ends.windows(2).position(|pair| pair[0] > pair[1]) {
        Some(k) => Err(format!("the {name} ends fall from {} to {}; they never fall", ends[k], ends[k + 1])),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
