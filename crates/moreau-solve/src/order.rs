//! The order in which a sweep visits the contacts.

use crate::Operator;
use rand::{SeedableRng, seq::SliceRandom};

/// How contacts are ordered for a sweep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Order {
    /// By colour, so that one visit does not wait for the velocity that the last one wrote.
    #[default]
    Coloured,
    /// As they are numbered.
    Natural,
    /// Shuffled by a generator with this seed: the same seed gives the same order on every machine.
    Shuffled(u64),
}

impl Order {
    /// Writes the order of `contacts` contacts.
    pub(crate) fn fill<O: Operator<D>, const D: usize>(self, operator: &O, contacts: usize, order: &mut Vec<u32>) {
        order.clear();
        order.extend(0..u32::try_from(contacts).unwrap_or(u32::MAX));
        match self {
            Order::Natural => {}
            Order::Coloured => operator.colour(order),
            Order::Shuffled(seed) => order.shuffle(&mut rand_pcg::Pcg64Mcg::seed_from_u64(seed)),
        }
    }
}
