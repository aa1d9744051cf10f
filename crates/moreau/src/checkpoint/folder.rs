//! The checkpoints of a run: when one is due, how many are kept, which is read.

use super::{Checkpoint, CheckpointError, read, write};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How many are kept: if the last is damaged, the one before it is there.
const KEPT: usize = 2;

/// The checkpoints in the folder of a run.
#[derive(Debug)]
pub struct Checkpoints {
    folder: PathBuf,
    /// Steps from one to the next; 0 for none.
    every: u64,
    /// Wall-clock time from one to the next.
    after: Option<Duration>,
    last: Instant,
    /// The step of the last one.
    saved: Option<u64>,
}

impl Checkpoints {
    /// One each `every` steps, if that is not zero, and each `seconds` of wall-clock time, if that is not zero; where either is not zero, also
    /// one at the start and one at the end.
    pub fn new(folder: &Path, every: u64, seconds: f64) -> Self {
        // A time that no clock reaches leaves those at the start and at the end.
        let after = (seconds > 0.0).then(|| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX));
        Self { folder: folder.to_owned(), every, after, last: Instant::now(), saved: None }
    }

    /// Whether one is to be kept after this step.
    pub(crate) fn due(&self, step: u64) -> bool {
        (self.every > 0 && step.is_multiple_of(self.every)) || self.after.is_some_and(|after| self.last.elapsed() >= after)
    }

    /// Returns whether checkpoints are kept at all and this step, at which the run begins or ends, has none yet.
    pub(crate) fn due_at_bound(&self, step: u64) -> bool {
        (self.every > 0 || self.after.is_some()) && self.saved != Some(step)
    }

    /// Keeps this one and the last before it.
    pub(crate) fn save(&mut self, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
        write(&self.folder.join(name(checkpoint.steps())), checkpoint)?;
        (self.last, self.saved) = (Instant::now(), Some(checkpoint.steps()));
        // One that cannot be removed does no harm.
        all(&self.folder).iter().rev().skip(KEPT).for_each(|(_, old)| drop(std::fs::remove_file(old)));
        Ok(())
    }
}

/// Names sort as steps do, for all runs that end.
fn name(step: u64) -> String {
    format!("checkpoint-{step:012}.bin")
}

/// The step of the checkpoint in a file of this name, if it is one.
fn step_of(name: &OsStr) -> Option<u64> {
    name.to_str()?.strip_prefix("checkpoint-")?.strip_suffix(".bin")?.parse().ok()
}

/// Whether a file of this name is a checkpoint.
pub fn is_name(name: &OsStr) -> bool {
    step_of(name).is_some()
}

/// The checkpoints in a folder, the last at the end.
fn all(folder: &Path) -> Vec<(u64, PathBuf)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut all: Vec<_> = entries.filter_map(|entry| Some((step_of(&entry.file_name())?, entry.path()))).collect();
    all.sort();
    all
}

/// The step of the last checkpoint in the folder of a run, readable or not.
pub fn last_step(folder: &Path) -> Option<u64> {
    all(folder).last().map(|(step, _)| *step)
}

/// The last checkpoint in the folder of a run that can be read, and what was wrong with those after it.
///
/// # Errors
/// Where there is none, or none can be read; the error is then that of the last.
pub fn newest(folder: &Path) -> Result<(Checkpoint, Vec<CheckpointError>), CheckpointError> {
    let mut passed_over = Vec::new();
    for (_, path) in all(folder).iter().rev() {
        match read(path) {
            Ok(checkpoint) => return Ok((checkpoint, passed_over)),
            Err(error) => passed_over.push(error),
        }
    }
    if passed_over.is_empty() { Err(CheckpointError::None { path: folder.to_owned() }) } else { Err(passed_over.swap_remove(0)) }
}
