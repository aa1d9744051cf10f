//! Standard bipotential (SBP), section 4.2: one step of Uzawa's method on the bipotential.
//!
//! ```text
//! û = u + μ ‖u_T‖ n            the velocity with de Saxcé's correction
//! τ = r − ρ û                  the augmented impulse
//! r ← proj(τ, K_μ)             on Coulomb's cone (eq. 29)
//! ```
//!
//! Reference: de Saxcé & Feng 1991; Fortin, Millet & de Saxcé 2005. Its fixed point is exact; how fast it comes there depends on ρ: a
//! visit without friction leaves the part 1 − ρ W_nn of the error. With the automatic ρ = 1/‖W‖ (row sums) it is then exact in one
//! visit. Not to be used where W_nn varies much between contacts with one absolute ρ: some contacts crawl, others diverge.

use super::rolling::equilibrated;
use super::{IMMOVABLE, LocalSolver, Visit, bilateral, moved, separated};
use crate::block::{Matrix, Vector, axpy, row_sum_norm};
use crate::{Cone, Resolved};

/// One projection a visit on Coulomb's cone.
#[derive(Clone, Copy, Debug)]
pub struct Sbp {
    /// ρ; automatic is 1/‖W_cc‖.
    pub rho: Resolved,
}

impl LocalSolver for Sbp {
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

impl Sbp {
    #[inline(always)]
    fn step<const D: usize>(&self, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
        let size = row_sum_norm(w);
        if size < IMMOVABLE {
            return separated(w, u, r);
        }
        let rho = self.rho.value(1.0 / size);
        let image = cone.nearest(&axpy(r, -rho, &cone.hat(u)));
        moved(w, u, r, image)
    }
}
