//! Thin dark lines where one body ends before another, and along sharp edges.

use super::surface::Surface;

/// Cosine of the angle from which on an edge is sharp.
const SHARP: f32 = 0.85;

/// What outlines know of the owners of a surface.
pub(super) struct Outline {
    /// For each owner how dark its outline is, 0 to 1; less than zero for one without.
    strength: Vec<f32>,
    /// For each owner whether it may have sharp edges.
    edges: Vec<bool>,
}

impl Outline {
    /// Outlines for owners of these radii in pixels, none for a floor, and whether they may have sharp edges. A line is as wide for
    /// a small body as for a large one and would cover it, so it is paler.
    pub(super) fn new(owners: impl Iterator<Item = (Option<f32>, bool)>) -> Self {
        let strength = |radius: f32| 0.8 * ((radius - 1.0) / 9.0).clamp(0.2, 1.0);
        let (strength, edges) = owners.map(|(r, edges)| (r.map_or(-1.0, strength), edges)).unzip();
        Self { strength, edges }
    }

    pub(super) fn has_edges(&self, owner: u32) -> bool {
        self.edges.get(owner as usize).is_some_and(|&e| e)
    }

    /// How dark the line through a sample is; 0 for none.
    pub(super) fn at(&self, surface: &Surface, x: usize, y: usize) -> f32 {
        let [width, height] = surface.size;
        let own = y * width + x;
        let mut dark = 0.0_f32;
        if x > 0 {
            dark = dark.max(self.between(surface, own, own - 1));
        }
        if x + 1 < width {
            dark = dark.max(self.between(surface, own, own + 1));
        }
        if y > 0 {
            dark = dark.max(self.between(surface, own, own - width));
        }
        if y + 1 < height {
            dark = dark.max(self.between(surface, own, own + width));
        }
        dark
    }

    fn between(&self, surface: &Surface, a: usize, b: usize) -> f32 {
        let strength = |owner: u32| self.strength.get(owner as usize).copied().unwrap_or(-1.0);
        if surface.owner[a] == surface.owner[b] {
            let bent = self.has_edges(surface.owner[a]) && surface.normal(a).dot(surface.normal(b)) < SHARP;
            return if bent { 0.6 * strength(surface.owner[a]) } else { 0.0 };
        }
        let nearer = if surface.depth[a] >= surface.depth[b] { a } else { b };
        strength(surface.owner[nearer])
    }
}
