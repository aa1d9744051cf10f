//! The balls around bodies: where each is now, and where it may go before the list of nearby pairs is made anew.

use super::{SLACK, Scene};
use crate::shape::Shape;
use crate::space::Space;

/// The ball around a body now, its reach included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound<const D: usize> {
    /// Finite or not, m.
    pub(super) centre: [f64; D],
    /// m; infinite for a body without a bounding ball.
    pub(super) radius: f64,
    /// Radius of the body itself if it is round, else not a number, m.
    core: f64,
    /// Its reach, m.
    reach: f64,
}

impl<const D: usize> Bound<D> {
    pub(super) const NOWHERE: Self = Self { centre: [f64::NAN; D], radius: f64::NAN, core: f64::NAN, reach: 0.0 };

    /// The ball around body `i`. Called, it would hand its result over in memory, in other pieces than it is read in: a third of detection.
    #[inline(always)]
    pub(super) fn of<S: Space<D, N>, const N: usize>(scene: &Scene<'_, S, D, N>, i: usize) -> Self {
        // A negative reach is left to the narrow phase: a bounding ball has no negative radius.
        let (shape, reach) = (&scene.shapes[i], scene.reach[i]);
        let size = shape.bounding_radius().unwrap_or(f64::INFINITY);
        let radius = (size + reach.max(0.0)) * (1.0 + SLACK);
        Self { centre: scene.poses[i].position, radius, core: if shape.is_round() { size } else { f64::NAN }, reach }
    }

    /// The body as a ball, and its reach, if it is round: bodies of which every normal passes through one point are balls.
    #[inline]
    pub(super) fn round(&self) -> Option<(([f64; D], f64), f64)> {
        (!self.core.is_nan()).then_some(((self.centre, self.core), self.reach))
    }

    /// True if the surface of body `i`, whose ball this is, may have edges: if it is neither round nor a half-space.
    #[inline]
    pub(super) fn has_edges<S: Space<D, N>, const N: usize>(&self, scene: &Scene<'_, S, D, N>, i: usize) -> bool {
        let is_half_space = || scene.shapes[i].bounding_normal(scene.poses[i].rotation).is_some();
        self.core.is_nan() && (self.radius.is_finite() || (self.radius == f64::INFINITY && !is_half_space()))
    }

    /// Whether there is no such place, or no such ball: the body can touch nothing.
    pub(super) fn is_nowhere(&self) -> bool {
        self.radius.is_nan() || !self.centre.iter().all(|x| x.is_finite())
    }

    /// Whether it is a ball around somewhere.
    pub(super) fn is_bounded(&self) -> bool {
        self.radius.is_finite() && !self.is_nowhere()
    }

    /// Whether the two balls meet; one that is infinite meets every other.
    #[inline]
    pub(super) fn meets(&self, other: &Self) -> bool {
        let sum = self.radius + other.radius;
        square_between(self.centre, other.centre) <= sum * sum
    }
}

/// The ball that a body may not leave while the list of nearby pairs stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold<const D: usize> {
    /// Where the body was when the list was made, m.
    pub(super) centre: [f64; D],
    /// m; infinite for a body without a bounding ball, not a number for one that was nowhere.
    pub(super) radius: f64,
    /// Whether the body was driven.
    pub(super) driven: bool,
}

impl<const D: usize> Hold<D> {
    /// Whether a body's ball lies within. A body without a ball must have been one, and is left to its wall. Where squares would
    /// lose their digits the answer is no, and so it is for a body that is nowhere or was; only one that stays nowhere is held.
    #[inline]
    pub(super) fn holds(&self, bound: &Bound<D>, driven: bool) -> bool {
        let room = self.radius - bound.radius;
        let inside = square_between(self.centre, bound.centre) <= room * room && room > 1e-140 && room < 1e140;
        (inside || self.without_ball(bound)) && self.driven == driven
    }

    /// Whether the body had no ball and has none, or was nowhere and still is.
    fn without_ball(&self, bound: &Bound<D>) -> bool {
        (self.radius == f64::INFINITY && bound.radius == f64::INFINITY) || (self.radius.is_nan() && bound.is_nowhere())
    }
}

/// Square of the distance, m².
#[inline]
pub(super) fn square_between<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    let mut square = 0.0;
    for k in 0..D {
        let between = b[k] - a[k];
        square += between * between;
    }
    square
}
