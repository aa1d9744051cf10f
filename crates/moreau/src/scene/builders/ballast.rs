//! Random convex stones.

use super::pieces::prism;
use super::{Builder, Piece, Site};
use crate::scene::build::centres;
use crate::scene::check::generate::{arranged, radii};
use crate::scene::error::Fault;
use crate::scene::generate::{Arrangement, Lattice, Packing, Radii, arrangement};
use crate::random::{Random, square};
use crate::shape::solid::Polyhedron;
use crate::space::{Solid, Space};
use glam::DQuat;
use crate::scene::ShapeSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Random convex stones, each turned at random, apart from each other by the balls around them. Corners are random points of an ellipsoid (in
/// the plane an ellipse), stretched so that the stone is as long, wide and high along its axes as the ellipsoid. The same seed gives the same
/// stones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ballast {
    /// How many stones.
    pub count: u64,
    /// Half of their widths, as of balls: a sieve of this diameter lets them through.
    pub radii: Radii,
    /// How many corners each has, 6 or more; default 12 (in the plane 3 or more, default 8).
    pub corners: Option<u64>,
    /// Width over length, more than 0 and at most 1; default 0.7.
    #[serde(default = "Ballast::seven_tenths")]
    pub elongation: f64,
    /// Height over width, more than 0 and at most 1; default 0.7; only in space.
    pub flatness: Option<f64>,
    /// Puts them on the sites of a lattice, the lowest layer first. There is either a lattice or a packing.
    pub lattice: Option<Lattice>,
    /// Puts them one after the other at random where the balls around them overlap none.
    pub packing: Option<Packing>,
    /// The seed; default the place of this builder in the list, from 0.
    pub seed: Option<u64>,
}

/// How many points are drawn for each corner after the first: the one farthest from all others becomes it, so that no stone is a splinter.
const CANDIDATES: usize = 8;

/// How often the corners of a stone are drawn of which no polyhedron can be told from rounding.
const REDRAWS: usize = 100;

impl Ballast {
    fn seven_tenths() -> f64 {
        0.7
    }

    /// Half of length, width and height for a width of 2.
    fn axes(&self) -> [f64; 3] {
        [1.0 / self.elongation, 1.0, self.flatness.unwrap_or(Self::seven_tenths())]
    }

    fn corners(&self, dimension: usize) -> u64 {
        self.corners.unwrap_or(if dimension == 2 { 8 } else { 12 })
    }

    fn arrangement(&self) -> Option<Arrangement<'_>> {
        arrangement(self.lattice.as_ref(), self.packing.as_ref())
    }

    /// A bound of all stones' distances from their middles to their corners.
    fn largest(&self, dimension: usize) -> f64 {
        let box_of_two: f64 = self.axes()[..dimension].iter().map(|half| half * half).sum();
        self.radii.largest() * box_of_two.sqrt()
    }

    /// The corners of a stone of width 2 around the middle of its box, along its axes.
    fn along_axes<const D: usize>(&self, random: &mut Random) -> Vec<[f64; D]> {
        let mut corners: Vec<[f64; D]> = vec![random.direction()];
        let nearest = |corners: &[[f64; D]], p: &[f64; D]| {
            let apart = |q: &[f64; D]| square::<D>(&std::array::from_fn(|k| p[k] - q[k]));
            corners.iter().map(apart).fold(f64::INFINITY, f64::min)
        };
        for _ in 1..self.corners(D) {
            let candidates = std::iter::repeat_with(|| random.direction()).take(CANDIDATES);
            let far = candidates.max_by(|p, q| nearest(&corners, p).total_cmp(&nearest(&corners, q)));
            corners.extend(far);
        }
        for (k, half) in self.axes().into_iter().enumerate().take(D) {
            let (low, high) = corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p[k]), high.max(p[k])));
            corners.iter_mut().for_each(|p| p[k] = half * (2.0 * (p[k] - low) / (high - low) - 1.0));
        }
        corners
    }

    /// The corners of a stone of the plane, in order around it, turned at random.
    fn polygon(&self, random: &mut Random) -> Vec<[f64; 2]> {
        let mut corners = self.along_axes::<2>(random);
        corners.sort_by(|p, q| libm::atan2(p[1], p[0]).total_cmp(&libm::atan2(q[1], q[0])));
        let [cosine, sine] = random.direction();
        corners.into_iter().map(|[x, y]| [cosine * x - sine * y, sine * x + cosine * y]).collect()
    }

    /// The corners of a stone of space, turned at random; `None` where no polyhedron came of many draws.
    fn polyhedron(&self, random: &mut Random) -> Option<Vec<[f64; 3]>> {
        let mut draws = std::iter::repeat_with(|| self.along_axes::<3>(random)).take(REDRAWS);
        let corners = draws.find(|corners| Polyhedron::hull(corners).is_ok())?;
        // A direction in four dimensions is a rotation, all alike.
        let rotation = DQuat::from_array(random.direction());
        Some(corners.into_iter().map(|p| Solid::rotate(rotation, p)).collect())
    }

    /// Stones of width 2 with the radii by which they are to be scaled, put in place.
    fn place<const D: usize>(
        &self,
        site: &Site<'_>,
        [sizes, places]: [&mut Random; 2],
        stones: &[Vec<[f64; D]>],
    ) -> Result<Vec<(f64, [f64; 3])>, Fault> {
        let radii = self.radii.draw(stones.len(), D, sizes).ok_or_else(|| {
            let message = "next to nothing of the distribution lies between min and max";
            site.fault("radii", message, "expected an interval around the median")
        })?;
        let around = |(stone, radius): (&Vec<[f64; D]>, &f64)| radius * stone.iter().map(square).fold(0.0, f64::max).sqrt();
        let balls: Vec<f64> = stones.iter().zip(&radii).map(around).collect();
        let centres = centres::<D>(self.arrangement().as_ref(), self.largest(D), &balls, places, &site.path)?;
        // In the plane the second coordinate is up.
        let padded = |p: [f64; D]| [p[0], if D == 3 { p[1] } else { 0.0 }, p[D - 1]];
        Ok(radii.into_iter().zip(centres.into_iter().map(padded)).collect())
    }
}

