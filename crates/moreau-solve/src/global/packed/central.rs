//! Without friction: 0 ≤ u_n ⊥ r_n ≥ 0 between round bodies, whose spin nothing changes.
//!
//! ```text
//! u = n·(v_b − v_a) + q,    r ← max(0, r − u/w)            exact: PDAS's step with γ = 1/w
//! ```
//!
//! With r̂ = √w r, û = u/√w and n̂ = n/√w nothing of w is left: û = n̂·(v_b − v_a) + q̂, r̂ ← max(0, r̂ − û), and the bodies get n̂ times
//! the change of r̂.

use super::kernel::{Kernel, Lane, Places, Sides};
use crate::block::Vector;
use crate::operator::balls::{RoundBody, RoundContact};
use crate::wide::{Four, LANES, Wide};

/// One row a body: its velocity, and 1/m.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Central;

/// Four contacts; 48 bytes each.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Group {
    /// n̂, a row a contact, the last number zero.
    n: [Four; LANES],
    q: Four,
    pairs: [[u32; 2]; LANES],
}

impl Default for Group {
    fn default() -> Self {
        Self { n: Default::default(), q: Four::default(), pairs: [[u32::MAX; 2]; LANES] }
    }
}

impl Kernel<1, 1> for Central {
    type Group = Group;

    fn body(body: RoundBody) -> [Four; 1] {
        [Four([0.0, 0.0, 0.0, body.inverse_mass])]
    }

    #[inline(always)]
    fn fill<const D: usize>(group: &mut Group, lane: usize, contact: &Lane<'_, D>) {
        let by = 1.0 / Self::scale(contact.contact);
        let [x, y, z] = contact.contact.frame[0];
        group.n[lane] = Four([by * x, by * y, by * z, 0.0]);
        [group.q.0[lane]] = Self::pack(contact.contact, contact.q, by);
        group.pairs[lane] = contact.rows;
    }

    fn blank(group: &mut Group, row: u32) {
        for at in group.pairs.as_flattened_mut().iter_mut().filter(|at| **at == u32::MAX) {
            *at = row;
        }
    }

    #[inline(always)]
    fn scale<const D: usize>(contact: &RoundContact<D>) -> f64 {
        contact.mobility[0].sqrt()
    }

    #[inline(always)]
    fn pack<const D: usize>(_: &RoundContact<D>, x: &Vector<D>, by: f64) -> [f64; 1] {
        [by * x[0]]
    }

    #[inline(always)]
    fn unpack<const D: usize>(_: &RoundContact<D>, x: &[f64; 1], by: f64) -> Vector<D> {
        std::array::from_fn(|i| if i == 0 { by * x[0] } else { 0.0 })
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
    fn visit<W: Wide>(w: W, _: &Group, y: &[W::F; 1], u: &[W::F; 1]) -> [W::F; 1] {
        [w.max(w.zero(), w.sub(y[0], u[0]))]
    }

    #[inline(always)]
    fn claim<W: Wide>(w: W, _: &Group, u: &[W::F; 1], change: &[W::F; 1]) -> [W::F; 1] {
        [w.add(u[0], change[0])]
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
            bodies.set(at_a, [w.store(w.less(a[i][0], p, by_a))]);
            bodies.set(at_b, [w.store(w.more(b[i][0], p, by_b))]);
        }
    }

    #[inline(always)]
    fn apart<W: Wide>(w: W, group: &Group, claimed: &[W::F; 1], u: &[W::F; 1]) -> W::F {
        let mut squares = [w.zero(); LANES];
        for i in 0..LANES {
            squares[i] = w.mul(w.load(&group.n[i]), w.load(&group.n[i]));
        }
        let apart = w.sub(claimed[0], u[0]);
        // ‖n̂‖² = 1/w; an empty lane has none, and nothing apart.
        w.div(w.mul(apart, apart), w.max(w.sums(squares), w.splat(&f64::MIN_POSITIVE)))
    }
}
