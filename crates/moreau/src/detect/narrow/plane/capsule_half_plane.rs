//! A capsule on a half-plane: each end within reach; the feature is the end.

use super::Pose;
use crate::detect::narrow::common::round_on_wall;
use crate::detect::narrow::vector::along;
use crate::shape::plane::{Capsule, HalfPlane};
use crate::space::{Plane, Space};

pub(super) fn collide(
    (capsule, pose): (&Capsule, &Pose),
    (_, wall): (&HalfPlane, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) {
    let boundary = (wall.position, HalfPlane::normal(wall.rotation));
    for (feature, end) in (0..).zip(capsule.ends()) {
        let centre = along(pose.position, 1.0, Plane::rotate(pose.rotation, end));
        round_on_wall((centre, capsule.radius()), boundary, reach, &mut |_, point, normal, gap| {
            emit(feature, point, normal, gap);
        });
    }
}
