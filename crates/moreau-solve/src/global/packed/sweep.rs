//! One sweep over the packed contacts, block by block, and what is seen of them between sweeps.

use super::Packing;
use super::kernel::{Kernel, Places, Seen, Sides};
use super::shared::Shared;
use super::vector::{along, load, minus, more_dot, store};
use crate::wide::{Four, Kernels, LANES, Wide, WithWide, total, with_wide};
use rayon::prelude::*;
use std::ops::Range;

/// ‖f‖², ‖z⁺ − z‖² and f·(z⁺ − z), with f = z⁺ − y what the sweep changed, in the norm of the diagonal of W.
pub(super) type Sums = [f64; 3];

/// The part of a sweep that one thread does without asking another.
struct Block<'a, K: Kernel<B, C>, P, const B: usize, const C: usize> {
    groups: &'a [K::Group],
    bodies: P,
    z: &'a [[Four; C]],
    /// z₋, which z⁺ replaces.
    before: &'a mut [[Four; C]],
    claimed: &'a mut [[Four; C]],
    beta: f64,
}

/// The rows of both sides of a group.
#[inline(always)]
fn sides<W: Wide, const B: usize>(w: W, bodies: &impl Seen<[Four; B]>, pairs: &[[u32; 2]; LANES]) -> Sides<W::F, B> {
    let mut sides = [[[w.zero(); B]; LANES]; 2];
    for i in 0..LANES {
        for side in 0..2 {
            let body = bodies.get(pairs[i][side] as usize);
            for row in 0..B {
                sides[side][i][row] = w.load(&body[row]);
            }
        }
    }
    sides
}

impl<K: Kernel<B, C>, P: Places<[Four; B]>, const B: usize, const C: usize> Block<'_, K, P, B, C> {
    fn sweep(self, kernels: Kernels, claim: bool) -> Sums {
        if claim {
            with_wide(kernels, Visits::<K, _, B, C, true>(self))
        } else {
            with_wide(kernels, Visits::<K, _, B, C, false>(self))
        }
    }
}

/// Visits; with CLAIM it keeps the velocities that they claim.
struct Visits<'a, K: Kernel<B, C>, P, const B: usize, const C: usize, const CLAIM: bool>(Block<'a, K, P, B, C>);

impl<K: Kernel<B, C>, P: Places<[Four; B]>, const B: usize, const C: usize, const CLAIM: bool> WithWide
    for Visits<'_, K, P, B, C, CLAIM>
{
    type Output = Sums;

    #[inline(always)]
    fn run<W: Wide>(self, w: W) -> Sums {
        let Block { groups, mut bodies, z, before, claimed, beta } = self.0;
        let n = groups.len();
        let (z, before, beta) = (&z[..n], &mut before[..n], w.splat(&beta));
        let claimed = if CLAIM { &mut claimed[..n] } else { &mut [] };
        let [mut changed, mut walked, mut together] = [w.zero(); 3];
        for g in 0..n {
            let (group, now) = (&groups[g], load(w, &z[g]));
            let y = along(w, &now, beta, &minus(w, &now, &load(w, &before[g])));
            let pairs = *K::pairs(group);
            let sides = sides(w, &bodies, &pairs);
            let u = K::velocity(w, group, &sides);
            let next = K::visit(w, group, &y, &u);
            let change = minus(w, &next, &y);
            K::push(w, group, pairs, &mut bodies, &sides, &change);
            before[g] = store(w, next);
            if CLAIM {
                claimed[g] = store(w, K::claim(w, group, &u, &change));
            }
            let way = minus(w, &next, &now);
            changed = more_dot(w, changed, &change, &change);
            walked = more_dot(w, walked, &way, &way);
            together = more_dot(w, together, &change, &way);
        }
        [total(&w.store(changed)), total(&w.store(walked)), total(&w.store(together))]
    }
}

/// Adds impulses to the bodies.
struct Deposit<'a, K: Kernel<B, C>, P, const B: usize, const C: usize>(&'a [K::Group], P, &'a [[Four; C]]);

impl<K: Kernel<B, C>, P: Places<[Four; B]>, const B: usize, const C: usize> WithWide for Deposit<'_, K, P, B, C> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self, w: W) {
        let Self(groups, mut bodies, z) = self;
        for (group, z) in groups.iter().zip(z) {
            let pairs = *K::pairs(group);
            let sides = sides(w, &bodies, &pairs);
            K::push(w, group, pairs, &mut bodies, &sides, &load(w, z));
        }
    }
}

/// Σ ‖ũ − u‖ and Σ ‖ũ − u‖² with the velocities u of the impulses of now.
struct Watch<'a, K: Kernel<B, C>, const B: usize, const C: usize>(&'a [K::Group], &'a [[Four; B]], &'a [[Four; C]]);

impl<K: Kernel<B, C>, const B: usize, const C: usize> WithWide for Watch<'_, K, B, C> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<W: Wide>(self, w: W) -> [f64; 2] {
        let Self(groups, bodies, claimed) = self;
        let [mut lengths, mut squares] = [w.zero(); 2];
        for (group, claimed) in groups.iter().zip(claimed) {
            let sides = sides(w, &bodies, K::pairs(group));
            let apart = K::apart(w, group, &load(w, claimed), &K::velocity(w, group, &sides));
            lengths = w.add(lengths, w.sqrt(apart));
            squares = w.add(squares, apart);
        }
        [total(&w.store(lengths)), total(&w.store(squares))]
    }
}

