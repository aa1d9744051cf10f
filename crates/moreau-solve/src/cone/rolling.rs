//! The cone of a contact with rolling friction: an intersection of two of Coulomb's cones over one normal.
//!
//! ```text
//! K = {r : ‖r_T‖ ≤ μ r_n, ‖r_R‖ ≤ μ_r r_n}
//! P_K(τ): minimise ½(n − τ_n)² + ½[‖τ_T‖ − μ n]₊² + ½[‖τ_R‖ − μ_r n]₊² over n ≥ 0, then clip τ_T and τ_R
//! ```
//!
//! The function of n is convex and quadratic in pieces: which of the two parts are clipped names the piece, and in each the minimum is
//! a weighted mean, n = (τ_n + Σ μ_p ‖τ_p‖)/(1 + Σ μ_p²) over the clipped parts p. One of the four is consistent with its own piece.
//!
//! Reference: Acary & Bourrier 2021 for the law; the projection is theory (49).

use crate::block::{Matrix, Vector};

/// Which part a component i ≥ 1 belongs to: 0 for sliding, 1 for rolling.
#[inline]
pub(crate) fn part<const D: usize>(i: usize) -> usize {
    usize::from(i >= D.div_ceil(2))
}

/// ‖a_T‖ and ‖a_R‖.
#[inline]
pub(crate) fn part_norms<const D: usize>(a: &Vector<D>) -> [f64; 2] {
    let mut squares = [0.0; 2];
    for i in 1..D {
        squares[part::<D>(i)] += a[i] * a[i];
    }
    squares.map(f64::sqrt)
}

/// μ‖u_T‖ + μ_r‖u_R‖. This and what follows stays out of line and takes values: inlined or by address, it keeps the compiler from making Coulomb's visits small.
#[cold]
#[inline(never)]
pub(super) fn lift<const D: usize>(mu: f64, mu_r: f64, u: Vector<D>) -> f64 {
    let [slip, roll] = part_norms(&u);
    mu * slip + mu_r * roll
}

/// (0, μ u_T/‖u_T‖, μ_r u_R/‖u_R‖), with zero for a part at rest.
#[cold]
#[inline(never)]
pub(super) fn hat_gradient<const D: usize>(mu: f64, mu_r: f64, u: Vector<D>) -> Vector<D> {
    let (limits, lengths) = ([mu, mu_r], part_norms(&u));
    std::array::from_fn(|i| {
        let p = part::<D>(i);
        if i > 0 && lengths[p] > 0.0 { limits[p] * u[i] / lengths[p] } else { 0.0 }
    })
}

/// The orthogonal projection on K.
#[cold]
#[inline(never)]
pub(super) fn project<const D: usize>(mu: f64, mu_r: f64, tau: Vector<D>) -> (Vector<D>, Matrix<D>) {
    let (limits, lengths) = ([mu, mu_r], part_norms(&tau));
    let [t, s] = [mu * lengths[0], mu_r * lengths[1]];
    // The polar cone first, as for Coulomb: there the minimum is at n = 0.
    if t + s <= -tau[0] {
        return ([0.0; D], [[0.0; D]; D]);
    }
    let fits = |p: usize, n: f64| lengths[p] <= limits[p] * n;
    let (only_t, only_r) = ((tau[0] + t) / (1.0 + mu * mu), (tau[0] + s) / (1.0 + mu_r * mu_r));
    // A part that the piece clips need only be asked at τ_n: n lies between τ_n and ‖τ_p‖/μ_p, which keep their order.
    let (n, clipped) = match (fits(0, tau[0]), fits(1, tau[0])) {
        (true, true) => (tau[0], [false, false]),
        (false, _) if fits(1, only_t) => (only_t, [true, false]),
        (_, false) if fits(0, only_r) => (only_r, [false, true]),
        _ => ((tau[0] + t + s) / (1.0 + mu * mu + mu_r * mu_r), [true, true]),
    };
    let piece = Piece { limits, lengths, clipped };
    let gradient = piece.gradient(&tau);
    piece.image(&tau, n, &gradient)
}

/// The projection of τ_T and τ_R on disks of radius μ [τ_n]₊ and μ_r [τ_n]₊.
#[cold]
#[inline(never)]
pub(super) fn project_cylinder<const D: usize>(mu: f64, mu_r: f64, tau: Vector<D>) -> (Vector<D>, Matrix<D>) {
    if tau[0] <= 0.0 {
        return ([0.0; D], [[0.0; D]; D]);
    }
    let (limits, lengths) = ([mu, mu_r], part_norms(&tau));
    let clipped = std::array::from_fn(|p| lengths[p] > limits[p] * tau[0]);
    let gradient = std::array::from_fn(|j| f64::from(u8::from(j == 0)));
    Piece { limits, lengths, clipped }.image(&tau, tau[0], &gradient)
}

/// One smooth piece of a projection.
struct Piece {
    limits: [f64; 2],
    lengths: [f64; 2],
    /// Whether T and R end on their bounds.
    clipped: [bool; 2],
}

impl Piece {
    /// A bound of zero holds its part whatever τ is: its derivative is that of a clipped one even at ‖τ_p‖ = 0.
    #[inline]
    fn bound(&self, p: usize) -> bool {
        self.clipped[p] || self.limits[p] == 0.0
    }

    /// μ_p τ_i/‖τ_p‖, the direction of a clipped part.
    #[inline]
    fn along<const D: usize>(&self, tau: &Vector<D>, i: usize) -> f64 {
        let p = part::<D>(i);
        if self.lengths[p] > 0.0 { self.limits[p] * tau[i] / self.lengths[p] } else { 0.0 }
    }

    /// ∂n/∂τ of the orthogonal projection.
    #[inline]
    fn gradient<const D: usize>(&self, tau: &Vector<D>) -> Vector<D> {
        let weight = |p: usize| if self.clipped[p] { self.limits[p] * self.limits[p] } else { 0.0 };
        let total = 1.0 + weight(0) + weight(1);
        std::array::from_fn(|j| match j {
            0 => 1.0 / total,
            _ if self.clipped[part::<D>(j)] => self.along(tau, j) / total,
            _ => 0.0,
        })
    }

    /// The image with the normal part n, whose derivative is `gradient`, and the derivative of all of it: along the bound's ray, and
    /// turning with the direction of τ_p.
    #[inline]
    fn image<const D: usize>(&self, tau: &Vector<D>, n: f64, gradient: &Vector<D>) -> (Vector<D>, Matrix<D>) {
        let value = std::array::from_fn(|i| match i {
            0 => n,
            _ if self.clipped[part::<D>(i)] => n * self.along(tau, i),
            _ => tau[i],
        });
        let derivative = std::array::from_fn(|i| {
            if i == 0 {
                return *gradient;
            }
            let p = part::<D>(i);
            if !self.bound(p) {
                return std::array::from_fn(|j| f64::from(u8::from(i == j)));
            }
            let length = self.lengths[p];
            let turn = if length > 0.0 { self.limits[p] * n / length } else { 0.0 };
            std::array::from_fn(|j| {
                let ray = self.along(tau, i) * gradient[j];
                if j == 0 || part::<D>(j) != p || length == 0.0 {
                    return ray;
                }
                let same = f64::from(u8::from(i == j));
                ray + turn * (same - tau[i] / length * (tau[j] / length))
            })
        });
        (value, derivative)
    }
}
