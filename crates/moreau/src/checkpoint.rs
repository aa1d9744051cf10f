//! Checkpoints: all that a run needs to go on from the end of a step as if it had never stopped, bit by bit, on any number of threads.
//!
//! What follows from the scene (shapes, masses, laws, joints, settings) is not kept: the scene is, and the world is built from it again. What is
//! kept is what steps change: poses, velocities, loads, who is there; events and sources; the impulses that the next solve starts from; the
//! sums of the energy ledger and of the summary; and by which the files of the run are known to be whole up to this step. The search for
//! contacts keeps nothing, because what it finds does not depend on what it remembers.
//!
//! A file is, in this order: the line `moreau checkpoint`, the version of the layout (32 bits, little end first), the content
//! (postcard), and the BLAKE3 checksum of all before. It is written beside its place, brought to the disk and renamed; the last two are kept.

mod digest;
mod error;
mod file;
mod folder;
mod state;

pub(crate) use digest::{Digest, Sum};
pub use error::CheckpointError;
pub use file::{read, write};
pub use folder::{Checkpoints, is_name, last_step, newest};
pub(crate) use state::{poses, rows};

use crate::observe::Summary;
use crate::space::Space;
use crate::step::Workspace;
use crate::world::World;
use serde::{Deserialize, Serialize};
use state::State;

/// What is known of a file of the run that grows: so many bytes of it belong to the steps so far, and their checksum.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mark {
    /// The name of the file in the folder of the run.
    pub file: String,
    /// Bytes.
    pub length: u64,
    digest: Digest,
}

impl Mark {
    pub(crate) fn new(file: String, length: u64, digest: Digest) -> Self {
        Self { file, length, digest }
    }

    /// Whether these bytes of the file have this checksum.
    pub(crate) fn knows(&self, digest: &Digest) -> bool {
        self.digest == *digest
    }
}

/// A run at the end of a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// The scene, as TOML with all that it names.
    pub scene: String,
    /// Sums over the steps so far.
    pub summary: Summary,
    /// What is known of the run's files.
    pub marks: Vec<Mark>,
    state: State,
}

impl Checkpoint {
    /// A run of the scene (as TOML) as it is now.
    pub fn take<S: Space<D, N>, const D: usize, const N: usize>(
        scene: &str,
        (summary, marks): (Summary, Vec<Mark>),
        world: &World<S, D, N>,
        work: &Workspace<S, D, N>,
    ) -> Self {
        Self { scene: scene.to_owned(), summary, marks, state: State::take(world, work) }
    }

    /// How many steps were done.
    pub fn steps(&self) -> u64 {
        self.state.steps
    }

    /// A checksum of all that the steps to come depend on, of equal runs the same: not of seconds, nor of the length of files.
    pub fn state_digest(&self) -> [u8; 32] {
        self.state.digest().0
    }

    /// Puts a world that was built from the scene, and a workspace that is new, where the run was.
    ///
    /// # Errors
    /// Where the world has other bodies than the run had, or the content is none that a run could have; `world` is then spoilt.
    pub fn restore<S: Space<D, N>, const D: usize, const N: usize>(
        &self,
        world: &mut World<S, D, N>,
        work: &mut Workspace<S, D, N>,
    ) -> Result<(), CheckpointError> {
        self.state.restore(world, work)
    }
}
