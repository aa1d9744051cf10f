//! What the local methods share for rolling friction: variables of one unit, and the law enforced on a chosen set.
//!
//! Moments and forces have different units, and a small ball turns far more easily than it moves: W_RR is then many times W_nn, and a
//! norm or a step that mixes both sees the spins alone. With r_p = s_p r̃_p and ũ_p = s_p u_p for p = T, R the law keeps its form,
//!
//! ```text
//! W̃ = diag(s) W diag(s),   μ̃ = μ/s_T,   μ̃_r = μ_r/s_R,   μ̃‖ũ_T‖ = μ‖u_T‖
//! ```
//!
//! so each method visits the contact in the variables for which W̃_TT and W̃_RR are near W_nn (theory (50)). The s are powers of two:
//! no digit is lost.

use super::Visit;
use crate::Cone;
use crate::block::{Matrix, Vector, dot, solve};
use crate::cone::part;

/// `visit` in variables of one unit. Kept out of line, so that the other laws' visits stay short, and by value, so that theirs need not
/// be written to memory.
#[cold]
#[inline(never)]
pub(super) fn equilibrated<const D: usize>(
    w: Matrix<D>,
    [mu, mu_r]: [f64; 2],
    u: Vector<D>,
    r: Vector<D>,
    visit: impl FnOnce(&Matrix<D>, Cone, &Vector<D>, &Vector<D>) -> Visit<D>,
) -> Visit<D> {
    let [t, s] = part_scales(&w);
    let scale: Vector<D> = std::array::from_fn(|i| if i == 0 { 1.0 } else { [t, s][part::<D>(i)] });
    let scaled = std::array::from_fn(|i| std::array::from_fn(|j| scale[i] * w[i][j] * scale[j]));
    let (u, r) = (std::array::from_fn(|i| scale[i] * u[i]), std::array::from_fn(|i| r[i] / scale[i]));
    let visit = visit(&scaled, Cone::Rolling { mu: mu / t, mu_r: mu_r / s }, &u, &r);
    Visit {
        r: std::array::from_fn(|i| scale[i] * visit.r[i]),
        u: std::array::from_fn(|i| visit.u[i] / scale[i]),
        converged: visit.converged,
    }
}

/// s_T and s_R: √(W_nn/W_pp) with the mean of the part's diagonal, cut down to a power of two; one where either cannot move.
fn part_scales<const D: usize>(w: &Matrix<D>) -> [f64; 2] {
    let (mut sums, mut counts) = ([0.0; 2], [0.0; 2]);
    for i in 1..D {
        sums[part::<D>(i)] += w[i][i];
        counts[part::<D>(i)] += 1.0;
    }
    std::array::from_fn(|p| {
        let ratio = w[0][0] * counts[p] / sums[p];
        // Beyond this range the part does not move in any sense that matters, and squares of the scale would leave the numbers.
        if (1e-60..=1e60).contains(&ratio) { power_below(ratio.sqrt()) } else { 1.0 }
    })
}

/// The greatest power of two that is not above x, for a positive normal x: its exponent without its digits.
fn power_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

/// The set that a closed contact is in: which parts slide, and along what. T and R are parts 0 and 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Set<const D: usize> {
    /// Whether each part slides; if not, its velocity is zero.
    pub slides: [bool; 2],
    /// r_p/r_n of the parts that slide, μ_p times a unit vector.
    pub along: Vector<D>,
    /// The part of each component.
    pub part: [usize; D],
}

impl<const D: usize> Set<D> {
    /// Whether component i ≥ 1 slides.
    pub(super) fn slides(&self, i: usize) -> bool {
        self.slides[self.part[i]]
    }

    /// r with u_n = 0, u_p = 0 for the parts that stick and r_p = r_n along_p for those that slide, where q is the velocity without
    /// this contact's impulse; `None` if there is no such r. Components that nothing moves stay near `r0`.
    pub(super) fn enforce(&self, w: &Matrix<D>, q: &Vector<D>, r0: &Vector<D>) -> Option<Vector<D>> {
        self.system(w, q, r0, 0.0).or_else(|| {
            // A singular block, as bodies with too few freedoms have: of its many answers the one near the impulse at hand.
            let trace: f64 = (0..D).map(|i| w[i][i].abs()).sum();
            self.system(w, q, r0, 1e-10 * trace)
        })
    }

    /// The same with W + ε I about r0 for the parts that stick.
    fn system(&self, w: &Matrix<D>, q: &Vector<D>, r0: &Vector<D>, epsilon: f64) -> Option<Vector<D>> {
        // The parts that slide are put in by hand: they follow r_n.
        let a: Matrix<D> = std::array::from_fn(|i| {
            if i > 0 && self.slides(i) {
                return std::array::from_fn(|j| f64::from(u8::from(i == j)));
            }
            let ray = w[i][0] + (1..D).map(|j| if self.slides(j) { w[i][j] * self.along[j] } else { 0.0 }).sum::<f64>();
            std::array::from_fn(|j| match j {
                0 => ray,
                _ if self.slides(j) => 0.0,
                _ => w[i][j] + if i == j { epsilon } else { 0.0 },
            })
        });
        let right = std::array::from_fn(|i| match i {
            0 => -q[0],
            _ if self.slides(i) => 0.0,
            _ => epsilon * r0[i] - q[i],
        });
        let mut r = solve(&a, &right)?;
        for i in 1..D {
            if self.slides(i) {
                r[i] = r[0] * self.along[i];
            }
        }
        r.iter().all(|x| x.is_finite()).then_some(r)
    }

    /// The velocity q + W r that goes with an enforced r: exactly zero where the set says so.
    pub(super) fn velocity(&self, w: &Matrix<D>, q: &Vector<D>, r: &Vector<D>) -> Vector<D> {
        std::array::from_fn(|i| if i > 0 && self.slides(i) { q[i] + dot(&w[i], r) } else { 0.0 })
    }
}
