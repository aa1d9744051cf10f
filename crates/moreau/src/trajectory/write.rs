//! Writing a trajectory.

use super::{Batch, FORMAT, PAIRS, Precision, REALS, Trajectory, TrajectoryError, VERSION, widths};
use crate::io::whole;
use crate::observe::COLUMNS;
use hdf5_pure::{AttrValue, DatasetBuilder, Error, File, FileAccessProperties, FileBuilder, H5Element, MaxExtent, SyncPolicy};
use std::path::{Path, PathBuf};

/// About how many numbers a chunk holds: so much is compressed, and read, at a time.
const CHUNK: usize = 1 << 14;

/// The most numbers that a chunk may hold. hdf5-pure stores the length of a longer one in four bytes where three are enough, which is within the
/// format, and which HDF5 2.0 and 2.1 refuse to read.
const LONGEST: usize = (1 << 16) - 1;

/// How well what is written is compressed: the least, for the run must not wait.
const LEVEL: u32 = 1;

/// What does not change during a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    /// 2 or 3.
    pub dimension: usize,
    /// The scene's.
    pub title: String,
    /// Length of a step, s.
    pub step: f64,
    /// Every how many-th step is a frame.
    pub every: u64,
    /// Bounding radii, m; infinite of what is unbounded.
    pub radius: Vec<f64>,
    /// kg.
    pub mass: Vec<f64>,
    /// Indices of materials.
    pub material: Vec<u16>,
    /// Whether bodies are free at some time of the run.
    pub free: Vec<bool>,
}

/// A file that grows.
pub struct TrajectoryWriter {
    path: PathBuf,
    file: File,
    precision: Precision,
    /// Contacts of all frames so far.
    contacts: u64,
    single: Vec<f32>,
}

impl std::fmt::Debug for TrajectoryWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "TrajectoryWriter({})", self.path.display())
    }
}

impl TrajectoryWriter {
    /// Makes a file without frames.
    ///
    /// # Errors
    /// Where it cannot be made.
    pub fn create(path: &Path, header: &Header, precision: Precision) -> Result<Self, TrajectoryError> {
        Self::create_at(path, path, header, precision)
    }

    /// As [`Self::create`], in the file `at` that errors call `path`.
    fn create_at(at: &Path, path: &Path, header: &Header, precision: Precision) -> Result<Self, TrajectoryError> {
        let is_new = !at.exists();
        let wrong = |error: Error| {
            // Half a head is of no use to anybody; a file that was there before is not ours to remove.
            let _ = if is_new { std::fs::remove_file(at) } else { Ok(()) };
            TrajectoryError::new(path, error)
        };
        layout(header, precision).write(at).map_err(wrong)?;
        // Nothing is forced to the disk before the end: a run that is killed loses no more than what waits here, and a machine that goes down
        // may lose the file.
        let access = FileAccessProperties::new().with_sync_policy(SyncPolicy::OnClose);
        let file = File::open_rw_with_options(at, access).map_err(wrong)?;
        Ok(Self { path: path.to_owned(), file, precision, contacts: 0, single: Vec::new() })
    }

    /// Goes on with the file of a run that was stopped, with frames and rows up to step `last`. They are copied into a new file that takes the
    /// place of the old one: a file that was being written when its run was killed is fit for reading only.
    ///
    /// # Errors
    /// Where it cannot be read or written, or lacks something up to that step; it is then as it was.
    pub fn resume(path: &Path, (every, precision): (u64, Precision), last: u64) -> Result<Self, TrajectoryError> {
        let old = Trajectory::open(path)?;
        let rows = old.rows_until(last)?;
        let frames = old.steps().partition_point(|&step| step <= last);
        let due = last.checked_rem(old.header().every).map(|since| last - since);
        if rows.last().map_or(0.0, |row| row[0]) != last as f64 || old.steps()[..frames].last().copied() != due {
            return Err(TrajectoryError::new(
                path,
                format!("it lacks records or frames up to step {last}; move it away, and the run begins it anew from here"),
            ));
        }
        let wrong = |error: &dyn std::fmt::Display| TrajectoryError::new(path, error);
        let beside = whole::beside(path).map_err(|error| wrong(&error))?.into_temp_path();
        let mut new = Self::create_at(&beside, path, &Header { every, ..old.header().clone() }, precision)?;
        let mut batch = Batch { rows, ..Batch::default() };
        for i in 0..frames {
            batch.push(old.frame(i)?);
            if batch.len() >= CHUNK << 4 {
                new.append(&batch)?;
                batch.clear();
            }
        }
        new.append(&batch)?;
        new.sync()?;
        drop(old);
        beside.persist(path).map_err(|refused| wrong(&refused.error))?;
        Ok(new)
    }

    /// Appends frames and rows; the numbers of steps last, by which readers know which frames are whole.
    ///
    /// # Errors
    /// Where they cannot be written.
    pub fn append(&mut self, batch: &Batch) -> Result<(), TrajectoryError> {
        self.put(batch).map_err(|error| TrajectoryError::new(&self.path, error))
    }

