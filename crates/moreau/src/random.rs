//! Random numbers that are the same on every machine.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A generator of fixed kind. Only sums, products, square roots and logarithms of our own follow it, which every machine rounds alike.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Random(Pcg64Mcg);

impl Random {
    /// Three independent generators from one seed: for sizes, places and velocities, so that changing one leaves the others.
    pub(crate) fn three(seed: u64) -> [Self; 3] {
        let mut first = Pcg64Mcg::seed_from_u64(seed);
        std::array::from_fn(|_| Self(Pcg64Mcg::from_rng(&mut first)))
    }

    /// A number in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// An index below `count`. (The bias of a product with 2⁶⁴ is below count / 2⁶⁴.)
    pub(crate) fn index(&mut self, count: usize) -> usize {
        ((u128::from(self.0.next_u64()) * count as u128) >> 64) as usize
    }

    /// Puts `items` in random order (Fisher and Yates).
    pub(crate) fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.index(last + 1));
        }
    }

    /// A point of the unit ball, all alike.
    pub(crate) fn in_ball<const D: usize>(&mut self) -> [f64; D] {
        loop {
            let point = std::array::from_fn(|_| 2.0 * self.unit() - 1.0);
            if square(&point) <= 1.0 {
                return point;
            }
        }
    }

    /// A direction, all alike; by rejection, because sines differ between machines.
    pub(crate) fn direction<const D: usize>(&mut self) -> [f64; D] {
        loop {
            let point = self.in_ball();
            let length = square(&point).sqrt();
            if length > 1e-3 {
                return point.map(|x| x / length);
            }
        }
    }

    /// A number of the standard normal distribution (Marsaglia & Bray 1964). Of libraries' ways the tails ask the system for a logarithm.
    pub(crate) fn normal(&mut self) -> f64 {
        loop {
            let point: [f64; 2] = self.in_ball();
            let s = square(&point);
            if s > 0.0 {
                return point[0] * (-2.0 * libm::log(s) / s).sqrt();
            }
        }
    }
}

/// The square of a vector's length.
pub(crate) fn square<const D: usize>(v: &[f64; D]) -> f64 {
    v.iter().map(|x| x * x).sum()
}
