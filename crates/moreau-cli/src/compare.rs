//! `moreau compare`: the paper's tables and its figure 4.

use crate::chart::{Chart, Curve, Form, semilog};
use crate::failure::{Failure, say, write_whole};
use crate::outputs::Replace;
use crate::rho::{self, Study};
use crate::table::aligned;
use crate::{names, progress, scene};
use moreau::compare::{Methods, Probe, Row, compare_one};
use moreau::run::End;
use moreau::scene::{AnyWorld, Scene};
use moreau::solve::{Criterion, GlobalMethod, LocalMethod};
use moreau::space::Space;
use moreau::world::World;
use std::fmt::Write;
use std::path::PathBuf;

/// The greatest relative difference of velocities in one step that still counts as agreement. ε_glob bounds a mean over contacts,
/// and errors add up along chains of them; methods that solve another problem differ by far more.
const AGREEMENT: f64 = 1e-3;

/// Arguments of `moreau compare`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The scene file
    scene: PathBuf,
    /// Local solvers
    #[arg(long, value_delimiter = ',', value_parser = names::local, default_value = "sbp,sal,ebp,eal,pdas")]
    local: Vec<LocalMethod>,
    /// Global solvers
    #[arg(long, value_delimiter = ',', value_parser = names::global, default_value = "nlgs")]
    global: Vec<GlobalMethod>,
    /// Change a value of the scene: key.path=value (may be given again)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
    /// Runs of each solver, of which the fastest counts
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    repeat: u16,
    /// The step at which errors are shown sweep by sweep and velocities are compared [default: the last]
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
    at: Option<u64>,
    /// Write the table, and the errors by sweep, as CSV
    #[arg(long)]
    csv: Option<PathBuf>,
    /// Draw error against sweep at the chosen step (the paper's figure 4), as .svg, .png or .pdf
    #[arg(long)]
    plot: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// Show instead how the sweeps depend on ρ: values relative to the automatic one, such as 0.2,0.4,1
    #[arg(long, value_delimiter = ',', value_parser = names::positive)]
    rho: Vec<f64>,
    /// No progress bar
    #[arg(long)]
    quiet: bool,
}

/// Runs all pairs of methods and reports.
pub(crate) fn compare(args: &Args) -> Result<(), Failure> {
    let scene = scene::load(&args.scene, &args.sets)?;
    for path in args.csv.iter().chain(&args.plot) {
        args.replace.allows(path)?;
    }
    args.plot.as_deref().map(Form::of).transpose()?;
    let world = scene::build(&scene)?;
    scene::pool(1)?.install(|| match &world {
        AnyWorld::Plane(world) => go(args, &scene, world),
        AnyWorld::Solid(world) => go(args, &scene, world),
    })
}

fn go<S: Space<D, N>, const D: usize, const N: usize>(args: &Args, scene: &Scene, world: &World<S, D, N>) -> Result<(), Failure> {
    let stop = progress::stop_on_ctrl_c()?;
    let steps = scene.time.steps;
    let at = args.at.unwrap_or(steps).clamp(1, steps.max(1));
    let methods: Vec<Methods> = args.global.iter().flat_map(|&g| args.local.iter().map(move |&l| (g, l))).collect();
    if !args.rho.is_empty() {
        let (csv, plot) = (args.csv.as_deref(), args.plot.as_deref());
        let study = Study { values: &args.rho, methods: &methods, steps, quiet: args.quiet, csv, plot };
        let (rows, interrupted) = rho::study(&study, world, stop)?;
        say(&aligned(&rows))?;
        return if interrupted { Err(Failure::interrupted("the table above is of what was done")) } else { Ok(()) };
    }
    let probe = Probe::new(world, at, 0.01 * world.settings.solver.tolerance, stop).map_err(Failure::file)?;

    let mut rows = Vec::new();
    for &methods in &methods {
        let bar = progress::bar(steps * u64::from(args.repeat), args.quiet);
        bar.set_prefix(methods.1.name());
        let shape = (steps, usize::from(args.repeat));
        let row = compare_one(world, probe.as_ref(), methods, shape, stop, |record| progress::tick(&bar, record));
        bar.finish_and_clear();
        rows.push(row.map_err(Failure::file)?);
        if rows.last().is_some_and(|row| row.end == End::Interrupted) {
            break;
        }
    }
    say(&report(args, scene, world, &rows, at))?;
    if let Some(path) = &args.csv {
        write_whole(path, csv(&rows))?;
    }
    if let Some(path) = &args.plot {
        let title = format!("{}: error by sweep at step {at}", scene::name(&args.scene));
        write_whole(path, figure(&title, world.settings.solver.criterion, &rows).draw(Form::of(path)?)?)?;
    }
    verdict(&rows, at)
}

