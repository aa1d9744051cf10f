//! What can go wrong when a ParaView file is written.

use std::io;
use std::path::{Path, PathBuf};

/// Why a file was not written. Each variant carries the path of that file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VtkError {
    /// The system refused: the folder is missing, read-only or full.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file that was to be written.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A collection to go on with that cannot be read.
    #[error("cannot go on with {}: {source}; move the folder away, and the run begins it anew from here", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// An array does not have one tuple for each point or cell.
    #[error(
        "cannot write {}: {place} array `{array}` has {found} numbers, but {count} tuples of {components} were expected",
        path.display()
    )]
    Length {
        /// The file that was to be written.
        path: PathBuf,
        /// `point` or `cell`.
        place: &'static str,
        /// The name of the array.
        array: String,
        /// The numbers of the array.
        found: usize,
        /// The points or cells of the data set.
        count: usize,
        /// The numbers of one tuple; none is never right.
        components: usize,
    },
    /// A line or polygon names a point that is not there.
    #[error("cannot write {}: {kind} {cell} names point {index}, but there are {points} points", path.display())]
    Index {
        /// The file that was to be written.
        path: PathBuf,
        /// `line` or `polygon`.
        kind: &'static str,
        /// Which one, counted from 0.
        cell: usize,
        /// The index that it names.
        index: usize,
        /// The points of the data set.
        points: usize,
    },
    /// A name that a reader would reject, or that would hide another array.
    #[error("cannot write {}: the name {name:?} {reason}", path.display())]
    Name {
        /// The file that was to be written.
        path: PathBuf,
        /// The name.
        name: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A time that is infinite or not a number.
    #[error("cannot write {}: the time {time} is not finite", path.display())]
    Time {
        /// The file that was to be written.
        path: PathBuf,
        /// The time.
        time: f64,
    },
}

impl VtkError {
    pub(super) fn io(path: &Path, source: io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }
}
