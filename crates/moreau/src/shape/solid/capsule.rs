//! The capsule.

use super::revolved::{arc, revolved};
use crate::shape::{Contour, Figure, Polygons, SAME, ShapeError, error::length};
use crate::space::Solid;
use std::f64::consts::PI;

/// All points within a radius of a segment around the body's centre, along the body's z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Radius, m.
    pub radius: f64,
    /// Half the length of the segment, m.
    pub half: f64,
}

impl Capsule {
    /// A capsule of this radius and this (whole) length between the centres of its end balls (m), which must be positive and
    /// finite.
    pub fn new(radius: f64, span: f64) -> Result<Self, ShapeError> {
        let radius = length("the radius of the capsule", radius)?;
        Ok(Self { radius, half: 0.5 * length("the length of the capsule", span)? })
    }

    /// End 0 (below) or 1 (above) of the segment in the body's frame, m.
    #[inline]
    pub fn end(&self, index: usize) -> [f64; 3] {
        [0.0, 0.0, if index == 0 { -self.half } else { self.half }]
    }
}

impl Figure<Solid, 3, 6> for Capsule {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.half + self.radius)
    }

    fn contour(&self, at: [f64; 3], outward: [f64; 3], _: usize) -> Contour<3> {
        let along = at[2] - self.radius * outward[2];
        if outward[2].abs() < SAME && along.abs() < (1.0 - SAME) * self.half {
            return Contour::Line { at: [0.0; 3], way: [0.0, 0.0, 1.0], radius: self.radius };
        }
        Contour::Ball { centre: [0.0, 0.0, self.half.copysign(along)], radius: self.radius }
    }

    fn polygons(&self) -> Polygons<3> {
        revolved(arc(self.radius, -self.half, 0..=6).chain(arc(self.radius, self.half, 6..=12)))
    }

    fn mass(&self, density: f64) -> [f64; 6] {
        let (r, l) = (self.radius, 2.0 * self.half);
        let (side, ends) = (density * PI * r * r * l, density * 4.0 / 3.0 * PI * r * r * r);
        let mass = side + ends;
        let along = (0.5 * side + 0.4 * ends) * r * r;
        // Each half ball has its centre of mass at 3r/8 from its flat side.
        let across = side * (l * l / 12.0 + r * r / 4.0) + ends * (0.4 * r * r + l * l / 4.0 + 0.375 * l * r);
        [mass, mass, mass, across, across, along]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integrals over slices across the axis, each a disk: ∫ π ρ² dz, ∫ π ρ⁴/2 dz and ∫ (π ρ⁴/4 + π ρ² z²) dz.
    #[test]
    fn mass_and_moments_are_the_integrals_over_slices() {
        let capsule = Capsule::new(0.7, 1.8).unwrap();
        let (count, top) = (200_000, capsule.bounding_radius().unwrap());
        let step = 2.0 * top / f64::from(count);
        let (mut mass, mut along, mut across) = (0.0, 0.0, 0.0);
        for k in 0..count {
            let z = -top + (f64::from(k) + 0.5) * step;
            let beyond = (z.abs() - capsule.half).max(0.0);
            let square = 0.7 * 0.7 - beyond * beyond;
            mass += PI * square * step;
            along += 0.5 * PI * square * square * step;
            across += PI * (0.25 * square * square + square * z * z) * step;
        }
        let found = capsule.mass(2.0);
        for (value, right) in found.iter().zip([mass, mass, mass, across, across, along]) {
            // The midpoint rule is off by (step / size)².
            assert!((value - 2.0 * right).abs() < 1e-9 * value, "{found:?}");
        }
    }

    #[test]
    fn a_capsule_needs_a_radius_and_a_length() {
        assert!(Capsule::new(0.0, 1.0).unwrap_err().to_string().contains("radius"));
        assert!(Capsule::new(1.0, f64::NAN).unwrap_err().to_string().contains("length"));
    }
}
