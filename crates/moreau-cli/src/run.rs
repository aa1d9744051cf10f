//! `moreau run`.

mod convergence;
mod folder;
mod observers;
mod resume;
mod words;

use crate::failure::{Failure, say, write_whole};
use crate::marker::Marker;
use crate::view::{self, Pace};
use crate::{progress, scene};
use folder::{claim, hold, leave, numbered, prepare, undo};
use moreau::checkpoint::{self, Checkpoint, Checkpoints};
use moreau::io::whole;
use moreau::observe::{Observer, Summary};
use moreau::run::{Outcome, Task, Unwritten};
use moreau::scene::{AnyWorld, Scene};
use moreau::space::Space;
use moreau::step::Workspace;
use moreau::world::World;
use observers::observers;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use words::{describe, ending, judge};

/// Arguments of `moreau run`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The scene file
    #[arg(required_unless_present = "resume")]
    scene: Option<PathBuf>,
    /// Go on with the run in this folder from its last checkpoint, whatever stopped it
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["scene", "out"])]
    resume: Option<PathBuf>,
    /// The folder to write into, which must be empty or not exist [default: out/NAME, NAME being the scene file's]
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace the run in the folder: remove the files that its run.json lists. Other files stay; a folder without run.json is refused
    #[arg(long, conflicts_with_all = ["resume", "new", "convergence"])]
    force: bool,
    /// Write into the first of the folders FOLDER, FOLDER-2, FOLDER-3, … that does not exist
    #[arg(long, conflicts_with = "resume")]
    new: bool,
    /// How many steps to do, in place of the scene's
    #[arg(long)]
    steps: Option<u64>,
    /// Change a value of the scene: key.path=value (may be given again)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
    /// How many threads may be used; default one a core. The results do not depend on it
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Run the scene at its step, at half of it and at a quarter (or so many halves), and print by what order the ends approach each other;
    /// writes convergence.csv into an empty folder or the folder of a run, where it replaces the last one
    #[arg(long, value_name = "HALVES", num_args = 0..=1, default_missing_value = "2", value_parser = clap::value_parser!(u32).range(1..=20), conflicts_with_all = ["resume", "view"])]
    convergence: Option<u32>,
    /// Show the run while it goes on, as a page on this machine that can pause, step and stop it; afterwards until Ctrl-C
    #[arg(long)]
    view: bool,
    /// End with code 6 if the run is not to be relied on
    #[arg(long, conflicts_with = "convergence")]
    strict: bool,
    /// No progress bar and no summary
    #[arg(long)]
    quiet: bool,
}

/// Runs the scene and writes its folder, or goes on with one.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let mut sets = args.sets.clone();
    sets.extend(args.steps.map(|steps| format!("time.steps={steps}")));
    // Before its checkpoint is read: another run may be about to write the next.
    let _held = args.resume.as_deref().map(hold).transpose()?;
    let (scene, folder, from) = match (&args.scene, &args.resume) {
        (_, Some(folder)) => {
            let (scene, checkpoint) = resume::load(folder, sets)?;
            (scene, folder.clone(), Some(checkpoint))
        }
        (Some(file), None) => {
            let scene = scene::load(file, &sets)?;
            let named = args.out.clone().or_else(|| scene.output.folder.as_ref().map(PathBuf::from));
            let folder = named.unwrap_or_else(|| Path::new("out").join(scene::name(file)));
            (scene, folder, None)
        }
        (None, None) => return Err(Failure::usage("there is neither a scene to run nor a run to go on with")),
    };
    if let Some(halvings) = args.convergence {
        return convergence::run(&scene, halvings, args, &folder);
    }
    match scene::build(&scene)? {
        AnyWorld::Plane(world) => begin(args, &scene, world, &folder, from.as_ref()),
        AnyWorld::Solid(world) => begin(args, &scene, world, &folder, from.as_ref()),
    }
}

/// How many threads are asked for.
fn threads(args: &Args) -> usize {
    args.threads.map_or_else(scene::cores, usize::from)
}

/// A run that is ready to go on: from the start, or from a checkpoint.
struct Ready<'a, S: Space<D, N>, const D: usize, const N: usize> {
    world: World<S, D, N>,
    work: Workspace<S, D, N>,
    observers: Vec<Box<dyn Observer<S, D, N> + 'a>>,
    /// The summary of the steps before, of a run that goes on.
    before: Option<Summary>,
    /// The scene as it is kept.
    text: String,
    /// True if the folder was there before the run.
    was_there: bool,
}

