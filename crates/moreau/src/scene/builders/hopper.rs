//! A hopper.

use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use crate::scene::spec::MotionKind;
use crate::scene::ShapeSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A hopper: in the plane two plates, in space four around a square, that lean outwards from an opening. The origin is in the middle of
/// the opening.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hopper {
    /// The width of the opening at the bottom, m.
    pub opening: f64,
    /// The width at the top, m.
    pub top: f64,
    /// The height, m. A hopper has either a height or an angle.
    pub height: Option<f64>,
    /// The angle of the plates from the horizontal, degrees.
    pub degrees: Option<f64>,
    /// The thickness of the plates, m.
    pub thickness: f64,
}

impl Hopper {
    fn height(&self) -> f64 {
        let run = 0.5 * (self.top - self.opening);
        self.height.unwrap_or_else(|| self.degrees.map_or(0.0, |degrees| run * libm::tan(degrees.to_radians())))
    }

    /// Inner and outer half widths with their heights. Plates are as thick as given across them, so wider along the horizontal.
    fn rings(&self) -> [[f64; 2]; 4] {
        let (run, height) = (0.5 * (self.top - self.opening), self.height());
        let across = self.thickness * libm::hypot(run, height) / height;
        [
            [0.5 * self.opening, 0.0],
            [0.5 * self.opening + across, 0.0],
            [0.5 * self.top + across, height],
            [0.5 * self.top, height],
        ]
    }
}

impl Builder for Hopper {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.lengths([("opening", self.opening), ("top", self.top), ("thickness", self.thickness)])?;
        if self.top < self.opening {
            let hint = format!("expected at least the opening of {} m", self.opening);
            return Err(site.fault("top", format!("top is {}", self.top), hint));
        }
        site.either(("height", self.height), ("degrees", self.degrees))?;
        if let Some(height) = self.height {
            site.lengths([("height", height)])?;
        }
        if let Some(degrees) = self.degrees {
            site.between("degrees", degrees, (0.0, 90.0), "expected an angle between 0 and 90 degrees")?;
            if self.top == self.opening {
                let hint = "expected a top wider than the opening, or a height";
                return Err(site.fault("top", "an angle of plates that stand upright", hint));
            }
        }
        Ok(())
    }

    fn count(&self, dimension: usize) -> u64 {
        if dimension == 2 { 2 } else { 4 }
    }

    fn motion(&self) -> MotionKind {
        MotionKind::Fixed
    }

    fn piece(&self, _: u64) -> &'static str {
        "plate"
    }

    fn pieces(&self, site: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        let rings = self.rings();
        if site.dimension == 2 {
            return Ok([1.0, -1.0].map(|sign| Piece::prism(rings.map(|[x, up]| [sign * x, up]).to_vec(), None)).into());
        }
        // Neighbouring plates meet in the planes of the square's diagonals. Quarter turns of the first: +x, +y, −x, −y.
        let plate = |[x, y]: [f64; 2]| {
            let corner = move |[half, up]: [f64; 2]| [1.0, -1.0].map(|side| [half * (x - side * y), half * (y + side * x), up]);
            Piece::at_origin(ShapeSpec::polyhedron(rings.into_iter().flat_map(corner)))
        };
        Ok([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].map(plate).into())
    }
}
