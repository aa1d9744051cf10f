//! Problems of solves that failed, kept under the policy `dump` to be solved again outside of their scene.

use crate::world::StepSettings;
use moreau_solve::files::{FileError, Info, Iterate, ProblemFile, StoredProblem};
use moreau_solve::{Operator, Report};

/// How many problems of a run are kept: enough to see what is hard, few enough not to fill a disk.
pub const FAILED_KEPT: u64 = 20;

/// The problem of a step whose solve did not converge.
#[derive(Clone, Debug, PartialEq)]
pub struct FailedSolve {
    /// The number of the step.
    pub step: u64,
    /// Its problem, or why problem files have no place for it. The first guess is where the solve began, the second where it ended.
    pub problem: Result<ProblemFile, FileError>,
}

impl FailedSolve {
    /// The name of its file.
    pub fn file_name(&self) -> String {
        format!("failed-step-{}.hdf5", self.step)
    }
}

/// What a workspace keeps of failed solves.
#[derive(Default)]
pub(super) struct Failed {
    /// The impulses from which the solve at hand began.
    pub(super) start: Vec<f64>,
    /// How many problems were kept so far.
    pub(super) count: u64,
    /// The last one, until it is taken.
    pub(super) last: Option<FailedSolve>,
}

/// What a problem file says of the step that it comes from.
pub(super) fn info(step: u64, time: f64, settings: &StepSettings, report: &Report) -> Info {
    let (solver, residual) = (&settings.solver, &report.residual);
    let description = format!(
        "The solve of the step to t = {time:e} s by {} inside {} ended with {} after {} sweeps: {} = {:e}, wanted {:e}. Guess 1 is \
         where it began, guess 2 where it ended.",
        solver.local.name(),
        solver.global.name(),
        report.status.name(),
        report.sweeps,
        solver.criterion.name(),
        residual.of(solver.criterion),
        solver.tolerance,
    );
    Info { title: Some(format!("step {step}")), description: Some(description), math_info: None }
}

/// The problem with guesses of these impulses; those with a number that is not finite are left out.
pub(super) fn with_guesses<const D: usize>(stored: &StoredProblem<D>, impulses: [&[f64]; 2]) -> Result<ProblemFile, FileError> {
    let mut file = ProblemFile::from_stored(stored)?;
    let problem = stored.problem();
    for r in impulses.into_iter().filter(|r| r.iter().all(|x| x.is_finite())) {
        let mut state = Vec::new();
        stored.operator.start(r.as_chunks().0, &mut state);
        let u = (0..problem.len()).flat_map(|c| problem.velocity(&state, c)).collect();
        file.guesses.push(Iterate { r: r.to_vec(), u, v: None });
    }
    Ok(file)
}