/// The table, in the paper's columns with ratios to the best.
fn report<S: Space<D, N>, const D: usize, const N: usize>(
    args: &Args,
    scene: &Scene,
    world: &World<S, D, N>,
    rows: &[Row],
    at: u64,
) -> String {
    // A run that ended early has no time to compare with.
    let done = |row: &&Row| row.end == End::Done;
    let best = |time: fn(&Row) -> f64| rows.iter().filter(done).map(time).fold(f64::INFINITY, f64::min);
    let (best_total, best_solve) = (best(|row| row.seconds_total), best(|row| row.seconds_solve));
    let header = ["method", "sweeps/step", "total s", "ratio", "contact forces s", "ratio", "unconverged", "difference"];
    let mut cells = vec![header.map(str::to_owned).to_vec()];
    for row in rows {
        cells.push(vec![
            name(row),
            format!("{:.2}", row.sweeps),
            format!("{:.4}", row.seconds_total),
            format!("{:.2}", row.seconds_total / best_total),
            format!("{:.4}", row.seconds_solve),
            format!("{:.2}", row.seconds_solve / best_solve),
            format!("{}", row.unconverged),
            format!("{:.1e}", row.disagreement),
        ]);
    }
    let solver = &world.settings.solver;
    let mut text = format!(
        "{}: {} bodies, {} steps of {:e} s, tolerance {:e} ({}), one thread\n\n",
        scene::name(&args.scene),
        world.bodies.len(),
        scene.time.steps,
        world.settings.h,
        solver.tolerance,
        if solver.criterion == Criterion::EpsGlob { "ε_glob" } else { "scaled residual" },
    );
    text += &aligned(&cells);
    let _ = writeln!(
        text,
        "\ndifference: greatest relative difference in velocity from the exact local solver in step {at},\n\
         taken from the same state to a hundredth of the tolerance"
    );
    text
}

fn name(row: &Row) -> String {
    format!("{}+{}", row.methods.0.name(), row.methods.1.name())
}

fn csv(rows: &[Row]) -> String {
    let mut text = "global,local,steps,sweeps_mean,seconds_total,seconds_solve,unconverged,difference\n".to_owned();
    for row in rows {
        let (global, local) = (row.methods.0.name(), row.methods.1.name());
        let _ = writeln!(
            text,
            "{global},{local},{},{},{},{},{},{:e}",
            row.steps, row.sweeps, row.seconds_total, row.seconds_solve, row.unconverged, row.disagreement
        );
    }
    text += "\nglobal,local,sweep,eps_motion,eps_bipotential,eps_penetration,eps_glob,scaled_residual\n";
    for row in rows {
        let (global, local) = (row.methods.0.name(), row.methods.1.name());
        for at in &row.history {
            let eps = &at.residual.eps_glob;
            let _ = writeln!(
                text,
                "{global},{local},{},{:e},{:e},{:e},{:e},{:e}",
                at.sweep,
                eps.motion,
                eps.bipotential,
                eps.penetration,
                eps.total(),
                at.residual.scaled
            );
        }
    }
    text
}

/// Error against sweep.
fn figure(title: &str, criterion: Criterion, rows: &[Row]) -> Chart {
    let label = if criterion == Criterion::EpsGlob { "ε_glob" } else { "scaled residual" };
    let curve = |row: &Row| Curve {
        name: name(row),
        points: row
            .history
            .iter()
            .map(|at| {
                let error = if criterion == Criterion::EpsGlob { at.residual.eps_glob.total() } else { at.residual.scaled };
                (at.sweep as f64, error)
            })
            .collect(),
    };
    semilog(title, "sweeps of NLGS", label, &rows.iter().map(curve).collect::<Vec<_>>())
}

fn verdict(rows: &[Row], at: u64) -> Result<(), Failure> {
    for row in rows {
        match &row.end {
            End::Done => {}
            End::Interrupted => return Err(Failure::interrupted("the table above is of what was done")),
            End::Unwritten => return Err(Failure::computation(format!("{}: the run could not be completed", name(row)))),
            End::Failed(error) => return Err(Failure::computation(format!("{}: {error}", name(row)))),
        }
    }
    match rows.iter().find(|row| row.disagreement.is_nan() || row.disagreement > AGREEMENT) {
        Some(row) if !row.disagreement.is_finite() => Err(Failure::computation(format!(
            "{}: step {at} does not converge to a hundredth of the tolerance, so velocities cannot be compared",
            name(row)
        ))),
        Some(row) => Err(Failure::disagreement(format!(
            "{} differs by {:.1e} from the exact local solver in step {at}: the tolerance is too loose, or it is wrong",
            name(row),
            row.disagreement
        ))),
        None => Ok(()),
    }
}
