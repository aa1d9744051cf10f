//! How good an answer is: one place, used by all solvers and owned by none.
//!
//! Two measures. The paper's ε_glob (eq. 42) is the mean over the contacts of
//!
//! - ε_motion = ‖ũ_c − u_c‖, the velocity ũ that the local solver claims against u = W r + q recomputed from all impulses; zero for
//!   methods that claim none (SBP and SAL);
//! - ε_bipotential = |ũ·r + μ r_n ‖ũ_T‖|, which vanishes if (ũ, r) obeys the law;
//! - ε_penetration = −min(0, ũ_n), with ‖ũ_T‖ added for a sticking contact, whose tangential velocity must vanish.
//!
//! It adds velocities and an energy, so its meaning changes with the units. The scaled residual does not:
//!
//! ```text
//! e_c = w_c ‖r − P_K(r − û/w_c)‖,  w_c = tr(W_cc)/D,  û = u + μ‖u_T‖ n,    scaled = √(Σ e_c²) / √(Σ ‖q_c‖² + ‖u_c‖²)
//! ```
//!
//! with P_K the projection on the cone of impulses: e_c is a velocity, zero exactly at a solution, and the velocities without and with
//! impulses (of which only the normal part counts where there is no friction) are what it is compared with. Velocities here are those of the normal form, with
//! the shift added; with restitution they are 1 + e times the formal ones of eq. 21, so with one coefficient e ε_glob is never smaller than the paper's.

use crate::block::{Vector, axpy, dot, norm, sub, tangent_norm};
use crate::{Cone, Criterion, Operator, Problem};

/// The three parts of ε_glob, each a mean over the contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EpsGlob {
    /// Error in the equation of motion, m/s.
    pub motion: f64,
    /// Value of the bipotential, J.
    pub bipotential: f64,
    /// Velocity of interpenetration, m/s.
    pub penetration: f64,
}

impl EpsGlob {
    /// ε_glob itself.
    pub fn total(&self) -> f64 {
        self.motion + self.bipotential + self.penetration
    }
}

/// Both measures of one answer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residual {
    /// The paper's criterion in its parts.
    pub eps_glob: EpsGlob,
    /// The scaled residual, without units.
    pub scaled: f64,
}

/// What the three terms of eq. 42 are at one contact.
#[inline]
fn eps_glob<const D: usize>(cone: Cone, claimed: &Vector<D>, u: &Vector<D>, r: &Vector<D>) -> EpsGlob {
    let slip = tangent_norm(claimed);
    let held = if cone == Cone::Sticking { slip } else { 0.0 };
    // A contact without friction has no law for its tangent.
    let (power, motion) = match cone {
        Cone::Signorini => (claimed[0] * r[0], (claimed[0] - u[0]).abs()),
        Cone::Coulomb(mu) => (dot(claimed, r) + mu * r[0] * slip, norm(&sub(claimed, u))),
        Cone::Sticking => (dot(claimed, r), norm(&sub(claimed, u))),
    };
    EpsGlob { motion, bipotential: power.abs(), penetration: (-claimed[0]).max(0.0) + held }
}

/// w ‖r − P_K(r − û/w)‖ at one contact.
#[inline]
fn natural<const D: usize>(cone: Cone, w: f64, u: &Vector<D>, r: &Vector<D>) -> f64 {
    if cone == Cone::Signorini {
        return (w * (r[0] - (r[0] - u[0] / w).max(0.0))).abs();
    }
    let mut hat = *u;
    hat[0] += cone.friction() * tangent_norm(u);
    let (image, _) = cone.project(&axpy(r, -1.0 / w, &hat));
    w * norm(&sub(r, &image))
}

/// Both measures at the impulses `r` for which `state` stands; `claimed` are the velocities that local solvers gave, if they do.
pub fn measure<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    state: &O::State,
    r: &[Vector<D>],
    claimed: Option<&[Vector<D>]>,
) -> Residual {
    Residual { eps_glob: mean_eps_glob(problem, state, r, claimed), scaled: scaled(problem, state, r) }
}

/// The one number that is compared with the tolerance.
pub fn criterion<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    state: &O::State,
    r: &[Vector<D>],
    claimed: Option<&[Vector<D>]>,
    which: Criterion,
) -> f64 {
    match which {
        Criterion::EpsGlob => mean_eps_glob(problem, state, r, claimed).total(),
        Criterion::Scaled => scaled(problem, state, r),
    }
}

/// ε_glob (eq. 42) in its parts.
fn mean_eps_glob<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    state: &O::State,
    r: &[Vector<D>],
    claimed: Option<&[Vector<D>]>,
) -> EpsGlob {
    let mut sum = EpsGlob::default();
    for c in 0..problem.len() {
        let u = problem.velocity(state, c);
        let part = eps_glob(problem.cones[c], claimed.map_or(&u, |claimed| &claimed[c]), &u, &r[c]);
        sum.motion += part.motion;
        sum.bipotential += part.bipotential;
        sum.penetration += part.penetration;
    }
    let mean = 1.0 / problem.len().max(1) as f64;
    EpsGlob { motion: sum.motion * mean, bipotential: sum.bipotential * mean, penetration: sum.penetration * mean }
}

/// The scaled residual.
fn scaled<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, state: &O::State, r: &[Vector<D>]) -> f64 {
    let (mut errors, mut speeds) = (0.0, 0.0);
    for c in 0..problem.len() {
        let (cone, q, u) = (problem.cones[c], &problem.q[c], problem.velocity(state, c));
        let error = natural(cone, mean_diagonal(problem, c), &u, &r[c]);
        errors += error * error;
        speeds += if cone == Cone::Signorini { q[0] * q[0] + u[0] * u[0] } else { dot(q, q) + dot(&u, &u) };
    }
    // A projection may make zero of what is no number; the velocities still show it.
    match (errors.is_finite() && speeds.is_finite(), errors == 0.0) {
        (false, _) => f64::NAN,
        (true, true) => 0.0,
        (true, false) => (errors / speeds).sqrt(),
    }
}

/// w_c of the scaled residual.
#[inline]
fn mean_diagonal<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, c: usize) -> f64 {
    let block = problem.operator.diagonal(c);
    if problem.cones[c] == Cone::Signorini {
        return block[0][0];
    }
    (0..D).map(|i| block[i][i]).sum::<f64>() / D as f64
}
