//! Whether a run is to be relied on: one judgement, which the terminal, `summary.json`, the page and the exit code share.
//!
//! Each check compares a number of the [`Summary`] with a constant of this file. The constants and their reasons are in
//! `docs/reliability.md`, section "The verdict".

use super::Summary;
use crate::step::Created;
use serde::Serialize;
use serde_json::{Value, json};

/// Deepest overlap, as a part of the smaller body's bounding radius. A contact is found at a predicted configuration, half a step ahead, so
/// an impact leaves an overlap of up to half the way of a step. At this bound bodies that meet come a tenth of a radius nearer in a step:
/// beyond it the step is too long for the motion. Sinking in lasting contact has the same bound.
pub const OVERLAP: f64 = 5e-2;

/// Greatest error of a joint, as a part of the smaller body's bounding radius. A step closes joints to rounding or to the tolerance of
/// its solver; the unit is that of theory (67), where 1e-3 is the overlap that is left alone.
pub const JOINT: f64 = 1e-3;

/// Energy gained on balance, as a part of the energy at hand: what is dissipated later does not count against it. Speeds are then wrong by
/// half of it, which is less than a time step of ordinary length costs.
pub const GAINED: f64 = 1e-3;

/// Sum of the energies created, as a part of the energy turned over. A scheme of second order gives and takes energy at each step without
/// drift, so this bound is wider than [`GAINED`].
pub const CREATED: f64 = 1e-2;

/// Error of the energy ledger and energy created that count as rounding, as a part of the largest number of the ledger or of the energy
/// turned over. Steps round by 1e-16 of it each, so 1e-10 is beyond a million steps.
pub const ROUNDING: f64 = 1e-10;

/// One thing that is looked at.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// Its name.
    pub name: &'static str,
    /// True if it speaks for the run.
    pub passed: bool,
    /// What was found, in words.
    pub text: String,
}

/// The judgement of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// All that was looked at.
    pub checks: Vec<Check>,
}

impl Verdict {
    /// Judges a run, or the part of it that was done.
    pub(super) fn of(summary: &Summary) -> Self {
        let checks = [
            ending(summary),
            Some(convergence(summary)),
            limits(summary),
            Some(overlap(summary)),
            joints(summary),
            Some(energy(summary)),
            Some(ledger(summary)),
        ];
        Self { checks: checks.into_iter().flatten().collect() }
    }

    /// True if every check passed.
    pub fn reliable(&self) -> bool {
        self.checks.iter().all(|check| check.passed)
    }

    /// Returns the check of this name.
    pub fn check(&self, name: &str) -> Option<&Check> {
        self.checks.iter().find(|check| check.name == name)
    }

    /// Returns why the run is not to be relied on; empty if it is.
    pub fn reasons(&self) -> Vec<String> {
        self.checks.iter().filter(|check| !check.passed).map(|check| check.text.clone()).collect()
    }

    /// Returns the object `verdict` of `summary.json`.
    pub fn to_json(&self) -> Value {
        json!({ "reliable": self.reliable(), "reasons": self.reasons(), "checks": self.checks })
    }
}

fn ending(summary: &Summary) -> Option<Check> {
    let text = format!("the run failed: {}", summary.failure.as_ref()?);
    Some(Check { name: "End", passed: false, text })
}

fn convergence(summary: &Summary) -> Check {
    let (steps, bad) = (summary.steps, summary.unconverged);
    let residual = format!("the scaled residual is at most {}", figures(summary.scaled_max));
    let text = match bad {
        0 => format!("the solver met its criterion in all {steps} steps; {residual}"),
        _ => format!("the solver did not meet its criterion in {bad} of {steps} steps; {residual}"),
    };
    Check { name: "Convergence", passed: bad == 0 && summary.scaled_max.is_finite() && summary.eps_glob_max.is_finite(), text }
}

fn limits(summary: &Summary) -> Option<Check> {
    let first = summary.first_breach.as_deref().unwrap_or("see the column breach of steps.csv");
    let text = format!("{} steps broke a limit of [guard]; the first: {first}", summary.breaches);
    (summary.breaches > 0).then_some(Check { name: "Limits", passed: false, text })
}

