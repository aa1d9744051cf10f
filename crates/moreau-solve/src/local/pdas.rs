//! Primal-dual active set (PDAS), section 4.3: the sets are read from (r, u), the law is then enforced exactly on each.
//!
//! ```text
//! τ_n = r_n − γ_n u_n,   τ_T = r_T − γ_T u_T
//! I: τ_n < 0              separated   r = 0                                      (eqs. 38, 41)
//! A: τ_n ≥ 0, frictionless            u_n = 0, r_n ← r_n − u_n/W_nn, r_T = 0       (eqs. 37, 39, 40)
//! A: ‖τ_T‖ ≤ μ r_n        sticking    u = 0, r ← r − W⁻¹ u
//! A: ‖τ_T‖ > μ r_n        sliding     u_n = 0, r_T = μ r_n τ_T/‖τ_T‖
//! ```
//!
//! The last two rows carry the paper's idea to Coulomb friction, as its conclusion asks for (compare Hüeber, Stadler & Wohlmuth 2008).
//! There the tangent is judged with the normal closed: u_T is taken after u_n has been brought to zero, and r_n is what closes
//! the normal under τ_T. A sticking impulse outside the cone is no member of that set, and the contact slides.
//!
//! With rolling T and R are two such parts, each sticking or sliding on its own bound. They are coupled, as forces and moments of one body
//! are, so the sets read from τ may contradict the pair enforced on them; they are then corrected a few times within the visit.
//!
//! One visit is one update of the sets. With the automatic γ and no tangential impulse to begin with it is exact in the plane, and in
//! space where the tangential block is a multiple of the identity, as for balls; else sets and direction settle over the sweeps.

use super::rolling::{Set, equilibrated};
use super::{IMMOVABLE, LocalSolver, Visit, bilateral, exact, free, moved, separated};
use crate::block::{
    Matrix, Vector, axpy, dot, norm, row_sum_norm, solve_definite, sub, tangent_norm, tangent_row_sum_norm, velocity_after,
};
use crate::cone::{part, part_norms};
use crate::{Cone, Resolved};

/// One update of the active sets a visit.
#[derive(Clone, Copy, Debug)]
pub struct Pdas {
    /// γ; automatic is 1/W_nn along the normal and 1/‖S‖ along the tangent, S the tangential block with the normal closed.
    pub gamma: Resolved,
}

impl LocalSolver for Pdas {
    const CLAIMS: bool = true;

    #[inline(always)]
    fn visit<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        if let Cone::Rolling { mu, mu_r } = cone {
            let Visit { r, u, converged } = equilibrated(*w, [mu, mu_r], *u, *r, |w, cone, u, r| self.rolling(w, cone, u, r));
            return Visit { r, u, converged };
        }
        if let Cone::Bilateral { held } = cone {
            let Visit { r, u, converged } = bilateral::hold(*w, held, *u, *r);
            return Visit { r, u, converged };
        }
        if D > 1 && cone == Cone::Sticking {
            return exact::held(w, &free(w, u, r));
        }
        // The inverse does not wait for u: a sweep is bound by what one visit hands to the next.
        let inverse = 1.0 / w[0][0];
        let tau_n = r[0] - self.gamma.value(inverse) * u[0];
        // A normal that cannot move: no impulse closes it, and its inverse is no number.
        if tau_n < 0.0 || w[0][0] < IMMOVABLE {
            return separated(w, u, r);
        }
        if D == 1 {
            let pressed = r[0] - inverse * u[0];
            // With γ other than 1/W_nn the set may be wrong, and eq. 40 would pull: that contact is separated.
            return if pressed < 0.0 { separated(w, u, r) } else { Visit { r: [pressed; D], u: [0.0; D], converged: true } };
        }
        let mu = cone.friction();
        let tau = self.closed(w, u, r);
        let length = tangent_norm(&tau);
        if length <= mu * tau[0]
            && let Some(held) = stick(w, u, r)
            && tangent_norm(&held.r) <= mu * held.r[0]
        {
            return held;
        }
        let direction = |i: usize| if i == 0 { 1.0 } else { mu * tau[i] / length };
        slide(w, u, r, &std::array::from_fn(|i| if i > 0 && length == 0.0 { 0.0 } else { direction(i) }))
    }
}

impl Pdas {
    /// (r_n that closes the normal under τ_T, τ_T), where τ_T = r_T − γ_T u_T with u_n brought to zero.
    #[inline]
    fn closed<const D: usize>(&self, w: &Matrix<D>, u: &Vector<D>, r: &Vector<D>) -> Vector<D> {
        let schur: Matrix<D> = std::array::from_fn(|i| std::array::from_fn(|j| w[i][j] - w[i][0] * w[0][j] / w[0][0]));
        let size = tangent_row_sum_norm(&schur);
        // A tangent that cannot move has no γ of its own; the normal's lets its direction settle.
        let gamma = self.gamma.value(1.0 / if size >= IMMOVABLE { size } else { w[0][0] });
        let mut tau: Vector<D> = std::array::from_fn(|i| r[i] - gamma * (u[i] - w[i][0] * u[0] / w[0][0]));
        let coupled: f64 = (1..D).map(|i| w[0][i] * (tau[i] - r[i])).sum();
        tau[0] = r[0] - (u[0] + coupled) / w[0][0];
        tau
    }

