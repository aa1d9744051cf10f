//! With friction: Coulomb's law between round bodies, in the axes of the world.
//!
//! W_cc = w_n n⊗n + w_t (I − n⊗n) couples nothing, so the law has a closed solution, which is PDAS's step for such a block:
//!
//! ```text
//! u = (v_b − v_a) − (l_b ω_b + l_a ω_a) × n + q
//! τ = p − (u_n/w_n) n − u_T/w_t
//! p ← max(0, τ_n) n + min(1, μ max(0, τ_n)/‖τ_T‖) τ_T
//! ```

use super::kernel::{Kernel, Lane, Places, Sides};
use crate::block::Vector;
use crate::operator::balls::{RoundBody, RoundContact};
use crate::wide::{Four, LANES, Wide};

/// Two rows a body: velocity and 1/m, spin and 1/J.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Round;

/// Four contacts.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Group {
    n: [Four; 3],
    q: [Four; 3],
    /// 1/w_n and 1/w_t.
    inverse: [Four; 2],
    mu: Four,
    /// l_a and l_b.
    arms: [Four; 2],
    pairs: [[u32; 2]; LANES],
}

impl Default for Group {
    fn default() -> Self {
        let (none, one) = (Four::default(), Four([1.0; LANES]));
        Self { n: [none; 3], q: [none; 3], inverse: [one; 2], mu: none, arms: [none; 2], pairs: [[u32::MAX; 2]; LANES] }
    }
}

/// Below any length that matters, above where its square is lost.
const NO_LENGTH: f64 = 1e-300;

/// Beyond it every coefficient of friction counts as one.
const MANY: f64 = 1e300;

#[inline(always)]
fn dot<W: Wide>(w: W, a: &[W::F; 3], b: &[W::F; 3]) -> W::F {
    w.add(w.add(w.mul(a[0], b[0]), w.mul(a[1], b[1])), w.mul(a[2], b[2]))
}

#[inline(always)]
fn cross<W: Wide>(w: W, a: &[W::F; 3], b: &[W::F; 3]) -> [W::F; 3] {
    let x = w.sub(w.mul(a[1], b[2]), w.mul(a[2], b[1]));
    let y = w.sub(w.mul(a[2], b[0]), w.mul(a[0], b[2]));
    [x, y, w.sub(w.mul(a[0], b[1]), w.mul(a[1], b[0]))]
}

/// a + s b.
#[inline(always)]
fn along<W: Wide>(w: W, a: &[W::F; 3], s: W::F, b: &[W::F; 3]) -> [W::F; 3] {
    [w.add(a[0], w.mul(s, b[0])), w.add(a[1], w.mul(s, b[1])), w.add(a[2], w.mul(s, b[2]))]
}

#[inline(always)]
fn sub<W: Wide>(w: W, a: &[W::F; 3], b: &[W::F; 3]) -> [W::F; 3] {
    [w.sub(a[0], b[0]), w.sub(a[1], b[1]), w.sub(a[2], b[2])]
}

#[inline(always)]
fn add<W: Wide>(w: W, a: &[W::F; 3], b: &[W::F; 3]) -> [W::F; 3] {
    [w.add(a[0], b[0]), w.add(a[1], b[1]), w.add(a[2], b[2])]
}

#[inline(always)]
fn lanes<W: Wide>(w: W, a: &[Four; 3]) -> [W::F; 3] {
    [w.load(&a[0]), w.load(&a[1]), w.load(&a[2])]
}

impl Kernel<2, 3> for Round {
    type Group = Group;

    fn body(body: RoundBody) -> [Four; 2] {
        [Four([0.0, 0.0, 0.0, body.inverse_mass]), Four([0.0, 0.0, 0.0, body.inverse_inertia])]
    }

    #[inline(always)]
    fn fill<const D: usize>(group: &mut Group, lane: usize, contact: &Lane<'_, D>) {
        let q = Self::pack(contact.contact, contact.q);
        for k in 0..3 {
            group.n[k].0[lane] = contact.contact.frame[0][k];
            group.q[k].0[lane] = q[k];
        }
        for k in 0..2 {
            group.inverse[k].0[lane] = 1.0 / contact.contact.mobility[k];
            group.arms[k].0[lane] = contact.contact.arms[k];
        }
        group.mu.0[lane] = contact.cone.friction();
        group.pairs[lane] = contact.rows;
    }

    fn blank(group: &mut Group, row: u32) {
        for at in group.pairs.as_flattened_mut().iter_mut().filter(|at| **at == u32::MAX) {
            *at = row;
        }
    }

    #[inline(always)]
    fn pack<const D: usize>(contact: &RoundContact<D>, r: &Vector<D>) -> [f64; 3] {
        std::array::from_fn(|k| (0..D).map(|i| contact.frame[i][k] * r[i]).sum())
    }

    #[inline(always)]
    fn unpack<const D: usize>(contact: &RoundContact<D>, p: &[f64; 3]) -> Vector<D> {
        contact.frame.map(|e| e[0] * p[0] + e[1] * p[1] + e[2] * p[2])
    }

    #[inline(always)]
    fn pairs(group: &Group) -> &[[u32; 2]; LANES] {
        &group.pairs
    }

