//! `steps.csv`: a row a step.

use super::{Frame, Observer, OutputError};
use crate::space::Space;
use crate::step::StepRecord;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// The columns, in order.
const HEADER: &str = "step,time,bodies,contacts,active,sweeps,converged,eps_motion,eps_bipotential,eps_penetration,eps_glob,\
                      scaled_residual,penetration,kinetic,potential,work,dissipated,balance_error,\
                      seconds_detect,seconds_localise,seconds_solve,seconds_step";

/// Writes the records of a run.
#[derive(Debug)]
pub struct StepsCsv {
    path: PathBuf,
    file: BufWriter<File>,
}

impl StepsCsv {
    /// Creates the file with its header.
    ///
    /// # Errors
    /// Where it cannot be created.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let file = File::create(path).map_err(OutputError::io(path))?;
        let mut steps = Self { path: path.to_owned(), file: BufWriter::new(file) };
        steps.line(HEADER)?;
        Ok(steps)
    }

    fn line(&mut self, line: &str) -> Result<(), OutputError> {
        writeln!(self.file, "{line}").map_err(OutputError::io(&self.path))
    }
}

/// One row.
fn row(r: &StepRecord) -> String {
    let (eps, energy, seconds) = (&r.residual.eps_glob, &r.energy, &r.seconds);
    let counts =
        format!("{},{:e},{},{},{},{},{}", r.step, r.time, r.bodies, r.contacts, r.active, r.sweeps, u8::from(r.converged()));
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
    let seconds = [seconds.detect, seconds.localise, seconds.solve, seconds.step];
    let exact = numbers.iter().map(|x| format!(",{x:e}"));
    let rough = seconds.iter().map(|x| format!(",{x:.3e}"));
    std::iter::once(counts).chain(exact).chain(rough).collect()
}

impl<S: Space<D, N>, const D: usize, const N: usize> Observer<S, D, N> for StepsCsv {
    fn see(&mut self, frame: &Frame<'_, S, D, N>) -> Result<(), OutputError> {
        frame.record.map_or(Ok(()), |record| self.line(&row(record)))
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        self.file.flush().map_err(OutputError::io(&self.path))
    }
}
