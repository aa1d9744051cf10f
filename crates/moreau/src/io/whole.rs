//! Files that appear whole or not at all: they are written beside their place and renamed.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Write as _};
use std::path::Path;
use tempfile::NamedTempFile;

/// How names of files begin that have not got their own yet.
const PREFIX: &str = ".moreau-";

/// Returns whether a file of this name is one that has not got its own yet.
pub fn is_temporary(name: &OsStr) -> bool {
    name.to_string_lossy().starts_with(PREFIX)
}

/// Takes out of a folder what programs that were killed left half written.
pub fn sweep(folder: &Path) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if is_temporary(&entry.file_name()) {
            // What cannot be removed does no harm.
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// The folder of a file.
fn folder(path: &Path) -> &Path {
    // A bare file name has the empty path as its parent, which no system call understands.
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A new file beside `path` that is to take its name; it is gone when it is dropped before.
///
/// # Errors
/// Where the folder is missing, read-only or full.
pub fn beside(path: &Path) -> io::Result<NamedTempFile> {
    // An ending of its own kind: programs that write by name look at it.
    let ending = path.extension().map_or_else(String::new, |ending| format!(".{}", ending.to_string_lossy()));
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(&ending);
    // Temporary files are private by default; a result is as readable as any other file under the user's umask.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder(path)).map_err(|error| unnamed(&error))
}

/// Returns an error without the temporary name that it carries. Callers name the file that the user knows.
fn unnamed(error: &io::Error) -> io::Error {
    let text = error.to_string();
    let reason = text.split_once(" at path ").map_or(text.as_str(), |(reason, _)| reason);
    io::Error::new(error.kind(), reason.to_owned())
}

/// Writes `parts` one after the other. The disk is not asked to sync: after the fall of the machine the file may be missing or empty.
///
/// # Errors
/// Where the system refuses; nothing has changed then.
pub fn write(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    filled(path, parts)?.persist(path).map(drop).map_err(|refused| refused.error)
}

/// As [`write()`], and when this returns the file is on the disk, under its name.
///
/// # Errors
/// As there.
pub fn write_to_disk(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    let file = filled(path, parts)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|refused| refused.error)?;
    names_to_disk(folder(path))
}

/// Brings what was written of a file to the disk.
///
/// # Errors
/// Where the system refuses, or the file is not there.
pub fn to_disk(path: &Path) -> io::Result<()> {
    // Not every system syncs a file that is open for reading.
    File::options().append(true).open(path)?.sync_all()
}

/// Brings the names of the files in a folder to the disk.
///
/// # Errors
/// Where the system refuses, or the folder is not there.
pub fn names_to_disk(folder: &Path) -> io::Result<()> {
    // Not every system opens folders.
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

fn filled(path: &Path, parts: &[&[u8]]) -> io::Result<NamedTempFile> {
    let mut file = beside(path)?;
    // The file inside: errors of the outer one carry the temporary name.
    parts.iter().try_for_each(|part| file.as_file_mut().write_all(part))?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_carry_no_temporary_name() {
        let folder = tempfile::tempdir().unwrap();
        let error = beside(&folder.path().join("not/there/steps.csv")).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        assert!(!error.to_string().contains(PREFIX) && !error.to_string().contains("at path"), "{error}");
    }
}
