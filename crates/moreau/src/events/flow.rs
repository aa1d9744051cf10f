//! Sources, where bodies come into the world, and sinks, where they leave it.

use crate::bodies::Bodies;
use crate::random::Random;
use crate::shape::Shape;
use crate::space::{Pose, Space};
use std::ops::Range;

/// Where, when and how bodies come.
#[derive(Clone, Debug, PartialEq)]
pub struct Rain<const D: usize, const N: usize> {
    /// Indices of the bodies, in the order in which they come. They are absent until then: each has a place in the arrays of its own, and
    /// a run that they flow through allocates no more than one that they stay in.
    pub bodies: Range<usize>,
    /// When the first is due, s.
    pub from: f64,
    /// When the last may come, s.
    pub until: f64,
    /// The time from one to the next, s.
    pub interval: f64,
    /// The lowest and the highest corner of the region, m; bodies lie inside.
    pub region: [[f64; D]; 2],
    /// The velocity that they begin with.
    pub velocity: [f64; N],
    /// How many places are tried for a body at each step.
    pub tries: u64,
}

/// A region in which bodies appear one after the other, at random places where they overlap nothing. One that is due and finds no room
/// waits, and those behind it with it.
#[derive(Clone, Debug)]
pub struct Source<const D: usize, const N: usize> {
    rain: Rain<D, N>,
    /// How many have come.
    count: usize,
    random: Random,
    /// Bodies that reach into the region.
    near: Vec<usize>,
}

impl<const D: usize, const N: usize> Source<D, N> {
    /// A source whose places follow from the seed.
    pub fn new(rain: Rain<D, N>, seed: u64) -> Self {
        let [_, random, _] = Random::three(seed);
        Self { rain, count: 0, random, near: Vec::new() }
    }

    /// Indices of the bodies that it brings.
    pub(super) fn bodies(&self) -> Range<usize> {
        self.rain.bodies.clone()
    }

    /// How many have come, and the generator of places.
    pub(super) fn state(&self) -> (usize, Random) {
        (self.count, self.random.clone())
    }

    /// Goes on from there, if so many can have come.
    pub(super) fn restore(&mut self, (count, random): &(usize, Random)) -> Option<()> {
        (self.count, self.random) = (*count, random.clone());
        (*count <= self.rain.bodies.len()).then_some(())
    }

    /// Puts in the bodies that are due at `time`, or until `now`, which allows for the rounding of clocks, as far as there is room;
    /// returns their indices.
    pub(super) fn rain<S: Space<D, N>>(&mut self, bodies: &mut Bodies<S, D, N>, time: f64, now: f64) -> Range<usize> {
        let first = self.rain.bodies.start + self.count;
        let (mut next, last) = (first, self.rain.bodies.end);
        let is_due = |count: usize| self.rain.from + count as f64 * self.rain.interval <= now;
        if next == last || time - (now - time) > self.rain.until || !is_due(self.count) {
            return next..next;
        }
        let [low, high] = &self.rain.region;
        self.near.clear();
        self.near.extend((0..bodies.len()).filter(|&j| bodies.is_present(j) && reaches(bodies, j, low, high)));
        while next < last && is_due(next - self.rain.bodies.start) {
            let Some(pose) = place(&self.rain, bodies, next, &self.near, &mut self.random) else { break };
            bodies.insert(next, pose, self.rain.velocity);
            self.near.push(next);
            next += 1;
        }
        self.count = next - self.rain.bodies.start;
        first..next
    }
}

/// Whether the bounding ball of body `j` meets the region, or it has none.
fn reaches<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    j: usize,
    low: &[f64; D],
    high: &[f64; D],
) -> bool {
    let Some(radius) = bodies.shape[j].bounding_radius() else { return true };
    let outside = |k: usize| (low[k] - bodies.pose[j].position[k]).max(bodies.pose[j].position[k] - high[k]).max(0.0);
    (0..D).map(|k| outside(k).powi(2)).sum::<f64>() <= radius * radius
}

/// A random place in the region where body `i` overlaps none of those near, if one of some tries is.
fn place<S: Space<D, N>, const D: usize, const N: usize>(
    rain: &Rain<D, N>,
    bodies: &Bodies<S, D, N>,
    i: usize,
    near: &[usize],
    random: &mut Random,
) -> Option<Pose<S::Rotation, D>> {
    let ([low, high], shape) = (&rain.region, &bodies.shape[i]);
    let radius = shape.bounding_radius()?;
    let mut places = (0..rain.tries).map(|_| {
        let position = std::array::from_fn(|k| low[k] + radius + random.unit() * (high[k] - low[k] - 2.0 * radius));
        Pose { position, rotation: S::IDENTITY }
    });
    places.find(|pose| {
        let touches = |&j: &usize| {
            let mut found = false;
            S::Shape::collide((shape, pose), (&bodies.shape[j], &bodies.pose[j]), 0.0, &mut |_, _, _, _| found = true);
            found
        };
        !near.iter().any(touches)
    })
}

/// A region in which free bodies vanish as soon as their centres are in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Sink<const D: usize> {
    /// The lowest corner of the region, m.
    pub min: [f64; D],
    /// The highest corner of the region, m.
    pub max: [f64; D],
}

impl<const D: usize> Sink<D> {
    /// Whether the region holds a point.
    pub fn holds(&self, point: &[f64; D]) -> bool {
        (0..D).all(|k| (self.min[k]..=self.max[k]).contains(&point[k]))
    }
}
