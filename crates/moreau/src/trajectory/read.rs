//! Reading a trajectory, also of a run that goes on or was killed.

use super::{FORMAT, Header, PAIRS, REALS, TrajectoryError, VERSION, motion_number, widths};
use crate::bodies::Motion;
use crate::observe::COLUMNS;
use hdf5_pure::{AttrValue, Dataset, Error, File};
use std::path::{Path, PathBuf};

/// A trajectory as it was when it was opened: what came since is not in it.
pub struct Trajectory {
    path: PathBuf,
    file: File,
    header: Header,
    step: Vec<u64>,
    time: Vec<f64>,
    /// Contacts of all frames to the end of each.
    contacts: Vec<u64>,
}

/// One frame; see [`super`] for the order of numbers and for units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrajectoryFrame {
    /// The number of the step.
    pub step: u64,
    /// s.
    pub time: f64,
    /// `D` numbers a body.
    pub position: Vec<f64>,
    /// 4 or 2 a body.
    pub rotation: Vec<f64>,
    /// `D` a body.
    pub velocity: Vec<f64>,
    /// 3 or 1 a body.
    pub spin: Vec<f64>,
    /// One a body: 0 absent, 1 held or driven, 2 free.
    pub motion: Vec<u8>,
    /// First and second body of each contact.
    pub pairs: [Vec<u32>; 2],
    /// `D` a contact.
    pub point: Vec<f64>,
    /// `D` a contact.
    pub normal: Vec<f64>,
    /// `D` a contact.
    pub impulse: Vec<f64>,
    /// One a contact.
    pub gap: Vec<f64>,
    /// One a contact.
    pub status: Vec<u8>,
}

impl TrajectoryFrame {
    /// Whether body `i` is there and moves by forces and contacts.
    pub fn is_free(&self, i: usize) -> bool {
        self.motion[i] == motion_number(Motion::Free)
    }
}

impl Trajectory {
    /// Opens a file.
    ///
    /// # Errors
    /// Where it cannot be read, or is no trajectory, or one of a later version.
    pub fn open(path: &Path) -> Result<Self, TrajectoryError> {
        let wrong = |error: Error| TrajectoryError::new(path, error);
        let length = std::fs::metadata(path).map_err(|error| TrajectoryError::new(path, error))?.len();
        let file = File::open_streaming(path).map_err(wrong)?;
        holds(&file, path, length)?;
        let header = header(&file, path)?;
        let step = read(&file, path, "frames/step", Dataset::read_u64)?;
        let frames = step.len() as u64;
        let time = read(&file, path, "frames/time", |set| set.read_f64_rows(0, frames))?;
        let contacts = read(&file, path, "frames/contacts", |set| set.read_u64_rows(0, frames))?;
        if contacts.len() != step.len() || time.len() != step.len() || !contacts.is_sorted() {
            return Err(TrajectoryError::new(path, "frames/step, frames/time and frames/contacts do not fit each other"));
        }
        Ok(Self { path: path.to_owned(), file, header, step, time, contacts })
    }

    /// What does not change.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// How many frames there are.
    pub fn frames(&self) -> usize {
        self.step.len()
    }

    /// Their numbers of steps.
    pub fn steps(&self) -> &[u64] {
        &self.step
    }

    /// Their times, s.
    pub fn times(&self) -> &[f64] {
        &self.time
    }

    /// How many contacts frame `i` has.
    pub fn contacts(&self, i: usize) -> u64 {
        self.contacts[i] - self.first_contact(i)
    }

    fn first_contact(&self, i: usize) -> u64 {
        if i == 0 { 0 } else { self.contacts[i - 1] }
    }

    /// Reads frame `i`.
    ///
    /// # Errors
    /// Where there is no such frame, or the file cannot be read or is damaged.
    pub fn frame(&self, i: usize) -> Result<TrajectoryFrame, TrajectoryError> {
        if i >= self.frames() {
            return Err(TrajectoryError::new(&self.path, format!("there is no frame {i}: it has {}", self.frames())));
        }
        let bodies = self.header.radius.len() as u64;
        let (first, count) = (self.first_contact(i), self.contacts(i));
        let mut reals = widths(self.header.dimension).into_iter().zip(REALS).map(|(width, name)| {
            let width = width as u64;
            let (start, rows) = if name.starts_with("frames/") { (i as u64 * bodies, bodies) } else { (first, count) };
            self.numbers(name, [start * width, rows * width], Dataset::read_f64_rows)
        });
        let mut next = || reals.next().unwrap_or_else(|| Ok(Vec::new()));
        let (position, rotation, velocity, spin) = (next()?, next()?, next()?, next()?);
        let (point, normal, impulse, gap) = (next()?, next()?, next()?, next()?);
        let [a, b] = PAIRS.map(|name| self.numbers(name, [first, count], Dataset::read_u32_rows));
        let motion = self.numbers("frames/motion", [i as u64 * bodies, bodies], Dataset::read_u8_rows)?;
        let status = self.numbers("contacts/status", [first, count], Dataset::read_u8_rows)?;
        let (step, time, pairs) = (self.step[i], self.time[i], [a?, b?]);
        if pairs.iter().flatten().any(|&body| u64::from(body) >= bodies) {
            return Err(TrajectoryError::new(&self.path, format!("frame {i} has a contact of a body that does not exist")));
        }
        Ok(TrajectoryFrame { step, time, position, rotation, velocity, spin, motion, pairs, point, normal, impulse, gap, status })
    }

    /// The records of steps, a column after the other as in `steps.csv`.
    ///
    /// # Errors
    /// Where the file cannot be read.
    pub fn columns(&self) -> Result<Vec<Vec<f64>>, TrajectoryError> {
        let rows = self.rows_until(u64::MAX)?;
        Ok((0..COLUMNS.len()).map(|k| rows.iter().map(|row| row[k]).collect()).collect())
    }

