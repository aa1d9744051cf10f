//! Which segments of a chain are in a region: boxes around runs of consecutive segments, runs of two runs, and so on.
//!
//! Consecutive segments are neighbours, so the order of the chain is as good a tree as any, and what is found comes in that order.

use super::{Segment, bounds};

/// Segments in a leaf.
const LEAF: usize = 4;

/// A full binary tree of boxes: 1 is the root, the two below `i` are `2 i` and `2 i + 1`.
#[derive(Debug, PartialEq)]
pub(super) struct Tree {
    boxes: Vec<Rect>,
    leaves: usize,
    segments: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Rect {
    low: [f64; 2],
    high: [f64; 2],
}

impl Rect {
    const EMPTY: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    fn with(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|k| self.low[k].min(other.low[k])),
            high: std::array::from_fn(|k| self.high[k].max(other.high[k])),
        }
    }

    /// Never where a coordinate is not a number.
    #[inline]
    fn meets(&self, other: &Self) -> bool {
        (0..2).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
}

impl Tree {
    pub(super) fn new(segments: &[Segment]) -> Self {
        let leaves = segments.len().div_ceil(LEAF).next_power_of_two();
        let mut boxes = vec![Rect::EMPTY; 2 * leaves];
        for (leaf, run) in segments.chunks(LEAF).enumerate() {
            let rect = |segment| {
                let (low, high) = bounds(segment);
                Rect { low, high }
            };
            boxes[leaves + leaf] = run.iter().map(rect).fold(Rect::EMPTY, Rect::with);
        }
        for node in (1..leaves).rev() {
            boxes[node] = boxes[2 * node].with(boxes[2 * node + 1]);
        }
        Self { boxes, leaves, segments: segments.len() }
    }

    /// Hands over, ascending, the numbers of all segments in leaves whose boxes meet that between `low` and `high`.
    #[inline]
    pub(super) fn each(&self, low: [f64; 2], high: [f64; 2], found: &mut impl FnMut(usize)) {
        self.descend(1, &Rect { low, high }, found);
    }

    fn descend(&self, node: usize, region: &Rect, found: &mut impl FnMut(usize)) {
        if !self.boxes[node].meets(region) {
            return;
        }
        if node >= self.leaves {
            let first = (node - self.leaves) * LEAF;
            (first..(first + LEAF).min(self.segments)).for_each(found);
            return;
        }
        self.descend(2 * node, region, found);
        self.descend(2 * node + 1, region, found);
    }
}
