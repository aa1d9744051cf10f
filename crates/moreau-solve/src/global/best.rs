//! The best impulses of a solve, which are its answer where it ends otherwise than by its criterion.
//!
//! Methods may get worse from sweep to sweep, and a limit may come at any time. The judge shows whatever it measures to [`Best`]; [`settle`]
//! puts the best back at the end. No method has to care.

use super::claims;
use crate::block::Vector;
use crate::residual::measure;
use crate::{Operator, Problem, Residual, Scratch, Settings};

/// The best of the impulses that were measured.
#[derive(Clone, Debug)]
pub(crate) struct Best<const D: usize> {
    /// Their criterion; infinite until something was measured.
    pub(super) error: f64,
    pub(super) impulses: Vec<Vector<D>>,
    /// The velocities claimed with them, of methods that claim any.
    claimed: Vec<Vector<D>>,
}

impl<const D: usize> Default for Best<D> {
    fn default() -> Self {
        Self { error: f64::INFINITY, impulses: Vec::new(), claimed: Vec::new() }
    }
}

impl<const D: usize> Best<D> {
    /// Forgets all but the memory, for another solve.
    pub(super) fn forget(&mut self) {
        self.error = f64::INFINITY;
    }

    /// Copies impulses whose criterion is `error`, if none were better. NaN is never better.
    pub(super) fn see(&mut self, error: f64, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) {
        if error < self.error {
            self.error = error;
            super::keep(&mut self.impulses, r);
            super::keep(&mut self.claimed, claimed.unwrap_or_default());
        }
    }

    /// Exchanges the impulses, with the velocities claimed for them.
    fn exchange(&mut self, r: &mut [Vector<D>], claimed: &mut Vec<Vector<D>>) {
        r.swap_with_slice(&mut self.impulses);
        std::mem::swap(claimed, &mut self.claimed);
    }
}

/// Leaves in `r` the better of its impulses and the best ones, or these in any case where its own were not `seen`, and measures them from the impulses alone.
///
/// Impulses that are not finite never remain: without better ones they become zero.
pub(super) fn settle<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    settings: &Settings,
    r: &mut [Vector<D>],
    scratch: &mut Scratch<O::State, D>,
    (best, seen): (&mut Best<D>, bool),
) -> Residual {
    let measured = |r: &[Vector<D>], scratch: &mut Scratch<O::State, D>| {
        problem.operator.start(r, &mut scratch.state);
        measure(problem, &scratch.state, r, claims(&scratch.claimed))
    };
    if !seen {
        best.exchange(r, &mut scratch.claimed);
        return measured(r, scratch);
    }
    let last = measured(r, scratch);
    let error = last.of(settings.criterion);
    if best.error.is_finite() && (error.is_nan() || best.error < error) {
        best.exchange(r, &mut scratch.claimed);
        let residual = measured(r, scratch);
        // A state gathers rounding: what was measured of it may have looked better than it is.
        if error.is_nan() || residual.of(settings.criterion) <= error {
            return residual;
        }
        best.exchange(r, &mut scratch.claimed);
        return measured(r, scratch);
    }
    if error.is_nan() && !r.as_flattened().iter().all(|x| x.is_finite()) {
        r.fill([0.0; D]);
        scratch.claimed.clear();
        return measured(r, scratch);
    }
    last
}
