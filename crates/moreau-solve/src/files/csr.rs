//! Compressed rows in canonical form: what every storage of a matrix comes down to.

/// A matrix by rows, each with increasing columns, no entry twice and none that is zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Csr {
    /// How many rows there are.
    pub rows: usize,
    /// How many columns there are.
    pub columns: usize,
    /// Where each row begins in `indices` and `values`, and last where the last one ends: rows + 1 numbers.
    pub starts: Vec<usize>,
    /// The column of each entry.
    pub indices: Vec<usize>,
    /// The value of each entry.
    pub values: Vec<f64>,
}

impl Csr {
    /// From entries (row, column, value) in any order: those at one place are added in the order given, zeros are dropped.
    /// Linear in entries, rows and columns. Entries outside of the matrix are left out.
    pub fn from_entries(rows: usize, columns: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> Self {
        let entries: Vec<_> = entries.filter(|&(i, j, _)| i < rows && j < columns).collect();
        // Sorted by column, then by row; both counting sorts keep the order of equals.
        let by_column = counting_sort(columns, &entries, |e| e.1);
        let by_row = counting_sort(rows, &by_column, |e| e.0);
        let mut csr = Self { rows, columns, starts: vec![0; rows + 1], ..Self::default() };
        let mut k = 0;
        while let Some(&(i, j, mut value)) = by_row.get(k) {
            k += 1;
            while let Some(&(_, _, more)) = by_row.get(k).filter(|next| (next.0, next.1) == (i, j)) {
                value += more;
                k += 1;
            }
            if value != 0.0 {
                csr.indices.push(j);
                csr.values.push(value);
                csr.starts[i + 1] = csr.indices.len();
            }
        }
        for i in 0..rows {
            csr.starts[i + 1] = csr.starts[i + 1].max(csr.starts[i]);
        }
        csr
    }

    /// The entries of a row: columns and values.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[i]..self.starts[i + 1];
        self.indices[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }

    /// All entries by rows: row, column, value.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        (0..self.rows).flat_map(move |i| self.row(i).map(move |(j, value)| (i, j, value)))
    }

    /// The transposed matrix.
    pub fn transposed(&self) -> Self {
        Self::from_entries(self.columns, self.rows, self.entries().map(|(i, j, value)| (j, i, value)))
    }

    /// ‖A − Aᵀ‖ / ‖A‖ by the greatest entries: zero where A is symmetric, and for an empty matrix.
    pub fn asymmetry(&self) -> f64 {
        let largest = self.values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        if largest == 0.0 {
            return 0.0;
        }
        let mirrored = self.transposed().entries().map(|(i, j, value)| (i, j, -value)).collect::<Vec<_>>();
        let difference = Self::from_entries(self.rows, self.columns, self.entries().chain(mirrored));
        difference.values.iter().fold(0.0, |m: f64, x| m.max(x.abs())) / largest
    }
}

/// The entries by increasing key, equals in the order they had.
fn counting_sort(
    keys: usize,
    entries: &[(usize, usize, f64)],
    key: impl Fn(&(usize, usize, f64)) -> usize,
) -> Vec<(usize, usize, f64)> {
    let mut next = vec![0; keys + 1];
    for entry in entries {
        next[key(entry) + 1] += 1;
    }
    for k in 0..keys {
        next[k + 1] += next[k];
    }
    let mut sorted = vec![(0, 0, 0.0); entries.len()];
    for entry in entries {
        let place = &mut next[key(entry)];
        sorted[*place] = *entry;
        *place += 1;
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn duplicates_are_added_and_zeros_dropped() {
        let entries = [(1, 2, 1.0), (0, 1, 3.0), (1, 2, 2.0), (1, 0, 5.0), (0, 0, 1.0), (0, 0, -1.0)];
        let csr = Csr::from_entries(3, 3, entries.into_iter());
        assert_eq!((csr.starts, csr.indices, csr.values), (vec![0, 1, 3, 3], vec![1, 0, 2], vec![3.0, 5.0, 3.0]));
    }

    #[test]
    fn asymmetry_is_relative_to_the_greatest_entry() {
        let csr = Csr::from_entries(2, 2, [(0, 0, 4.0), (0, 1, 1.0), (1, 0, 2.0)].into_iter());
        assert_eq!(csr.asymmetry(), 0.25);
        assert_eq!(Csr::from_entries(2, 2, csr.entries().filter(|e| e.0 == e.1)).asymmetry(), 0.0);
    }
}
