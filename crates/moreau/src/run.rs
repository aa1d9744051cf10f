//! A run: steps, observers, an orderly end.

use crate::observe::{Frame, Observer, OutputError, Summary};
use crate::space::Space;
use crate::step::{FailedSolve, StepError, StepRecord, Workspace, step};
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
    /// Wall-clock seconds of all of it.
    pub seconds_total: f64,
    /// Of these, in observers: what the run waited for. An observer may go on with its files beside the steps.
    pub seconds_output: f64,
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

/// Advances `world` by `steps` steps, shows each frame to the observers and each record to `progress`; ends early, with what was
/// computed kept, when `stop` is set.
///
/// # Errors
/// Where an observer cannot write. A step that fails is no error but an [`End`].
pub fn run<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    steps: u64,
    observers: &mut [Box<dyn Observer<S, D, N> + '_>],
    stop: &AtomicBool,
    mut progress: impl FnMut(&StepRecord),
) -> Result<Outcome, Box<Unwritten>> {
    let started = Instant::now();
    let mut audience = Audience { observers, error: None, seconds: 0.0 };
    let mut summary = Summary::default();
    let mut end = End::Done;
    audience.see(&Frame { world, contacts: work.contacts(), record: None });
    for _ in 0..steps {
        if audience.error.is_some() {
            break;
        }
        if stop.load(Ordering::Relaxed) {
            end = End::Interrupted;
            break;
        }
        let done = step(world, work);
        if let Some(failed) = work.take_failed() {
            audience.see_failed(&failed, &mut summary);
        }
        match done {
            Ok(record) => {
                summary.add(&record);
                audience.see(&Frame { world, contacts: work.contacts(), record: Some(&record) });
                progress(&record);
            }
            Err(error) => {
                end = End::Failed(error);
                break;
            }
        }
    }
    audience.finish();
    if audience.error.is_some() && end == End::Done {
        end = End::Unwritten;
    }
    let Audience { error, seconds: seconds_output, .. } = audience;
    let outcome = Outcome { end, summary, seconds_total: started.elapsed().as_secs_f64(), seconds_output };
    match error {
        Some(error) => Err(Box::new(Unwritten { error, outcome })),
        None => Ok(outcome),
    }
}

/// All observers. What one cannot write is no reason for the others not to see a step or to leave their files incomplete; the first
/// error is kept.
struct Audience<'a, 'b, S: Space<D, N>, const D: usize, const N: usize> {
    observers: &'a mut [Box<dyn Observer<S, D, N> + 'b>],
    error: Option<OutputError>,
    seconds: f64,
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
