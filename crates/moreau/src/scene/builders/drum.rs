//! A rotating drum.

use super::pieces::{extruded, polar, prism};
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use crate::scene::{MotionKind, PartSpec, ShapeSpec};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A drum of plates around an axis, in space along y: one body, driven. The origin is in the middle of the axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Drum {
    /// The inner radius, to the corners, m.
    pub radius: f64,
    /// The inner length along the axis, m; only in space.
    pub length: Option<f64>,
    /// The thickness of the plates, m, at the corners.
    pub thickness: f64,
    /// How many plates there are around; default 36.
    #[serde(default = "Drum::three_dozen")]
    pub sides: u64,
    /// Whether plates close both ends; in space; default no.
    #[serde(default)]
    pub closed: bool,
    /// Its spin, rad/s: from x towards up, with y into the picture. Default 0.
    #[serde(default)]
    pub spin: f64,
}

impl Drum {
    fn three_dozen() -> u64 {
        36
    }

    /// The corners of a regular polygon around the axis, two of them at the same height below.
    fn corner(&self, radius: f64, k: u64) -> [f64; 2] {
        let part = (k % self.sides) as f64 + 0.5;
        polar(radius, 360.0 * part / self.sides as f64 - 90.0)
    }

    fn plate(&self, k: u64) -> ShapeSpec {
        let rings = [self.radius, self.radius + self.thickness];
        let [[inner, next_inner], [outer, next_outer]] = rings.map(|radius| [k, k + 1].map(|k| self.corner(radius, k)));
        prism(vec![inner, outer, next_outer, next_inner], self.length)
    }

    /// The plates at both ends, outside of the length.
    fn ends(&self) -> impl Iterator<Item = ShapeSpec> {
        let outside: Vec<_> = (0..self.sides).map(|k| self.corner(self.radius + self.thickness, k)).collect();
        let half = self.length.filter(|_| self.closed).map(|length| 0.5 * length);
        half.into_iter().flat_map(move |half| {
            [-1.0, 1.0].map(|sign: f64| extruded(&outside, [sign * half, sign * (half + self.thickness)]))
        })
    }
}

impl Builder for Drum {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.lengths([("radius", self.radius), ("thickness", self.thickness)])?;
        site.across("length", self.length)?;
        if !(3..=1000).contains(&self.sides) {
            return Err(site.fault("sides", format!("sides is {}", self.sides), "expected a number from 3 to 1000"));
        }
        if self.closed && site.dimension == 2 {
            return Err(site.fault("closed", "closed ends where dimension = 2", "leave it out"));
        }
        if !self.spin.is_finite() {
            return Err(site.fault("spin", format!("spin is {}", self.spin), "expected a finite number, in rad/s"));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        1
    }

    fn motion(&self) -> MotionKind {
        MotionKind::Driven
    }

    fn spin(&self) -> f64 {
        self.spin
    }

    fn piece(&self, _: u64) -> &'static str {
        "drum"
    }

    fn pieces(&self, _: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        let part = |shape| PartSpec { shape, position: Vec::new(), orientation: None };
        let parts = (0..self.sides).map(|k| self.plate(k)).chain(self.ends()).map(part).collect();
        Ok(vec![Piece::at_origin(ShapeSpec::Compound { parts })])
    }
}
