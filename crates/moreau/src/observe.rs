//! Observers: who sees each step, and what is written of it.
//!
//! A [`Frame`] is a borrowed view of the world after a step. Adding an output is a file, and a row in [`OUTPUTS`].

mod background;
mod books;
mod failed;
pub mod interfaces;
mod measures;
mod status;
mod steps;
mod summary;
mod table;
mod trajectory;
pub mod verdict;
mod vtk;

pub use failed::FailedProblems;
pub use measures::MeasuresCsv;
pub use steps::{COLUMNS, StepsCsv, numbers};
pub use summary::Summary;
pub use trajectory::TrajectoryOutput;
pub use verdict::Verdict;
pub use vtk::VtkOutput;

use crate::checkpoint::Mark;
use crate::space::Space;
use crate::step::{FailedSolve, Localised, StepRecord};
use crate::world::World;
use moreau_solve::Row;
use std::path::PathBuf;

/// The table of outputs.
pub const OUTPUTS: &[Row] = &[
    Row {
        name: "steps",
        about: "steps.csv: a row a step with sweeps, residuals, penetration, joints, energies, energy created, seconds",
    },
    Row {
        name: "trajectory",
        about: "trajectory.h5: bodies and contacts of each frame and the records of steps, for moreau's own views and for Python",
    },
    Row { name: "measures", about: "measures.csv: coordination, solid fraction, fabric, stress, forces; as often as frames" },
    Row { name: "vtk", about: "vtk/: bodies, contacts, shapes, interfaces for ParaView, compressed, with .pvd collections" },
];

/// What an observer sees after a step; `record` is `None` for the state at the start.
pub struct Frame<'a, S: Space<D, N>, const D: usize, const N: usize> {
    /// Bodies, laws, time.
    pub world: &'a World<S, D, N>,
    /// The contacts of the last step, sorted by key.
    pub contacts: &'a [Localised<D>],
    /// What the step tells of itself.
    pub record: Option<&'a StepRecord>,
}

/// A file that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// By the operating system's word.
    #[error("cannot write {path}: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file to go on with that is not what the run left.
    #[error("cannot go on with {}: it is not what the run wrote; move it away, and the run begins it anew from here", path.display())]
    Changed {
        /// The file.
        path: PathBuf,
    },
    /// A checkpoint.
    #[error(transparent)]
    Checkpoint(#[from] crate::checkpoint::CheckpointError),
    /// By the word of the writer of problem files.
    #[error(transparent)]
    Problem(#[from] moreau_solve::files::FileError),
    /// By the word of the writer of trajectories.
    #[error("cannot write {0}")]
    Trajectory(#[from] crate::trajectory::TrajectoryError),
    /// By the VTK writer's word.
    #[error(transparent)]
    Vtk(#[from] crate::io::vtk::VtkError),
}

impl OutputError {
    pub(crate) fn io(path: &std::path::Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| OutputError::Io { path: path.to_owned(), source }
    }
}

/// Someone who looks at every step.
pub trait Observer<S: Space<D, N>, const D: usize, const N: usize>: Send {
    /// Sees one frame. Who writes much copies what is needed and writes it elsewhere: the next step begins when this returns.
    ///
    /// # Errors
    /// Where what it writes cannot be written, or could not since it was asked last.
    fn see(&mut self, frame: &Frame<'_, S, D, N>) -> Result<(), OutputError>;

    /// Sees the problem of a step whose solve failed under the policy `dump`; returns the name of the file that it makes of it, if it
    /// makes one.
    ///
    /// # Errors
    /// Where what it writes cannot be written.
    fn see_failed(&mut self, _: &FailedSolve) -> Result<Option<String>, OutputError> {
        Ok(None)
    }

    /// Brings into its files all that it saw so far, for a checkpoint is about to say that it is there; gives the mark by which a file
    /// that is cut off again at this place is known.
    ///
    /// # Errors
    /// Where what it writes cannot be written.
    fn sync(&mut self) -> Result<Option<Mark>, OutputError> {
        Ok(None)
    }

    /// Completes its files; called once at the end, also of a run that was interrupted or cannot go on, and where another
    /// observer failed.
    ///
    /// # Errors
    /// Where they cannot be written.
    fn finish(&mut self) -> Result<(), OutputError> {
        Ok(())
    }
}
