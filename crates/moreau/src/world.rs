//! The world: the truth that a step advances.

use crate::bodies::Bodies;
use crate::events::Schedule;
use crate::joints::Joint;
use crate::laws::Laws;
use crate::space::Space;
use moreau_solve::Settings;

/// With which impulses a solve begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// From zero, as in the paper (section 3.2).
    Cold,
    /// From those of the step before, contact by contact.
    #[default]
    Warm,
}

/// Which rows give contacts their velocity at the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rows {
    /// Those of the end of the step, to second order in h: bodies that roll or turn about an edge keep their height and their energy.
    #[default]
    Turning,
    /// Those of the predicted configuration, half a step earlier, as in the paper.
    Frozen,
}

/// What to do when a solve reaches its limit of sweeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OnFailure {
    /// Take the step all the same, and count it.
    #[default]
    Warn,
    /// End the run before the step.
    Stop,
    /// Take the step all the same, count it, and write its problem to failed-step-N.hdf5 in the folder of the run, for
    /// `moreau solve`; of a run the first twenty.
    Dump,
    /// Do the step again in two halves, if need be in four quarters, and so on down to h/64.
    Halve,
}

/// What to do when a step breaks a limit of [`Guard`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OnBreach {
    /// Take the step all the same, and count it.
    #[default]
    Warn,
    /// End the run, and write the contact problem of the step to failed-step-N.hdf5 in its folder.
    Stop,
    /// Do the step again in two halves, if need be in four quarters, and so on down to h/64; then end the run. The same where a velocity or
    /// position ceases to be a number.
    Halve,
}

/// Limits that each step must keep to; those that are not given are none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Guard<const D: usize> {
    /// The lowest and the highest corner of the region in which centres of free bodies stay, m.
    pub domain: Option<[[f64; D]; 2]>,
    /// How deep bodies may overlap at the predicted configuration, as a part of the smaller one's bounding radius.
    pub penetration: Option<f64>,
    /// How much energy a step may create, J, the sum of its parts: theory (80). Rounding and the solver's tolerance create some.
    pub energy: Option<f64>,
    /// What to do when a step breaks one of them.
    pub policy: OnBreach,
}

impl<const D: usize> Guard<D> {
    /// Whether the problem of a step that breaks a limit is to be written.
    pub fn dumps(&self) -> bool {
        self.policy == OnBreach::Stop && (self.domain.is_some() || self.penetration.is_some() || self.energy.is_some())
    }
}

/// How the world is advanced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepSettings {
    /// Length of a step h, s.
    pub h: f64,
    /// θ of the θ-method, from 1/2 to 1 (eq. 13).
    pub theta: f64,
    /// Which rows give contacts their velocity at the end of a step.
    pub rows: Rows,
    /// How deep bodies may overlap before their positions are corrected, as a part of the smaller one's bounding radius; `None` for no
    /// correction.
    pub max_penetration: Option<f64>,
    /// First impulses of a solve.
    pub start: Start,
    /// What to do when a solve fails.
    pub on_failure: OnFailure,
    /// The contact solver.
    pub solver: Settings,
}

/// Bodies, laws and gravity at one time.
#[derive(Clone, Debug)]
pub struct World<S: Space<D, N>, const D: usize, const N: usize> {
    /// The bodies.
    pub bodies: Bodies<S, D, N>,
    /// The laws by pair of materials.
    pub laws: Laws,
    /// What holds bodies to each other or to the world.
    pub joints: Vec<Joint<D>>,
    /// Gravity, m/s².
    pub gravity: [f64; D],
    /// What happens to bodies at given times, and what drives them.
    pub schedule: Schedule<S, D, N>,
    /// Limits that each step must keep to.
    pub guard: Guard<D>,
    /// How it is advanced.
    pub settings: StepSettings,
    /// Time, s.
    pub time: f64,
    /// Steps done.
    pub steps: u64,
}

impl<S: Space<D, N>, const D: usize, const N: usize> World<S, D, N> {
    /// Of each body whether it is free at some time of the run: now, once it has come from a source, or from an event on.
    pub fn ever_free(&self) -> Vec<bool> {
        let mut free: Vec<bool> = (0..self.bodies.len()).map(|i| self.bodies.is_free(i)).collect();
        self.schedule.freed().for_each(|i| free[i] = true);
        free
    }

    /// Lets the events happen that are due; returns the energy of free bodies that they bring, J.
    pub(crate) fn act(&mut self) -> f64 {
        self.schedule.act(&mut self.bodies, &self.gravity, self.time, self.settings.h)
    }
}
