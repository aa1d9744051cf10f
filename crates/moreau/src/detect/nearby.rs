//! The list of nearby pairs, and whether it still stands.

use super::bound::{Bound, Hold};
use super::broad::{Grid, Sphere};
use super::pairs::Pairs;
use super::skin::Skins;
use super::wall::Wall;
use super::{CHUNK, SLACK, Scene, is_shared};
use crate::space::Space;
use rayon::prelude::*;

/// All pairs that can touch while every body stays where it is held.
#[derive(Clone, Debug, Default)]
pub(super) struct Nearby<const D: usize> {
    /// Where each body is held.
    holds: Vec<Hold<D>>,
    /// Bodies without a bounding ball.
    walls: Vec<Wall<D>>,
    walls_before: Vec<Wall<D>>,
    pairs: Pairs,
    /// Whether all bodies with a bounding ball were round when the list was made.
    round: bool,
    /// How many calls it has served beyond the one that made it.
    pub(super) calls: u32,
    skins: Skins,
    grid: Grid<D>,
    spheres: Vec<Sphere<D>>,
}

impl<const D: usize> Nearby<D> {
    /// The pairs, lower index first, ascending, each once.
    pub(super) fn pairs(&self) -> &[(u32, u32)] {
        self.pairs.list()
    }

    /// Whether bodies are round, but for those without a bounding ball; if some have changed since the list was made, it is no more than a guess.
    pub(super) fn all_round(&self) -> bool {
        self.round
    }

    /// Fills in the bounding balls of the call and says whether every body is where it was held: whether no pair outside the list
    /// can touch.
    pub(super) fn still_holds<S: Space<D, N>, const N: usize>(
        &mut self,
        scene: &Scene<'_, S, D, N>,
        driven: &(impl Fn(usize) -> bool + Sync),
        bounds: &mut Vec<Bound<D>>,
    ) -> bool {
        let count = scene.shapes.len();
        bounds.resize(count, Bound::NOWHERE);
        let same = self.holds.len() == count;
        if same {
            self.calls = self.calls.saturating_add(1);
        } else {
            self.forget(count);
        }
        let look = |(chunk, (bounds, holds)): (usize, (&mut [Bound<D>], &[Hold<D>]))| {
            let mut all = true;
            for (i, (bound, hold)) in (chunk * CHUNK..).zip(bounds.iter_mut().zip(holds)) {
                *bound = Bound::of(scene, i);
                all &= hold.holds(bound, driven(i));
            }
            all
        };
        let bodies = if is_shared(count, CHUNK) {
            let chunks = bounds.par_chunks_mut(CHUNK).zip(self.holds.par_chunks(CHUNK)).enumerate();
            chunks.map(look).reduce(|| true, |a, b| a & b)
        } else {
            bounds.chunks_mut(CHUNK).zip(self.holds.chunks(CHUNK)).enumerate().map(look).fold(true, |a, b| a & b)
        };
        same && bodies && self.walls.iter().all(|wall| wall.holds(scene))
    }

    /// Begins afresh, with so many bodies.
    fn forget(&mut self, count: usize) {
        self.holds.clear();
        self.holds.resize(count, Hold { centre: [0.0; D], radius: f64::NAN, driven: false });
        self.walls.clear();
        self.calls = 0;
    }

    /// Makes the list anew for the bodies of a call, whose bounding balls are filled in.
    pub(super) fn rebuild<S: Space<D, N>, const N: usize>(
        &mut self,
        scene: &Scene<'_, S, D, N>,
        driven: &impl Fn(usize) -> bool,
        bounds: &[Bound<D>],
    ) {
        self.hold_all(scene, driven, bounds);
        let Self { pairs, holds, .. } = self;
        pairs.clear();
        let wanted = |a: u32, b: u32| !(holds[a as usize].driven && holds[b as usize].driven);
        self.grid.pairs(&self.spheres, wanted, &mut |a, b| pairs.push(a, b));
        let mut found = |a, b| {
            if wanted(a, b) {
                pairs.push(a, b);
            }
        };
        for rank in 0..self.walls.len() {
            let (walls, others) = self.walls.split_at_mut(rank + 1);
            let body = walls[rank].body;
            walls[rank].near(&self.spheres, |other| found(body, other));
            others.iter().for_each(|other| found(body, other.body));
        }
        pairs.sort(bounds.len());
        self.calls = 0;
    }

    /// Chooses skins and sets the balls and heights that hold bodies and walls.
    fn hold_all<S: Space<D, N>, const N: usize>(
        &mut self,
        scene: &Scene<'_, S, D, N>,
        driven: &impl Fn(usize) -> bool,
        bounds: &[Bound<D>],
    ) {
        self.skins.adapt(&self.holds, self.calls, bounds);
        self.spheres.clear();
        std::mem::swap(&mut self.walls, &mut self.walls_before);
        self.walls.clear();
        self.round = true;
        for (body, (bound, hold)) in (0..).zip(bounds.iter().zip(&mut self.holds)) {
            let centre = bound.centre;
            let mut radius = if bound.is_nowhere() { f64::NAN } else { bound.radius };
            if bound.is_bounded() {
                self.round &= bound.round().is_some();
                let wide = bound.radius + self.skins.of_body(hold, self.calls, bound);
                radius = if wide * (1.0 + SLACK) < f64::INFINITY { wide } else { radius };
                self.spheres.push(Sphere { centre, radius: radius * (1.0 + SLACK), body });
            } else if !bound.is_nowhere() {
                let mut wall = Wall::new(scene, body);
                let before = self.walls_before.get(self.walls.len()).filter(|before| before.body == body);
                let pace = before.map_or(0.0, |before| before.approach(scene).max(0.0) / f64::from(self.calls.max(1)));
                wall.allow(self.skins.of_wall(pace));
                self.walls.push(wall);
            }
            *hold = Hold { centre, radius, driven: driven(body as usize) };
        }
    }
}
