//! Energy over a whole run: what was at hand, what was created, and how far the ledger closed.

use crate::step::{Created, StepRecord};
use moreau_solve::residual::larger;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// The step in which a part of the scheme created most energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Worst {
    /// Its number; 0 where no step created any.
    pub(super) step: u64,
    /// Energy created in it, J.
    pub(super) energy: f64,
}

/// Sums and extremes of the energy ledger.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Books {
    kinetic: f64,
    /// The lowest and the highest potential energy, J.
    potential: Option<[f64; 2]>,
    work: f64,
    dissipated: f64,
    lift: f64,
    /// Potential energy and work of the last step, J, and the sum of the amounts by which they changed.
    last: Option<[f64; 2]>,
    changed: f64,
    pub(super) created: Created,
    /// By part, in the order of [`Created::NAMES`].
    pub(super) worst: [Worst; 4],
    /// The greatest dissipated energy so far, J, and the greatest fall from there: energy gained on balance.
    highest: f64,
    pub(super) gained: f64,
    pub(super) balance_error: f64,
}

impl Books {
    pub(super) fn add(&mut self, record: &StepRecord) {
        let energy = &record.energy;
        self.kinetic = larger(self.kinetic, energy.kinetic);
        let [low, high] = self.potential.unwrap_or([energy.potential; 2]);
        self.potential = Some([-larger(-low, -energy.potential), larger(high, energy.potential)]);
        self.work = larger(self.work, energy.work.abs());
        self.dissipated = larger(self.dissipated, energy.dissipated.abs());
        self.lift = larger(self.lift, record.lift);
        let [potential, work] = self.last.unwrap_or([energy.potential, energy.work]);
        self.changed += (energy.potential - potential).abs() + (energy.work - work).abs();
        self.last = Some([energy.potential, energy.work]);
        self.created.add(&record.created);
        for (worst, energy) in self.worst.iter_mut().zip(record.created.parts()) {
            if energy > worst.energy {
                *worst = Worst { step: record.step, energy };
            }
        }
        self.highest = larger(self.highest, energy.dissipated);
        self.gained = larger(self.gained, self.highest - energy.dissipated);
        self.balance_error = larger(self.balance_error, energy.balance_error.abs());
    }

    /// Returns the energy at hand, J: the largest of kinetic energy, the range of potential energy, work, dissipated energy, and the energy
    /// that moves each body by its own radius against its weight and load.
    pub(super) fn scale(&self) -> f64 {
        let range = self.potential.map_or(0.0, |[low, high]| high - low);
        [self.kinetic, range, self.work, self.dissipated].into_iter().fold(self.lift, larger)
    }

    /// Returns the energy turned over, J: the energy at hand, and the amounts by which potential energy and work changed in all steps.
    pub(super) fn turnover(&self) -> f64 {
        self.scale() + self.changed
    }

    /// Returns the largest number in the ledger, J, to which its rounding is relative.
    pub(super) fn magnitude(&self) -> f64 {
        let potential = self.potential.map_or(0.0, |[low, high]| larger(low.abs(), high.abs()));
        [self.kinetic, self.work, self.dissipated].into_iter().fold(potential, larger)
    }

    /// Returns the object `energy.created` of `summary.json`.
    pub(super) fn to_json(&self) -> Value {
        let Created { contacts, joints, correction, scheme } = self.created;
        let worst = |k: usize| json!({ "step": self.worst[k].step, "energy": self.worst[k].energy });
        json!({
            "total": self.created.total(),
            "contacts": contacts,
            "joints": joints,
            "correction": correction,
            "scheme": scheme,
            "gained": self.gained,
            "scale": self.scale(),
            "turnover": self.turnover(),
            "worst_step": { "contacts": worst(0), "joints": worst(1), "correction": worst(2), "scheme": worst(3) },
        })
    }
}
