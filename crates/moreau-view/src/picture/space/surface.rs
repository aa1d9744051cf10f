//! What is nearest to the eye at each sample.

use super::solid::{Plane, Solid, ball, rod};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

/// Nothing is at this sample.
pub(super) const NOTHING: u32 = u32::MAX;

/// Samples of a tile, across and down. A band is a row of tiles and belongs to one thread at a time.
const TILE: usize = 32;

/// Depth, normal and owner of each sample, rows from the top.
pub(super) struct Surface {
    pub size: [usize; 2],
    /// Towards the eye, in samples; minus infinity where nothing is.
    pub depth: Vec<f32>,
    /// Right and down components of the normal times 32767; the third points to the eye.
    normal: Vec<[i16; 2]>,
    /// Index of the body or chain.
    pub owner: Vec<u32>,
}

/// A band of rows of a surface.
pub(super) struct Band<'a> {
    /// Its first row.
    pub top: usize,
    width: usize,
    pub depth: &'a mut [f32],
    normal: &'a mut [[i16; 2]],
    owner: &'a mut [u32],
}

impl Surface {
    /// The nearest of the solids, each with its owner.
    pub(super) fn new(size: [usize; 2], solids: &[(Solid, u32)]) -> Self {
        let samples = size[0] * size[1];
        let mut surface =
            Self { size, depth: vec![f32::NEG_INFINITY; samples], normal: vec![[0; 2]; samples], owner: vec![NOTHING; samples] };
        let tiles = Tiles::new(size, solids);
        surface.bands(|band| {
            for column in 0..tiles.across {
                band.draw(column * TILE, tiles.of(column, band.top / TILE), solids);
            }
        });
        surface
    }

    /// Calls `each` for all bands, in parallel.
    pub(super) fn bands(&mut self, each: impl Fn(&mut Band) + Sync) {
        let width = self.size[0];
        let rows = TILE * width;
        self.depth
            .par_chunks_mut(rows)
            .zip(self.normal.par_chunks_mut(rows))
            .zip(self.owner.par_chunks_mut(rows))
            .enumerate()
            .for_each(|(i, ((depth, normal), owner))| each(&mut Band { top: i * TILE, width, depth, normal, owner }));
    }

    /// Whether a square of samples shows nothing, or one place of one surface: the same owner and, where `flat`, the same normal.
    pub(super) fn is_even(&self, first: [usize; 2], side: usize, flat: impl Fn(u32) -> bool) -> bool {
        let at = |row: usize| (first[1] + row) * self.size[0] + first[0];
        let owner = self.owner[at(0)];
        let row = |row: usize| at(row)..at(row) + side;
        (0..side).all(|y| self.owner[row(y)].iter().all(|&o| o == owner))
            && (!flat(owner) || (0..side).all(|y| self.normal[row(y)].iter().all(|&n| n == self.normal[at(0)])))
    }

    pub(super) fn normal(&self, sample: usize) -> Vec3 {
        let [x, y] = self.normal[sample].map(|n| f32::from(n) / 32767.0);
        Vec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt())
    }
}

