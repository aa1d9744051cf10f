//! The reference: all cases of one contact in turn, each solved to rounding.
//!
//! ```text
//! q_n ≥ 0                         separated   r = 0
//! −W⁻¹ q ∈ K_μ                    sticking    r = −W⁻¹ q, u = 0
//! else                            sliding     u_n = 0, u_T = −λ r_T, ‖r_T‖ = μ r_n, λ > 0
//! ```
//!
//! with q the velocity without this contact's impulse. Sliding: the multiplier λ is found by a guarded Newton
//! method (`sliding.rs`); ‖r_T(λ)‖ − μ r_n(λ) is positive at λ = 0 (not sticking) and negative at infinity (r_T → 0,
//! r_n → −q_n/W_nn > 0), so there is a root. In the plane it is the intersection of the line u_n = 0 with the cone's edge. (In space it
//! solves the quartic of Bonnefon & Daviet 2011.) With rolling T and R have a multiplier each; the answer is checked, and where the
//! search has failed (strong coupling) Newton's method on both projections is tried from several starts.
//!
//! Slower than the others by the search for λ; where W couples normal and tangent strongly there may be several roots, and it
//! takes one.

use super::rolling::{Set, equilibrated};
use super::sliding::Sliding;
use super::{Eal, Ebp, IMMOVABLE, LocalSolver, Visit, bilateral, free, separated};
use crate::block::{Matrix, Vector, axpy, dot, mul, norm, row_sum_norm, solve, solve_definite, sub, tangent_norm};
use crate::cone::{part, part_norms};
use crate::{Cone, Parameter};

/// Enumeration of the cases.
#[derive(Clone, Copy, Debug)]
pub struct Exact;

impl LocalSolver for Exact {
    const CLAIMS: bool = true;

    #[inline]
    fn visit<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        if let Cone::Rolling { mu, mu_r } = cone
            && D > 1
        {
            return equilibrated(*w, [mu, mu_r], *u, *r, rolling);
        }
        if let Cone::Bilateral { held } = cone {
            let Visit { r, u, converged } = bilateral::hold(*w, held, *u, *r);
            return Visit { r, u, converged };
        }
        let q = free(w, u, r);
        if D > 1 && cone == Cone::Sticking {
            return held(w, &q);
        }
        if let Some(visit) = open(w, u, r, &q) {
            return visit;
        }
        if D == 1 {
            return Visit { r: std::array::from_fn(|i| -q[i] / w[0][0]), u: [0.0; D], converged: true };
        }
        let mu = cone.friction();
        if let Some(r) = at_rest_plainly(w, &q).or_else(|| at_rest(*w, q))
            && tangent_norm(&r) <= mu * r[0]
        {
            return Visit { r, u: [0.0; D], converged: true };
        }
        let (r, set) = Sliding::new(w, &q, [mu, 0.0], [0; D]).search();
        sliding(w, &q, &r, &set)
    }
}

/// No impulse: where there is no approach, or where the normal cannot move and no impulse would stop one.
fn open<const D: usize>(w: &Matrix<D>, u: &Vector<D>, r: &Vector<D>, q: &Vector<D>) -> Option<Visit<D>> {
    if q[0] >= 0.0 {
        return Some(separated(w, u, r));
    }
    (w[0][0] < IMMOVABLE).then(|| Visit { converged: false, ..separated(w, u, r) })
}

/// −W⁻¹ q, the impulse that brings the contact to rest, for a block that is regular and exactly symmetric, as those of bodies are.
#[inline(always)]
fn at_rest_plainly<const D: usize>(w: &Matrix<D>, q: &Vector<D>) -> Option<Vector<D>> {
    let mut symmetric = true;
    for i in 1..D {
        for j in 0..i {
            symmetric &= w[i][j] == w[j][i];
        }
    }
    // A block that hardly moves would need an impulse that is no number.
    if symmetric { solve_definite(w, &q.map(|x| -x)).filter(|r| dot(r, r).is_finite()) } else { None }
}

/// The same for any block; `None` where no impulse does it. Out of line and by value, for the sake of the visits without need of it.
#[cold]
#[inline(never)]
pub(super) fn at_rest<const D: usize>(w: Matrix<D>, q: Vector<D>) -> Option<Vector<D>> {
    let stops = |r: &Vector<D>| norm(&after(&w, &q, r)) <= 1e-9 * norm(&q);
    let minus = q.map(|x| -x);
    if let Some(r) = solve(&w, &minus).filter(stops) {
        return Some(r);
    }
    // Singular: one of the many impulses, by rounds of the regular block W + ε I.
    let epsilon = 1e-8 * row_sum_norm(&w);
    let regular = std::array::from_fn(|i| std::array::from_fn(|j| w[i][j] + if i == j { epsilon } else { 0.0 }));
    let mut r = [0.0; D];
    for _ in 0..4 {
        r = sub(&r, &solve(&regular, &after(&w, &q, &r))?);
    }
    (norm(&after(&w, &q, &r)) <= 1e-12 * norm(&q)).then_some(r)
}

