//! A run: steps, observers, an orderly end.

use crate::checkpoint::{Checkpoint, Checkpoints, Mark};
use crate::observe::{Frame, Observer, OutputError, Summary};
use crate::space::Space;
use crate::step::{FailedSolve, StepError, StepRecord, Workspace, step_until};
use crate::world::World;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// All steps were done.
    Done,
    /// It was asked to stop.
    Interrupted,
    /// A step could not be done; those before it stand.
    Failed(StepError),
    /// An observer could not write; the steps done until it said so stand.
    Unwritten,
}

/// What a run came to.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// How it ended.
    pub end: End,
    /// Sums over its steps.
    pub summary: Summary,
}

/// What a run is to do.
#[derive(Debug, Default)]
pub struct Task<'a> {
    /// How many steps.
    pub steps: u64,
    /// Summary of the steps before, of a run that goes on from a checkpoint, at step 0 as well: observers have seen the start then.
    pub before: Option<Summary>,
    /// Where it is kept: the scene as TOML, and the folder's checkpoints.
    pub kept: Option<(&'a str, Checkpoints)>,
}

impl Task<'_> {
    /// So many steps from the start, of which no checkpoint is kept.
    pub fn new(steps: u64) -> Self {
        Self { steps, ..Self::default() }
    }
}

/// A run of which an observer could not write something: it ended there, and all observers were asked to complete their files.
#[derive(Debug, thiserror::Error)]
#[error("{error}")]
pub struct Unwritten {
    /// The first thing that could not be written.
    pub error: OutputError,
    /// What the run came to until then.
    pub outcome: Outcome,
}

/// Advances `world` by some steps, shows each frame to the observers and each record to `progress`, and keeps checkpoints, of which the
/// first is of the start; ends early, with what was computed kept, when `stop` is set.
///
/// # Errors
/// Where an observer cannot write. A step that fails is no error but an [`End`].
pub fn run<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    task: Task<'_>,
    observers: &mut [Box<dyn Observer<S, D, N> + '_>],
    stop: &AtomicBool,
    mut progress: impl FnMut(&StepRecord),
) -> Result<Outcome, Box<Unwritten>> {
    let Task { steps, before, kept } = task;
    let mut keeper = kept.map(|(scene, checkpoints)| Keeper { scene, checkpoints });
    let mut audience = Audience { observers, error: None, seconds: 0.0, since: Instant::now() };
    let mut end = End::Done;
    let is_new = before.is_none();
    let mut summary = before.unwrap_or_default();
    if is_new {
        audience.see(&Frame { world, contacts: work.contacts(), record: None });
        // A run that ends before its next checkpoint, whatever ends it, goes on from this one.
        if let Some(keeper) = keeper.as_mut().filter(|keeper| keeper.checkpoints.due_at_bound(world.steps)) {
            keeper.keep(&mut audience, &mut summary, world, work);
        }
    }
    for _ in 0..steps {
        if audience.error.is_some() {
            break;
        }
        if stop.load(Ordering::Relaxed) {
            end = End::Interrupted;
            break;
        }
        let done = step_until(world, work, stop);
        if let Some(failed) = work.take_failed() {
            audience.see_failed(&failed, &mut summary);
        }
        match done {
            Ok(record) => {
                summary.add(&record);
                audience.see(&Frame { world, contacts: work.contacts(), record: Some(&record) });
                if let Some(keeper) = keeper.as_mut().filter(|keeper| keeper.checkpoints.due(world.steps)) {
                    keeper.keep(&mut audience, &mut summary, world, work);
                }
                progress(&record);
            }
            Err(StepError::Interrupted { .. }) => {
                end = End::Interrupted;
                break;
            }
            Err(error) => {
                summary.fail(error.to_string());
                end = End::Failed(error);
                break;
            }
        }
    }
    // Of a step that was not done nothing is left.
    if let Some(keeper) = keeper.as_mut().filter(|keeper| keeper.checkpoints.due_at_bound(world.steps)) {
        keeper.keep(&mut audience, &mut summary, world, work);
    }
    audience.finish();
    audience.count_seconds(&mut summary);
    if audience.error.is_some() && end == End::Done {
        end = End::Unwritten;
    }
    let outcome = Outcome { end, summary };
    match audience.error {
        Some(error) => Err(Box::new(Unwritten { error, outcome })),
        None => Ok(outcome),
    }
}

/// Who keeps checkpoints.
struct Keeper<'a> {
    scene: &'a str,
    checkpoints: Checkpoints,
}

impl Keeper<'_> {
    /// Keeps the run as it is, once all files have what came before. Nothing is kept of a run that cannot write.
    fn keep<S: Space<D, N>, const D: usize, const N: usize>(
        &mut self,
        audience: &mut Audience<'_, '_, S, D, N>,
        summary: &mut Summary,
        world: &World<S, D, N>,
        work: &Workspace<S, D, N>,
    ) {
        let marks = audience.sync();
        if audience.error.is_some() {
            return;
        }
        audience.count_seconds(summary);
        let clock = Instant::now();
        let checkpoint = Checkpoint::take(self.scene, (summary.clone(), marks), world, work);
        audience.error = self.checkpoints.save(&checkpoint).err().map(OutputError::from);
        audience.seconds += clock.elapsed().as_secs_f64();
    }
}

/// All observers. What one cannot write is no reason for the others not to see a step or to leave their files incomplete; the first
/// error is kept.
struct Audience<'a, 'b, S: Space<D, N>, const D: usize, const N: usize> {
    observers: &'a mut [Box<dyn Observer<S, D, N> + 'b>],
    error: Option<OutputError>,
    /// Seconds that the run waited for, and since when the summary has none of all.
    seconds: f64,
    since: Instant,
}

impl<'b, S: Space<D, N>, const D: usize, const N: usize> Audience<'_, 'b, S, D, N> {
    fn see(&mut self, frame: &Frame<'_, S, D, N>) {
        self.each(|observer| observer.see(frame));
    }

    fn see_failed(&mut self, failed: &FailedSolve, summary: &mut Summary) {
        if let Err(reason) = &failed.problem {
            summary.refuse_failed(format!("step {}: {reason}", failed.step));
        }
        self.each(|observer| {
            observer.see_failed(failed)?.into_iter().for_each(|name| summary.add_failed(name));
            Ok(())
        });
    }

    /// Has all files hold what was seen; gives the marks by which they are known.
    fn sync(&mut self) -> Vec<Mark> {
        let mut marks = Vec::new();
        self.each(|observer| {
            marks.extend(observer.sync()?);
            Ok(())
        });
        marks
    }

    /// Adds the seconds since the last time to the summary.
    fn count_seconds(&mut self, summary: &mut Summary) {
        summary.add_seconds(self.since.elapsed().as_secs_f64(), std::mem::take(&mut self.seconds));
        self.since = Instant::now();
    }

    fn finish(&mut self) {
        self.each(Observer::finish);
    }

    fn each(&mut self, mut tell: impl FnMut(&mut (dyn Observer<S, D, N> + 'b)) -> Result<(), OutputError>) {
        let clock = Instant::now();
        for observer in self.observers.iter_mut() {
            if let Err(error) = tell(observer.as_mut()) {
                self.error.get_or_insert(error);
            }
        }
        self.seconds += clock.elapsed().as_secs_f64();
    }
}
