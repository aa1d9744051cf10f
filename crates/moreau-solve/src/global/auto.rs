//! Chooses the method by what it sees of the problem and of the residual, and says what it did in the report's stages.
//!
//! ```text
//! repeat until the criterion is met, each time with twice as many sweeps:
//!   accelerated sweeps, at first 100 and a quarter of the unknowns, at most 400; more while they promise to end soon
//!   steps of the active set method, if the factors are not too large
//!   once: the active set method from the first guess, with its few sweeps between the steps
//!   from the third time on, the sweeps are in a shuffled order and with the exact local solver
//! ```
//!
//! Where contacts are many more than the motion of the bodies can tell apart, as of blocks that stand on faces, their impulses are not unique and the
//! active set method has no matrix to invert; W + ϱ D, through the bodies, is small:
//!
//! ```text
//! three times, until the criterion is met:
//!   accelerated sweeps: 20, 40, 80
//!   60 steps of ADMM, which end a structure that stands but hardly one that slides
//! the stages above where there are few unknowns, else accelerated sweeps
//! ```
//!
//! Sweeps are by far the cheapest and end most problems; a step costs some fifty of them and ends those on which they crawl. Where both
//! stall, another start or another order of the contacts is another method: solutions are the same, the paths to them are not.

use super::{Work, active_set, admm};
use crate::report::Stage;
use crate::{GlobalMethod, LocalMethod, Operator, Order, Status};

/// Sweeps before the first step, however large the problem is.
const MOST_FIRST_SWEEPS: u64 = 400;

/// Sweeps before each turn of ADMM where impulses are far from unique, and its steps.
const INDETERMINATE: [u64; 3] = [20, 40, 80];
const STEPS: u64 = 60;
/// Up to so many unknowns what ADMM does not end is left to the other stages: ratios of masses, which they bear better. Of larger problems of this kind
/// each step of the active set method takes tenths of a second, and many.
const SMALL: usize = 600;

/// Stages until the judge says stop.
pub(super) fn run<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Status {
    if admm::suits(work.problem) { indeterminate(work) } else { determinate(work) }
}

/// The turns of sweeps and ADMM, and what follows where they do not end.
fn indeterminate<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Status {
    let turns = INDETERMINATE.iter().flat_map(|&sweeps| [(GlobalMethod::Accelerated, sweeps), (GlobalMethod::Admm, STEPS)]);
    for (method, budget) in turns {
        let end = stage(work, method, |work| limited(work, method, budget));
        // Where factors are too large or fail, sweeps go on.
        if let Some(status) = end.filter(|status| !matches!(status, Status::Unsuited | Status::Stalled)) {
            return status;
        }
    }
    work.go_back();
    if work.problem.len() * D <= SMALL {
        return determinate(work);
    }
    let end = stage(work, GlobalMethod::Accelerated, |work| Some(work.run(GlobalMethod::Accelerated)));
    end.unwrap_or(Status::Stalled)
}

fn determinate<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Status {
    let unknowns = work.problem.len() * D;
    let given = work.settings;
    let mut budget = (100 + unknowns as u64 / 4).min(MOST_FIRST_SWEEPS);
    let first = work.r.to_vec();
    let mut stored = None;
    for round in 0_u64.. {
        if round >= 2 {
            work.settings = crate::Settings { order: Order::Shuffled(round), local: LocalMethod::Exact, ..given };
        }
        let mut end = sweeps(work, budget);
        if end.is_none() && unknowns <= active_set::LARGEST {
            let stored = stored.get_or_insert_with(|| work.problem.operator.stored().into_owned());
            end = stage(work, GlobalMethod::ActiveSet, |work| active_set::steps(work, stored));
        }
        if end.is_none() && round == 0 && unknowns <= active_set::LARGEST {
            work.r.copy_from_slice(&first);
            end = stage(work, GlobalMethod::ActiveSet, |work| limited(work, GlobalMethod::ActiveSet, 4 * budget));
            if end.is_none() {
                work.go_back();
            }
        }
        if let Some(status) = end {
            return status;
        }
        budget *= 2;
    }
    Status::Stalled
}

/// Accelerated sweeps, `budget` of them and again as many while they promise to end soon.
fn sweeps<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>, budget: u64) -> Option<Status> {
    stage(work, GlobalMethod::Accelerated, |work| {
        let mut before = work.judge.error;
        loop {
            if let Some(status) = limited(work, GlobalMethod::Accelerated, budget) {
                return Some(status);
            }
            let (fallen, to_fall) = (libm::log(before / work.judge.error), libm::log(work.judge.error / work.settings.tolerance));
            // Of the first sweeps it is not known whence they fell.
            let soon = before.is_finite() && 2.0 * fallen >= to_fall;
            if !soon {
                return None;
            }
            before = work.judge.error;
        }
    })
}

/// At most `budget` sweeps or steps of one method; how they ended the solve, if they did.
fn limited<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>, method: GlobalMethod, budget: u64) -> Option<Status> {
    let limit = work.judge.limit;
    work.judge.limit = limit.min(work.judge.sweeps + budget);
    let status = work.run(method);
    work.judge.limit = limit;
    (status != Status::MaxSweeps || work.judge.sweeps >= limit).then_some(status)
}

/// Runs one method and notes what it did.
fn stage<'a, O: Operator<D>, const D: usize>(
    work: &mut Work<'a, O, D>,
    method: GlobalMethod,
    run: impl FnOnce(&mut Work<'a, O, D>) -> Option<Status>,
) -> Option<Status> {
    let before = work.judge.sweeps;
    let end = run(work);
    let (sweeps, error) = (work.judge.sweeps - before, work.judge.error);
    work.stages.push(Stage { method, sweeps, error, status: end.unwrap_or(Status::Stalled) });
    end
}
