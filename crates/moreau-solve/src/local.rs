//! Local solvers: what to do at one contact while the others wait (section 4 of Barboteu & Dumont 2017).
//!
//! A visit gets the block W_cc, the law, and the pair (u, r) as the equation of motion has it; it returns a new impulse and, for
//! methods that are exact in the law rather than in the motion, the velocity that they claim. Without friction all of them solve
//! 0 ≤ u_n ⊥ r_n ≥ 0; with friction, Coulomb's law in two and three dimensions, and rolling friction
//! with three and five components; and bilateral constraints, of whichever components. Blocks may be singular, somewhat unsymmetric or zero: no visit makes of finite numbers others.

mod bilateral;
mod eal;
mod ebp;
mod exact;
mod newton;
mod pdas;
mod rolling;
mod sal;
mod sbp;
mod sliding;
#[cfg(test)]
mod tests;

pub use eal::Eal;
pub use ebp::Ebp;
pub use exact::Exact;
pub use pdas::Pdas;
pub use sal::Sal;
pub use sbp::Sbp;

use crate::block::{Matrix, Vector, mul, sub, velocity_after};
use crate::{Cone, Row, Settings};

/// The answer of one visit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visit<const D: usize> {
    /// The new impulse.
    pub r: Vector<D>,
    /// The velocity that goes with it according to the method; ε_motion compares it with the equation of motion.
    pub u: Vector<D>,
    /// Whether the method reached its own end: false only where a Newton iteration ran out of rounds.
    pub converged: bool,
}

/// A method for one contact.
pub trait LocalSolver: Copy + Send + Sync {
    /// Whether the velocity in [`Visit`] is a claim of its own; SBP and SAL take theirs from the equation of motion.
    const CLAIMS: bool;

    /// One visit: `u` is the velocity with the impulse `r` still applied.
    fn visit<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D>;
}

/// The methods by name. Adding one is a file, a variant with its row in [`LOCAL_METHODS`], and an arm of [`with_local`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum LocalMethod {
    /// Standard bipotential.
    Sbp,
    /// Standard augmented Lagrangian.
    Sal,
    /// Enhanced bipotential.
    Ebp,
    /// Enhanced augmented Lagrangian.
    Eal,
    /// Primal-dual active set.
    Pdas,
    /// Enumeration of the cases.
    Exact,
}

/// The table of local solvers.
pub const LOCAL_METHODS: &[(LocalMethod, Row)] = &[
    (LocalMethod::Sbp, Row { name: "sbp", about: "standard bipotential: one Uzawa projection a visit, step ρ" }),
    (LocalMethod::Sal, Row { name: "sal", about: "standard augmented Lagrangian: one projected gradient step a visit, step ρ" }),
    (LocalMethod::Ebp, Row { name: "ebp", about: "enhanced bipotential: Newton to convergence at each visit" }),
    (
        LocalMethod::Eal,
        Row { name: "eal", about: "enhanced augmented Lagrangian: generalised Newton to convergence at each visit" },
    ),
    (LocalMethod::Pdas, Row { name: "pdas", about: "primal-dual active set: one update of the sets a visit" }),
    (LocalMethod::Exact, Row { name: "exact", about: "reference: enumerates separated, sticking and sliding" }),
];

impl LocalMethod {
    /// Its name in [`LOCAL_METHODS`].
    pub fn name(self) -> &'static str {
        LOCAL_METHODS.iter().find(|(method, _)| *method == self).map_or("", |(_, row)| row.name)
    }

    /// The method of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        LOCAL_METHODS.iter().find(|(_, row)| row.name == name).map(|&(method, _)| method)
    }
}

/// What runs with a concrete local solver, so that the choice is made once and not at each visit.
pub trait WithLocal {
    /// Its result.
    type Output;
    /// Runs with `local`.
    fn run<L: LocalSolver>(self, local: L) -> Self::Output;
}

/// Runs `task` with the local solver that `settings` name.
pub fn with_local<T: WithLocal>(settings: Settings, task: T) -> T::Output {
    match settings.local {
        LocalMethod::Sbp => task.run(Sbp { rho: settings.rho.resolve() }),
        LocalMethod::Sal => task.run(Sal { rho: settings.rho.resolve() }),
        LocalMethod::Ebp => task.run(Ebp { rho: settings.rho.resolve() }),
        LocalMethod::Eal => task.run(Eal { rho: settings.rho.resolve() }),
        LocalMethod::Pdas => task.run(Pdas { gamma: settings.gamma.resolve() }),
        LocalMethod::Exact => task.run(Exact),
    }
}

/// What counts as no mobility at all, 1/kg: below it a step 1/W, squared in a norm, might leave the numbers. A block of zeros is what
/// is meant: a contact between bodies that are driven, or a direction in which neither can move.
const IMMOVABLE: f64 = 1e-120;

/// The velocity without the impulse of this contact.
#[inline]
fn free<const D: usize>(w: &Matrix<D>, u: &Vector<D>, r: &Vector<D>) -> Vector<D> {
    sub(u, &mul(w, r))
}

/// No impulse, and the velocity that leaves.
#[inline]
fn separated<const D: usize>(w: &Matrix<D>, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
    Visit { r: [0.0; D], u: free(w, u, r), converged: true }
}

/// One projection: the new impulse is `image`, the velocity follows the equation of motion.
#[inline]
fn moved<const D: usize>(w: &Matrix<D>, u: &Vector<D>, r: &Vector<D>, image: Vector<D>) -> Visit<D> {
    Visit { r: image, u: velocity_after(w, u, r, &image), converged: true }
}
