//! What a solve says of itself, measured by [`crate::residual`] and never by the solver.

use crate::{GlobalMethod, Residual};

/// How a solve ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Status {
    /// The criterion is at most the tolerance, and the law holds as computed from the impulses alone: see
    /// [`Residual::certifies`], the only rule for this status.
    #[default]
    Converged,
    /// The limit of sweeps was reached first.
    MaxSweeps,
    /// The limit of seconds was reached first.
    OutOfTime,
    /// It was asked to stop; see [`solve_until`](crate::solve_until).
    Interrupted,
    /// The method can do no more: a matrix that it cannot factorise, or steps that no longer lower the residual.
    Stalled,
    /// The method is not made for such a problem: too large for its dense matrix, or a law that it does not know.
    Unsuited,
    /// A velocity or an impulse is not a finite number.
    NotFinite,
}

impl Status {
    /// Its name in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Status::Converged => "converged",
            Status::MaxSweeps => "max_sweeps",
            Status::OutOfTime => "out_of_time",
            Status::Interrupted => "interrupted",
            Status::Stalled => "stalled",
            Status::Unsuited => "unsuited",
            Status::NotFinite => "not_finite",
        }
    }
}

/// The residuals after one sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HistoryRow {
    /// How many sweeps were done.
    pub sweep: u64,
    /// What was measured after it.
    pub residual: Residual,
}

/// What one method did within a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// The method.
    pub method: GlobalMethod,
    /// Its sweeps, or steps where it has none.
    pub sweeps: u64,
    /// The criterion when it ended; of the last stage of a solve that did not converge, the answer may be better: it is the best of all.
    pub error: f64,
    /// How it ended.
    pub status: Status,
}

/// The outcome of a solve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// How it ended.
    pub status: Status,
    /// How many sweeps were done, or steps of a method that has none.
    pub sweeps: u64,
    /// The methods that were at work, in turn: one, unless the method chooses among others.
    pub stages: Vec<Stage>,
    /// Measured at the end, from the impulses alone, of those that are the answer.
    pub residual: Residual,
    /// Visits of the last sweep in which the local solver did not reach its own end.
    pub unfinished_visits: u64,
    /// Measured after each sweep, if asked for.
    pub history: Vec<HistoryRow>,
}
