//! The direction along which two bodies are farthest apart, or overlap least.

use super::{Convex, Touch, unit};
use crate::detect::narrow::vector::{dot, sub};

use crate::detect::narrow::common::SAME;

/// A direction from the first body to the second.
#[derive(Clone, Copy)]
pub(super) struct Direction {
    pub(super) normal: [f64; 3],
    /// How far the bodies are apart along it, m; negative where they overlap.
    pub(super) apart: f64,
    /// A point of each body that are so far apart, where the direction comes from two points.
    pub(super) pair: Option<[[f64; 3]; 2]>,
}

/// The best of the directions tried so far.
pub(in crate::detect::narrow::solid) struct Best<'a, A, B> {
    pub(super) a: &'a A,
    pub(super) b: &'a B,
    pub(super) level: f64,
    /// The first of those that are as good as the best. Bodies that touch or overlap can have several; there is only one for those
    /// that are apart.
    pub(super) first: Direction,
    pub(super) best: Direction,
    /// The first of the normals of faces that are as good as each other.
    face: Direction,
}

impl<'a, A: Convex, B: Convex> Best<'a, A, B> {
    pub(in crate::detect::narrow::solid) fn new(a: &'a A, b: &'a B, level: f64) -> Self {
        let nothing = Direction { normal: [0.0, 0.0, 1.0], apart: f64::NEG_INFINITY, pair: None };
        Self { a, b, level, first: nothing, best: nothing, face: nothing }
    }

    /// Whether the bodies are too far apart along the best direction, or nowhere.
    pub(in crate::detect::narrow::solid) fn is_beyond(&self, touch: &Touch) -> bool {
        touch.is_beyond(self.best.apart)
    }

    /// Tries a unit vector along which the bodies are apart by so much.
    fn take(&mut self, normal: [f64; 3], apart: f64, pair: Option<[[f64; 3]; 2]>) {
        let slack = if self.first.apart <= self.level { self.level } else { 0.0 };
        if apart > self.first.apart + slack {
            self.first = Direction { normal, apart, pair };
        }
        if apart > self.best.apart {
            self.best = Direction { normal, apart, pair };
        }
    }

    /// Tries the normal of a face, into the second body, along which the bodies are apart by so much.
    pub(super) fn take_face(&mut self, normal: [f64; 3], apart: f64) {
        self.take(normal, apart, None);
        if apart > self.face.apart + self.level {
            self.face = Direction { normal, apart, pair: None };
        }
    }

    /// The normal of a face, where the best direction is not that of a face but nearly so.
    pub(super) fn face_beside(&self) -> Option<&Direction> {
        let beside = self.first.apart > self.face.apart && dot(self.first.normal, self.face.normal) > 1.0 - SAME;
        beside.then_some(&self.face)
    }

    /// Tries both caps of a cylinder with this axis.
    pub(in crate::detect::narrow::solid) fn offer_caps(&mut self, axis: [f64; 3]) {
        for normal in [axis, axis.map(|x| -x)] {
            self.take_face(normal, self.apart(normal));
        }
    }

    fn apart(&self, normal: [f64; 3]) -> f64 {
        -self.b.height(normal.map(|x| -x)) - self.a.height(normal)
    }

    /// Tries a unit vector.
    pub(in crate::detect::narrow::solid) fn offer(&mut self, normal: [f64; 3]) {
        self.take(normal, self.apart(normal), None);
    }

    /// Tries the direction of a vector of any length and its opposite, unless it has none.
    pub(in crate::detect::narrow::solid) fn offer_both_ways(&mut self, way: [f64; 3]) {
        if let Some(normal) = unit(way) {
            self.offer(normal);
            self.offer(normal.map(|x| -x));
        }
    }

    /// Tries a unit vector and its opposite, of bodies that have these points beside each other.
    pub(super) fn offer_beside(&mut self, normal: [f64; 3], pair: [[f64; 3]; 2]) {
        for normal in [normal, normal.map(|x| -x)] {
            self.take(normal, self.apart(normal), Some(pair));
        }
    }

    /// Tries the direction from a point of the first body to one of the second: no direction has them farther apart than these points.
    pub(super) fn offer_between(&mut self, [on_a, on_b]: [[f64; 3]; 2]) {
        let way = sub(on_b, on_a);
        let best = self.best.apart;
        if best < 0.0 || dot(way, way) > best * best {
            unit(way).into_iter().for_each(|normal| self.take_pair(normal, [on_a, on_b]));
        }
    }

    /// Tries what is across two edges, both ways, which has two of their points nearest. Of edges that are nearly parallel it has few
    /// digits, so it has to be better than what was tried before, more than by rounding.
    pub(in crate::detect::narrow::solid) fn offer_across(&mut self, across: [f64; 3], [on_a, on_b]: [[f64; 3]; 2]) {
        let Some(normal) = unit(across) else { return };
        for normal in [normal, normal.map(|x| -x)] {
            if dot(normal, sub(on_b, on_a)) > self.best.apart + 1e-3 * self.level {
                self.take_pair(normal, [on_a, on_b]);
            }
        }
    }

    /// Tries a unit vector that has its value from two points: if the bodies are less apart, other points count, and other directions.
    pub(super) fn take_pair(&mut self, normal: [f64; 3], [on_a, on_b]: [[f64; 3]; 2]) {
        let apart = self.apart(normal);
        if dot(normal, sub(on_b, on_a)) <= apart + self.level {
            self.take(normal, apart, Some([on_a, on_b]));
        }
    }
}
