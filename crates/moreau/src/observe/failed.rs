//! `failed-step-N.hdf5`: problems of steps whose solve did not converge, under the policy `dump`.

use super::{Frame, Observer, OutputError};
use crate::space::Space;
use crate::step::FailedSolve;
use moreau_solve::files;
use std::path::{Path, PathBuf};

/// Writes each problem into a folder.
#[derive(Debug)]
pub struct FailedProblems {
    folder: PathBuf,
}

impl FailedProblems {
    /// Writes into `folder`, which must be there.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned() }
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Observer<S, D, N> for FailedProblems {
    fn see(&mut self, _: &Frame<'_, S, D, N>) -> Result<(), OutputError> {
        Ok(())
    }

    fn see_failed(&mut self, failed: &FailedSolve) -> Result<Option<String>, OutputError> {
        let Ok(problem) = &failed.problem else { return Ok(None) };
        let name = failed.file_name();
        files::write(&self.folder.join(&name), problem)?;
        Ok(Some(name))
    }
}
