//! A convex polyhedron on a half-space: the corners of the face that faces it, and what lies deeper; the feature is the index of the corner.
//!
//! The deepest corner need not be one of that face: a long tip that leans stands beside it.

use super::Pose;
use super::facets::{Point, Points};
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::solid::{Faceted, HalfSpace, Polyhedron};
use crate::space::{Solid, Space};
use std::cell::RefCell;

thread_local! {
    /// Kept from pair to pair, so that nothing is allocated anew.
    static POINTS: RefCell<Points> = RefCell::default();
}

pub(super) fn collide(
    (body, pose): (&Polyhedron, &Pose),
    (_, wall): (&HalfSpace, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let outward = HalfSpace::normal(wall.rotation);
    let up = Solid::unrotate(pose.rotation, outward);
    let centre = dot(outward, sub(pose.position, wall.position));
    let height = |i: usize| centre + dot(up, body.vertex(i));
    let level = LEVEL * body.radius();
    let against = |face: usize| dot(up, body.normal(face));
    let facing = (1..body.faces()).fold(0, |best, face| if against(face) < against(best) { face } else { best });
    let corners = body.face(facing);
    let lowest = corners.iter().map(|&i| height(usize::from(i))).fold(f64::INFINITY, f64::min);
    // Not `>`: what is nowhere touches nothing.
    let deeper = |i: usize| height(i) < lowest - level;
    let mut points = POINTS.take();
    points.clear();
    for i in 0..body.vertices() {
        if (corners.contains(&(i as u16)) || deeper(i)) && height(i) <= reach {
            let at = along(pose.position, 1.0, Solid::rotate(pose.rotation, body.vertex(i)));
            points.add(Point { feature: i as u64, at, normal: outward.map(|x| -x), gap: height(i) });
        }
    }
    points.spread(level, reach);
    for &Point { feature, at, normal, gap } in points.all() {
        emit(feature, along(at, 0.5 * gap, normal), normal, gap);
    }
    POINTS.set(points);
}
