//! What all methods of Gauss-Seidel's kind share: the visit of a contact, and a plain sweep over all of them.

use super::Work;
use crate::block::{Matrix, Vector, axpy, sub, velocity_after};
use crate::local::{LocalSolver, Visit};
use crate::{Cone, Operator};

/// One visit to every contact, in the order of the scratch or against it.
pub(super) fn sweep<O: Operator<D>, L: LocalSolver, const D: usize>(work: &mut Work<'_, O, D>, local: L, backwards: bool) {
    let Work { problem, settings, r, scratch, judge, .. } = work;
    let (state, order) = (&mut scratch.state, &scratch.order);
    let n = order.len();
    // One length for all, and one look at the index: the compiler then drops a check for each array.
    let (q, cones, r) = (&problem.q[..n], &problem.cones[..n], &mut r[..n]);
    let claimed = if L::CLAIMS { &mut scratch.claimed[..n] } else { &mut [] };
    let omega = settings.relaxation;
    let mut unfinished = 0;
    let mut at = |c: usize| {
        if c >= n {
            return;
        }
        problem.operator.relax(state, c, |w, wr| {
            let u = std::array::from_fn(|i| q[c][i] + wr[i]);
            let mut visit = visit(local, w, cones[c], &u, &r[c]);
            if omega != 1.0 {
                visit = relaxed(omega, w, cones[c], &u, &r[c], &visit);
            }
            let change = sub(&visit.r, &r[c]);
            r[c] = visit.r;
            if L::CLAIMS {
                claimed[c] = visit.u;
            }
            unfinished += u64::from(!visit.converged);
            change
        });
    };
    if backwards {
        order.iter().rev().for_each(|&c| at(c as usize));
    } else {
        order.iter().for_each(|&c| at(c as usize));
    }
    judge.unfinished_visits = unfinished;
}

/// A contact without friction is a problem of one dimension, in whichever space it lies.
#[inline(always)]
pub(super) fn visit<L: LocalSolver, const D: usize>(
    local: L,
    w: &Matrix<D>,
    cone: Cone,
    u: &Vector<D>,
    r: &Vector<D>,
) -> Visit<D> {
    if D == 1 || cone != Cone::Signorini {
        return local.visit(w, cone, u, r);
    }
    let normal = local.visit(&[[w[0][0]]], cone, &[u[0]], &[r[0]]);
    let only = |x: f64| std::array::from_fn(|i| if i == 0 { x } else { 0.0 });
    Visit { r: only(normal.r[0]), u: only(normal.u[0]), converged: normal.converged }
}

/// Over-relaxation: P_K(r + ω (r⁺ − r)), with the velocity that the equation of motion then gives.
#[inline]
fn relaxed<const D: usize>(omega: f64, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>, visit: &Visit<D>) -> Visit<D> {
    let r_new = cone.nearest(&axpy(r, omega, &sub(&visit.r, r)));
    Visit { r: r_new, u: velocity_after(w, u, r, &r_new), converged: visit.converged }
}
