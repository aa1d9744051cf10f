//! Scratch of a step: buffers that are written anew each time and kept, and what observers read of the last step.

use super::correct::Correction;
use super::created::Islands;
use super::failed::{Failed, FailedSolve};
use super::joints::{Reaction, StepJoints};
use super::localise::Spins;
use super::record::{Balance, Ledger};
use super::system::Systems;
use super::undo::Undo;
use crate::contacts::{Contact, ContactKey};
use crate::detect::Detector;
use crate::space::curve::Curve;
use crate::space::{Pose, Space};
use crate::world::World;
use moreau_solve::operator::Lightest;
use moreau_solve::{Cone, HistoryRow, NormalForm};

/// One contact as the last step left it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Localised<const D: usize> {
    /// Identity, point, normal and gap at the predicted configuration.
    pub contact: Contact<D>,
    /// The frame, rows n, t₁ (, t₂).
    pub frame: [[f64; D]; D],
    /// Law in normal form.
    pub form: NormalForm<D>,
    /// Relative velocity at the beginning of the step, in the frame, m/s; where no contact of the step can turn a body (no friction,
    /// round bodies), the normal part alone.
    pub before: [f64; D],
    /// Relative velocity at the end of the step, in the frame, m/s; where no contact of the step has friction, the normal part alone.
    pub after: [f64; D],
    /// What driven bodies give of both, the mean of before and after.
    pub driven: [f64; D],
    /// Impulse on body `b`, in the frame, N·s.
    pub impulse: [f64; D],
    acts: bool,
}

impl<const D: usize> Localised<D> {
    /// A contact before the solve, without an impulse; its law does not act where it has no form.
    pub(super) fn new(
        contact: Contact<D>,
        frame: [[f64; D]; D],
        form: Option<NormalForm<D>>,
        [before, after, driven]: [[f64; D]; 3],
    ) -> Self {
        let none = NormalForm { cone: Cone::Signorini, shift: [0.0; D] };
        let (acts, form) = (form.is_some(), form.unwrap_or(none));
        Self { contact, frame, form, before, after, driven, impulse: [0.0; D], acts }
    }

    /// The impulse on body `b` in the world, N·s.
    pub fn impulse_in_world(&self) -> [f64; D] {
        std::array::from_fn(|k| (0..D).map(|i| self.frame[i][k] * self.impulse[i]).sum())
    }

    /// Whether its law acts in this step.
    pub(super) fn acts(&self) -> bool {
        self.acts
    }
}

/// The world before a step that may have to be halved.
pub(super) struct Before<S: Space<D, N>, const D: usize, const N: usize> {
    pose: Vec<Pose<S::Rotation, D>>,
    velocity: Vec<[f64; N]>,
    time: f64,
    ledger: Ledger,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Before<S, D, N> {
    pub(super) fn of(world: &World<S, D, N>, ledger: &Ledger) -> Self {
        let bodies = &world.bodies;
        Self { pose: bodies.pose.clone(), velocity: bodies.velocity.clone(), time: world.time, ledger: *ledger }
    }

    pub(super) fn restore(&self, world: &mut World<S, D, N>, ledger: &mut Ledger) {
        world.bodies.pose.clone_from(&self.pose);
        world.bodies.velocity.clone_from(&self.velocity);
        (world.time, *ledger) = (self.time, self.ledger);
    }
}

/// All that a step needs beside the world.
pub struct Workspace<S: Space<D, N>, const D: usize, const N: usize> {
    pub(super) detector: Detector<D>,
    pub(super) free: Vec<[f64; N]>,
    pub(super) after: Vec<[f64; N]>,
    pub(super) middle: Vec<Pose<S::Rotation, D>>,
    /// The greatest speeds of points of bodies, as far as they are known before the solve.
    pub(super) speeds: Vec<f64>,
    pub(super) reach: Vec<f64>,
    pub(super) found: Vec<Contact<D>>,
    pub(super) spins: Spins,
    pub(super) remainders: Vec<[f64; D]>,
    /// Velocities at the beginning of the step before.
    pub(super) last: Vec<[f64; N]>,
    /// How many sweeps the last solve had.
    pub(super) swept: u64,
    /// Scratch: what contacts at rest have to give the bodies, M^½ (v − v_free).
    pub(super) held: Vec<[f64; N]>,
    pub(super) lightest: Lightest<D, N>,
    pub(super) contacts: Vec<Localised<D>>,
    pub(super) previous: Vec<(ContactKey, [f64; D])>,
    pub(super) joints: StepJoints<D, N>,
    pub(super) curve: Curve,
    pub(super) systems: Systems<S, D, N>,
    pub(super) correction: Correction<D, N>,
    pub(super) ledger: Ledger,
    pub(super) balance: Vec<Balance>,
    pub(super) islands: Islands,
    pub(super) failed: Failed,
    pub(super) undo: Undo<S, D, N>,
    pub(crate) history: Vec<HistoryRow>,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Default for Workspace<S, D, N> {
    fn default() -> Self {
        Self {
            detector: Detector::default(),
            free: Vec::new(),
            after: Vec::new(),
            middle: Vec::new(),
            speeds: Vec::new(),
            reach: Vec::new(),
            found: Vec::new(),
            spins: Spins::default(),
            remainders: Vec::new(),
            last: Vec::new(),
            swept: 0,
            lightest: Lightest::default(),
            held: Vec::new(),
            contacts: Vec::new(),
            previous: Vec::new(),
            joints: StepJoints::default(),
            curve: Curve::default(),
            systems: Systems::default(),
            correction: Correction::default(),
            ledger: Ledger::default(),
            balance: Vec::new(),
            islands: Islands::default(),
            failed: Failed::default(),
            undo: Undo::default(),
            history: Vec::new(),
        }
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Workspace<S, D, N> {
    /// The contacts of the last step, sorted by key.
    pub fn contacts(&self) -> &[Localised<D>] {
        &self.contacts
    }

    /// What each joint of the world did in the last step, in their order.
    pub fn reactions(&self) -> &[Reaction<D>] {
        &self.joints.reactions
    }

    /// The problem of the last step, if its solve failed under [`OnFailure::Dump`](crate::world::OnFailure::Dump) and is among the
    /// first [`FAILED_KEPT`](super::FAILED_KEPT) of this workspace. The next step drops it.
    pub fn take_failed(&mut self) -> Option<FailedSolve> {
        self.failed.last.take()
    }

    /// Residuals sweep by sweep of the last solve, if the solver's settings ask for them.
    pub fn history(&self) -> &[HistoryRow] {
        &self.history
    }
}
