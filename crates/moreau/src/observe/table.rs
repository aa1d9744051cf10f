//! A CSV file that grows by a row at a time.

use super::OutputError;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};

/// The file, and the row at hand.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    file: BufWriter<File>,
    /// The row at hand, with the end of its line.
    pub(super) row: String,
}

impl Table {
    /// Creates the file with its header.
    ///
    /// # Errors
    /// Where it cannot be created.
    pub(super) fn create(path: &Path, header: &str) -> Result<Self, OutputError> {
        let file = File::create(path).map_err(OutputError::io(path))?;
        let mut table = Self { path: path.to_owned(), file: BufWriter::new(file), row: format!("{header}\n") };
        table.put()?;
        Ok(table)
    }

    /// Writes the row at hand; the file has it when some more have come, or at the end.
    pub(super) fn put(&mut self) -> Result<(), OutputError> {
        self.file.write_all(self.row.as_bytes()).map_err(OutputError::io(&self.path))
    }

    /// Puts into the file what it does not have yet.
    pub(super) fn finish(&mut self) -> Result<(), OutputError> {
        self.file.flush().map_err(OutputError::io(&self.path))
    }
}
