//! The ball.

use super::revolved::{arc, revolved};
use crate::shape::{Contour, Figure, Polygons, ShapeError, error::length};
use crate::space::Solid;
use std::f64::consts::PI;

/// A ball around its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Radius, m.
    pub radius: f64,
}

impl Ball {
    /// A ball of this radius (m), which must be positive and finite.
    pub fn new(radius: f64) -> Result<Self, ShapeError> {
        Ok(Self { radius: length("the radius of the ball", radius)? })
    }
}

impl Figure<Solid, 3, 6> for Ball {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.radius)
    }

    #[inline]
    fn is_round(&self) -> bool {
        true
    }

    fn contour(&self, _: [f64; 3], _: [f64; 3], _: usize) -> Contour<3> {
        Contour::Ball { centre: [0.0; 3], radius: self.radius }
    }

    fn polygons(&self) -> Polygons<3> {
        revolved(arc(self.radius, 0.0, 0..=12))
    }

    fn mass(&self, density: f64) -> [f64; 6] {
        let square = self.radius * self.radius;
        let mass = density * 4.0 / 3.0 * PI * square * self.radius;
        let moment = 0.4 * mass * square;
        [mass, mass, mass, moment, moment, moment]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moment_of_a_ball_is_two_fifths_m_r_squared() {
        let [m, _, _, i, j, k] = Ball::new(2.0).unwrap().mass(3.0);
        assert!((m - 32.0 * PI).abs() < 1e-12 && (i - 1.6 * m).abs() < 1e-12 && i == j && j == k);
    }

    #[test]
    fn a_ball_needs_a_radius() {
        for wrong in [0.0, -0.5, f64::NAN, f64::INFINITY] {
            assert!(matches!(Ball::new(wrong), Err(ShapeError::Length { .. })), "{wrong}");
        }
    }
}
