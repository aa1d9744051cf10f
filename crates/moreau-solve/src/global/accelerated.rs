//! Accelerated NLGS: a Gauss-Seidel sweep as the step of Nesterov's iteration, with Anderson's mixing where that sees further.
//!
//! ```text
//! repeat until the criterion is met:
//!   z⁺ = one sweep of NLGS from y                               f = z⁺ − y, what the sweep changed
//!   if mixing the last five changes would leave less than 0.2 ‖f‖ of f:      y = P_K(z⁺ − Σ γ_j Δz_j)     (Anderson)
//!   else if f points against the way just gone, f·(z⁺ − z) < 0.2 ‖f‖ ‖z⁺ − z‖,
//!        or has grown, ‖f‖² > 1.1 ‖f₋‖²:                        y = z⁺, shorter momentum               (restart)
//!   else                                                        y = z⁺ + β (z⁺ − z), longer momentum     (Nesterov)
//!   z = z⁺
//! ```
//!
//! in the norm of the diagonal of W, with β = t/(t + 1/2), t growing by one a sweep and cut to 0.6 t by a restart. Nesterov's part carries
//! news along chains of contacts in a number of sweeps that grows with their length, not with its square; Anderson's part ends small problems in a few sweeps.
//! The momentum costs one pass over bodies and impulses: W (z + β Δz) is what the operator's state already has, extrapolated.
//!
//! Safeguard: where the criterion has not fallen below its best value for some sweeps, twice as many plain ones follow from the best impulses, and the patience
//! doubles. Where acceleration fails altogether two thirds of all sweeps are thus plain ones that go on from each other.
//!
//! References: Nesterov 1983; O'Donoghue & Candès 2015 (restarts); Anderson 1965, Walker & Ni 2011 (mixing). With friction the
//! problem is not convex and nothing is proved: the criterion decides.

use super::mixing::Mixing;
use super::sweep::{Local, sweep};
use super::{Work, keep};
use crate::local::LocalSolver;
use crate::{Operator, Status};

/// For how many sweeps without a gain acceleration may go on at first.
pub(super) const FIRST_PATIENCE: u64 = 64;
/// β = t/(t + OFFSET).
const OFFSET: f64 = 0.5;
/// What a restart leaves of t.
const SHORTENED: f64 = 0.6;
/// The cosine of the angle to the way just gone below which a change of the impulses counts as against it.
const AGAINST: f64 = 0.2;
/// How much the square of the change may grow from sweep to sweep. Without friction it hardly grows; with it momentum may drive contacts
/// from sticking to sliding and back, which the angle alone sees too late.
const GROWTH: f64 = 1.1;

/// How far the next sweep is to go beyond the last.
#[derive(Clone, Copy, Debug)]
pub(super) struct Momentum {
    t: f64,
    /// ‖f₋‖.
    last: f64,
}

impl Default for Momentum {
    fn default() -> Self {
        Self { t: 1.0, last: f64::INFINITY }
    }
}

impl Momentum {
    /// β after a sweep that changed the impulses by ‖f‖ = `change`, on a way ‖z⁺ − z‖ = `length`, with f·(z⁺ − z) = `along`; zero is
    /// a restart.
    pub(super) fn after(&mut self, change: f64, length: f64, along: f64) -> f64 {
        let last = std::mem::replace(&mut self.last, change);
        if along < AGAINST * change * length || change * change > GROWTH * last * last {
            self.t = (SHORTENED * self.t).max(1.0);
            return 0.0;
        }
        let beta = self.t / (self.t + OFFSET);
        self.t += 1.0;
        beta
    }
}