    #[inline(always)]
    fn velocity<W: Wide>(w: W, group: &Group, [a, b]: &Sides<W::F, 2>) -> [W::F; 3] {
        let (mut v, mut spin) = ([w.zero(); LANES], [w.zero(); LANES]);
        for i in 0..LANES {
            v[i] = w.sub(b[i][0], a[i][0]);
            let (l_a, l_b) = (w.splat(&group.arms[0].0[i]), w.splat(&group.arms[1].0[i]));
            spin[i] = w.add(w.mul(l_b, b[i][1]), w.mul(l_a, a[i][1]));
        }
        let [v_x, v_y, v_z, _] = w.transpose(v);
        let [s_x, s_y, s_z, _] = w.transpose(spin);
        let turn = cross(w, &[s_x, s_y, s_z], &lanes(w, &group.n));
        add(w, &sub(w, &[v_x, v_y, v_z], &turn), &lanes(w, &group.q))
    }

    #[inline(always)]
    fn visit<W: Wide>(w: W, group: &Group, y: &[W::F; 3], u: &[W::F; 3]) -> [W::F; 3] {
        let (n, zero, one) = (lanes(w, &group.n), w.zero(), w.splat(&1.0));
        let [normal, tangent] = [w.load(&group.inverse[0]), w.load(&group.inverse[1])];
        let u_n = dot(w, &n, u);
        let beside = w.mul(w.sub(tangent, normal), u_n);
        let tau = along(w, &along(w, y, w.sub(zero, tangent), u), beside, &n);
        let tau_n = dot(w, &n, &tau);
        let pressed = w.max(zero, tau_n);
        let slid = along(w, &tau, w.sub(zero, tau_n), &n);
        let length = w.sqrt(w.max(w.splat(&NO_LENGTH), dot(w, &slid, &slid)));
        let share = w.min(w.div(w.mul(w.load(&group.mu), pressed), length), one);
        along(w, &[w.mul(n[0], pressed), w.mul(n[1], pressed), w.mul(n[2], pressed)], share, &slid)
    }

    #[inline(always)]
    fn claim<W: Wide>(w: W, group: &Group, u: &[W::F; 3], change: &[W::F; 3]) -> [W::F; 3] {
        let (n, one) = (lanes(w, &group.n), w.splat(&1.0));
        let (w_n, w_t) = (w.div(one, w.load(&group.inverse[0])), w.div(one, w.load(&group.inverse[1])));
        let beside = w.mul(w.sub(w_n, w_t), dot(w, &n, change));
        along(w, &along(w, u, w_t, change), beside, &n)
    }

    #[inline(always)]
    fn push<W: Wide>(
        w: W,
        group: &Group,
        pairs: [[u32; 2]; LANES],
        bodies: &mut impl Places<[Four; 2]>,
        [a, b]: &Sides<W::F, 2>,
        change: &[W::F; 3],
    ) {
        let zero = w.zero();
        let [x, y, z] = *change;
        let pushes = w.transpose([x, y, z, zero]);
        let [x, y, z] = cross(w, &lanes(w, &group.n), change);
        let turns = w.transpose([x, y, z, zero]);
        for i in 0..LANES {
            let (at_a, at_b) = (pairs[i][0] as usize, pairs[i][1] as usize);
            let (m_a, m_b) = (w.splat(&bodies.get(at_a)[0].0[3]), w.splat(&bodies.get(at_b)[0].0[3]));
            let (j_a, j_b) = (w.splat(&bodies.get(at_a)[1].0[3]), w.splat(&bodies.get(at_b)[1].0[3]));
            let (l_a, l_b) = (w.splat(&group.arms[0].0[i]), w.splat(&group.arms[1].0[i]));
            let v_a = w.sub(a[i][0], w.mul(m_a, pushes[i]));
            let v_b = w.add(b[i][0], w.mul(m_b, pushes[i]));
            let s_a = w.sub(a[i][1], w.mul(w.mul(l_a, j_a), turns[i]));
            let s_b = w.sub(b[i][1], w.mul(w.mul(l_b, j_b), turns[i]));
            bodies.set(at_a, [w.store(v_a), w.store(s_a)]);
            bodies.set(at_b, [w.store(v_b), w.store(s_b)]);
        }
    }

    #[inline(always)]
    fn weight<W: Wide>(w: W, group: &Group) -> W::F {
        w.div(w.splat(&1.0), w.load(&group.inverse[1]))
    }

    #[inline(always)]
    fn apart<W: Wide>(w: W, group: &Group, claimed: &[W::F; 3], u: &[W::F; 3]) -> W::F {
        let (n, one) = (lanes(w, &group.n), w.splat(&1.0));
        let apart = sub(w, claimed, u);
        let normal = dot(w, &n, &apart);
        let tangent = along(w, &apart, w.sub(w.zero(), normal), &n);
        // Without friction the law knows no tangent.
        let rough = w.min(w.mul(w.load(&group.mu), w.splat(&MANY)), one);
        w.add(w.mul(normal, normal), w.mul(rough, dot(w, &tangent, &tangent)))
    }
}
