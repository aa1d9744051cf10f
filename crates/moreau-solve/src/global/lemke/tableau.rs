//! The dense tableau of Lemke's method: what is in the basis, written in what is not.

use super::{Lcp, ROUNDING, TIE, ZERO};

/// Its multiples fill the line between zero and one evenly.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// x_B = b + T x_N. Unknowns are numbered y first, then x, then z.
pub(super) struct Tableau {
    size: usize,
    /// T by rows, with b as the last column.
    rows: Vec<f64>,
    /// The unknown of each row, and of each column.
    basic: Vec<usize>,
    others: Vec<usize>,
}

impl Tableau {
    /// With y in the basis and z = 0. The covering vector e is of ones in the first attempt, and then of numbers between one and two that
    /// look like random ones.
    pub(super) fn new(lcp: &Lcp, attempt: u32) -> Self {
        let cover = |i: usize| 1.0 + (f64::from(attempt) * GOLDEN * (i + 1) as f64).fract();
        let n = lcp.size;
        let mut rows = Vec::with_capacity(n * (n + 2));
        for (i, (m, b)) in lcp.m.chunks_exact(n.max(1)).zip(&lcp.b).enumerate() {
            rows.extend_from_slice(m);
            rows.extend([cover(i), *b]);
        }
        Self { size: n, rows, basic: (0..n).collect(), others: (n..=2 * n).collect() }
    }

    fn row(&self, i: usize) -> &[f64] {
        &self.rows[i * (self.size + 2)..(i + 1) * (self.size + 2)]
    }

    fn constant(&self, i: usize) -> f64 {
        self.row(i)[self.size + 1]
    }

    /// Raises z until no constant is negative. The column that enters next, or `None` where nothing has to.
    pub(super) fn first(&mut self) -> Option<usize> {
        // Of equal ones the last: it is the least in the lexicographic order.
        let level = |i: usize| self.constant(i) / self.row(i)[self.size];
        let row = (0..self.size).rev().min_by(|&i, &j| level(i).total_cmp(&level(j)))?;
        if self.constant(row) >= 0.0 {
            return None;
        }
        self.pivot(row, self.size);
        self.complement(self.size)
    }

    /// The column of the complement of what has just left the basis by this column; `None` if that was z.
    pub(super) fn complement(&self, column: usize) -> Option<usize> {
        let left = self.others[column];
        let wanted = if left < self.size { left + self.size } else { left.wrapping_sub(self.size) };
        if left == 2 * self.size { None } else { self.others.iter().position(|&other| other == wanted) }
    }

    /// The row whose unknown first falls to zero as the column's rises; `None` where none does: a ray.
    pub(super) fn leaving(&self, column: usize) -> Option<usize> {
        let greatest = (0..self.size).map(|i| self.row(i)[column].abs()).fold(0.0, f64::max);
        let ratio = |i: usize| self.constant(i).max(0.0) / -self.row(i)[column];
        let falling: Vec<usize> = (0..self.size).filter(|&i| self.row(i)[column] < -ZERO * greatest).collect();
        let least = falling.iter().map(|&i| ratio(i)).fold(f64::INFINITY, f64::min);
        let tied = falling.into_iter().filter(|&i| ratio(i) <= least * (1.0 + TIE));
        // z leaves whenever it may: then all is solved.
        tied.min_by(|&i, &j| {
            let is_z = |i: usize| self.basic[i] != 2 * self.size;
            is_z(i).cmp(&is_z(j)).then_with(|| self.lexicographic(i, j, column))
        })
    }

    /// Compares the rows of B⁻¹, each divided by its entry in the column.
    fn lexicographic(&self, i: usize, j: usize, column: usize) -> std::cmp::Ordering {
        let mut places = vec![None; self.size];
        for (k, &other) in self.others.iter().enumerate().filter(|(_, other)| **other < self.size) {
            places[other] = Some(k);
        }
        let entry = |row: usize, y: usize| {
            let value = places[y].map_or(f64::from(u8::from(self.basic[row] == y)), |k: usize| -self.row(row)[k]);
            value / -self.row(row)[column]
        };
        let differ = |y: usize| (entry(i, y) - entry(j, y)).abs() > TIE * (entry(i, y).abs() + entry(j, y).abs());
        (0..self.size).find(|&y| differ(y)).map_or(i.cmp(&j), |y| entry(i, y).total_cmp(&entry(j, y)))
    }

    /// Exchanges the unknowns of a row and a column.
    pub(super) fn pivot(&mut self, row: usize, column: usize) {
        let width = self.size + 2;
        let mut pivot_row = self.row(row).to_vec();
        let scale = -1.0 / pivot_row[column];
        pivot_row[column] = -1.0;
        pivot_row.iter_mut().for_each(|x| *x *= scale);
        for (i, other) in self.rows.chunks_exact_mut(width).enumerate() {
            let factor = std::mem::take(&mut other[column]);
            if i == row {
                other.copy_from_slice(&pivot_row);
            } else if factor != 0.0 {
                let before = other[width - 1];
                other.iter_mut().zip(&pivot_row).for_each(|(x, y)| *x += factor * y);
                if other[width - 1].abs() <= ROUNDING * before.abs() {
                    other[width - 1] = 0.0;
                }
            }
        }
        std::mem::swap(&mut self.basic[row], &mut self.others[column]);
    }

    /// x, of which what is not in the basis is zero.
    pub(super) fn values(&self) -> Vec<f64> {
        let mut x = vec![0.0; self.size];
        for (i, &unknown) in self.basic.iter().enumerate() {
            if (self.size..2 * self.size).contains(&unknown) {
                x[unknown - self.size] = self.constant(i).max(0.0);
            }
        }
        x
    }
}