/// Phases until the judge says stop.
pub(super) fn run<O: Operator<D>, L: LocalSolver, const D: usize>(work: &mut Work<'_, O, D>, local: L) -> Status {
    work.begin::<L>();
    keep(&mut work.scratch.best, work.r);
    let (mut best, mut patience) = (f64::INFINITY, FIRST_PATIENCE);
    loop {
        if let Some(status) = accelerate(work, local, patience, &mut best) {
            return status;
        }
        work.r.copy_from_slice(&work.scratch.best);
        work.problem.operator.start(work.r, &mut work.scratch.state);
        for _ in 0..2 * patience {
            sweep(work, local, false);
            if let Some(status) = work.after_sweep() {
                return status;
            }
        }
        best = work.judge.error;
        keep(&mut work.scratch.best, work.r);
        patience *= 2;
    }
}

/// Accelerated sweeps from the impulses of now, until the judge says stop or `patience` of them, and a third of all, have gone by without a
/// gain; `best` is the least criterion so far, and the scratch has its impulses.
fn accelerate<O: Operator<D>, L: LocalSolver, const D: usize>(
    work: &mut Work<'_, O, D>,
    local: L,
    patience: u64,
    best: &mut f64,
) -> Option<Status> {
    let mut mixing = std::mem::take(&mut work.scratch.mixing);
    mixing.begin(work.problem);
    let Work { r, scratch, .. } = work;
    keep(&mut scratch.previous, r);
    keep(&mut scratch.from, r);
    scratch.earlier.clone_from(&scratch.state);
    let (mut momentum, mut gained_at) = (Momentum::default(), work.judge.sweeps);
    let end = loop {
        sweep_from(work, local);
        if let Some(status) = work.after_sweep() {
            break Some(status);
        }
        if work.judge.measured_at == work.judge.sweeps {
            if work.judge.error < *best {
                (*best, gained_at) = (work.judge.error, work.judge.sweeps);
                keep(&mut work.scratch.best, work.r);
            } else if work.judge.sweeps - gained_at >= patience.max(work.judge.sweeps / 3) {
                break None;
            }
        }
        extrapolate(work, &mut mixing, &mut momentum);
    };
    work.scratch.mixing = mixing;
    end
}

/// Chooses the point y from which the next sweep starts.
fn extrapolate<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>, mixing: &mut Mixing, momentum: &mut Momentum) {
    let Work { problem, r, scratch, .. } = work;
    let way = mixing.push(r.as_flattened(), scratch.from.as_flattened(), scratch.previous.as_flattened());
    scratch.previous.copy_from_slice(r);
    let now = &mut scratch.spare;
    now.clone_from(&scratch.state);
    if mixing.propose(scratch.from.as_flattened_mut(), r.as_flattened()) {
        for (y, cone) in scratch.from.iter_mut().zip(problem.cones) {
            *y = cone.nearest(y);
        }
        problem.operator.start(&scratch.from, &mut scratch.state);
        *momentum = Momentum::default();
    } else {
        let beta = momentum.after(way.change, way.length, way.change_along_way);
        mixing.ahead(scratch.from.as_flattened_mut(), r.as_flattened(), beta);
        if beta != 0.0 {
            problem.operator.extrapolate(&mut scratch.state, &scratch.earlier, beta);
        }
    }
    std::mem::swap(&mut scratch.earlier, now);
}

/// A sweep that starts from the impulses `from` of the scratch, for which its state stands, and leaves its result in the impulses.
fn sweep_from<O: Operator<D>, L: LocalSolver, const D: usize>(work: &mut Work<'_, O, D>, local: L) {
    let Work { problem, r, scratch, judge, .. } = work;
    let (state, order) = (&mut scratch.state, &scratch.order);
    let n = order.len();
    let (q, cones, from, r) = (&problem.q[..n], &problem.cones[..n], &scratch.from[..n], &mut r[..n]);
    let claimed = if L::CLAIMS { &mut scratch.claimed[..n] } else { &mut [] };
    let mut unfinished = 0;
    for c in order.iter().map(|&c| c as usize).filter(|&c| c < n) {
        let (r, u) = (&mut r[c], claimed.get_mut(c));
        let visit = Local { local, q: &q[c], cone: cones[c], from: from[c], omega: 1.0, r, u, unfinished: &mut unfinished };
        problem.operator.relax(state, c, visit);
    }
    judge.unfinished_visits = unfinished;
}
