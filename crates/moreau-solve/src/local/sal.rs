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

use super::{LocalSolver, Visit, moved};
use crate::block::{Matrix, Vector, tangent_row_sum_norm};
use crate::{Cone, Resolved};

/// One projection a visit on the half cylinder.
#[derive(Clone, Copy, Debug)]
pub struct Sal {
    /// ρ; automatic is 1/W_nn along the normal and 1/‖W_TT‖ along the tangent.
    pub rho: Resolved,
}

/// ρ for each component.
#[inline]
pub(super) fn steps<const D: usize>(rho: Resolved, w: &Matrix<D>) -> Vector<D> {
    let normal = rho.value(1.0 / w[0][0]);
    let tangent = if D > 1 { rho.value(1.0 / tangent_row_sum_norm(w)) } else { 0.0 };
    std::array::from_fn(|i| if i == 0 { normal } else { tangent })
}

impl LocalSolver for Sal {
    const CLAIMS: bool = false;

    #[inline]
    fn visit<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        let rho = steps(self.rho, w);
        let tau = std::array::from_fn(|i| r[i] - rho[i] * u[i]);
        let (image, _) = cone.project_cylinder(&tau);
        moved(w, u, r, image)
    }
}