/// state ← state + β (state − earlier), and earlier ← state.
struct Extrapolate<'a, const B: usize>(&'a mut [[Four; B]], &'a mut [[Four; B]], f64);

impl<const B: usize> WithWide for Extrapolate<'_, B> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self, w: W) {
        let Self(state, earlier, beta) = self;
        let beta = w.splat(&beta);
        for (now, before) in state.as_flattened_mut().iter_mut().zip(earlier.as_flattened_mut()) {
            let kept = w.load(now);
            *now = w.store(w.more(kept, beta, w.sub(kept, w.load(before))));
            *before = w.store(kept);
        }
    }
}

/// A sweep takes several threads where a wave has so many blocks to share on average: with fewer, threads wait for each other.
const WORTH_SHARING: usize = 3;

/// So many bodies are one task.
const BODIES: usize = 2048;

impl<K: Kernel<B, C>, const B: usize, const C: usize> Packing<K, B, C> {
    /// Whether blocks are shared among threads; the bits are the same either way.
    fn shares(&self) -> bool {
        self.layout.blocks.len() >= WORTH_SHARING * self.layout.waves.len() && rayon::current_num_threads() > 1
    }

    /// y = z + β (z − z₋), one sweep from y to z⁺, and what changed. With `claim` the visits' velocities are kept.
    pub(super) fn sweep(&mut self, beta: f64, claim: bool) -> Sums {
        self.extrapolate(beta);
        self.sums.resize(self.layout.blocks.len(), Sums::default());
        if self.shares() {
            self.sweep_shared(beta, claim);
        } else {
            self.sweep_alone(beta, claim);
        }
        std::mem::swap(&mut self.z, &mut self.before);
        self.sums.iter().fold([0.0; 3], |[a, b, c], part| [a + part[0], b + part[1], c + part[2]])
    }

    fn sweep_alone(&mut self, beta: f64, claim: bool) {
        for (range, sums) in self.layout.blocks.iter().zip(&mut self.sums) {
            let block = Block::<K, _, B, C> {
                groups: &self.groups[range.clone()],
                bodies: self.state.as_mut_slice(),
                z: &self.z[range.clone()],
                before: &mut self.before[range.clone()],
                claimed: &mut self.claimed[range.clone()],
                beta,
            };
            *sums = block.sweep(self.kernels, claim);
        }
    }

    #[allow(unsafe_code)]
    fn sweep_shared(&mut self, beta: f64, claim: bool) {
        let (bodies, before) = (Shared::new(&mut self.state), Shared::new(&mut self.before));
        let (claimed, sums) = (Shared::new(&mut self.claimed), Shared::new(&mut self.sums));
        for wave in &self.layout.waves {
            wave.clone().into_par_iter().for_each(|b| {
                let range = self.layout.blocks[b].clone();
                // SAFETY: blocks have groups of their own, and those of a wave have bodies of their own; see `Layout`.
                let (block, sums) = unsafe {
                    let block = Block::<K, _, B, C> {
                        groups: &self.groups[range.clone()],
                        bodies: bodies.scattered(),
                        z: &self.z[range.clone()],
                        before: before.part(range.clone()),
                        claimed: claimed.part(range),
                        beta,
                    };
                    (block, sums.part(b..b + 1))
                };
                sums[0] = block.sweep(self.kernels, claim);
            });
        }
    }

    /// The state of y, since it is linear in the impulses; that of z stays as the earlier one.
    fn extrapolate(&mut self, beta: f64) {
        let kernels = self.kernels;
        if beta == 0.0 {
            self.earlier.clone_from(&self.state);
        } else if self.shares() {
            let chunks = self.state.par_chunks_mut(BODIES).zip(self.earlier.par_chunks_mut(BODIES));
            chunks.for_each(|(state, earlier)| with_wide(kernels, Extrapolate(state, earlier, beta)));
        } else {
            with_wide(kernels, Extrapolate(&mut self.state, &mut self.earlier, beta));
        }
    }

    /// The state of the impulses z, for bodies at rest.
    pub(super) fn deposit(&mut self) {
        for range in &self.layout.blocks {
            let (groups, z) = (&self.groups[range.clone()], &self.z[range.clone()]);
            with_wide(self.kernels, Deposit::<K, _, B, C>(groups, self.state.as_mut_slice(), z));
        }
    }

    /// Σ ‖ũ − u‖ and Σ ‖ũ − u‖² after a sweep that kept the claimed velocities.
    pub(super) fn watch(&mut self) -> [f64; 2] {
        let (groups, claimed, state, kernels) = (&self.groups, &self.claimed, self.state.as_slice(), self.kernels);
        let see = |range: &Range<usize>| {
            let [lengths, squares] = with_wide(kernels, Watch::<K, B, C>(&groups[range.clone()], state, &claimed[range.clone()]));
            [lengths, squares, 0.0]
        };
        if self.shares() {
            let blocks = self.layout.blocks.par_iter().zip(&mut self.sums);
            blocks.for_each(|(range, sums)| *sums = see(range));
        } else {
            self.layout.blocks.iter().zip(&mut self.sums).for_each(|(range, sums)| *sums = see(range));
        }
        self.sums.iter().fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]])
    }
}
