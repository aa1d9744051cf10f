//! A run: steps, observers, an orderly end.

use crate::observe::{Frame, Observer, OutputError, Summary};
use crate::space::Space;
use crate::step::{StepError, StepRecord, Workspace, step};
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
    /// Of these, in observers.
    pub seconds_output: f64,
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
) -> Result<Outcome, OutputError> {
    let started = Instant::now();
    let mut seconds_output = 0.0;
    let mut show = |frame: Frame<'_, S, D, N>| {
        let clock = Instant::now();
        let seen = observers.iter_mut().try_for_each(|observer| observer.see(&frame));
        seconds_output += clock.elapsed().as_secs_f64();
        seen
    };
    let mut summary = Summary::default();
    let mut end = End::Done;
    show(Frame { world, contacts: work.contacts(), record: None })?;
    for _ in 0..steps {
        if stop.load(Ordering::Relaxed) {
            end = End::Interrupted;
            break;
        }
        match step(world, work) {
            Ok(record) => {
                summary.add(&record);
                show(Frame { world, contacts: work.contacts(), record: Some(&record) })?;
                progress(&record);
            }
            Err(error) => {
                end = End::Failed(error);
                break;
            }
        }
    }
    let clock = Instant::now();
    observers.iter_mut().try_for_each(|observer| observer.finish())?;
    seconds_output += clock.elapsed().as_secs_f64();
    Ok(Outcome { end, summary, seconds_total: started.elapsed().as_secs_f64(), seconds_output })
}
