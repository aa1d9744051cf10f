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

use level::{LEVELS, Level, rank};

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
    hits: Hits,
}

impl<const D: usize> Grid<D> {
    /// Hands over every pair of bodies whose balls overlap or touch, in no particular order, some more than once.
    pub(super) fn pairs(&mut self, spheres: &[Sphere<D>], found: &mut impl FnMut(u32, u32)) {
        self.build(spheres);
        let mut hits = std::mem::take(&mut self.hits);
        for (depth, level) in self.levels.iter().enumerate() {
            let first = self.starts[level.table as usize] as usize;
            let last = self.starts[(level.table + level.mask) as usize + 1] as usize;
            for ball in first..last {
                hits.count = 0;
                self.within(level, ball, &mut hits);
                for coarser in &self.levels[..depth] {
                    self.above(coarser, ball, &mut hits);
                }
                for &other in hits.list[..hits.count].iter().filter(|&&other| other as usize != ball) {
                    found(self.bodies[ball], self.bodies[other as usize]);
                }
            }
        }
        self.hits = hits;
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

    /// A ball against those of its own level: the rest of its cell, the next cell of its column, and half the columns around.
    #[inline]
    fn within(&self, level: &Level<D>, ball: usize, hits: &mut Hits) {
        let home = self.buckets[ball] - level.table;
        self.scan(ball, ball + 1, self.starts[(level.table + home) as usize + 1] as usize, hits);
        self.scan_run(level, ball, home.wrapping_add(1), 1, hits);
        for &offset in level.columns() {
            self.scan_run(level, ball, home.wrapping_add(offset), 3, hits);
        }
    }

    /// A ball against those of a coarser level, in the cells where a centre may be in range.
    #[inline]
    fn above(&self, level: &Level<D>, ball: usize, hits: &mut Hits) {
        let Ball { centre, radius } = self.balls[ball];
        let range = radius + level.half_cell;
        let low = level.cell(centre.map(|x| x - range));
        let high = level.cell(centre.map(|x| x + range));
        let run = (high[D - 1] - low[D - 1] + 1) as u32;
        // An odometer over all axes but the last, which the run covers.
        let mut cell = low;
        loop {
            self.scan_run(level, ball, level.bucket(cell), run, hits);
            let Some(axis) = (0..D - 1).find(|&axis| cell[axis] < high[axis]) else { break };
            cell[axis] += 1;
            cell[..axis].copy_from_slice(&low[..axis]);
        }
    }

    /// A ball against `run` consecutive buckets of a table, which closes on itself.
    #[inline]
    fn scan_run(&self, level: &Level<D>, ball: usize, bucket: u32, run: u32, hits: &mut Hits) {
        let first = bucket & level.mask;
        let end = first + run;
        let start_of = |bucket: u32| self.starts[(level.table + bucket) as usize] as usize;
        self.scan(ball, start_of(first), start_of(end.min(level.mask + 1)), hits);
        if end > level.mask + 1 {
            self.scan(ball, start_of(0), start_of(end - level.mask - 1), hits);
        }
    }

    /// A ball against a stretch of the sorted balls.
    #[inline]
    fn scan(&self, ball: usize, first: usize, last: usize, hits: &mut Hits) {
        if first == last {
            return;
        }
        let Ball { centre, radius } = self.balls[ball];
        let stretch = &self.balls[first..last];
        let room = hits.room(stretch.len());
        let mut count = 0;
        for (other, candidate) in (first as u32..).zip(stretch) {
            let mut square = 0.0;
            for k in 0..D {
                let between = candidate.centre[k] - centre[k];
                square += between * between;
            }
            let sum = candidate.radius + radius;
            room[count] = other;
            count += usize::from(square <= sum * sum);
        }
        hits.count += count;
    }
}

/// What a ball has hit. A hit is written before it is known and counted after: the test is a toss of a coin, and a branch on it
/// would cost more than all the rest.
#[derive(Clone, Debug, Default)]
struct Hits {
    list: Vec<u32>,
    count: usize,
}

impl Hits {
    /// The place for so many more.
    #[inline]
    fn room(&mut self, more: usize) -> &mut [u32] {
        let end = self.count + more;
        if self.list.len() < end {
            self.list.resize(end, 0);
        }
        &mut self.list[self.count..end]
    }
}

#[cfg(test)]
pub(super) mod tests;
