//! A column of drums.

use super::pieces::polar;
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use crate::scene::ShapeSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A column of equal drums, one on the other, numbered from below.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// How many drums.
    pub drums: u64,
    /// The height of the whole column, m.
    pub height: f64,
    /// Drums are regular prisms with this radius to their corners, m; in space. A column has either a radius or a width.
    pub radius: Option<f64>,
    /// How many sides such a prism has; default 12. One of them looks along x.
    #[serde(default = "Column::dozen")]
    pub sides: u64,
    /// Drums are blocks of this width along x, m.
    pub width: Option<f64>,
    /// The depth of blocks along y, m; default the width; only in space.
    pub depth: Option<f64>,
}

impl Column {
    fn dozen() -> u64 {
        12
    }

    fn drum(&self, k: u64, site: &Site<'_>) -> Piece {
        let bed = |k: u64| self.height * (k as f64 / self.drums as f64);
        let (low, high) = (bed(k), bed(k + 1));
        let Some(radius) = self.radius else {
            let width = self.width.unwrap_or(0.0);
            let depth = (site.dimension == 3).then(|| self.depth.unwrap_or(width));
            return Piece::block([width, high - low], depth, [0.0, 0.5 * (low + high)]);
        };
        let sides = self.sides;
        let corner = |i: u64| polar(radius, 360.0 * (i as f64 + 0.5) / sides as f64);
        Piece::at_origin(ShapeSpec::polyhedron([low, high].into_iter().flat_map(|up| (0..sides).map(corner).map(move |[x, y]| [x, y, up]))))
    }
}

impl Builder for Column {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.whole("drums", self.drums, 1)?;
        site.lengths([("height", self.height)])?;
        site.either(("radius", self.radius), ("width", self.width))?;
        if let Some(width) = self.width {
            site.lengths([("width", width)])?;
        }
        if let Some(radius) = self.radius {
            site.lengths([("radius", radius)])?;
            if site.dimension == 2 {
                return Err(site.fault("radius", "a radius where dimension = 2", "expected a width"));
            }
        }
        if self.depth.is_some() {
            site.across("depth", self.depth)?;
            site.either(("radius", self.radius), ("depth", self.depth))?;
        }
        if !(3..=360).contains(&self.sides) {
            return Err(site.fault("sides", format!("sides is {}", self.sides), "expected a number from 3 to 360"));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        self.drums
    }

    fn piece(&self, _: u64) -> &'static str {
        "drum"
    }

    fn pieces(&self, site: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        Ok((0..self.drums).map(|k| self.drum(k, site)).collect())
    }
}
