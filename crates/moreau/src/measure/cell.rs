//! Parts of space: boxes along the axes and regular grids of them.

use super::MeasureError;

/// A box along the axes; a rectangle in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<const D: usize> {
    /// Its lowest corner, m.
    pub min: [f64; D],
    /// Its highest corner, m.
    pub max: [f64; D],
}

impl<const D: usize> Cell<D> {
    /// The box between two corners (m).
    ///
    /// # Errors
    /// Where a corner is not finite, or the second is not above the first along each axis.
    pub fn new(min: [f64; D], max: [f64; D]) -> Result<Self, MeasureError> {
        for axis in 0..D {
            check_range(axis, [min[axis], max[axis]])?;
        }
        Ok(Self { min, max })
    }

    /// Its volume, m³; its area in the plane, m².
    pub fn volume(&self) -> f64 {
        (0..D).map(|k| self.max[k] - self.min[k]).product()
    }

    /// Whether the point is inside. A point of its lower sides is and one of its upper sides is not, so each point is in one cell of a grid.
    pub fn contains(&self, point: &[f64; D]) -> bool {
        (0..D).all(|k| self.min[k] <= point[k] && point[k] < self.max[k])
    }

    /// The smallest box around both.
    pub(super) fn with(&self, other: &Self) -> Self {
        let pick = |of: fn(f64, f64) -> f64, a: &[f64; D], b: &[f64; D]| std::array::from_fn(|k| of(a[k], b[k]));
        Self { min: pick(f64::min, &self.min, &other.min), max: pick(f64::max, &self.max, &other.max) }
    }

    /// The box around a ball.
    pub(super) fn around(centre: &[f64; D], radius: f64) -> Self {
        Self { min: centre.map(|x| x - radius), max: centre.map(|x| x + radius) }
    }

    /// Whether all of another is inside.
    pub(super) fn holds(&self, other: &Self) -> bool {
        (0..D).all(|k| self.min[k] <= other.min[k] && other.max[k] <= self.max[k])
    }

    /// Whether it has no inside in common with another.
    pub(super) fn misses(&self, other: &Self) -> bool {
        (0..D).any(|k| self.max[k] <= other.min[k] || other.max[k] <= self.min[k])
    }
}

/// Whether an interval (m) along an axis has an inside.
pub(super) fn check_range(axis: usize, [from, to]: [f64; 2]) -> Result<(), MeasureError> {
    let inside = from.is_finite() && to.is_finite() && from < to;
    if inside { Ok(()) } else { Err(MeasureError::Region { axis, from, to }) }
}

/// A box that is divided evenly along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<const D: usize> {
    region: Cell<D>,
    counts: [usize; D],
}

impl<const D: usize> Grid<D> {
    /// `counts` cells along each axis of the region.
    ///
    /// # Errors
    /// Where there is an axis without cells.
    pub fn new(region: Cell<D>, counts: [usize; D]) -> Result<Self, MeasureError> {
        if counts.contains(&0) {
            return Err(MeasureError::NoParts { what: "cells of a grid" });
        }
        Ok(Self { region, counts })
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.counts.iter().product()
    }

    /// Never: each axis has a cell.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Cell `index`; indices run along the first axis first. Neighbours have the very same number for the side that they share.
    pub fn cell(&self, index: usize) -> Cell<D> {
        let at = self.place(index);
        let side = |k: usize, i: usize| {
            let part = i as f64 / self.counts[k] as f64;
            self.region.min[k] * (1.0 - part) + self.region.max[k] * part
        };
        Cell { min: std::array::from_fn(|k| side(k, at[k])), max: std::array::from_fn(|k| side(k, at[k] + 1)) }
    }

    /// Where a cell is along each axis.
    fn place(&self, mut index: usize) -> [usize; D] {
        self.counts.map(|count| {
            let at = index % count;
            index /= count;
            at
        })
    }

    /// The indices of cells that may have something in common with a box.
    pub(super) fn near(&self, other: &Cell<D>) -> impl Iterator<Item = usize> + use<'_, D> {
        // One more on each side, for a side of a cell may be rounded past where the division puts it. Conversion saturates.
        let along =
            |k: usize, x: f64| (x - self.region.min[k]) / (self.region.max[k] - self.region.min[k]) * self.counts[k] as f64;
        let first: [usize; D] = std::array::from_fn(|k| (along(k, other.min[k]) as usize).saturating_sub(1));
        let end: [usize; D] =
            std::array::from_fn(|k| (along(k, other.max[k]) as usize).saturating_add(2).min(self.counts[k]).max(first[k]));
        let block: [usize; D] = std::array::from_fn(|k| end[k] - first[k]);
        (0..block.iter().product()).map(move |mut number| {
            let (mut index, mut stride) = (0, 1);
            for k in 0..D {
                index += (first[k] + number % block[k]) * stride;
                number /= block[k];
                stride *= self.counts[k];
            }
            index
        })
    }
}
