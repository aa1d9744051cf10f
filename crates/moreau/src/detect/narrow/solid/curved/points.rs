//! The points of a contact, and which of them are kept.

use super::Touch;
use crate::detect::narrow::solid::spread::spread;
use crate::detect::narrow::vector::{dot, sub};
use crate::space::{Solid, Space};

/// As many points as are looked at.
const MOST: usize = 64;

/// What makes a point, by its kind: 0 a corner of the first body, 1 one of the second, 2 one of each, 3 sides that cross, by the corners at
/// which they begin.
pub(in crate::detect::narrow::solid) fn feature(kind: u64, a: u64, b: u64) -> u64 {
    kind << 30 | a << 15 | b
}

/// A point of contact half-way between both surfaces; the normal points from the first body to the second.
#[derive(Clone, Copy, Debug)]
pub(in crate::detect::narrow::solid) struct Point {
    pub(in crate::detect::narrow::solid) feature: u64,
    pub(in crate::detect::narrow::solid) at: [f64; 3],
    pub(in crate::detect::narrow::solid) normal: [f64; 3],
    pub(in crate::detect::narrow::solid) gap: f64,
}

/// Points within reach.
pub(in crate::detect::narrow::solid) struct Points {
    all: [Point; MOST],
    count: usize,
    apart: f64,
    level: f64,
    reach: f64,
}

impl Points {
    /// None yet, of bodies that are `apart` (m).
    pub(in crate::detect::narrow::solid) fn new(apart: f64, touch: &Touch) -> Self {
        let nothing = Point { feature: 0, at: [0.0; 3], normal: [0.0; 3], gap: 0.0 };
        Self { all: [nothing; MOST], count: 0, apart, level: touch.level, reach: touch.reach }
    }

    pub(in crate::detect::narrow::solid) fn all(&self) -> &[Point] {
        &self.all[..self.count]
    }

    /// Adds a point within reach, unless it is there already.
    pub(in crate::detect::narrow::solid) fn add(&mut self, point: Point) {
        if point.gap <= self.reach && self.count < MOST && self.all().iter().all(|other| other.feature != point.feature) {
            self.all[self.count] = point;
            self.count += 1;
        }
    }

    /// Adds a point, unless there is one at the same place, seen along their normal, that has no greater gap.
    pub(super) fn add_seen(&mut self, point: Point) {
        let level = self.level;
        let same = |other: &&mut Point| {
            let way = sub(other.at, point.at);
            let rise = dot(point.normal, way);
            dot(way, way) - rise * rise <= 16.0 * level * level
        };
        match self.all[..self.count].iter_mut().find(same) {
            Some(other) if point.gap < other.gap - level => *other = point,
            Some(_) => {}
            None => self.add(point),
        }
    }

    /// Whether a gap is not below what the bodies are apart.
    pub(super) fn allows(&self, gap: f64) -> bool {
        gap >= self.apart - self.level
    }

    /// Whether one has the gap that the bodies have, up to a part of what is level.
    pub(super) fn have_least(&self, part: f64) -> bool {
        self.all().iter().any(|point| point.gap <= self.apart + part * self.level)
    }

    /// Keeps of more than four those farthest out in four directions across their normal and the deepest, in the order of their features.
    pub(super) fn spread(&mut self) {
        let [_, s, t] = Solid::frame(self.all[0].normal);
        self.spread_between([s, t]);
    }

    /// The same with directions between two given ones.
    pub(in crate::detect::narrow::solid) fn spread_between(&mut self, [s, t]: [[f64; 3]; 2]) {
        self.all[..self.count].sort_unstable_by_key(|point| point.feature);
        if self.count <= 4 {
            return;
        }
        let points = &self.all[..self.count];
        let mut chosen = spread(points.len(), |i| (points[i].at, points[i].gap), [s, t], self.level);
        chosen.sort_unstable();
        self.count = 0;
        for (k, &i) in chosen.iter().enumerate() {
            if k == 0 || chosen[k - 1] != i {
                self.all[self.count] = self.all[i];
                self.count += 1;
            }
        }
    }
}
