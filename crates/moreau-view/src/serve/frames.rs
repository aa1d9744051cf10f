//! Meta data and blocks of frames, read from the folder of a run that may still grow.

use crate::recording::{Recording, RecordingError, block};
use crate::report::blocks;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};
use std::time::Duration;

/// Number of attempts to read a file that the run may be writing, and the time between two of them.
const TRIES: u32 = 25;
const BETWEEN: Duration = Duration::from_millis(20);

/// The recording of a run, shared by requests.
pub(super) struct Frames {
    folder: PathBuf,
    /// Opened by the first request: a run that has just begun has no file yet.
    recording: Mutex<Option<Recording>>,
}

impl Frames {
    /// The frames of the run in a folder.
    pub(super) fn new(folder: PathBuf) -> Self {
        Self { folder, recording: Mutex::new(None) }
    }

    /// Returns what the page knows before it sees a frame, as JSON. `live` is true if the run goes on.
    pub(super) fn meta(&self, live: bool) -> Result<Vec<u8>, RecordingError> {
        self.read(live, |recording| {
            recording.renew()?;
            let frames = all(recording);
            Ok(recording.meta(&frames, &blocks(recording, &frames), 1, live).to_string().into_bytes())
        })
    }

    /// Returns a block of frames, or nothing if there are fewer blocks.
    pub(super) fn block(&self, number: usize, live: bool) -> Result<Option<Vec<u8>>, RecordingError> {
        self.read(live, |recording| {
            recording.renew_frames()?;
            let frames = all(recording);
            let blocks = blocks(recording, &frames);
            let Some(range) = blocks.get(number) else { return Ok(None) };
            Ok(Some(block(&recording.trajectory, &frames[range.clone()])?))
        })
    }

    /// Reads, and repeats a read that fails while the run goes on. Other requests have their turn between two attempts.
    fn read<T>(&self, live: bool, read: impl Fn(&mut Recording) -> Result<T, RecordingError>) -> Result<T, RecordingError> {
        for _ in 1..TRIES {
            match self.read_once(&read) {
                Err(_) if live => std::thread::sleep(BETWEEN),
                done => return done,
            }
        }
        self.read_once(&read)
    }

    fn read_once<T>(&self, read: impl Fn(&mut Recording) -> Result<T, RecordingError>) -> Result<T, RecordingError> {
        let mut recording = self.lock();
        match &mut *recording {
            Some(recording) => read(recording),
            none => read(none.insert(Recording::open(&self.folder)?)),
        }
    }

    /// Locks the recording. One that a panic left half-way is forgotten, and opened again.
    fn lock(&self) -> MutexGuard<'_, Option<Recording>> {
        self.recording.lock().unwrap_or_else(|poisoned| {
            let mut recording = poisoned.into_inner();
            *recording = None;
            self.recording.clear_poison();
            recording
        })
    }
}

fn all(recording: &Recording) -> Vec<usize> {
    (0..recording.trajectory.frames()).collect()
}