fn overlap(summary: &Summary) -> Check {
    let (deep, part) = (figures(summary.penetration_max), percent(summary.overlap_max));
    let passed = summary.overlap_max <= OVERLAP && summary.penetration_max.is_finite();
    let text = format!("bodies overlap by at most {part} of the smaller one's radius, and by at most {deep} m");
    Check { name: "Overlap", passed, text: limited(text, passed, OVERLAP) }
}

fn joints(summary: &Summary) -> Option<Check> {
    let (open, part) = (figures(summary.joint_error_max), percent(summary.joint_gap_max));
    let passed = summary.joint_gap_max <= JOINT;
    let text = format!("joints are open by at most {open} m, {part} of the smaller body's radius");
    (summary.joint_error_max != 0.0).then(|| Check { name: "Joints", passed, text: limited(text, passed, JOINT) })
}

/// True if more energy was created than rounding creates.
pub(super) fn beyond_rounding(summary: &Summary) -> bool {
    let created = summary.books.created.total();
    exceeds(created, ROUNDING * summary.books.turnover())
}

fn energy(summary: &Summary) -> Check {
    let books = &summary.books;
    let (created, turnover, scale) = (books.created.total(), books.turnover(), books.scale());
    let gained = books.gained <= GAINED * scale;
    let passed = gained && created <= CREATED * turnover;
    let parts: Vec<String> = books
        .created
        .parts()
        .iter()
        .zip(Created::NAMES)
        .zip(books.worst)
        .filter(|((energy, _), _)| exceeds(**energy, ROUNDING * turnover))
        .map(|((energy, name), worst)| {
            format!("{} J by {name} (most in step {}: {} J)", figures(*energy), worst.step, figures(worst.energy))
        })
        .collect();
    let made = match parts.is_empty() {
        true => "no energy was created beyond rounding".to_owned(),
        false => format!(
            "{} J were created, {} of the energy turned over: {}",
            figures(created),
            percent(share(created, turnover)),
            parts.join(", "),
        ),
    };
    let text = match parts.is_empty() && gained {
        true => made,
        false => format!(
            "{made}; on balance {} J were gained, {} of the energy at hand",
            figures(books.gained),
            percent(share(books.gained, scale)),
        ),
    };
    let text = match (passed, gained) {
        (true, _) => text,
        (_, false) => limited(text, false, GAINED),
        (_, true) => limited(text, false, CREATED),
    };
    Check { name: "Energy", passed, text }
}

fn ledger(summary: &Summary) -> Check {
    let (error, whole) = (summary.books.balance_error, summary.books.magnitude());
    // Bodies at rest turn over their weights' work step by step, and rounding is of that.
    let passed = error <= ROUNDING * whole || error <= f64::EPSILON * summary.books.turnover();
    let text =
        format!("the energy ledger is open by {} J, {} of its largest number", figures(error), percent(share(error, whole)));
    Check { name: "Ledger", passed, text: limited(text, passed, ROUNDING) }
}

/// True if a number is above its bound or NaN.
fn exceeds(x: f64, bound: f64) -> bool {
    x > bound || x.is_nan()
}

/// Adds the bound that was exceeded.
fn limited(text: String, passed: bool, bound: f64) -> String {
    if passed { text } else { format!("{text}; the limit is {}", percent(bound)) }
}

/// Returns a / b, and 0 for 0 / 0.
fn share(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a / b }
}

/// Writes a share in percent.
fn percent(share: f64) -> String {
    format!("{} %", figures(100.0 * share))
}

/// Writes a number with three digits.
fn figures(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        1e-2..1.0 => format!("{x:.3}"),
        1.0..10.0 => format!("{x:.2}"),
        10.0..100.0 => format!("{x:.1}"),
        100.0..1e5 => format!("{x:.0}"),
        _ => format!("{x:.2e}"),
    }
}
