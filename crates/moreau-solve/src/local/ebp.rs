//! Enhanced bipotential (EBP), section 4.2: Newton on the bipotential's fixed point (eqs. 30-36).
//!
//! ```text
//! find χ = (r, u):   u = W r + q,   r = proj(r − ρ û, K_μ),   û = u + μ ‖u_T‖ n
//! ```
//!
//! The derivative takes in all of the projection that is differentiable, which is the enhancement (Joli & Feng 2008; Dumont 2013).
//! Without friction it ends in one round with contact and one without, whatever ρ. Claims the velocity of its last round.

use super::newton::{Image, newton};
use super::{LocalSolver, Visit};
use crate::block::{Matrix, Vector, axpy, row_sum_norm, tangent_norm};
use crate::{Cone, Resolved};

/// Newton to convergence on Coulomb's cone.
#[derive(Clone, Copy, Debug)]
pub struct Ebp {
    /// ρ; automatic is 1/‖W_cc‖.
    pub rho: Resolved,
}

impl LocalSolver for Ebp {
    const CLAIMS: bool = true;

    #[inline]
    fn visit<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        let rho = self.rho.value(1.0 / row_sum_norm(w));
        newton(w, u, r, |r, u| {
            let slip = tangent_norm(u);
            let mu = cone.friction();
            let mut hat = *u;
            hat[0] += mu * slip;
            let (value, by_r) = cone.project(&axpy(r, -rho, &hat));
            // ∂û/∂u = I + μ n ⊗ u_T/‖u_T‖; at rest the direction is free, and none is taken.
            let lift = |j: usize| if j > 0 && slip > 0.0 { mu * u[j] / slip } else { 0.0 };
            let by_u = std::array::from_fn(|i| std::array::from_fn(|j| -rho * (by_r[i][j] + by_r[i][0] * lift(j))));
            Image { value, by_r, by_u }
        })
    }
}
