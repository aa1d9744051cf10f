//! The alternating direction method of multipliers (ADMM): the equations of motion and the cones take turns.
//!
//! ```text
//! minimise ½ xᵀ W x + (q + s)ᵀ x over x = z, z ∈ K,   s = μ‖u_T‖ n (de Saxcé's correction)
//! repeat until the criterion is met:
//!   (W + ϱ D) x = ϱ D (z − λ) − q − s            D = diag w_c (far more for wide gaps), factorised once for each ϱ
//!   x̂ = α x + (1 − α) z                          over-relaxation
//!   z⁺ = P_K(x̂ + λ),  λ ← λ + x̂ − z⁺
//!   û = −ϱ D λ,  s = μ‖û_T‖ n                    λ is the velocity: at the end û ∈ K* is orthogonal to z, as of each projection
//!   ϱ is changed where ‖D (x − z)‖ and ‖ϱ D (z⁺ − z)‖ differ much, each relative to what it is a part of
//! ```
//!
//! The impulses are z. W may be rank deficient; where its root J is known and has fewer columns than rows the factors are those of a matrix of the
//! bodies (`through_bodies`). Where it is not symmetric its LU factors take the place of Cholesky's. ϱ is a
//! number: D has the units of W.
//!
//! Reference: Boyd et al. 2011; Stellato et al. 2020 (choice of ϱ); Acary, Armand & Rousseau for Coulomb's law. For problems of
//! which W has many contacts a body or large ratios of masses, where sweeps are slow. It is `Unsuited` beyond [`LIMIT`] unknowns
//! or a factor of more than [`FILL`] entries; and not the method for tolerances near rounding.

mod factors;
mod through_bodies;

use super::Work;
use super::steps::{after_step, product, scales};
use crate::block::{Vector, axpy, norm, sub};
use crate::{Operator, Problem, Status};
use factors::{System, ThroughContacts};
use through_bodies::ThroughBodies;

/// How many unknowns W may have.
const LIMIT: usize = 60_000;
/// How many entries its factor may have.
const FILL: usize = 40_000_000;
/// α.
const OVER: f64 = 1.6;
/// ϱ at first.
const FIRST: f64 = 0.1;
/// By which factor ϱ has to be wrong to be changed, and after how many steps it may be at first.
const WRONG: f64 = 5.0;
const FIRST_WAIT: u64 = 10;

/// A contact so many times as wide as the others are fast is hardly going to close; so many times heavier is it held to its zero.
const WIDE: f64 = 10.0;
const HELD: f64 = 1e4;

/// Whether contacts are far from closing: their velocities the iteration would have to find to many digits by ϱ alone.
fn wide<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>) -> Vec<bool> {
    let closing = |c: usize| if problem.q[c][0] > 0.0 { 0.0 } else { norm(&problem.q[c]) };
    let fastest = (0..problem.len()).map(closing).fold(0.0, f64::max);
    (0..problem.len()).map(|c| problem.q[c][0] > WIDE * fastest && problem.cones[c].may_open()).collect()
}

/// D: w_c, and more of it for contacts that are `held` to zero.
fn diagonal<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, held: &[bool]) -> Vec<f64> {
    let w = scales(problem);
    w.into_iter().zip(held).map(|(w, &held)| if held { HELD * w } else { w }).collect()
}

/// The variables of the iteration.
struct Variables<const D: usize> {
    w: Vec<f64>,
    rho: f64,
    x: Vec<Vector<D>>,
    lambda: Vec<Vector<D>>,
    /// q + s.
    free: Vec<Vector<D>>,
    /// ‖D (x − z)‖ and ‖ϱ D (z⁺ − z)‖, each relative.
    primal: f64,
    dual: f64,
}

/// Steps until the judge says stop.
pub(super) fn run<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Status {
    for (r, cone) in work.r.iter_mut().zip(work.problem.cones) {
        *r = cone.nearest(r);
    }
    // At rest the impulses of the last step mostly are the answer, and nothing need be factorised.
    if let Some(status) = work.certify() {
        return status;
    }
    let mut held = wide(work.problem);
    let w = diagonal(work.problem, &held);
    let Some(mut system) = system(work.problem, &w) else { return Status::Unsuited };
    let mut variables = Variables::new(work, w);
    let (mut wait, mut changed_at) = (FIRST_WAIT, work.judge.sweeps);
    if !system.factorise(variables.rho) {
        return Status::Stalled;
    }
    loop {
        variables.step(work, &*system, &held);
        if let Some(status) = after_step(work) {
            return status;
        }
        // One that closes is like the others.
        if held.iter().zip(&*work.r).any(|(&held, r)| held && *r != [0.0; D]) {
            held.fill(false);
            variables.weigh(diagonal(work.problem, &held));
            let Some(plain) = self::system(work.problem, &variables.w) else { return Status::Unsuited };
            system = plain;
            if !system.factorise(variables.rho) {
                return Status::Stalled;
            }
        }
        let ratio = (variables.primal / variables.dual).sqrt();
        if work.judge.sweeps - changed_at >= wait && ratio.is_finite() && ratio > 0.0 && (ratio > WRONG || ratio * WRONG < 1.0) {
            variables.change(ratio);
            if !system.factorise(variables.rho) {
                return Status::Stalled;
            }
            changed_at = work.judge.sweeps;
            wait += wait / 2;
        }
    }
}

