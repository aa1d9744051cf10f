//! The trajectory of a run: where bodies were and how fast, what was between them, frame by frame, and the record of each step.
//!
//! It is one HDF5 file, `trajectory.h5`, that any reader of HDF5 opens. All that grows is in one-dimensional datasets, compressed in chunks:
//! numbers of a frame follow on each other, body after body, contact after contact. With `n` bodies, of which none leaves its place in the
//! arrays (an absent one has no number for a position), in `D` dimensions:
//!
//! | dataset | of each | numbers | meaning |
//! |---|---|---|---|
//! | `bodies/radius`, `mass`, `material`, `free` | body | 1 | bounding radius (m, infinite of what is unbounded), mass (kg), index of the material, whether it is free at some time of the run |
//! | `frames/step`, `time`, `contacts` | frame | 1 | number of the step, its time (s), contacts of all frames to the end of this one |
//! | `frames/position`, `velocity` | frame and body | `D` | m, m/s |
//! | `frames/rotation` | frame and body | 4, 2 | quaternion x, y, z, w; in the plane cosine and sine |
//! | `frames/spin` | frame and body | 3, 1 | in the world, rad/s |
//! | `frames/motion` | frame and body | 1 | 0 absent (not yet come, or taken out), 1 held or driven, 2 free |
//! | `contacts/a`, `b` | contact | 1 | indices of the bodies |
//! | `contacts/point`, `normal`, `impulse` | contact | `D` | m; unit, from a to b; that of the step on b, in the world, N·s |
//! | `contacts/gap` | contact | 1 | m, at the predicted configuration |
//! | `contacts/status` | contact | 1 | 0 without impulse, 1 sticking, 2 sliding |
//! | `steps` | step | as many as columns | the row of `steps.csv` |
//!
//! The root has the attributes `format` (`moreau trajectory`), `version`, `dimension`, `title`, `step` (s), `every` and
//! `columns`, the names of those of `steps` with commas between them. What is real is in
//! single or double precision by choice, times, masses, radii and records in double always.
//!
//! Frames are appended some at a time, and `frames/step` last: a frame that is listed there is whole, whenever the run was killed and while it
//! goes on.

mod read;
#[cfg(test)]
mod tests;
mod write;

pub use read::{Trajectory, TrajectoryFrame};
pub use write::{Header, TrajectoryWriter};

use crate::bodies::Motion;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The version of the layout and of the columns of records.
const VERSION: i64 = 4;

/// The number in `frames/motion` for how a body moves.
pub(crate) fn motion_number(motion: Motion) -> u8 {
    match motion {
        Motion::Absent => 0,
        Motion::Driven => 1,
        Motion::Free => 2,
    }
}

/// What the attribute `format` says.
const FORMAT: &str = "moreau trajectory";

/// How real numbers of frames are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// 32 bits, which is a ten-millionth of a position.
    #[default]
    Single,
    /// 64 bits, as they were computed.
    Double,
}

/// A trajectory that cannot be written or read.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {reason}")]
pub struct TrajectoryError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong.
    pub reason: String,
}

impl TrajectoryError {
    fn new(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self { path: path.to_owned(), reason: reason.to_string() }
    }
}

/// Frames and rows that are written together.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Numbers of the steps.
    pub step: Vec<u64>,
    /// s.
    pub time: Vec<f64>,
    /// How many contacts each frame has.
    pub contacts: Vec<u64>,
    /// What is real, by [`REALS`].
    pub reals: [Vec<f64>; REALS.len()],
    /// How bodies move: 0 absent, 1 held or driven, 2 free.
    pub motion: Vec<u8>,
    /// The pairs of bodies of contacts.
    pub pairs: [Vec<u32>; 2],
    /// Their status.
    pub status: Vec<u8>,
    /// Records of steps, by the columns of `steps.csv`.
    pub rows: Vec<[f64; crate::observe::COLUMNS.len()]>,
}

/// The datasets of real numbers of frames and contacts.
pub const REALS: [&str; 8] = [
    "frames/position",
    "frames/rotation",
    "frames/velocity",
    "frames/spin",
    "contacts/point",
    "contacts/normal",
    "contacts/impulse",
    "contacts/gap",
];

/// How many numbers a body or a contact has in each of [`REALS`].
const fn widths(dimension: usize) -> [usize; REALS.len()] {
    if dimension == 2 { [2, 2, 2, 1, 2, 2, 2, 1] } else { [3, 4, 3, 3, 3, 3, 3, 1] }
}

/// The datasets of a contact's bodies.
const PAIRS: [&str; 2] = ["contacts/a", "contacts/b"];

impl Batch {
    /// Forgets all, and keeps the memory.
    pub fn clear(&mut self) {
        self.step.clear();
        self.time.clear();
        self.contacts.clear();
        self.reals.iter_mut().for_each(Vec::clear);
        self.motion.clear();
        self.pairs.iter_mut().for_each(Vec::clear);
        self.status.clear();
        self.rows.clear();
    }

    /// Takes all of another over.
    pub fn append(&mut self, other: &Self) {
        self.step.extend(&other.step);
        self.time.extend(&other.time);
        self.contacts.extend(&other.contacts);
        self.reals.iter_mut().zip(&other.reals).for_each(|(to, from)| to.extend(from));
        self.motion.extend(&other.motion);
        self.pairs.iter_mut().zip(&other.pairs).for_each(|(to, from)| to.extend(from));
        self.status.extend(&other.status);
        self.rows.extend(&other.rows);
    }

    /// Takes over a frame that was read.
    fn push(&mut self, frame: TrajectoryFrame) {
        let TrajectoryFrame {
            step,
            time,
            position,
            rotation,
            velocity,
            spin,
            motion,
            pairs,
            point,
            normal,
            impulse,
            gap,
            status,
        } = frame;
        self.step.push(step);
        self.time.push(time);
        self.contacts.push(status.len() as u64);
        let reals = [position, rotation, velocity, spin, point, normal, impulse, gap];
        self.reals.iter_mut().zip(reals).for_each(|(to, from)| to.extend(from));
        self.motion.extend(motion);
        self.pairs.iter_mut().zip(pairs).for_each(|(to, from)| to.extend(from));
        self.status.extend(status);
    }

    /// Whether there is nothing to write.
    pub fn is_empty(&self) -> bool {
        self.step.is_empty() && self.rows.is_empty()
    }

    /// How much it is, in numbers.
    pub fn len(&self) -> usize {
        self.reals.iter().map(Vec::len).sum::<usize>() + self.rows.len() * crate::observe::COLUMNS.len()
    }
}
