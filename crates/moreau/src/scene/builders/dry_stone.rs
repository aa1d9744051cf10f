//! A wall of irregular stones with flat beds.

use super::site::edges;
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use crate::random::Random;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A wall of irregular stones: layers of random heights with level beds, in each stones of random widths whose joints lean. Joints of one
/// layer lie near the middles of the stones below. Stones are numbered layer by layer from below and from lowest x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryStone {
    /// Mean length, in space depth, and mean height of a stone, m. All stones go through the depth.
    #[schemars(length(min = 2, max = 3))]
    pub size: Vec<f64>,
    /// How many layers.
    pub layers: u64,
    /// How many mean lengths a layer is long; every second one has a stone more, as it begins and ends with a short one.
    pub stones: u64,
    /// How far heights and lengths deviate from their means, as a part of these: from 0 (all alike) to less than 1.
    #[serde(default = "DryStone::third")]
    pub irregularity: f64,
    /// The seed; default the place of this builder in the list, from 0.
    pub seed: Option<u64>,
}

impl DryStone {
    fn third() -> f64 {
        0.3
    }

    /// The joints of a layer from end to end, each where it meets the lower and where it meets the upper bed.
    fn joints(&self, layer: u64, random: &mut Random) -> Vec<[f64; 2]> {
        let length = edges(&self.size).0[0];
        let stones = self.stones as f64;
        // Each end of a joint moves by up to half of the irregularity, so that two leave at least what the irregularity leaves of a stone.
        let mut joint = |k: f64| [k; 2].map(|k| length * (k - 0.5 * stones + self.irregularity * (random.unit() - 0.5)));
        let first = if layer.is_multiple_of(2) { 1.0 } else { 0.5 };
        let inner = (0..).map(|k| first + f64::from(k)).take_while(|&k| k < stones);
        let mut joints = vec![[-0.5 * stones * length; 2]];
        joints.extend(inner.map(&mut joint));
        joints.push([0.5 * stones * length; 2]);
        joints
    }
}

impl Builder for DryStone {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.size("size", &self.size)?;
        site.whole("layers", self.layers, 1)?;
        site.whole("stones", self.stones, 1)?;
        if !(0.0..1.0).contains(&self.irregularity) {
            let hint = "expected a part of the mean size, from 0 to less than 1";
            return Err(site.fault("irregularity", format!("irregularity is {}", self.irregularity), hint));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        self.layers.saturating_mul(self.stones).saturating_add(self.layers / 2)
    }

    fn piece(&self, _: u64) -> &'static str {
        "stone"
    }

    fn pieces(&self, site: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        let [mut heights, mut places, _] = Random::three(self.seed.unwrap_or(site.seed));
        let ([_, mean], depth) = edges(&self.size);
        let mut bed = 0.0;
        let mut pieces = Vec::new();
        for layer in 0..self.layers {
            let top = bed + mean * (1.0 + self.irregularity * (2.0 * heights.unit() - 1.0));
            let joints = self.joints(layer, &mut places);
            let stone = |pair: &[[f64; 2]]| vec![[pair[0][0], bed], [pair[1][0], bed], [pair[1][1], top], [pair[0][1], top]];
            pieces.extend(joints.windows(2).map(|pair| Piece::prism(stone(pair), depth)));
            bed = top;
        }
        Ok(pieces)
    }
}
