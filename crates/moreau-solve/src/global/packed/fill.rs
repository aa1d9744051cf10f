//! From the problem into the arrays of the kernels, and back.

use super::kernel::{Kernel, Lane};
use super::{Balls, NONE, Packing};
use crate::block::Vector;
use crate::tasks;
use crate::wide::{Four, LANES};
use crate::{Cone, Operator, Problem};

impl<K: Kernel<B, C>, const B: usize, const C: usize> Packing<K, B, C> {
    /// Packs the problem with the impulses to start from.
    pub(super) fn fill<O: Operator<D>, const D: usize>(
        &mut self,
        problem: &Problem<'_, O, D>,
        balls: &Balls<D>,
        r: &[Vector<D>],
    ) {
        self.layout.arrange(balls);
        self.bodies(balls);
        let layout = &self.layout;
        tasks::fill(&mut self.groups, layout.members.len(), |g| {
            let block = layout.blocks.partition_point(|groups| groups.end <= g);
            let wall = (layout.touched.len() + block) as u32;
            let mut group = K::Group::default();
            for (lane, &c) in layout.members[g].iter().enumerate() {
                if c == NONE {
                    K::blank(&mut group, wall);
                    break;
                }
                let (c, contact) = (c as usize, &balls.contacts[c as usize]);
                let rows = contact.pair.map(|body| layout.rows.get(body as usize).copied().unwrap_or(wall));
                K::fill(&mut group, lane, &Lane { contact, rows, q: &problem.q[c], cone: problem.cones[c] });
            }
            group
        });
        tasks::fill(&mut self.z, layout.members.len(), |g| {
            let mut z = [Four::default(); C];
            for (lane, &c) in layout.members[g].iter().enumerate().filter(|(_, c)| **c != NONE) {
                let contact = &balls.contacts[c as usize];
                let p = K::pack(contact, &r[c as usize], K::scale(contact));
                for k in 0..C {
                    z[k].0[lane] = p[k];
                }
            }
            z
        });
        self.before.clone_from(&self.z);
        self.claimed.clone_from(&self.z);
        self.best.clone_from(&self.z);
    }

    /// The bodies at rest, each in its row, and a wall for each block.
    pub(super) fn bodies<const D: usize>(&mut self, balls: &Balls<D>) {
        self.state.clear();
        self.state.extend(self.layout.touched.iter().map(|&body| K::body(balls.bodies[body as usize])));
        self.state.resize(self.layout.touched.len() + self.layout.blocks.len(), [Four::default(); B]);
    }

    /// Writes the impulses into `r`, and the claimed velocities into `claimed`, both by contact.
    pub(super) fn read<const D: usize>(&self, balls: &Balls<D>, r: &mut [Vector<D>], claimed: &mut [Vector<D>]) {
        self.read_impulses(balls, &self.z, r);
        let contact = |c: usize| &balls.contacts[c];
        tasks::each(claimed, |c, u| *u = K::unpack(contact(c), &self.of(&self.claimed, c), K::scale(contact(c))));
    }

    /// Writes packed impulses into `r`, by contact.
    pub(super) fn read_impulses<const D: usize>(&self, balls: &Balls<D>, packed: &[[Four; C]], r: &mut [Vector<D>]) {
        let contact = |c: usize| &balls.contacts[c];
        tasks::each(r, |c, r| *r = K::unpack(contact(c), &self.of(packed, c), 1.0 / K::scale(contact(c))));
    }

    /// What packed numbers hold for contact `c`.
    fn of(&self, packed: &[[Four; C]], c: usize) -> [f64; C] {
        let slot = self.layout.slots[c] as usize;
        let group = &packed[slot / LANES];
        std::array::from_fn(|k| group[k].0[slot % LANES])
    }
}

/// Whether every contact moves and obeys a law that kernels know.
pub(super) fn suits<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, balls: &Balls<D>) -> bool {
    let known = |cone: Cone| matches!(cone, Cone::Signorini | Cone::Coulomb(_));
    let moves = |mobility: f64| mobility.is_normal() && (1.0 / mobility).is_normal();
    problem.cones.iter().all(|&cone| known(cone)) && balls.contacts.iter().all(|contact| contact.mobility.into_iter().all(moves))
}
