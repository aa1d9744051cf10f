//! Global solvers: all contacts together.

mod accelerated;
mod active_set;
mod admm;
mod apgd;
mod auto;
mod best;
mod cpg;
pub(crate) mod judge;
mod lemke;
mod mixing;
mod nlgs;
mod packed;
mod steps;
mod sweep;

use crate::block::Vector;
use crate::local::{LocalSolver, WithLocal, with_local};
use crate::report::Stage;
use crate::residual::measure;
use crate::{Operator, Problem, Report, Residual, Row, Settings, Status};
use best::settle;
use judge::Judge;
use std::sync::atomic::AtomicBool;

/// The methods by name. Adding one is a file, a variant with its row in [`GLOBAL_METHODS`], and an arm of `Work::run`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum GlobalMethod {
    /// Nonlinear Gauss-Seidel.
    Nlgs,
    /// Nonlinear Gauss-Seidel with momentum.
    #[default]
    Accelerated,
    /// Global primal-dual active set.
    ActiveSet,
    /// Conjugate projected gradients.
    Cpg,
    /// Accelerated projected gradient descent.
    Apgd,
    /// The alternating direction method of multipliers.
    Admm,
    /// Pivoting: Lemke's method.
    Lemke,
    /// Whatever the problem asks for.
    Auto,
}

/// The table of global solvers.
pub const GLOBAL_METHODS: &[(GlobalMethod, Row)] = &[
    (GlobalMethod::Nlgs, Row { name: "nlgs", about: "nonlinear Gauss-Seidel: contact by contact until all agree" }),
    (GlobalMethod::Accelerated, Row { name: "accelerated", about: "NLGS with Nesterov's momentum, restarts and a safeguard" }),
    (
        GlobalMethod::ActiveSet,
        Row { name: "active_set", about: "Newton on all contacts at once, after sweeps: for tight tolerances" },
    ),
    (GlobalMethod::Cpg, Row { name: "cpg", about: "conjugate projected gradients: products with W only" }),
    (GlobalMethod::Apgd, Row { name: "apgd", about: "projected gradients with Nesterov's momentum: products with W only" }),
    (
        GlobalMethod::Admm,
        Row {
            name: "admm",
            about: "splitting: W is factorised once, through the bodies where they are fewer, a step solves with it and projects",
        },
    ),
    (
        GlobalMethod::Lemke,
        Row { name: "lemke", about: "exact pivoting: small problems without friction or with it in the plane" },
    ),
    (
        GlobalMethod::Auto,
        Row { name: "auto", about: "accelerated, then active_set or, for blocks that stand on faces, admm; says what it did" },
    ),
];

impl GlobalMethod {
    /// Its name in [`GLOBAL_METHODS`].
    pub fn name(self) -> &'static str {
        GLOBAL_METHODS.iter().find(|(method, _)| *method == self).map_or("", |(_, row)| row.name)
    }

    /// The method of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        GLOBAL_METHODS.iter().find(|(_, row)| row.name == name).map(|&(method, _)| method)
    }
}

/// Memory that solves share, so that a solve of a size seen before allocates next to nothing.
#[derive(Clone, Debug, Default)]
pub struct Scratch<State, const D: usize> {
    pub(crate) state: State,
    pub(crate) claimed: Vec<Vector<D>>,
    pub(crate) order: Vec<u32>,
    /// Of methods with momentum: the impulses from which a sweep starts and those where the last one ended, with its state.
    pub(crate) from: Vec<Vector<D>>,
    pub(crate) previous: Vec<Vector<D>>,
    pub(crate) earlier: State,
    pub(crate) spare: State,
    pub(crate) mixing: mixing::Mixing,
    /// The impulses to which a method goes back where its steps lead astray.
    pub(crate) best: Vec<Vector<D>>,
    /// The best impulses of the solve.
    pub(crate) kept: best::Best<D>,
    pub(crate) packings: packed::Packings,
}

impl<State, const D: usize> Scratch<State, D> {
    /// The operator's state at the end of the last solve: what the final impulses do.
    pub fn state(&self) -> &State {
        &self.state
    }
}

/// A solve at work: what every global method reads and writes.
pub(crate) struct Work<'a, O: Operator<D>, const D: usize> {
    pub problem: &'a Problem<'a, O, D>,
    pub settings: Settings,
    /// The impulses: the first guess, and then the answer.
    pub r: &'a mut [Vector<D>],
    pub scratch: &'a mut Scratch<O::State, D>,
    pub judge: Judge<'a, O, D>,
    /// What was done before the method that now runs.
    pub stages: Vec<Stage>,
}

