//! Files that cannot be read.

use crate::scene::error::Fault;
use crate::scene::path::KeyPath;
use std::fmt::Display;
use std::path::Path;

/// Whether there is a file: a device or a pipe might have no end.
pub(super) fn is_file(place: &Path, path: &KeyPath) -> Result<(), Fault> {
    match std::fs::metadata(place) {
        Ok(found) if found.is_file() => Ok(()),
        Ok(_) => Err(fault(path, place, &"it is not a file")),
        Err(error) => Err(fault(path, place, &error)),
    }
}

pub(super) fn fault(path: &KeyPath, place: &Path, error: &dyn Display) -> Fault {
    let hint = "expected a file, by its path from the folder of the scene";
    Fault::new(path.clone(), format!("cannot read {}: {error}", place.display()), hint)
}
