//! A cylinder and a capsule: up to two points, where the capsule lies on a cap or along the side.

use super::Pose;
use super::curved::{Segment, tube_with};
use crate::shape::solid::{Capsule, Cylinder};

pub(super) fn collide(
    (cylinder, pose_a): (&Cylinder, &Pose),
    (capsule, pose_b): (&Capsule, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let segment = Segment { half: capsule.half };
    tube_with((cylinder, pose_a), (&segment, pose_b), capsule.radius, reach, emit);
}
