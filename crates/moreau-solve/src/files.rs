//! Problem files: friction-contact problems that other programs dumped, read, checked, reduced, solved and written.
//!
//! Two formats are known: FCLIB's HDF5 (`.hdf5`, `.h5`) and the text of Siconos (`.dat`, `.txt`). Both hold a problem in one of two
//! forms,
//!
//! ```text
//! local    u = W r + q
//! global   M v = H r + f,   u = Hᵀ v + w,   hence   W = Hᵀ M⁻¹ H,   q = Hᵀ M⁻¹ f + w
//! ```
//!
//! with the coefficient of friction μ of each contact, and of rolling friction μ_r where contacts resist rolling. Components are
//! contact by contact: `[n, t]`, `[n, t₁, t₂]`, rolling in the plane `[n, t, m]`, in space `[n, t₁, t₂, m₁, m₂]`.
//!
//! Reading is total: whatever the bytes are, the answer is a problem that passes [`ProblemFile::check`] or a [`FileError`] that
//! says where the file is wrong. No number in a file makes the reader allocate more than a small multiple of the file's size; for
//! compressed HDF5 the limit is [`EXPANSION_LIMIT`].
//!
//! ```
//! use moreau_solve::files::{self, AnyProblem};
//!
//! // One contact in the plane: W = diag(2, 4), q = (−1, 3), μ = 0.5.
//! let file = files::read_text(b"2 1  0 2 2  2 2  2 0 0 4  -1 3  0.5").unwrap();
//! let AnyProblem::Plane(stored) = file.any_problem().unwrap() else { panic!("a problem in the plane") };
//! assert_eq!(stored.q, [[-1.0, 3.0]]);
//! ```

mod csr;
mod error;
mod fclib;
mod matrix;
mod reduce;
mod same;
mod stored;
mod text;

pub use csr::Csr;
pub use error::{FileError, Place};
pub use fclib::{EXPANSION_FLOOR, EXPANSION_LIMIT, read_fclib, write_fclib};
pub use matrix::{Blocks, Entries, SparseMatrix, Storage};
pub use stored::{Answer, AnyProblem, StoredProblem};
pub use text::{read_text, write_text};

use std::io::Write;
use std::path::Path;

/// A problem as its file holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct ProblemFile {
    /// Components a contact: 2 or 3; with rolling 3 in the plane and 5 in space.
    pub dimension: usize,
    /// The matrices and vectors.
    pub equations: Equations,
    /// The coefficient of friction of each contact, ≥ 0.
    pub mu: Vec<f64>,
    /// The coefficient of rolling friction of each contact, ≥ 0, a length where impulses are forces; `None` without rolling.
    pub mu_r: Option<Vec<f64>>,
    /// What the file says about itself; text files say nothing.
    pub info: Info,
    /// Where solvers may start; text files have none.
    pub guesses: Vec<Iterate>,
    /// A solution as the file's writer left it, good or bad; text files have none.
    pub solution: Option<Iterate>,
    /// What the reader noticed without refusing the file.
    pub notes: Vec<String>,
}

/// The equations of a problem with N contacts of D components.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a problem has one of them")]
pub enum Equations {
    /// u = W r + q.
    Local {
        /// W, D·N × D·N.
        w: SparseMatrix,
        /// q, D·N numbers.
        q: Vec<f64>,
    },
    /// M v = H r + f and u = Hᵀ v + w for n velocities v.
    Global {
        /// M, n × n.
        m: SparseMatrix,
        /// H, n × D·N.
        h: SparseMatrix,
        /// f, n numbers.
        f: Vec<f64>,
        /// w, D·N numbers.
        w: Vec<f64>,
        /// Equality constraints beside the contacts.
        bilateral: Option<Bilateral>,
    },
}

/// Equality constraints Gᵀ v + b = 0; their impulses λ add G λ to the right of M v = H r + f.
#[derive(Clone, Debug, PartialEq)]
pub struct Bilateral {
    /// G, n × as many columns as constraints.
    pub g: SparseMatrix,
    /// b, a number for each constraint.
    pub b: Vec<f64>,
}

