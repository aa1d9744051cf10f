//! Disjoint sets of numbers, kept as trees in an array: each number points to another of its set, and one of them, the representative, to itself.

/// Returns the representative of a number's set, and halves the path to it.
pub(crate) fn representative(parent: &mut [u32], mut of: u32) -> u32 {
    while parent[of as usize] != of {
        let next = parent[parent[of as usize] as usize];
        parent[of as usize] = next;
        of = next;
    }
    of
}