/// Whether impulses are so far from unique that factors through the bodies are the way: twice as many as motions of the bodies.
pub(super) fn suits<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>) -> bool {
    let Some(root) = problem.operator.root() else { return false };
    let mut moved = vec![false; root.columns];
    root.entries.iter().for_each(|&(_, column, _)| moved[column] = true);
    let unknowns = problem.len() * D;
    unknowns <= LIMIT && 2 * moved.iter().filter(|moved| **moved).count() <= unknowns
}

/// W + ϱ D, D = diag `w`, in the smaller of its two forms; `None` where the problem is too large.
fn system<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, w: &[f64]) -> Option<Box<dyn System<D>>> {
    if problem.len() * D > LIMIT {
        return None;
    }
    match ThroughBodies::new(problem, w) {
        Some(system) => Some(Box::new(system)),
        None => Some(Box::new(ThroughContacts::new(problem, w)?)),
    }
}

impl<const D: usize> Variables<D> {
    /// From the impulses of now and their velocities.
    fn new<O: Operator<D>>(work: &mut Work<'_, O, D>, w: Vec<f64>) -> Self {
        let problem = work.problem;
        let mut u = vec![[0.0; D]; problem.len()];
        product(problem, &mut work.scratch.state, work.r, &mut u);
        let rho = FIRST;
        let mut lambda = u.clone();
        for c in 0..problem.len() {
            let dual = problem.cones[c].project_dual(&problem.cones[c].hat(&axpy(&problem.q[c], 1.0, &u[c])));
            lambda[c] = dual.map(|u| if w[c] > 0.0 { -u / (rho * w[c]) } else { 0.0 });
        }
        Self { w, rho, x: u, lambda, free: problem.q.to_vec(), primal: 0.0, dual: 0.0 }
    }

    fn step<O: Operator<D>>(&mut self, work: &mut Work<'_, O, D>, system: &dyn System<D>, held: &[bool]) {
        let problem = work.problem;
        for c in 0..problem.len() {
            let hat = self.lambda[c].map(|x| -self.rho * self.w[c] * x);
            let shift = problem.cones[c].hat(&hat)[0] - hat[0];
            self.free[c] = problem.q[c];
            self.free[c][0] += shift;
            let pull = self.rho * self.w[c];
            self.x[c] = axpy(&self.free[c].map(|x| -x), pull, &sub(&work.r[c], &self.lambda[c]));
        }
        system.solve(&mut self.x, work.r);
        let (mut apart, mut moved, mut impulses, mut velocities) = (0.0, 0.0, 0.0, 0.0);
        for c in 0..problem.len() {
            let (z, w) = (work.r[c], self.w[c]);
            let over = axpy(&z, OVER, &sub(&self.x[c], &z));
            let tau = axpy(&self.lambda[c], 1.0, &over);
            let next = problem.cones[c].nearest(&tau);
            self.lambda[c] = if w > 0.0 { sub(&tau, &next) } else { [0.0; D] };
            let square = |a: f64| (w * a) * (w * a);
            apart += square(norm(&sub(&self.x[c], &next)));
            moved += square(norm(&sub(&next, &z)));
            impulses += square(norm(&next));
            // A wide gap is in the velocity, which says nothing of the others.
            velocities += if held[c] { 0.0 } else { square(norm(&self.lambda[c])) };
            work.r[c] = next;
        }
        self.primal = (apart / impulses).sqrt();
        self.dual = (moved / velocities).sqrt();
    }

    /// Another D with the same velocities.
    fn weigh(&mut self, w: Vec<f64>) {
        for ((lambda, before), now) in self.lambda.iter_mut().zip(&self.w).zip(&w) {
            *lambda = lambda.map(|x| if *now > 0.0 { x * (before / now) } else { 0.0 });
        }
        self.w = w;
    }

    /// ϱ ← ratio · ϱ with the same velocities.
    fn change(&mut self, ratio: f64) {
        self.rho *= ratio;
        self.lambda.iter_mut().for_each(|lambda| *lambda = lambda.map(|x| x / ratio));
    }
}
