//! A CSV file that grows by a row at a time.

use super::OutputError;
use crate::checkpoint::{Mark, Sum};
use std::fs::File;
use std::io::{self, BufWriter, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

/// The file, and the row at hand.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    file: BufWriter<File>,
    /// The row at hand, with the end of its line.
    pub(super) row: String,
    /// Of all rows so far: bytes, and their checksum.
    length: u64,
    sum: Sum,
}

impl Table {
    /// Creates the file with its header.
    ///
    /// # Errors
    /// Where it cannot be created.
    pub(super) fn create(path: &Path, header: &str) -> Result<Self, OutputError> {
        let file = File::create(path).map_err(OutputError::io(path))?;
        let mut table = Self::of(path, file, format!("{header}\n"));
        table.put()?;
        Ok(table)
    }

    /// Goes on with a file of which the mark is known; what is behind it is cut off.
    ///
    /// # Errors
    /// Where it cannot be read and written, or is not what it was.
    pub(super) fn resume(path: &Path, mark: &Mark) -> Result<Self, OutputError> {
        let again = || -> io::Result<Option<Self>> {
            let file = File::options().read(true).write(true).open(path)?;
            let mut table = Self::of(path, file, String::new());
            let (file, mut piece) = (table.file.get_mut(), vec![0; 1 << 16]);
            while table.length < mark.length {
                let wanted = (mark.length - table.length).min(piece.len() as u64) as usize;
                let read = file.read(&mut piece[..wanted])?;
                if read == 0 {
                    return Ok(None);
                }
                table.sum.add(&piece[..read]);
                table.length += read as u64;
            }
            if !mark.knows(&table.sum.now()) {
                return Ok(None);
            }
            file.set_len(mark.length)?;
            file.seek(SeekFrom::Start(mark.length))?;
            Ok(Some(table))
        };
        again().map_err(OutputError::io(path))?.ok_or_else(|| OutputError::Changed { path: path.to_owned() })
    }

    fn of(path: &Path, file: File, row: String) -> Self {
        Self { path: path.to_owned(), file: BufWriter::new(file), row, length: 0, sum: Sum::default() }
    }

    /// Writes the row at hand; the file has it when some more have come, or at the end.
    pub(super) fn put(&mut self) -> Result<(), OutputError> {
        self.length += self.row.len() as u64;
        self.sum.add(self.row.as_bytes());
        self.file.write_all(self.row.as_bytes()).map_err(OutputError::io(&self.path))
    }

    /// Brings all to the disk, and gives the mark by which the file is known again.
    pub(super) fn sync(&mut self) -> Result<Mark, OutputError> {
        self.finish()?;
        self.file.get_ref().sync_data().map_err(OutputError::io(&self.path))?;
        let name = self.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Mark::new(name, self.length, self.sum.now()))
    }

    /// Puts into the file what it does not have yet.
    pub(super) fn finish(&mut self) -> Result<(), OutputError> {
        self.file.flush().map_err(OutputError::io(&self.path))
    }
}