impl Band<'_> {
    /// Takes a sample if it is nearer than what is there; `at` counts from the band's first sample.
    #[inline]
    pub(super) fn put(&mut self, at: usize, depth: f32, owner: u32, normal: impl FnOnce() -> Vec3) {
        if depth > self.depth[at] {
            let n = normal();
            self.depth[at] = depth;
            self.owner[at] = owner;
            self.normal[at] = [n.x, n.y].map(|x| (x * 32767.0) as i16);
        }
    }

    /// Draws the solids of a tile, which come nearest first.
    fn draw(&mut self, left: usize, list: &[u32], solids: &[(Solid, u32)]) {
        let (right, rows) = ((left + TILE).min(self.width), self.depth.len() / self.width);
        for (count, &index) in list.iter().enumerate() {
            let (solid, owner) = &solids[index as usize];
            let (low, high) = solid.bounds();
            // Everything after this one is even farther. Looking costs as much as drawing a few, so it is done now and then.
            if count % 8 == 7 && high.z < self.farthest(left, right, rows) {
                return;
            }
            let columns = span(low.x, high.x, left, right);
            let lines = span(low.y, high.y, self.top, self.top + rows);
            for y in lines {
                self.line(y, columns.clone(), solid, *owner);
            }
        }
    }

    fn line(&mut self, y: usize, columns: std::ops::Range<usize>, solid: &Solid, owner: u32) {
        let start = (y - self.top) * self.width;
        let place = |x: usize| Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
        match *solid {
            Solid::Ball { centre, radius } => {
                let Some(half) = ball(Vec2::new(0.0, y as f32 + 0.5 - centre.y), radius) else { return };
                for x in span(centre.x - half, centre.x + half, columns.start, columns.end) {
                    let at = place(x) - centre.truncate();
                    if let Some(height) = ball(at, radius) {
                        self.put(start + x, centre.z + height, owner, || at.extend(height) / radius);
                    }
                }
            }
            Solid::Triangle { corners, normals: [a, b, c] } => {
                let plane = Plane::new(corners);
                for x in columns {
                    if let Some((depth, w)) = plane.at(place(x)) {
                        self.put(start + x, depth, owner, || (a * w.x + b * w.y + c * w.z).normalize_or(Vec3::Z));
                    }
                }
            }
            Solid::Rod { from, to, radius } => {
                for x in columns {
                    if let Some((depth, normal)) = rod(place(x), from, to, radius) {
                        self.put(start + x, depth, owner, || normal);
                    }
                }
            }
        }
    }

    fn farthest(&self, left: usize, right: usize, rows: usize) -> f32 {
        let row =
            |y: usize| self.depth[y * self.width + left..y * self.width + right].iter().copied().fold(f32::INFINITY, f32::min);
        (0..rows).map(row).fold(f32::INFINITY, f32::min)
    }
}

/// The samples with centres from `low` to `high` that are in `first..end`.
fn span(low: f32, high: f32, first: usize, end: usize) -> std::ops::Range<usize> {
    let from = (low - 0.5).ceil().max(first as f32) as usize;
    let to = ((high - 0.5).floor() + 1.0).clamp(0.0, end as f32) as usize;
    from..to
}

/// For each tile the solids that may be seen in it, nearest first.
struct Tiles {
    across: usize,
    starts: Vec<usize>,
    solids: Vec<u32>,
}

impl Tiles {
    fn new(size: [usize; 2], solids: &[(Solid, u32)]) -> Self {
        let [across, down] = size.map(|n| n.div_ceil(TILE));
        let mut order: Vec<(f32, u32)> = solids.iter().enumerate().map(|(i, (s, _))| (-s.bounds().1.z, i as u32)).collect();
        order.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let touched = |index: u32| {
            let (low, high) = solids[index as usize].0.bounds();
            let tiles = |low: f32, high: f32, count: usize| {
                let tile = |x: f32| (x / TILE as f32).floor().clamp(-1.0, count as f32) as isize;
                tile(low).max(0) as usize..((tile(high) + 1).max(0) as usize).min(count)
            };
            let columns = tiles(low.x, high.x, across);
            tiles(low.y, high.y, down).flat_map(move |row| columns.clone().map(move |column| row * across + column))
        };
        let mut starts = vec![0; across * down + 1];
        order.iter().flat_map(|&(_, i)| touched(i)).for_each(|tile| starts[tile + 1] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut list = vec![0; starts[across * down]];
        let mut next = starts.clone();
        for &(_, index) in &order {
            for tile in touched(index) {
                list[next[tile]] = index;
                next[tile] += 1;
            }
        }
        Self { across, starts, solids: list }
    }

    fn of(&self, column: usize, row: usize) -> &[u32] {
        let tile = row * self.across + column;
        &self.solids[self.starts[tile]..self.starts[tile + 1]]
    }
}
