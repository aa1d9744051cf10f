//! A disk on a half-plane: one point, under the centre.

use super::Pose;
use crate::detect::narrow::common::round_on_wall;
use crate::shape::plane::{Disk, HalfPlane};

#[inline]
pub(super) fn collide(
    (disk, pose): (&Disk, &Pose),
    (_, wall): (&HalfPlane, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) {
    round_on_wall((pose.position, disk.radius), (wall.position, HalfPlane::normal(wall.rotation)), reach, emit);
}
