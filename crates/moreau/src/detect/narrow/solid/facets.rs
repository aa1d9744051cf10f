//! Two convex bodies with flat faces: where they touch face to face up to four points, edge to edge one.
//!
//! The axis that separates them best, or along which they overlap least, is the normal of a face or the cross product of two edges
//! whose arcs on the sphere of normals meet (Gottschalk, Lin & Manocha 1996; Gregorius 2013). Of a face, the points are the corners of what it shares with the
//! face opposite, seen along the normal (`overlap`). Bodies that are apart where no face is, at two vertices or at a vertex and an edge, have the
//! point between these (`nearest`).
//!
//! A point's feature says which vertices or edges make it, not which face was the reference, so features of bodies at rest stay as they are.

mod axes;
mod nearest;
mod overlap;

use super::Pose;
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::solid::Faceted;
use crate::space::{Solid, Space};
use axes::{Axis, best};
use nearest::nearest;
use overlap::{Points, overlap};

/// What makes a point, by its kind: 0 a vertex of the first body, 1 one of the second, 2 an edge of each by their numbers, 3 one of each by the
/// vertices at which their faces' sides begin, or two vertices.
fn feature(kind: u64, a: usize, b: usize) -> u64 {
    kind << 30 | (a as u64) << 15 | b as u64
}

/// A point of contact in the frame of the first body, on the surface of the second; the normal points from the first to the second.
#[derive(Clone, Copy, Debug)]
struct Point {
    feature: u64,
    at: [f64; 3],
    normal: [f64; 3],
    gap: f64,
}

/// A body as seen in the frame of another.
#[derive(Clone, Copy)]
struct Seen<'a, F> {
    body: &'a F,
    pose: Pose,
}

impl<'a, F: Faceted> Seen<'a, F> {
    fn own(body: &'a F) -> Self {
        Self { body, pose: Pose { position: [0.0; 3], rotation: Solid::IDENTITY } }
    }

    fn vertex(&self, i: usize) -> [f64; 3] {
        along(self.pose.position, 1.0, Solid::rotate(self.pose.rotation, self.body.vertex(i)))
    }

    fn normal(&self, i: usize) -> [f64; 3] {
        Solid::rotate(self.pose.rotation, self.body.normal(i))
    }

    /// The vertex of face `i` and place `k` in it.
    fn corner(&self, face: usize, k: usize) -> [f64; 3] {
        self.vertex(usize::from(self.body.face(face)[k]))
    }

    /// The face whose normal is most against this direction.
    fn facing(&self, direction: [f64; 3]) -> usize {
        let inward = Solid::unrotate(self.pose.rotation, direction);
        let against = |i: usize| dot(inward, self.body.normal(i));
        (1..self.body.faces()).fold(0, |best, i| if against(i) < against(best) { i } else { best })
    }
}

pub(super) fn collide<A: Faceted, B: Faceted>(
    (a, pose_a): (&A, &Pose),
    (b, pose_b): (&B, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let position = Solid::unrotate(pose_a.rotation, sub(pose_b.position, pose_a.position));
    let (a, b) =
        (Seen::own(a), Seen { body: b, pose: Pose { position, rotation: pose_a.rotation.conjugate() * pose_b.rotation } });
    let level = LEVEL * (a.body.radius() + b.body.radius());
    let Some((axis, apart)) = best(&a, &b, level, reach) else { return };
    let mut points = Points::default();
    match axis {
        Axis::FaceOfFirst(face) => overlap(&a, face, &b, true, level, &mut points),
        Axis::FaceOfSecond(face) => overlap(&b, face, &a, false, level, &mut points),
        Axis::Edges(point, true) => points.add(point),
        Axis::Edges(_, false) => {}
    }
    let least = points.all().iter().map(|point| point.gap).fold(f64::INFINITY, f64::min);
    // Where the bodies are apart and a face or two edges are nearest, the axis has their distance.
    if least > apart.max(0.0) + level {
        points = Points::default();
        points.add(nearest(&a, &b, &axis, apart, level));
    }
    points.spread(level, reach);
    for &Point { feature, at, normal, gap } in points.all() {
        let middle = Solid::rotate(pose_a.rotation, along(at, -0.5 * gap, normal));
        emit(feature, along(pose_a.position, 1.0, middle), Solid::rotate(pose_a.rotation, normal), gap);
    }
}
