//! Candidate pairs, to be had in order.

/// Pairs of bodies, found in any order and more than once, and their order by two stable counting sorts: linear in pairs and
/// bodies.
#[derive(Clone, Debug, Default)]
pub(super) struct Pairs {
    found: Vec<(u32, u32)>,
    spare: Vec<(u32, u32)>,
    starts: Vec<u32>,
}

impl Pairs {
    pub(super) fn clear(&mut self) {
        self.found.clear();
    }

    #[inline]
    pub(super) fn push(&mut self, a: u32, b: u32) {
        self.found.push((a.min(b), a.max(b)));
    }

    /// Brings the pairs of `bodies` bodies into their order, lower index first, ascending, and drops repetitions.
    pub(super) fn sort(&mut self, bodies: usize) {
        self.spare.resize(self.found.len(), (0, 0));
        counting_sort(&self.found, &mut self.spare, &mut self.starts, bodies, |pair| pair.1);
        counting_sort(&self.spare, &mut self.found, &mut self.starts, bodies, |pair| pair.0);
        self.found.dedup();
    }

    /// The pairs as they stand.
    pub(super) fn list(&self) -> &[(u32, u32)] {
        &self.found
    }
}

/// Writes `from` into `to` by ascending key below `keys`, equal keys in the order in which they were.
fn counting_sort(
    from: &[(u32, u32)],
    to: &mut [(u32, u32)],
    starts: &mut Vec<u32>,
    keys: usize,
    key: impl Fn((u32, u32)) -> u32,
) {
    starts.clear();
    starts.resize(keys + 1, 0);
    for &pair in from {
        starts[key(pair) as usize + 1] += 1;
    }
    for k in 1..=keys {
        starts[k] += starts[k - 1];
    }
    for &pair in from {
        let next = &mut starts[key(pair) as usize];
        to[*next as usize] = pair;
        *next += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_come_out_in_order_and_once() {
        let mut pairs = Pairs::default();
        for (a, b) in [(3, 1), (0, 2), (1, 3), (2, 1), (0, 1), (2, 0)] {
            pairs.push(a, b);
        }
        pairs.sort(4);
        assert_eq!(pairs.list(), [(0, 1), (0, 2), (1, 2), (1, 3)]);
        pairs.clear();
        pairs.sort(0);
        assert!(pairs.list().is_empty());
    }
}
