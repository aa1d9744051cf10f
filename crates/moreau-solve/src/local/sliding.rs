//! The search for the multipliers of sliding parts, for the reference method (theory (35), with rolling (51)).
//!
//! ```text
//! u_n = 0,   u_p = −λ_p r_p,   ‖r_p‖ ≤ μ_p r_n,   λ_p ≥ 0,   one of the last two with equality,       p = T and, with rolling, R
//! ```
//!
//! Eliminating r_n by u_n = 0 leaves (S + Λ) r = −b with the Schur complement S = W_TT − W_Tn W_nT/W_nn, b = q_T − W_Tn q_n/W_nn, T
//! standing for all parts, and Λ = λ_p on each. For each part h_p(λ) = μ_p r_n/‖r_p‖ − 1 has the sign of what is left to the bound. As
//! in the subproblem of trust regions it is nearly linear in λ_p (the norm itself is not), so Newton's method on h takes few rounds; a
//! bracket guards it. With two parts the search in λ_T is inside that in λ_R.

use super::rolling::Set;
use crate::block::{Matrix, Vector, dot, solve, solve_definite};

const ROUNDS: usize = 200;

/// A closed contact whose impulse at rest leaves the cone.
pub(super) struct Sliding<'a, const D: usize> {
    w: &'a Matrix<D>,
    q: &'a Vector<D>,
    limits: [f64; 2],
    part: [usize; D],
    schur: Matrix<D>,
    b: Vector<D>,
    symmetric: bool,
    /// A multiplier of the size of S.
    scale: f64,
}

/// r at some λ, with h and ∂h/∂λ.
struct Point<const D: usize> {
    r: Vector<D>,
    h: [f64; 2],
    slope: [[f64; 2]; 2],
}

impl<'a, const D: usize> Sliding<'a, D> {
    /// For W_nn > 0; `part` says which part a component is of, `limits` the coefficient of each.
    pub(super) fn new(w: &'a Matrix<D>, q: &'a Vector<D>, limits: [f64; 2], part: [usize; D]) -> Self {
        let schur: Matrix<D> = std::array::from_fn(|i| std::array::from_fn(|j| w[i][j] - w[i][0] * w[0][j] / w[0][0]));
        let b = std::array::from_fn(|i| if i == 0 { 0.0 } else { q[i] - w[i][0] * q[0] / w[0][0] });
        let trace: f64 = (1..D).map(|i| schur[i][i].abs()).sum();
        let symmetric = (1..D).all(|i| (1..i).all(|j| schur[i][j] == schur[j][i]));
        // A tangent that nothing moves slides all the same: then any size serves to begin with.
        let scale = if trace > f64::EPSILON * w[0][0] { trace } else { w[0][0] };
        Self { w, q, limits, part, schur, b, symmetric, scale }
    }

    /// The impulse, and the set that it is in; without the set where the search found none of it.
    pub(super) fn search(&self) -> (Vector<D>, Set<D>) {
        let inner = |lambda_r: f64| if self.limits[0] == 0.0 { 0.0 } else { self.root(|lambda| self.along(lambda, lambda_r, 0)) };
        // Coulomb's law has one part, and a coefficient of zero leaves none to search.
        let lambda_r = if self.limits[1] == 0.0 { 0.0 } else { self.outer(inner) };
        let lambda = [inner(lambda_r), lambda_r];
        let r = self.point(lambda).r;
        let lengths = self.norms(&r);
        let slides = std::array::from_fn(|p| lambda[p] > 0.0 || self.limits[p] == 0.0);
        let along = std::array::from_fn(|i| {
            let p = self.part[i];
            if i > 0 && slides[p] && lengths[p] > 0.0 { self.limits[p] * r[i] / lengths[p] } else { 0.0 }
        });
        (r, Set { slides, along, part: self.part })
    }

    /// λ_R, with λ_T following it.
    fn outer(&self, inner: impl Fn(f64) -> f64) -> f64 {
        self.root(|lambda| {
            let lambda_t = inner(lambda);
            let point = self.point([lambda_t, lambda]);
            // By the implicit function: λ_T follows λ_R where T slides.
            let [[tt, tr], [rt, rr]] = point.slope;
            let follows = if lambda_t > 0.0 && tt != 0.0 { rt * tr / tt } else { 0.0 };
            (point.h[1], rr - follows)
        })
    }

    fn along(&self, lambda_t: f64, lambda_r: f64, p: usize) -> (f64, f64) {
        let point = self.point([lambda_t, lambda_r]);
        (point.h[p], point.slope[p][p])
    }

