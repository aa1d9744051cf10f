//! Who writes what a scene asks for.

use super::resume;
use crate::failure::Failure;
use moreau::checkpoint::Mark;
use moreau::observe::{FailedProblems, MeasuresCsv, Observer, StepsCsv, TrajectoryOutput, VtkOutput};
use moreau::scene::{OutputKind, Scene};
use moreau::space::Space;
use moreau::world::{OnFailure, World};
use std::path::Path;

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
    // A run makes a missing file anew.
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
