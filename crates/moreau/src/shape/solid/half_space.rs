//! The half-space.

use crate::shape::{Contour, Figure};
use crate::space::{Solid, Space};

/// All that lies below a plane. The body's position is a point of the plane, the outward normal is the body's z axis. It has no
/// end, so its mass is infinite and it must be driven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HalfSpace;

impl HalfSpace {
    /// The outward unit normal in the world.
    #[inline]
    pub fn normal(rotation: <Solid as Space<3, 6>>::Rotation) -> [f64; 3] {
        Solid::rotate(rotation, [0.0, 0.0, 1.0])
    }
}

impl Figure<Solid, 3, 6> for HalfSpace {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        None
    }

    fn bounding_normal(&self, rotation: <Solid as Space<3, 6>>::Rotation) -> Option<[f64; 3]> {
        Some(Self::normal(rotation))
    }

    fn contour(&self, at: [f64; 3], outward: [f64; 3], _: usize) -> Contour<3> {
        Contour::Flat { at, outward }
    }

    fn mass(&self, _: f64) -> [f64; 6] {
        [f64::INFINITY; 6]
    }
}
