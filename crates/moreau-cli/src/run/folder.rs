//! The folder of a run: which one it is, who may write into it, and what is taken out of it before.
//!
//! A run begins in an empty folder, which it marks (`marker.rs`). One that holds anything is refused. With `--force` the files that its marker
//! lists are removed first; a folder without a marker is refused all the same.

use crate::failure::{Failure, writable};
use crate::marker::{self, Marker};
use moreau::io::whole;
use std::fs::{self, File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Names of a folder that a message tells.
const SHOWN: usize = 4;

/// Makes the folder and claims it; see [`hold`].
pub(super) fn claim(folder: &Path) -> Result<Option<File>, Failure> {
    fs::create_dir_all(folder).map_err(|error| wrong(folder, &error))?;
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

/// Makes the first of the folders FOLDER, FOLDER-2, FOLDER-3, … that does not exist, and returns it.
pub(super) fn numbered(folder: &Path) -> Result<PathBuf, Failure> {
    let Some(name) = folder.file_name() else {
        return Err(Failure::usage(format!("--new: {} has no name that a number could follow", folder.display())));
    };
    let above = folder.parent().filter(|above| !above.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::create_dir_all(above).map_err(|error| wrong(above, &error))?;
    let mut next = folder.to_owned();
    for number in 2_u64.. {
        // Of two programs that try at the same time one makes it.
        match fs::create_dir(&next) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                let mut name = name.to_owned();
                name.push(format!("-{number}"));
                next = folder.with_file_name(name);
            }
            Err(error) => return Err(wrong(&next, &error)),
            Ok(()) => break,
        }
    }
    Ok(next)
}

/// Makes a claimed folder ready for a new run of the scene in a file: empty but for what is the user's, and marked.
pub(super) fn prepare(folder: &Path, scene: &Path, force: bool) -> Result<(), Failure> {
    let names = names(folder);
    if !names.is_empty() {
        let marker = Marker::read(folder);
        match marker.filter(|_| force) {
            Some(marker) => clear(folder, scene, &marker)?,
            None => return Err(refused(folder, &names, force)),
        }
    }
    whole::sweep(folder);
    whole::sweep(&folder.join("vtk"));
    Marker::new().write(folder)
}

/// Makes a claimed folder ready for one file of the program's own: it is a run's, or empty.
pub(super) fn prepare_beside_a_run(folder: &Path) -> Result<(), Failure> {
    let names = names(folder);
    match Marker::read(folder) {
        Some(_) => Ok(()),
        None if names.is_empty() => Marker::new().write(folder),
        None => Err(refused(folder, &names, false)),
    }
}

/// Removes the files of a run that could not begin, and the folder unless it was there before.
pub(super) fn undo(folder: &Path, was_there: bool) {
    // What cannot be removed is found by its marker, which goes last.
    if Marker::new().files(folder).iter().all(|path| fs::remove_file(path).is_ok()) {
        let _ = fs::remove_dir(folder.join("vtk"));
        leave(folder, was_there);
    }
}

/// Removes the folder of a run that could not begin, unless it was there before or holds something.
pub(super) fn leave(folder: &Path, was_there: bool) {
    if !was_there {
        let _ = fs::remove_dir(folder);
    }
}

/// The names in a folder, but for those that programs which were killed left half written, and for a marker that marks nothing yet.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.file_name());
    let mut names: Vec<String> =
        entries.filter(|name| !whole::is_temporary(name)).map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    if names == [marker::NAME] && Marker::read(folder).is_some() { Vec::new() } else { names }
}

/// Says what is in the folder and what can be done.
fn refused(folder: &Path, names: &[String], force: bool) -> Failure {
    let more = names.len().saturating_sub(SHOWN);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let holds = format!("it holds {}{more}", names[..names.len().min(SHOWN)].join(", "));
    let place = folder.display();
    let elsewhere = "choose another folder with --out, or have a numbered one made with --new";
    let advice = if Marker::read(folder).is_some() {
        format!("go on with its run (moreau run --resume {place}), replace its run with --force, or {elsewhere}")
    } else if force {
        format!("--force removes nothing there, for it has no {} of a run; {elsewhere}", marker::NAME)
    } else {
        format!("nothing of it is overwritten; {elsewhere}")
    };
    Failure::file(format!("cannot write into {place}: {holds}; {advice}"))
}

/// Removes the files that the marker lists. Nothing is removed before it is sure that all can be written, and never the scene to run.
fn clear(folder: &Path, scene: &Path, marker: &Marker) -> Result<(), Failure> {
    ["scene.toml", "summary.json", "steps.csv", "measures.csv", "trajectory.h5", "convergence.csv", marker::NAME]
        .iter()
        .try_for_each(|name| writable(&folder.join(name)))?;
    let vtk = folder.join("vtk");
    if vtk.symlink_metadata().is_ok() {
        if !vtk.is_dir() || vtk.is_symlink() {
            return Err(wrong(&vtk, &"it is not a folder"));
        }
        writable(&vtk.join("bodies.pvd"))?;
    }
    let files = marker.files(folder);
    let scene = scene.canonicalize().ok();
    if let Some(same) = files.iter().find(|path| scene.is_some() && path.canonicalize().ok() == scene) {
        return Err(wrong(same, &"it is the scene to run, which would be removed"));
    }
    for path in files.iter().filter(|path| path.file_name().is_none_or(|name| name != marker::NAME)) {
        match fs::remove_file(path) {
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(wrong(path, &error)),
            _ => {}
        }
    }
    // One with files of the user's stays.
    let _ = fs::remove_dir(vtk);
    Ok(())
}
