//! Writes FCLIB's format.

use super::KINDS;
use super::hdf5::{self, Branch};
use crate::files::{Bilateral, Equations, FileError, Info, Iterate, Place, ProblemFile, SparseMatrix, Storage};

/// The bytes of a file in FCLIB's format. Dense matrices and blocks become compressed rows. `spacedim` is the number of components
/// of a contact, 5 for rolling in space, as Siconos writes it.
///
/// # Errors
///
/// Where the problem fails [`ProblemFile::check`], or an index needs more than the 32 bits that the format has.
pub fn write_fclib(problem: &ProblemFile) -> Result<Vec<u8>, FileError> {
    problem.check()?;
    let kind = (matches!(problem.equations, Equations::Global { .. }), problem.mu_r.is_some());
    let name = KINDS.iter().find(|k| (k.1, k.2) == kind).map_or("fclib_local", |k| k.0);
    let mut root = Branch::new(name);
    root.indices("spacedim", &[problem.dimension])?;
    match &problem.equations {
        Equations::Local { w, .. } => write_matrix(&mut root, "W", w)?,
        Equations::Global { m, h, bilateral, .. } => {
            write_matrix(&mut root, "M", m)?;
            write_matrix(&mut root, "H", h)?;
            if let Some(Bilateral { g, .. }) = bilateral {
                write_matrix(&mut root, "G", g)?;
            }
        }
    }
    root.group("vectors", |group| {
        write_vectors(group, problem);
        Ok(())
    })?;
    if problem.info != Info::default() {
        root.group("info", |group| write_info(group, &problem.info))?;
    }
    let mut branches = vec![root];
    if !problem.guesses.is_empty() {
        let mut guesses = Branch::new("guesses");
        guesses.indices("number_of_guesses", &[problem.guesses.len()])?;
        for (k, guess) in problem.guesses.iter().enumerate() {
            guesses.group(&(k + 1).to_string(), |group| {
                write_iterate(group, guess);
                Ok(())
            })?;
        }
        branches.push(guesses);
    }
    if let Some(solution) = &problem.solution {
        let mut group = Branch::new("solution");
        write_iterate(&mut group, solution);
        branches.push(group);
    }
    hdf5::bytes(branches)
}

fn write_vectors(group: &mut Branch, problem: &ProblemFile) {
    match &problem.equations {
        Equations::Local { q, .. } => group.reals("q", q),
        Equations::Global { f, w, bilateral, .. } => {
            group.reals("f", f);
            group.reals("w", w);
            if let Some(Bilateral { b, .. }) = bilateral {
                group.reals("b", b);
            }
        }
    }
    group.reals("mu", &problem.mu);
    if let Some(mu_r) = &problem.mu_r {
        group.reals("mu_r", mu_r);
    }
}

fn write_matrix(parent: &mut Branch, name: &str, matrix: &SparseMatrix) -> Result<(), FileError> {
    parent.group(name, |group| {
        let rows = |group: &mut Branch, matrix: &SparseMatrix| match &matrix.storage {
            Storage::Triplets { rows, columns, values } => write_lists(group, values.len() as i64, columns, rows, values),
            Storage::Columns { starts, rows, values } => write_lists(group, -1, starts, rows, values),
            Storage::Rows { starts, columns, values } => write_lists(group, -2, starts, columns, values),
            Storage::Dense(_) | Storage::Blocks(_) => Err(FileError::new(Place::Whole, "dense storage has no lists")),
        };
        group.indices("m", &[matrix.rows])?;
        group.indices("n", &[matrix.columns])?;
        match matrix.storage {
            Storage::Dense(_) | Storage::Blocks(_) => rows(group, &matrix.csr().into()),
            _ => rows(group, matrix),
        }
    })
}

fn write_lists(group: &mut Branch, form: i64, p: &[usize], i: &[usize], x: &[f64]) -> Result<(), FileError> {
    group.integers("nz", [form].into_iter())?;
    group.indices("nzmax", &[x.len()])?;
    group.indices("p", p)?;
    group.indices("i", i)?;
    group.reals("x", x);
    Ok(())
}

fn write_info(group: &mut Branch, info: &Info) -> Result<(), FileError> {
    for (name, text) in [("title", &info.title), ("description", &info.description), ("math_info", &info.math_info)] {
        if let Some(text) = text {
            group.text(name, text)?;
        }
    }
    Ok(())
}

fn write_iterate(group: &mut Branch, iterate: &Iterate) {
    group.reals("r", &iterate.r);
    group.reals("u", &iterate.u);
    if let Some(v) = &iterate.v {
        group.reals("v", v);
    }
}
