//! `steps.csv`: a row a step.

use super::table::Table;
use super::{Frame, Observer, OutputError};
use crate::space::Space;
use crate::step::StepRecord;
use std::fmt::Write as _;
use std::path::Path;

/// The columns, in order.
const HEADER: &str = "step,time,bodies,contacts,active,sweeps,converged,eps_motion,eps_bipotential,eps_penetration,eps_glob,\
                      scaled_residual,penetration,kinetic,potential,work,dissipated,balance_error,\
                      seconds_detect,seconds_localise,seconds_solve,seconds_step";

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
        Ok(Self { table: Table::create(path, HEADER)? })
    }
}

/// Puts one row in place of what is in `row`.
fn format(row: &mut String, r: &StepRecord) -> std::fmt::Result {
    let (eps, energy, seconds) = (&r.residual.eps_glob, &r.energy, &r.seconds);
    row.clear();
    write!(row, "{},{:e},{},{},{},{},{}", r.step, r.time, r.bodies, r.contacts, r.active, r.sweeps, u8::from(r.converged()))?;
    let numbers = [
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
        energy.balance_error,
    ];
    numbers.iter().try_for_each(|x| write!(row, ",{x:e}"))?;
    let seconds = [seconds.detect, seconds.localise, seconds.solve, seconds.step];
    seconds.iter().try_for_each(|x| write!(row, ",{x:.3e}"))?;
    writeln!(row)
}

impl<S: Space<D, N>, const D: usize, const N: usize> Observer<S, D, N> for StepsCsv {
    fn see(&mut self, frame: &Frame<'_, S, D, N>) -> Result<(), OutputError> {
        let Some(record) = frame.record else { return Ok(()) };
        // A string takes all that is formatted.
        let _ = format(&mut self.table.row, record);
        self.table.put()
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        self.table.finish()
    }
}
