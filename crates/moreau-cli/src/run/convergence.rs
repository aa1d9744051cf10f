//! `moreau run --convergence`: the scene at its step, at half of it, at a quarter.

use super::folder::{claim, leave, numbered, prepare_beside_a_run};
use crate::failure::{Failure, say, writable, write_whole};
use crate::table::aligned;
use crate::{progress, scene};
use moreau::convergence::{ConvergenceError, Level, study};
use moreau::run::End;
use moreau::scene::Scene;
use std::fmt::Write as _;
use std::path::Path;

/// Runs the study, prints its table and writes convergence.csv.
pub(super) fn run(scene: &Scene, halvings: u32, args: &super::Args, folder: &Path) -> Result<(), Failure> {
    let quiet = args.quiet;
    let stop = progress::stop_on_ctrl_c()?;
    let new = if args.new { Some(numbered(folder)?) } else { None };
    let folder = new.as_deref().unwrap_or(folder);
    let was_there = new.is_none() && folder.exists();
    let _claim = claim(folder)?;
    prepare_beside_a_run(folder).inspect_err(|_| leave(folder, was_there))?;
    writable(&folder.join("convergence.csv"))?;
    let all = (0..=halvings).fold(0_u64, |all, level| all.saturating_add(scene.time.steps << level));
    let bar = progress::bar(all, quiet);
    let tick = |record: &_| progress::tick(&bar, record);
    let levels = scene::pool(super::threads(args))?.install(|| study(scene, halvings, scene::available_memory(), stop, tick));
    bar.finish_and_clear();
    let levels = levels.map_err(|error| match error {
        ConvergenceError::Scene(error) => Failure::scene(error),
        other => Failure::computation(other),
    })?;
    let rows = rows(&levels);
    let mut csv = String::new();
    rows.iter().for_each(|row| writeln!(csv, "{}", row.join(",")).unwrap_or_default());
    write_whole(&folder.join("convergence.csv"), csv)?;
    if !quiet {
        say(&aligned(&rows))?;
    }
    match levels.last().map(|level| &level.end) {
        Some(End::Interrupted) => Err(Failure::interrupted(format!("the {} runs before are in the table", levels.len() - 1))),
        Some(End::Failed(error)) => Err(Failure::computation(error)),
        _ => Ok(()),
    }
}

/// The table: a run a row, its difference from the run before, and the order that two differences tell.
fn rows(levels: &[Level]) -> Vec<Vec<String>> {
    let names = ["step", "steps", "unconverged", "position", "order", "velocity", "order", "energy", "order", "seconds"];
    let mut rows = vec![names.map(str::to_owned).to_vec()];
    for (i, level) in levels.iter().enumerate() {
        let coarser = i.checked_sub(1).and_then(|i| levels[i].difference);
        let orders = coarser.zip(level.difference).map(|(coarse, fine)| coarse.orders(&fine));
        let values = level.difference.map(|d| [d.position, d.velocity, d.energy]);
        let mut row = vec![format!("{:e}", level.h), level.steps.to_string(), level.unconverged.to_string()];
        for k in 0..3 {
            row.push(values.map_or_else(|| "-".to_owned(), |values| format!("{:.3e}", values[k])));
            row.push(orders.map_or_else(|| "-".to_owned(), |orders| format!("{:.2}", orders[k])));
        }
        row.push(format!("{:.2}", level.seconds));
        rows.push(row);
    }
    rows
}
