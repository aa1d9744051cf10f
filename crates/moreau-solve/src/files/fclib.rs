//! FCLIB's format: HDF5 with a group `fclib_local`, `fclib_global`, or one of the two with `_rolling`.
//!
//! ```text
//! fclib_…/spacedim                    fclib_…/info/{title, description, math_info}
//! fclib_local/W                       fclib_local/vectors/{q, mu}             (mu_r with rolling)
//! fclib_global/M, H, (G)              fclib_global/vectors/{f, w, mu, (b)}    (mu_r with rolling)
//! guesses/number_of_guesses           guesses/k/{r, u, (v)}                   solution/{r, u, (v)}
//! ```
//!
//! A matrix is a group of `m`, `n`, `nz`, `nzmax`, `p`, `i`, `x`: with nz = −2 by rows, with nz = −1 by columns, with nz ≥ 0 triplets
//! with the row in `i` and the column in `p`. With rolling friction the writers do not agree on what `spacedim` counts; the
//! number of components comes from the sizes of the vectors. What this crate does not know it leaves out: attributes, the
//! conditions of matrices, the impulses λ of a guess.

mod hdf5;
mod write;

pub use hdf5::{EXPANSION_FLOOR, EXPANSION_LIMIT};
pub use write::write_fclib;

use super::{Bilateral, Equations, FileError, Info, Iterate, Place, ProblemFile, SparseMatrix, Storage};
use hdf5::Archive;

/// The groups that hold problems: whether they are global, whether rolling.
const KINDS: [(&str, bool, bool); 4] = [
    ("fclib_local", false, false),
    ("fclib_global", true, false),
    ("fclib_local_rolling", false, true),
    ("fclib_global_rolling", true, true),
];

/// Reads a problem in FCLIB's format.
///
/// # Errors
///
/// Where the bytes are no HDF5 file or it does not hold a problem: names the dataset.
pub fn read_fclib(bytes: &[u8]) -> Result<ProblemFile, FileError> {
    let archive = Archive::open(bytes)?;
    let mut found = Vec::new();
    for kind in KINDS {
        if archive.has("", kind.0)? {
            found.push(kind);
        }
    }
    let [(root, global, rolling)] = found[..] else {
        let what = format!("{} groups hold problems; one of {} is right", found.len(), KINDS.map(|kind| kind.0).join(", "));
        return Err(FileError::new(Place::Dataset("/".to_owned()), what));
    };
    let vector = |name: &str| archive.reals(&format!("{root}/vectors/{name}"));
    let equations = if global { read_global(&archive, root)? } else { read_local(&archive, root)? };
    let mu = vector("mu")?;
    let mu_r = if rolling { Some(vector("mu_r")?) } else { None };
    let dimension = read_dimension(&archive, root, &equations, mu.len(), rolling)?;
    let mut problem = ProblemFile::new(dimension, equations, mu, mu_r);
    problem.info = read_info(&archive, root)?;
    problem.guesses = read_guesses(&archive)?;
    if archive.has("", "solution")? {
        problem.solution = Some(read_iterate(&archive, "solution")?);
    }
    problem.check()?;
    Ok(problem)
}

fn read_local(archive: &Archive, root: &str) -> Result<Equations, FileError> {
    for name in ["V", "R"] {
        if archive.has(root, name)? {
            let what =
                "equality constraints in a local problem are not supported; eliminate them, or give a global problem with G";
            return Err(FileError::new(Place::Dataset(format!("{root}/{name}")), what));
        }
    }
    let (w, q) = (read_matrix(archive, &format!("{root}/W"))?, archive.reals(&format!("{root}/vectors/q"))?);
    Ok(Equations::Local { w, q })
}

fn read_global(archive: &Archive, root: &str) -> Result<Equations, FileError> {
    let (m, h) = (read_matrix(archive, &format!("{root}/M"))?, read_matrix(archive, &format!("{root}/H"))?);
    let vector = |name: &str| archive.reals(&format!("{root}/vectors/{name}"));
    let (f, w) = (vector("f")?, vector("w")?);
    let bilateral = match archive.has(root, "G")? {
        true => Some(Bilateral { g: read_matrix(archive, &format!("{root}/G"))?, b: vector("b")? }),
        false => None,
    };
    Ok(Equations::Global { m, h, f, w, bilateral })
}

