//! The Newton iteration of the enhanced methods (eq. 33), shared: they differ in the map whose fixed point they seek.
//!
//! The unknowns are χ = (r, u). The first row of eq. 34, u − W r − q = 0, is linear: after one round it holds exactly, so u is
//! eliminated and each round solves, with Z = r − g(r, u) (eqs. 26 and 32),
//!
//! ```text
//! (A + B W) Δr = −Z,   A = ∂Z/∂r (eq. 35),   B = ∂Z/∂u (eq. 36),   u ← u + W Δr
//! ```
//!
//! With friction Z has kinks and a full step may overshoot: it is halved until ‖Z‖ falls, and where that fails too the plain
//! projection is taken instead, r ← g.

use super::Visit;
use crate::block::{Matrix, Vector, axpy, identity, mul, norm, solve, sub, velocity_after};

/// A map g at (r, u), with its derivatives.
pub(super) struct Image<const D: usize> {
    pub value: Vector<D>,
    pub by_r: Matrix<D>,
    pub by_u: Matrix<D>,
}

const ROUNDS: usize = 60;
const HALVINGS: i32 = 5;

/// Iterates from (u, r) to a fixed point of `map`.
#[inline(always)]
pub(super) fn newton<const D: usize>(
    w: &Matrix<D>,
    u0: &Vector<D>,
    r0: &Vector<D>,
    map: impl Fn(&Vector<D>, &Vector<D>) -> Image<D>,
) -> Visit<D> {
    let (mut r, mut u) = (*r0, *u0);
    let mut image = map(&r, &u);
    for _ in 0..ROUNDS {
        let z = sub(&r, &image.value);
        let error = norm(&z);
        if error <= 4.0 * f64::EPSILON * (norm(&r) + norm(&image.value)) {
            return Visit { r, u, converged: true };
        }
        let step = step(w, &image, &z);
        let mut accepted = false;
        for halving in 0..=HALVINGS {
            let trial = axpy(&r, 0.5_f64.powi(halving), &step);
            let u_trial = velocity_after(w, u0, r0, &trial);
            let image_trial = map(&trial, &u_trial);
            if norm(&sub(&trial, &image_trial.value)) < error {
                (r, u, image, accepted) = (trial, u_trial, image_trial, true);
                break;
            }
        }
        if !accepted {
            r = image.value;
            u = velocity_after(w, u0, r0, &r);
            image = map(&r, &u);
        }
    }
    let error = norm(&sub(&r, &image.value));
    Visit { r, u, converged: error <= 1e-12 * (norm(&r) + norm(&image.value)) }
}

/// Δr of eq. 33; the step −Z to the projection where the matrix is singular.
#[inline]
fn step<const D: usize>(w: &Matrix<D>, image: &Image<D>, z: &Vector<D>) -> Vector<D> {
    let one = identity::<D>();
    let columns: Matrix<D> = std::array::from_fn(|j| std::array::from_fn(|i| w[i][j]));
    let a: Matrix<D> =
        std::array::from_fn(|i| std::array::from_fn(|j| one[i][j] - image.by_r[i][j] - mul(&image.by_u, &columns[j])[i]));
    let minus = z.map(|x| -x);
    solve(&a, &minus).unwrap_or(minus)
}
