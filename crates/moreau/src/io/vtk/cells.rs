//! Cells of several points: lines and polygons.

/// Lists of points, one a cell, one list after the other in the same memory.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cells {
    points: Vec<usize>,
    ends: Vec<usize>,
}

/// No cells at all.
pub(super) static NONE: Cells = Cells { points: Vec::new(), ends: Vec::new() };

impl Cells {
    /// Adds a cell with these points, in order along the line or around the polygon.
    pub fn push(&mut self, points: impl IntoIterator<Item = usize>) {
        self.points.extend(points);
        self.ends.push(self.points.len());
    }

    /// Takes all cells out and keeps the memory.
    pub fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The points of all cells in a row.
    pub fn points(&self) -> &[usize] {
        &self.points
    }

    /// Where each cell ends in that row.
    pub fn ends(&self) -> &[usize] {
        &self.ends
    }
}

impl<C: IntoIterator<Item = usize>> FromIterator<C> for Cells {
    fn from_iter<I: IntoIterator<Item = C>>(cells: I) -> Self {
        let mut all = Self::default();
        cells.into_iter().for_each(|cell| all.push(cell));
        all
    }
}
