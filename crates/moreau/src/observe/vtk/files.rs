//! The files of `vtk/`, one frame after the other.

use super::snapshot::Snapshot;
use crate::io::vtk::{PolyData, Series, Writer};
use crate::io::whole;
use crate::observe::{OutputError, background};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How often collections are saved while frames come: each save costs as much as a frame of some hundred bodies.
const SAVED_EVERY: Duration = Duration::from_secs(1);

/// The kinds of files.
const NAMES: [&str; 4] = ["bodies", "contacts", "shapes", "interfaces"];

/// All of them.
#[derive(Debug)]
pub(super) struct Files {
    bodies: Kind,
    contacts: Kind,
    shapes: Kind,
    interfaces: Kind,
    saved: Option<Instant>,
}

impl Files {
    /// Those of `folder`.
    pub(super) fn new(folder: &Path) -> Self {
        let [bodies, contacts, shapes, interfaces] = NAMES.map(|name| Kind::new(folder, name));
        Self { bodies, contacts, shapes, interfaces, saved: None }
    }

    /// Those of `folder` that are there, without frames after step `last`.
    pub(super) fn resume(folder: &Path, last: u64) -> Result<Self, OutputError> {
        let [bodies, contacts, shapes, interfaces] = NAMES.map(|name| Kind::resume(folder, name, last));
        Ok(Self { bodies: bodies?, contacts: contacts?, shapes: shapes?, interfaces: interfaces?, saved: None })
    }
}

impl background::Writer<Snapshot> for Files {
    fn write(&mut self, frame: &Snapshot) -> Result<(), OutputError> {
        self.bodies.write(frame.step, &frame.bodies())?;
        self.contacts.write(frame.step, &frame.contacts())?;
        // Where all bodies are points with a radius these two would say nothing. Once begun they go on, lest an old frame stay in sight.
        if frame.has_shapes() || !self.shapes.series.is_empty() {
            self.shapes.write(frame.step, &frame.shapes())?;
            self.interfaces.write(frame.step, &frame.interfaces())?;
        }
        if self.saved.is_none_or(|saved| saved.elapsed() >= SAVED_EVERY) {
            self.catch_up()?;
        }
        Ok(())
    }

    fn catch_up(&mut self) -> Result<(), OutputError> {
        self.saved = Some(Instant::now());
        self.bodies.save()?;
        self.contacts.save()?;
        self.shapes.save()?;
        self.interfaces.save()
    }

    fn sync(&mut self) -> Result<(), OutputError> {
        self.catch_up()?;
        for kind in [&mut self.bodies, &mut self.contacts, &mut self.shapes, &mut self.interfaces] {
            kind.keep()?;
        }
        let folder = &self.bodies.folder;
        whole::names_to_disk(folder).map_err(OutputError::io(folder))
    }
}

/// The files `NAME_STEP.vtp` and the collection `NAME.pvd`.
#[derive(Debug)]
struct Kind {
    folder: PathBuf,
    name: &'static str,
    writer: Writer,
    series: Series,
    /// How many frames the collection names that is saved.
    saved: usize,
    /// Files of which nobody knows yet that they are on the disk.
    new: Vec<PathBuf>,
}

impl Kind {
    fn new(folder: &Path, name: &'static str) -> Self {
        let series = Series::new(folder.join(name).with_extension("pvd"));
        Self { folder: folder.to_owned(), name, writer: Writer::default(), series, saved: 0, new: Vec::new() }
    }

    fn resume(folder: &Path, name: &'static str, last: u64) -> Result<Self, OutputError> {
        let mut kind = Self::new(folder, name);
        let step = |file: &str| file.strip_prefix(name)?.strip_prefix('_')?.strip_suffix(".vtp")?.parse::<u64>().ok();
        kind.series.load(|file| step(file).is_some_and(|step| step <= last))?;
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            if entry.file_name().to_str().and_then(step).is_some_and(|step| step > last) {
                std::fs::remove_file(entry.path()).map_err(OutputError::io(&entry.path()))?;
            }
        }
        if kind.series.path().exists() {
            kind.series.save()?;
        }
        kind.saved = kind.series.len();
        Ok(kind)
    }

    fn write(&mut self, step: u64, data: &PolyData) -> Result<(), OutputError> {
        let file = format!("{}_{step:08}.vtp", self.name);
        let path = self.folder.join(&file);
        self.writer.write(&path, data)?;
        self.new.push(path);
        Ok(self.series.push(data.time, &file)?)
    }

    /// Saves the collection, if it is not what is on the disk.
    fn save(&mut self) -> Result<(), OutputError> {
        if self.saved < self.series.len() {
            self.series.save()?;
            self.saved = self.series.len();
        }
        Ok(())
    }

    /// Brings the frames since the last time, and the collection, to the disk; those that somebody has taken away meanwhile are not missed.
    fn keep(&mut self) -> Result<(), OutputError> {
        if !self.new.is_empty() {
            self.new.push(self.series.path().to_owned());
        }
        self.new.drain(..).try_for_each(|path| match whole::to_disk(&path) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(OutputError::io(&path)(error)),
            _ => Ok(()),
        })
    }
}
