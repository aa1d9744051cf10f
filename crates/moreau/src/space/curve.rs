//! The bodies along a curve through space (Morton 1966), on which neighbours are near each other: generated bodies are numbered along it,
//! so that neighbours share caches, and contacts are shared along it among threads. It depends on the positions of now alone, so a run
//! that is resumed goes on as it was.

use super::Pose;
use moreau_solve::tasks;

/// Cells along an axis: 2 to this power, at most.
const FINEST: u32 = 8;

/// The place of each body on the curve, with the memory to find it.
#[derive(Default)]
pub(crate) struct Curve {
    cells: Vec<u32>,
    counts: Vec<u32>,
    places: Vec<u32>,
}

impl Curve {
    /// The place of each body; those for which `counts` is false come last, and stretch nothing.
    pub(crate) fn places<R: Sync, const D: usize>(
        &mut self,
        middle: &[Pose<R, D>],
        counts: impl Fn(usize) -> bool + Sync + Send,
    ) -> &[u32] {
        let moving = || (0..middle.len()).filter(|&i| counts(i));
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for i in moving() {
            low = std::array::from_fn(|k| low[k].min(middle[i].position[k]));
            high = std::array::from_fn(|k| high[k].max(middle[i].position[k]));
        }
        // Cubes, as many as bodies if these filled the box.
        let bits = middle.len().max(2).ilog2().div_ceil(D as u32).min(FINEST);
        let widest = (0..D).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        let per_length = if widest > 0.0 { f64::from((1 << bits) - 1) / widest } else { 0.0 };
        let last = 1 << (bits * D as u32);
        tasks::fill(&mut self.cells, middle.len(), |i| {
            let cell = |k: usize| ((middle[i].position[k] - low[k]) * per_length) as u32;
            if counts(i) { interleaved(std::array::from_fn::<_, D, _>(cell)) } else { last }
        });
        self.rank(last as usize + 1);
        &self.places
    }

    /// Counts the bodies of each cell, and gives them their places.
    fn rank(&mut self, cells: usize) {
        self.counts.clear();
        self.counts.resize(cells, 0);
        self.cells.iter().for_each(|&cell| self.counts[cell as usize] += 1);
        let mut next = 0;
        for count in &mut self.counts {
            next += std::mem::replace(count, next);
        }
        self.places.clear();
        self.places.extend(self.cells.iter().map(|&cell| {
            let place = &mut self.counts[cell as usize];
            std::mem::replace(place, *place + 1)
        }));
    }
}

/// The bits of D numbers in turns: bit b of number k is bit b D + k of the result.
fn interleaved<const D: usize>(numbers: [u32; D]) -> u32 {
    (0..FINEST).fold(0, |all, bit| (0..D).fold(all, |all, k| all | (numbers[k] >> bit & 1) << (bit * D as u32 + k as u32)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_body_has_a_place_and_neighbours_are_near() {
        let side = 16;
        let at = |i: usize| [i % side, i / side % side, i / (side * side)].map(|x| x as f64);
        // The last one counts for nothing, however far it is.
        let mut bodies: Vec<Pose<(), 3>> = (0..side.pow(3)).map(|i| Pose { position: at(i), rotation: () }).collect();
        bodies.push(Pose { position: [1e9; 3], rotation: () });
        let mut curve = Curve::default();
        let places = curve.places(&bodies, |i| i < side.pow(3)).to_vec();
        let mut sorted = places.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().zip(0..).all(|(&place, i)| place == i));
        assert_eq!(places[side.pow(3)], side.pow(3) as u32);
        // Sixty-four in a row are a cube of four.
        for begin in (0..side.pow(3) as u32).step_by(64) {
            let row = || {
                places
                    .iter()
                    .zip(&bodies)
                    .filter(|(place, _)| (begin..begin + 64).contains(*place))
                    .map(|(_, body)| body.position)
            };
            for k in 0..3 {
                let (low, high) = row().fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x[k]), high.max(x[k])));
                assert_eq!(high - low, 3.0);
            }
        }
    }

    #[test]
    fn one_body_or_none_has_its_place() {
        let mut curve = Curve::default();
        assert!(curve.places::<(), 2>(&[], |_| true).is_empty());
        assert_eq!(curve.places(&[Pose { position: [3.0, 4.0], rotation: () }], |_| true), [0]);
        assert_eq!(curve.places(&[Pose { position: [f64::NAN, 4.0], rotation: () }], |_| true), [0]);
    }
}
