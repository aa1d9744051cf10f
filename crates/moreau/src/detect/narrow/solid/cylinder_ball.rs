//! A cylinder and a ball: one point, on the cap, side or rim nearest to the centre of the ball.
//!
//! A centre inside the cylinder leaves by the nearer of side and cap, one on the axis along x of the body.

use super::Pose;
use crate::detect::narrow::vector::{NO_DIRECTION, along, dot, sub};
use crate::shape::solid::{Ball, Cylinder};
use crate::space::{Solid, Space};

pub(super) fn collide(
    (cylinder, pose_a): (&Cylinder, &Pose),
    (ball, pose_b): (&Ball, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let centre = Solid::unrotate(pose_a.rotation, sub(pose_b.position, pose_a.position));
    let (outward, distance) = nearest(cylinder, centre);
    let gap = distance - ball.radius;
    if gap <= reach {
        let normal = Solid::rotate(pose_a.rotation, outward);
        emit(0, along(pose_b.position, -(ball.radius + 0.5 * gap), normal), normal, gap);
    }
}

/// Outward direction to a point in the cylinder's frame, and its distance from the surface (negative inside).
fn nearest(cylinder: &Cylinder, [x, y, z]: [f64; 3]) -> ([f64; 3], f64) {
    let square = x * x + y * y;
    let from_axis = square.sqrt();
    let [u, v] = if square > NO_DIRECTION { [x / from_axis, y / from_axis] } else { [1.0, 0.0] };
    let up = 1.0_f64.copysign(z);
    // Not `max`, which would make a place of what is nowhere.
    let [side, cap] = [from_axis - cylinder.radius, z.abs() - cylinder.half];
    let outside = [side, cap].map(|x| if x < 0.0 { 0.0 } else { x });
    let square = dot(outside, outside);
    if square > NO_DIRECTION {
        let distance = square.sqrt();
        let [radial, axial] = outside.map(|x| x / distance);
        return ([radial * u, radial * v, axial * up], distance);
    }
    if side > cap { ([u, v, 0.0], side) } else { ([0.0, 0.0, up], cap) }
}