/// What a file says about itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Info {
    /// A name.
    pub title: Option<String>,
    /// Where the problem comes from.
    pub description: Option<String>,
    /// What is known about its mathematics.
    pub math_info: Option<String>,
}

/// Impulses and velocities: a guess or a solution.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Iterate {
    /// r, D·N numbers.
    pub r: Vec<f64>,
    /// u, D·N numbers.
    pub u: Vec<f64>,
    /// v, the global velocities, where they are stored.
    pub v: Option<Vec<f64>>,
}

/// Reads a problem file; the content decides on the format.
///
/// # Errors
///
/// Where the file cannot be read or does not hold a problem.
pub fn read(path: &Path) -> Result<ProblemFile, FileError> {
    let bytes = std::fs::read(path).map_err(|e| FileError::new(Place::Whole, format!("cannot be read: {e}")).of(path))?;
    read_bytes(&bytes).map_err(|e| e.of(path))
}

/// Reads a problem from the content of a file; it decides on the format.
///
/// # Errors
///
/// Where the bytes do not hold a problem.
pub fn read_bytes(bytes: &[u8]) -> Result<ProblemFile, FileError> {
    // HDF5 may begin after a block of the user's, at 0, 512, 1024, 2048, …
    let at = |offset: usize| bytes.get(offset..offset + 8) == Some(b"\x89HDF\r\n\x1a\n");
    let mut offset = 512;
    let mut found = at(0);
    while !found && offset + 8 <= bytes.len() {
        found = at(offset);
        offset *= 2;
    }
    if found { read_fclib(bytes) } else { read_text(bytes) }
}

/// Writes a problem as the ending of `path` says: `.hdf5` or `.h5` in FCLIB's format, `.dat` or `.txt` as text. The file is written
/// beside and renamed, so that `path` never holds half a problem. The answer names what the format has no place for and the file
/// therefore lacks.
///
/// # Errors
///
/// Where the problem fails [`ProblemFile::check`], the format cannot hold it, or the file cannot be written.
pub fn write(path: &Path, problem: &ProblemFile) -> Result<Vec<String>, FileError> {
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let (bytes, lost) = match ending.as_deref() {
        Some("hdf5" | "h5") => (write_fclib(problem).map_err(|e| e.of(path))?, Vec::new()),
        Some("dat" | "txt") => (write_text(problem).map_err(|e| e.of(path))?.into_bytes(), problem.lost_in_text()),
        _ => {
            let what = "the ending names no format; .hdf5 and .h5 are FCLIB's, .dat and .txt are text";
            return Err(FileError::new(Place::Whole, what).of(path));
        }
    };
    replace(path, &bytes).map_err(|e| FileError::new(Place::Whole, format!("cannot be written: {e}")).of(path))?;
    Ok(lost)
}

fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".moreau-");
    // Who may read a problem is the user's choice, the mask; temporary files are their owner's alone otherwise.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // An error of a temporary file carries its name, which the user does not know.
    let mut beside = builder.tempfile_in(folder).map_err(|error| {
        let text = error.to_string();
        std::io::Error::new(error.kind(), text.split_once(" at path ").map_or(text.clone(), |(reason, _)| reason.to_owned()))
    })?;
    beside.as_file_mut().write_all(bytes)?;
    beside.as_file().sync_all()?;
    beside.persist(path)?;
    Ok(())
}

impl ProblemFile {
    /// A problem with these equations and coefficients and nothing else.
    pub fn new(dimension: usize, equations: Equations, mu: Vec<f64>, mu_r: Option<Vec<f64>>) -> Self {
        let (info, guesses, solution, notes) = (Info::default(), Vec::new(), None, Vec::new());
        Self { dimension, equations, mu, mu_r, info, guesses, solution, notes }
    }

    /// How many contacts there are.
    pub fn contacts(&self) -> usize {
        self.mu.len()
    }

