//! The disk.

use crate::shape::polygons::{Polygons, SIDES};
use crate::shape::{Contour, Figure, ShapeError, error::length};
use crate::space::Plane;
use std::f64::consts::PI;

/// A disk around its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    /// Radius, m.
    pub radius: f64,
}

impl Disk {
    /// A disk of this radius (m), which must be positive and finite.
    pub fn new(radius: f64) -> Result<Self, ShapeError> {
        Ok(Self { radius: length("the radius of the disk", radius)? })
    }
}

impl Figure<Plane, 2, 3> for Disk {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.radius)
    }

    #[inline]
    fn is_round(&self) -> bool {
        true
    }

    fn contour(&self, _: [f64; 2], _: [f64; 2], _: usize) -> Contour<2> {
        Contour::Ball { centre: [0.0; 2], radius: self.radius }
    }

    fn polygons(&self) -> Polygons<2> {
        let angle = |side: usize| 2.0 * PI * side as f64 / SIDES as f64;
        Polygons::of_loop((0..SIDES).map(|side| [self.radius * libm::cos(angle(side)), self.radius * libm::sin(angle(side))]))
    }

    fn mass(&self, density: f64) -> [f64; 3] {
        let mass = density * PI * self.radius * self.radius;
        [mass, mass, 0.5 * mass * self.radius * self.radius]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moment_of_a_disk_is_half_m_r_squared() {
        let [m, n, j] = Disk::new(2.0).unwrap().mass(3.0);
        assert!((m - 12.0 * PI).abs() < 1e-13 && m == n && (j - 2.0 * m).abs() < 1e-12);
    }

    #[test]
    fn a_disk_needs_a_radius() {
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Disk::new(wrong), Err(ShapeError::Length { .. })), "{wrong}");
        }
        let text = Disk::new(-1.0).unwrap_err().to_string();
        assert_eq!(text, "the radius of the disk is -1 m; it must be positive and finite");
    }
}
