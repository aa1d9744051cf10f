//! A box and a ball: one point, on the face, edge or corner nearest to the centre of the ball.
//!
//! A centre inside the box leaves by the nearest face; one exactly on the surface takes the normal of its face, so that the gap
//! is continuous through the surface and no direction is drawn from a zero.

use super::Pose;
use crate::detect::narrow::vector::{NO_DIRECTION, along, dot, sub};
use crate::shape::solid::{Ball, Cuboid};
use crate::space::{Solid, Space};

pub(super) fn collide(
    (cuboid, pose_a): (&Cuboid, &Pose),
    (ball, pose_b): (&Ball, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let centre = Solid::unrotate(pose_a.rotation, sub(pose_b.position, pose_a.position));
    let (outward, distance) = nearest(cuboid.half, centre);
    let gap = distance - ball.radius;
    if gap <= reach {
        let normal = Solid::rotate(pose_a.rotation, outward);
        emit(0, along(pose_b.position, -(ball.radius + 0.5 * gap), normal), normal, gap);
    }
}

/// Outward direction to a point in the box's frame, and its distance from the surface (negative inside).
fn nearest(half: [f64; 3], point: [f64; 3]) -> ([f64; 3], f64) {
    // Not `clamp`, which panics on a NaN bound.
    let outside: [f64; 3] = std::array::from_fn(|k| point[k] - point[k].min(half[k]).max(-half[k]));
    let square = dot(outside, outside);
    if square > NO_DIRECTION {
        let distance = square.sqrt();
        return (outside.map(|x| x / distance), distance);
    }
    let depth: [f64; 3] = std::array::from_fn(|k| half[k] - point[k].abs());
    let axis = (1..3).fold(0, |best, k| if depth[k] < depth[best] { k } else { best });
    let mut outward = [0.0; 3];
    outward[axis] = 1.0_f64.copysign(point[axis]);
    (outward, -depth[axis])
}
