//! What all methods of Gauss-Seidel's kind share: the visit of a contact, and a plain sweep over all of them.

use super::Work;
use crate::block::{Matrix, Vector, axpy, sub, velocity_after};
use crate::local::{LocalSolver, Visit};
use crate::operator::Visit as AtContact;
use crate::{Cone, Operator};

/// One visit to every contact, in the order of the scratch or against it.
pub(super) fn sweep<O: Operator<D>, L: LocalSolver, const D: usize>(work: &mut Work<'_, O, D>, local: L, backwards: bool) {
    let Work { problem, settings, r, scratch, judge, .. } = work;
    let (state, order) = (&mut scratch.state, &scratch.order);
    let n = order.len();
    // One length for all, and one look at the index: the compiler then drops a check for each array.
    let (q, cones, r) = (&problem.q[..n], &problem.cones[..n], &mut r[..n]);
    let claimed = if L::CLAIMS { &mut scratch.claimed[..n] } else { &mut [] };
    let (omega, mut unfinished) = (settings.relaxation, 0);
    for k in 0..n {
        let c = order[if backwards { n - 1 - k } else { k }] as usize;
        if c < n {
            let (from, u) = (r[c], claimed.get_mut(c));
            let visit = Local { local, q: &q[c], cone: cones[c], from, omega, r: &mut r[c], u, unfinished: &mut unfinished };
            problem.operator.relax(state, c, visit);
        }
    }
    judge.unfinished_visits = unfinished;
}

/// A visit by the local solver.
pub(super) struct Local<'a, L, const D: usize> {
    pub(super) local: L,
    pub(super) q: &'a Vector<D>,
    pub(super) cone: Cone,
    /// The impulse of before, for which the operator's state stands.
    pub(super) from: Vector<D>,
    /// Over-relaxation.
    pub(super) omega: f64,
    /// Where the new impulse goes, and the claimed velocity if it is kept.
    pub(super) r: &'a mut Vector<D>,
    pub(super) u: Option<&'a mut Vector<D>>,
    pub(super) unfinished: &'a mut u64,
}

impl<L: LocalSolver, const D: usize> AtContact<D> for Local<'_, L, D> {
    #[inline(always)]
    fn change(self, w: &Matrix<D>, wr: Vector<D>) -> Vector<D> {
        let Self { local, q, cone, from, omega, r, u: claimed, unfinished } = self;
        let u = axpy(q, 1.0, &wr);
        let mut visit = visit(local, w, cone, &u, &from);
        if omega != 1.0 {
            visit = relaxed(omega, w, cone, &u, &from, &visit);
        }
        *r = visit.r;
        if let Some(claimed) = claimed {
            *claimed = visit.u;
        }
        *unfinished += u64::from(!visit.converged);
        sub(&visit.r, &from)
    }
}

/// A contact without friction is a problem of one dimension, in whichever space it lies.
#[inline(always)]
fn visit<L: LocalSolver, const D: usize>(local: L, w: &Matrix<D>, cone: Cone, u: &Vector<D>, r: &Vector<D>) -> Visit<D> {
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
