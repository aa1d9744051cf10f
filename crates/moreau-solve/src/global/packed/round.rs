//! With friction: Coulomb's law between round bodies, in the axes of the world.
//!
//! W_cc = w_n n⊗n + w_t (I − n⊗n) couples nothing, so the law has a closed solution, which is PDAS's step for such a block. With
//! p̂ = √w_t p, û = u/√w_t and κ = w_t/w_n:
//!
//! ```text
//! û = ((v_b − v_a) − (l_b ω_b + l_a ω_a) × n)/√w_t + q̂
//! τ = p̂ − û − (κ − 1) û_n n
//! p̂ ← max(0, τ_n) n + min(1, μ max(0, τ_n)/‖τ_T‖) τ_T
//! ```

use super::kernel::{Kernel, Lane, Places, Sides};
use super::vector::{against, along, cross, dot, load, minus, minus_cross, plus, times};
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
    /// 1/√w_t.
    root: Four,
    /// κ.
    kappa: Four,
    mu: Four,
    /// l_a and l_b.
    arms: [Four; 2],
    pairs: [[u32; 2]; LANES],
}

impl Default for Group {
    fn default() -> Self {
        let (none, one) = (Four::default(), Four([1.0; LANES]));
        Self { n: [none; 3], q: [none; 3], root: one, kappa: one, mu: none, arms: [none; 2], pairs: [[u32::MAX; 2]; LANES] }
    }
}

/// Below any length that matters, above where its square is lost.
const NO_LENGTH: f64 = 1e-300;

/// Beyond it every coefficient of friction counts as one.
const MANY: f64 = 1e300;

impl Kernel<2, 3> for Round {
    type Group = Group;

    fn body(body: RoundBody) -> [Four; 2] {
        [Four([0.0, 0.0, 0.0, body.inverse_mass]), Four([0.0, 0.0, 0.0, body.inverse_inertia])]
    }

    #[inline(always)]
    fn fill<const D: usize>(group: &mut Group, lane: usize, contact: &Lane<'_, D>) {
        let root = 1.0 / Self::scale(contact.contact);
        let q = Self::pack(contact.contact, contact.q, root);
        for k in 0..3 {
            group.n[k].0[lane] = contact.contact.frame[0][k];
            group.q[k].0[lane] = q[k];
        }
        group.root.0[lane] = root;
        group.kappa.0[lane] = contact.contact.mobility[1] / contact.contact.mobility[0];
        for k in 0..2 {
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
    fn scale<const D: usize>(contact: &RoundContact<D>) -> f64 {
        contact.mobility[1].sqrt()
    }

    #[inline(always)]
    fn pack<const D: usize>(contact: &RoundContact<D>, x: &Vector<D>, by: f64) -> [f64; 3] {
        std::array::from_fn(|k| by * (0..D).map(|i| contact.frame[i][k] * x[i]).sum::<f64>())
    }

    #[inline(always)]
    fn unpack<const D: usize>(contact: &RoundContact<D>, x: &[f64; 3], by: f64) -> Vector<D> {
        contact.frame.map(|e| by * (e[0] * x[0] + e[1] * x[1] + e[2] * x[2]))
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
            spin[i] = w.more(w.mul(l_b, b[i][1]), l_a, a[i][1]);
        }
        let [v_x, v_y, v_z, _] = w.transpose(v);
        let [s_x, s_y, s_z, _] = w.transpose(spin);
        let u = minus_cross(w, &[v_x, v_y, v_z], &[s_x, s_y, s_z], &load(w, &group.n));
        along(w, &load(w, &group.q), w.load(&group.root), &u)
    }

    #[inline(always)]
    fn visit<W: Wide>(w: W, group: &Group, y: &[W::F; 3], u: &[W::F; 3]) -> [W::F; 3] {
        let (n, zero) = (load(w, &group.n), w.zero());
        let (y_n, u_n) = (dot(w, &n, y), dot(w, &n, u));
        let pressed = w.max(zero, w.less(y_n, w.load(&group.kappa), u_n));
        // τ_T = (p̂ − û)_T.
        let slid = along(w, &minus(w, y, u), w.sub(u_n, y_n), &n);
        let length = w.sqrt(w.max(w.splat(&NO_LENGTH), dot(w, &slid, &slid)));
        let share = w.min(w.div(w.mul(w.load(&group.mu), pressed), length), w.splat(&1.0));
        along(w, &times(w, pressed, &n), share, &slid)
    }

    #[inline(always)]
    fn claim<W: Wide>(w: W, group: &Group, u: &[W::F; 3], change: &[W::F; 3]) -> [W::F; 3] {
        let (n, one) = (load(w, &group.n), w.splat(&1.0));
        let beside = w.mul(w.sub(w.div(one, w.load(&group.kappa)), one), dot(w, &n, change));
        along(w, &plus(w, u, change), beside, &n)
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
        let (zero, root) = (w.zero(), w.load(&group.root));
        let p = times(w, root, change);
        let pushes = w.transpose([p[0], p[1], p[2], zero]);
        let [x, y, z] = cross(w, &load(w, &group.n), &p);
        let turns = w.transpose([x, y, z, zero]);
        for i in 0..LANES {
            let (at_a, at_b) = (pairs[i][0] as usize, pairs[i][1] as usize);
            let (m_a, m_b) = (w.splat(&bodies.get(at_a)[0].0[3]), w.splat(&bodies.get(at_b)[0].0[3]));
            let (j_a, j_b) = (w.splat(&bodies.get(at_a)[1].0[3]), w.splat(&bodies.get(at_b)[1].0[3]));
            let (l_a, l_b) = (w.splat(&group.arms[0].0[i]), w.splat(&group.arms[1].0[i]));
            let v_a = w.less(a[i][0], m_a, pushes[i]);
            let v_b = w.more(b[i][0], m_b, pushes[i]);
            let s_a = w.less(a[i][1], w.mul(l_a, j_a), turns[i]);
            let s_b = w.less(b[i][1], w.mul(l_b, j_b), turns[i]);
            bodies.set(at_a, [w.store(v_a), w.store(s_a)]);
            bodies.set(at_b, [w.store(v_b), w.store(s_b)]);
        }
    }

    #[inline(always)]
    fn apart<W: Wide>(w: W, group: &Group, claimed: &[W::F; 3], u: &[W::F; 3]) -> W::F {
        let (n, one) = (load(w, &group.n), w.splat(&1.0));
        let apart = minus(w, claimed, u);
        let normal = dot(w, &n, &apart);
        let tangent = against(w, &apart, normal, &n);
        // Without friction the law knows no tangent.
        let rough = w.min(w.mul(w.load(&group.mu), w.splat(&MANY)), one);
        let square = w.more(w.mul(normal, normal), rough, dot(w, &tangent, &tangent));
        let root = w.load(&group.root);
        w.div(square, w.mul(root, root))
    }
}
