//! The direction along which two bodies are farthest apart, or overlap least.

use super::{Convex, Touch, unit};
use crate::detect::narrow::vector::{dot, sub};

/// The best of the directions tried so far, unit vectors from the first body to the second.
pub(in crate::detect::narrow::solid) struct Best<'a, A, B> {
    pub(super) a: &'a A,
    pub(super) b: &'a B,
    pub(super) level: f64,
    pub(super) normal: [f64; 3],
    /// How far the bodies are apart along it, m; negative where they overlap.
    pub(super) apart: f64,
    /// A point of each body that are so far apart, where the direction comes from two points.
    pub(super) pair: Option<[[f64; 3]; 2]>,
    /// Whether the direction is the normal of a face.
    is_flat: bool,
}

impl<'a, A: Convex, B: Convex> Best<'a, A, B> {
    pub(in crate::detect::narrow::solid) fn new(a: &'a A, b: &'a B, level: f64) -> Self {
        Self { a, b, level, normal: [0.0, 0.0, 1.0], apart: f64::NEG_INFINITY, pair: None, is_flat: false }
    }

    /// Whether the bodies are too far apart along the best direction, or nowhere.
    pub(in crate::detect::narrow::solid) fn is_beyond(&self, touch: &Touch) -> bool {
        touch.is_beyond(self.apart)
    }

    /// Tries a unit vector along which the bodies are apart by so much. Bodies that touch or overlap can have several directions
    /// that are equally good, of which the first is kept, most of all the normal of a face; there is only one for those that are apart.
    fn take(&mut self, normal: [f64; 3], apart: f64, pair: Option<[[f64; 3]; 2]>, is_flat: bool) {
        let slack = match self.is_flat {
            _ if self.apart > self.level => 0.0,
            true => self.level,
            false => 1e-2 * self.level,
        };
        if apart > self.apart + slack {
            (self.normal, self.apart, self.pair, self.is_flat) = (normal, apart, pair, is_flat);
        }
    }

    /// Tries the normal of a face, into the second body, along which the bodies are apart by so much.
    pub(super) fn take_face(&mut self, normal: [f64; 3], apart: f64) {
        self.take(normal, apart, None, true);
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
        self.take(normal, self.apart(normal), None, false);
    }

    /// Tries the direction of a vector of any length and its opposite, unless it has none.
    pub(in crate::detect::narrow::solid) fn offer_both_ways(&mut self, way: [f64; 3]) {
        if let Some(normal) = unit(way) {
            self.offer(normal);
            self.offer(normal.map(|x| -x));
        }
    }

    /// Tries the direction from a point of the first body to one of the second: no direction has them farther apart than these points.
    pub(super) fn offer_between(&mut self, [on_a, on_b]: [[f64; 3]; 2]) {
        let way = sub(on_b, on_a);
        if self.apart < 0.0 || dot(way, way) > self.apart * self.apart {
            unit(way).into_iter().for_each(|normal| self.take_pair(normal, [on_a, on_b]));
        }
    }

    /// Tries what is across two edges, both ways, which has two of their points nearest. Of edges that are nearly parallel it has few
    /// digits, so it has to be better than what was tried before, more than by rounding.
    pub(super) fn offer_across(&mut self, across: [f64; 3], [on_a, on_b]: [[f64; 3]; 2]) {
        let Some(normal) = unit(across) else { return };
        for normal in [normal, normal.map(|x| -x)] {
            if dot(normal, sub(on_b, on_a)) > self.apart + 1e-3 * self.level {
                self.take_pair(normal, [on_a, on_b]);
            }
        }
    }

    /// Tries a unit vector that has its value from two points: if the bodies are less apart, other points count, and other directions.
    pub(super) fn take_pair(&mut self, normal: [f64; 3], [on_a, on_b]: [[f64; 3]; 2]) {
        let apart = self.apart(normal);
        if dot(normal, sub(on_b, on_a)) <= apart + self.level {
            self.take(normal, apart, Some([on_a, on_b]), false);
        }
    }
}
