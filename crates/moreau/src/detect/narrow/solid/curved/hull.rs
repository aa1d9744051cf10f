//! Bodies with flat faces, segments and single points, as seen in the frame of another.

use super::Convex;
use super::patch::{Corner, MOST, Patch};
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::solid::Pose;
use crate::detect::narrow::vector::{along, dot};
use crate::shape::solid::{Edge, Faceted};
use crate::space::{Solid, Space};

/// Cosine of the angle from which on a face is seen too much from the side to be a patch; an edge is taken then.
const ASLANT: f64 = 0.25;

/// The segment inside a capsule, along z.
pub(in crate::detect::narrow::solid) struct Segment {
    /// Half its length, m.
    pub(in crate::detect::narrow::solid) half: f64,
}

/// The centre of a ball.
pub(in crate::detect::narrow::solid) struct Dot;

impl Faceted for Segment {
    fn vertices(&self) -> usize {
        2
    }

    fn vertex(&self, i: usize) -> [f64; 3] {
        [0.0, 0.0, if i == 0 { -self.half } else { self.half }]
    }

    fn faces(&self) -> usize {
        0
    }

    fn normal(&self, _: usize) -> [f64; 3] {
        [0.0; 3]
    }

    fn face(&self, _: usize) -> &[u16] {
        &[]
    }

    fn edges(&self) -> &[Edge] {
        // Without faces there is none on either side; nobody asks.
        const { &[Edge { ends: [0, 1], faces: [0, 0] }] }
    }

    fn radius(&self) -> f64 {
        self.half
    }

    fn inner(&self) -> f64 {
        0.0
    }
}

impl Faceted for Dot {
    fn vertices(&self) -> usize {
        1
    }

    fn vertex(&self, _: usize) -> [f64; 3] {
        [0.0; 3]
    }

    fn faces(&self) -> usize {
        0
    }

    fn normal(&self, _: usize) -> [f64; 3] {
        [0.0; 3]
    }

    fn face(&self, _: usize) -> &[u16] {
        &[]
    }

    fn edges(&self) -> &[Edge] {
        &[]
    }

    fn radius(&self) -> f64 {
        0.0
    }

    fn inner(&self) -> f64 {
        0.0
    }
}

/// A faceted body and where it is.
#[derive(Clone, Copy)]
pub(in crate::detect::narrow::solid) struct Hull<'a, F> {
    pub(in crate::detect::narrow::solid) body: &'a F,
    pub(in crate::detect::narrow::solid) pose: Pose,
}

impl<'a, F: Faceted> Hull<'a, F> {
    /// A body in its own frame.
    pub(in crate::detect::narrow::solid) fn own(body: &'a F) -> Self {
        Self { body, pose: Pose { position: [0.0; 3], rotation: Solid::IDENTITY } }
    }

    pub(in crate::detect::narrow::solid) fn vertex(&self, i: usize) -> [f64; 3] {
        along(self.pose.position, 1.0, Solid::rotate(self.pose.rotation, self.body.vertex(i)))
    }

    pub(in crate::detect::narrow::solid) fn ends(&self, edge: &Edge) -> [[f64; 3]; 2] {
        edge.ends.map(|end| self.vertex(usize::from(end)))
    }

    /// The outward normal of face `i`, and the height of its plane along it.
    pub(in crate::detect::narrow::solid) fn face(&self, i: usize) -> ([f64; 3], f64) {
        let normal = Solid::rotate(self.pose.rotation, self.body.normal(i));
        let first = self.body.face(i).first().map_or(0, |&vertex| usize::from(vertex));
        // In the body's own frame the plane's height keeps its digits.
        (normal, dot(self.body.normal(i), self.body.vertex(first)) + dot(normal, self.pose.position))
    }

    fn corner(&self, i: u16) -> Corner {
        Corner { at: self.vertex(usize::from(i)), id: u64::from(i) }
    }

    /// Corners of a face, not more than a patch can have.
    fn polygon(&self, face: usize) -> Patch {
        let corners = self.body.face(face);
        let step = corners.len().div_ceil(MOST).max(1);
        Patch::new(corners.iter().step_by(step).map(|&i| self.corner(i)))
    }
}

impl<F: Faceted> Convex for Hull<'_, F> {
    fn height(&self, direction: [f64; 3]) -> f64 {
        let own = Solid::unrotate(self.pose.rotation, direction);
        let highest = (0..self.body.vertices()).map(|i| dot(own, self.body.vertex(i))).fold(f64::NEG_INFINITY, f64::max);
        highest + dot(direction, self.pose.position)
    }

    /// Of the faces at the highest vertex the one that looks along `outward` most, else the edge whose other end is highest.
    fn patch(&self, outward: [f64; 3], level: f64) -> Patch {
        let own = Solid::unrotate(self.pose.rotation, outward);
        let height = |i: usize| dot(own, self.body.vertex(i));
        let highest = (0..self.body.vertices()).map(height).fold(f64::NEG_INFINITY, f64::max);
        let top = (0..self.body.vertices()).find(|&i| height(i) >= highest - level).unwrap_or(0) as u16;
        let mut facing: Option<(usize, f64)> = None;
        for face in (0..self.body.faces()).filter(|&face| self.body.face(face).contains(&top)) {
            let cosine = dot(own, self.body.normal(face));
            if facing.is_none_or(|(_, best)| cosine > best + LEVEL) {
                facing = Some((face, cosine));
            }
        }
        if let Some((face, cosine)) = facing
            && cosine > ASLANT
        {
            let mut patch = self.polygon(face);
            patch.normal = Some(self.face(face).0);
            return patch;
        }
        let mut rising: Option<([u16; 2], f64)> = None;
        for edge in self.body.edges().iter().filter(|edge| edge.ends.contains(&top)) {
            let other = height(usize::from(if edge.ends[0] == top { edge.ends[1] } else { edge.ends[0] }));
            if rising.is_none_or(|(_, best)| other > best + level) {
                rising = Some((edge.ends, other));
            }
        }
        let Some((ends, _)) = rising else { return Patch::new([self.corner(top)].into_iter()) };
        let ends = ends.map(|end| self.corner(end));
        let mut patch = Patch::new(ends.into_iter());
        // What is an edge alone is the axis of a capsule.
        patch.axis = (self.body.faces() == 0).then_some((ends.map(|end| end.at), 0.0));
        patch
    }
}