impl Builder for Ballast {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.whole("count", self.count, 1)?;
        radii(&self.radii, &site.path.then("radii"))?;
        let least = if site.dimension == 2 { 3 } else { 6 };
        let most = Polyhedron::MOST_VERTICES as u64;
        if !(least..=most).contains(&self.corners(site.dimension)) {
            let message = format!("corners is {}", self.corners(site.dimension));
            return Err(site.fault("corners", message, format!("expected a number from {least} to {most}")));
        }
        for (field, ratio) in [("elongation", self.elongation), ("flatness", self.axes()[2])] {
            // Thinner ones would lose their corners to rounding.
            if !(1e-3..=1.0).contains(&ratio) {
                return Err(site.fault(field, format!("{field} is {ratio}"), "expected a ratio from 0.001 to 1"));
            }
        }
        if site.dimension == 2 && self.flatness.is_some() {
            return Err(site.fault("flatness", "a flatness where dimension = 2", "leave it out"));
        }
        let places = (self.lattice.as_ref(), self.packing.as_ref());
        arranged(site.scene, places, Some(self.count), self.largest(site.dimension), &site.path)
    }

    fn count(&self, _: usize) -> u64 {
        self.count
    }

    fn piece(&self, _: u64) -> &'static str {
        "stone"
    }

    fn pieces(&self, site: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        let [mut sizes, mut places, mut forms] = Random::three(self.seed.unwrap_or(site.seed));
        let scaled = |radius: f64| move |x: f64| radius * x;
        if site.dimension == 2 {
            let stones: Vec<_> = (0..self.count).map(|_| self.polygon(&mut forms)).collect();
            let placed = self.place(site, [&mut sizes, &mut places], &stones)?;
            let piece = |(stone, (radius, position)): (Vec<[f64; 2]>, _)| {
                let profile = stone.into_iter().map(|p| p.map(scaled(radius))).collect();
                Piece { shape: prism(profile, None), position }
            };
            return Ok(stones.into_iter().zip(placed).map(piece).collect());
        }
        let stones: Option<Vec<_>> = (0..self.count).map(|_| self.polyhedron(&mut forms)).collect();
        let stones = stones.ok_or_else(|| {
            site.fault("corners", format!("no polyhedron came of {REDRAWS} draws of corners"), "expected fewer corners or rounder stones")
        })?;
        let placed = self.place(site, [&mut sizes, &mut places], &stones)?;
        let piece = |(stone, (radius, position)): (Vec<[f64; 3]>, _)| {
            let points = stone.into_iter().map(|p| p.map(scaled(radius)));
            Piece { shape: ShapeSpec::polyhedron(points), position }
        };
        Ok(stones.into_iter().zip(placed).map(piece).collect())
    }
}