    /// The update for a contact with rolling, in variables of one unit: T and R each stick or slide. The sets are corrected where the
    /// enforced pair contradicts them; if they do not settle the visit is one projection.
    fn rolling<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        let Cone::Rolling { mu, mu_r } = cone else { return separated(w, u, r) };
        if w[0][0] < IMMOVABLE || r[0] - self.gamma.value(1.0 / w[0][0]) * u[0] < 0.0 {
            return separated(w, u, r);
        }
        let (limits, tau, q) = ([mu, mu_r], self.closed(w, u, r), free(w, u, r));
        let small = 1e-14 * (norm(&q) + norm(u));
        let lengths = part_norms(&tau);
        let mut set = Set { slides: [false; 2], along: [0.0; D], part: std::array::from_fn(part::<D>) };
        for p in 0..2 {
            set.slides[p] = lengths[p] > limits[p] * tau[0] || limits[p] == 0.0;
            direct(&mut set, p, limits[p], &tau);
        }
        let mut slid = set.slides;
        for round in 0..CORRECTIONS {
            let Some(r_new) = set.enforce(w, &q, r).filter(|r| r[0] >= 0.0) else { break };
            let u_new = set.velocity(w, &q, &r_new);
            let mut settled = true;
            for p in 0..2 {
                // Both at once may go round in circles; one at a time, the later rounds.
                if limits[p] == 0.0 || (round > 1 && !settled) {
                    continue;
                }
                let pushed: f64 = (1..D).filter(|&i| part::<D>(i) == p).map(|i| set.along[i] * u_new[i]).sum();
                if set.slides[p] && pushed > limits[p] * small {
                    // Friction along the velocity is no friction.
                    (set.slides[p], settled) = (false, false);
                } else if !set.slides[p] && part_norms(&r_new)[p] > limits[p] * r_new[0] * (1.0 + 1e-14) {
                    // Along τ as in any visit, so that the direction settles over the visits; if friction would drive there, along
                    // the impulse that leaves the cone.
                    direct(&mut set, p, limits[p], if slid[p] { &r_new } else { &tau });
                    (set.slides[p], slid[p], settled) = (true, true, false);
                }
            }
            if settled {
                return Visit { r: r_new, u: u_new, converged: true };
            }
        }
        let size = row_sum_norm(w);
        moved(w, u, r, cone.nearest(&axpy(r, -1.0 / size, &cone.hat(u))))
    }
}

/// How often a visit corrects the sets of a rolling contact: there are nine of them in the plane.
const CORRECTIONS: usize = 9;

/// Makes part p of the set slide along that part of `r`, if it slides.
fn direct<const D: usize>(set: &mut Set<D>, p: usize, limit: f64, r: &Vector<D>) {
    let length = part_norms(r)[p];
    for i in (1..D).filter(|&i| part::<D>(i) == p) {
        set.along[i] = if length > 0.0 { limit * r[i] / length } else { 0.0 };
    }
}

/// u = 0; `None` where a singular block does not allow it.
#[inline]
fn stick<const D: usize>(w: &Matrix<D>, u: &Vector<D>, r: &Vector<D>) -> Option<Visit<D>> {
    let r = match solve_definite(w, u) {
        Some(change) => sub(r, &change),
        None => axpy(r, 1.0, &exact::at_rest(*w, *u)?),
    };
    Some(Visit { r, u: [0.0; D], converged: true })
}

/// r along `direction` = (1, μ s), u_n = 0.
#[inline]
fn slide<const D: usize>(w: &Matrix<D>, u: &Vector<D>, r: &Vector<D>, direction: &Vector<D>) -> Visit<D> {
    let normal_free = free(w, u, r)[0];
    let stiffness = dot(&w[0], direction);
    // Where friction alone would lift the contact (W_nn + μ W_nT·s ≤ 0), no impulse along the ray closes it: step without it.
    let r_n = if stiffness > 0.0 { -normal_free / stiffness } else { r[0] - u[0] / w[0][0] };
    let r_new = axpy(&[0.0; D], r_n.max(0.0), direction);
    let mut u_new = velocity_after(w, u, r, &r_new);
    if stiffness > 0.0 && r_n >= 0.0 {
        u_new[0] = 0.0;
    }
    Visit { r: r_new, u: u_new, converged: true }
}
