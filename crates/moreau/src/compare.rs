//! The paper's comparison (section 5): one scene, one start, several solvers.

use crate::run::{End, Task, Unwritten, run};
use crate::space::Space;
use crate::step::{StepRecord, Workspace, step_until};
use crate::world::{OnFailure, World};
use moreau_solve::{GlobalMethod, HistoryRow, Kernels, LocalMethod};
use std::sync::atomic::AtomicBool;

/// One pair of methods.
pub type Methods = (GlobalMethod, LocalMethod);

/// What one pair of methods did.
#[derive(Clone, Debug)]
pub struct Row {
    /// The methods.
    pub methods: Methods,
    /// How the run ended.
    pub end: End,
    /// Steps done.
    pub steps: u64,
    /// Steps whose solve did not meet its criterion.
    pub unconverged: u64,
    /// Mean number of sweeps a step.
    pub sweeps: f64,
    /// Seconds of the whole run, least of the repetitions.
    pub seconds_total: f64,
    /// Seconds for contact impulses, in the same repetition.
    pub seconds_solve: f64,
    /// Residual after each sweep of the chosen step.
    pub history: Vec<HistoryRow>,
    /// Greatest difference of a body's velocity from the exact local solver's after the chosen step, taken from the same state by
    /// both; relative to the greatest velocity, or to what the step's free motion gives where all is at rest.
    pub disagreement: f64,
}

/// The chosen step in which solvers are compared sweep by sweep, with the state before it.
pub struct Probe<S: Space<D, N>, const D: usize, const N: usize> {
    before: World<S, D, N>,
    after: World<S, D, N>,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Probe<S, D, N> {
    /// Advances a copy of `start` to just before step number `number` (from 1) with its own solver. The step itself is taken with the
    /// exact local solver to `tolerance`, as by those who are compared: much tighter than that of the run, so that what differs
    /// is the methods and not where they stopped.
    ///
    /// Returns `None` if the run fails on its way.
    ///
    /// # Errors
    /// None of its own; the type is that of [`run`].
    pub fn new(start: &World<S, D, N>, number: u64, tolerance: f64, stop: &AtomicBool) -> Result<Option<Self>, Box<Unwritten>> {
        let mut before = start.clone();
        let outcome = run(&mut before, &mut Workspace::default(), Task::new(number.saturating_sub(1)), &mut [], stop, |_| {})?;
        let settings = &mut before.settings;
        (settings.solver.tolerance, settings.on_failure) = (tolerance, OnFailure::Warn);
        settings.solver.max_sweeps = settings.solver.max_sweeps.saturating_mul(10).min(2_000_000);
        let mut after = before.clone();
        after.settings.solver.local = LocalMethod::Exact;
        let arrived = outcome.end == End::Done
            && step_until(&mut after, &mut Workspace::default(), stop).is_ok_and(|record| record.converged());
        Ok(arrived.then_some(Self { before, after }))
    }

    /// Takes the step with `methods`: residuals by sweep, and the greatest relative difference in velocity; infinite where the step
    /// fails or does not converge.
    pub fn take(&self, methods: Methods, stop: &AtomicBool) -> (Vec<HistoryRow>, f64) {
        let mut world = self.before.clone();
        let solver = &mut world.settings.solver;
        (solver.global, solver.local, solver.history) = (methods.0, methods.1, true);
        solver.kernels = Kernels::Plain;
        let mut work = Workspace::default();
        let converged = step_until(&mut world, &mut work, stop).is_ok_and(|record| record.converged());
        let difference = if converged { disagreement(&self.after, &world) } else { f64::INFINITY };
        (std::mem::take(&mut work.history), difference)
    }
}

/// max |v − v'| / max |v| over all bodies, velocities of surface points: spins count by the radius. The scale is at least what
/// gravity and loads would do in one step.
pub fn disagreement<S: Space<D, N>, const D: usize, const N: usize>(a: &World<S, D, N>, b: &World<S, D, N>) -> f64 {
    use crate::shape::Shape;
    let speed = |v: &[f64; N], radius: f64| {
        let weight = |k: usize| if k < D { 1.0 } else { radius };
        (0..N).map(|k| (weight(k) * v[k]).powi(2)).sum::<f64>().sqrt()
    };
    let (mut difference, mut scale) = (0.0_f64, 0.0_f64);
    for i in 0..a.bodies.len() {
        let radius = a.bodies.shape[i].bounding_radius().unwrap_or(0.0);
        let (v, w) = (&a.bodies.velocity[i], &b.bodies.velocity[i]);
        difference = difference.max(speed(&std::array::from_fn(|k| v[k] - w[k]), radius));
        // What the loads would do in one step: the scale of a system at rest.
        let pushed = std::array::from_fn(|k| {
            let gravity = if k < D && a.bodies.is_free(i) { a.gravity[k] } else { 0.0 };
            a.settings.h * (gravity + a.bodies.inverse_mass[i][k] * a.bodies.load[i][k])
        });
        scale = scale.max(speed(v, radius)).max(speed(&pushed, radius));
    }
    if difference == 0.0 { 0.0 } else { difference / scale }
}

/// Runs a copy of `start` for `steps` steps with `methods`, `repeat` times; the fastest counts.
///
/// # Errors
/// None of its own; the type is that of [`run`].
pub fn compare_one<S: Space<D, N>, const D: usize, const N: usize>(
    start: &World<S, D, N>,
    probe: Option<&Probe<S, D, N>>,
    methods: Methods,
    (steps, repeat): (u64, usize),
    stop: &AtomicBool,
    mut progress: impl FnMut(&StepRecord),
) -> Result<Row, Box<Unwritten>> {
    let (mut history, disagreement) = probe.map_or((Vec::new(), f64::NAN), |probe| probe.take(methods, stop));
    let mut once = || -> Result<Row, Box<Unwritten>> {
        let mut world = start.clone();
        let solver = &mut world.settings.solver;
        (solver.global, solver.local, solver.kernels) = (methods.0, methods.1, Kernels::Plain);
        if world.settings.on_failure == OnFailure::Dump {
            // Nobody writes the problems of a comparison, and to keep them would count as time of the solver.
            world.settings.on_failure = OnFailure::Warn;
        }
        let outcome = run(&mut world, &mut Workspace::default(), Task::new(steps), &mut [], stop, &mut progress)?;
        Ok(Row {
            methods,
            end: outcome.end,
            steps: outcome.summary.steps(),
            unconverged: outcome.summary.unconverged(),
            sweeps: outcome.summary.sweeps_mean(),
            seconds_total: outcome.summary.seconds_total(),
            seconds_solve: outcome.summary.seconds_solve(),
            history: Vec::new(),
            disagreement,
        })
    };
    let mut best = once()?;
    for _ in 1..repeat {
        let row = once()?;
        match row.end {
            End::Done if row.seconds_total < best.seconds_total => best = row,
            End::Done => {}
            _ => break,
        }
    }
    best.history.append(&mut history);
    Ok(best)
}
