//! The search of the grid: each ball against those that may overlap it.

use super::level::Level;
use super::{Ball, Grid};
use std::ops::Range;

impl<const D: usize> Grid<D> {
    /// Hands over what some of the sorted balls hit among those that come after them in their level, and in coarser levels.
    pub(super) fn search(&self, balls: Range<usize>, hits: &mut Hits, mut found: impl FnMut(u32, u32)) {
        for (depth, level) in self.levels.iter().enumerate() {
            let first = self.starts[level.table as usize] as usize;
            let last = self.starts[(level.table + level.mask) as usize + 1] as usize;
            for ball in first.max(balls.start)..last.min(balls.end) {
                hits.count = 0;
                self.within(level, ball, hits);
                for coarser in &self.levels[..depth] {
                    self.above(coarser, ball, hits);
                }
                for &other in hits.list[..hits.count].iter().filter(|&&other| other as usize != ball) {
                    found(self.bodies[ball], self.bodies[other as usize]);
                }
            }
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

/// Scratch of a search.
#[derive(Clone, Debug, Default)]
pub(super) struct Search {
    pub(super) hits: Hits,
    /// What a thread has found for the others.
    pub(super) pairs: Vec<(u32, u32)>,
}

/// What a ball has hit. A hit is written before it is known and counted after: the test is a toss of a coin, and a branch on it
/// would cost more than all the rest.
#[derive(Clone, Debug, Default)]
pub(super) struct Hits {
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
