//! `moreau run --resume`: where a run goes on.

use crate::failure::Failure;
use moreau::checkpoint::{self, Checkpoint};
use moreau::scene::{OutputKind, Scene};
use std::path::Path;

/// The scene and the last checkpoint of the run in a folder, with overrides. Checkpoints that are damaged are passed over, with a note.
pub(crate) fn load(folder: &Path, mut sets: Vec<String>) -> Result<(Scene, Checkpoint), Failure> {
    let (checkpoint, passed_over) = checkpoint::newest(folder).map_err(Failure::file)?;
    for error in passed_over {
        Failure::file(error).note("went back to the checkpoint before");
    }
    let name = folder.join("scene.toml").display().to_string();
    let scene = |sets: &[String]| Scene::parse_with(&checkpoint.scene, &name, sets).map_err(Failure::scene);
    let before = scene(&[])?;
    // Frames keep their distance where the run is made longer.
    sets.insert(0, format!("output.every={}", before.frames_every()));
    let after = scene(&sets)?;
    only_own(folder, &before, &after)?;
    Ok((after, checkpoint))
}

/// Refuses to go on where an output that the run did not have before would take the place of a file that is there.
fn only_own(folder: &Path, before: &Scene, after: &Scene) -> Result<(), Failure> {
    for kind in after.output.kinds.iter().filter(|kind| !before.output.kinds.contains(kind)) {
        let path = folder.join(match kind {
            OutputKind::Vtk => "vtk",
            OutputKind::Steps => "steps.csv",
            OutputKind::Trajectory => "trajectory.h5",
            OutputKind::Measures => "measures.csv",
        });
        if path.symlink_metadata().is_ok() {
            let what = "the run up to its checkpoint did not write it; move it away, and the run begins it from here";
            return Err(Failure::file(format!("cannot write {}: {what}", path.display())));
        }
    }
    Ok(())
}

/// Whether a file that the run wrote is there to go on with; a note says where it is not.
pub(crate) fn is_there(folder: &Path, name: &str) -> bool {
    let path = folder.join(name);
    if !path.exists() {
        Failure::file(format!("{} is not there any more", path.display())).note("began it anew from here");
    }
    path.exists()
}
