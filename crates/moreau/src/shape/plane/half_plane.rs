//! The half-plane.

use crate::shape::{Contour, Figure};
use crate::space::{Plane, Space};

/// All that lies below a line. The body's position is a point of the line, the outward normal is the body's y axis. It has no
/// end, so its mass is infinite and it must be driven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HalfPlane;

impl HalfPlane {
    /// The outward unit normal in the world.
    #[inline]
    pub fn normal(rotation: <Plane as Space<2, 3>>::Rotation) -> [f64; 2] {
        Plane::rotate(rotation, [0.0, 1.0])
    }
}

impl Figure<Plane, 2, 3> for HalfPlane {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        None
    }

    fn bounding_normal(&self, rotation: <Plane as Space<2, 3>>::Rotation) -> Option<[f64; 2]> {
        Some(Self::normal(rotation))
    }

    fn contour(&self, at: [f64; 2], outward: [f64; 2], _: usize) -> Contour<2> {
        Contour::Flat { at, outward }
    }

    fn mass(&self, _: f64) -> [f64; 3] {
        [f64::INFINITY; 3]
    }
}