impl<O: Operator<D>, const D: usize> Work<'_, O, D> {
    /// Runs one method from the impulses of now.
    fn run(&mut self, method: GlobalMethod) -> Status {
        // What another method has claimed is not what this one claims.
        self.scratch.claimed.clear();
        match method {
            GlobalMethod::Auto => auto::run(self),
            GlobalMethod::Cpg => cpg::run(self),
            GlobalMethod::Apgd => apgd::run(self),
            GlobalMethod::Admm => admm::run(self),
            GlobalMethod::Lemke => lemke::run(self),
            GlobalMethod::Nlgs | GlobalMethod::Accelerated => packed::run(self, method).unwrap_or_else(|| self.sweep(method)),
            GlobalMethod::ActiveSet => self.sweep(method),
        }
    }

    /// Runs a method that sweeps, with its local solver.
    fn sweep(&mut self, method: GlobalMethod) -> Status {
        with_local(self.settings, Sweeping { work: self, method })
    }

    /// Makes ready for sweeps from the impulses of now with the local solver `L`.
    fn begin<L: LocalSolver>(&mut self) {
        let n = self.problem.len();
        self.settings.order.fill(self.problem.operator, n, &mut self.scratch.order);
        self.scratch.claimed.clear();
        self.scratch.claimed.resize(if L::CLAIMS { n } else { 0 }, [0.0; D]);
        self.problem.operator.start(self.r, &mut self.scratch.state);
    }

    /// Goes back to the best impulses of the solve, if any were measured.
    fn go_back(&mut self) {
        if self.judge.best.error.is_finite() {
            self.r.copy_from_slice(&self.judge.best.impulses);
            self.scratch.claimed.clear();
        }
    }

    /// Asks the judge after a step of a method that claims no velocities; `state` of the scratch must stand for the impulses.
    fn after_step(&mut self) -> Option<Status> {
        self.judge.after_step(&mut self.scratch.state, self.r, None)
    }

    /// Asks the judge about the impulses alone.
    fn certify(&mut self) -> Option<Status> {
        self.judge.certify(&mut self.scratch.state, self.r, None)
    }

    /// Asks the judge after a sweep.
    fn after_sweep(&mut self) -> Option<Status> {
        let claimed = claims(&self.scratch.claimed);
        self.judge.after_sweep(&mut self.scratch.state, self.r, claimed)
    }
}

/// kept ← r.
fn keep<const D: usize>(kept: &mut Vec<Vector<D>>, r: &[Vector<D>]) {
    kept.clear();
    kept.extend_from_slice(r);
}

/// The claimed velocities, of methods that claim any.
fn claims<const D: usize>(claimed: &[Vector<D>]) -> Option<&[Vector<D>]> {
    if claimed.is_empty() { None } else { Some(claimed) }
}

/// A method that sweeps, waiting for its local solver.
struct Sweeping<'a, 'b, O: Operator<D>, const D: usize> {
    work: &'a mut Work<'b, O, D>,
    method: GlobalMethod,
}

impl<O: Operator<D>, const D: usize> WithLocal for Sweeping<'_, '_, O, D> {
    type Output = Status;

    fn run<L: LocalSolver>(self, local: L) -> Status {
        match self.method {
            GlobalMethod::Accelerated => accelerated::run(self.work, local),
            GlobalMethod::ActiveSet => active_set::run(self.work, local),
            _ => nlgs::run(self.work, local),
        }
    }
}

/// Solves `problem` from the impulses in `r`, which it replaces: by the solution, or by the best impulses that were measured.
///
/// Not converging is a status, never an error: the caller owns the policy.
pub fn solve<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    settings: &Settings,
    r: &mut [Vector<D>],
    scratch: &mut Scratch<O::State, D>,
) -> Report {
    solve_until(problem, settings, &AtomicBool::new(false), r, scratch)
}

/// The same, until `stop` is set: then it ends after the sweep or step that is being done, as [`Status::Interrupted`], with the best impulses that were
/// measured.
pub fn solve_until<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    settings: &Settings,
    stop: &AtomicBool,
    r: &mut [Vector<D>],
    scratch: &mut Scratch<O::State, D>,
) -> Report {
    scratch.claimed.clear();
    let judge = Judge::new(problem, settings, stop, std::mem::take(&mut scratch.kept));
    let mut work = Work { problem, settings: *settings, r, scratch, judge, stages: Vec::new() };
    let status = if problem.is_empty() { work.certify().unwrap_or(Status::Stalled) } else { work.run(settings.global) };
    let Work { r, scratch, judge, mut stages, .. } = work;
    let Judge { sweeps, certificate, mut best, unfinished_visits, history, unseen, .. } = judge;
    // What ended the solve has measured all that there is to say.
    let certificate = certificate.filter(|_| status == Status::Converged);
    let residual = certificate.unwrap_or_else(|| settle(problem, settings, r, scratch, (&mut best, !unseen)));
    scratch.kept = best;
    if stages.is_empty() {
        stages.push(Stage { method: settings.global, sweeps, error: residual.of(settings.criterion), status });
    }
    Report { status, sweeps, stages, residual, unfinished_visits, history }
}

/// Measures the impulses `r` without changing them. The scratch then holds what they do, as after [`solve`].
pub fn certify<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    r: &[Vector<D>],
    scratch: &mut Scratch<O::State, D>,
) -> Residual {
    scratch.claimed.clear();
    problem.operator.start(r, &mut scratch.state);
    measure(problem, &scratch.state, r, None)
}
