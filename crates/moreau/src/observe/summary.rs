//! What a whole run comes to: the numbers of `summary.json`.

use super::books::Books;
use super::steps::record_of;
use super::{COLUMNS, Verdict, verdict};
use crate::step::{Energy, StepRecord};
use crate::world::StepSettings;
use moreau_solve::residual::larger;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Sums and extremes over the steps of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    pub(super) steps: u64,
    contacts: u64,
    sweeps: u64,
    sweeps_max: u64,
    pub(super) unconverged: u64,
    pub(super) eps_glob_max: f64,
    pub(super) scaled_max: f64,
    pub(super) penetration_max: f64,
    pub(super) overlap_max: f64,
    pub(super) joint_error_max: f64,
    pub(super) joint_gap_max: f64,
    pub(super) books: Books,
    pub(super) breaches: u64,
    pub(super) first_breach: Option<String>,
    /// Why the run ended before its last step, if a step failed.
    pub(super) failure: Option<String>,
    failed_problems: Vec<String>,
    refused_problem: Option<String>,
    detect: f64,
    localise: f64,
    solve: f64,
    total: f64,
    output: f64,
    time: f64,
    contacts_last: usize,
    energy: Energy,
}

impl Summary {
    /// Adds a step.
    pub fn add(&mut self, record: &StepRecord) {
        self.steps += 1;
        self.contacts += record.contacts as u64;
        self.sweeps += record.sweeps;
        self.sweeps_max = self.sweeps_max.max(record.sweeps);
        self.unconverged += u64::from(!record.converged());
        self.eps_glob_max = larger(self.eps_glob_max, record.residual.eps_glob.total());
        self.scaled_max = larger(self.scaled_max, record.residual.scaled);
        self.penetration_max = larger(self.penetration_max, record.penetration);
        self.overlap_max = larger(self.overlap_max, record.overlap);
        self.joint_error_max = larger(self.joint_error_max, record.joint_error);
        self.joint_gap_max = larger(self.joint_gap_max, record.joint_gap);
        self.books.add(record);
        self.detect += record.seconds.detect;
        self.localise += record.seconds.localise;
        self.solve += record.seconds.solve;
        if let Some(breach) = &record.breach {
            self.breaches += 1;
            self.first_breach.get_or_insert_with(|| format!("step {}, t = {} s: {breach}", record.step, record.time));
        }
        (self.time, self.contacts_last, self.energy) = (record.time, record.contacts, record.energy);
    }

    /// Returns the summary of steps whose rows of `steps.csv` these are. It knows of no file and of no failure.
    pub fn of_rows(rows: impl IntoIterator<Item = [f64; COLUMNS.len()]>) -> Self {
        let mut summary = Self::default();
        for row in rows {
            let (record, broke) = record_of(&row);
            summary.add(&record);
            summary.breaches += u64::from(broke);
        }
        summary
    }

    /// Notes the error of the step that ended the run.
    pub fn fail(&mut self, reason: String) {
        self.failure = Some(reason);
    }

    /// Judges whether the run is to be relied on.
    pub fn verdict(&self) -> Verdict {
        Verdict::of(self)
    }

    /// Returns how much energy was created and by what, if it is more than rounding creates.
    pub fn energy_created(&self) -> Option<String> {
        let text = || self.verdict().check("Energy").map(|check| check.text.clone());
        verdict::beyond_rounding(self).then(text).flatten()
    }

    /// Adds the name of a file with the problem of a failed solve.
    pub fn add_failed(&mut self, name: String) {
        self.failed_problems.push(name);
    }

    /// Notes why there is no file with the problem of a failed solve; the first reason is kept.
    pub fn refuse_failed(&mut self, reason: String) {
        self.refused_problem.get_or_insert(reason);
    }

    /// The files with problems of failed solves.
    pub fn failed_problems(&self) -> &[String] {
        &self.failed_problems
    }

    /// Why there is no file of the first failed solve of which there could be none.
    pub fn refused_problem(&self) -> Option<&str> {
        self.refused_problem.as_deref()
    }

    /// How many steps broke a limit of [`Guard`](crate::world::Guard), where that is only counted, and what is said of the first.
    pub fn breaches(&self) -> (u64, Option<&str>) {
        (self.breaches, self.first_breach.as_deref())
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Steps whose solve did not meet its criterion.
    pub fn unconverged(&self) -> u64 {
        self.unconverged
    }

    /// Mean number of sweeps a step.
    pub fn sweeps_mean(&self) -> f64 {
        mean(self.sweeps, self.steps)
    }

    /// Adds wall-clock seconds, of the whole run and of its waiting for files.
    pub(crate) fn add_seconds(&mut self, total: f64, output: f64) {
        self.total += total;
        self.output += output;
    }

    /// Wall-clock seconds of the whole run.
    pub fn seconds_total(&self) -> f64 {
        self.total
    }

    /// Of these, in observers and checkpoints: what the run waited for. An observer may go on with its files beside the steps.
    pub fn seconds_output(&self) -> f64 {
        self.output
    }

    /// Seconds spent on contact impulses.
    pub fn seconds_solve(&self) -> f64 {
        self.solve
    }

    /// The object of `summary.json`; `bodies` is how many are there at the end.
    pub fn to_json(&self, bodies: usize, settings: &StepSettings, threads: usize) -> Value {
        let (energy, solver) = (&self.energy, &settings.solver);
        json!({
            "steps": self.steps,
            "bodies": bodies,
            "time": self.time,
            "contacts_last": self.contacts_last,
            "contacts_mean": mean(self.contacts, self.steps),
            "sweeps_mean": self.sweeps_mean(),
            "sweeps_max": self.sweeps_max,
            "unconverged_steps": self.unconverged,
            "breaches": self.breaches,
            "first_breach": self.first_breach,
            "failed_problems": self.failed_problems,
            "eps_glob_max": self.eps_glob_max,
            "scaled_residual_max": self.scaled_max,
            "penetration_max": self.penetration_max,
            "overlap_max": self.overlap_max,
            "joint_error_max": self.joint_error_max,
            "joint_gap_max": self.joint_gap_max,
            "verdict": self.verdict().to_json(),
            "energy": {
                "kinetic": energy.kinetic,
                "potential": energy.potential,
                "work": energy.work,
                "dissipated": energy.dissipated,
                "impact": energy.impact,
                "friction": energy.friction,
                "balance_error": energy.balance_error,
                "balance_error_max": self.books.balance_error,
                "created": self.books.to_json(),
            },
            "seconds": {
                "total": self.total,
                "detect": self.detect,
                "localise": self.localise,
                "solve": self.solve,
                "output": self.output,
            },
            "threads": threads,
            "solver": { "global": solver.global.name(), "local": solver.local.name(), "tolerance": solver.tolerance },
            "version": env!("CARGO_PKG_VERSION"),
        })
    }
}

fn mean(sum: u64, count: u64) -> f64 {
    if count == 0 { 0.0 } else { sum as f64 / count as f64 }
}
