//! Nonlinear Gauss-Seidel (NLGS), section 3.2: each contact in turn is solved by a local method while the others wait.
//!
//! ```text
//! repeat until the criterion is met:
//!   for each contact c in order:
//!     u_c = q_c + (W r)_c                      predicted velocity (eq. 20)
//!     (r_c⁺, ũ_c) = local(W_cc, law_c, u_c, r_c)      contact law (eq. 22)
//!     v ← v + M⁻¹ H_c (r_c⁺ − r_c)                 at once, so that the next contact sees it
//! ```
//!
//! Reference: Moreau 1994, Jean 1999. Robust and cheap a sweep; the number of sweeps grows with the length of chains of contacts, so it
//! is not the method for tall stacks at tight tolerances. Over-relaxation (ω of the settings) and sweeps that alternate in direction
//! are the old remedies.

use super::Work;
use super::sweep::sweep;
use crate::local::LocalSolver;
use crate::{Operator, Status};

/// Sweeps until the judge says stop.
pub(super) fn run<O: Operator<D>, L: LocalSolver, const D: usize>(work: &mut Work<'_, O, D>, local: L) -> Status {
    work.begin::<L>();
    let mut backwards = false;
    loop {
        sweep(work, local, backwards);
        backwards = work.settings.symmetric && !backwards;
        if let Some(status) = work.after_sweep() {
            return status;
        }
    }
}
