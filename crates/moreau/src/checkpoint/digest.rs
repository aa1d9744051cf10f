//! Checksums.

use serde::{Deserialize, Serialize};

/// The BLAKE3 checksum of some bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Digest(pub(super) [u8; 32]);

/// How many bytes a checksum has.
pub(super) const LENGTH: usize = 32;

impl Digest {
    /// That of these parts one after the other.
    pub(super) fn of(parts: &[&[u8]]) -> Self {
        let mut sum = Sum::default();
        parts.iter().for_each(|part| sum.add(part));
        sum.now()
    }
}

/// A checksum at work.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sum(blake3::Hasher);

impl Sum {
    /// Adds some bytes.
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// That of all bytes so far.
    pub(crate) fn now(&self) -> Digest {
        Digest(*self.0.finalize().as_bytes())
    }
}