    fn put(&mut self, batch: &Batch) -> Result<(), Error> {
        let file = &self.file;
        for (name, values) in REALS.iter().zip(&batch.reals) {
            match self.precision {
                Precision::Double => grow(file, name, values)?,
                Precision::Single => {
                    self.single.clear();
                    self.single.extend(values.iter().map(|&x| x as f32));
                    grow(file, name, &self.single)?;
                }
            }
        }
        for (name, values) in PAIRS.iter().zip(&batch.pairs) {
            grow(file, name, values)?;
        }
        grow(file, "frames/motion", &batch.motion)?;
        grow(file, "contacts/status", &batch.status)?;
        grow(file, "steps", batch.rows.as_flattened())?;
        grow(file, "frames/time", &batch.time)?;
        let mut end = self.contacts;
        let ends = batch.contacts.iter().map(|count| {
            end += count;
            end
        });
        grow(file, "frames/contacts", &ends.collect::<Vec<u64>>())?;
        self.contacts = end;
        grow(file, "frames/step", &batch.step)
    }

    /// Brings what was appended to the disk.
    ///
    /// # Errors
    /// Where the system refuses.
    pub fn sync(&self) -> Result<(), TrajectoryError> {
        self.file.sync().map_err(|error| TrajectoryError::new(&self.path, error))
    }

    /// Completes the file.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn finish(self) -> Result<(), TrajectoryError> {
        self.file.close().map_err(|error| TrajectoryError::new(&self.path, error))
    }
}

fn grow<T: H5Element>(file: &File, name: &str, values: &[T]) -> Result<(), Error> {
    if values.is_empty() { Ok(()) } else { file.dataset(name)?.append(values) }
}

/// The file without frames.
fn layout(header: &Header, precision: Precision) -> FileBuilder {
    let mut file = FileBuilder::new();
    file.set_attr("format", AttrValue::String(FORMAT.to_owned()));
    file.set_attr("version", AttrValue::I64(VERSION));
    file.set_attr("dimension", AttrValue::I64(header.dimension as i64));
    file.set_attr("title", AttrValue::String(header.title.clone()));
    file.set_attr("step", AttrValue::F64(header.step));
    file.set_attr("every", AttrValue::U64(header.every));
    file.set_attr("columns", AttrValue::String(COLUMNS.join(",")));
    let mut bodies = file.create_group("bodies");
    fixed(bodies.create_dataset("radius"), &header.radius);
    fixed(bodies.create_dataset("mass"), &header.mass);
    fixed(bodies.create_dataset("material"), &header.material);
    fixed(bodies.create_dataset("free"), &header.free.iter().map(|&free| u8::from(free)).collect::<Vec<_>>());
    file.add_group(bodies.finish());
    let count = header.radius.len();
    let mut frames = file.create_group("frames");
    let mut contacts = file.create_group("contacts");
    for (name, width) in REALS.iter().zip(widths(header.dimension)) {
        let (of_frames, name) = name.split_once('/').map_or((false, *name), |(group, name)| (group == "frames", name));
        let chunk = whole_rows(if of_frames { count * width } else { width });
        let group = if of_frames { &mut frames } else { &mut contacts };
        match precision {
            Precision::Single => growing(group.create_dataset(name), &[0_f32; 0], chunk),
            Precision::Double => growing(group.create_dataset(name), &[0_f64; 0], chunk),
        }
    }
    growing(frames.create_dataset("motion"), &[0_u8; 0], whole_rows(count));
    growing(frames.create_dataset("step"), &[0_u64; 0], CHUNK >> 4);
    growing(frames.create_dataset("time"), &[0_f64; 0], CHUNK >> 4);
    growing(frames.create_dataset("contacts"), &[0_u64; 0], CHUNK >> 4);
    growing(contacts.create_dataset("a"), &[0_u32; 0], CHUNK);
    growing(contacts.create_dataset("b"), &[0_u32; 0], CHUNK);
    growing(contacts.create_dataset("status"), &[0_u8; 0], CHUNK);
    file.add_group(frames.finish());
    file.add_group(contacts.finish());
    growing(file.create_dataset("steps"), &[0_f64; 0], CHUNK);
    file
}

/// The length of chunks that hold whole rows of `one` number each, where rows are short enough.
fn whole_rows(one: usize) -> usize {
    if one > LONGEST { part(one) } else { (one * (CHUNK / one.max(1)).max(1)).max(1) }
}

/// The length of equal parts of `count` numbers, none longer than a chunk may be; without a rest where a few more parts allow it, so that a frame
/// ends with a chunk, and the next one does not write that again.
fn part(count: usize) -> usize {
    let least = count.div_ceil(LONGEST).max(1);
    count.div_ceil((least..4 * least).find(|&parts| count.is_multiple_of(parts)).unwrap_or(least))
}

/// A dataset that stays as it is, with a checksum.
fn fixed<T: H5Element>(dataset: &mut DatasetBuilder, values: &[T]) {
    let dataset = dataset.with_data(values);
    if !values.is_empty() {
        dataset.with_chunks(&[part(values.len()) as u64]).with_fletcher32();
    }
}

/// A dataset that is appended to. What is compressed has a checksum.
fn growing<T: H5Element>(dataset: &mut DatasetBuilder, none: &[T], chunk: usize) {
    let dataset = dataset.with_data(none).with_shape(&[0]).with_maxshape(&[MaxExtent::Unlimited]);
    dataset.with_chunks(&[chunk as u64]).with_shuffle().with_deflate(LEVEL);
}
