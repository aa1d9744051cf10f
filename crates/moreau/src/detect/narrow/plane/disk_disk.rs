//! Two disks: one point, on the line of centres.

use super::Pose;
use crate::detect::narrow::common::two_round;
use crate::shape::plane::Disk;

#[inline]
pub(super) fn collide(
    (a, pose_a): (&Disk, &Pose),
    (b, pose_b): (&Disk, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) {
    two_round((pose_a.position, a.radius), (pose_b.position, b.radius), reach, emit);
}
