//! The contact problem, frozen while it is solved.

use crate::{Cone, Operator, block::Vector};

/// u = W r + q with the law of each contact. Nothing in it changes during a solve.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a, O, const D: usize> {
    /// W.
    pub operator: &'a O,
    /// The velocity without impulses, with the shifts of the laws added, m/s.
    pub q: &'a [Vector<D>],
    /// The law of each contact.
    pub cones: &'a [Cone],
}

impl<O: Operator<D>, const D: usize> Problem<'_, O, D> {
    /// How many contacts there are.
    pub fn len(&self) -> usize {
        self.q.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.q.is_empty()
    }

    /// u_c = q_c + (W r)_c for the impulses that `state` stands for.
    #[inline]
    pub fn velocity(&self, state: &O::State, c: usize) -> Vector<D> {
        let wr = self.operator.apply(state, c);
        std::array::from_fn(|i| self.q[c][i] + wr[i])
    }
}
