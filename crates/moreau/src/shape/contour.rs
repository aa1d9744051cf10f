//! What the surface of a body is like near a point of contact: all that its turning needs to know of it (theory, section 23).

use crate::space::{Pose, Space};

/// Sine of the angle below which two directions count as one.
pub(crate) const SAME: f64 = 1e-6;

/// The surface of a body near a point of contact, as part of something simple. Points and directions are in the frame of the body, or in the
/// world once it is placed; directions are unit vectors, lengths are in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contour<const D: usize> {
    /// A plane (in 2D a line).
    Flat {
        /// A point of it.
        at: [f64; D],
        /// Out of the body.
        outward: [f64; D],
    },
    /// A ball (in 2D a disk); a corner where the radius is zero.
    Ball {
        /// Its centre.
        centre: [f64; D],
        /// Its radius.
        radius: f64,
    },
    /// All within a radius of a straight line; an edge where the radius is zero.
    Line {
        /// A point of the line.
        at: [f64; D],
        /// Along the line.
        way: [f64; D],
        /// The radius.
        radius: f64,
    },
    /// The circular edge of a cap.
    Rim {
        /// Its centre.
        centre: [f64; D],
        /// Across it.
        axis: [f64; D],
        /// Its radius.
        radius: f64,
    },
}

impl<const D: usize> Contour<D> {
    /// The corner at a point.
    pub(crate) fn corner(at: [f64; D]) -> Self {
        Self::Ball { centre: at, radius: 0.0 }
    }

    /// The contour of a body that has this pose, in the world.
    pub(crate) fn placed<S: Space<D, N>, const N: usize>(&self, pose: &Pose<S::Rotation, D>) -> Self {
        let turn = |v: [f64; D]| S::rotate(pose.rotation, v);
        let point = |p: [f64; D]| {
            let p = turn(p);
            std::array::from_fn(|k| pose.position[k] + p[k])
        };
        match *self {
            Self::Flat { at, outward } => Self::Flat { at: point(at), outward: turn(outward) },
            Self::Ball { centre, radius } => Self::Ball { centre: point(centre), radius },
            Self::Line { at, way, radius } => Self::Line { at: point(at), way: turn(way), radius },
            Self::Rim { centre, axis, radius } => Self::Rim { centre: point(centre), axis: turn(axis), radius },
        }
    }
}

/// Whether two unit vectors are one but for rounding.
pub(crate) fn is_same<const D: usize>(a: [f64; D], b: [f64; D]) -> bool {
    (0..D).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>() < SAME * SAME
}
