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
//! is not the method for tall stacks at tight tolerances.

use super::Scratch;
use crate::block::{Matrix, Vector, sub};
use crate::local::{LocalSolver, Visit, WithLocal};
use crate::report::{HistoryRow, Report, Status};
use crate::residual::{criterion, measure};
use crate::{Cone, Operator, Problem, Settings};

/// One solve, waiting for its local solver.
pub(super) struct Nlgs<'a, O: Operator<D>, const D: usize> {
    pub problem: &'a Problem<'a, O, D>,
    pub settings: &'a Settings,
    pub r: &'a mut [Vector<D>],
    pub scratch: &'a mut Scratch<O::State, D>,
}

impl<O: Operator<D>, const D: usize> WithLocal for Nlgs<'_, O, D> {
    type Output = Report;

    fn run<L: LocalSolver>(self, local: L) -> Report {
        let Self { problem, settings, r, scratch } = self;
        settings.order.fill(problem.operator, problem.len(), &mut scratch.order);
        scratch.claimed.clear();
        scratch.claimed.resize(if L::CLAIMS { problem.len() } else { 0 }, [0.0; D]);
        problem.operator.start(r, &mut scratch.state);

        let mut history = Vec::new();
        let (mut sweeps, mut next_check, mut unfinished_visits) = (0, 1, 0);
        let status = loop {
            if problem.is_empty() {
                break Status::Converged;
            }
            unfinished_visits = sweep(problem, local, r, scratch);
            sweeps += 1;
            let last = sweeps >= settings.max_sweeps;
            if settings.history {
                let residual = measure(problem, &scratch.state, r, claims::<L, D>(&scratch.claimed));
                history.push(HistoryRow { sweep: sweeps, residual });
            } else if sweeps < next_check && !last {
                continue;
            }
            next_check = sweeps + if sweeps < 20 { 1 } else { sweeps / 16 };
            let error = criterion(problem, &scratch.state, r, claims::<L, D>(&scratch.claimed), settings.criterion);
            if !error.is_finite() {
                break Status::NotFinite;
            }
            if error <= settings.tolerance {
                // The state has gathered the rounding of every visit: the verdict is on the impulses alone.
                problem.operator.start(r, &mut scratch.state);
                let claimed = claims::<L, D>(&scratch.claimed);
                if criterion(problem, &scratch.state, r, claimed, settings.criterion) <= settings.tolerance {
                    break Status::Converged;
                }
            }
            if last {
                break Status::MaxSweeps;
            }
        };
        problem.operator.start(r, &mut scratch.state);
        let residual = measure(problem, &scratch.state, r, claims::<L, D>(&scratch.claimed));
        Report { status, sweeps, residual, unfinished_visits, history }
    }
}

/// The claimed velocities, of methods that claim any.
fn claims<L: LocalSolver, const D: usize>(claimed: &[Vector<D>]) -> Option<&[Vector<D>]> {
    L::CLAIMS.then_some(claimed)
}

/// One visit to every contact; returns how many did not reach their own end.
fn sweep<O: Operator<D>, L: LocalSolver, const D: usize>(
    problem: &Problem<'_, O, D>,
    local: L,
    r: &mut [Vector<D>],
    scratch: &mut Scratch<O::State, D>,
) -> u64 {
    let Scratch { state, claimed, order } = scratch;
    let n = order.len();
    // One length for all, and one look at the index: the compiler then drops a check for each array.
    let (q, cones, r) = (&problem.q[..n], &problem.cones[..n], &mut r[..n]);
    let claimed = if L::CLAIMS { &mut claimed[..n] } else { &mut [] };
    let mut unfinished = 0;
    for &c in order.iter() {
        let c = c as usize;
        if c >= n {
            continue;
        }
        problem.operator.relax(state, c, |w, wr| {
            let u = std::array::from_fn(|i| q[c][i] + wr[i]);
            let visit = visit(local, w, cones[c], &u, &r[c]);
            let change = sub(&visit.r, &r[c]);
            r[c] = visit.r;
            if L::CLAIMS {
                claimed[c] = visit.u;
            }
            unfinished += u64::from(!visit.converged);
            change
        });
    }
    unfinished
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
