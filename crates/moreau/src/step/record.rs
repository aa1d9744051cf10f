//! What a step tells: solver, penetration, energy ledger, seconds.

use super::created::Created;
use super::guard::Breach;
use super::joints::Block;
use super::workspace::Localised;
use crate::bodies::Bodies;
use crate::shape::Shape;
use crate::space::Space;
use moreau_solve::block::{dot, norm};
use moreau_solve::tasks;
use moreau_solve::{Residual, Status};
use serde::{Deserialize, Serialize};

/// The energy of the free bodies, J, and what has gone in and out since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Σ ½ v·M v.
    pub kinetic: f64,
    /// −Σ m g·x.
    pub potential: f64,
    /// Done by forces and torques and by driven bodies, and brought by bodies that came, went, or became free or driven.
    pub work: f64,
    /// Lost in contacts and joints, and by the scheme: where θ > 1/2, and in the rotation of bodies that are not round. Corrections of
    /// positions count as well: weights that they lift are a negative loss.
    pub dissipated: f64,
    /// Of this, by the normal impulses of contacts: impacts.
    pub impact: f64,
    /// And by their tangential impulses: friction. The rest of `dissipated` belongs to joints, to the scheme and to corrections.
    pub friction: f64,
    /// kinetic + potential − work + dissipated, less its value at the start: rounding, if all is well.
    pub balance_error: f64,
}

/// Seconds of wall-clock time by stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seconds {
    /// Neighbour search and exact pairs, also for the correction of positions.
    pub detect: f64,
    /// Frames, velocities, laws, operator.
    pub localise: f64,
    /// Contact impulses.
    pub solve: f64,
    /// The whole step, without output.
    pub step: f64,
}

/// The record of one step: a row of `steps.csv`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepRecord {
    /// Number of the step, from 1.
    pub step: u64,
    /// Time at its end, s.
    pub time: f64,
    /// Length of its last part, s: that of the step, unless it was halved. The contacts that it leaves are those of this part.
    pub h: f64,
    /// Number of bodies that are there.
    pub bodies: usize,
    /// Contacts that took part.
    pub contacts: usize,
    /// Of these, with an impulse.
    pub active: usize,
    /// Sweeps; the sum where the step was halved.
    pub sweeps: u64,
    /// How the solve ended; the worst where the step was halved.
    pub status: Status,
    /// Residuals at its end; the worst where the step was halved.
    pub residual: Residual,
    /// Deepest overlap of two bodies at the predicted configuration, m; zero if none.
    pub penetration: f64,
    /// Deepest overlap as a part of the smaller body's bounding radius; zero if there is none.
    pub overlap: f64,
    /// The greatest error of position that a joint is left with at the next predicted configuration, m, angles times the arm of its bodies;
    /// zero without joints.
    pub joint_error: f64,
    /// The greatest such error as a part of the smaller body's bounding radius; zero without joints.
    pub joint_gap: f64,
    /// Energy created by the step, J, by part.
    pub created: Created,
    /// Energy that moves each free body by its own bounding radius against its weight and load, J: the energy at hand where all is at rest.
    pub lift: f64,
    /// Energies.
    pub energy: Energy,
    /// How it broke a limit of [`Guard`](crate::world::Guard), where that is only counted.
    pub breach: Option<Breach>,
    /// Time taken.
    pub seconds: Seconds,
}

impl StepRecord {
    /// Whether every solve of the step met its criterion.
    pub fn converged(&self) -> bool {
        self.status == Status::Converged
    }

    /// Returns the name of the first number that is NaN or infinite.
    pub(super) fn not_finite(&self) -> Option<&'static str> {
        let (energy, residual) = (&self.energy, &self.residual);
        let numbers = [
            ("kinetic energy", energy.kinetic),
            ("potential energy", energy.potential),
            ("work", energy.work),
            ("dissipated energy", energy.dissipated),
            ("energy dissipated by impacts", energy.impact),
            ("energy dissipated by friction", energy.friction),
            ("error of the energy balance", energy.balance_error),
            ("energy created", self.created.total()),
            ("depth of the deepest overlap", self.penetration),
            ("error of a joint", self.joint_error),
            ("residual ε_glob of the contact solver", residual.eps_glob.total()),
            ("scaled residual of the contact solver", residual.scaled),
        ];
        numbers.iter().find(|(_, x)| !x.is_finite()).map(|&(name, _)| name)
    }
}

/// The running sums of the energy ledger.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Ledger {
    start: Option<f64>,
    work: f64,
    dissipated: f64,
    impact: f64,
    friction: f64,
}

/// One body's part of the ledger in a step, J.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Balance {
    /// Work of its load.
    work: f64,
    /// What the scheme loses before settling: for θ > 1/2, and by the gyroscopic term.
    pub(super) scheme: f64,
    /// See [`StepRecord::lift`].
    lift: f64,
}

