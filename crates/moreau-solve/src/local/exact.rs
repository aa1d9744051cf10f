//! The reference: all cases of one contact in turn, each solved to rounding.
//!
//! ```text
//! q_n ≥ 0                         separated   r = 0
//! −W⁻¹ q ∈ K_μ                    sticking    r = −W⁻¹ q, u = 0
//! else                            sliding     u_n = 0, u_T = −λ r_T, ‖r_T‖ = μ r_n, λ > 0
//! ```
//!
//! with q the velocity without this contact's impulse. Sliding: eliminating r_n by u_n = 0 leaves (S + λ I) r_T = −b with the Schur
//! complement S = W_TT − W_Tn W_nT/W_nn and b = q_T − W_Tn q_n/W_nn; φ(λ) = ‖r_T(λ)‖ − μ r_n(λ) is positive at λ = 0 (not sticking) and
//! negative at infinity (r_T → 0, r_n → −q_n/W_nn > 0), so bisection in λ/(λ + tr S) always finds a root. In the plane S is a number and
//! the root is the intersection of the line u_n = 0 with the cone's edge. (In space the root solves the quartic of Bonnefon & Daviet 2011.)
//!
//! Slower than the others by the search for λ; where W couples normal and tangent strongly there may be several roots, and it
//! takes one.

use super::{LocalSolver, Visit, free, separated};
use crate::Cone;
use crate::block::{Matrix, Vector, mul, solve_definite, tangent_norm};

/// Enumeration of the cases.
#[derive(Clone, Copy, Debug)]
pub struct Exact;

impl LocalSolver for Exact {
    const CLAIMS: bool = true;

    #[inline]
    fn visit<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        let q = free(w, u, r);
        if D > 1 && cone == Cone::Sticking {
            return held(w, &q);
        }
        if q[0] >= 0.0 {
            return separated(w, u, r);
        }
        if D == 1 {
            return Visit { r: std::array::from_fn(|i| -q[i] / w[0][0]), u: [0.0; D], converged: true };
        }
        let mu = cone.friction();
        if let Some(r) = solve_definite(w, &q.map(|x| -x))
            && tangent_norm(&r) <= mu * r[0]
        {
            return Visit { r, u: [0.0; D], converged: true };
        }
        sliding(w, &q, mu)
    }
}

/// A sticking contact: u = 0 if that takes a push along the normal, else the tangent alone is held.
pub(super) fn held<const D: usize>(w: &Matrix<D>, q: &Vector<D>) -> Visit<D> {
    match solve_definite(w, &q.map(|x| -x)) {
        Some(r) if r[0] >= 0.0 => Visit { r, u: [0.0; D], converged: true },
        _ => {
            let r = tangent_impulse(&std::array::from_fn(|i| std::array::from_fn(|j| w[i][j])), q, 0.0);
            Visit { r, u: after(w, q, &r), converged: true }
        }
    }
}

/// u_n = 0 on the edge of the cone.
fn sliding<const D: usize>(w: &Matrix<D>, q: &Vector<D>, mu: f64) -> Visit<D> {
    let schur: Matrix<D> = std::array::from_fn(|i| std::array::from_fn(|j| w[i][j] - w[i][0] * w[0][j] / w[0][0]));
    let b: Vector<D> = std::array::from_fn(|i| if i == 0 { 0.0 } else { q[i] - w[i][0] * q[0] / w[0][0] });
    let scale: f64 = (1..D).map(|i| schur[i][i]).sum();
    let impulse = |x: f64| {
        let mut r = tangent_impulse(&schur, &b, scale * x / (1.0 - x));
        let coupled: f64 = (1..D).map(|i| w[0][i] * r[i]).sum();
        r[0] = -(q[0] + coupled) / w[0][0];
        r
    };
    let outside = |r: &Vector<D>| tangent_norm(r) > mu * r[0];
    let (mut low, mut high) = (0.0, 1.0);
    while high - low > f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        *(if outside(&impulse(middle)) { &mut low } else { &mut high }) = middle;
    }
    let mut r = if high < 1.0 { impulse(high) } else { std::array::from_fn(|i| if i == 0 { -q[0] / w[0][0] } else { 0.0 }) };
    // Put the last digit on the edge and on u_n = 0: keep the direction, solve for r_n.
    let length = tangent_norm(&r);
    if length > 0.0 {
        let direction: Vector<D> = std::array::from_fn(|i| if i == 0 { 1.0 } else { mu * r[i] / length });
        let stiffness: f64 = (0..D).map(|i| w[0][i] * direction[i]).sum();
        if stiffness > 0.0 {
            r = direction.map(|x| -x * q[0] / stiffness);
        }
    }
    let mut u = after(w, q, &r);
    u[0] = 0.0;
    Visit { r, u, converged: true }
}

/// r_T of (A_TT + λ I) r_T = −b_T, with r_n = 0.
fn tangent_impulse<const D: usize>(a: &Matrix<D>, b: &Vector<D>, lambda: f64) -> Vector<D> {
    let block = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let same = f64::from(u8::from(i == j));
            if i == 0 || j == 0 { same } else { a[i][j] + lambda * same }
        })
    });
    let right = std::array::from_fn(|i| if i == 0 { 0.0 } else { -b[i] });
    solve_definite(&block, &right).unwrap_or([0.0; D])
}

/// q + W r.
fn after<const D: usize>(w: &Matrix<D>, q: &Vector<D>, r: &Vector<D>) -> Vector<D> {
    let wr = mul(w, r);
    std::array::from_fn(|i| q[i] + wr[i])
}
