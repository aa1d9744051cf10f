//! A polygon on a half-plane: every vertex within reach; the feature is the index of the vertex.

use super::Pose;
use crate::detect::narrow::common::corner_on_wall;
use crate::detect::narrow::vector::along;
use crate::shape::plane::{HalfPlane, Polygon};
use crate::space::{Plane, Space};

pub(super) fn collide(
    (polygon, pose): (&Polygon, &Pose),
    (_, wall): (&HalfPlane, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) {
    let normal = HalfPlane::normal(wall.rotation);
    for (feature, vertex) in (0..).zip(polygon.vertices()) {
        let corner = along(pose.position, 1.0, Plane::rotate(pose.rotation, vertex));
        corner_on_wall(feature, corner, (wall.position, normal), reach, emit);
    }
}
