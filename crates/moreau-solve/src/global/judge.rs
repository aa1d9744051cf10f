//! When a solve ends: it is measured here, by [`crate::residual`], and the method that runs only asks whether to go on.
//!
//! [`Residual::certifies`] is the only rule by which a solve has converged, and this is the only place that applies it.

use super::best::Best;
use crate::block::Vector;
use crate::report::{HistoryRow, Status};
use crate::residual::{criterion, measure};
use crate::{Operator, Problem, Residual, Settings};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Watches one solve.
pub(crate) struct Judge<'a, O: Operator<D>, const D: usize> {
    problem: &'a Problem<'a, O, D>,
    settings: &'a Settings,
    deadline: Option<Instant>,
    stop: &'a AtomicBool,
    /// Sweeps or steps done so far, by all methods of this solve.
    pub sweeps: u64,
    /// The number of sweeps at which the method at work has to hand over.
    pub limit: u64,
    /// The criterion when it was last measured, and after how many sweeps that was.
    pub error: f64,
    pub measured_at: u64,
    pub history: Vec<HistoryRow>,
    /// Visits of the last sweep in which the local solver did not reach its own end.
    pub unfinished_visits: u64,
    /// What was measured of a state made again from the impulses, after the sweep `measured_at`.
    pub certificate: Option<Residual>,
    /// The best impulses that were measured.
    pub best: Best<D>,
    next_check: u64,
    skip_to: u64,
    /// Whether the solve ended after a sweep that was not measured: the best impulses are the answer.
    pub unseen: bool,
}

impl<'a, O: Operator<D>, const D: usize> Judge<'a, O, D> {
    /// `best` is memory of an earlier solve.
    pub(crate) fn new(problem: &'a Problem<'a, O, D>, settings: &'a Settings, stop: &'a AtomicBool, mut best: Best<D>) -> Self {
        best.forget();
        // A limit beyond what a clock can hold is none.
        let deadline = settings.max_seconds.and_then(|s| Instant::now().checked_add(Duration::try_from_secs_f64(s).ok()?));
        let (sweeps, limit) = (0, settings.max_sweeps);
        Self {
            problem,
            settings,
            deadline,
            stop,
            sweeps,
            limit,
            error: f64::INFINITY,
            measured_at: 0,
            history: Vec::new(),
            unfinished_visits: 0,
            certificate: None,
            best,
            next_check: 1,
            skip_to: 0,
            unseen: false,
        }
    }

    /// After a sweep that left the impulses `r`, for which `state` stands: how the method ends, if it does.
    ///
    /// Every one of the first twenty sweeps is measured and then every sixteenth part of those done, but not where
    /// none can be expected to end the solve: a measure costs what a sweep costs. The last one is measured where another method follows it. At the
    /// limit of the whole solve it is not: what counts are then the same sweeps as under any higher limit, so a higher limit never gives a worse answer.
    pub(crate) fn after_sweep(&mut self, state: &mut O::State, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) -> Option<Status> {
        self.sweeps += 1;
        let is_end = self.sweeps >= self.settings.max_sweeps && self.best.error.is_finite();
        let last = self.sweeps >= self.limit && !is_end || self.is_over();
        let due = self.sweeps >= self.next_check;
        if due {
            self.next_check = self.sweeps + if self.sweeps < 20 { 1 } else { self.sweeps / 16 };
        }
        let worthwhile = self.settings.history || last || due && self.sweeps >= self.skip_to;
        if worthwhile {
            return self.measured(state, r, claimed);
        }
        self.unseen = is_end;
        is_end.then_some(Status::MaxSweeps)
    }

    /// The same after a step that is worth measuring each time.
    pub(crate) fn after_step(&mut self, state: &mut O::State, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) -> Option<Status> {
        self.sweeps += 1;
        self.measured(state, r, claimed)
    }

    fn measured(&mut self, state: &mut O::State, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) -> Option<Status> {
        let before = self.error;
        self.record(state, r, claimed);
        self.error = self.weigh(state, r, claimed);
        self.skip_to = self.sweeps + self.hopeless(before);
        self.measured_at = self.sweeps;
        if self.error <= self.settings.tolerance && self.confirmed(state, r, claimed) {
            return Some(Status::Converged);
        }
        self.unmet(r, claimed)
    }

