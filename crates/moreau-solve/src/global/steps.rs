//! What methods of steps share: the scale of each contact, products with W, and the question whether to go on.
//!
//! A step takes all contacts together: r ← P_K(r − t û/w), with the w_c of the scaled residual in the place of a mass. So a step
//! has no unit, t is near one, and a problem in millimetres takes the steps of one in metres.

use super::Work;
use crate::block::{Vector, dot};
use crate::residual::mean_diagonal;
use crate::{Operator, Problem, Status};

/// For each contact w_c, or zero where impulses do not move it: those stay as they are.
pub(super) fn scales<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>) -> Vec<f64> {
    let usable = |w: f64| if w > 0.0 && w.is_finite() { w } else { 0.0 };
    (0..problem.len()).map(|c| usable(mean_diagonal(problem, c))).collect()
}

/// 1/w_c, zero where w_c is.
#[inline]
pub(super) fn inverse(w: f64) -> f64 {
    if w > 0.0 { 1.0 / w } else { 0.0 }
}

/// W x, by way of a state that is free to use.
pub(super) fn product<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    state: &mut O::State,
    x: &[Vector<D>],
    wx: &mut [Vector<D>],
) {
    problem.operator.start(x, state);
    for (c, wx) in wx.iter_mut().enumerate() {
        *wx = problem.operator.apply(state, c);
    }
}

/// Σ a_c · b_c.
pub(super) fn inner<const D: usize>(a: &[Vector<D>], b: &[Vector<D>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| dot(a, b)).sum()
}

/// Σ w_c a_c · b_c.
pub(super) fn weighted<const D: usize>(w: &[f64], a: &[Vector<D>], b: &[Vector<D>]) -> f64 {
    w.iter().zip(a).zip(b).map(|((w, a), b)| w * dot(a, b)).sum()
}

/// Asks the judge after a step, about a state made again from the impulses.
pub(super) fn after_step<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Option<Status> {
    work.problem.operator.start(work.r, &mut work.scratch.state);
    work.after_sweep()
}
