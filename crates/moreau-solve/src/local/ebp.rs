//! Enhanced bipotential (EBP), section 4.2: Newton on the bipotential's fixed point (eqs. 30-36).
//!
//! ```text
//! find χ = (r, u):   u = W r + q,   r = proj(r − ρ û, K_μ),   û = u + μ ‖u_T‖ n
//! ```
//!
//! The derivative takes in all of the projection that is differentiable, which is the enhancement (Joli & Feng 2008; Dumont 2013).
//! Without friction it ends in one round with contact and one without, whatever ρ. Claims the velocity of its last round.

use super::newton::{Image, newton};
use super::rolling::equilibrated;
use super::{IMMOVABLE, LocalSolver, Visit, bilateral, separated};
use crate::block::{Matrix, Vector, axpy, row_sum_norm};
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
        if let Cone::Rolling { mu, mu_r } = cone {
            let Visit { r, u, converged } = equilibrated(*w, [mu, mu_r], *u, *r, |w, cone, u, r| self.rolling(w, cone, u, r));
            return Visit { r, u, converged };
        }
        if let Cone::Bilateral { held } = cone {
            let Visit { r, u, converged } = bilateral::cut(*w, held, *u, *r, |w, cone, u, r| self.newton(w, cone, u, r));
            return Visit { r, u, converged };
        }
        self.newton(w, cone, u, r)
    }
}

impl Ebp {
    /// The iteration for a contact with rolling, in variables of one unit; its own copy, so that the other is free of its cases.
    #[cold]
    #[inline(never)]
    pub(super) fn rolling<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        self.newton(w, cone, u, r)
    }

    /// The iteration itself.
    #[inline(always)]
    fn newton<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        let size = row_sum_norm(w);
        if size < IMMOVABLE {
            return separated(w, u, r);
        }
        let rho = self.rho.value(1.0 / size);
        newton(w, u, r, move |r, u| {
            let (value, by_r) = cone.project(&axpy(r, -rho, &cone.hat(u)));
            // ∂û/∂u = I + n ⊗ lift, for Coulomb I + μ n ⊗ u_T/‖u_T‖.
            let lift = cone.hat_gradient(u);
            let by_u = std::array::from_fn(|i| std::array::from_fn(|j| -rho * (by_r[i][j] + by_r[i][0] * lift[j])));
            Image { value, by_r, by_u }
        })
    }
}
