//! A step is done whole or not at all: what it has changed when it fails, or is asked to stop, is taken back.

use super::Workspace;
use super::record::Ledger;
use crate::bodies::Motion;
use crate::contacts::ContactKey;
use crate::events::ScheduleState;
use crate::space::{Pose, Space};
use crate::world::World;

/// The world before a step, and what the workspace keeps from one step to the next (`state.rs`).
///
/// It is made anew at each step. So what is long is kept only where a step can change it, and what a step replaces is not copied but put aside.
pub(super) struct Undo<S: Space<D, N>, const D: usize, const N: usize> {
    pose: Vec<Pose<S::Rotation, D>>,
    velocity: Vec<[f64; N]>,
    /// These three of worlds with a schedule.
    schedule: Option<ScheduleState>,
    load: Vec<[f64; N]>,
    motion: Vec<Motion>,
    time: f64,
    ledger: Ledger,
    swept: u64,
    joints: Vec<[f64; D]>,
    /// Whether these two were put aside in this step.
    replaced: bool,
    previous: Vec<(ContactKey, [f64; D])>,
    last: Vec<[f64; N]>,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Default for Undo<S, D, N> {
    fn default() -> Self {
        Self {
            pose: Vec::new(),
            velocity: Vec::new(),
            schedule: None,
            load: Vec::new(),
            motion: Vec::new(),
            time: 0.0,
            ledger: Ledger::default(),
            swept: 0,
            joints: Vec::new(),
            replaced: false,
            previous: Vec::new(),
            last: Vec::new(),
        }
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Undo<S, D, N> {
    /// Puts the impulses and velocities of the step before aside, where they are still those: the caller writes others in their place.
    pub(super) fn put_aside(&mut self, previous: &mut Vec<(ContactKey, [f64; D])>, last: &mut Vec<[f64; N]>) {
        if !self.replaced {
            self.replaced = true;
            std::mem::swap(&mut self.previous, previous);
            std::mem::swap(&mut self.last, last);
        }
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Workspace<S, D, N> {
    /// Notes the world and the workspace before a step.
    pub(super) fn begin(&mut self, world: &World<S, D, N>) {
        let (bodies, undo) = (&world.bodies, &mut self.undo);
        undo.pose.clone_from(&bodies.pose);
        undo.velocity.clone_from(&bodies.velocity);
        undo.schedule = (!world.schedule.is_empty()).then(|| world.schedule.state());
        if undo.schedule.is_some() {
            undo.load.clone_from(&bodies.load);
            undo.motion.clone_from(&bodies.motion);
        }
        undo.joints.clone_from(&self.joints.previous);
        (undo.time, undo.ledger, undo.swept, undo.replaced) = (world.time, self.ledger, self.swept, false);
    }

    /// Takes back what was done since.
    pub(super) fn take_back(&mut self, world: &mut World<S, D, N>) {
        let (bodies, undo) = (&mut world.bodies, &mut self.undo);
        if let Some(schedule) = undo.schedule.take() {
            for i in (0..bodies.len()).filter(|&i| bodies.motion[i] != undo.motion[i]).collect::<Vec<_>>() {
                bodies.set_motion(i, undo.motion[i]);
            }
            bodies.load.clone_from(&undo.load);
            // It is the schedule's own.
            let fits = world.schedule.restore(&schedule);
            debug_assert!(fits.is_ok(), "{fits:?}");
        }
        bodies.pose.clone_from(&undo.pose);
        bodies.velocity.clone_from(&undo.velocity);
        self.joints.previous.clone_from(&undo.joints);
        (world.time, self.ledger, self.swept) = (undo.time, undo.ledger, undo.swept);
        if undo.replaced {
            std::mem::swap(&mut undo.previous, &mut self.previous);
            std::mem::swap(&mut undo.last, &mut self.last);
        }
    }
}
