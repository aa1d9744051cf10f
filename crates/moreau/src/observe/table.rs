//! A CSV file that grows by a row at a time.

use super::OutputError;
use crate::checkpoint::{Mark, Sum};
use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

/// So many bytes are written together.
const ENOUGH: usize = 1 << 13;

/// The file, and the row at hand.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    file: File,
    /// Whole rows that the file does not have yet.
    waiting: Vec<u8>,
    /// Bytes of whole rows that the file has.
    written: u64,
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
            let mut piece = vec![0; 1 << 16];
            while table.length < mark.length {
                let wanted = (mark.length - table.length).min(piece.len() as u64) as usize;
                let read = table.file.read(&mut piece[..wanted])?;
                if read == 0 {
                    return Ok(None);
                }
                table.sum.add(&piece[..read]);
                table.length += read as u64;
            }
            if !mark.knows(&table.sum.now()) {
                return Ok(None);
            }
            table.file.set_len(mark.length)?;
            table.written = table.file.seek(SeekFrom::Start(mark.length))?;
            Ok(Some(table))
        };
        again().map_err(OutputError::io(path))?.ok_or_else(|| OutputError::Changed { path: path.to_owned() })
    }

    fn of(path: &Path, file: File, row: String) -> Self {
        Self { path: path.to_owned(), file, waiting: Vec::new(), written: 0, row, length: 0, sum: Sum::default() }
    }

    /// Writes the row at hand; the file has it when some more have come, or at the end.
    pub(super) fn put(&mut self) -> Result<(), OutputError> {
        self.length += self.row.len() as u64;
        self.sum.add(self.row.as_bytes());
        self.waiting.extend_from_slice(self.row.as_bytes());
        if self.waiting.len() < ENOUGH { Ok(()) } else { self.finish() }
    }

    /// Brings all to the disk, and gives the mark by which the file is known again.
    pub(super) fn sync(&mut self) -> Result<Mark, OutputError> {
        self.finish()?;
        self.file.sync_data().map_err(OutputError::io(&self.path))?;
        let name = self.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Mark::new(name, self.length, self.sum.now()))
    }

    /// Puts into the file what it does not have yet.
    pub(super) fn finish(&mut self) -> Result<(), OutputError> {
        let done = self.file.write_all(&self.waiting);
        match done {
            Ok(()) => self.written += self.waiting.len() as u64,
            // Half a row would be read as a whole one.
            Err(_) => self.cut(),
        }
        self.waiting.clear();
        done.map_err(OutputError::io(&self.path))
    }

    /// Cuts off the part of a row that a full disk has left at the end of the file.
    fn cut(&mut self) {
        let end = self.file.metadata().map_or(self.written, |file| file.len());
        let come = usize::try_from(end.saturating_sub(self.written)).unwrap_or(usize::MAX).min(self.waiting.len());
        let rows = self.waiting[..come].iter().rposition(|&byte| byte == b'\n').map_or(0, |last| last + 1);
        self.written += rows as u64;
        // Where that fails too, the row stays; the next checkpoint that is gone on from cuts it off.
        let _ = self.file.set_len(self.written).and_then(|()| self.file.seek(SeekFrom::Start(self.written)));
    }
}
