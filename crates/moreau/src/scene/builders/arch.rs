//! An arch of voussoirs around a circle.

use super::pieces::polar;
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An arch of equal stones around a circle, whose sides between the joints are straight. The lowest corners of its feet stand at height 0;
/// stones are numbered from the foot of highest x, springers after them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Arch {
    /// How many stones, 2 or more.
    pub stones: u64,
    /// The mean radius, half-way through the stones, m. An arch has either a radius or a span.
    pub radius: Option<f64>,
    /// The clear span between its feet, m.
    pub span: Option<f64>,
    /// The thickness of the ring, m.
    pub thickness: f64,
    /// The depth along y, m; only in space.
    pub depth: Option<f64>,
    /// How the joints run.
    #[serde(default)]
    pub joints: Joints,
    /// The angle that it embraces, degrees, up to a half circle; default 180.
    #[serde(default = "Arch::half_circle")]
    pub degrees: f64,
    /// What it stands on.
    #[serde(default)]
    pub springers: Springers,
}

/// How the joints of an arch run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Joints {
    /// Towards the centre of the circle.
    #[default]
    Radial,
    /// Straight up; the feet of a half circle are level all the same.
    Vertical,
}

/// What an arch stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Springers {
    /// On whatever lies below its feet, which must be level: a half circle.
    #[default]
    Ground,
    /// On two fixed blocks, one below each foot.
    Fixed,
}

impl Arch {
    fn half_circle() -> f64 {
        180.0
    }

    fn is_half_circle(&self) -> bool {
        self.degrees == 180.0
    }

    /// The angle of joint `k` from x, in degrees.
    fn angle(&self, k: u64) -> f64 {
        90.0 - 0.5 * self.degrees + self.degrees * (k as f64 / self.stones as f64)
    }

    fn mean_radius(&self) -> f64 {
        let foot = polar(1.0, self.angle(0))[0];
        let from_span = |span: f64| match self.joints {
            Joints::Vertical if !self.is_half_circle() => 0.5 * span / foot,
            _ => 0.5 * span / foot + 0.5 * self.thickness,
        };
        self.radius.unwrap_or_else(|| self.span.map_or(0.0, from_span))
    }

    /// The inner and the outer end of joint `k` about the centre. The left half is the mirror image of the right one.
    fn joint(&self, k: u64) -> [[f64; 2]; 2] {
        if 2 * k > self.stones {
            return self.joint(self.stones - k).map(|[x, up]| [-x, up]);
        }
        let radius = self.mean_radius();
        let rings = [radius - 0.5 * self.thickness, radius + 0.5 * self.thickness];
        match self.joints {
            // Feet stand on the ground exactly.
            _ if k == 0 && self.is_half_circle() => rings.map(|r| [r, 0.0]),
            Joints::Radial => rings.map(|r| polar(r, self.angle(k))),
            Joints::Vertical => {
                let x = polar(radius, self.angle(k))[0];
                rings.map(|r| [x, ((r - x) * (r + x)).sqrt()])
            }
        }
    }

    /// The block that carries the foot at the right, as thick as the ring.
    fn springer(&self) -> Vec<[f64; 2]> {
        let [inner, outer] = self.joint(0);
        // Out of the stone, perpendicular to its foot.
        let length = libm::hypot(outer[0] - inner[0], outer[1] - inner[1]);
        let [x, up] = [0, 1].map(|k| self.thickness * (outer[k] - inner[k]) / length);
        let below = |p: [f64; 2]| [p[0] + up, p[1] - x];
        vec![inner, below(inner), below(outer), outer]
    }
}

impl Builder for Arch {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.whole("stones", self.stones, 2)?;
        site.either(("radius", self.radius), ("span", self.span))?;
        self.radius.map_or(Ok(()), |radius| site.lengths([("radius", radius)]))?;
        self.span.map_or(Ok(()), |span| site.lengths([("span", span)]))?;
        site.lengths([("thickness", self.thickness)])?;
        site.across("depth", self.depth)?;
        if !(self.degrees > 0.0 && self.degrees <= 180.0) {
            return Err(site.fault("degrees", format!("degrees is {}", self.degrees), "expected more than 0 and at most 180"));
        }
        if self.springers == Springers::Ground && !self.is_half_circle() {
            let hint = "expected springers = \"fixed\": only a half circle has level feet";
            return Err(site.fault("degrees", format!("an arch of {} degrees on level ground", self.degrees), hint));
        }
        let radius = self.mean_radius();
        if 2.0 * radius <= self.thickness {
            let hint = format!("expected less than twice the mean radius of {radius} m");
            return Err(site.fault("thickness", format!("thickness is {}", self.thickness), hint));
        }
        // The first vertical joint must cross the ring from side to side.
        let x = polar(radius, self.angle(u64::from(self.is_half_circle())))[0];
        if self.joints == Joints::Vertical && x >= radius - 0.5 * self.thickness {
            let hint = "expected fewer stones, a thinner ring, or radial joints";
            return Err(site.fault("joints", "the outermost vertical joint misses the inner side of the ring", hint));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        self.stones.saturating_add(self.held())
    }

    fn held(&self) -> u64 {
        if self.springers == Springers::Fixed { 2 } else { 0 }
    }

    fn piece(&self, number: u64) -> &'static str {
        if number < self.stones { "voussoir" } else { "springer" }
    }

    fn pieces(&self, _: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        let ground = self.joint(0)[0][1];
        let place = |profile: Vec<[f64; 2]>| {
            Piece::prism(profile.into_iter().map(|[x, up]| [x, up - ground]).collect(), self.depth)
        };
        let voussoir = |k: u64| {
            let ([inner, outer], [next_inner, next_outer]) = (self.joint(k), self.joint(k + 1));
            place(vec![inner, outer, next_outer, next_inner])
        };
        let mut pieces: Vec<Piece> = (0..self.stones).map(voussoir).collect();
        if self.springers == Springers::Fixed {
            let right = self.springer();
            let left = right.iter().map(|&[x, up]| [-x, up]).collect();
            pieces.extend([right, left].map(place));
        }
        Ok(pieces)
    }
}
