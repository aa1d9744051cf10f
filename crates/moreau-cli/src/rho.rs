//! `moreau compare --rho`: how the number of sweeps depends on the parameter ρ of the standard methods.

use crate::chart::{Curve, Form, linear};
use crate::failure::{Failure, write_whole};
use crate::progress;
use moreau::compare::{Methods, compare_one};
use moreau::run::End;
use moreau::solve::Parameter;
use moreau::space::Space;
use moreau::world::World;
use std::fmt::Write;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// The study: which values of ρ, relative to the automatic one, over how many steps.
pub(crate) struct Study<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) methods: &'a [Methods],
    pub(crate) steps: u64,
    pub(crate) quiet: bool,
    pub(crate) csv: Option<&'a Path>,
    pub(crate) plot: Option<&'a Path>,
}

/// Runs `world` with each value and method; returns a table of mean sweeps and whether it was cut short, and writes CSV and
/// figure if asked.
pub(crate) fn study<S: Space<D, N>, const D: usize, const N: usize>(
    study: &Study<'_>,
    world: &World<S, D, N>,
    stop: &AtomicBool,
) -> Result<(Vec<Vec<String>>, bool), Failure> {
    let names: Vec<&str> = study.methods.iter().map(|(_, local)| local.name()).collect();
    let mut rows = vec![std::iter::once("rho W").chain(names.iter().copied()).map(str::to_owned).collect::<Vec<_>>()];
    let mut curves: Vec<Curve> = names.iter().map(|&name| Curve { name: name.to_owned(), points: Vec::new() }).collect();
    let mut csv = format!("rho_relative,{}\n", names.join(","));
    let bar = progress::bar(study.steps * (study.values.len() * study.methods.len()) as u64, study.quiet);
    let mut interrupted = false;
    'values: for &value in study.values {
        let mut start = world.clone();
        start.settings.solver.rho = Parameter::Relative(value);
        let mut cells = vec![format!("{value}")];
        for (&methods, curve) in study.methods.iter().zip(&mut curves) {
            let row = compare_one(&start, None, methods, (study.steps, 1), stop, |record| progress::tick(&bar, record));
            let row = row.map_err(Failure::file)?;
            if row.end == End::Interrupted {
                interrupted = true;
                break 'values;
            }
            // A value that does not converge has no number of sweeps.
            let converged = row.end == End::Done && row.unconverged == 0;
            cells.push(if converged { format!("{:.2}", row.sweeps) } else { "-".to_owned() });
            if converged {
                curve.points.push((value, row.sweeps));
            }
        }
        let _ = writeln!(csv, "{}", cells.join(","));
        rows.push(cells);
    }
    bar.finish_and_clear();
    if let Some(path) = study.csv {
        write_whole(path, &csv)?;
    }
    if let Some(path) = study.plot {
        let chart = linear("sweeps a step against ρ", "ρ relative to 1/W", "sweeps of NLGS a step", &curves);
        write_whole(path, chart.draw(Form::of(path)?)?)?;
    }
    Ok((rows, interrupted))
}