/// Claims the folder, puts the world and the files where the run begins or goes on, and computes.
fn begin<S: Space<D, N>, const D: usize, const N: usize>(
    args: &Args,
    scene: &Scene,
    world: World<S, D, N>,
    folder: &Path,
    from: Option<&Checkpoint>,
) -> Result<(), Failure> {
    let new = if args.new { Some(numbered(folder)?) } else { None };
    let folder = new.as_deref().unwrap_or(folder);
    if from.is_some() {
        return go(args, scene, ready(scene, world, folder, from)?, folder);
    }
    let was_there = new.is_none() && folder.exists();
    let _claim = claim(folder)?;
    if let Some(file) = &args.scene {
        prepare(folder, file, args.force).inspect_err(|_| leave(folder, was_there))?;
    }
    let ready = ready(scene, world, folder, from).inspect_err(|_| undo(folder, was_there))?;
    go(args, scene, Ready { was_there, ..ready }, folder)
}

/// Puts the world and the files where the run begins or goes on, in a folder that is claimed.
fn ready<'a, S: Space<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    mut world: World<S, D, N>,
    folder: &Path,
    from: Option<&Checkpoint>,
) -> Result<Ready<'a, S, D, N>, Failure> {
    let mut work = Workspace::default();
    if let Some(checkpoint) = from {
        checkpoint.restore(&mut world, &mut work).map_err(Failure::scene)?;
        Marker::add(folder)?;
        whole::sweep(folder);
        whole::sweep(&folder.join("vtk"));
    }
    let marks = from.map(|checkpoint| (checkpoint.steps(), checkpoint.marks.as_slice()));
    let observers = observers(scene, &world, folder, marks)?;
    let text = scene.to_toml();
    write_whole(&folder.join("scene.toml"), &text)?;
    Ok(Ready { world, work, observers, before: from.map(|checkpoint| checkpoint.summary.clone()), text, was_there: true })
}

/// Computes, and shows what is computed if that is asked for.
fn go<S: Space<D, N>, const D: usize, const N: usize>(
    args: &Args,
    scene: &Scene,
    ready: Ready<'_, S, D, N>,
    folder: &Path,
) -> Result<(), Failure> {
    let (stop, pace) = (progress::stop_on_ctrl_c()?, Arc::new(Pace::default()));
    if !args.view {
        return compute(args, scene, ready, folder, (stop, &pace));
    }
    let serving = view::begin(folder, &pace, stop)?;
    let result = compute(args, scene, ready, folder, (stop, &pace));
    serving.run_is_over();
    // It can be looked at until it is enough.
    if result.as_ref().err().is_none_or(Failure::is_unreliable) {
        view::until(stop);
    }
    result
}

/// Takes the steps, and writes and tells what they came to.
fn compute<S: Space<D, N>, const D: usize, const N: usize>(
    args: &Args,
    scene: &Scene,
    ready: Ready<'_, S, D, N>,
    folder: &Path,
    (stop, pace): (&'static AtomicBool, &Pace),
) -> Result<(), Failure> {
    let Ready { mut world, mut work, mut observers, before, text, was_there } = ready;
    let goes_on = before.is_some();
    let settings = world.settings;
    let checkpoints = Checkpoints::new(folder, scene.checkpoint.every, scene.checkpoint.seconds);
    let (first, steps) = (world.steps, scene.time.steps.saturating_sub(world.steps));
    let task = Task { steps, before, kept: Some((&text, checkpoints)) };
    let bar = progress::bar(scene.time.steps, args.quiet);
    bar.set_position(first);
    let pool = scene::pool(threads(args))?;
    let result = pool.install(|| {
        moreau::run::run(&mut world, &mut work, task, &mut observers, stop, |record| {
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
    let written = write_summary(folder, &outcome, &world, pool.current_num_threads());
    if let Some(error) = unwritten {
        drop(observers);
        if !goes_on && outcome.summary.steps() == 0 && checkpoint::last_step(folder).is_none() {
            undo(folder, was_there);
            return Err(Failure::file(format!("{error}; the run could not begin, and its files are removed")));
        }
        let lacks = if written.is_err() { "; summary.json could not be written either" } else { "" };
        return Err(Failure::file(format!("{error}{lacks}; {}", words::whole(&outcome, folder))));
    }
    written?;
    if !args.quiet {
        if goes_on {
            say(&format!("gone on from step {first}\n"))?;
        }
        say(&describe(&outcome, bodies, &settings, folder))?;
    }
    ending(&outcome, scene, folder)?;
    judge(&outcome, args)
}

/// Writes summary.json.
fn write_summary<S: Space<D, N>, const D: usize, const N: usize>(
    folder: &Path,
    outcome: &Outcome,
    world: &World<S, D, N>,
    threads: usize,
) -> Result<(), Failure> {
    let mut summary = outcome.summary.to_json(world.bodies.present(), &world.settings, threads);
    summary["bodies_inserted"] = world.schedule.inserted().into();
    summary["bodies_removed"] = world.schedule.removed().into();
    summary["memory_bytes"] = scene::memory_in_use().into();
    write_whole(&folder.join("summary.json"), format!("{summary:#}\n"))
}