    /// D·N, the length of r and u.
    pub(crate) fn unknowns(&self) -> usize {
        self.dimension.saturating_mul(self.contacts())
    }

    /// Whether sizes fit together, indices are in range, values are finite and coefficients are not negative.
    ///
    /// # Errors
    ///
    /// Names the part that is wrong.
    pub fn check(&self) -> Result<(), FileError> {
        match (self.dimension, &self.mu_r) {
            (2 | 3, None) | (3 | 5, Some(_)) => {}
            (d, None) => return Err(FileError::part("dimension", format!("{d}; 2 or 3 is right, with rolling friction 3 or 5"))),
            (d, Some(_)) => return Err(FileError::part("dimension", format!("{d}; 3 or 5 is right with rolling friction"))),
        }
        check_coefficients("mu", &self.mu, self.contacts())?;
        if let Some(mu_r) = &self.mu_r {
            check_coefficients("mu_r", mu_r, self.contacts())?;
        }
        let size = self.unknowns();
        let velocities = self.check_equations(size)?;
        let name = |k: usize| format!("guess {}", k + 1);
        let guesses = self.guesses.iter().enumerate().map(|(k, guess)| (name(k), guess));
        for (name, iterate) in guesses.chain(self.solution.iter().map(|s| ("solution".to_owned(), s))) {
            check_vector(&format!("r of {name}"), &iterate.r, size)?;
            check_vector(&format!("u of {name}"), &iterate.u, size)?;
            if let Some(v) = &iterate.v {
                check_vector(&format!("v of {name}"), v, velocities.unwrap_or(v.len()))?;
            }
        }
        Ok(())
    }

    /// Checks the equations for r and u of `size` numbers; the answer is the number of global velocities.
    fn check_equations(&self, size: usize) -> Result<Option<usize>, FileError> {
        match &self.equations {
            Equations::Local { w, q } => {
                check_matrix("W", w, size, size)?;
                check_vector("q", q, size)?;
                Ok(None)
            }
            Equations::Global { m, h, f, w, bilateral } => {
                check_matrix("M", m, f.len(), f.len())?;
                check_matrix("H", h, f.len(), size)?;
                check_vector("f", f, f.len())?;
                check_vector("w", w, size)?;
                if let Some(Bilateral { g, b }) = bilateral {
                    check_matrix("G", g, f.len(), b.len())?;
                    check_vector("b", b, b.len())?;
                }
                Ok(Some(f.len()))
            }
        }
    }

    /// What a text file has no place for.
    fn lost_in_text(&self) -> Vec<String> {
        let parts = [
            (self.info != Info::default(), "title, description and mathematics"),
            (!self.guesses.is_empty(), "the guesses"),
            (self.solution.is_some(), "the solution"),
        ];
        parts.iter().filter(|p| p.0).map(|p| format!("the text format has no place for {}", p.1)).collect()
    }
}

fn check_matrix(name: &str, matrix: &SparseMatrix, rows: usize, columns: usize) -> Result<(), FileError> {
    if (matrix.rows, matrix.columns) != (rows, columns) {
        let what = format!("{} × {}; {rows} × {columns} fits the other parts", matrix.rows, matrix.columns);
        return Err(FileError::part(name, what));
    }
    matrix.check().map_err(|what| FileError::part(name, what))
}

fn check_vector(name: &str, vector: &[f64], length: usize) -> Result<(), FileError> {
    if vector.len() != length {
        return Err(FileError::part(name, format!("{} numbers; {length} fit the other parts", vector.len())));
    }
    match vector.iter().position(|x| !x.is_finite()) {
        Some(k) => Err(FileError::part(name, format!("number {k} is {}; finite numbers are right", vector[k]))),
        None => Ok(()),
    }
}

fn check_coefficients(name: &str, mu: &[f64], length: usize) -> Result<(), FileError> {
    check_vector(name, mu, length)?;
    match mu.iter().position(|&x| x < 0.0) {
        Some(k) => Err(FileError::part(name, format!("{} at contact {k}; coefficients are not negative", mu[k]))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
