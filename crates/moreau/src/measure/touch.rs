//! Which contacts count.

use crate::step::Localised;

/// What it takes for a contact to count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Touch {
    /// A normal impulse.
    Loaded,
    /// A gap of at most so much (m), with or without an impulse.
    Closed(f64),
}

impl Touch {
    /// Whether this contact counts.
    pub fn holds<const D: usize>(self, c: &Localised<D>) -> bool {
        match self {
            Self::Loaded => c.impulse[0] > 0.0,
            Self::Closed(gap) => c.contact.gap <= gap,
        }
    }

    /// The contacts that count.
    pub fn among<const D: usize>(self, contacts: &[Localised<D>]) -> impl Iterator<Item = &Localised<D>> {
        contacts.iter().filter(move |c| self.holds(c))
    }

    /// The pairs of bodies with a contact that counts, each once, and how many points of theirs count. Contacts are sorted by key.
    pub fn pairs<const D: usize>(self, contacts: &[Localised<D>]) -> impl Iterator<Item = ([u32; 2], usize)> {
        let pair = |c: &Localised<D>| [c.contact.key.a, c.contact.key.b];
        let of_pair = contacts.chunk_by(move |one, next| pair(one) == pair(next));
        let counted = of_pair.map(move |contacts| (pair(&contacts[0]), contacts.iter().filter(|c| self.holds(c)).count()));
        counted.filter(|&(_, points)| points > 0)
    }
}
