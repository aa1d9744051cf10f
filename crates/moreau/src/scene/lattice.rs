//! The sites of a lattice in a region.

use super::generate::{Lattice, LatticeKind};

/// Rounding may not cost a site where the region is a whole number of spacings.
const SLACK: f64 = 1e-9;

/// A lattice in its region, its sites as far from the walls as a ball of half a spacing needs.
///
/// Sites lie in rows along x; rows follow each other along y, layers of them along z. In the plane there is one layer. The
/// hexagonal lattice moves every other row by half a spacing, and every other layer into the hollows of the one below.
pub(super) struct Sites {
    min: [f64; 3],
    /// Lengths of the region; a spacing along z in the plane.
    lengths: [f64; 3],
    spacing: f64,
    hexagonal: bool,
}

impl Sites {
    pub(super) fn new(lattice: &Lattice, largest_radius: f64, dimension: usize) -> Self {
        let spacing = lattice.spacing.unwrap_or(1.05 * 2.0 * largest_radius);
        let (mut min, mut lengths) = ([0.0; 3], [spacing; 3]);
        for k in 0..dimension.min(lattice.min.len()).min(lattice.max.len()) {
            min[k] = lattice.min[k];
            lengths[k] = lattice.max[k] - lattice.min[k];
        }
        Self { min, lengths, spacing, hexagonal: lattice.kind == LatticeKind::Hexagonal }
    }

    /// Distance between sites, m.
    pub(super) fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Distance from row to row and from layer to layer in spacings.
    fn heights(&self) -> [f64; 2] {
        if self.hexagonal { [0.75_f64.sqrt(), (2.0_f64 / 3.0).sqrt()] } else { [1.0, 1.0] }
    }

    /// By how many spacings a layer is moved along y, and a row along x.
    fn shifts(&self, layer: u64, row: u64) -> [f64; 2] {
        if !self.hexagonal {
            return [0.0, 0.0];
        }
        // The hollows of a triangular layer lie half a spacing along x and a third of a row's triangle along y.
        let y = if layer % 2 == 1 { 1.0 / 12.0_f64.sqrt() } else { 0.0 };
        [0.5 * ((layer + row) % 2) as f64, y]
    }

    fn layers(&self) -> u64 {
        fits(self.lengths[2] / self.spacing - 1.0, self.heights()[1])
    }

    fn rows(&self, layer: u64) -> u64 {
        fits(self.lengths[1] / self.spacing - 1.0 - self.shifts(layer, 0)[1], self.heights()[0])
    }

    fn columns(&self, layer: u64, row: u64) -> u64 {
        fits(self.lengths[0] / self.spacing - 1.0 - self.shifts(layer, row)[0], 1.0)
    }

    /// How many sites there are; more than can be counted are `u64::MAX`.
    pub(super) fn count(&self) -> u64 {
        // Layers of either parity are alike, and so are the rows of one layer.
        let in_layer = |layer: u64| {
            let rows = self.rows(layer);
            let even = rows.div_ceil(2).saturating_mul(self.columns(layer, 0));
            even.saturating_add((rows / 2).saturating_mul(self.columns(layer, 1)))
        };
        let layers = self.layers();
        let even = layers.div_ceil(2).saturating_mul(in_layer(0));
        even.saturating_add((layers / 2).saturating_mul(in_layer(1)))
    }

    /// The first `count` sites, row by row and layer by layer.
    pub(super) fn first<const D: usize>(&self, count: usize) -> Vec<[f64; D]> {
        let mut sites = Vec::with_capacity(count.min(usize::try_from(self.count()).unwrap_or(usize::MAX)));
        let [row_height, layer_height] = self.heights();
        for layer in 0..self.layers() {
            for row in 0..self.rows(layer) {
                let [x, y] = self.shifts(layer, row);
                for column in 0..self.columns(layer, row) {
                    if sites.len() == count {
                        return sites;
                    }
                    let place = [column as f64 + x, row as f64 * row_height + y, layer as f64 * layer_height];
                    sites.push(std::array::from_fn(|k| self.min[k] + self.spacing * (place[k] + 0.5)));
                }
            }
        }
        sites
    }
}

/// How many steps of `step` fit into `length`, with the one at its beginning; none where it is negative.
fn fits(length: f64, step: f64) -> u64 {
    if length < -SLACK { 0 } else { (((length.max(0.0) / step) * (1.0 + SLACK) + SLACK) as u64).saturating_add(1) }
}
