//! Detection: from poses to contacts.
//!
//! Which bodies are near each other is remembered from call to call (`nearby`): each bounded body is held by a ball somewhat
//! larger than itself and its reach, and as long as it stays inside, the pairs of these balls are all that can touch. Only when
//! some body has left its ball does the broad phase (`broad`) find the pairs anew. Of the pairs that are listed, those whose
//! bounding balls meet now go to the narrow phase (`narrow`), in the order of their keys. Contacts with sides that an adjoining piece
//! of ground hides are taken out (`seams`). What comes out therefore depends
//! neither on how the pairs were found nor on when. All scratch is kept from call to call.

mod bound;
mod broad;
pub(crate) mod narrow;
mod nearby;
mod pairs;
mod seams;
mod sift;
mod skin;
mod wall;

pub(crate) use narrow::{parts_of, piece_of};

use crate::contacts::Contact;
use crate::space::{Pose, Space};
use bound::Bound;
use nearby::Nearby;
use seams::Seams;
use sift::Sieve;

/// By how much coarse tests give way, so that their rounding never drops what the exact one would keep.
const SLACK: f64 = 1e-12;

/// How many bodies or pairs a thread takes at a time; fewer are not worth a thread.
const CHUNK: usize = 4096;

/// How many pairs a thread takes at a time where bodies are not round: the contacts of two take hundreds of times as long.
const CHUNK_OF_SHAPES: usize = 64;

/// Whether so many bodies or pairs are shared out among threads, which take so many at a time.
fn is_shared(count: usize, chunk: usize) -> bool {
    count > chunk && rayon::current_num_threads() > 1
}

/// The bodies of a call, in slices of one length.
struct Scene<'a, S: Space<D, N>, const D: usize, const N: usize> {
    shapes: &'a [S::Shape],
    poses: &'a [Pose<S::Rotation, D>],
    reach: &'a [f64],
}

/// Finds the contacts of all bodies. What it remembers from call to call is checked against the bodies of each call and changes
/// nothing in what is found. An allocation is made only where a scene needs more than any before it.
#[derive(Clone, Debug, Default)]
pub struct Detector<const D: usize> {
    /// Bounding balls of the call.
    bounds: Vec<Bound<D>>,
    nearby: Nearby<D>,
    sieve: Sieve<D>,
    seams: Seams<D>,
}

impl<const D: usize> Detector<D> {
    /// A detector with nothing reserved.
    pub fn new() -> Self {
        Self::default()
    }

    /// Clears `out` and fills it with every contact whose gap is at most the sum of its bodies' `reach` (m), sorted by key and
    /// without duplicates; pairs of two `driven` bodies are left out, and so are pairs that no narrow phase knows.
    ///
    /// Bodies are the entries of the three slices, as far as all three go. A body whose position is not finite touches nothing.
    /// Anything may change between two calls; a detector is quick where bodies keep their places in the slices and move little.
    pub fn detect<S: Space<D, N>, const N: usize>(
        &mut self,
        shapes: &[S::Shape],
        poses: &[Pose<S::Rotation, D>],
        reach: &[f64],
        driven: impl Fn(usize) -> bool + Sync,
        out: &mut Vec<Contact<D>>,
    ) {
        let count = shapes.len().min(poses.len()).min(reach.len());
        let scene = Scene::<S, D, N> { shapes: &shapes[..count], poses: &poses[..count], reach: &reach[..count] };
        if !self.nearby.still_holds(&scene, &driven, &mut self.bounds) {
            self.nearby.rebuild(&scene, &driven, &self.bounds);
        }
        let chunk = if self.nearby.all_round() { CHUNK } else { CHUNK_OF_SHAPES };
        self.sieve.contacts(&scene, &self.bounds, self.nearby.pairs(), chunk, out);
        self.seams.mend(&scene, &self.bounds, &driven, out);
    }
}

#[cfg(test)]
mod tests;
