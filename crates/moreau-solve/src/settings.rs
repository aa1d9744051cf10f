//! How a problem is to be solved.

use crate::{GlobalMethod, Kernels, LocalMethod, Order, Row};

/// Which measure stops the sweeps.
///
/// Whichever it is, an answer has converged only if the law holds for its impulses: [`crate::Residual::certifies`] gives the bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Criterion {
    /// The paper's ε_glob (eq. 42), with the distance of the impulses from their cones.
    EpsGlob,
    /// The scaled residual, which does not depend on units; see [`crate::residual`].
    #[default]
    Scaled,
    /// The residual that Siconos reports, which does.
    Siconos,
    /// The larger of the scaled and Siconos's residual.
    Strict,
}

/// The table of criteria.
pub const CRITERIA: &[(Criterion, Row)] = &[
    (Criterion::EpsGlob, Row { name: "eps_glob", about: "the paper's ε_glob, in units" }),
    (Criterion::Scaled, Row { name: "scaled", about: "the scaled residual, without units" }),
    (Criterion::Siconos, Row { name: "siconos", about: "the residual that Siconos reports" }),
    (Criterion::Strict, Row { name: "strict", about: "the larger of the scaled and Siconos's residual" }),
];

impl Criterion {
    /// Its name in [`CRITERIA`].
    pub fn name(self) -> &'static str {
        CRITERIA.iter().find(|(criterion, _)| *criterion == self).map_or("", |(_, row)| row.name)
    }

    /// The criterion of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        CRITERIA.iter().find(|(_, row)| row.name == name).map(|&(criterion, _)| criterion)
    }
}

/// The parameter ρ of SBP, SAL, EBP and EAL, or γ of PDAS: how far a velocity moves an impulse, kg.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Parameter {
    /// From the contact's own block of W; see each method.
    #[default]
    Auto,
    /// The automatic value times a factor.
    Relative(f64),
    /// One value for all contacts, kg, as in the paper.
    Absolute(f64),
}

/// A parameter made ready for the sweeps, where a choice at each visit would cost more than the visit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolved {
    factor: f64,
    fixed: f64,
}

impl Parameter {
    /// The parameter as a factor of the automatic value and a fixed part, one of which is zero.
    pub fn resolve(self) -> Resolved {
        match self {
            Parameter::Auto => Resolved { factor: 1.0, fixed: 0.0 },
            Parameter::Relative(factor) => Resolved { factor, fixed: 0.0 },
            Parameter::Absolute(fixed) => Resolved { factor: 0.0, fixed },
        }
    }
}

impl Resolved {
    /// Its value where the automatic one is `automatic`.
    #[inline]
    pub fn value(self, automatic: f64) -> f64 {
        self.factor * automatic + self.fixed
    }
}

/// Settings of one solve, with sound defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The method over all contacts.
    pub global: GlobalMethod,
    /// The method at one contact.
    pub local: LocalMethod,
    /// What is measured.
    pub criterion: Criterion,
    /// Where to stop.
    pub tolerance: f64,
    /// After how many sweeps, or steps of a method that has none, to give up.
    pub max_sweeps: u64,
    /// After how many seconds to give up. A solve that is stopped by the clock need not give the same bits again.
    pub max_seconds: Option<f64>,
    /// Over-relaxation ω of Gauss-Seidel sweeps, between 0 and 2: r ← P_K(r + ω (r⁺ − r)).
    pub relaxation: f64,
    /// Whether every second sweep of plain Gauss-Seidel goes backwards.
    pub symmetric: bool,
    /// The order of a sweep.
    pub order: Order,
    /// Whether contacts of round bodies are visited several at a time; see [`Kernels`].
    pub kernels: Kernels,
    /// ρ of SBP, SAL, EBP, EAL.
    pub rho: Parameter,
    /// γ of PDAS.
    pub gamma: Parameter,
    /// Whether the report keeps the residuals of every sweep; else they are measured at every one of the first twenty sweeps and
    /// then every sixteenth part of those done, and not kept.
    pub history: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            global: GlobalMethod::Accelerated,
            local: LocalMethod::Pdas,
            criterion: Criterion::Scaled,
            tolerance: 1e-4,
            max_sweeps: 100_000,
            max_seconds: None,
            relaxation: 1.0,
            symmetric: false,
            order: Order::Coloured,
            kernels: Kernels::Auto,
            rho: Parameter::Auto,
            gamma: Parameter::Auto,
            history: false,
        }
    }
}

/// A setting outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{setting} = {value} is out of range: {range}")]
pub struct SettingsError {
    /// Its name.
    pub setting: &'static str,
    /// What was given.
    pub value: f64,
    /// What would be right.
    pub range: &'static str,
}

impl Settings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the first setting that is not a positive, finite number.
    pub fn check(&self) -> Result<(), SettingsError> {
        let value = |parameter: Parameter| parameter.resolve().value(1.0);
        let numbers = [("tolerance", self.tolerance), ("rho", value(self.rho)), ("gamma", value(self.gamma))];
        for (setting, value) in numbers {
            if !(value > 0.0 && value.is_finite()) {
                return Err(SettingsError { setting, value, range: "a positive, finite number" });
            }
        }
        if !(self.relaxation > 0.0 && self.relaxation < 2.0) {
            return Err(SettingsError { setting: "relaxation", value: self.relaxation, range: "between 0 and 2, both excluded" });
        }
        if let Some(value) = self.max_seconds.filter(|&seconds| seconds.is_nan() || seconds <= 0.0) {
            return Err(SettingsError { setting: "max_seconds", value, range: "a positive number" });
        }
        if self.max_sweeps == 0 {
            return Err(SettingsError { setting: "max_sweeps", value: 0.0, range: "1 or more" });
        }
        Ok(())
    }
}