    fn norms(&self, a: &Vector<D>) -> [f64; 2] {
        let mut squares = [0.0; 2];
        for i in 1..D {
            squares[self.part[i]] += a[i] * a[i];
        }
        squares.map(f64::sqrt)
    }

    /// h ≥ 0 at λ = 0, or the λ at which h changes from negative: Newton's steps inside a bracket, halved where they leave it.
    fn root(&self, f: impl Fn(f64) -> (f64, f64)) -> f64 {
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let (mut h, mut slope) = f(0.0);
        if h.is_nan() || h >= 0.0 {
            return 0.0;
        }
        let (mut lambda, mut last) = (0.0_f64, f64::INFINITY);
        for _ in 0..ROUNDS {
            let newton = lambda - h / slope;
            // A step that shrinks less than by half is not Newton's convergence; halving is then no slower.
            let inside = newton > low && newton < high && (newton - lambda).abs() <= 0.5 * last;
            let next = if inside {
                newton
            } else if high.is_finite() {
                // Orders of magnitude first, then digits.
                if low > 0.0 && high > 4.0 * low { (low * high).sqrt() } else { 0.5 * (low + high) }
            } else {
                4.0 * low.max(self.scale)
            };
            let change = (next - lambda).abs();
            last = if high.is_finite() { change } else { f64::INFINITY };
            lambda = next;
            (h, slope) = f(lambda);
            *(if h < 0.0 { &mut low } else { &mut high }) = lambda;
            // h compares two impulses: below this both are the same number.
            let even = h.abs() <= 2.0 * f64::EPSILON;
            let closed = high.is_finite() && high - low <= f64::EPSILON * high;
            if even || closed || change <= f64::EPSILON * lambda || lambda > 1e300 {
                break;
            }
        }
        lambda
    }

    #[inline]
    fn point(&self, lambda: [f64; 2]) -> Point<D> {
        let minus_b = self.b.map(|x| -x);
        let (lambda, r) = match self.apply(lambda, &minus_b) {
            Some(r) => (lambda, r),
            // S is singular: the least that makes it regular stands for zero.
            None => {
                let lambda = lambda.map(|x| x.max(4.0 * f64::EPSILON * self.scale));
                (lambda, self.apply(lambda, &minus_b).unwrap_or([0.0; D]))
            }
        };
        let coupled = |t: &Vector<D>| (1..D).map(|i| self.w[0][i] * t[i]).sum::<f64>() / self.w[0][0];
        let (lengths, normal) = (self.norms(&r), -self.q[0] / self.w[0][0] - coupled(&r));
        let h = std::array::from_fn(|p| if lengths[p] > 0.0 { self.limits[p] * normal / lengths[p] - 1.0 } else { 1.0 });
        let mut slope = [[0.0; 2]; 2];
        for k in (0..2).filter(|&k| self.limits[k] > 0.0) {
            let on_part = std::array::from_fn(|i| if i > 0 && self.part[i] == k { -r[i] } else { 0.0 });
            let turned = self.apply(lambda, &on_part).unwrap_or([0.0; D]);
            for p in (0..2).filter(|&p| lengths[p] > 0.0) {
                let growth: f64 = (1..D).filter(|&i| self.part[i] == p).map(|i| r[i] * turned[i]).sum();
                let squared = lengths[p] * lengths[p];
                slope[p][k] = self.limits[p] / lengths[p] * (-coupled(&turned) - normal * growth / squared);
            }
        }
        let mut full = r;
        full[0] = normal;
        Point { r: full, h, slope }
    }

    /// (S + Λ)⁻¹ a on the parts that may carry an impulse; zero on the normal and on parts with the coefficient zero.
    #[inline]
    fn apply(&self, lambda: [f64; 2], a: &Vector<D>) -> Option<Vector<D>> {
        let free = |i: usize| i > 0 && self.limits[self.part[i]] > 0.0;
        let same = |i: usize, j: usize| f64::from(u8::from(i == j));
        let block = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                if free(i) && free(j) { self.schur[i][j] + lambda[self.part[i]] * same(i, j) } else { same(i, j) }
            })
        });
        let right = std::array::from_fn(|i| if free(i) { a[i] } else { 0.0 });
        let x = if self.symmetric { solve_definite(&block, &right) } else { solve(&block, &right) };
        x.filter(|x| dot(x, x).is_finite())
    }
}
