//! Global solvers: all contacts together.

mod nlgs;

use crate::block::Vector;
use crate::{Operator, Problem, Report, Row, Settings};

/// The methods by name. Adding one is a file, a variant with its row in [`GLOBAL_METHODS`], and an arm of [`solve`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum GlobalMethod {
    /// Nonlinear Gauss-Seidel.
    #[default]
    Nlgs,
}

/// The table of global solvers.
pub const GLOBAL_METHODS: &[(GlobalMethod, Row)] =
    &[(GlobalMethod::Nlgs, Row { name: "nlgs", about: "nonlinear Gauss-Seidel: contact by contact until all agree" })];

impl GlobalMethod {
    /// Its name in [`GLOBAL_METHODS`].
    pub fn name(self) -> &'static str {
        GLOBAL_METHODS.iter().find(|(method, _)| *method == self).map_or("", |(_, row)| row.name)
    }

    /// The method of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        GLOBAL_METHODS.iter().find(|(_, row)| row.name == name).map(|&(method, _)| method)
    }
}

/// Memory that solves share, so that a solve of a size seen before allocates next to nothing.
#[derive(Clone, Debug, Default)]
pub struct Scratch<State, const D: usize> {
    pub(crate) state: State,
    pub(crate) claimed: Vec<Vector<D>>,
    pub(crate) order: Vec<u32>,
}

impl<State, const D: usize> Scratch<State, D> {
    /// The operator's state at the end of the last solve: what the final impulses do.
    pub fn state(&self) -> &State {
        &self.state
    }
}

/// Solves `problem` from the impulses in `r`, which it replaces.
///
/// Not converging is a status, never an error: the caller owns the policy.
pub fn solve<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    settings: &Settings,
    r: &mut [Vector<D>],
    scratch: &mut Scratch<O::State, D>,
) -> Report {
    match settings.global {
        GlobalMethod::Nlgs => crate::local::with_local(settings, nlgs::Nlgs { problem, settings, r, scratch }),
    }
}
