//! A box on a half-space: every corner within reach; the feature is the index of the corner.

use super::Pose;
use crate::detect::narrow::common::corner_on_wall;
use crate::detect::narrow::vector::along;
use crate::shape::solid::{Cuboid, HalfSpace};
use crate::space::{Solid, Space};

pub(super) fn collide(
    (cuboid, pose): (&Cuboid, &Pose),
    (_, wall): (&HalfSpace, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let normal = HalfSpace::normal(wall.rotation);
    for feature in 0..8 {
        let corner = along(pose.position, 1.0, Solid::rotate(pose.rotation, cuboid.corner(feature)));
        corner_on_wall(feature, corner, (wall.position, normal), reach, emit);
    }
}
