//! Two balls: one point, on the line of centres.

use super::Pose;
use crate::detect::narrow::common::two_round;
use crate::shape::solid::Ball;

#[inline]
pub(super) fn collide(
    (a, pose_a): (&Ball, &Pose),
    (b, pose_b): (&Ball, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    two_round((pose_a.position, a.radius), (pose_b.position, b.radius), reach, emit);
}
