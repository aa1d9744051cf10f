//! NLGS and its accelerated form over packed contacts: [`super::super::nlgs`] and [`super::super::accelerated`], with the same rules.
//!
//! A sweep says how much it changed, and how much the criterion is of that is known from when it was last looked at. So the
//! criterion is looked at where it is due to be met, now and then besides, and an answer counts when it has been certified: from the
//! impulses alone, by the operator's own visits and the common measure, which know nothing of packing.

use super::fill::suits;
use super::kernel::Kernel;
use super::{Balls, Packing};
use crate::global::Work;
use crate::global::accelerated::{FIRST_PATIENCE, Momentum};
use crate::{Criterion, GlobalMethod, Kernels, LocalMethod, Operator, Order, Parameter, Settings, Status};

/// Solves, if contacts, laws and settings are such as can be packed.
pub(in crate::global) fn run<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>, method: GlobalMethod) -> Option<Status> {
    let balls = work.problem.operator.balls().filter(|balls| allowed(&work.settings) && suits(work.problem, balls))?;
    let accelerated = method == GlobalMethod::Accelerated;
    let mut packings = std::mem::take(&mut work.scratch.packings);
    let status = if D == 1 {
        Drive::new(work, balls, &mut packings.central).run(accelerated)
    } else {
        Drive::new(work, balls, &mut packings.round).run(accelerated)
    };
    work.scratch.packings = packings;
    Some(status)
}

/// Whether kernels do what the settings ask for: PDAS as it chooses its own γ, by colour, without over-relaxation.
fn allowed(settings: &Settings) -> bool {
    settings.kernels != Kernels::Plain
        && settings.local == LocalMethod::Pdas
        && settings.gamma == Parameter::Auto
        && settings.order == Order::Coloured
        && settings.relaxation == 1.0
        && !settings.symmetric
}

/// Below this multiple of the tolerance a criterion that sweeps do not measure is certified at each look.
const NEAR: f64 = 10.0;

/// One solve.
struct Drive<'a, 'b, 'c, O: Operator<D>, K: Kernel<B, C>, const D: usize, const B: usize, const C: usize> {
    work: &'a mut Work<'b, O, D>,
    balls: &'c Balls<D>,
    packing: &'a mut Packing<K, B, C>,
    /// After how many sweeps the criterion is looked at whatever is expected.
    next_look: u64,
    /// After how many the last certificate was made.
    certified_at: u64,
    best: f64,
    gained_at: u64,
    patience: u64,
    /// How many plain sweeps are still to come before momentum is tried again.
    plain: u64,
}

impl<'a, 'b, 'c, O: Operator<D>, K: Kernel<B, C>, const D: usize, const B: usize, const C: usize>
    Drive<'a, 'b, 'c, O, K, D, B, C>
{
    fn new(work: &'a mut Work<'b, O, D>, balls: &'c Balls<D>, packing: &'a mut Packing<K, B, C>) -> Self {
        packing.kernels = work.settings.kernels;
        packing.fill(work.problem, balls, work.r);
        packing.deposit();
        work.scratch.claimed.clear();
        work.scratch.claimed.resize(work.r.len(), [0.0; D]);
        let (next_look, best) = (work.judge.sweeps + 1, f64::INFINITY);
        Self { work, balls, packing, next_look, certified_at: 0, best, gained_at: 0, patience: FIRST_PATIENCE, plain: 0 }
    }

    fn run(mut self, accelerated: bool) -> Status {
        let (mut momentum, mut beta, mut change) = (Momentum::default(), 0.0, f64::INFINITY);
        loop {
            let looks = self.looks(change);
            let sums = self.packing.sweep(beta, looks);
            change = sums[0].sqrt();
            self.work.judge.sweeps += 1;
            if looks && let Some(status) = self.look(change) {
                return status;
            }
            beta = 0.0;
            if !accelerated {
                continue;
            }
            self.plain = self.plain.saturating_sub(1);
            if self.plain == 0 && self.fails() {
                self.restore();
                momentum = Momentum::default();
            } else if self.plain == 0 {
                beta = momentum.after(change, sums[1].sqrt(), sums[2]);
            }
        }
    }

    /// Whether the criterion is looked at after the next sweep, the last one having changed as much as `change`.
    fn looks(&self, change: f64) -> bool {
        let judge = &self.work.judge;
        let sweep = judge.sweeps + 1;
        let expected = self.packing.ratio * change;
        let settings = &self.work.settings;
        expected <= settings.tolerance || sweep >= self.next_look.min(judge.limit) || settings.history || judge.is_over()
    }

    /// Looks at the criterion after a sweep; certifies the answer where it ends the solve.
    fn look(&mut self, change: f64) -> Option<Status> {
        let settings = self.work.settings;
        let [sum, squares] = self.packing.watch();
        let exact = settings.criterion == Criterion::EpsGlob;
        // The other three parts of ε_glob vanish for visits that obey the law; for another criterion the last certificate tells.
        let seen = if exact { sum / self.work.r.len() as f64 } else { squares.sqrt() };
        let sweeps = self.work.judge.sweeps;
        self.next_look = sweeps + (sweeps / 4).max(4);
        let mut error = if exact { seen } else { self.packing.scale * seen };
        let ends =
            error <= settings.tolerance || !error.is_finite() || sweeps >= self.work.judge.limit || self.work.judge.is_over();
        // What the last certificate tells of another criterion is true to some factor, and less so the older it is.
        let stale = !exact && (error <= NEAR * settings.tolerance || sweeps >= 2 * self.certified_at);
        if ends || stale || settings.history || self.packing.scale == 0.0 {
            let Work { r, scratch, judge, .. } = &mut *self.work;
            self.certified_at = sweeps;
            self.packing.read(self.balls, r, &mut scratch.claimed);
            if let Some(status) = judge.certify(&mut scratch.state, r, Some(&scratch.claimed)) {
                if status != Status::Converged {
                    self.offer_best();
                }
                return Some(status);
            }
            error = judge.error;
            // Where the criterion is met and the law is not, it is the law that the sweeps are to end by.
            let hurdle = judge.hurdle();
            self.packing.scale = hurdle / seen;
            self.packing.ratio = hurdle / change;
        } else {
            self.packing.ratio = error / change;
        }
        if error < self.best {
            (self.best, self.gained_at) = (error, sweeps);
            self.packing.best.clone_from(&self.packing.z);
        }
        None
    }

    /// Whether momentum has not gained for too long.
    fn fails(&self) -> bool {
        let sweeps = self.work.judge.sweeps;
        sweeps - self.gained_at >= self.patience.max(sweeps / 3)
    }

    /// Lets the judge measure the best impulses, if they seem better than what it has. The last ones stay in place.
    fn offer_best(&mut self) {
        let Work { r, scratch, judge, .. } = &mut *self.work;
        if self.best < judge.best.error && (judge.error.is_nan() || self.best < judge.error) {
            self.packing.read_impulses(self.balls, &self.packing.best, r);
            judge.consider(&mut scratch.state, r);
            self.packing.read_impulses(self.balls, &self.packing.z, r);
        }
    }

    /// Back to the best impulses, for some plain sweeps.
    fn restore(&mut self) {
        self.offer_best();
        self.packing.z.clone_from(&self.packing.best);
        self.packing.before.clone_from(&self.packing.best);
        self.packing.bodies(self.balls);
        self.packing.deposit();
        self.plain = 2 * self.patience;
        self.patience *= 2;
        self.best = f64::INFINITY;
        self.gained_at = self.work.judge.sweeps + self.plain;
    }
}
