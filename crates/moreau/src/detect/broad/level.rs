//! One level of the grid: its cells and where they are hashed to.

/// How many levels there can be; what is smaller than the largest ball by more powers of two shares the last.
pub(super) const LEVELS: usize = 64;

/// Coordinates of cells are clamped here: up to it their rounding stays well within `MARGIN`. Clamping only brings cells
/// together, so nothing is lost by it.
const FARTHEST_CELL: f64 = (1_u64 << 41) as f64;

/// By what fraction cells are wider than the widest ball, so that rounding never puts balls that touch two cells apart.
const MARGIN: f64 = 1.0 / 256.0;

/// Strides of the hash as fractions of the table: powers of the inverse of the plastic number (x³ = x + 1), which spread the
/// columns of a block of cells evenly.
const SPREAD: [f64; 2] = [0.569_840_290_998_053_2, 0.754_877_666_246_692_7];

/// One level.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level<const D: usize> {
    /// Where its table begins among those of all levels.
    pub(super) table: u32,
    /// Size of its table, a power of two, less one.
    pub(super) mask: u32,
    /// Half the width of its cells, m.
    pub(super) half_cell: f64,
    per_metre: f64,
    strides: [u32; D],
    columns: [u32; 4],
    column_count: usize,
}

/// By how many powers of two a ball is smaller than the largest.
#[inline]
pub(super) fn rank(largest: f64, radius: f64) -> usize {
    let ratio = largest / radius; // 1 or more, or not a number if all radii are zero
    let exponent = (ratio.to_bits() >> 52) as usize;
    exponent.saturating_sub(1023).min(LEVELS - 1)
}

impl<const D: usize> Level<D> {
    /// A level for `count` balls of radius `widest` (m) or less, its table beginning at `table`.
    pub(super) fn new(count: usize, widest: f64, table: u32) -> Self {
        let size = (2 * count).next_power_of_two().max(64);
        // Far above the smallest number, or its inverse overflows.
        let half_cell = (widest * (1.0 + MARGIN)).max(1e-300);
        let mut strides = [1; D];
        for axis in 0..D - 1 {
            // Odd, so that a column reaches every bucket.
            strides[axis] = (SPREAD[axis + 3 - D] * size as f64) as u32 | 1;
        }
        let (columns, column_count) = half_neighbourhood(&strides);
        let per_metre = 0.5 / half_cell;
        Self { table, mask: size as u32 - 1, half_cell, per_metre, strides, columns, column_count }
    }

    /// The cell that holds a point.
    #[inline]
    pub(super) fn cell(&self, point: [f64; D]) -> [i64; D] {
        point.map(|x| {
            let scaled = (x * self.per_metre).clamp(-FARTHEST_CELL, FARTHEST_CELL);
            let towards_zero = scaled as i64;
            towards_zero - i64::from(scaled < towards_zero as f64)
        })
    }

    /// Bucket of a cell, in the level's table.
    #[inline]
    pub(super) fn bucket(&self, cell: [i64; D]) -> u32 {
        let mut hash = 0_u32;
        for axis in 0..D {
            hash = hash.wrapping_add((cell[axis] as u32).wrapping_mul(self.strides[axis]));
        }
        hash & self.mask
    }

    /// Offsets, modulo the table, from a cell's bucket to the first of three cells in each of half the columns around.
    #[inline]
    pub(super) fn columns(&self) -> &[u32] {
        &self.columns[..self.column_count]
    }
}

/// One of each two opposite neighbouring columns: the one whose first step off the axis is upwards.
fn half_neighbourhood<const D: usize>(strides: &[u32; D]) -> ([u32; 4], usize) {
    let mut offsets = [0; 4];
    let mut count = 0;
    let around = 3_i32.pow(D as u32 - 1);
    // Digits −1, 0, 1 of a ternary number; those after the middle one, which is the column itself, are the upper half.
    for code in around / 2 + 1..around {
        let (mut digits, mut offset) = (code, u32::MAX); // one below in the column
        for &stride in &strides[..D - 1] {
            offset = offset.wrapping_add(((digits % 3 - 1) as u32).wrapping_mul(stride));
            digits /= 3;
        }
        offsets[count] = offset;
        count += 1;
    }
    (offsets, count)
}
