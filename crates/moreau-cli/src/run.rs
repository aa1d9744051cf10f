//! `moreau run`.

use crate::failure::{Failure, say, writable, write_whole};
use crate::view::{self, Pace};
use crate::{progress, scene};
use moreau::observe::{FailedProblems, MeasuresCsv, Observer, OutputError, StepsCsv, TrajectoryOutput, VtkOutput};
use moreau::run::{End, Outcome, Unwritten};
use moreau::scene::{AnyWorld, OutputKind, Scene};
use moreau::space::Space;
use moreau::step::{FAILED_KEPT, Workspace};
use moreau::world::{OnFailure, StepSettings, World};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Arguments of `moreau run`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The scene file
    scene: PathBuf,
    /// Where to write [default: out/NAME, NAME being the scene file's]
    #[arg(long)]
    out: Option<PathBuf>,
    /// How many steps to do, in place of the scene's
    #[arg(long)]
    steps: Option<u64>,
    /// Change a value of the scene: key.path=value (may be given again)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
    /// How many threads may be used; default one a core. The results do not depend on it
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Show the run while it goes on, as a page on this machine that can pause, step and stop it; afterwards until Ctrl-C
    #[arg(long)]
    view: bool,
    /// No progress bar and no summary
    #[arg(long)]
    quiet: bool,
}

/// Runs the scene and writes its folder.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let mut sets = args.sets.clone();
    sets.extend(args.steps.map(|steps| format!("time.steps={steps}")));
    let scene = scene::load(&args.scene, &sets)?;
    let world = scene::build(&scene)?;
    let folder = args
        .out
        .clone()
        .or_else(|| scene.output.folder.as_ref().map(PathBuf::from))
        .unwrap_or_else(|| Path::new("out").join(scene::name(&args.scene)));
    prepare(&folder, &args.scene)?;
    write_whole(&folder.join("scene.toml"), scene.to_toml())?;
    match world {
        AnyWorld::Plane(world) => go(args, &scene, world, &folder),
        AnyWorld::Solid(world) => go(args, &scene, world, &folder),
    }
}

/// Makes the folder and takes an earlier run's files out of it: a mixture of two runs would mislead. Nothing is taken before it is
/// sure that all can be written, and never the scene that is being run.
fn prepare(folder: &Path, scene: &Path) -> Result<(), Failure> {
    let wrong = |path: &Path, reason: &dyn std::fmt::Display| {
        Failure::file(format!("cannot write into {}: {reason}; choose another folder with --out", path.display()))
    };
    std::fs::create_dir_all(folder).map_err(|error| wrong(folder, &error))?;
    let files = ["scene.toml", "summary.json", "steps.csv", "measures.csv", "trajectory.h5"].map(|file| folder.join(file));
    for file in &files {
        writable(file)?;
    }
    let same = |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if same(&files[0], scene) {
        return Err(wrong(&files[0], &"it is the scene to run, which would be overwritten"));
    }
    let vtk = folder.join("vtk");
    if vtk.exists() && !vtk.is_dir() {
        return Err(wrong(&vtk, &"it is not a folder"));
    }
    if vtk.exists() {
        writable(&vtk.join("bodies.pvd"))?;
    }
    let old_frames = std::fs::read_dir(&vtk).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_frame = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "vtp" || extension == "pvd");
    let old_problems = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_problem = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("failed-step-") && name.ends_with(".hdf5") && path.is_file()
    };
    let old = old_frames.filter(is_frame).chain(old_problems.filter(is_problem));
    for path in files[1..].iter().cloned().chain(old) {
        match std::fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => return Err(wrong(&path, &error)),
            _ => {}
        }
    }
    Ok(())
}

fn observers<'a, S: Space<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    world: &World<S, D, N>,
    folder: &Path,
) -> Result<Vec<Box<dyn Observer<S, D, N> + 'a>>, OutputError> {
    let mut observers: Vec<Box<dyn Observer<S, D, N> + 'a>> = Vec::new();
    if scene.output.kinds.contains(&OutputKind::Steps) {
        observers.push(Box::new(StepsCsv::create(&folder.join("steps.csv"))?));
    }
    let every = scene.frames_every();
    if scene.output.kinds.contains(&OutputKind::Measures) && every > 0 {
        observers.push(Box::new(MeasuresCsv::create(&folder.join("measures.csv"), every, D)?));
    }
    if scene.output.kinds.contains(&OutputKind::Vtk) && every > 0 {
        observers.push(Box::new(VtkOutput::create(&folder.join("vtk"), every)?));
    }
    if scene.output.kinds.contains(&OutputKind::Trajectory) {
        let settings = (scene.title.as_deref().unwrap_or_default(), every, scene.output.precision);
        observers.push(Box::new(TrajectoryOutput::create(&folder.join("trajectory.h5"), world, settings)?));
    }
    if scene.solver.on_failure == OnFailure::Dump {
        observers.push(Box::new(FailedProblems::new(folder)));
    }
    Ok(observers)
}

