//! Files that appear whole or not at all.

use super::Error;
use moreau::io::whole;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use tempfile::NamedTempFile;

/// A file beside `path` that is to take its name.
pub(super) fn beside(path: &Path) -> Result<NamedTempFile, Error> {
    whole::beside(path).map_err(|source| failed(path, source))
}

/// Gives the file its name.
pub(super) fn rename(file: NamedTempFile, path: &Path) -> Result<(), Error> {
    file.persist(path).map(drop).map_err(|e| failed(path, e.error))
}

/// Writes a whole file.
pub(super) fn write(path: &Path, content: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<(), Error> {
    let file = beside(path)?;
    let mut out = BufWriter::new(file.as_file());
    content(&mut out).and_then(|()| out.flush()).map_err(|source| failed(path, source))?;
    drop(out);
    rename(file, path)
}

pub(super) fn failed(path: &Path, source: io::Error) -> Error {
    Error::Write { path: path.to_owned(), source }
}
