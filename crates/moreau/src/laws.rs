//! Which law holds between which materials.

use moreau_solve::Law;

/// The laws by pair of materials, with a default.
#[derive(Clone, Debug, PartialEq)]
pub struct Laws {
    materials: usize,
    table: Vec<Law>,
}

impl Laws {
    /// A table for `materials` materials in which every pair has the law `default`.
    pub fn new(materials: usize, default: Law) -> Self {
        Self { materials, table: vec![default; materials * materials] }
    }

    /// Sets the law of a pair, in both orders.
    pub fn set(&mut self, a: u16, b: u16, law: Law) {
        let (a, b) = (usize::from(a), usize::from(b));
        self.table[a * self.materials + b] = law;
        self.table[b * self.materials + a] = law;
    }

    /// The law of a pair.
    #[inline]
    pub fn get(&self, a: u16, b: u16) -> &Law {
        &self.table[usize::from(a) * self.materials + usize::from(b)]
    }

    /// All laws in use.
    pub fn iter(&self) -> impl Iterator<Item = &Law> {
        self.table.iter()
    }
}
