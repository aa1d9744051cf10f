//! What can be wrong with a checkpoint.

use std::path::{Path, PathBuf};

/// Why a run cannot go on from a checkpoint, or a checkpoint not be kept.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The system refused.
    #[error("cannot {what} {}: {source}", path.display())]
    Io {
        /// `read` or `write`.
        what: &'static str,
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The folder of the run has none.
    #[error(
        "{}: there is no checkpoint to go on from; a run keeps one at its start, at its end, and as often as the scene's [checkpoint] says",
        path.display()
    )]
    None {
        /// The folder.
        path: PathBuf,
    },
    /// A file that is none, is damaged, or is of another version.
    #[error("{}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The content does not fit the world of the scene.
    #[error("the checkpoint does not fit the scene: {0}")]
    Misfit(String),
}

impl CheckpointError {
    pub(super) fn io(what: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { what, path, source }
    }

    pub(super) fn unreadable(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self::Unreadable { path: path.to_owned(), reason: reason.to_string() }
    }

    pub(crate) fn misfit(reason: impl std::fmt::Display) -> Self {
        Self::Misfit(reason.to_string())
    }
}
