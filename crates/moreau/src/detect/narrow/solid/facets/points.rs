//! The points of a pair, and which four of many are kept.

use super::Point;
use crate::detect::narrow::solid::spread::spread;
use crate::detect::narrow::vector::{dot, sub};
use crate::space::{Solid, Space};

/// Points of contact.
#[derive(Default)]
pub(in crate::detect::narrow::solid) struct Points {
    all: Vec<Point>,
    /// Where those that must be apart from each other are in their plane.
    places: Vec<[f64; 2]>,
}

impl Points {
    pub(in crate::detect::narrow::solid) fn all(&self) -> &[Point] {
        &self.all
    }

    pub(in crate::detect::narrow::solid) fn clear(&mut self) {
        self.all.clear();
        self.places.clear();
    }

    pub(in crate::detect::narrow::solid) fn add(&mut self, point: Point) {
        self.all.push(point);
    }

    /// Adds a point whose place in a plane is farther than `apart` from those of all before.
    pub(super) fn add_apart(&mut self, point: Point, place: [f64; 2], apart: f64) {
        let near = |&p: &[f64; 2]| dot(sub(p, place), sub(p, place)) <= apart * apart;
        if !self.places.iter().any(near) {
            self.places.push(place);
            self.all.push(point);
        }
    }

    /// Keeps those within reach, of more than four the ones farthest out in four directions and the deepest, in the order of their features.
    pub(in crate::detect::narrow::solid) fn spread(&mut self, level: f64, reach: f64) {
        self.all.retain(|point| point.gap <= reach);
        self.all.sort_unstable_by_key(|point| point.feature);
        if self.all.len() > 4 {
            self.four(level);
        }
    }

    fn four(&mut self, level: f64) {
        let all = &self.all;
        let [_, s, t] = Solid::frame(all[0].normal);
        let kept = spread(all.len(), |i| (all[i].at, all[i].gap), [s, t], level);
        let mut place = 0..;
        self.all.retain(|_| place.next().is_some_and(|i| kept.contains(&i)));
    }
}
