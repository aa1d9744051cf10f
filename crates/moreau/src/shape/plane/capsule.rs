//! The capsule: a rectangle with a half-disk at each end.

use super::boundary::{Side, side};
use crate::shape::polygons::SIDES;
use crate::shape::{Contour, Figure, Polygons, SAME, ShapeError, error::length};
use crate::space::Plane;
use std::f64::consts::PI;

/// All points no farther than a radius from a segment of the body's x axis around its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// The segment, as a figure without width: there and back.
    axis: [Side; 2],
    radius: f64,
    length: f64,
}

impl Capsule {
    /// A capsule of this radius around a segment of this length (both in m, positive and finite): from end to end it measures
    /// `length + 2 radius`.
    pub fn new(radius: f64, straight: f64) -> Result<Self, ShapeError> {
        let (radius, length) = (length("the radius of the capsule", radius)?, length("the length of the capsule", straight)?);
        let (left, right) = ([-0.5 * length, 0.0], [0.5 * length, 0.0]);
        Ok(Self { axis: [side(left, right), side(right, left)], radius, length })
    }

    /// Its radius, m.
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The length of its segment, m.
    #[inline]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The segment as seen from below and from above.
    #[inline]
    pub(crate) fn axis(&self) -> &[Side; 2] {
        &self.axis
    }

    /// The ends of the segment, the left one first, in the body's frame, m.
    #[inline]
    pub fn ends(&self) -> [[f64; 2]; 2] {
        self.axis.map(|side| side.start)
    }
}

impl Figure<Plane, 2, 3> for Capsule {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(0.5 * self.length + self.radius)
    }

    fn contour(&self, at: [f64; 2], outward: [f64; 2], _: usize) -> Contour<2> {
        let (half, along) = (0.5 * self.length, at[0] - self.radius * outward[0]);
        if outward[0].abs() < SAME && along.abs() < (1.0 - SAME) * half {
            return Contour::Flat { at, outward };
        }
        Contour::Ball { centre: [half.copysign(along), 0.0], radius: self.radius }
    }

    /// A = 2 r l + π r² and, the centroid of a half-disk being 4 r / (3 π) beyond its diameter,
    /// ∫ |x|² dA = r l³ / 6 + 2 r³ l / 3 + π r⁴ / 2 + 4 r³ l / 3 + π r² l² / 4.
    fn polygons(&self) -> Polygons<2> {
        // Half of the sides about each end, from below the right one on.
        let half = SIDES / 2;
        Polygons::of_loop((0..2 * (half + 1)).map(|i| {
            let right = i <= half;
            let angle = PI * ((i - usize::from(!right)) as f64 / half as f64 - 0.5);
            [if right { 0.5 } else { -0.5 } * self.length + self.radius * libm::cos(angle), self.radius * libm::sin(angle)]
        }))
    }

    fn mass(&self, density: f64) -> [f64; 3] {
        let (r, l) = (self.radius, self.length);
        let mass = density * (2.0 * r * l + PI * r * r);
        let rectangle = r * l * (l * l + 4.0 * r * r) / 6.0;
        let ends = 0.5 * PI * r * r * (r * r + 0.5 * l * l) + 4.0 / 3.0 * r * r * r * l;
        [mass, mass, density * (rectangle + ends)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mass_and_moment_are_those_of_thin_slices() {
        // Slices of width dx and half-height y(x) have the moment 2 (x² y + y³/3) dx. The height is vertical at the tips, so the
        // midpoint rule is off by about dx^(3/2).
        let (r, l, n) = (0.3, 0.8, 2_000_000);
        let half = 0.5 * l + r;
        let (mut area, mut moment) = (0.0, 0.0);
        let dx = 2.0 * half / f64::from(n);
        for i in 0..n {
            let x: f64 = -half + (f64::from(i) + 0.5) * dx;
            let beyond = (x.abs() - 0.5 * l).max(0.0);
            let y = (r * r - beyond * beyond).sqrt();
            area += 2.0 * y * dx;
            moment += 2.0 * (x * x * y + y * y * y / 3.0) * dx;
        }
        let [m, n, j] = Capsule::new(r, l).unwrap().mass(2.0);
        assert!((m - 2.0 * area).abs() < 1e-8 && m == n && (j - 2.0 * moment).abs() < 1e-8, "{m} {j}");
    }

    #[test]
    fn a_capsule_needs_a_radius_and_a_length() {
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Capsule::new(wrong, 1.0).is_err() && Capsule::new(1.0, wrong).is_err(), "{wrong}");
        }
    }
}
