//! A hemispherical dome of voussoirs.

use super::pieces::polar;
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use crate::scene::ShapeSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A half sphere of stones in rings. A stone is the convex hull of its eight corners on two spheres: its sides lie in two planes through the
/// axis, its beds in planes through the centre, so that neighbours share whole faces; all rings have their joints above each other. Stones are
/// numbered ring by ring from below, each from x towards y; a keystone comes last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dome {
    /// How many rings, without the keystone.
    pub courses: u64,
    /// How many stones a ring has.
    pub stones: u64,
    /// The mean radius, half-way through the stones, m.
    pub radius: f64,
    /// The distance of the two spheres, m.
    pub thickness: f64,
    /// The radius of the opening at the top, measured inside to the corners, m; default 0: a keystone closes the dome.
    #[serde(default)]
    pub oculus: f64,
}

impl Dome {
    fn spheres(&self) -> [f64; 2] {
        [self.radius - 0.5 * self.thickness, self.radius + 0.5 * self.thickness]
    }

    /// The sine and cosine of the latitude of bed `k`, that below ring `k`.
    fn latitude(&self, k: u64) -> [f64; 2] {
        if k == 0 {
            // The dome stands on the ground exactly.
            return [0.0, 1.0];
        }
        let part = if self.oculus > 0.0 {
            libm::acos(self.oculus / self.spheres()[0]).to_degrees() / self.courses as f64
        } else {
            // The keystone is as wide as a ring is high.
            90.0 / (self.courses as f64 + 0.5)
        };
        let [cosine, sine] = polar(1.0, part * k as f64);
        [sine, cosine]
    }

    /// The corner on bed `k` and meridian `i`, at the distance of a sphere.
    fn corner(&self, k: u64, i: u64, sphere: f64) -> [f64; 3] {
        let [sine, cosine] = self.latitude(k);
        let [x, y] = polar(1.0, 360.0 * (i % self.stones) as f64 / self.stones as f64);
        [cosine * x, cosine * y, sine].map(|part| sphere * part)
    }

    fn stone(&self, course: u64, i: u64) -> Piece {
        let ends = |sphere: f64| [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(bed, side)| self.corner(course + bed, i + side, sphere));
        Piece::at_origin(ShapeSpec::polyhedron(self.spheres().into_iter().flat_map(ends)))
    }

    fn keystone(&self) -> Piece {
        let ring = |sphere: f64| (0..self.stones).map(move |i| self.corner(self.courses, i, sphere));
        Piece::at_origin(ShapeSpec::polyhedron(self.spheres().into_iter().flat_map(ring)))
    }

    fn is_closed(&self) -> bool {
        self.oculus == 0.0
    }
}

impl Builder for Dome {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.whole("courses", self.courses, 1)?;
        site.whole("stones", self.stones, 3)?;
        site.lengths([("radius", self.radius), ("thickness", self.thickness)])?;
        if self.thickness >= 2.0 * self.radius {
            let hint = format!("expected less than twice the mean radius of {} m", self.radius);
            return Err(site.fault("thickness", format!("thickness is {}", self.thickness), hint));
        }
        if !(self.oculus >= 0.0 && self.oculus < self.spheres()[0]) {
            let hint = format!("expected 0 for a keystone, or less than the inner radius of {} m", self.spheres()[0]);
            return Err(site.fault("oculus", format!("oculus is {}", self.oculus), hint));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        self.courses.saturating_mul(self.stones).saturating_add(u64::from(self.is_closed()))
    }

    fn piece(&self, number: u64) -> &'static str {
        if number < self.courses.saturating_mul(self.stones) { "voussoir" } else { "keystone" }
    }

    fn pieces(&self, _: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        let stones = (0..self.courses).flat_map(|course| (0..self.stones).map(move |i| self.stone(course, i)));
        Ok(stones.chain(self.is_closed().then(|| self.keystone())).collect())
    }
}
