//! A collection of files with their times (`.pvd`), which ParaView opens as one animated source.

use std::fmt::Write as _;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::{VtkError, check, file};
use crate::io::whole;

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n\
    <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
const TAIL: &str = "  </Collection>\n</VTKFile>\n";

/// The frames of a run so far, and the `.pvd` file that lists them.
///
/// Push a frame once its own file is there: the list on disk then names nothing that is not. Where frames come fast, save now and
/// then and at the end rather than after each: a save writes the whole list, about 70 bytes a frame, and puts it in the place of
/// another file, for which some file systems wait for the disk. The text of the entries is kept, so nothing is formatted twice.
#[derive(Clone, Debug)]
pub struct Series {
    path: PathBuf,
    entries: String,
    len: usize,
}

impl Series {
    /// An empty collection that will be saved at `path` (`NAME.pvd`). Nothing is written yet.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), entries: String::new(), len: 0 }
    }

    /// Adds a frame: its time, and its file relative to the folder of the collection, with `/` between folders.
    ///
    /// # Errors
    /// The time is not finite, or the file name is empty or has control characters; the collection stays as it was.
    pub fn push(&mut self, time: f64, file: &str) -> Result<(), VtkError> {
        check::time(&self.path, time)?;
        check::name(&self.path, file)?;
        let name = file::escape(file);
        // `{:?}` gives the fewest digits that read back as the same number, with an exponent where that is shorter.
        let _ = writeln!(self.entries, "    <DataSet timestep=\"{time:?}\" part=\"0\" file=\"{name}\"/>");
        self.len += 1;
        Ok(())
    }

    /// Takes over the frames of the collection on the disk, if there is one, as far as `keep` says so of their files.
    ///
    /// # Errors
    /// Where it cannot be read or was not written by a series, or a file that it names and that is kept is not there.
    pub fn load(&mut self, keep: impl Fn(&str) -> bool) -> Result<(), VtkError> {
        let wrong = |source| VtkError::Unreadable { path: self.path.clone(), source };
        let text = match std::fs::read_to_string(&self.path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
            Err(error) => return Err(wrong(error)),
        };
        let invalid = |what: String| wrong(std::io::Error::new(ErrorKind::InvalidData, what));
        let entries = text.strip_prefix(HEAD).and_then(|text| text.strip_suffix(TAIL));
        let (mut kept, mut len) = (String::new(), 0);
        for line in entries.ok_or_else(|| invalid("it is no collection of a run".to_owned()))?.lines() {
            let file = line.split("file=\"").nth(1).and_then(|rest| rest.strip_suffix("\"/>"));
            let file = file.ok_or_else(|| invalid(format!("the line `{line}` names no file")))?;
            if keep(file) {
                if !self.path.with_file_name(file).is_file() {
                    return Err(invalid(format!("it names {file}, which is not there")));
                }
                kept += line;
                kept.push('\n');
                len += 1;
            }
        }
        (self.entries, self.len) = (kept, len);
        Ok(())
    }

    /// Writes the collection as it stands, replacing what was there.
    ///
    /// # Errors
    /// The file cannot be written; the error names it.
    pub fn save(&self) -> Result<(), VtkError> {
        let parts = [HEAD.as_bytes(), self.entries.as_bytes(), TAIL.as_bytes()];
        whole::write(&self.path, &parts).map_err(|source| VtkError::io(&self.path, source))
    }

    /// Where the collection is saved.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The number of frames.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no frame yet.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }
}
