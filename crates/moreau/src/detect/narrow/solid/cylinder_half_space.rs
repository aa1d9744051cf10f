//! A cylinder on a half-space: up to four points of a cap's rim, or the ends of the line along its side.

use super::Pose;
use super::curved::{Convex, Point, Points, Touch, Tube, feature};
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::solid::{Cylinder, HalfSpace};

pub(super) fn collide(
    (cylinder, pose): (&Cylinder, &Pose),
    (_, wall): (&HalfSpace, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let tube = Tube::new(cylinder, pose);
    let outward = HalfSpace::normal(wall.rotation);
    let normal = outward.map(|x| -x);
    let level = LEVEL * (cylinder.radius + cylinder.half);
    let mut points = Points::new(f64::NEG_INFINITY, &Touch { radii: [0.0; 2], level, reach });
    for corner in tube.patch(normal, level).corners() {
        let gap = dot(outward, sub(corner.at, wall.position));
        points.add(Point { feature: feature(0, corner.id, 0), at: along(corner.at, -0.5 * gap, outward), normal, gap });
    }
    // Chosen among in the cylinder's own axes, in which the points stay.
    points.spread_between([tube.axes[0], tube.axes[1]]);
    for &Point { feature, at, normal, gap } in points.all() {
        emit(feature, at, normal, gap);
    }
}
