//! Bodies with flat faces, as seen in some frame.

use super::Pose;
use crate::detect::narrow::vector::{along, dot};
use crate::shape::solid::{Edge, Faceted};
use crate::space::{Solid, Space};

/// Vertices and normals of a body in the frame in which it is seen.
#[derive(Default)]
pub(in crate::detect::narrow::solid) struct Corners {
    vertices: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    middle: [f64; 3],
}

impl Corners {
    /// Those of a body that has its own frame.
    pub(super) fn own(&mut self, body: &impl Faceted) {
        self.vertices.clear();
        self.vertices.extend((0..body.vertices()).map(|i| body.vertex(i)));
        self.normals.clear();
        self.normals.extend((0..body.faces()).map(|i| body.normal(i)));
        self.middle = [0.0; 3];
    }

    /// Those of a body in this place.
    pub(in crate::detect::narrow::solid) fn place(&mut self, body: &impl Faceted, pose: &Pose) {
        self.own(body);
        let turn = |v: &[f64; 3]| Solid::rotate(pose.rotation, *v);
        self.vertices.iter_mut().for_each(|v| *v = along(pose.position, 1.0, turn(v)));
        self.normals.iter_mut().for_each(|n| *n = turn(n));
        self.middle = pose.position;
    }

    pub(in crate::detect::narrow::solid) fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }
}

/// A body as seen in some frame.
#[derive(Clone, Copy)]
pub(in crate::detect::narrow::solid) struct Seen<'a, F> {
    pub(in crate::detect::narrow::solid) body: &'a F,
    pub(in crate::detect::narrow::solid) vertices: &'a [[f64; 3]],
    pub(in crate::detect::narrow::solid) normals: &'a [[f64; 3]],
    /// A point of it, the middle of a ball of radius `inner` inside it.
    pub(in crate::detect::narrow::solid) middle: [f64; 3],
}

impl<'a, F: Faceted> Seen<'a, F> {
    pub(in crate::detect::narrow::solid) fn new(body: &'a F, Corners { vertices, normals, middle }: &'a Corners) -> Self {
        Self { body, vertices, normals, middle: *middle }
    }

    /// The vertex of face `i` and place `k` in it.
    pub(super) fn corner(&self, face: usize, k: usize) -> [f64; 3] {
        self.vertices[usize::from(self.body.face(face)[k])]
    }

    /// Both ends of an edge.
    pub(super) fn ends(&self, edge: &Edge) -> [[f64; 3]; 2] {
        edge.ends.map(|end| self.vertices[usize::from(end)])
    }

    /// The face that faces this direction: of those with the most corners that lie farthest against it, to within `level`, the one whose
    /// normal is most against it. Without the corners it could be a large face beside a tip.
    pub(super) fn facing(&self, direction: [f64; 3], level: f64) -> usize {
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
