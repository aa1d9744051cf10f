//! Round arches side by side on piers, level on top.

use super::pieces::{polar, rectangle};
use super::{Builder, Piece, Site};
use crate::scene::error::Fault;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Half-circular arches side by side on piers. Joints are radial; the stones reach up to a level top and sideways to the middle of the piers
/// (at both ends to the outer side), so that courses can be laid on them: an aqueduct. Blocks of the piers come first, from lowest x and from
/// below, then the stones of the arches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Arcade {
    /// How many arches.
    pub arches: u64,
    /// How many stones an arch has, 2 or more.
    pub stones: u64,
    /// The clear span of an arch, m.
    pub span: f64,
    /// The width of a pier, m.
    pub pier: f64,
    /// The height of a pier, m.
    pub height: f64,
    /// Of how many blocks a pier is built.
    pub blocks: u64,
    /// The height of the top above the piers, m: more than half the span.
    pub level: f64,
    /// The depth along y, m; only in space.
    pub depth: Option<f64>,
}

/// What of the top's height is too little to tell two corners apart.
const ROUNDING: f64 = 1e-9;

impl Arcade {
    fn pier_blocks(&self) -> u64 {
        self.arches.saturating_add(1).saturating_mul(self.blocks)
    }

    /// The middle of pier `k`, that left of arch `k`.
    fn middle(&self, k: u64) -> f64 {
        (k as f64 - 0.5 * self.arches as f64) * (self.span + self.pier)
    }

    fn block(&self, pier: u64, k: u64) -> Piece {
        let (x, blocks) = (self.middle(pier), self.blocks as f64);
        let sides = [x - 0.5 * self.pier, x + 0.5 * self.pier];
        let beds = [k as f64, (k + 1) as f64].map(|k| self.height * (k / blocks));
        Piece::prism(rectangle(sides, beds), self.depth)
    }

    /// The stones of an arch from its right foot, about the middle of its span at the height of the piers.
    fn profiles(&self, arch: u64) -> Vec<Vec<[f64; 2]>> {
        let inner = 0.5 * self.span;
        let reach = |is_end: bool| inner + if is_end { self.pier } else { 0.5 * self.pier };
        let sides = [reach(arch + 1 == self.arches), reach(arch == 0)];
        // Inner and outer end of a joint; the left half is mirrored from the right one.
        let joint = |k: u64| {
            let (k, side, sign) =
                if 2 * k > self.stones { (self.stones - k, sides[1], -1.0) } else { (k, sides[0], 1.0) };
            let [cosine, sine] = if k == 0 { [1.0, 0.0] } else { polar(1.0, 180.0 * k as f64 / self.stones as f64) };
            let outer = if side * sine < self.level * cosine {
                [side, side * sine / cosine]
            } else {
                [self.level * cosine / sine, self.level]
            };
            [[inner * cosine, inner * sine], outer].map(|[x, up]| [sign * x, up])
        };
        let corners = [[sides[0], self.level], [-sides[1], self.level]];
        let apart = |p: [f64; 2], q: [f64; 2]| libm::hypot(p[0] - q[0], p[1] - q[1]) > ROUNDING * self.level;
        let profile = |k: u64| {
            let ([inner, outer], [next_inner, next_outer]) = (joint(k), joint(k + 1));
            let mut profile = vec![inner, outer];
            // Corners of the rectangle that lie between the two joints.
            let between = |&[x, up]: &[f64; 2]| outer[0] * up - outer[1] * x > 0.0 && x * next_outer[1] - up * next_outer[0] > 0.0;
            profile.extend(corners.into_iter().filter(between).filter(|&corner| apart(corner, outer) && apart(corner, next_outer)));
            profile.extend([next_outer, next_inner]);
            profile
        };
        (0..self.stones).map(profile).collect()
    }
}

impl Builder for Arcade {
    fn check(&self, site: &Site<'_>) -> Result<(), Fault> {
        site.whole("arches", self.arches, 1)?;
        site.whole("stones", self.stones, 2)?;
        site.whole("blocks", self.blocks, 1)?;
        site.lengths([("span", self.span), ("pier", self.pier), ("height", self.height), ("level", self.level)])?;
        site.across("depth", self.depth)?;
        if self.level <= 0.5 * self.span {
            let hint = format!("expected more than half the span, {} m: the top lies above the arches", 0.5 * self.span);
            return Err(site.fault("level", format!("level is {}", self.level), hint));
        }
        Ok(())
    }

    fn count(&self, _: usize) -> u64 {
        self.pier_blocks().saturating_add(self.arches.saturating_mul(self.stones))
    }

    fn piece(&self, number: u64) -> &'static str {
        if number < self.pier_blocks() { "block" } else { "voussoir" }
    }

    fn pieces(&self, _: &Site<'_>) -> Result<Vec<Piece>, Fault> {
        let blocks = (0..=self.arches).flat_map(|pier| (0..self.blocks).map(move |k| self.block(pier, k)));
        let stones = (0..self.arches).flat_map(|arch| {
            let middle = 0.5 * (self.middle(arch) + self.middle(arch + 1));
            let place = move |profile: Vec<[f64; 2]>| profile.into_iter().map(|[x, up]| [middle + x, self.height + up]).collect();
            self.profiles(arch).into_iter().map(move |profile| Piece::prism(place(profile), self.depth))
        });
        Ok(blocks.chain(stones).collect())
    }
}
