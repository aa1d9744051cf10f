//! `steps.csv`: a row a step.

use super::table::Table;
use super::{Frame, Observer, OutputError};
use crate::checkpoint::Mark;
use crate::space::Space;
use crate::step::{Created, Energy, Seconds, StepRecord};
use moreau_solve::{EpsGlob, Residual, Status};
use std::fmt::Write as _;
use std::path::Path;

/// The columns, in order.
pub const COLUMNS: [&str; 35] = [
    "step",
    "time",
    "bodies",
    "contacts",
    "active",
    "sweeps",
    "converged",
    "breach",
    "eps_motion",
    "eps_bipotential",
    "eps_penetration",
    "eps_cone",
    "eps_glob",
    "scaled_residual",
    "penetration",
    "overlap",
    "joint_error",
    "joint_gap",
    "kinetic",
    "potential",
    "work",
    "dissipated",
    "impact",
    "friction",
    "balance_error",
    "created",
    "created_contacts",
    "created_joints",
    "created_correction",
    "created_scheme",
    "lift",
    "seconds_detect",
    "seconds_localise",
    "seconds_solve",
    "seconds_step",
];

/// How many of the first columns are whole numbers, but for the time.
const WHOLE: usize = 8;
/// Where the seconds begin, of which few digits mean something.
const SECONDS: usize = COLUMNS.len() - 4;

/// Returns the numbers of a row; whole numbers are below 2^53.
pub fn numbers(r: &StepRecord) -> [f64; COLUMNS.len()] {
    let (eps, energy, seconds) = (&r.residual.eps_glob, &r.energy, &r.seconds);
    [
        r.step as f64,
        r.time,
        r.bodies as f64,
        r.contacts as f64,
        r.active as f64,
        r.sweeps as f64,
        f64::from(u8::from(r.converged())),
        f64::from(u8::from(r.breach.is_some())),
        eps.motion,
        eps.bipotential,
        eps.penetration,
        eps.cone,
        eps.total(),
        r.residual.scaled,
        r.penetration,
        r.overlap,
        r.joint_error,
        r.joint_gap,
        energy.kinetic,
        energy.potential,
        energy.work,
        energy.dissipated,
        energy.impact,
        energy.friction,
        energy.balance_error,
        r.created.total(),
        r.created.contacts,
        r.created.joints,
        r.created.correction,
        r.created.scheme,
        r.lift,
        seconds.detect,
        seconds.localise,
        seconds.solve,
        seconds.step,
    ]
}

/// Returns the record with this row, and whether it broke a limit. The row does not say which limit, or why a solve ended.
pub(crate) fn record_of(row: &[f64; COLUMNS.len()]) -> (StepRecord, bool) {
    let [step, time, bodies, contacts, active, sweeps, converged, breach, rest @ ..] = *row;
    let [motion, bipotential, eps_penetration, cone, _, scaled, penetration, overlap, joint_error, joint_gap, rest @ ..] = rest;
    let [kinetic, potential, work, dissipated, impact, friction, balance_error, _, rest @ ..] = rest;
    let [by_contacts, by_joints, by_correction, by_scheme, lift, detect, localise, solve, whole] = rest;
    let record = StepRecord {
        step: step as u64,
        time,
        bodies: bodies as usize,
        contacts: contacts as usize,
        active: active as usize,
        sweeps: sweeps as u64,
        status: if converged == 1.0 { Status::Converged } else { Status::MaxSweeps },
        residual: Residual {
            eps_glob: EpsGlob { motion, bipotential, penetration: eps_penetration, cone },
            scaled,
            ..Residual::default()
        },
        penetration,
        overlap,
        joint_error,
        joint_gap,
        created: Created::of([by_contacts, by_joints, by_correction, by_scheme]),
        lift,
        energy: Energy { kinetic, potential, work, dissipated, impact, friction, balance_error },
        seconds: Seconds { detect, localise, solve, step: whole },
        ..StepRecord::default()
    };
    (record, breach == 1.0)
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
