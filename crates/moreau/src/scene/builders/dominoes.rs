//! A row of dominoes.

use super::pieces::{polar, rectangle};
use super::site::edges;
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A row of upright dominoes along x. The origin is below the middle of the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dominoes {
    /// How many.
    pub count: u64,
    /// Thickness, in space width, and height of one, m.
    #[schemars(length(min = 2, max = 3))]
    pub size: Vec<f64>,
    /// The distance from the middle of one to that of the next, m.
    pub spacing: f64,
    /// By how much the first is tilted over its edge towards the next, degrees; default 0.
    #[serde(default)]
    pub tilt_degrees: f64,
}

impl Dominoes {
    /// The first one, turned about the lower edge that is next to the second.
    fn tilted(&self) -> Piece {
        let ([thickness, height], depth) = edges(&self.size);
        let [cosine, sine] = polar(1.0, -self.tilt_degrees);
        let turn = |[x, up]: [f64; 2]| [0.5 * thickness + cosine * x - sine * up, sine * x + cosine * up];
        Piece::prism(rectangle([-thickness, 0.0], [0.0, height]).into_iter().map(turn).collect(), depth)
    }
}

impl Builder for Dominoes {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.whole("count", self.count, 1)?;
        site.size("size", &self.size)?;
        if !(self.spacing >= self.size[0] && self.spacing.is_finite()) {
            let hint = format!("expected at least the thickness of {} m", self.size[0]);
            return Err(site.fault("spacing", format!("spacing is {}", self.spacing), hint));
        }
        if !(0.0..90.0).contains(&self.tilt_degrees) {
            let hint = "expected 0 or more and less than 90";
            return Err(site.fault("tilt_degrees", format!("tilt_degrees is {}", self.tilt_degrees), hint));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        self.count
    }

    fn piece(&self, _: u64) -> &'static str {
        "domino"
    }

    fn pieces(&self, _: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        let (size, depth) = edges(&self.size);
        let upright = |k: u64| Piece::block(size, depth, [k as f64 * self.spacing, 0.5 * size[1]]);
        let domino = |k: u64| if k == 0 && self.tilt_degrees > 0.0 { self.tilted() } else { upright(k) };
        Ok((0..self.count).map(domino).collect())
    }
}
