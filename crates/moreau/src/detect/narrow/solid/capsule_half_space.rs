//! A capsule on a half-space: the points under both ends of its segment, as far as they are within reach.

use super::Pose;
use crate::detect::narrow::common::round_on_wall;
use crate::detect::narrow::vector::along;
use crate::shape::solid::{Capsule, HalfSpace};
use crate::space::{Solid, Space};

pub(super) fn collide(
    (capsule, pose): (&Capsule, &Pose),
    (_, wall): (&HalfSpace, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let boundary = (wall.position, HalfSpace::normal(wall.rotation));
    for end in 0..2 {
        let centre = along(pose.position, 1.0, Solid::rotate(pose.rotation, capsule.end(end)));
        let mut one = |_, point, normal, gap| emit(end as u64, point, normal, gap);
        round_on_wall((centre, capsule.radius), boundary, reach, &mut one);
    }
}
