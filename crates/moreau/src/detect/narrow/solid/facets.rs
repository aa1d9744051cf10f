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
use axes::{Axis, best};
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
    a: Corners,
    b: Corners,
    points: Points,
    /// The corners of two faces in their common plane.
    flat: [Vec<[f64; 2]>; 2],
    /// On which side of the plane across an edge the normals of the other body's faces are.
    sides: Vec<i8>,
}

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

/// Vertices and normals of a body in the frame of the first.
#[derive(Default)]
struct Corners {
    vertices: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
}

impl Corners {
    fn fill<F: Faceted>(&mut self, body: &F, place: impl Fn([f64; 3]) -> [f64; 3], turn: impl Fn([f64; 3]) -> [f64; 3]) {
        self.vertices.clear();
        self.vertices.extend((0..body.vertices()).map(|i| place(body.vertex(i))));
        self.normals.clear();
        self.normals.extend((0..body.faces()).map(|i| turn(body.normal(i))));
    }
}

/// A body as seen in the frame of the first.
#[derive(Clone, Copy)]
struct Seen<'a, F> {
    body: &'a F,
    vertices: &'a [[f64; 3]],
    normals: &'a [[f64; 3]],
}

impl<'a, F: Faceted> Seen<'a, F> {
    fn new(body: &'a F, Corners { vertices, normals }: &'a Corners) -> Self {
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
    let mut scratch = SCRATCH.take();
    points((a, pose_a), None, (b, pose_b), reach, &mut scratch);
    show(scratch, pose_a, emit);
}

/// The points along the normal of one face of the first body, wherever the bodies are nearest.
pub(super) fn along_face<A: Faceted, B: Faceted>(
    (a, pose_a): (&A, &Pose),
    face: usize,
    (b, pose_b): (&B, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let mut scratch = SCRATCH.take();
    points((a, pose_a), Some(face), (b, pose_b), reach, &mut scratch);
    show(scratch, pose_a, emit);
}

/// Hands over the points in the world, and puts the scratch back.
fn show(scratch: Scratch, pose: &Pose, emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64)) {
    for &Point { feature, at, normal, gap } in scratch.points.all() {
        let middle = Solid::rotate(pose.rotation, along(at, -0.5 * gap, normal));
        emit(feature, along(pose.position, 1.0, middle), Solid::rotate(pose.rotation, normal), gap);
    }
    SCRATCH.set(scratch);
}

/// Leaves the points of contact in the scratch: where the bodies are nearest or, if a face of the first one is given, along its normal.
fn points<A: Faceted, B: Faceted>(
    (a, pose_a): (&A, &Pose),
    face: Option<usize>,
    (b, pose_b): (&B, &Pose),
    reach: f64,
    scratch: &mut Scratch,
) {
    let Scratch { a: corners_a, b: corners_b, points, flat, sides } = scratch;
    points.clear();
    let Pose { position, rotation } = seen_from(pose_a, pose_b);
    let turn = |v| Solid::rotate(rotation, v);
    corners_a.fill(a, |v| v, |n| n);
    corners_b.fill(b, |v| along(position, 1.0, turn(v)), turn);
    let (a, b) = (Seen::new(a, corners_a), Seen::new(b, corners_b));
    let level = LEVEL * (a.body.radius() + b.body.radius());
    if let Some(face) = face {
        overlap(&a, face, &b, true, level, flat, points);
    } else {
        let Some((axis, apart)) = best(&a, &b, position, sides, level, reach) else { return };
        match axis {
            Axis::FaceOfFirst(face) => overlap(&a, face, &b, true, level, flat, points),
            Axis::FaceOfSecond(face) => overlap(&b, face, &a, false, level, flat, points),
            Axis::Edges(point, true) => points.add(point),
            Axis::Edges(_, false) => {}
        }
        let least = points.all().iter().map(|point| point.gap).fold(f64::INFINITY, f64::min);
        // Where the bodies are apart and a face or two edges are nearest, the axis has their distance.
        if least > apart.max(0.0) + level {
            points.clear();
            points.add(nearest(&a, &b, &axis, apart, level));
        }
    }
    points.spread(level, reach);
}
