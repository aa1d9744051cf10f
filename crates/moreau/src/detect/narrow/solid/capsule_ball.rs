//! A capsule and a ball: one point, on the way from the nearest point of the capsule's segment to the centre of the ball.

use super::Pose;
use crate::detect::narrow::common::two_round;
use crate::detect::narrow::vector::{along, sub};
use crate::shape::solid::{Ball, Capsule};
use crate::space::{Solid, Space};

pub(super) fn collide(
    (capsule, pose_a): (&Capsule, &Pose),
    (ball, pose_b): (&Ball, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let [_, _, z] = Solid::unrotate(pose_a.rotation, sub(pose_b.position, pose_a.position));
    // Not `clamp`, which panics on a NaN bound.
    let nearest = [0.0, 0.0, z.min(capsule.half).max(-capsule.half)];
    let nearest = along(pose_a.position, 1.0, Solid::rotate(pose_a.rotation, nearest));
    two_round((nearest, capsule.radius), (pose_b.position, ball.radius), reach, emit);
}
