//! How much room bodies get before the list of nearby pairs must be made anew.
//!
//! A body's skin is what it would travel, at the pace of late, until the list is to be made again, and for one at rest, which may
//! be hit, a part of a radius. More skin means a longer list to go through at each call, less means making it more often. For how
//! many calls skins are made follows from the pace of all bodies, the part of a radius from how long lists did last.

use super::bound::{Bound, Hold, square_between};

/// For how many calls skins may be made. For fewer than the last a skin is not worth its pairs, and there is none.
const CALLS: [f64; 7] = [24.0, 17.0, 12.0, 8.0, 5.0, 3.0, 2.0];

/// By how much skins may make the balls grow, in volume and on average: pairs grow alike.
const GROWTH: f64 = 2.5;

/// A skin in parts of what a body would travel at the pace of late.
const AHEAD: f64 = 1.25;

/// The smallest and the largest part of a radius that a body at rest gets, and the factor between two tries.
const REST: [f64; 2] = [0.02, 0.4];
const TRY: f64 = 1.25;

/// How many calls a list should last: where it lasts less or more, skins of bodies at rest are made thicker or thinner.
const LASTING: [u32; 2] = [10, 30];

/// The skins of one making of the list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Skins {
    /// Skin of a body at rest, as a part of its radius.
    rest: f64,
    /// For how many calls they are made.
    calls: f64,
    /// Mean radius of all bounded bodies, m.
    mean: f64,
}

impl Default for Skins {
    fn default() -> Self {
        Self { rest: 0.2, calls: CALLS[0], mean: 0.0 }
    }
}

impl Skins {
    /// Adapts to how bodies moved from where they were held and to how many calls that lasted.
    pub(super) fn adapt<const D: usize>(&mut self, holds: &[Hold<D>], lasted: u32, bounds: &[Bound<D>]) {
        if (1..LASTING[0]).contains(&lasted) {
            self.rest = (self.rest * TRY).min(REST[1]);
        } else if lasted > LASTING[1] {
            self.rest = (self.rest / TRY).max(REST[0]);
        }
        let all = bounds.len() as f64;
        let mut volumes = [0.0; CALLS.len()];
        let (mut sum, mut count) = (0.0, 0.0);
        for (hold, bound) in holds.iter().zip(bounds).filter(|(_, bound)| bound.is_bounded()) {
            sum += bound.radius;
            count += 1.0;
            let pace = AHEAD * pace(hold, bound, lasted) / bound.radius;
            for (volume, calls) in volumes.iter_mut().zip(CALLS) {
                // However thick the skin, it brings no more than a pair for each other body.
                *volume += all.min((1.0 + calls * pace).powi(D as i32));
            }
        }
        self.mean = if count > 0.0 { sum / count } else { 0.0 };
        let fit = CALLS.into_iter().zip(volumes).find(|&(_, volume)| volume <= GROWTH * count);
        self.calls = fit.map_or(0.0, |(calls, _)| calls);
    }

    /// The skin of a body that was held and is now at `bound`, m.
    pub(super) fn of_body<const D: usize>(&self, hold: &Hold<D>, lasted: u32, bound: &Bound<D>) -> f64 {
        self.of_pace(pace(hold, bound, lasted), bound.radius)
    }

    /// The skin of a wall that came nearer by `pace` (m) a call.
    pub(super) fn of_wall(&self, pace: f64) -> f64 {
        self.of_pace(if pace.is_finite() { pace } else { 0.0 }, self.mean)
    }

    fn of_pace(&self, pace: f64, radius: f64) -> f64 {
        if self.calls == 0.0 { 0.0 } else { (AHEAD * pace * self.calls).max(self.rest * radius.min(self.mean)) }
    }
}

/// How far a body moved, on average, in each of the calls since the list was made, m; zero where that is not known.
fn pace<const D: usize>(hold: &Hold<D>, bound: &Bound<D>, lasted: u32) -> f64 {
    let pace = square_between(hold.centre, bound.centre).sqrt() / f64::from(lasted.max(1));
    if hold.radius.is_finite() && pace.is_finite() { pace } else { 0.0 }
}
