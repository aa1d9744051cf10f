//! The folder of a run: what is taken out of it before, and who writes what into it.

use super::resume;
use crate::failure::{Failure, writable};
use moreau::checkpoint::{self, Mark};
use moreau::observe::{FailedProblems, MeasuresCsv, Observer, StepsCsv, TrajectoryOutput, VtkOutput};
use moreau::scene::{OutputKind, Scene};
use moreau::space::Space;
use moreau::world::{OnFailure, World};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

/// Makes the folder and claims it; see [`hold`].
pub(super) fn claim(folder: &Path) -> Result<Option<File>, Failure> {
    std::fs::create_dir_all(folder).map_err(|error| wrong(folder, &error))?;
    hold(folder)
}

/// Makes sure that no other run is at work in a folder until what this gives is dropped. (Where there is no such folder, or a system knows no
/// such thing, nobody looks.)
pub(super) fn hold(folder: &Path) -> Result<Option<File>, Failure> {
    let Ok(handle) = File::open(folder) else { return Ok(None) };
    match handle.try_lock() {
        Err(TryLockError::WouldBlock) => Err(wrong(folder, &"another run is at work there")),
        _ => Ok(Some(handle)),
    }
}

fn wrong(path: &Path, reason: &dyn std::fmt::Display) -> Failure {
    Failure::file(format!("cannot write into {}: {reason}; choose another folder with --out", path.display()))
}

/// Takes an earlier run's files out of the folder: a mixture of two runs would mislead. Nothing is taken before it is
/// sure that all can be written, and never the scene that is being run.
pub(super) fn prepare(folder: &Path, scene: &Path) -> Result<(), Failure> {
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
    let is_kept = |path: &PathBuf| path.file_name().is_some_and(checkpoint::is_name);
    let old = old_frames.filter(is_frame).chain(old_problems.filter(|path| is_problem(path) || is_kept(path)));
    for path in files[1..].iter().cloned().chain(old) {
        match std::fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => return Err(wrong(&path, &error)),
            _ => {}
        }
    }
    Ok(())
}

/// Who writes what the scene asks for; of a run that goes on, with what is known of its files at that step.
pub(super) fn observers<'a, S: Space<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    world: &World<S, D, N>,
    folder: &Path,
    from: Option<(u64, &[Mark])>,
) -> Result<Vec<Box<dyn Observer<S, D, N> + 'a>>, Failure> {
    let mut observers: Vec<Box<dyn Observer<S, D, N> + 'a>> = Vec::new();
    let every = scene.frames_every();
    let wanted = |kind: OutputKind| scene.output.kinds.contains(&kind) && (every > 0 || kind == OutputKind::Steps);
    // A file that is not there any more begins anew.
    let old = |name: &str| from.filter(|_| resume::is_there(folder, name));
    let mark = |name: &str| old(name)?.1.iter().find(|mark| mark.file == name);
    let path = |name: &str| folder.join(name);
    if wanted(OutputKind::Steps) {
        let (name, path) = ("steps.csv", path("steps.csv"));
        let table = mark(name).map_or_else(|| StepsCsv::create(&path), |mark| StepsCsv::resume(&path, mark));
        observers.push(Box::new(table.map_err(Failure::file)?));
    }
    if wanted(OutputKind::Measures) {
        let (name, path) = ("measures.csv", path("measures.csv"));
        let table =
            mark(name).map_or_else(|| MeasuresCsv::create(&path, every, D), |mark| MeasuresCsv::resume(&path, every, mark));
        observers.push(Box::new(table.map_err(Failure::file)?));
    }
    if wanted(OutputKind::Vtk) {
        let path = path("vtk");
        let frames =
            old("vtk").map_or_else(|| VtkOutput::create(&path, every), |(step, _)| VtkOutput::resume(&path, every, step));
        observers.push(Box::new(frames.map_err(Failure::file)?));
    }
    if scene.output.kinds.contains(&OutputKind::Trajectory) {
        let (path, precision) = (path("trajectory.h5"), scene.output.precision);
        let settings = (scene.title.as_deref().unwrap_or_default(), every, precision);
        let trajectory = old("trajectory.h5").map_or_else(
            || TrajectoryOutput::create(&path, world, settings),
            |(step, _)| TrajectoryOutput::resume(&path, (every, precision), step),
        );
        observers.push(Box::new(trajectory.map_err(Failure::file)?));
    }
    if scene.solver.on_failure == OnFailure::Dump || world.guard.dumps() {
        observers.push(Box::new(FailedProblems::new(folder)));
    }
    Ok(observers)
}
