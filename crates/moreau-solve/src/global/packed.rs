//! Contacts of round bodies, packed for visits of four at a time.
//!
//! Contacts are put into blocks, near each other in space; within a block they are coloured, and four of one colour make a group,
//! which [`Kernel`]s visit at once since no two of them share a body. Blocks are coloured in their turn: those of one wave share no
//! body, so threads may take them in any order and the bits are the same. The order of visits is that of the arrays; it depends on
//! the problem alone.
//!
//! A sweep is fused with the momentum that leads to it (y = z + β (z − z₋) is never stored) and adds up what the next decision needs.

mod central;
mod drive;
mod fill;
mod kernel;
mod layout;
mod round;
mod shared;
mod sweep;
#[cfg(test)]
mod tests;
mod vector;

pub(super) use drive::run;

use crate::operator::{Balls, NONE};
use crate::wide::{Four, Kernels, LANES};
use central::Central;
use kernel::Kernel;
use layout::Layout;
use round::Round;
use sweep::Sums;

/// What a visit without friction and one with it keep from solve to solve: memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Packings {
    central: Packing<Central, 1, 1>,
    round: Packing<Round, 2, 3>,
}

/// A packed problem; B rows of four numbers a body, C components of an impulse.
#[derive(Clone, Debug)]
pub(crate) struct Packing<K: Kernel<B, C>, const B: usize, const C: usize> {
    kernels: Kernels,
    layout: Layout,
    groups: Vec<K::Group>,
    /// Velocities that the impulses gave the bodies, then one blank for each block: what a wall is.
    state: Vec<[Four; B]>,
    /// The same after the sweep before.
    earlier: Vec<[Four; B]>,
    /// Impulses after the last sweep, after the one before, and the best so far.
    z: Vec<[Four; C]>,
    before: Vec<[Four; C]>,
    best: Vec<[Four; C]>,
    /// Velocities that the visits of the last sweep claimed, if they were asked to.
    claimed: Vec<[Four; C]>,
    /// What each block of a sweep adds up.
    sums: Vec<Sums>,
    /// The criterion over the change by a sweep, and over the number that is watched in its place, as last seen: guesses for the
    /// next solve.
    ratio: f64,
    scale: f64,
}

impl<K: Kernel<B, C>, const B: usize, const C: usize> Default for Packing<K, B, C> {
    fn default() -> Self {
        Self {
            kernels: Kernels::Auto,
            layout: Layout::default(),
            groups: Vec::new(),
            state: Vec::new(),
            earlier: Vec::new(),
            z: Vec::new(),
            before: Vec::new(),
            best: Vec::new(),
            claimed: Vec::new(),
            sums: Vec::new(),
            ratio: 0.0,
            scale: 0.0,
        }
    }
}

/// The contacts in the lanes of one group; [`NONE`] in a lane that has none.
type Members = [u32; LANES];
