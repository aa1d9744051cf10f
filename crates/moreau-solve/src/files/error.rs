//! What can be wrong with a problem file.

use std::fmt;
use std::path::{Path, PathBuf};

/// A file that cannot be read, written or used: which one, where in it, what is wrong and what would be right.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{place}{what}", self.prefix())]
pub struct FileError {
    /// The file; `None` where the content did not come from one.
    pub file: Option<PathBuf>,
    /// Where in the file.
    pub place: Place,
    /// What is wrong, and what would be right.
    pub what: String,
}

/// A place in a problem file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file or the problem as a whole.
    Whole,
    /// A token of a text file; line, column and token are counted from 1.
    Token {
        /// The line.
        line: usize,
        /// The column, in bytes.
        column: usize,
        /// The token's number in the file.
        token: usize,
    },
    /// A group or dataset of an HDF5 file, by its path.
    Dataset(String),
    /// A part of the problem, by its name in the equations: `W`, `q`, `mu`.
    Part(String),
}

impl FileError {
    /// An error at `place`, of a file not yet named.
    pub(crate) fn new(place: Place, what: impl Into<String>) -> Self {
        Self { file: None, place, what: what.into() }
    }

    /// An error in the part of the problem that is called `name`.
    pub(crate) fn part(name: &str, what: impl Into<String>) -> Self {
        Self::new(Place::Part(name.to_owned()), what)
    }

    /// The same error, of the file `path`.
    pub(crate) fn of(mut self, path: &Path) -> Self {
        self.file = Some(path.to_owned());
        self
    }

    fn prefix(&self) -> String {
        self.file.as_ref().map_or_else(String::new, |file| format!("{}: ", file.display()))
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole => Ok(()),
            Self::Token { line, column, token } => write!(f, "line {line}, column {column} (token {token}): "),
            Self::Dataset(path) => write!(f, "{path}: "),
            Self::Part(name) => write!(f, "{name}: "),
        }
    }
}
