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
mod points;

use super::Pose;
use super::curved::seen_from;
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::vector::{along, dot};
use crate::shape::solid::{Edge, Faceted};
use crate::space::{Solid, Space};
use axes::{Axis, Crossing, are_beyond, best};
use nearest::nearest;
use overlap::overlap;
pub(super) use points::Points;
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
    crossing: Crossing,
}

thread_local! {
    static CORNERS: RefCell<[Corners; 2]> = RefCell::default();
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

/// Vertices and normals of a body in the frame in which it is seen.
#[derive(Default)]
pub(super) struct Corners {
    vertices: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
}

impl Corners {
    /// Those of a body that has its own frame.
    fn own(&mut self, body: &impl Faceted) {
        self.vertices.clear();
        self.vertices.extend((0..body.vertices()).map(|i| body.vertex(i)));
        self.normals.clear();
        self.normals.extend((0..body.faces()).map(|i| body.normal(i)));
    }

    /// Those of a body in this place.
    pub(super) fn place(&mut self, body: &impl Faceted, pose: &Pose) {
        self.own(body);
        let turn = |v: &[f64; 3]| Solid::rotate(pose.rotation, *v);
        self.vertices.iter_mut().for_each(|v| *v = along(pose.position, 1.0, turn(v)));
        self.normals.iter_mut().for_each(|n| *n = turn(n));
    }

    pub(super) fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }
}

/// A body as seen in some frame.
#[derive(Clone, Copy)]
pub(super) struct Seen<'a, F> {
    pub(super) body: &'a F,
    pub(super) vertices: &'a [[f64; 3]],
    pub(super) normals: &'a [[f64; 3]],
}

impl<'a, F: Faceted> Seen<'a, F> {
    pub(super) fn new(body: &'a F, Corners { vertices, normals }: &'a Corners) -> Self {
        Self { body, vertices, normals }
    }

    /// The vertex of face `i` and place `k` in it.
    fn corner(&self, face: usize, k: usize) -> [f64; 3] {
        self.vertices[usize::from(self.body.face(face)[k])]
    }

    /// Both ends of an edge.
    fn ends(&self, edge: &Edge) -> [[f64; 3]; 2] {
        edge.ends.map(|end| self.vertices[usize::from(end)])
    }

    /// The face that faces this direction: of those with the most corners that lie farthest against it, to within `level`, the one whose
    /// normal is most against it. Without the corners it could be a large face beside a tip.
    fn facing(&self, direction: [f64; 3], level: f64) -> usize {
        let height = |i: usize| dot(direction, self.vertices[i]);
        let lowest = (0..self.vertices.len()).map(height).fold(f64::INFINITY, f64::min) + level;
        let count = |face: usize| self.body.face(face).iter().filter(|&&i| height(usize::from(i)) <= lowest).count();
        let against = |face: usize| dot(direction, self.normals[face]);
        let first = (0, count(0), against(0));
        let better = |best: (usize, usize, f64), face: usize| {
            let next = (face, count(face), against(face));
            if next.1 > best.1 || (next.1 == best.1 && next.2 < best.2) { next } else { best }
        };
        (1..self.normals.len()).fold(first, better).0
    }
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

    /// The points where the bodies are nearest.
    fn nearest<A: Faceted, B: Faceted>(&mut self, a: &Seen<'_, A>, b: &Seen<'_, B>, reach: f64) {
        let level = level(a, b);
        let Some((axis, apart)) = best(a, b, &mut self.crossing, level, reach) else { return };
        match axis {
            Axis::FaceOfFirst(face) => self.along(a, face, b),
            Axis::FaceOfSecond(face) => overlap(b, face, a, false, level, &mut self.flat, &mut self.points),
            Axis::Edges(point, true) => self.points.add(point),
            Axis::Edges(_, false) => {}
        }
        let least = self.points.all().iter().map(|point| point.gap).fold(f64::INFINITY, f64::min);
        // Where the bodies are apart and a face or two edges are nearest, the axis has their distance.
        if least > apart.max(0.0) + level {
            self.points.clear();
            self.points.add(nearest(a, b, &axis, apart, level));
        }
    }
}
