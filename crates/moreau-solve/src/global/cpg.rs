//! Nonsmooth conjugate projected gradients (CPG): conjugate directions within the faces of the cones.
//!
//! ```text
//! repeat until the criterion is met:
//!   û = q + W r + μ‖u_T‖ n,  τ = r − û/w                     the gradient of ½ rᵀ W r + rᵀ (q + μ‖u_T‖ n), scaled by W_cc
//!   z = P_K(τ) − r,  J = ∂P_K(τ)                             projected direction, and the faces that it stays in
//!   β = [z·w(z − J z₋)]₊ / (z₋·w z₋)                         Polak & Ribière
//!   p = z + β J p₋,  or z if that goes uphill
//!   α = −û·p / pᵀ W p                                        exact along p
//!   r⁺ = P_K(r + α p),  or P_K(r − û/(L w)) with L as of APGD if the cones cut p so short that the function would not fall
//! ```
//!
//! Once the contacts that push, stick and slide are known, J is the projection on the unknowns that are free and the steps are
//! those of conjugate gradients on them. Where a plain step takes their place the directions start anew from z. z is zero exactly
//! at a solution of Coulomb's law.
//!
//! Reference: Renouf & Alart 2004. It differs from theirs in that z is a step to the cone of û, not one to the disk of radius μ
//! r_n, so that one line serves all laws. A step costs two products with W and no factors: for large problems with many contacts
//! a body. With friction nothing is proved.

use super::Work;
use super::steps::{after_step, inner, inverse, product, scales, weighted};
use crate::block::{Vector, axpy, dot, mul, sub};
use crate::{Operator, Status};

/// How often the plain step is halved; more means numbers that are not finite.
const HALVINGS: usize = 60;

/// The directions with their products.
struct Directions<const D: usize> {
    w: Vec<f64>,
    wr: Vec<Vector<D>>,
    hat: Vec<Vector<D>>,
    /// z and p, and W p.
    z: Vec<Vector<D>>,
    p: Vec<Vector<D>>,
    wp: Vec<Vector<D>>,
    /// r⁺ and d = r⁺ − r, and W d.
    next: Vec<Vector<D>>,
    d: Vec<Vector<D>>,
    wd: Vec<Vector<D>>,
    /// Σ w_c ‖z_c‖² of the last step; zero for a new start.
    size: f64,
    /// The plain step's L.
    lipschitz: f64,
}

/// Steps until the judge says stop.
pub(super) fn run<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Status {
    for (r, cone) in work.r.iter_mut().zip(work.problem.cones) {
        *r = cone.nearest(r);
    }
    let mut directions = Directions::new(work);
    loop {
        directions.turn(work);
        directions.step(work);
        if let Some(status) = after_step(work) {
            return status;
        }
    }
}

impl<const D: usize> Directions<D> {
    fn new<O: Operator<D>>(work: &Work<'_, O, D>) -> Self {
        let zeros = || vec![[0.0; D]; work.problem.len()];
        Self {
            w: scales(work.problem),
            wr: zeros(),
            hat: zeros(),
            z: zeros(),
            p: zeros(),
            wp: zeros(),
            next: zeros(),
            d: zeros(),
            wd: zeros(),
            size: 0.0,
            lipschitz: 1.0,
        }
    }

    /// The direction p at the impulses of now.
    fn turn<O: Operator<D>>(&mut self, work: &mut Work<'_, O, D>) {
        let problem = work.problem;
        product(problem, &mut work.scratch.state, work.r, &mut self.wr);
        let (mut size, mut change) = (0.0, 0.0);
        for c in 0..problem.len() {
            self.hat[c] = problem.cones[c].hat(&axpy(&problem.q[c], 1.0, &self.wr[c]));
            let (image, face) = problem.cones[c].project(&axpy(&work.r[c], -inverse(self.w[c]), &self.hat[c]));
            let z = sub(&image, &work.r[c]);
            let kept = mul(&face, &self.z[c]);
            size += self.w[c] * dot(&z, &z);
            change += self.w[c] * dot(&z, &sub(&z, &kept));
            self.z[c] = z;
            self.p[c] = mul(&face, &self.p[c]);
        }
        let beta = if self.size > 0.0 { (change / self.size).max(0.0) } else { 0.0 };
        self.size = size;
        for (p, z) in self.p.iter_mut().zip(&self.z) {
            *p = axpy(z, beta, p);
        }
        let downhill = inner(&self.hat, &self.p) < 0.0;
        if !downhill {
            self.p.copy_from_slice(&self.z);
        }
    }

    /// The step along p.
    fn step<O: Operator<D>>(&mut self, work: &mut Work<'_, O, D>) {
        product(work.problem, &mut work.scratch.state, &self.p, &mut self.wp);
        let (slope, curvature) = (inner(&self.hat, &self.p), inner(&self.p, &self.wp));
        // A direction that W does not feel, where it is rank deficient, leads nowhere.
        let alpha = if curvature > 0.0 { -slope / curvature } else { 1.0 };
        let mut cut = 0.0;
        for c in 0..self.w.len() {
            let tau = axpy(&work.r[c], alpha, &self.p[c]);
            self.next[c] = work.problem.cones[c].nearest(&tau);
            let lost = sub(&self.next[c], &tau);
            cut += self.w[c] * dot(&lost, &lost);
            self.d[c] = sub(&self.next[c], &work.r[c]);
        }
        if cut > 0.0 {
            product(work.problem, &mut work.scratch.state, &self.d, &mut self.wd);
            let gain = -inner(&self.hat, &self.d) - 0.5 * inner(&self.d, &self.wd);
            if gain <= 0.0 || gain.is_nan() {
                self.plain(work);
                self.size = 0.0;
            }
        }
        work.r.copy_from_slice(&self.next);
    }

    /// The projected gradient's step that lowers the function for sure.
    fn plain<O: Operator<D>>(&mut self, work: &mut Work<'_, O, D>) {
        self.lipschitz = (0.5 * self.lipschitz).max(1.0);
        for _ in 0..HALVINGS {
            for c in 0..self.w.len() {
                let t = inverse(self.w[c]) / self.lipschitz;
                self.next[c] = work.problem.cones[c].nearest(&axpy(&work.r[c], -t, &self.hat[c]));
                self.d[c] = sub(&self.next[c], &work.r[c]);
            }
            product(work.problem, &mut work.scratch.state, &self.d, &mut self.wd);
            if inner(&self.d, &self.wd) <= self.lipschitz * weighted(&self.w, &self.d, &self.d) {
                return;
            }
            self.lipschitz *= 2.0;
        }
    }
}
