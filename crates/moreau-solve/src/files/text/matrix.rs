//! A matrix in the text format: dense, by blocks, or as CSparse prints it.

use super::tokens::Tokens;
use crate::files::{Blocks, FileError, SparseMatrix, Storage};

/// Reads `storage rows columns` and the entries of the matrix called `name`.
pub(super) fn read(tokens: &mut Tokens<'_>, name: &str) -> Result<SparseMatrix, FileError> {
    let kind = tokens.integer(&format!("the storage of {name}"))?;
    let rows = tokens.integer(&format!("the number of rows of {name}"))?;
    let columns = tokens.integer(&format!("the number of columns of {name}"))?;
    let storage = match kind {
        0 => dense(tokens, rows, columns)?,
        1 => blocks(tokens)?,
        2 => printed(tokens, rows, columns)?,
        _ => return Err(tokens.error(format!("{name} has storage {kind}; 0 dense, 1 blocks or 2 sparse is right"))),
    };
    let matrix = SparseMatrix { rows, columns, storage };
    matrix.check().map_err(|what| tokens.error(format!("{name} ends here and is wrong: {what}")))?;
    Ok(matrix)
}

fn dense(tokens: &mut Tokens<'_>, rows: usize, columns: usize) -> Result<Storage, FileError> {
    expect(tokens, rows, "rows")?;
    expect(tokens, columns, "columns")?;
    // A product that overflows is more than any file has.
    let count = rows.saturating_mul(columns);
    Ok(Storage::Dense(tokens.reals(count, "dense entries")?))
}

/// Reads a size that the file has given before.
fn expect(tokens: &mut Tokens<'_>, size: usize, name: &str) -> Result<(), FileError> {
    match tokens.integer(&format!("the number of {name}, again"))? {
        again if again == size => Ok(()),
        again => Err(tokens.error(format!("{again} {name} after {size} before"))),
    }
}

fn blocks(tokens: &mut Tokens<'_>) -> Result<Storage, FileError> {
    let count = tokens.count("the number of blocks")?;
    let rows = tokens.count("the number of rows of blocks")?;
    let columns = tokens.count("the number of columns of blocks")?;
    let row_ends = tokens.integers(rows, "row ends")?;
    let column_ends = tokens.integers(columns, "column ends")?;
    let filled = tokens.count("the number of row pointers")?;
    expect(tokens, count, "blocks")?;
    if filled == 0 || filled > rows + 1 {
        return Err(tokens.error(format!("{filled} row pointers for {rows} rows of blocks; one more is right")));
    }
    let mut starts = tokens.integers(filled, "row pointers")?;
    // Rows without a pointer of their own are empty and at the end.
    starts.resize(rows + 1, starts[filled - 1]);
    let indices = tokens.integers(count, "columns of blocks")?;
    let mut blocks = Blocks { row_ends, column_ends, starts, columns: indices, values: Vec::new() };
    // Only indices that are in range give sizes to believe.
    let sizes = blocks.sizes().map_err(|what| tokens.error(what))?;
    for (k, size) in sizes.into_iter().enumerate() {
        let number = tokens.integer("the number of a block")?;
        if number != k {
            return Err(tokens.error(format!("block {number} where block {k} is next")));
        }
        blocks.values.extend(tokens.reals(size, "entries of a block")?);
    }
    Ok(Storage::Blocks(blocks))
}

/// Reads what CSparse prints: triplets, columns or rows.
fn printed(tokens: &mut Tokens<'_>, rows: usize, columns: usize) -> Result<Storage, FileError> {
    let origin = tokens.integer("the origin of a sparse matrix")?;
    let version = tokens.line("a line `CSparse Version …`")?;
    if !version.starts_with("CSparse") {
        return Err(tokens.error("a line `CSparse Version …` is right here"));
    }
    let count = header(tokens, rows, columns)?;
    match origin {
        1 => triplets(tokens, count),
        2 => {
            let (starts, rows, values) = compressed(tokens, "col", columns, count)?;
            Ok(Storage::Columns { starts, rows, values })
        }
        3 => {
            let (starts, columns, values) = compressed(tokens, "row", rows, count)?;
            Ok(Storage::Rows { starts, columns, values })
        }
        _ => Err(tokens.error(format!("a sparse matrix of origin {origin}; 1 triplets, 2 columns or 3 rows is right"))),
    }
}

/// Reads `[triplet: |csr: ]m-by-n, nzmax: X nnz: Y[, 1-norm: Z]`; the answer is Y.
fn header(tokens: &mut Tokens<'_>, rows: usize, columns: usize) -> Result<usize, FileError> {
    let line = tokens.line("a line `m-by-n, nzmax: … nnz: …`")?;
    let mut words = line.split_ascii_whitespace().filter(|word| !matches!(*word, "triplet:" | "csr:" | "csc:"));
    let sizes = words.next().map(|word| word.trim_end_matches(','));
    if sizes != Some(format!("{rows}-by-{columns}").as_str()) {
        return Err(tokens.error(format!("`{rows}-by-{columns}, nzmax: … nnz: …` is right in this line")));
    }
    let number = words.skip_while(|word| *word != "nnz:").nth(1).map(|word| word.trim_end_matches(','));
    let Some(count) = number.and_then(|word| word.parse().ok()) else {
        return Err(tokens.error("`nnz:` and the number of entries are missing in this line"));
    };
    tokens.fits(count, "nnz")?;
    Ok(count)
}

/// Reads `i j : v` for each entry.
fn triplets(tokens: &mut Tokens<'_>, count: usize) -> Result<Storage, FileError> {
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..count {
        rows.push(tokens.integer("a row")?);
        columns.push(tokens.integer("a column")?);
        tokens.word(":")?;
        values.push(tokens.real("an entry")?);
    }
    Ok(Storage::Triplets { rows, columns, values })
}

/// Starts, indices and values of compressed storage.
type Lists = (Vec<usize>, Vec<usize>, Vec<f64>);

/// Reads `col j : locations a to b` and `i : v` for each entry of the column; an empty one has b = a − 1.
fn compressed(tokens: &mut Tokens<'_>, word: &str, stretches: usize, count: usize) -> Result<Lists, FileError> {
    tokens.fits(stretches, "columns")?;
    let (mut starts, mut indices, mut values) = (vec![0], Vec::new(), Vec::new());
    for k in 0..stretches {
        tokens.word(word)?;
        expect(tokens, k, &format!("as the number of the {word}"))?;
        tokens.word(":")?;
        tokens.word("locations")?;
        expect(tokens, indices.len(), "entries before it")?;
        tokens.word("to")?;
        let last = tokens.signed("the last location")?;
        let length = usize::try_from(last.saturating_add(1)).ok().and_then(|end| end.checked_sub(indices.len()));
        let Some(length) = length else {
            return Err(tokens.error(format!("the last location {last} is before the first, {}", indices.len())));
        };
        tokens.fits(length, "locations")?;
        for _ in 0..length {
            indices.push(tokens.integer("an index")?);
            tokens.word(":")?;
            values.push(tokens.real("an entry")?);
        }
        starts.push(indices.len());
    }
    if indices.len() != count {
        return Err(tokens.error(format!("{} entries; nnz said {count}", indices.len())));
    }
    Ok((starts, indices, values))
}
