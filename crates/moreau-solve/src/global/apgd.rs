//! Accelerated projected gradient descent (APGD): Nesterov's method on the dual problem of all contacts.
//!
//! ```text
//! minimise ½ rᵀ W r + rᵀ (q + s) over r ∈ K,   s = μ‖u_T‖ n (de Saxcé's correction), held at the impulses where it was set last
//! repeat until the criterion is met:
//!   r⁺ = P_K(y − (q + W y + s)/(L w)),  d = r⁺ − y       doubling L until dᵀ W d ≤ L Σ w_c ‖d_c‖²
//!   if Σ w_c d·(r⁺ − r) < 0:  y = r⁺, θ = 1              restart: the momentum points uphill
//!   else:  y = r⁺ + β (r⁺ − r),  β = θ (1 − θ)/(θ² + θ⁺),  θ⁺² = (1 − θ⁺) θ²
//!   L ← 0.9 L
//!   once L ‖d‖ has fallen to 0.4 of what it was when s was set:  s = μ‖u_T(r)‖ n, and start anew
//! ```
//!
//! With w_c = tr(W_cc)/D the steps do not depend on units, and L is a number: one for separate contacts, and at most about as
//! many as contacts meet at a body. With s = 0 it would solve the cone-relaxed problem, in which sliding contacts open; as s
//! follows, an end of the iteration solves the law itself. To set s at each step does not work: the momentum turns its delay into
//! cycles.
//!
//! Reference: Mazhar, Heyn, Negrut & Tasora 2015; O'Donoghue & Candès 2015 (restarts); Haslinger 1983 (the sequence of problems
//! with s held). A step costs one or two products with W and no factors: for large problems at moderate tolerances. Not for large
//! ratios of masses, on whose root the number of steps depends. With friction nothing is proved; it is slow at large μ where W is
//! rank deficient.

use super::Work;
use super::steps::{after_step, inner, inverse, product, scales, weighted};
use crate::block::{Vector, axpy, dot, sub};
use crate::{Operator, Status};

/// What L keeps of itself after a step, and below which it does not fall: of all of W it is at least one.
const FORGET: f64 = 0.9;
const LEAST: f64 = 0.1;
/// What is left of L ‖d‖ when s is set anew.
const SOLVED: f64 = 0.4;
/// After how many steps s is set anew in any case: this many, and all so far divided by this.
const PATIENCE: u64 = 50;
const PART: u64 = 10;
/// How often L is doubled within a step; more means numbers that are not finite.
const DOUBLINGS: usize = 64;

/// The points of the iteration with their products.
struct Points<const D: usize> {
    w: Vec<f64>,
    /// W r and W y.
    wr: Vec<Vector<D>>,
    y: Vec<Vector<D>>,
    wy: Vec<Vector<D>>,
    /// q + s.
    free: Vec<Vector<D>>,
    next: Vec<Vector<D>>,
    d: Vec<Vector<D>>,
    wd: Vec<Vector<D>>,
    theta: f64,
    lipschitz: f64,
    /// L ‖d‖.
    change: f64,
}

/// Steps until the judge says stop.
pub(super) fn run<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Status {
    for (r, cone) in work.r.iter_mut().zip(work.problem.cones) {
        *r = cone.nearest(r);
    }
    let mut points = Points::new(work);
    let (mut since, mut first) = (work.judge.sweeps, None);
    points.set_shift(work);
    loop {
        points.step(work);
        points.momentum(work);
        if let Some(status) = after_step(work) {
            return status;
        }
        let steps = work.judge.sweeps;
        if work.judge.measured_at == steps {
            // What rounding has left in W r goes.
            product(work.problem, &mut work.scratch.state, work.r, &mut points.wr);
        }
        let first_change = *first.get_or_insert(points.change);
        if points.change <= SOLVED * first_change || steps - since > PATIENCE + steps / PART {
            points.set_shift(work);
            (since, first) = (steps, None);
        }
    }
}

impl<const D: usize> Points<D> {
    fn new<O: Operator<D>>(work: &mut Work<'_, O, D>) -> Self {
        let zeros = || vec![[0.0; D]; work.problem.len()];
        let mut wr = zeros();
        product(work.problem, &mut work.scratch.state, work.r, &mut wr);
        Self {
            w: scales(work.problem),
            y: work.r.to_vec(),
            wy: wr.clone(),
            wr,
            free: zeros(),
            next: zeros(),
            d: zeros(),
            wd: zeros(),
            theta: 1.0,
            lipschitz: 1.0,
            change: 0.0,
        }
    }

    /// The projected step from y, with d and W d.
    fn step<O: Operator<D>>(&mut self, work: &mut Work<'_, O, D>) {
        let mut length = 0.0;
        for _ in 0..DOUBLINGS {
            for c in 0..work.problem.len() {
                let t = inverse(self.w[c]) / self.lipschitz;
                let gradient = axpy(&self.free[c], 1.0, &self.wy[c]);
                self.next[c] = work.problem.cones[c].nearest(&axpy(&self.y[c], -t, &gradient));
                self.d[c] = sub(&self.next[c], &self.y[c]);
            }
            product(work.problem, &mut work.scratch.state, &self.d, &mut self.wd);
            length = weighted(&self.w, &self.d, &self.d);
            if inner(&self.d, &self.wd) <= self.lipschitz * length {
                break;
            }
            self.lipschitz *= 2.0;
        }
        self.change = self.lipschitz * length.sqrt();
        self.lipschitz = (FORGET * self.lipschitz).max(LEAST);
    }

    /// Makes the step, and chooses the point y from which the next one starts.
    fn momentum<O: Operator<D>>(&mut self, work: &mut Work<'_, O, D>) {
        let square = self.theta * self.theta;
        let next_theta = 0.5 * (-square + (square * square + 4.0 * square).sqrt());
        let mut beta = self.theta * (1.0 - self.theta) / (square + next_theta);
        let onward = |c: usize| self.w[c] * dot(&self.d[c], &sub(&self.next[c], &work.r[c]));
        self.theta = next_theta;
        if (0..self.w.len()).map(onward).sum::<f64>() < 0.0 {
            (beta, self.theta) = (0.0, 1.0);
        }
        for c in 0..self.w.len() {
            let wr = axpy(&self.wy[c], 1.0, &self.wd[c]);
            self.y[c] = axpy(&self.next[c], beta, &sub(&self.next[c], &work.r[c]));
            self.wy[c] = axpy(&wr, beta, &sub(&wr, &self.wr[c]));
            (work.r[c], self.wr[c]) = (self.next[c], wr);
        }
    }

    /// Starts anew from the impulses of now, with s at theirs.
    fn set_shift<O: Operator<D>>(&mut self, work: &mut Work<'_, O, D>) {
        product(work.problem, &mut work.scratch.state, work.r, &mut self.wr);
        for c in 0..self.w.len() {
            let q = work.problem.q[c];
            let u = axpy(&q, 1.0, &self.wr[c]);
            self.free[c] = q;
            self.free[c][0] += work.problem.cones[c].hat(&u)[0] - u[0];
        }
        self.y.copy_from_slice(work.r);
        self.wy.copy_from_slice(&self.wr);
        self.theta = 1.0;
    }
}
