//! `steps.csv`: a row a step.

use super::table::Table;
use super::{Frame, Observer, OutputError};
use crate::checkpoint::Mark;
use crate::space::Space;
use crate::step::StepRecord;
use std::fmt::Write as _;
use std::path::Path;

/// The columns, in order.
pub const COLUMNS: [&str; 24] = [
    "step",
    "time",
    "bodies",
    "contacts",
    "active",
    "sweeps",
    "converged",
    "eps_motion",
    "eps_bipotential",
    "eps_penetration",
    "eps_glob",
    "scaled_residual",
    "penetration",
    "kinetic",
    "potential",
    "work",
    "dissipated",
    "impact",
    "friction",
    "balance_error",
    "seconds_detect",
    "seconds_localise",
    "seconds_solve",
    "seconds_step",
];

/// How many of the first columns are whole numbers, but for the time.
const WHOLE: usize = 7;
/// Where the seconds begin, of which few digits mean something.
const SECONDS: usize = 20;

/// The numbers of a row; whole numbers are below 2^53.
pub(crate) fn numbers(r: &StepRecord) -> [f64; COLUMNS.len()] {
    let (eps, energy, seconds) = (&r.residual.eps_glob, &r.energy, &r.seconds);
    [
        r.step as f64,
        r.time,
        r.bodies as f64,
        r.contacts as f64,
        r.active as f64,
        r.sweeps as f64,
        f64::from(u8::from(r.converged())),
        eps.motion,
        eps.bipotential,
        eps.penetration,
        eps.total(),
        r.residual.scaled,
        r.penetration,
        energy.kinetic,
        energy.potential,
        energy.work,
        energy.dissipated,
        energy.impact,
        energy.friction,
        energy.balance_error,
        seconds.detect,
        seconds.localise,
        seconds.solve,
        seconds.step,
    ]
}

/// Writes the records of a run.
#[derive(Debug)]
pub struct StepsCsv {
    table: Table,
}

impl StepsCsv {
    /// Creates the file with its header.
    ///
    /// # Errors
    /// Where it cannot be created.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        Ok(Self { table: Table::create(path, &COLUMNS.join(","))? })
    }

    /// Goes on with the file of a run that was stopped: rows after the mark are taken out.
    ///
    /// # Errors
    /// Where it cannot be written, or is not what the run left.
    pub fn resume(path: &Path, mark: &Mark) -> Result<Self, OutputError> {
        Ok(Self { table: Table::resume(path, mark)? })
    }
}

/// Puts one row in place of what is in `row`.
fn format(row: &mut String, r: &StepRecord) -> std::fmt::Result {
    row.clear();
    for (k, x) in numbers(r).into_iter().enumerate() {
        let comma = if k == 0 { "" } else { "," };
        match k {
            1 => write!(row, "{comma}{x:e}")?,
            0..WHOLE => write!(row, "{comma}{x}")?,
            WHOLE..SECONDS => write!(row, "{comma}{x:e}")?,
            _ => write!(row, "{comma}{x:.3e}")?,
        }
    }
    writeln!(row)
}

impl<S: Space<D, N>, const D: usize, const N: usize> Observer<S, D, N> for StepsCsv {
    fn see(&mut self, frame: &Frame<'_, S, D, N>) -> Result<(), OutputError> {
        let Some(record) = frame.record else { return Ok(()) };
        // A string takes all that is formatted.
        let _ = format(&mut self.table.row, record);
        self.table.put()
    }

    fn sync(&mut self) -> Result<Option<Mark>, OutputError> {
        self.table.sync().map(Some)
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        self.table.finish()
    }
}
