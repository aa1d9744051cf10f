//! Enhanced augmented Lagrangian (EAL), section 4.1: generalised Newton on the augmented Lagrangian's fixed point (eq. 26).
//!
//! ```text
//! find χ = (r, u):   u = W r + q,   r_n = [τ_n]₊,   r_T = proj(τ_T, B(0, μ [τ_n]₊)),   τ = r − ρ u
//! ```
//!
//! Reference: Alart & Curnier 1991; Dumont 2013. Claims the velocity of its last round.

use super::newton::{Image, newton};
use super::rolling::equilibrated;
use super::sal::steps;
use super::{LocalSolver, Visit, bilateral, separated};
use crate::block::{Matrix, Vector};
use crate::{Cone, Resolved};

/// Newton to convergence on the half cylinder.
#[derive(Clone, Copy, Debug)]
pub struct Eal {
    /// ρ; automatic is 1/W_nn along the normal and 1/‖W_TT‖ along the tangent.
    pub rho: Resolved,
}

impl LocalSolver for Eal {
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

impl Eal {
    /// The iteration for a contact with rolling, in variables of one unit; its own copy, so that the other is free of its cases.
    #[cold]
    #[inline(never)]
    pub(super) fn rolling<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        self.newton(w, cone, u, r)
    }

    /// The iteration itself.
    #[inline(always)]
    fn newton<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        let Some(rho) = steps(self.rho, w) else { return separated(w, u, r) };
        newton(w, u, r, move |r, u| {
            let tau = std::array::from_fn(|i| r[i] - rho[i] * u[i]);
            let (value, by_r) = cone.project_cylinder(&tau);
            let by_u = std::array::from_fn(|i| std::array::from_fn(|j| -by_r[i][j] * rho[j]));
            Image { value, by_r, by_u }
        })
    }
}
