//! A triangle as a body with flat faces: as thin as can be, with a front, a back and three sides.
//!
//! The sides are as wide as their edges and have no height. They are there for the normals: those of the surface at an edge of the
//! triangle turn from the front's over the side's to the back's.

use super::super::facets::Seen;
use crate::detect::narrow::vector::{cross, dot, sub};
use crate::shape::solid::{Edge, Faceted};

pub(in crate::detect::narrow::solid) struct Triangle {
    pub(super) corners: [[f64; 3]; 3],
    /// Its point that is nearest to the middle of the body that it meets.
    pub(super) nearest: [f64; 3],
    /// Of the front, the back, and the sides.
    normals: [[f64; 3]; 5],
    radius: f64,
}

impl Triangle {
    /// The number of the face in front.
    pub(super) const FRONT: usize = 0;

    pub(super) fn new(corners: [[f64; 3]; 3], front: [f64; 3], nearest: [f64; 3]) -> Self {
        let way = |k: usize| sub(corners[(k + 1) % 3], corners[k]);
        let side = |k: usize| {
            let way = way(k);
            let length = dot(way, way).sqrt();
            cross(way, front).map(|x| x / length)
        };
        let longest = (0..3).map(|k| dot(way(k), way(k))).fold(0.0, f64::max);
        Self { corners, nearest, normals: [front, front.map(|x| -x), side(0), side(1), side(2)], radius: longest.sqrt() }
    }

    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    pub(super) fn seen(&self) -> Seen<'_, Self> {
        Seen { body: self, vertices: &self.corners, normals: &self.normals, middle: self.nearest }
    }
}

const FACES: [&[u16]; 5] = [&[0, 1, 2], &[0, 2, 1], &[0, 1], &[1, 2], &[2, 0]];

const fn edge(start: u16, end: u16, left: u16, right: u16) -> Edge {
    Edge { ends: [start, end], faces: [left, right] }
}

/// Each edge between the front and its side, and after it that between the side and the back.
const EDGES: [Edge; 6] =
    [edge(0, 1, 0, 2), edge(1, 0, 1, 2), edge(1, 2, 0, 3), edge(2, 1, 1, 3), edge(2, 0, 0, 4), edge(0, 2, 1, 4)];

impl Faceted for Triangle {
    fn vertices(&self) -> usize {
        3
    }

    #[inline]
    fn vertex(&self, i: usize) -> [f64; 3] {
        self.corners[i]
    }

    fn faces(&self) -> usize {
        5
    }

    #[inline]
    fn normal(&self, i: usize) -> [f64; 3] {
        self.normals[i]
    }

    #[inline]
    fn face(&self, i: usize) -> &[u16] {
        FACES[i]
    }

    #[inline]
    fn edges(&self) -> &[Edge] {
        &EDGES
    }

    /// Its longest edge: a ball of this radius around any of its points holds it.
    fn radius(&self) -> f64 {
        self.radius
    }

    fn inner(&self) -> f64 {
        0.0
    }
}
