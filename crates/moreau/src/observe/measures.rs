//! `measures.csv`: granular measures, a row every so many steps.

use super::table::Table;
use super::{Frame, Observer, OutputError};
use crate::checkpoint::Mark;
use crate::measure::{self, Touch};
use crate::space::Space;
use std::fmt::Write as _;
use std::path::Path;

/// Writes the measures of a run.
///
/// Solid fraction and stress are those of the smallest box around the free bodies; contacts count where they carry a load.
#[derive(Debug)]
pub struct MeasuresCsv {
    every: u64,
    table: Table,
}

impl MeasuresCsv {
    /// Creates the file with its header, for each `every`-th step of a world in `dimension` dimensions.
    ///
    /// # Errors
    /// Where it cannot be created.
    pub fn create(path: &Path, every: u64, dimension: usize) -> Result<Self, OutputError> {
        Ok(Self { every: every.max(1), table: Table::create(path, &header(dimension))? })
    }

    /// Goes on with the file of a run that was stopped: rows after the mark are taken out.
    ///
    /// # Errors
    /// Where it cannot be written, or is not what the run left.
    pub fn resume(path: &Path, every: u64, mark: &Mark) -> Result<Self, OutputError> {
        Ok(Self { every: every.max(1), table: Table::resume(path, mark)? })
    }
}

/// The columns, in order.
fn header(dimension: usize) -> String {
    let axes = ["x", "y", "z"];
    let axes = &axes[..dimension.min(axes.len())];
    let stress: Vec<String> = axes.iter().flat_map(|i| axes.iter().map(move |j| format!("stress_{i}{j}"))).collect();
    let before = "step,time,coordination,coordination_without_rattlers,solid_fraction,fabric_anisotropy";
    format!("{before},{},pressure,mean_normal_force,sliding_share", stress.join(","))
}

impl<S: Space<D, N>, const D: usize, const N: usize> Observer<S, D, N> for MeasuresCsv {
    fn see(&mut self, frame: &Frame<'_, S, D, N>) -> Result<(), OutputError> {
        let Some(record) = frame.record.filter(|record| record.step.is_multiple_of(self.every)) else { return Ok(()) };
        let (world, contacts) = (frame.world, frame.contacts);
        let number = measure::coordination(world, contacts, Touch::Loaded);
        let (mut fraction, mut stress) = (0.0, [[0.0; D]; D]);
        if let Some(region) = measure::extent(&world.bodies) {
            fraction = measure::solid_fraction(world, &region);
            stress = measure::stress_in(world, contacts, record.h, &region);
        }
        let anisotropy = measure::deviator(&measure::fabric(Touch::Loaded.among(contacts)));
        let force = measure::mean(&measure::normal_forces(contacts, record.h));
        let before = [number.mean, number.without_rattlers, fraction, anisotropy];
        let after = [measure::mean_stress(&stress), force, measure::sliding_share(contacts)];
        let row = &mut self.table.row;
        row.clear();
        // A string takes all that is formatted.
        let _ = write!(row, "{},{:e}", record.step, record.time);
        for x in before.iter().chain(stress.as_flattened()).chain(&after) {
            let _ = write!(row, ",{x:e}");
        }
        row.push('\n');
        self.table.put()
    }

    fn sync(&mut self) -> Result<Option<Mark>, OutputError> {
        self.table.sync().map(Some)
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        self.table.finish()
    }
}
