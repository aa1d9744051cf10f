//! A house of cards.

use super::pieces::polar;
use super::site::edges;
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A house of cards: in each level pairs that lean on each other, one less than in the level below, and level cards from each pair to the
/// next. Cards are numbered level by level from below, first those that lean, then those that lie.
///
/// Friction must hold it: a card that carries P presses with tan φ (½ + P) to the side where it presses with 1 + P down (φ its lean, P in
/// weights of a card), so a friction of tan φ is always enough on the ground, and between two cards that lean.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CardHouse {
    /// How many levels.
    pub levels: u64,
    /// Length, in space width, and thickness of a card, m.
    #[schemars(length(min = 2, max = 3))]
    pub size: Vec<f64>,
    /// How far cards lean from upright, degrees, less than 30.
    pub degrees: f64,
    /// The gap between the ends of two cards that lie, m; default a quarter of the thickness. Their other ends lie on the pairs.
    pub gap: Option<f64>,
}

impl CardHouse {
    /// The card of a pair that leans to the right, as it stands left of the pair's middle: its upper right corner is there.
    fn leaning(&self) -> Vec<[f64; 2]> {
        let ([length, thickness], _) = edges(&self.size);
        let [cosine, sine] = polar(1.0, self.degrees);
        let foot = [-length * sine, 0.0];
        let back = [-thickness * cosine, thickness * sine];
        let top = [0.0, length * cosine];
        vec![foot, top, [top[0] + back[0], top[1] + back[1]], [foot[0] + back[0], foot[1] + back[1]]]
    }

    /// The height of a level.
    fn rise(&self) -> f64 {
        let ([length, thickness], _) = edges(&self.size);
        let [cosine, sine] = polar(1.0, self.degrees);
        length * cosine + thickness * sine + thickness
    }

    fn gap(&self) -> f64 {
        self.gap.unwrap_or(0.25 * edges(&self.size).0[1])
    }

    fn level(&self, below: u64) -> Vec<Piece> {
        let (size, depth) = edges(&self.size);
        let (pairs, ground) = (self.levels - below, below as f64 * self.rise());
        let middle = |k: f64| (k - 0.5 * (pairs - 1) as f64) * (size[0] + self.gap());
        let leans = self.leaning();
        let pair = |k: u64| {
            let side = |sign: f64| leans.iter().map(|&[x, up]| [middle(k as f64) + sign * x, ground + up]).collect();
            [1.0, -1.0].map(|sign| Piece::prism(side(sign), depth))
        };
        let lies = |k: u64| Piece::block(size, depth, [middle(k as f64 + 0.5), ground + self.rise() - 0.5 * size[1]]);
        (0..pairs).flat_map(pair).chain((0..pairs - 1).map(lies)).collect()
    }
}

impl Builder for CardHouse {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        if !(1..=1000).contains(&self.levels) {
            return Err(site.fault("levels", format!("levels is {}", self.levels), "expected a number from 1 to 1000"));
        }
        site.size("size", &self.size)?;
        let ([length, thickness], _) = edges(&self.size);
        site.between("degrees", self.degrees, (0.0, 30.0), "expected more than 0 and less than 30")?;
        let [cosine, sine] = polar(1.0, self.degrees);
        if 2.0 * (length * sine + thickness * cosine) >= length + self.gap() {
            return Err(site.fault("degrees", "neighbouring pairs of cards overlap", "expected a smaller angle or thinner cards"));
        }
        let room = 2.0 * thickness * cosine;
        if !(self.gap() >= 0.0 && self.gap() < room) {
            let hint = format!("expected 0 or more and less than {room} m, so that both ends lie on the pair");
            return Err(site.fault("gap", format!("gap is {}", self.gap()), hint));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        // Σ (2 m + m − 1) over m = 1 to the number of levels.
        let n = self.levels.min(1 << 20);
        3 * n * (n + 1) / 2 - n
    }

    fn piece(&self, _: u64) -> &'static str {
        "card"
    }

    fn pieces(&self, _: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        Ok((0..self.levels).flat_map(|below| self.level(below)).collect())
    }
}
