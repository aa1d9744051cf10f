//! The marker `run.json` tells that a folder is a run's. It holds the version of the program that made the folder and the names of the files
//! that the program makes there. `--force` removes files of these names and no others.

use crate::failure::{Failure, write_whole};
use serde_json::{Value, json};
use std::fs;
use std::path::{Component, Path, PathBuf};

/// The name of the marker.
pub(crate) const NAME: &str = "run.json";

/// The version of the marker's layout.
const LAYOUT: u64 = 1;

/// What stands for the digits of a step in names.
const STEP: &str = "{step}";

/// All files that the program makes in the folder of a run under names of its own, checkpoints first: what is left of a run whose files are
/// removed and who is killed meanwhile must not look like one to go on with.
const FILES: [&str; 20] = [
    "checkpoint-{step}.bin",
    "scene.toml",
    "summary.json",
    "steps.csv",
    "measures.csv",
    "trajectory.h5",
    "failed-step-{step}.hdf5",
    "vtk/bodies.pvd",
    "vtk/bodies_{step}.vtp",
    "vtk/contacts.pvd",
    "vtk/contacts_{step}.vtp",
    "vtk/shapes.pvd",
    "vtk/shapes_{step}.vtp",
    "vtk/interfaces.pvd",
    "vtk/interfaces_{step}.vtp",
    "convergence.csv",
    "report.html",
    "plot.svg",
    "picture.png",
    NAME,
];

/// Names of files of a run, relative to its folder.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Marker(Vec<String>);

impl Marker {
    /// Returns that of a folder which this program fills.
    pub(crate) fn new() -> Self {
        Self(FILES.map(str::to_owned).to_vec())
    }

    /// Reads the marker of a folder. Returns nothing if there is no `run.json`, or if it is not a marker.
    pub(crate) fn read(folder: &Path) -> Option<Self> {
        let marker: Value = serde_json::from_slice(&fs::read(folder.join(NAME)).ok()?).ok()?;
        let is_ours = marker["format"] == "moreau run" && marker["layout"] == LAYOUT;
        let names: Option<Vec<String>> = marker["files"]
            .as_array()?
            .iter()
            .map(|name| name.as_str().filter(|name| is_below(name)).map(str::to_owned))
            .collect();
        names.filter(|_| is_ours).map(Self)
    }

    /// Writes it into a folder.
    ///
    /// # Errors
    /// Where it cannot be written; there is then none, or the one before.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Failure> {
        let marker = json!({ "format": "moreau run", "layout": LAYOUT, "version": env!("CARGO_PKG_VERSION"), "files": self.0 });
        write_whole(&folder.join(NAME), format!("{marker:#}\n"))
    }

    /// Marks the folder of a run that goes on, which a program before the marker may have made. A `run.json` of somebody else stays.
    pub(crate) fn add(folder: &Path) -> Result<(), Failure> {
        let old = Self::read(folder);
        if old.is_none() && folder.join(NAME).exists() {
            return Ok(());
        }
        let (mut all, old) = (Self::new(), old.unwrap_or(Self(Vec::new())));
        let unknown: Vec<String> = old.0.iter().filter(|name| !all.0.contains(name)).cloned().collect();
        all.0.extend(unknown);
        if all.0.iter().all(|name| old.0.contains(name)) { Ok(()) } else { all.write(folder) }
    }

    /// Returns whether it lists this name.
    pub(crate) fn lists(&self, name: &str) -> bool {
        self.0.iter().any(|listed| listed == name)
    }

    /// Returns the files in the folder that have one of the names, the marker itself last.
    pub(crate) fn files(&self, folder: &Path) -> Vec<PathBuf> {
        let (marker, names): (Vec<_>, Vec<_>) = self.0.iter().partition(|&name| name == NAME);
        names.into_iter().chain(marker).flat_map(|name| found(folder, name)).collect()
    }
}

/// Whether a name stays in the folder: whatever a marker says, nothing elsewhere is touched.
fn is_below(name: &str) -> bool {
    !name.is_empty() && Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

/// The files of this name that are there. A link is one; what it points to is not followed, and folders on the way must be none.
fn found(folder: &Path, name: &str) -> Vec<PathBuf> {
    let path = folder.join(name);
    let (Some(above), Some(last)) = (path.parent(), Path::new(name).file_name().and_then(|last| last.to_str())) else {
        return Vec::new();
    };
    let is_file = |path: &Path| fs::symlink_metadata(path).is_ok_and(|file| !file.is_dir());
    let is_linked = above != folder && fs::symlink_metadata(above).is_ok_and(|above| above.is_symlink());
    let Some((before, after)) = last.split_once(STEP).filter(|_| !is_linked) else {
        return if is_linked || !is_file(&path) { Vec::new() } else { vec![path] };
    };
    let is_step = |name: &str| {
        let digits = name.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
        digits.is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()))
    };
    let entries = fs::read_dir(above).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> =
        entries.filter(|entry| entry.file_name().to_str().is_some_and(is_step)).map(|entry| entry.path()).collect();
    files.retain(|path| is_file(path));
    files.sort();
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_marker_reads_as_it_was_written_and_names_only_what_is_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        assert_eq!(Marker::read(folder), None);
        Marker::new().write(folder).unwrap();
        assert_eq!(Marker::read(folder), Some(Marker::new()));
        fs::create_dir(folder.join("vtk")).unwrap();
        for name in ["steps.csv", "checkpoint-7.bin", "checkpoint-x.bin", "vtk/bodies_00000005.vtp", "vtk/mine.vtp", "notes"] {
            fs::write(folder.join(name), "").unwrap();
        }
        let files: Vec<PathBuf> = Marker::new().files(folder);
        let ours = ["checkpoint-7.bin", "steps.csv", "vtk/bodies_00000005.vtp", "run.json"].map(|name| folder.join(name));
        assert_eq!(files, ours);
    }

    #[test]
    fn a_marker_that_points_out_of_the_folder_is_none() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["../mine", "/etc/passwd", "", "a/../../b"] {
            Marker(vec![name.to_owned()]).write(folder.path()).unwrap();
            assert_eq!(Marker::read(folder.path()), None, "{name}");
        }
        fs::write(folder.path().join(NAME), "{}").unwrap();
        assert_eq!(Marker::read(folder.path()), None);
    }
}
