//! A capsule and a disk: one point, between the centre of the disk and the nearest point of the capsule's segment.

use super::Pose;
use crate::detect::narrow::vector::{NO_DIRECTION, along, dot, sub};
use crate::shape::plane::{Capsule, Disk};
use crate::space::{Plane, Space};

pub(super) fn collide(
    (capsule, pose_a): (&Capsule, &Pose),
    (disk, pose_b): (&Disk, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) {
    let half = 0.5 * capsule.length();
    let centre = Plane::unrotate(pose_a.rotation, sub(pose_b.position, pose_a.position));
    let between = [centre[0] - centre[0].clamp(-half, half), centre[1]];
    let square = dot(between, between);
    let distance = square.sqrt();
    let gap = distance - (capsule.radius() + disk.radius);
    if gap <= reach {
        // A centre on the segment leaves by the capsule's side.
        let outward = if square > NO_DIRECTION { between.map(|x| x / distance) } else { [0.0, 1.0] };
        let normal = Plane::rotate(pose_a.rotation, outward);
        emit(0, along(pose_b.position, -(disk.radius + 0.5 * gap), normal), normal, gap);
    }
}
