//! The cylinder.

use super::revolved::revolved;
use crate::shape::{Contour, Figure, Polygons, SAME, ShapeError, error::length};
use crate::space::Solid;
use std::f64::consts::PI;

/// How far from the lowest point of the rim, in radii, a point of contact counts as that point.
const ON_RIM: f64 = 1e-3;

/// A circular cylinder around its centre, its axis along the body's z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Radius, m.
    pub radius: f64,
    /// Half the length, m.
    pub half: f64,
}

impl Cylinder {
    /// A cylinder of this radius and this (whole) length from cap to cap (m), which must be positive and finite.
    pub fn new(radius: f64, span: f64) -> Result<Self, ShapeError> {
        let radius = length("the radius of the cylinder", radius)?;
        Ok(Self { radius, half: 0.5 * length("the length of the cylinder", span)? })
    }
}

impl Figure<Solid, 3, 6> for Cylinder {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some((self.radius * self.radius + self.half * self.half).sqrt())
    }

    fn contour(&self, at: [f64; 3], outward: [f64; 3], _: usize) -> Contour<3> {
        let [x, y, z] = outward;
        let across = (x * x + y * y).sqrt();
        if across < SAME {
            return Contour::Flat { at, outward };
        }
        if z.abs() < SAME {
            return Contour::Line { at: [0.0; 3], way: [0.0, 0.0, 1.0], radius: self.radius };
        }
        let centre = [0.0, 0.0, self.half.copysign(at[2])];
        let lowest = [self.radius * x / across, self.radius * y / across, centre[2]];
        let apart = (0..3).map(|k| (at[k] - lowest[k]) * (at[k] - lowest[k])).sum::<f64>().sqrt();
        // Of one that nearly lies the lowest points of both rims are contacts. Other points are those that a cap stands on, fixed in the body.
        if apart < ON_RIM * self.radius {
            return Contour::Rim { centre, axis: [0.0, 0.0, 1.0], radius: self.radius };
        }
        Contour::corner(at)
    }

    fn polygons(&self) -> Polygons<3> {
        revolved([[self.radius, -self.half], [self.radius, self.half]])
    }

    fn mass(&self, density: f64) -> [f64; 6] {
        let (r, h) = (self.radius, self.half);
        let mass = density * PI * r * r * 2.0 * h;
        // With half the length the familiar twelfth is a third.
        let across = mass * (r * r / 4.0 + h * h / 3.0);
        [mass, mass, mass, across, across, 0.5 * mass * r * r]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moments_of_a_cylinder_are_a_half_and_three_r_squared_and_l_squared_over_twelve() {
        let cylinder = Cylinder::new(2.0, 3.0).unwrap();
        let mass = 5.0 * PI * 4.0 * 3.0;
        let across = mass * (3.0 * 4.0 + 9.0) / 12.0;
        for (found, right) in cylinder.mass(5.0).iter().zip([mass, mass, mass, across, across, 2.0 * mass]) {
            assert!((found - right).abs() < 1e-12 * right);
        }
        assert!((cylinder.bounding_radius().unwrap() - 2.5).abs() < 1e-15);
    }

    #[test]
    fn a_cylinder_needs_a_radius_and_a_length() {
        assert!(Cylinder::new(-1.0, 1.0).unwrap_err().to_string().contains("radius"));
        assert!(Cylinder::new(1.0, f64::INFINITY).unwrap_err().to_string().contains("length"));
    }
}
