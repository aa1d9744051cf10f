//! Random sequential insertion: balls one after the other at random places where they overlap none.

use crate::random::{Random, square};

/// A uniform grid over the region: per cell the last ball put there, per ball the one before it in its cell.
struct Grid<const D: usize> {
    min: [f64; D],
    cell: f64,
    cells: [usize; D],
    last: Vec<u32>,
    before: Vec<u32>,
}

/// The end of a cell's list.
const NONE: u32 = u32::MAX;

impl<const D: usize> Grid<D> {
    /// A grid whose cells are at least `smallest` wide and not many more than the `count` balls that it will hold.
    fn new(min: &[f64; D], max: &[f64; D], smallest: f64, count: usize) -> Self {
        let lengths: [f64; D] = std::array::from_fn(|k| max[k] - min[k]);
        let mut cell = smallest;
        let wide = |cell: f64| lengths.map(|length| (length / cell).floor().max(1.0));
        while wide(cell).iter().product::<f64>() > 4.0 * count as f64 + 64.0 {
            cell *= 1.25;
        }
        let cells = wide(cell).map(|n| n as usize);
        Self { min: *min, cell, cells, last: vec![NONE; cells.iter().product()], before: vec![NONE; count] }
    }

    /// The cell of a point along one axis. What lies beyond the last cell counts to it.
    fn along(&self, k: usize, x: f64) -> usize {
        (((x - self.min[k]) / self.cell) as usize).min(self.cells[k] - 1)
    }

    fn number(&self, at: [usize; D]) -> usize {
        (0..D).rev().fold(0, |number, k| number * self.cells[k] + at[k])
    }

    fn insert(&mut self, ball: u32, at: &[f64; D]) {
        let cell = self.number(std::array::from_fn(|k| self.along(k, at[k])));
        self.before[ball as usize] = self.last[cell];
        self.last[cell] = ball;
    }

    /// Whether `test` holds of some ball whose centre may lie within a cell's width of `at`.
    fn any_near(&self, at: &[f64; D], mut test: impl FnMut(u32) -> bool) -> bool {
        let low: [usize; D] = std::array::from_fn(|k| self.along(k, at[k]).saturating_sub(1));
        let high: [usize; D] = std::array::from_fn(|k| (self.along(k, at[k]) + 1).min(self.cells[k] - 1));
        let mut here = low;
        loop {
            let mut ball = self.last[self.number(here)];
            while ball != NONE {
                if test(ball) {
                    return true;
                }
                ball = self.before[ball as usize];
            }
            // The next cell of the block, as an odometer counts.
            let Some(k) = (0..D).find(|&k| here[k] < high[k]) else { return false };
            here[..k].copy_from_slice(&low[..k]);
            here[k] += 1;
        }
    }
}

/// Centres for balls of these radii inside the region, in the order of the radii; where one does not fit, how many did.
///
/// The largest come first, as later ones find less room.
pub(super) fn pack<const D: usize>(
    radii: &[f64],
    min: &[f64; D],
    max: &[f64; D],
    tries: u64,
    random: &mut Random,
) -> Result<Vec<[f64; D]>, usize> {
    if radii.is_empty() {
        return Ok(Vec::new());
    }
    let mut order: Vec<u32> = (0..radii.len() as u32).collect();
    order.sort_by(|&a, &b| radii[b as usize].total_cmp(&radii[a as usize]).then(a.cmp(&b)));
    let largest = order.first().map_or(0.0, |&ball| radii[ball as usize]);
    let mut grid = Grid::new(min, max, 2.0 * largest, radii.len());
    let mut centres = vec![[0.0; D]; radii.len()];
    for (placed, &ball) in order.iter().enumerate() {
        let radius = radii[ball as usize];
        if (0..D).any(|k| max[k] - min[k] < 2.0 * radius) {
            return Err(placed);
        }
        let free = (0..tries).find_map(|_| {
            let at: [f64; D] = std::array::from_fn(|k| min[k] + radius + random.unit() * (max[k] - min[k] - 2.0 * radius));
            let overlaps = grid.any_near(&at, |other| {
                let apart: [f64; D] = std::array::from_fn(|k| at[k] - centres[other as usize][k]);
                let reach = radius + radii[other as usize];
                square(&apart) < reach * reach
            });
            (!overlaps).then_some(at)
        });
        let at = free.ok_or(placed)?;
        centres[ball as usize] = at;
        grid.insert(ball, &at);
    }
    Ok(centres)
}