/// Kinetic and potential energy of the free bodies.
pub(super) fn energies<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    gravity: &[f64; D],
) -> (f64, f64) {
    let [kinetic, potential] = tasks::sums(0..bodies.len(), &|i| bodies.energy(i, gravity));
    (kinetic, potential)
}

impl Ledger {
    /// Notes the energy at the start of a run, once.
    pub(super) fn open(&mut self, energy: impl FnOnce() -> (f64, f64)) {
        self.start.get_or_insert_with(|| {
            let (kinetic, potential) = energy();
            kinetic + potential
        });
    }

    /// Books one step, before the bodies move; returns [`StepRecord::lift`]. `smooth` is v_free, `after` is v⁺; `balance` gets each body's
    /// part.
    ///
    /// The scheme's own identity: ΔK = v_m·M Δv with v_m = (v + v⁺)/2, and M Δv = h f + gyroscopic + H p. Displacements are those of
    /// v_θ = θ v⁺ + (1 − θ) v, so loads and gravity do work on v_θ; what v_m misses of that is lost by the scheme.
    pub(super) fn book<S: Space<D, N>, const D: usize, const N: usize>(
        &mut self,
        bodies: &Bodies<S, D, N>,
        gravity: &[f64; D],
        [smooth, after]: [&[[f64; N]]; 2],
        contacts: &[Localised<D>],
        (h, theta): (f64, f64),
        balance: &mut Vec<Balance>,
    ) -> f64 {
        let of_body = |i: usize| {
            let (v, mass) = (&bodies.velocity[i], &bodies.mass[i]);
            let (mut work, mut displaced, mut middle) = (0.0, 0.0, 0.0);
            let v_theta = |k: usize| theta * after[i][k] + (1.0 - theta) * v[k];
            if bodies.load[i] != [0.0; N] {
                let load = bodies.load_in_body(i);
                work = h * (0..N).map(|k| load[k] * v_theta(k)).sum::<f64>();
                displaced = work;
            }
            for k in 0..D {
                displaced += h * mass[k] * gravity[k] * v_theta(k);
            }
            for k in 0..N {
                middle += mass[k] * (smooth[i][k] - v[k]) * 0.5 * (v[k] + after[i][k]);
            }
            let push: [f64; D] = std::array::from_fn(|k| mass[k] * gravity[k] + bodies.load[i][k]);
            let lift = norm(&push) * bodies.shape[i].bounding_radius().unwrap_or(0.0);
            Balance { work, scheme: displaced - middle, lift }
        };
        let of_contact = |c: usize| {
            let c = &contacts[c];
            let mean: [f64; D] = std::array::from_fn(|i| 0.5 * (c.before[i] + c.after[i]));
            [-dot(&c.impulse, &c.driven), -c.impulse[0] * mean[0], -(1..D).map(|i| c.impulse[i] * mean[i]).sum::<f64>()]
        };
        tasks::fill(balance, bodies.len(), |i| if bodies.is_free(i) { of_body(i) } else { Balance::default() });
        let [work, scheme, lift] = tasks::sums(0..bodies.len(), &|i| [balance[i].work, balance[i].scheme, balance[i].lift]);
        let contacts = tasks::sums(0..contacts.len(), &of_contact);
        self.work += work + contacts[0];
        self.impact += contacts[1];
        self.friction += contacts[2];
        self.dissipated += scheme + (contacts[1] + contacts[2]);
        lift
    }

    /// Books what joints do, as contacts do.
    pub(super) fn book_joints<const D: usize, const N: usize>(&mut self, blocks: &[Block<D, N>]) {
        for block in blocks {
            let mean = std::array::from_fn(|i| 0.5 * (block.before[i] + block.after[i]));
            self.work -= dot(&block.impulse, &block.driven);
            self.dissipated -= dot(&block.impulse, &mean);
        }
    }

    /// What was dissipated since the start, J.
    pub(super) fn dissipated(&self) -> f64 {
        self.dissipated
    }

    /// Books what events bring.
    pub(super) fn bring(&mut self, energy: f64) {
        self.work += energy;
    }

    /// Books what settling and corrections of positions take.
    pub(super) fn dissipate(&mut self, energy: f64) {
        self.dissipated += energy;
    }

    /// The ledger when the energies are these.
    pub(super) fn energy(&self, (kinetic, potential): (f64, f64)) -> Energy {
        let balance_error = kinetic + potential - self.start.unwrap_or(0.0) - self.work + self.dissipated;
        let Self { work, dissipated, impact, friction, .. } = *self;
        Energy { kinetic, potential, work, dissipated, impact, friction, balance_error }
    }
}
