//! Without friction: 0 ≤ u_n ⊥ r_n ≥ 0 between round bodies, whose spin nothing changes.
//!
//! ```text
//! u = n·(v_b − v_a) + q,    r ← max(0, r − u/w)            exact: PDAS's step with γ = 1/w
//! ```

use super::kernel::{Kernel, Lane, Places, Sides};
use crate::block::Vector;
use crate::operator::balls::{RoundBody, RoundContact};
use crate::wide::{Four, LANES, Wide};

/// One row a body: its velocity, and 1/m.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Central;

/// Four contacts; 56 bytes each.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Group {
    /// Normals, a row a contact, the last number zero.
    n: [Four; LANES],
    /// 1/w.
    inverse: Four,
    q: Four,
    pairs: [[u32; 2]; LANES],
}

impl Default for Group {
    fn default() -> Self {
        Self { n: Default::default(), inverse: Four([1.0; LANES]), q: Four::default(), pairs: [[u32::MAX; 2]; LANES] }
    }
}

impl Kernel<1, 1> for Central {
    type Group = Group;

    fn body(body: RoundBody) -> [Four; 1] {
        [Four([0.0, 0.0, 0.0, body.inverse_mass])]
    }

    #[inline(always)]
    fn fill<const D: usize>(group: &mut Group, lane: usize, contact: &Lane<'_, D>) {
        let [x, y, z] = contact.contact.frame[0];
        group.n[lane] = Four([x, y, z, 0.0]);
        group.inverse.0[lane] = 1.0 / contact.contact.mobility[0];
        group.q.0[lane] = contact.q[0];
        group.pairs[lane] = contact.rows;
    }

    fn blank(group: &mut Group, row: u32) {
        for at in group.pairs.as_flattened_mut().iter_mut().filter(|at| **at == u32::MAX) {
            *at = row;
        }
    }

    #[inline(always)]
    fn pack<const D: usize>(_: &RoundContact<D>, r: &Vector<D>) -> [f64; 1] {
        [r[0]]
    }

    #[inline(always)]
    fn unpack<const D: usize>(_: &RoundContact<D>, p: &[f64; 1]) -> Vector<D> {
        std::array::from_fn(|i| if i == 0 { p[0] } else { 0.0 })
    }

    #[inline(always)]
    fn pairs(group: &Group) -> &[[u32; 2]; LANES] {
        &group.pairs
    }

    #[inline(always)]
    fn velocity<W: Wide>(w: W, group: &Group, [a, b]: &Sides<W::F, 1>) -> [W::F; 1] {
        let mut along = [w.zero(); LANES];
        for i in 0..LANES {
            along[i] = w.mul(w.load(&group.n[i]), w.sub(b[i][0], a[i][0]));
        }
        [w.add(w.sums(along), w.load(&group.q))]
    }

    #[inline(always)]
    fn visit<W: Wide>(w: W, group: &Group, y: &[W::F; 1], u: &[W::F; 1]) -> [W::F; 1] {
        let pressed = w.sub(y[0], w.mul(w.load(&group.inverse), u[0]));
        [w.max(w.zero(), pressed)]
    }

    #[inline(always)]
    fn claim<W: Wide>(w: W, group: &Group, u: &[W::F; 1], change: &[W::F; 1]) -> [W::F; 1] {
        [w.add(u[0], w.div(change[0], w.load(&group.inverse)))]
    }

    #[inline(always)]
    fn push<W: Wide>(
        w: W,
        group: &Group,
        pairs: [[u32; 2]; LANES],
        bodies: &mut impl Places<[Four; 1]>,
        [a, b]: &Sides<W::F, 1>,
        change: &[W::F; 1],
    ) {
        // From memory numbers are spread over a register for nothing, from a register they are not.
        let change = w.store(change[0]);
        for i in 0..LANES {
            let p = w.mul(w.load(&group.n[i]), w.splat(&change.0[i]));
            let (at_a, at_b) = (pairs[i][0] as usize, pairs[i][1] as usize);
            let (by_a, by_b) = (w.splat(&bodies.get(at_a)[0].0[3]), w.splat(&bodies.get(at_b)[0].0[3]));
            bodies.set(at_a, [w.store(w.sub(a[i][0], w.mul(p, by_a)))]);
            bodies.set(at_b, [w.store(w.add(b[i][0], w.mul(p, by_b)))]);
        }
    }

    #[inline(always)]
    fn weight<W: Wide>(w: W, group: &Group) -> W::F {
        w.div(w.splat(&1.0), w.load(&group.inverse))
    }

    #[inline(always)]
    fn apart<W: Wide>(w: W, _: &Group, claimed: &[W::F; 1], u: &[W::F; 1]) -> W::F {
        let apart = w.sub(claimed[0], u[0]);
        w.mul(apart, apart)
    }
}
