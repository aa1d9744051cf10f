//! Broad phase: pairs of balls that overlap, by a hierarchical hashed grid.
//!
//! 1. Balls are put into levels by powers of two of their diameter below the largest one; the cell of a level is as wide as the
//!    largest ball in it, so that balls of one level can only overlap within neighbouring cells.
//! 2. A level's cells are hashed into a table of buckets by a linear function of their integer coordinates with stride 1 along
//!    the last axis: the cells of a column are consecutive buckets, and a neighbour is a constant offset.
//! 3. One counting sort puts the balls into the order of their buckets; a run of three neighbouring cells is contiguous memory.
//! 4. Each ball is held against half of the neighbouring columns of its own level, and against the cells of every coarser level
//!    that hold a centre in range.
//!
//! Distinct cells may share a bucket. That costs a few more tests, and may find a pair twice, but never loses one; the caller
//! drops repetitions. A ball flown off shares the bucket of some other cell and costs nothing; memory is linear in the balls.
//! After Eitz & Gu, Hierarchical spatial hashing for real-time collision detection, SMI 2007; Ogarko & Luding, A fast
//! multilevel algorithm for contact detection of arbitrarily polydisperse objects, Comput. Phys. Commun. 183 (2012).

mod level;
mod search;

use super::{CHUNK, is_shared};
use level::{LEVELS, Level, rank};
use rayon::prelude::*;
use search::Search;

/// A ball around a body, of its reach included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sphere<const D: usize> {
    /// Finite, m.
    pub(super) centre: [f64; D],
    /// Finite and not negative, m.
    pub(super) radius: f64,
    /// Whose it is.
    pub(super) body: u32,
}

/// What the inner loop reads.
#[derive(Clone, Copy, Debug)]
struct Ball<const D: usize> {
    centre: [f64; D],
    radius: f64,
}

/// The grid; it is built anew each time, in the memory of the last.
#[derive(Clone, Debug, Default)]
pub(super) struct Grid<const D: usize> {
    /// Occupied levels, coarse to fine.
    levels: Vec<Level<D>>,
    /// Where each bucket of each level begins in the sorted arrays, and the end.
    starts: Vec<u32>,
    /// Bucket of each ball, in the order given.
    unsorted: Vec<u32>,
    /// Balls in the order of their buckets, then who they are and where.
    balls: Vec<Ball<D>>,
    bodies: Vec<u32>,
    buckets: Vec<u32>,
    /// Scratch, one for each chunk of balls where threads share them, else one alone.
    searches: Vec<Search>,
}

impl<const D: usize> Grid<D> {
    /// Hands over every pair of bodies that is `wanted` and whose balls overlap or touch, in no particular order, some more than
    /// once.
    pub(super) fn pairs(
        &mut self,
        spheres: &[Sphere<D>],
        wanted: impl Fn(u32, u32) -> bool + Sync,
        found: &mut impl FnMut(u32, u32),
    ) {
        self.build(spheres);
        let count = spheres.len();
        let mut searches = std::mem::take(&mut self.searches);
        if is_shared(count, CHUNK) {
            searches.resize_with(count.div_ceil(CHUNK).max(searches.len()), Search::default);
            searches.par_iter_mut().enumerate().for_each(|(chunk, search)| {
                let Search { hits, pairs } = search;
                pairs.clear();
                let balls = (chunk * CHUNK).min(count)..((chunk + 1) * CHUNK).min(count);
                self.search(balls, hits, |a, b| {
                    if wanted(a, b) {
                        pairs.push((a, b));
                    }
                });
            });
            searches.iter().flat_map(|search| &search.pairs).for_each(|&(a, b)| found(a, b));
        } else {
            searches.resize_with(searches.len().max(1), Search::default);
            self.search(0..count, &mut searches[0].hits, |a, b| {
                if wanted(a, b) {
                    found(a, b);
                }
            });
        }
        self.searches = searches;
    }

    /// Sorts the balls by level and bucket.
    fn build(&mut self, spheres: &[Sphere<D>]) {
        let largest = spheres.iter().fold(0.0, |r: f64, sphere| r.max(sphere.radius));
        let mut census = [(0, 0.0_f64); LEVELS];
        for sphere in spheres {
            let (count, widest) = &mut census[rank(largest, sphere.radius)];
            *count += 1;
            *widest = widest.max(sphere.radius);
        }
        let mut level_of_rank = [0; LEVELS];
        self.levels.clear();
        let mut table = 0;
        for (rank, &(count, widest)) in census.iter().enumerate().filter(|(_, (count, _))| *count > 0) {
            level_of_rank[rank] = self.levels.len();
            let level = Level::new(count, widest, table);
            table += level.mask + 1;
            self.levels.push(level);
        }
        self.unsorted.clear();
        self.unsorted.extend(spheres.iter().map(|sphere| {
            let level = &self.levels[level_of_rank[rank(largest, sphere.radius)]];
            level.table + level.bucket(level.cell(sphere.centre))
        }));
        self.sort(spheres, table as usize);
    }

    fn sort(&mut self, spheres: &[Sphere<D>], tables: usize) {
        self.starts.clear();
        self.starts.resize(tables + 1, 0);
        for &bucket in &self.unsorted {
            self.starts[bucket as usize] += 1;
        }
        // Running sums give each bucket's end; filling from the back leaves its beginning, and keeps the order given.
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        self.balls.resize(spheres.len(), Ball { centre: [0.0; D], radius: 0.0 });
        self.bodies.resize(spheres.len(), 0);
        self.buckets.resize(spheres.len(), 0);
        for (sphere, &bucket) in spheres.iter().zip(&self.unsorted).rev() {
            let start = &mut self.starts[bucket as usize];
            *start -= 1;
            let place = *start as usize;
            self.balls[place] = Ball { centre: sphere.centre, radius: sphere.radius };
            self.bodies[place] = sphere.body;
            self.buckets[place] = bucket;
        }
    }
}

#[cfg(test)]
pub(super) mod tests;