/// The components of a contact, from the size of its vectors; `spacedim` must not contradict them.
fn read_dimension(
    archive: &Archive,
    root: &str,
    equations: &Equations,
    contacts: usize,
    rolling: bool,
) -> Result<usize, FileError> {
    let path = format!("{root}/spacedim");
    let claimed = archive.count(&path)?;
    let (Equations::Local { q: shift, .. } | Equations::Global { w: shift, .. }) = equations;
    let dimension = shift.len().checked_div(contacts).unwrap_or(claimed);
    let right: &[usize] = match (dimension, rolling) {
        (2, false) => &[2],
        (3, false) => &[3],
        (3, true) => &[2, 3],
        (5, true) => &[3, 5],
        _ => &[],
    };
    if right.contains(&claimed) {
        return Ok(dimension);
    }
    let rolls = if rolling { " with rolling friction" } else { "" };
    let what = format!("{claimed} for {contacts} contacts of {} components in all{rolls}", shift.len());
    Err(FileError::new(Place::Dataset(path), what))
}

fn read_matrix(archive: &Archive, path: &str) -> Result<SparseMatrix, FileError> {
    let at = |name: &str| format!("{path}/{name}");
    let (rows, columns) = (archive.count(&at("m"))?, archive.count(&at("n"))?);
    let form = archive.integer(&at("nz"))?;
    let (mut p, mut i) = (archive.indices(&at("p"))?, archive.indices(&at("i"))?);
    let mut values = archive.reals(&at("x"))?;
    // Lists may be as long as nzmax; what is behind the last entry means nothing.
    let count = match usize::try_from(form) {
        Ok(count) => count,
        Err(_) => p.last().copied().unwrap_or(0),
    };
    i.truncate(count);
    values.truncate(count);
    let storage = match form {
        -2 => Storage::Rows { starts: p, columns: i, values },
        -1 => Storage::Columns { starts: p, rows: i, values },
        0.. => {
            p.truncate(count);
            if values.len() != count {
                let what = format!("{count} entries, and x has {}", values.len());
                return Err(FileError::new(Place::Dataset(at("nz")), what));
            }
            Storage::Triplets { rows: i, columns: p, values }
        }
        _ => {
            let what = format!("{form}; -2 for rows, -1 for columns or a number of triplets is right");
            return Err(FileError::new(Place::Dataset(at("nz")), what));
        }
    };
    let matrix = SparseMatrix { rows, columns, storage };
    matrix.check().map_err(|what| FileError::new(Place::Dataset(path.to_owned()), what))?;
    Ok(matrix)
}

fn read_info(archive: &Archive, root: &str) -> Result<Info, FileError> {
    if !archive.has(root, "info")? {
        return Ok(Info::default());
    }
    let group = format!("{root}/info");
    let text = |name: &str| match archive.has(&group, name)? {
        true => archive.text(&format!("{group}/{name}")).map(Some),
        false => Ok(None),
    };
    Ok(Info { title: text("title")?, description: text("description")?, math_info: text("math_info")? })
}

fn read_guesses(archive: &Archive) -> Result<Vec<Iterate>, FileError> {
    if !archive.has("", "guesses")? {
        return Ok(Vec::new());
    }
    let count = archive.count("guesses/number_of_guesses")?;
    // Not a range that is believed: the first guess that is missing ends it with an error.
    (1..=count).map(|k| read_iterate(archive, &format!("guesses/{k}"))).collect()
}

fn read_iterate(archive: &Archive, group: &str) -> Result<Iterate, FileError> {
    let vector = |name: &str| archive.reals(&format!("{group}/{name}"));
    let v = if archive.has(group, "v")? { Some(vector("v")?) } else { None };
    Ok(Iterate { r: vector("r")?, u: vector("u")?, v })
}

#[cfg(test)]
mod tests;
