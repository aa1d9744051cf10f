//! How far a schedule has come, for checkpoints.

use super::{Running, Schedule, Source};
use crate::checkpoint::{CheckpointError, poses, rows};
use crate::random::Random;
use crate::space::Space;
use serde::{Deserialize, Serialize};

/// Events that have happened, drives that are at work, and sources.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ScheduleState {
    next: usize,
    running: Vec<RunningState>,
    sources: Vec<(usize, Random)>,
    inserted: u64,
    removed: u64,
}

/// A drive that is at work.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct RunningState {
    event: usize,
    since: f64,
    position: Vec<f64>,
    rotation: [f64; 4],
    load: Vec<f64>,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Schedule<S, D, N> {
    pub(crate) fn state(&self) -> ScheduleState {
        let running = |running: &Running<S::Rotation, D, N>| RunningState {
            event: running.event,
            since: running.since,
            position: running.start.position.to_vec(),
            rotation: S::numbers(running.start.rotation),
            load: running.load.to_vec(),
        };
        ScheduleState {
            next: self.next,
            running: self.running.iter().map(running).collect(),
            sources: self.sources.iter().map(Source::state).collect(),
            inserted: self.inserted,
            removed: self.removed,
        }
    }

    pub(crate) fn restore(&mut self, state: &ScheduleState) -> Result<(), CheckpointError> {
        let ScheduleState { next, running, sources, inserted, removed } = state;
        let other = || CheckpointError::misfit("it has other events, drives or sources than the run had");
        if *next > self.events.len() || sources.len() != self.sources.len() {
            return Err(other());
        }
        let one = |state: &RunningState| {
            let RunningState { event, since, position, rotation, load } = state;
            let start = poses::<S, D, N>(position, std::slice::from_ref(rotation))?.pop()?;
            let load = rows(load, 1)?.pop()?;
            (event < next).then_some(Running { event: *event, since: *since, start, load })
        };
        self.running = running.iter().map(one).collect::<Option<_>>().ok_or_else(other)?;
        let restored = self.sources.iter_mut().zip(sources).map(|(source, state)| source.restore(state));
        restored.collect::<Option<()>>().ok_or_else(other)?;
        (self.next, self.inserted, self.removed) = (*next, *inserted, *removed);
        Ok(())
    }
}
