//! Generators: many balls (in the plane disks) from a few lines.

use super::lattice::Sites;
use super::values::{Angular, Numbers};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Many balls, in the plane disks. The same seed gives the same balls on every machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Generate {
    /// The name of their material.
    pub material: String,
    /// How many; a lattice fills its region where it is not given.
    pub count: Option<u64>,
    /// The seed of all that is random here; default the place of this generator in the list, from 0.
    pub seed: Option<u64>,
    /// Their sizes.
    pub radii: Radii,
    /// Puts them on the sites of a lattice, the lowest layer first. Each generator has either a lattice or a packing.
    pub lattice: Option<Lattice>,
    /// Puts them one after the other at random where they overlap none of this generator's others (random sequential insertion),
    /// the largest first. Beyond about a third of the volume (half of the area in the plane) no more fit.
    pub packing: Option<Packing>,
    /// A velocity that all have, m/s; default zero.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub velocity: Vec<f64>,
    /// A spin that all have, rad/s; default zero.
    pub spin: Option<Angular>,
    /// A random velocity that is added, m/s: of this magnitude, in all directions alike; default zero.
    #[serde(default)]
    pub speed: f64,
}

/// A distribution of radii.
///
/// Radii are drawn one from each of as many equal parts of the distribution as there are balls, in shuffled order, so that even
/// few balls follow it closely; only those of `log_normal` are drawn independently.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Radii {
    /// One radius, m.
    Constant(f64),
    /// Radii spread evenly between two.
    Uniform(Range),
    /// The same mass in each interval of radii of the same length: the number of balls falls with r⁻³, of disks with r⁻².
    UniformMass(Range),
    /// A log-normal distribution, cut off at both ends by drawing again.
    LogNormal(LogNormal),
    /// A grading curve as from sieves: [diameter in m, fraction of the mass that passes], from a fraction of 0 to 1, straight in
    /// between.
    Sieve(Vec<Numbers<2>>),
}

/// Two radii.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// The smallest radius, m.
    pub min: f64,
    /// The largest radius, m.
    pub max: f64,
}

/// A log-normal distribution of radii, by number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LogNormal {
    /// The median radius, m.
    pub median: f64,
    /// The standard deviation of the radius's logarithm.
    pub sigma: f64,
    /// The smallest radius, m.
    pub min: f64,
    /// The largest radius, m.
    pub max: f64,
}

/// A lattice within a region.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lattice {
    /// How the sites lie.
    #[serde(default)]
    pub kind: LatticeKind,
    /// The lowest corner of the region, m; all balls lie inside.
    pub min: Vec<f64>,
    /// The highest corner of the region, m.
    pub max: Vec<f64>,
    /// Distance between neighbouring sites, m; default 1.05 times the largest diameter.
    pub spacing: Option<f64>,
    /// How far each site is moved at random, from 0 to 1: at 1 by up to half the room that two of the largest balls would leave,
    /// so that none overlap.
    #[serde(default)]
    pub jitter: f64,
}

/// How the sites of a lattice lie.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LatticeKind {
    /// In rows and columns.
    #[default]
    Cubic,
    /// Each row in the gaps of the one below; in space, hexagonal close packing with its layers one above the other.
    Hexagonal,
}

/// Random places within a region.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Packing {
    /// The lowest corner of the region, m; all balls lie inside.
    pub min: Vec<f64>,
    /// The highest corner of the region, m.
    pub max: Vec<f64>,
    /// How many places are tried for each ball before the packing is given up.
    #[serde(default = "Packing::thousand")]
    pub tries: u64,
}

impl Packing {
    fn thousand() -> u64 {
        1000
    }
}

/// Where balls are put: what a generator has one of.
pub(super) enum Arrangement<'a> {
    Lattice(&'a Lattice),
    Packing(&'a Packing),
}

impl Arrangement<'_> {
    /// The corners of the region.
    pub(super) fn region(&self) -> (&[f64], &[f64]) {
        match self {
            Arrangement::Lattice(lattice) => (&lattice.min, &lattice.max),
            Arrangement::Packing(packing) => (&packing.min, &packing.max),
        }
    }

    /// Its name in scene files.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Arrangement::Lattice(_) => "lattice",
            Arrangement::Packing(_) => "packing",
        }
    }
}

/// The lattice or the packing; `None` where there is not exactly one.
pub(super) fn arrangement<'a>(lattice: Option<&'a Lattice>, packing: Option<&'a Packing>) -> Option<Arrangement<'a>> {
    match (lattice, packing) {
        (Some(lattice), None) => Some(Arrangement::Lattice(lattice)),
        (None, Some(packing)) => Some(Arrangement::Packing(packing)),
        _ => None,
    }
}

impl Generate {
    /// The lattice or the packing; `None` where there is not exactly one.
    pub(super) fn arrangement(&self) -> Option<Arrangement<'_>> {
        arrangement(self.lattice.as_ref(), self.packing.as_ref())
    }

    /// How many balls in `dimension` dimensions.
    pub(super) fn number(&self, dimension: usize) -> u64 {
        match (self.arrangement(), self.count) {
            (_, Some(count)) => count,
            (Some(Arrangement::Lattice(lattice)), None) => Sites::new(lattice, self.radii.largest(), dimension).count(),
            _ => 0,
        }
    }
}
