//! A cylinder, as seen in the frame of another body.

use super::Convex;
use super::patch::{Corner, Disc, Patch};
use super::rim::Rim;
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::solid::Pose;
use crate::detect::narrow::vector::{along, dot};
use crate::shape::solid::Cylinder;
use crate::space::{Solid, Space};
use std::f64::consts::FRAC_1_SQRT_2;

/// The directions of the points of a rim that are fixed in the body, around its axis.
pub(super) const FIXED: [[f64; 2]; 8] = [
    [1.0, 0.0],
    [FRAC_1_SQRT_2, FRAC_1_SQRT_2],
    [0.0, 1.0],
    [-FRAC_1_SQRT_2, FRAC_1_SQRT_2],
    [-1.0, 0.0],
    [-FRAC_1_SQRT_2, -FRAC_1_SQRT_2],
    [0.0, -1.0],
    [FRAC_1_SQRT_2, -FRAC_1_SQRT_2],
];

/// A cylinder and where it is.
#[derive(Clone, Copy)]
pub(in crate::detect::narrow::solid) struct Tube {
    pub(in crate::detect::narrow::solid) centre: [f64; 3],
    /// Of the body: right-handed and orthonormal, the third one along the cylinder's axis.
    pub(in crate::detect::narrow::solid) axes: [[f64; 3]; 3],
    pub(in crate::detect::narrow::solid) radius: f64,
    pub(in crate::detect::narrow::solid) half: f64,
}

impl Tube {
    pub(in crate::detect::narrow::solid) fn new(cylinder: &Cylinder, pose: &Pose) -> Self {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| Solid::rotate(pose.rotation, axis));
        Self { centre: pose.position, axes, radius: cylinder.radius, half: cylinder.half }
    }

    /// A cylinder in its own frame.
    pub(in crate::detect::narrow::solid) fn own(cylinder: &Cylinder) -> Self {
        Self::new(cylinder, &Pose { position: [0.0; 3], rotation: Solid::IDENTITY })
    }

    pub(in crate::detect::narrow::solid) fn axis(&self) -> [f64; 3] {
        self.axes[2]
    }

    /// The rims of the lower and the upper cap.
    pub(in crate::detect::narrow::solid) fn rims(&self) -> [Rim; 2] {
        let [x, y, z] = self.axes;
        [(-1.0, [y, x]), (1.0, [x, y])].map(|(side, tangents)| Rim {
            centre: along(self.centre, side * self.half, z),
            outward: z.map(|k| side * k),
            tangents,
            radius: self.radius,
        })
    }

    /// The corner of a rim in a direction around the axis.
    fn on(&self, rim: &Rim, [x, y]: [f64; 2], id: usize) -> Corner {
        let at = along(along(rim.centre, self.radius * x, self.axes[0]), self.radius * y, self.axes[1]);
        Corner { at, id: id as u64 }
    }
}

impl Convex for Tube {
    fn height(&self, direction: [f64; 3]) -> f64 {
        let [x, y, z] = self.axes.map(|axis| dot(axis, direction));
        dot(direction, self.centre) + self.radius * (x * x + y * y).sqrt() + self.half * z.abs()
    }

    /// A cap or, where this lies flatter, the line along the side. The corner at which they meet has the number of its rim in both.
    fn patch(&self, outward: [f64; 3], _: f64) -> Patch {
        let [x, y, z] = self.axes.map(|axis| dot(axis, outward));
        let tilt = (x * x + y * y).sqrt();
        let highest = [x / tilt, y / tilt];
        let rims = self.rims();
        if self.half * z.abs() < self.radius * tilt {
            let mut line = Patch::new((0..2).map(|side| self.on(&rims[side], highest, side)));
            line.axis = Some((rims.map(|rim| rim.centre), self.radius));
            return line;
        }
        let side = usize::from(z > 0.0);
        let fixed = |k: usize| self.on(&rims[side], FIXED[k], 2 + 8 * side + k);
        let mut cap = if tilt > LEVEL {
            let along = |k: usize| dot(FIXED[k], highest);
            let nearest = (1..8).fold(0, |best, k| if along(k) > along(best) + LEVEL { k } else { best });
            Patch::new((0..8).map(|k| if k == nearest { self.on(&rims[side], highest, side) } else { fixed(k) }))
        } else {
            Patch::new((0..8).map(fixed))
        };
        cap.normal = Some(self.axes[2]);
        cap.disc = Some(Disc { centre: rims[side].centre, axes: self.axes, radius: self.radius });
        cap
    }
}
