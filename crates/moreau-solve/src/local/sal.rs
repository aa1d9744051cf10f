//! Standard augmented Lagrangian (SAL), section 4.1: one projected gradient step (eq. 25).
//!
//! ```text
//! τ = r − ρ u                  the augmented impulse, ρ apart for normal and tangent
//! r_n ← [τ_n]₊
//! r_T ← proj(τ_T, B(0, μ r_n)) on the disk of the half cylinder C(μ r) (eq. 23)
//! ```
//!
//! Reference: Alart & Curnier 1991. As for SBP the speed depends on ρ. The automatic values are 1/W_nn and 1/‖W_TT‖; a relative ρ
//! multiplies both, an absolute one replaces both.

use super::rolling::equilibrated;
use super::{IMMOVABLE, LocalSolver, Visit, bilateral, moved, separated};
use crate::block::{Matrix, Vector, tangent_row_sum_norm};
use crate::{Cone, Resolved};

/// One projection a visit on the half cylinder.
#[derive(Clone, Copy, Debug)]
pub struct Sal {
    /// ρ; automatic is 1/W_nn along the normal and 1/‖W_TT‖ along the tangent.
    pub rho: Resolved,
}

/// ρ for each component; `None` where the contact's impulse moves nothing.
#[inline]
pub(super) fn steps<const D: usize>(rho: Resolved, w: &Matrix<D>) -> Option<Vector<D>> {
    let (size, tangent_size) = (w[0][0], if D > 1 { tangent_row_sum_norm(w) } else { 0.0 });
    // A part that cannot move has no step of its own and takes the other's: its impulse still has to find its place in the cone.
    let of = |size: f64, other: f64| if size >= IMMOVABLE { size } else { other };
    let (normal, tangent) = (of(size, tangent_size), of(tangent_size, size));
    if normal < IMMOVABLE {
        return None;
    }
    let (normal, tangent) = (rho.value(1.0 / normal), rho.value(1.0 / tangent));
    Some(std::array::from_fn(|i| if i == 0 { normal } else { tangent }))
}

impl LocalSolver for Sal {
    const CLAIMS: bool = false;

    #[inline(always)]
    fn visit<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        if let Cone::Rolling { mu, mu_r } = cone {
            let Visit { r, u, converged } = equilibrated(*w, [mu, mu_r], *u, *r, |w, cone, u, r| self.step(w, cone, u, r));
            return Visit { r, u, converged };
        }
        if let Cone::Bilateral { held } = cone {
            let Visit { r, u, converged } = bilateral::cut(*w, held, *u, *r, |w, cone, u, r| self.step(w, cone, u, r));
            return Visit { r, u, converged };
        }
        self.step(w, cone, u, r)
    }
}

impl Sal {
    #[inline(always)]
    fn step<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        let Some(rho) = steps(self.rho, w) else { return separated(w, u, r) };
        let tau = std::array::from_fn(|i| r[i] - rho[i] * u[i]);
        let image = cone.nearest_in_cylinder(&tau);
        moved(w, u, r, image)
    }
}
