//! Writes the text format.

use crate::files::{Blocks, Equations, FileError, ProblemFile, SparseMatrix, Storage};
use std::fmt::{self, Write};

/// The text of a file: numbers have 17 significant digits, which are read back to the last bit. Matrices keep their storage.
/// Rolling in the plane with a single contact gets a token more, without which it would not be read as rolling.
///
/// # Errors
///
/// Where the problem fails [`ProblemFile::check`], or has equality constraints, for which the format has no place.
pub fn write_text(problem: &ProblemFile) -> Result<String, FileError> {
    problem.check()?;
    if let Equations::Global { bilateral: Some(_), .. } = problem.equations {
        return Err(FileError::part("G", "the text format has no place for equality constraints; FCLIB's has"));
    }
    if problem.mu_r.is_some() && problem.dimension == 3 && problem.contacts() == 0 {
        return Err(FileError::part("mu_r", "the text format cannot say that no contact rolls in the plane"));
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_problem(&mut text, problem);
    Ok(text)
}

fn write_problem(out: &mut String, problem: &ProblemFile) -> fmt::Result {
    writeln!(out, "{}\n{}", problem.dimension, problem.contacts())?;
    match &problem.equations {
        Equations::Local { w, q } => {
            write_matrix(out, w)?;
            write_reals(out, q)?;
        }
        Equations::Global { m, h, f, w, .. } => {
            write_matrix(out, m)?;
            write_matrix(out, h)?;
            write_reals(out, f)?;
            write_reals(out, w)?;
        }
    }
    write_reals(out, &problem.mu)?;
    if let Some(mu_r) = &problem.mu_r {
        write_reals(out, mu_r)?;
        if problem.dimension == 3 && mu_r.len() == 1 {
            writeln!(out, "0")?;
        }
    }
    Ok(())
}

fn write_reals(out: &mut String, values: &[f64]) -> fmt::Result {
    for value in values {
        write!(out, " {value:.16e}")?;
    }
    writeln!(out)
}

fn write_indices(out: &mut String, values: &[usize]) -> fmt::Result {
    for value in values {
        write!(out, "{value}\t")?;
    }
    writeln!(out)
}

fn write_matrix(out: &mut String, matrix: &SparseMatrix) -> fmt::Result {
    let (rows, columns) = (matrix.rows, matrix.columns);
    let kind = match matrix.storage {
        Storage::Dense(_) => 0,
        Storage::Blocks(_) => 1,
        _ => 2,
    };
    writeln!(out, "{kind}\n{rows}\n{columns}")?;
    match &matrix.storage {
        Storage::Dense(values) => {
            writeln!(out, "{rows}\t{columns}")?;
            values.chunks(rows.max(1)).try_for_each(|column| write_reals(out, column))
        }
        Storage::Blocks(blocks) => write_blocks(out, blocks),
        Storage::Triplets { rows: i, columns: j, values } => {
            write_header(out, 1, "triplet: ", matrix)?;
            i.iter().zip(j).zip(values).try_for_each(|((i, j), value)| writeln!(out, "    {i} {j} : {value:.16e}"))
        }
        Storage::Columns { starts, rows, values } => {
            write_header(out, 2, "", matrix)?;
            write_stretches(out, "col", starts, rows, values)
        }
        Storage::Rows { starts, columns, values } => {
            write_header(out, 3, "csr: ", matrix)?;
            write_stretches(out, "row", starts, columns, values)
        }
    }
}

fn write_blocks(out: &mut String, blocks: &Blocks) -> fmt::Result {
    let (rows, columns, count) = (blocks.row_ends.len(), blocks.column_ends.len(), blocks.columns.len());
    writeln!(out, "{count}\n{rows}\n{columns}")?;
    write_indices(out, &blocks.row_ends)?;
    write_indices(out, &blocks.column_ends)?;
    writeln!(out, "{}\n{count}", blocks.starts.len())?;
    write_indices(out, &blocks.starts)?;
    write_indices(out, &blocks.columns)?;
    for (k, (_, height, _, width, begin)) in blocks.places().enumerate() {
        writeln!(out, "{k}")?;
        write_reals(out, &blocks.values[begin..begin + height * width])?;
    }
    Ok(())
}

/// The lines by which readers know what CSparse printed.
fn write_header(out: &mut String, origin: usize, prefix: &str, matrix: &SparseMatrix) -> fmt::Result {
    let (rows, columns, count) = (matrix.rows, matrix.columns, matrix.values().len());
    writeln!(out, "{origin}\nCSparse Version 3.1.9, as written by moreau")?;
    writeln!(out, "{prefix}{rows}-by-{columns}, nzmax: {count} nnz: {count}")
}

fn write_stretches(out: &mut String, word: &str, starts: &[usize], indices: &[usize], values: &[f64]) -> fmt::Result {
    for (k, ends) in starts.windows(2).enumerate() {
        writeln!(out, "    {word} {k} : locations {} to {}", ends[0], ends[1] as i64 - 1)?;
        for (i, value) in indices[ends[0]..ends[1]].iter().zip(&values[ends[0]..ends[1]]) {
            writeln!(out, "      {i} : {value:.16e}")?;
        }
    }
    Ok(())
}
