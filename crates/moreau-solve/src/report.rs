//! What a solve says of itself, measured by [`crate::residual`] and never by the solver.

use crate::Residual;

/// How a solve ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Status {
    /// The criterion is at most the tolerance.
    #[default]
    Converged,
    /// The limit of sweeps was reached first.
    MaxSweeps,
    /// A velocity or an impulse is not a finite number.
    NotFinite,
}

/// The residuals after one sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HistoryRow {
    /// How many sweeps were done.
    pub sweep: u64,
    /// What was measured after it.
    pub residual: Residual,
}

/// The outcome of a solve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// How it ended.
    pub status: Status,
    /// How many sweeps were done.
    pub sweeps: u64,
    /// Measured at the end, from the impulses alone.
    pub residual: Residual,
    /// Visits of the last sweep in which the local solver did not reach its own end.
    pub unfinished_visits: u64,
    /// Measured after each sweep, if asked for.
    pub history: Vec<HistoryRow>,
}
