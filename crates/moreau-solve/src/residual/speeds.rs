//! The scale of the scaled residual.

use super::{larger, squared};
use crate::block::Vector;

/// How many times faster than the fastest of the others a contact that stays open may count.
const FASTER: f64 = 10.0;

/// The scale of the scaled residual. Contacts that stay open have their gap, divided by the step, in both velocities, which may be any number:
/// all together they count for no more than if each were [`FASTER`] than the fastest of the others (theory (38)).
#[derive(Clone, Copy, Default)]
pub(super) struct Speeds {
    /// Σ ‖q‖² + ‖u‖² and its greatest part.
    sum: f64,
    fastest: f64,
    /// The sum for contacts that stay open, and how many they are.
    open: f64,
    count: u32,
}

impl Speeds {
    #[inline(always)]
    pub(super) fn add<const D: usize>(&mut self, q: &Vector<D>, u: &Vector<D>) {
        let speed = squared(q) + squared(u);
        self.sum += speed;
        self.fastest = larger(self.fastest, speed);
    }

    #[inline(always)]
    pub(super) fn add_open<const D: usize>(&mut self, q: &Vector<D>, u: &Vector<D>) {
        self.open += squared(q) + squared(u);
        self.count += 1;
    }

    pub(super) fn with(&mut self, other: &Self) {
        self.sum += other.sum;
        self.fastest = larger(self.fastest, other.fastest);
        self.open += other.open;
        self.count += other.count;
    }

    pub(super) fn total(&self) -> f64 {
        self.sum + self.open.min(FASTER * FASTER * f64::from(self.count) * self.fastest)
    }
}
