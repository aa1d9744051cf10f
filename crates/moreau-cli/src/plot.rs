//! `moreau plot`.

use crate::chart::{Chart, Curve, Form, figure, linear, semilog};
use crate::failure::{Failure, say, write_whole};
use crate::outputs::Replace;
use moreau_view::recording::Recording;
use std::path::PathBuf;

/// Arguments of `moreau plot`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder that moreau run wrote
    run: PathBuf,
    /// What is drawn, with commas between
    #[arg(long, value_enum, value_delimiter = ',', default_value = "sweeps,residual,penetration,energy")]
    what: Vec<What>,
    /// The figure, .svg, .png or .pdf [default: plot.svg in that folder]
    #[arg(long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum What {
    /// Sweeps of the solver in each step
    Sweeps,
    /// The parts of the paper's residual, and the scaled one
    Residual,
    /// The deepest overlap
    Penetration,
    /// Kinetic and potential energy, work and what was dissipated
    Energy,
    /// By how much the balance of energy does not close
    Balance,
    /// Contacts, and those with an impulse
    Contacts,
    /// Where the time of each step went
    Seconds,
    /// Contacts a body, of runs with measures
    Coordination,
    /// What part of their box bodies fill, of runs with measures
    SolidFraction,
    /// How far contacts prefer a direction, of runs with measures
    Anisotropy,
    /// The mean stress, of runs with measures
    Pressure,
}

impl What {
    /// Whether it comes from the measures.
    fn is_measured(self) -> bool {
        matches!(self, Self::Coordination | Self::SolidFraction | Self::Anisotropy | Self::Pressure)
    }
}

/// Draws and writes.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let run = Recording::open(&args.run).map_err(Failure::file)?;
    let form = args.out.as_deref().map_or(Ok(Form::Svg), Form::of)?;
    let out = args.replace.in_run(&args.run, "plot.svg", args.out.as_deref())?;
    if run.column("step").is_empty() {
        return Err(Failure::file(format!("{}: the trajectory has no step yet", args.run.display())));
    }
    if args.what.iter().any(|what| what.is_measured()) && run.measure("time").is_empty() {
        let what = "it has no measures.csv, or an empty one; run it again with \"measures\" among output.kinds";
        return Err(Failure::usage(format!("{}: {what}", args.run.display())));
    }
    let charts = args.what.iter().map(|&what| chart(&run, what)).collect();
    write_whole(&out, figure(&run.title(), charts, form)?)?;
    say(&format!("{}: {} steps\n", out.display(), run.column("step").len()))
}

/// Curves of these columns of steps over time.
fn curves(run: &Recording, columns: &[(&str, &str)]) -> Vec<Curve> {
    columns.iter().map(|&(column, name)| curve(name, run.column("time"), run.column(column))).collect()
}

/// The same of measures.
fn measures(run: &Recording, columns: &[(&str, &str)]) -> Vec<Curve> {
    columns.iter().map(|&(column, name)| curve(name, run.measure("time"), run.measure(column))).collect()
}

fn curve(name: &str, times: &[f64], values: &[f64]) -> Curve {
    let points = times.iter().copied().zip(values.iter().copied());
    Curve { name: name.to_owned(), points: points.filter(|(_, y)| y.is_finite()).collect() }
}

fn chart(run: &Recording, what: What) -> Chart {
    let time = "time (s)";
    match what {
        What::Sweeps => linear("Sweeps", time, "sweeps a step", &curves(run, &[("sweeps", "sweeps")])),
        What::Residual => {
            let parts = [
                ("eps_motion", "ε of motion"),
                ("eps_bipotential", "ε of the bipotential"),
                ("eps_penetration", "ε of penetration"),
                ("eps_cone", "ε of the cone"),
                ("scaled_residual", "scaled"),
            ];
            semilog("Residuals", time, "residual", &curves(run, &parts))
        }
        What::Penetration => semilog("Deepest overlap", time, "overlap (m)", &curves(run, &[("penetration", "overlap")])),
        What::Energy => {
            let parts = ["kinetic", "potential", "work", "dissipated", "impact", "friction"].map(|name| (name, name));
            linear("Energy", time, "energy (J)", &from_start(curves(run, &parts)))
        }
        What::Balance => linear("Balance of energy", time, "error (J)", &curves(run, &[("balance_error", "error")])),
        What::Contacts => {
            linear("Contacts", time, "contacts", &curves(run, &[("contacts", "within reach"), ("active", "with an impulse")]))
        }
        What::Seconds => {
            let parts = [
                ("seconds_detect", "detection"),
                ("seconds_localise", "localising"),
                ("seconds_solve", "solving"),
                ("seconds_step", "whole step"),
            ];
            semilog("Time of a step", time, "time (s)", &curves(run, &parts))
        }
        What::Coordination => {
            let parts = [("coordination", "all"), ("coordination_without_rattlers", "without rattlers")];
            linear("Coordination", time, "contacts a body", &measures(run, &parts))
        }
        What::SolidFraction => {
            linear("Solid fraction", time, "part filled", &measures(run, &[("solid_fraction", "smallest box around the bodies")]))
        }
        What::Anisotropy => {
            linear("Anisotropy", time, "of the fabric tensor", &measures(run, &[("fabric_anisotropy", "contacts that carry")]))
        }
        What::Pressure => {
            linear("Pressure", time, "mean stress (Pa, in the plane N/m)", &measures(run, &[("pressure", "pressure")]))
        }
    }
}

/// Potential energy has no zero: its curve begins there.
fn from_start(mut curves: Vec<Curve>) -> Vec<Curve> {
    for curve in curves.iter_mut().filter(|curve| curve.name == "potential") {
        let start = curve.points.first().map_or(0.0, |&(_, y)| y);
        curve.name = "potential, from the start".to_owned();
        curve.points.iter_mut().for_each(|(_, y)| *y -= start);
    }
    curves
}
