//! A ball on a half-space: one point, under the centre.

use super::Pose;
use crate::detect::narrow::common::round_on_wall;
use crate::shape::solid::{Ball, HalfSpace};

#[inline]
pub(super) fn collide(
    (ball, pose): (&Ball, &Pose),
    (_, wall): (&HalfSpace, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    round_on_wall((pose.position, ball.radius), (wall.position, HalfSpace::normal(wall.rotation)), reach, emit);
}
