//! `trajectory.h5`: every n-th step and the records of all, as [`crate::trajectory`] says.
//!
//! A frame is copied out of the world and handed to a thread that compresses and writes it while the run goes on.

use super::background::{self, Background};
use super::status::status;
use super::{Frame, Observer, OutputError, numbers};
use crate::checkpoint::Mark;
use crate::shape::Shape;
use crate::space::Space;
use crate::step::Localised;
use crate::trajectory::{Batch, Header, Precision, TrajectoryWriter, motion_number};
use crate::world::World;
use std::path::Path;
use std::time::{Duration, Instant};

/// How many numbers are written together, and for how long they may wait: each dataset is touched anew each time. What is left at the end
/// is waited for.
const ENOUGH: usize = 1 << 16;
const LONG_ENOUGH: Duration = Duration::from_secs(1);

/// So many records of steps are handed over without a frame.
const ROWS: usize = 512;

/// Writes frames and records, on a thread of its own.
///
/// What cannot be written is told at a later step or at the end; nothing is written after it.
#[derive(Debug)]
pub struct TrajectoryOutput {
    every: u64,
    file: Background<Batch>,
    /// What was seen since the last frame.
    waiting: Batch,
}

impl TrajectoryOutput {
    /// Makes the file for this world; the start and every `every`-th step will be frames, none if it is 0.
    ///
    /// # Errors
    /// Where it cannot be made, or there can be no thread.
    pub fn create<S: Space<D, N>, const D: usize, const N: usize>(
        path: &Path,
        world: &World<S, D, N>,
        (title, every, precision): (&str, u64, Precision),
    ) -> Result<Self, OutputError> {
        let bodies = &world.bodies;
        let header = Header {
            dimension: D,
            title: title.to_owned(),
            step: world.settings.h,
            every,
            radius: bodies.shape.iter().map(|shape| shape.bounding_radius().unwrap_or(f64::INFINITY)).collect(),
            mass: bodies.mass.iter().map(|mass| mass[0]).collect(),
            material: bodies.material.clone(),
            free: world.ever_free(),
        };
        Self::of(path, every, TrajectoryWriter::create(path, &header, precision)?)
    }

    /// Goes on with the file of a run that was stopped: frames and records after step `last` are left out, and every `every`-th step will be
    /// a frame.
    ///
    /// # Errors
    /// Where it cannot be read or written, or lacks something up to that step.
    pub fn resume(path: &Path, (every, precision): (u64, Precision), last: u64) -> Result<Self, OutputError> {
        Self::of(path, every, TrajectoryWriter::resume(path, (every, precision), last)?)
    }

    fn of(path: &Path, every: u64, file: TrajectoryWriter) -> Result<Self, OutputError> {
        let writer = Writer { file, waiting: Batch::default(), last: Instant::now() };
        Ok(Self { every, file: Background::start(writer).map_err(OutputError::io(path))?, waiting: Batch::default() })
    }

    fn give(&mut self) -> Result<(), OutputError> {
        let mut next = self.file.used().unwrap_or_default();
        next.clear();
        self.file.give(std::mem::replace(&mut self.waiting, next))
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Observer<S, D, N> for TrajectoryOutput {
    fn see(&mut self, frame: &Frame<'_, S, D, N>) -> Result<(), OutputError> {
        self.waiting.rows.extend(frame.record.map(numbers));
        let is_frame = self.every > 0 && frame.world.steps.is_multiple_of(self.every);
        if is_frame {
            take(&mut self.waiting, frame);
        }
        if is_frame || self.waiting.rows.len() >= ROWS { self.give() } else { self.file.check() }
    }

    fn sync(&mut self) -> Result<Option<Mark>, OutputError> {
        if !self.waiting.is_empty() {
            self.give()?;
        }
        self.file.sync().map(|()| None)
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        if !self.waiting.is_empty() {
            self.give()?;
        }
        self.file.finish()
    }
}

/// Adds a frame.
fn take<S: Space<D, N>, const D: usize, const N: usize>(to: &mut Batch, frame: &Frame<'_, S, D, N>) {
    let (world, bodies, contacts) = (frame.world, &frame.world.bodies, frame.contacts);
    to.step.push(world.steps);
    to.time.push(world.time);
    to.contacts.push(contacts.len() as u64);
    let [position, rotation, velocity, spin, point, normal, impulse, gap] = &mut to.reals;
    for (pose, v) in bodies.pose.iter().zip(&bodies.velocity) {
        position.extend(pose.position);
        velocity.extend(&v[..D]);
        let turned = S::spin_in_world(pose.rotation, v);
        if D == 2 {
            let axis = S::rotate(pose.rotation, std::array::from_fn(|k| if k == 0 { 1.0 } else { 0.0 }));
            rotation.extend(axis);
            spin.push(turned[2]);
        } else {
            rotation.extend(S::quaternion(pose.rotation));
            spin.extend(turned);
        }
    }
    to.motion.extend(bodies.motion.iter().copied().map(motion_number));
    for contact in contacts {
        let Localised { contact: c, .. } = contact;
        point.extend(c.point);
        normal.extend(c.normal);
        impulse.extend(contact.impulse_in_world());
        gap.push(c.gap);
        to.pairs[0].push(c.key.a);
        to.pairs[1].push(c.key.b);
        to.status.push(status(contact) as u8);
    }
}

/// The thread's part: collects, and writes much at a time.
struct Writer {
    file: TrajectoryWriter,
    waiting: Batch,
    last: Instant,
}

impl background::Writer<Batch> for Writer {
    fn write(&mut self, batch: &Batch) -> Result<(), OutputError> {
        self.waiting.append(batch);
        if self.waiting.len() >= ENOUGH || self.last.elapsed() >= LONG_ENOUGH { self.catch_up() } else { Ok(()) }
    }

    fn catch_up(&mut self) -> Result<(), OutputError> {
        let written = if self.waiting.is_empty() { Ok(()) } else { self.file.append(&self.waiting) };
        self.waiting.clear();
        self.last = Instant::now();
        Ok(written?)
    }

    fn sync(&mut self) -> Result<(), OutputError> {
        self.catch_up()?;
        Ok(self.file.sync()?)
    }
}
