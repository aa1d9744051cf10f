//! `vtk/`: bodies and contacts for ParaView, one pair of files a frame and two collections with times; where some body is neither a ball
//! nor a disk, also shapes and interfaces.
//!
//! A frame is copied out of the world (`snapshot.rs`) and handed to a thread that compresses and writes it (`files.rs`) while the
//! run goes on. The run waits only where frames come faster than they can be written, and at its end. The collections name each
//! frame within a second or so of its being written, and all of them at the end.

mod files;
mod interfaces;
mod shapes;
mod snapshot;
#[cfg(test)]
mod tests;

use super::background::Background;
use super::{Frame, Observer, OutputError};
use crate::checkpoint::Mark;
use crate::space::Space;
use files::Files;
use shapes::Drawing;
use snapshot::Snapshot;
use std::path::Path;
use std::sync::Arc;

/// Writes every n-th step, on a thread of its own.
///
/// What cannot be written is told at a later step or at the end; nothing is written after it.
#[derive(Debug)]
pub struct VtkOutput {
    every: u64,
    files: Background<Snapshot>,
    drawing: Arc<Drawing>,
}

impl VtkOutput {
    /// Writes into `folder` (made if need be) the start and every `every`-th step.
    ///
    /// # Errors
    /// Where the folder cannot be made, or there can be no thread.
    pub fn create(folder: &Path, every: u64) -> Result<Self, OutputError> {
        std::fs::create_dir_all(folder).map_err(OutputError::io(folder))?;
        Self::of(folder, every, Files::new(folder))
    }

    /// Goes on with the frames of a run that was stopped: those after step `last` are taken out.
    ///
    /// # Errors
    /// As [`Self::create`], and where a collection is none or names frames that are not there.
    pub fn resume(folder: &Path, every: u64, last: u64) -> Result<Self, OutputError> {
        Self::of(folder, every, Files::resume(folder, last)?)
    }

    fn of(folder: &Path, every: u64, files: Files) -> Result<Self, OutputError> {
        let files = Background::start(files).map_err(OutputError::io(folder))?;
        Ok(Self { every: every.max(1), files, drawing: Arc::default() })
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Observer<S, D, N> for VtkOutput {
    fn see(&mut self, frame: &Frame<'_, S, D, N>) -> Result<(), OutputError> {
        if !frame.world.steps.is_multiple_of(self.every) {
            return self.files.check();
        }
        let mut snapshot = self.files.used().unwrap_or_default();
        snapshot.take(frame, &mut self.drawing);
        self.files.give(snapshot)
    }

    fn sync(&mut self) -> Result<Option<Mark>, OutputError> {
        self.files.sync().map(|()| None)
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        self.files.finish()
    }
}
