//! A polygon and a disk: one point, on the side or vertex nearest to the centre of the disk.
//!
//! The side that the centre is farthest outside of either holds the nearest point or ends in it: beyond a vertex the normals of
//! its two sides are closer to the direction of the centre than any other. Where the centre is inside, the same side is the
//! nearest way out. A centre on the boundary takes the normal of the side, so that no direction is drawn from rounding.

use super::Pose;
use crate::detect::narrow::vector::{NO_DIRECTION, along, dot, sub};
use crate::shape::plane::{Disk, Polygon, Side};
use crate::space::{Plane, Space};

pub(super) fn collide(
    (polygon, pose_a): (&Polygon, &Pose),
    (disk, pose_b): (&Disk, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) {
    let centre = Plane::unrotate(pose_a.rotation, sub(pose_b.position, pose_a.position));
    let (outward, distance) = nearest(polygon, centre);
    let gap = distance - disk.radius;
    if gap <= reach {
        let normal = Plane::rotate(pose_a.rotation, outward);
        emit(0, along(pose_b.position, -(disk.radius + 0.5 * gap), normal), normal, gap);
    }
}

/// Outward direction to a point in the polygon's frame, and its distance from the boundary (negative inside).
fn nearest(polygon: &Polygon, point: [f64; 2]) -> ([f64; 2], f64) {
    let height = |side: &Side| dot(side.normal, sub(point, side.start));
    let mut side = &polygon.sides()[0];
    let mut farthest = height(side);
    for candidate in &polygon.sides()[1..] {
        let distance = height(candidate);
        if distance > farthest {
            (farthest, side) = (distance, candidate);
        }
    }
    if farthest > 0.0 {
        let edge = sub(side.end, side.start);
        for (vertex, way) in [(side.start, -1.0), (side.end, 1.0)] {
            let from_vertex = sub(point, vertex);
            let square = dot(from_vertex, from_vertex);
            if way * dot(edge, from_vertex) > 0.0 && square > NO_DIRECTION {
                let distance = square.sqrt();
                return (from_vertex.map(|x| x / distance), distance);
            }
        }
    }
    (side.normal, farthest)
}
