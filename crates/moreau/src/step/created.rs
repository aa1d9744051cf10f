//! Energy that a step creates, by the part of the scheme that creates it (theory, section 14).
//!
//! Energy is created where the sum of a part's dissipation is negative. The sum goes over what can exchange energy within one step:
//!
//! - contacts, joints: an island, which is a set of free bodies connected by impulses. A single contact of an island may do positive work,
//!   because other contacts shut it; (43) and (44) are statements about the sum. Islands exchange nothing, so the sum over a whole step
//!   would hide the creation of one island behind the dissipation of another.
//! - scheme: one body. Settling, the gyroscopic term and θ > 1/2 do not couple bodies.
//! - correction: all bodies, which one correction of positions moves together.

use super::joints::Block;
use super::workspace::Localised;
use crate::bodies::Bodies;
use crate::disjoint::representative;
use crate::space::Space;
use moreau_solve::block::dot;
use serde::{Deserialize, Serialize};

/// Energy created, J, by part. No part is negative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Created {
    /// By contacts: the normal and tangential impulses of an island together.
    pub contacts: f64,
    /// By joints.
    pub joints: f64,
    /// By corrections of positions, which lift weights.
    pub correction: f64,
    /// By the scheme: settling of rotations, the gyroscopic term, θ > 1/2.
    pub scheme: f64,
}

impl Created {
    /// The names of the parts, in the order of [`Self::parts`].
    pub const NAMES: [&'static str; 4] = ["contacts", "joints", "corrections of positions", "the scheme"];

    /// The parts, J.
    pub fn parts(&self) -> [f64; 4] {
        [self.contacts, self.joints, self.correction, self.scheme]
    }

    /// Returns the energy with these parts, in the order of [`Self::NAMES`].
    pub fn of([contacts, joints, correction, scheme]: [f64; 4]) -> Self {
        Self { contacts, joints, correction, scheme }
    }

    /// The sum of all parts, J.
    pub fn total(&self) -> f64 {
        self.parts().iter().sum()
    }

    /// Adds the energy that another step, or another part of this step, created.
    pub fn add(&mut self, other: &Self) {
        let (a, b) = (self.parts(), other.parts());
        *self = Self::of(std::array::from_fn(|k| a[k] + b[k]));
    }
}

/// Sets of free bodies that impulses of one step connect, with the work of contacts and of joints on each.
#[derive(Clone, Debug, Default)]
pub(super) struct Islands {
    /// Index of a body nearer to the representative of its island; the representative has its own.
    parent: Vec<u32>,
    /// Work of contacts and of joints, J, at the representative.
    work: Vec<[f64; 2]>,
}

impl Islands {
    /// Returns the energy that contacts and joints created: the positive sums over islands of p · ½(u⁻ + u⁺).
    pub(super) fn created<S: Space<D, N>, const D: usize, const N: usize>(
        &mut self,
        bodies: &Bodies<S, D, N>,
        contacts: &[Localised<D>],
        blocks: &[Block<D, N>],
    ) -> Created {
        if blocks.is_empty() && contacts.iter().all(|c| c.impulse == [0.0; D]) {
            return Created::default();
        }
        self.parent.clear();
        self.parent.extend(0..bodies.len() as u32);
        self.work.clear();
        self.work.resize(bodies.len(), [0.0; 2]);
        let free = |body: u32| bodies.is_free(body as usize).then_some(body);
        let of_contact = |c: &Localised<D>| [free(c.contact.key.a), free(c.contact.key.b)];
        let of_block = |block: &Block<D, N>| block.bodies.map(|body| free(u32::try_from(body?).ok()?));
        let active = || contacts.iter().filter(|c| c.impulse != [0.0; D]);
        active().for_each(|c| self.connect(of_contact(c)));
        blocks.iter().for_each(|block| self.connect(of_block(block)));
        active().for_each(|c| self.add(of_contact(c), 0, work(&c.impulse, [&c.before, &c.after])));
        blocks.iter().for_each(|block| self.add(of_block(block), 1, work(&block.impulse, [&block.before, &block.after])));
        // A NaN is kept: it is an error, not a zero.
        let positive = |x: f64| if x <= 0.0 { 0.0 } else { x };
        let [contacts, joints] = self.work.iter().fold([0.0; 2], |sum, work| std::array::from_fn(|k| sum[k] + positive(work[k])));
        Created { contacts, joints, ..Created::default() }
    }

    /// Joins the islands of two bodies under the smaller of their representatives.
    fn connect(&mut self, pair: [Option<u32>; 2]) {
        if let [Some(a), Some(b)] = pair {
            let (a, b) = (representative(&mut self.parent, a), representative(&mut self.parent, b));
            self.parent[a.max(b) as usize] = a.min(b);
        }
    }

    /// Adds work to the island of a contact or joint; one between driven bodies has none.
    fn add(&mut self, [a, b]: [Option<u32>; 2], part: usize, work: f64) {
        if let Some(body) = a.or(b) {
            let island = representative(&mut self.parent, body);
            self.work[island as usize][part] += work;
        }
    }
}

/// Work of an impulse, J: p · ½(u⁻ + u⁺).
fn work<const D: usize>(impulse: &[f64; D], [before, after]: [&[f64; D]; 2]) -> f64 {
    dot(impulse, &std::array::from_fn(|i| 0.5 * (before[i] + after[i])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn islands_keep_their_work_apart() {
        let mut islands = Islands { parent: (0..6).collect(), work: vec![[0.0; 2]; 6] };
        // Bodies 5-3-1 are one island, 0 and 4 another, 2 stands on the ground alone.
        for pair in [[Some(5), Some(3)], [Some(3), Some(1)], [Some(4), Some(0)], [None, Some(2)]] {
            islands.connect(pair);
        }
        islands.add([Some(5), Some(3)], 0, 2.0);
        islands.add([Some(1), None], 0, -3.0);
        islands.add([None, Some(4)], 1, 1.5);
        islands.add([None, Some(2)], 0, 0.5);
        islands.add([None, None], 0, 100.0);
        assert_eq!(islands.work, [[0.0, 1.5], [-1.0, 0.0], [0.5, 0.0], [0.0; 2], [0.0; 2], [0.0; 2]]);
    }

    #[test]
    fn created_energy_adds_up_by_part() {
        let mut sum = Created::of([1.0, 2.0, 3.0, 4.0]);
        sum.add(&Created { scheme: 1.0, ..Created::default() });
        assert_eq!((sum.parts(), sum.total()), ([1.0, 2.0, 3.0, 5.0], 11.0));
    }
}