/// Computes, and shows what is computed if that is asked for.
fn go<S: Space<D, N>, const D: usize, const N: usize>(
    args: &Args,
    scene: &Scene,
    world: World<S, D, N>,
    folder: &Path,
) -> Result<(), Failure> {
    let (stop, pace) = (progress::stop_on_ctrl_c()?, Pace::default());
    if !args.view {
        return compute(args, scene, world, folder, (stop, &pace));
    }
    let mut viewer = view::begin(folder)?;
    let (running, done) = (AtomicBool::new(true), AtomicBool::new(false));
    std::thread::scope(|scope| {
        scope.spawn(|| viewer.serve(&done, &running, |order| pace.order(order, stop)));
        let result = compute(args, scene, world, folder, (stop, &pace));
        running.store(false, Ordering::Relaxed);
        // It can be looked at until it is enough.
        while result.is_ok() && !stop.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(100));
        }
        done.store(true, Ordering::Relaxed);
        result
    })
}

fn compute<S: Space<D, N>, const D: usize, const N: usize>(
    args: &Args,
    scene: &Scene,
    mut world: World<S, D, N>,
    folder: &Path,
    (stop, pace): (&'static AtomicBool, &Pace),
) -> Result<(), Failure> {
    let mut observers = observers(scene, &world, folder).map_err(Failure::file)?;
    let settings = world.settings;
    let bar = progress::bar(scene.time.steps, args.quiet);
    let pool = scene::pool(args.threads.map_or_else(scene::cores, usize::from))?;
    let result = pool.install(|| {
        moreau::run::run(&mut world, &mut Workspace::default(), scene.time.steps, &mut observers, stop, |record| {
            if !bar.is_hidden() {
                progress::tick(&bar, record);
            }
            pace.wait(stop);
        })
    });
    bar.finish_and_clear();
    let bodies = world.bodies.present();
    // What could not be written ends the run, but not without its summary.
    let (outcome, unwritten) = match result {
        Ok(outcome) => (outcome, None),
        Err(unwritten) => {
            let Unwritten { error, outcome } = *unwritten;
            (outcome, Some(error))
        }
    };
    let threads = pool.current_num_threads();
    let mut summary = outcome.summary.to_json(bodies, &settings, threads, outcome.seconds_total, outcome.seconds_output);
    summary["bodies_inserted"] = world.schedule.inserted().into();
    summary["bodies_removed"] = world.schedule.removed().into();
    summary["memory_bytes"] = scene::memory_in_use().into();
    let written = write_whole(&folder.join("summary.json"), format!("{summary:#}\n"));
    if let Some(error) = unwritten {
        return Err(Failure::file(format!("{error}; {}", kept(&outcome, folder))));
    }
    written?;
    if !args.quiet {
        say(&describe(&outcome, bodies, &settings, folder))?;
    }
    verdict(&outcome, folder)
}

/// A few lines for a person.
fn describe(outcome: &Outcome, bodies: usize, settings: &StepSettings, folder: &Path) -> String {
    let summary = &outcome.summary;
    let unconverged = match summary.unconverged() {
        0 => "every step converged".to_owned(),
        count => format!("{count} steps did NOT converge"),
    };
    format!(
        "{} steps, {bodies} bodies, {} inside {}: {:.1} sweeps a step, {unconverged}\n\
         {:.2} s in all, {:.2} s for contact impulses, {:.2} s for files\n\
         {}results in {}\n",
        summary.steps(),
        settings.solver.local.name(),
        settings.solver.global.name(),
        summary.sweeps_mean(),
        outcome.seconds_total,
        summary.seconds_solve(),
        outcome.seconds_output,
        failed_problems(outcome, folder),
        folder.display(),
    )
}

/// Where the problems of failed solves are, under the policy `dump`.
fn failed_problems(outcome: &Outcome, folder: &Path) -> String {
    let summary = &outcome.summary;
    let mut text = String::new();
    if let [first, ..] = summary.failed_problems() {
        let count = summary.failed_problems().len();
        let more =
            if summary.unconverged() > FAILED_KEPT { format!(", of the first {FAILED_KEPT} that failed") } else { String::new() };
        text += &format!(
            "problems of {count} failed solves{more}; solve again with: moreau solve {}\n",
            folder.join(first).display()
        );
    }
    if let Some(reason) = summary.refused_problem() {
        text += &format!("no problem file could be made of {reason}\n");
    }
    text
}

fn kept(outcome: &Outcome, folder: &Path) -> String {
    format!("the {} steps before are kept in {}", outcome.summary.steps(), folder.display())
}

fn verdict(outcome: &Outcome, folder: &Path) -> Result<(), Failure> {
    let kept = kept(outcome, folder);
    match &outcome.end {
        End::Done | End::Unwritten => Ok(()),
        End::Interrupted => Err(Failure::interrupted(kept)),
        End::Failed(error) => Err(Failure::computation(format!("{error}; {kept}"))),
    }
}