/// A sticking contact: u = 0 if that takes a push along the normal, else the tangent alone is held.
#[inline]
pub(super) fn held<const D: usize>(w: &Matrix<D>, q: &Vector<D>) -> Visit<D> {
    match at_rest_plainly(w, q).filter(|r| r[0] >= 0.0) {
        Some(r) => Visit { r, u: [0.0; D], converged: true },
        None => {
            let Visit { r, u, converged } = held_otherwise(*w, *q);
            Visit { r, u, converged }
        }
    }
}

#[cold]
#[inline(never)]
fn held_otherwise<const D: usize>(w: Matrix<D>, q: Vector<D>) -> Visit<D> {
    if let Some(r) = at_rest(w, q).filter(|r| r[0] >= 0.0) {
        return Visit { r, u: [0.0; D], converged: true };
    }
    let same = |i: usize, j: usize| f64::from(u8::from(i == j));
    let tangent = std::array::from_fn(|i| std::array::from_fn(|j| if i == 0 || j == 0 { same(i, j) } else { w[i][j] }));
    let right = std::array::from_fn(|i| if i == 0 { 0.0 } else { q[i] });
    let r = at_rest_plainly(&tangent, &right).or_else(|| at_rest(tangent, right)).unwrap_or([0.0; D]);
    Visit { r, u: after(&w, &q, &r), converged: true }
}

/// Puts the last digit of r on the edge of the cone and on u_n = 0: keeps the directions and solves for the rest.
fn sliding<const D: usize>(w: &Matrix<D>, q: &Vector<D>, r: &Vector<D>, set: &Set<D>) -> Visit<D> {
    match set.enforce(w, q, r) {
        Some(r) if r[0] >= 0.0 => Visit { r, u: set.velocity(w, q, &r), converged: true },
        _ => Visit { r: *r, u: after(w, q, r), converged: false },
    }
}

/// A rolling contact, in variables of one unit.
fn rolling<const D: usize>(w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
    let Cone::Rolling { mu, mu_r } = cone else { return separated(w, u, r) };
    let q = free(w, u, r);
    if let Some(visit) = open(w, u, r, &q) {
        return visit;
    }
    if let Some(r) = at_rest_plainly(w, &q).or_else(|| at_rest(*w, q)) {
        let [slip, roll] = part_norms(&r);
        if slip <= mu * r[0] && roll <= mu_r * r[0] {
            return Visit { r, u: [0.0; D], converged: true };
        }
    }
    let (found, set) = Sliding::new(w, &q, [mu, mu_r], std::array::from_fn(part::<D>)).search();
    let mut best = sliding(w, &q, &found, &set);
    let mut least = error(w, cone, &q, &best.r);
    let starts = [best.r, *r, cone.nearest(r), [0.0; D]];
    let rho = Parameter::Auto.resolve();
    for k in 0..2 * starts.len() {
        if least <= ROUNDING {
            break;
        }
        let (r, u) = (&starts[k / 2], &after(w, &q, &starts[k / 2]));
        let visit = if k % 2 == 0 { Ebp { rho }.rolling(w, cone, u, r) } else { Eal { rho }.rolling(w, cone, u, r) };
        let error = error(w, cone, &q, &visit.r);
        if error < least {
            (best, least) = (visit, error);
        }
    }
    best.converged = least <= ROUNDING;
    best
}

/// What the reference calls exact: some digits of the terms' size.
const ROUNDING: f64 = 1e-12;

/// The natural residual of an impulse against the velocities' size.
fn error<const D: usize>(w: &Matrix<D>, cone: Cone, q: &Vector<D>, r: &Vector<D>) -> f64 {
    let (u, size) = (after(w, q, r), row_sum_norm(w));
    let image = cone.nearest(&axpy(r, -1.0 / size, &cone.hat(&u)));
    let error = size * norm(&sub(r, &image)) / (norm(q) + size * norm(r));
    if error.is_finite() { error } else { f64::INFINITY }
}

/// q + W r.
fn after<const D: usize>(w: &Matrix<D>, q: &Vector<D>, r: &Vector<D>) -> Vector<D> {
    let wr = mul(w, r);
    std::array::from_fn(|i| q[i] + wr[i])
}
