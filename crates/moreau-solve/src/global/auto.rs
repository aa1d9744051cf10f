//! Chooses the method by what it sees of the problem and of the residual, and says what it did in the report's stages.
//!
//! ```text
//! accelerated sweeps, 100 and a quarter of the unknowns, at most 400
//! repeat until the criterion is met:
//!   while the sweeps fall fast enough to end within twice as many: more of them
//!   steps of the active set method, if the factors are not too large
//!   twice as many accelerated sweeps; from the third round on in a shuffled order with the exact local solver
//! ```
//!
//! Sweeps are by far the cheapest and end most problems; a step costs some fifty of them and ends those on which they crawl. Where both
//! stall, another order of the contacts is another method: Gauss-Seidel's fixed points are the same, its paths are not.

use super::{Work, active_set, keep};
use crate::report::Stage;
use crate::{GlobalMethod, LocalMethod, Operator, Order, Status};

/// Sweeps before the first step, however large the problem is.
const MOST_FIRST_SWEEPS: u64 = 400;

/// Stages until the judge says stop; the best impulses of all are the answer.
pub(super) fn run<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Status {
    let unknowns = work.problem.len() * D;
    let given = work.settings;
    let mut budget = (100 + unknowns as u64 / 4).min(MOST_FIRST_SWEEPS);
    let mut stored = None;
    let (mut best, mut answer) = (f64::INFINITY, Vec::new());
    for round in 0_u64.. {
        if round >= 2 {
            work.settings = crate::Settings { order: Order::Shuffled(round), local: LocalMethod::Exact, ..given };
        }
        if let Some(status) = sweeps(work, budget) {
            return ended(work, status, best, &answer);
        }
        if unknowns <= active_set::LARGEST {
            let stored = stored.get_or_insert_with(|| work.problem.operator.stored().into_owned());
            if let Some(status) = stage(work, GlobalMethod::ActiveSet, |work| active_set::steps(work, stored)) {
                return ended(work, status, best, &answer);
            }
        }
        if work.judge.error < best || answer.is_empty() {
            best = work.judge.error;
            keep(&mut answer, work.r);
        }
        budget *= 2;
    }
    Status::Stalled
}

/// Accelerated sweeps, `budget` of them and again as many while they promise to end soon.
fn sweeps<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>, budget: u64) -> Option<Status> {
    stage(work, GlobalMethod::Accelerated, |work| {
        let limit = work.judge.limit;
        loop {
            let before = work.judge.error;
            work.judge.limit = limit.min(work.judge.sweeps + budget);
            let status = work.run(GlobalMethod::Accelerated);
            work.judge.limit = limit;
            if status != Status::MaxSweeps || work.judge.sweeps >= limit {
                return Some(status);
            }
            let now = work.judge.error;
            let (fallen, to_fall) = ((before / now).ln(), (now / work.settings.tolerance).ln());
            // Of the first sweeps it is not known whence they fell.
            if before.is_finite() && (fallen.is_nan() || 2.0 * fallen < to_fall) || before.is_infinite() {
                return None;
            }
        }
    })
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

/// The status, with the best impulses put in place where the last ones are not the answer.
fn ended<O: Operator<D>, const D: usize>(
    work: &mut Work<'_, O, D>,
    status: Status,
    best: f64,
    answer: &[crate::block::Vector<D>],
) -> Status {
    if status != Status::Converged && !answer.is_empty() && (work.judge.error.is_nan() || best < work.judge.error) {
        work.r.copy_from_slice(answer);
        work.scratch.claimed.clear();
    }
    status
}
