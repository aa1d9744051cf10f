//! A tree of boxes over boxes, to find those that meet a given one.
//!
//! Built once, from the top, each node's boxes halved at the median of their centres along the longest side; its shape and the order in
//! which boxes are found follow from the boxes alone. A search keeps its way in an array and allocates nothing.

/// How many boxes a leaf holds at most.
const LEAF: usize = 4;

/// More than the depth of a tree of 2³² boxes.
const DEPTH: usize = 64;

/// A box along the axes, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
    pub(crate) low: [f64; 3],
    pub(crate) high: [f64; 3],
}

impl Aabb {
    /// Around nothing.
    pub(crate) const EMPTY: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// Around these points.
    pub(crate) fn around(points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        points.into_iter().fold(Self::EMPTY, |all, p| all.with(Self { low: p, high: p }))
    }

    /// Around both.
    pub(crate) fn with(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|k| self.low[k].min(other.low[k])),
            high: std::array::from_fn(|k| self.high[k].max(other.high[k])),
        }
    }

    /// So much larger on every side, m.
    pub(crate) fn grown(self, by: f64) -> Self {
        Self { low: self.low.map(|x| x - by), high: self.high.map(|x| x + by) }
    }

    /// Whether two boxes have a point in common; nothing meets what is nowhere.
    #[inline]
    pub(crate) fn meets(&self, other: &Self) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
}

/// A node: the box around all below it, and for a leaf where its boxes stand, else its second child; the first one follows it.
#[derive(Clone, Debug, PartialEq)]
struct Node {
    around: Aabb,
    /// How many boxes a leaf has; 0 for other nodes.
    count: u32,
    start: u32,
}

/// The tree.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// Boxes in the order of the leaves.
    boxes: Vec<(Aabb, u32)>,
}

impl Tree {
    pub(crate) fn new(boxes: impl Iterator<Item = Aabb>) -> Self {
        let mut tree = Self { nodes: Vec::new(), boxes: boxes.zip(0..).collect() };
        let mut boxes = std::mem::take(&mut tree.boxes);
        if !boxes.is_empty() {
            tree.split(&mut boxes, 0);
        }
        tree.boxes = boxes;
        tree
    }

    fn split(&mut self, boxes: &mut [(Aabb, u32)], start: usize) {
        let around = boxes.iter().fold(Aabb::EMPTY, |all, (one, _)| all.with(*one));
        let node = self.nodes.len();
        let is_leaf = boxes.len() <= LEAF;
        self.nodes.push(Node { around, count: if is_leaf { boxes.len() as u32 } else { 0 }, start: start as u32 });
        if is_leaf {
            return;
        }
        let side = |k: usize| around.high[k] - around.low[k];
        let axis = (1..3).fold(0, |best, k| if side(k) > side(best) { k } else { best });
        let middle = |one: &Aabb| one.low[axis] + one.high[axis];
        let half = boxes.len() / 2;
        // Of equal centres the lower number first: the halves do not depend on how they were found.
        boxes.select_nth_unstable_by(half, |(a, i), (b, j)| middle(a).total_cmp(&middle(b)).then(i.cmp(j)));
        let (first, second) = boxes.split_at_mut(half);
        self.split(first, start);
        self.nodes[node].start = self.nodes.len() as u32;
        self.split(second, start + half);
    }

    /// Hands over the number of each box that meets this one, in the order of the tree.
    pub(crate) fn meeting(&self, wanted: &Aabb, mut found: impl FnMut(u32)) {
        let mut waiting = [0_u32; DEPTH];
        let mut count = usize::from(!self.nodes.is_empty());
        while count > 0 {
            count -= 1;
            let place = waiting[count];
            let node = &self.nodes[place as usize];
            if !node.around.meets(wanted) {
                continue;
            }
            if node.count > 0 {
                let boxes = &self.boxes[node.start as usize..][..node.count as usize];
                boxes.iter().filter(|(one, _)| one.meets(wanted)).for_each(|&(_, number)| found(number));
            } else {
                waiting[count] = node.start;
                waiting[count + 1] = place + 1;
                count += 2;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_finds_what_a_look_at_each_box_finds() {
        // Quasi-random boxes of all sizes, many with the same centre along x.
        let roll = |i: u32, k: u32| f64::from((i.wrapping_mul(2_654_435_761) ^ k.wrapping_mul(40_503)) % 1009) / 1009.0;
        let boxes: Vec<Aabb> = (0..500)
            .map(|i| {
                let centre = [f64::from(i % 5), 5.0 * roll(i, 1), 5.0 * roll(i, 2)];
                let margin = 0.5 * roll(i, 3);
                Aabb { low: centre.map(|x| x - margin), high: centre.map(|x| x + margin) }
            })
            .collect();
        let tree = Tree::new(boxes.iter().copied());
        for wanted in &boxes {
            let mut found = Vec::new();
            tree.meeting(wanted, |number| found.push(number as usize));
            found.sort_unstable();
            let expected: Vec<usize> = (0..boxes.len()).filter(|&i| boxes[i].meets(wanted)).collect();
            assert_eq!(found, expected);
        }
        Tree::new(std::iter::empty()).meeting(&boxes[0], |_| unreachable!());
    }
}