    /// The records of steps up to this one.
    pub(super) fn rows_until(&self, last: u64) -> Result<Vec<[f64; COLUMNS.len()]>, TrajectoryError> {
        let numbers = read(&self.file, &self.path, "steps", Dataset::read_f64)?;
        let (rows, _) = numbers.as_chunks();
        Ok(rows.iter().take_while(|row: &&[f64; COLUMNS.len()]| row[0] <= last as f64).copied().collect())
    }

    /// Some numbers of a dataset, from one on.
    fn numbers<T>(
        &self,
        name: &str,
        [start, count]: [u64; 2],
        get: impl Fn(&Dataset, u64, u64) -> Result<Vec<T>, Error>,
    ) -> Result<Vec<T>, TrajectoryError> {
        let values = read(&self.file, &self.path, name, |set| get(set, start, count))?;
        if values.len() as u64 == count {
            return Ok(values);
        }
        Err(TrajectoryError::new(&self.path, format!("{name} ends before a frame that frames/step has")))
    }
}

fn read<T>(file: &File, path: &Path, name: &str, get: impl Fn(&Dataset) -> Result<T, Error>) -> Result<T, TrajectoryError> {
    file.dataset(name).and_then(|set| get(&set)).map_err(|error| TrajectoryError::new(path, format!("{name}: {error}")))
}

/// How many bytes one byte of a file may stand for: deflate never makes more than 1 032 of one.
const EXPANSION: u64 = 1100;

/// How many bytes may be claimed beside that, by files of which little is compressed: one mebibyte.
const FLOOR: u64 = 1 << 20;

/// Refuses a file of which a dataset claims more than its `length` in bytes can hold, before memory for it is taken.
pub(super) fn holds(file: &File, path: &Path, length: u64) -> Result<(), TrajectoryError> {
    let room = length.saturating_mul(EXPANSION).saturating_add(FLOOR);
    let bodies = ["bodies/radius", "bodies/mass", "bodies/material", "bodies/free"];
    let steps = ["frames/step", "frames/time", "frames/contacts", "frames/motion", "contacts/status", "steps"];
    for name in REALS.into_iter().chain(PAIRS).chain(bodies).chain(steps) {
        // One that is not there is found where it is read.
        let Ok(set) = file.dataset(name) else { continue };
        let shape = set.shape().map_err(|error| TrajectoryError::new(path, format!("{name}: {error}")))?;
        let count = shape.iter().fold(1_u64, |count, &size| count.saturating_mul(size));
        if count > room {
            let message =
                format!("{name} claims {count} numbers, which the {length} bytes of the file cannot hold: it is damaged");
            return Err(TrajectoryError::new(path, message));
        }
    }
    Ok(())
}

/// A whole number, of whatever length another program has written it.
fn integer(value: &AttrValue) -> Option<i64> {
    match value {
        AttrValue::I32(x) => Some(i64::from(*x)),
        AttrValue::U32(x) => Some(i64::from(*x)),
        AttrValue::I64(x) => Some(*x),
        AttrValue::U64(x) => i64::try_from(*x).ok(),
        _ => None,
    }
}

/// A text, of whatever kind: as long as it is, padded, of variable length, or a list of one.
fn text(value: &AttrValue) -> Option<String> {
    match value {
        AttrValue::String(text)
        | AttrValue::AsciiString(text)
        | AttrValue::VarLenString(text)
        | AttrValue::VarLenAsciiString(text) => Some(text.clone()),
        AttrValue::StringSized { value, .. } | AttrValue::AsciiStringSized { value, .. } => Some(value.clone()),
        AttrValue::StringArray(texts) | AttrValue::AsciiStringArray(texts) | AttrValue::VarLenStringArray(texts) => {
            texts.first().filter(|_| texts.len() == 1).cloned()
        }
        _ => None,
    }
}

fn header(file: &File, path: &Path) -> Result<Header, TrajectoryError> {
    let attributes = file.root().attrs().map_err(|error| TrajectoryError::new(path, error))?;
    let integer = |name: &str| attributes.get(name).and_then(integer);
    let text = |name: &str| attributes.get(name).and_then(text);
    if text("format").as_deref() != Some(FORMAT) {
        return Err(TrajectoryError::new(
            path,
            format!("it has no attribute format with the value {FORMAT:?}: it is no trajectory"),
        ));
    }
    let version = integer("version").unwrap_or(0);
    if version != VERSION {
        return Err(TrajectoryError::new(path, format!("it is of version {version}; this program reads version {VERSION}")));
    }
    let dimension = match integer("dimension") {
        Some(dimension @ (2 | 3)) => dimension as usize,
        other => return Err(TrajectoryError::new(path, format!("its dimension is {other:?}; 2 or 3 is right"))),
    };
    let step = if let Some(AttrValue::F64(step)) = attributes.get("step") { *step } else { f64::NAN };
    let radius = read(file, path, "bodies/radius", Dataset::read_f64)?;
    let mass = read(file, path, "bodies/mass", Dataset::read_f64)?;
    let material = read(file, path, "bodies/material", Dataset::read_u16)?;
    let free: Vec<bool> = read(file, path, "bodies/free", Dataset::read_u8)?.into_iter().map(|free| free != 0).collect();
    if [mass.len(), material.len(), free.len()] != [radius.len(); 3] {
        return Err(TrajectoryError::new(path, "the datasets of bodies are not of one length"));
    }
    let every = integer("every").and_then(|every| u64::try_from(every).ok()).unwrap_or(1);
    Ok(Header { dimension, title: text("title").unwrap_or_default(), step, every, radius, mass, material, free })
}
