//! Distributions of radii: the most extreme radii, the mean mass, and draws.

use super::error::Fault;
use super::generate::{LogNormal, Radii, Range};
use super::path::KeyPath;
use super::values::Numbers;
use crate::random::Random;

/// How often a radius of a clipped distribution is drawn again before the distribution is given up.
const REDRAWS: usize = 10_000;

impl Radii {
    /// The largest radius that can come, m.
    pub(super) fn largest(&self) -> f64 {
        match self {
            Radii::Constant(radius) => *radius,
            Radii::Uniform(range) | Radii::UniformMass(range) => range.max,
            Radii::LogNormal(log_normal) => log_normal.max,
            Radii::Sieve(points) => points.last().map_or(0.0, |Numbers([size, _])| 0.5 * size),
        }
    }

    /// The mean of r to the power `dimension`.
    pub(super) fn mean_power(&self, dimension: usize) -> f64 {
        let power = |r: f64| r.powi(dimension as i32);
        let nodes = 4096;
        let middles = (0..nodes).map(|k| (f64::from(k) + 0.5) / f64::from(nodes));
        if let Radii::LogNormal(LogNormal { median, sigma, min, max }) = self {
            // Over the logarithm of r, whose density is normal.
            let (low, high) = (libm::log(min / median), libm::log(max / median));
            let (mut sum, mut weights) = (0.0, f64::MIN_POSITIVE);
            for u in middles {
                let log = low + u * (high - low);
                let weight = if *sigma > 0.0 { libm::exp(-0.5 * (log / sigma).powi(2)) } else { 1.0 };
                sum += weight * power(median * libm::exp(log));
                weights += weight;
            }
            return sum / weights;
        }
        let quantile = self.quantiles(dimension);
        middles.map(|u| power(quantile.at(u))).sum::<f64>() / f64::from(nodes)
    }

    /// Draws `count` radii; `None` where a clipped distribution has next to nothing between its ends.
    pub(super) fn draw(&self, count: usize, dimension: usize, random: &mut Random) -> Option<Vec<f64>> {
        if let Radii::LogNormal(log_normal) = self {
            return (0..count).map(|_| log_normal.draw(random)).collect();
        }
        let quantile = self.quantiles(dimension);
        let mut radii: Vec<f64> = (0..count).map(|k| quantile.at((k as f64 + random.unit()) / count as f64)).collect();
        random.shuffle(&mut radii);
        Some(radii)
    }

    /// The fault of a distribution that [`Radii::draw`] gives up.
    pub(super) fn empty(path: KeyPath) -> Fault {
        let message = "next to nothing of the distribution lies between min and max";
        Fault::new(path, message, "expected an interval around the median")
    }

    fn quantiles(&self, dimension: usize) -> Quantiles {
        let class = |min, max, by_mass, weight| Class { min, max, by_mass, weight };
        let classes = match self {
            Radii::Constant(radius) => vec![class(*radius, *radius, false, 1.0)],
            Radii::Uniform(Range { min, max }) => vec![class(*min, *max, false, 1.0)],
            Radii::UniformMass(Range { min, max }) => vec![class(*min, *max, true, 1.0)],
            Radii::LogNormal(LogNormal { median, .. }) => vec![class(*median, *median, false, 1.0)],
            Radii::Sieve(points) => points
                .windows(2)
                .map(|pair| {
                    let [Numbers([small, below]), Numbers([large, above])] = [pair[0], pair[1]];
                    let (min, max) = (0.5 * small, 0.5 * large);
                    // Number of balls = mass of the class times the mean of 1 / r^D over it.
                    class(min, max, true, (above - below) * mean_inverse_power(min, max, dimension))
                })
                .collect(),
        };
        Quantiles { classes, dimension }
    }
}

impl LogNormal {
    /// A radius.
    fn draw(&self, random: &mut Random) -> Option<f64> {
        let mut draws = std::iter::repeat_with(|| self.median * libm::exp(self.sigma * random.normal())).take(REDRAWS);
        draws.find(|radius| (self.min..=self.max).contains(radius))
    }
}

/// Radii between two, evenly by number or by mass.
struct Class {
    min: f64,
    max: f64,
    by_mass: bool,
    /// Its share of the number of balls, not normalised.
    weight: f64,
}

/// A distribution by number as the inverse of its cumulative function.
struct Quantiles {
    classes: Vec<Class>,
    dimension: usize,
}

impl Quantiles {
    /// The radius below which a part `u` of the balls lies, 0 ≤ u ≤ 1.
    fn at(&self, u: f64) -> f64 {
        let mut left = u * self.classes.iter().map(|class| class.weight).sum::<f64>();
        for class in &self.classes {
            if left < class.weight {
                return class.at(left / class.weight, self.dimension);
            }
            left -= class.weight;
        }
        self.classes.iter().rev().find(|class| class.weight > 0.0).map_or(0.0, |class| class.max)
    }
}

impl Class {
    fn at(&self, u: f64, dimension: usize) -> f64 {
        let (a, b) = (self.min, self.max);
        let radius = if !self.by_mass {
            a + u * (b - a)
        } else if dimension == 2 {
            // n(r) ~ r⁻² is even in 1/r; n(r) ~ r⁻³ is even in 1/r².
            1.0 / (1.0 / a + u * (1.0 / b - 1.0 / a))
        } else {
            1.0 / (1.0 / (a * a) + u * (1.0 / (b * b) - 1.0 / (a * a))).sqrt()
        };
        radius.clamp(a, b)
    }
}

/// The mean of r⁻² (plane) or r⁻³ (space) over radii from `a` to `b`.
fn mean_inverse_power(a: f64, b: f64, dimension: usize) -> f64 {
    if dimension == 2 { 1.0 / (a * b) } else { 0.5 * (a + b) / (a * a * b * b) }
}
