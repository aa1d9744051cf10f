//! Two convex bodies with flat faces: where they touch face to face up to four points, edge to edge one.
//!
//! The axis that separates them best, or along which they overlap least, is the normal of a face or the cross product of two edges
//! whose arcs on the sphere of normals meet (Gottschalk, Lin & Manocha 1996; Gregorius 2013). Of a face, the points are the corners of what it shares with the
//! face opposite, seen along the normal (`overlap`). Bodies that are apart where no face is, at two vertices or at a vertex and an edge, have the
//! point between these (`nearest`).
//!
//! A point's feature says which vertices or edges make it, not which face was the reference, so features of bodies at rest stay as they are.

mod axes;
mod bounds;
mod nearest;
mod overlap;
mod points;
mod seen;

use super::Pose;
use super::curved::seen_from;
use crate::detect::narrow::common::{CLOSE, LEVEL, SAME};
use crate::detect::narrow::vector::{along, dot};
use crate::shape::solid::Faceted;
use crate::space::{Solid, Space};
pub(super) use axes::support;
use axes::{are_beyond, edges, faces};
use bounds::Bounds;
use nearest::nearest;
use overlap::overlap;
pub(super) use points::Points;
pub(super) use seen::{Corners, Seen};
use std::cell::RefCell;

/// What makes a point, by its kind: 0 a vertex of the first body, 1 one of the second, 2 an edge of each by their numbers, 3 one of each by the
/// vertices at which their faces' sides begin, or two vertices.
fn feature(kind: u64, a: usize, b: usize) -> u64 {
    kind << 30 | (a as u64) << 15 | b as u64
}

/// A point of contact in the frame of the first body, on the surface of the second; the normal points from the first to the second.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) feature: u64,
    pub(super) at: [f64; 3],
    pub(super) normal: [f64; 3],
    pub(super) gap: f64,
}

/// What a pair is computed in; each thread keeps its own from pair to pair, so that nothing is allocated anew.
#[derive(Default)]
struct Scratch {
    points: Points,
    /// The corners of two faces in their common plane.
    flat: [Vec<[f64; 2]>; 2],
    bounds: Bounds,
}

thread_local! {
    static CORNERS: RefCell<[Corners; 2]> = RefCell::default();
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

pub(super) fn collide<A: Faceted, B: Faceted>(
    (a, pose_a): (&A, &Pose),
    (b, pose_b): (&B, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let there = seen_from(pose_a, pose_b);
    let mut corners = CORNERS.take();
    corners[0].own(a);
    corners[1].place(b, &there);
    let (a, b) = (Seen::new(a, &corners[0]), Seen::new(b, &corners[1]));
    if !are_beyond(&a, &b, there.position, reach) {
        points(&a, None, &b, reach, &mut |feature, middle, normal, gap| {
            let middle = along(pose_a.position, 1.0, Solid::rotate(pose_a.rotation, middle));
            emit(feature, middle, Solid::rotate(pose_a.rotation, normal), gap);
        });
    }
    CORNERS.set(corners);
}

/// Hands over the points of contact of two bodies in the frame in which both are seen: where they are nearest or, if a face of the first one is
/// given, along its normal.
pub(super) fn points<A: Faceted, B: Faceted>(
    a: &Seen<'_, A>,
    face: Option<usize>,
    b: &Seen<'_, B>,
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let mut scratch = SCRATCH.take();
    scratch.points.clear();
    match face {
        Some(face) => scratch.along(a, face, b),
        None => scratch.nearest(a, b, reach),
    }
    scratch.points.spread(level(a, b), reach);
    for &Point { feature, at, normal, gap } in scratch.points.all() {
        emit(feature, along(at, -0.5 * gap, normal), normal, gap);
    }
    SCRATCH.set(scratch);
}

/// What rounding may do to lengths of two bodies, m.
fn level<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>) -> f64 {
    LEVEL * (a.body.radius() + b.body.radius())
}

impl Scratch {
    /// The points along the normal of a face of the first body.
    fn along<A: Faceted, B: Faceted>(&mut self, a: &Seen<'_, A>, face: usize, b: &Seen<'_, B>) {
        overlap(a, face, b, true, level(a, b), &mut self.flat, &mut self.points);
    }

    /// The points where the bodies are nearest. Of axes that are as good as each other faces come before edges.
    fn nearest<A: Faceted, B: Faceted>(&mut self, a: &Seen<'_, A>, b: &Seen<'_, B>, reach: f64) {
        let level = level(a, b);
        let Some(face) = faces(a, b, level, reach) else { return };
        let (mut normal, mut apart) = if face.of_first {
            self.along(a, face.number, b);
            (a.normals[face.number], face.apart)
        } else {
            overlap(b, face.number, a, false, level, &mut self.flat, &mut self.points);
            (b.normals[face.number].map(|x| -x), face.apart)
        };
        // Where the bodies are apart and a face or two edges are nearest, the axis has their distance, and no other has more.
        if apart > 0.0 && self.least() <= apart + level {
            return;
        }
        if let Some((point, within)) = edges(a, b, apart, level, &mut self.bounds)
            && point.gap > apart + level
        {
            let same = dot(point.normal, normal) > 1.0 - SAME && point.gap.abs() <= CLOSE * level;
            if same && self.least() <= point.gap + level {
                return;
            }
            (normal, apart) = (point.normal, point.gap);
            self.points.clear();
            if apart > reach {
                return;
            }
            if within {
                self.points.add(point);
            }
        }
        if self.least() > apart.max(0.0) + level {
            let point = nearest(a, b, (normal, apart), level);
            if point.gap < self.least() {
                self.points.clear();
                self.points.add(point);
            }
        }
    }

    /// The least gap of the points.
    fn least(&self) -> f64 {
        self.points.all().iter().map(|point| point.gap).fold(f64::INFINITY, f64::min)
    }
}