    /// Makes `state` again from the impulses and measures that: how the method ends, if it does.
    pub(crate) fn certify(&mut self, state: &mut O::State, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) -> Option<Status> {
        let met = self.confirmed(state, r, claimed);
        self.measured_at = self.sweeps;
        if met { Some(Status::Converged) } else { self.unmet(r, claimed) }
    }

    /// Measures impulses that are not where the method stands, and keeps them if they are the best.
    pub(crate) fn consider(&mut self, state: &mut O::State, r: &[Vector<D>]) {
        self.problem.operator.start(r, state);
        self.best.see(self.weigh(state, r, None), r, None);
    }

    fn record(&mut self, state: &O::State, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) {
        if self.settings.history {
            self.note(measure(self.problem, state, r, claimed));
        }
    }

    /// Writes the row of this sweep; what was measured later of the same sweep takes its place.
    fn note(&mut self, residual: Residual) {
        let row = HistoryRow { sweep: self.sweeps, residual };
        match self.history.last_mut().filter(|last| last.sweep == row.sweep) {
            Some(last) => *last = row,
            None => self.history.push(row),
        }
    }

    /// How the method ends although the answer does not count. If the solve goes on its best impulses are kept.
    fn unmet(&mut self, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) -> Option<Status> {
        let status = match () {
            () if !self.error.is_finite() => Some(Status::NotFinite),
            () if self.is_stopped() => Some(Status::Interrupted),
            () if self.sweeps >= self.limit => Some(Status::MaxSweeps),
            () if self.is_late() => Some(Status::OutOfTime),
            () => None,
        };
        if status.is_none() || self.sweeps < self.settings.max_sweeps {
            self.best.see(self.error, r, claimed);
        }
        status
    }

    /// Whether the solve ends however good it is: it was asked to stop, or the clock has run out. Asked after each sweep, for those of a large
    /// problem that are measured may be minutes apart.
    pub(crate) fn is_over(&self) -> bool {
        self.is_stopped() || self.is_late()
    }

    fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn is_late(&self) -> bool {
        self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// For how many sweeps a measure cannot but say no: a quarter of those that the fall since the last one, `before`,
    /// lets expect, but no more than an eighth of those done: some methods fall ever faster.
    fn hopeless(&self, before: f64) -> u64 {
        let fall = libm::log(before / self.error) / (self.sweeps - self.measured_at).max(1) as f64;
        let expected = libm::log(self.error / self.settings.tolerance) / fall;
        // A fall from what was never measured is infinite, and expects nothing.
        if fall > 0.0 && expected > 0.0 { (0.25 * expected).min(0.125 * self.sweeps as f64) as u64 } else { 0 }
    }

    /// The criterion at `r`, for which `state` stands.
    pub(crate) fn weigh(&self, state: &O::State, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) -> f64 {
        criterion(self.problem, state, r, claimed, self.settings.criterion)
    }

    /// A state has gathered the rounding of every visit: the verdict is on the impulses alone.
    fn confirmed(&mut self, state: &mut O::State, r: &[Vector<D>], claimed: Option<&[Vector<D>]>) -> bool {
        let Settings { criterion, tolerance, history, .. } = *self.settings;
        self.problem.operator.start(r, state);
        let residual = measure(self.problem, state, r, claimed);
        // Where another measure is not finite the answer cannot be judged.
        self.error = if residual.is_finite() { residual.of(criterion) } else { f64::NAN };
        self.certificate = Some(residual);
        if history {
            self.note(residual);
        }
        residual.certifies(criterion, tolerance)
    }

    /// What the last certificate lacks: the criterion, or where that is met the error in the law, on the scale of the tolerance.
    pub(crate) fn hurdle(&self) -> f64 {
        let Settings { criterion, tolerance, .. } = *self.settings;
        let refused = self.certificate.filter(|_| self.error <= tolerance);
        refused.map_or(self.error, |residual| residual.hurdle(criterion, tolerance))
    }
}
