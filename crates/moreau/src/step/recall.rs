//! Stage 5: the impulses of the step before, and what becomes of them for the next.

use super::localise::smaller;
use super::{Localised, Workspace};
use crate::contacts::ContactKey;
use crate::space::Space;
use crate::world::{Rows, Start, World};
use moreau_solve::block::norm;
use moreau_solve::operator::Standing;
use moreau_solve::tasks;

/// What of the way to the least impulses a start goes at once.
const PART: f64 = 0.5;

/// A contact that goes no farther in a step than this part of the smaller body's size does not move; with a gap below that it touches.
const AT_REST: f64 = 1e-7;

/// Gives contacts the impulses of the step before, as far as they had any. Both lists are sorted by key.
pub(super) fn recall<const D: usize>(previous: &[(ContactKey, [f64; D])], contacts: &mut [Localised<D>]) {
    tasks::parts(contacts, |_, contacts| {
        let Some(first) = contacts.first() else { return };
        let mut last = previous[previous.partition_point(|(before, _)| *before < first.contact.key)..].iter().peekable();
        for contact in contacts {
            let key = contact.contact.key;
            while last.next_if(|(before, _)| *before < key).is_some() {}
            if let Some((_, r)) = last.next_if(|(before, _)| *before == key) {
                contact.impulse = *r;
            }
        }
    });
}

/// Keeps the impulses of a step that was taken, for the next to start from, and the velocities at its beginning.
pub(super) fn remember<S: Space<D, N>, const D: usize, const N: usize>(work: &mut Workspace<S, D, N>, velocity: &Vec<[f64; N]>) {
    work.undo.put_aside(&mut work.previous, &mut work.last);
    work.last.clone_from(velocity);
    let contacts = &work.contacts;
    tasks::fill(&mut work.previous, contacts.len(), |c| (contacts[c].contact.key, contacts[c].impulse));
    work.joints.remember();
}

/// After how many steps an equilibrium is looked for again, beside those that are powers of two. One that was found is kept by starting from it.
const EVERY: u64 = 64;

/// After how many steps impulses are made lighter again: they wander slowly.
const LIGHTER_EVERY: u64 = 16;

/// Among so few contacts both are done in each step that may need it.
const FEW: usize = 128;

/// Begins with an equilibrium where one is found, and takes from the impulses of contacts at rest what no velocity tells, where the last solve had sweeps to add some (theory (87)).
pub(super) fn lighten<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    h: f64,
) {
    let warm = world.settings.start == Start::Warm;
    if world.settings.rows == Rows::Frozen || (warm && work.swept < 2 && world.steps > 0) {
        return;
    }
    let (contacts, blocks, bodies) = (&work.contacts, &work.joints.blocks, &world.bodies);
    let standing = |c: usize| {
        let (before, gap, pair) = match contacts.get(c) {
            Some(Localised { before, contact, .. }) => {
                (before, contact.gap, [contact.key.a, contact.key.b].map(|body| Some(body as usize)))
            }
            None => (&blocks[c - contacts.len()].before, 0.0, blocks[c - contacts.len()].bodies),
        };
        let bound = AT_REST * smaller(bodies, pair.into_iter().flatten());
        match h * norm(before) <= bound {
            true if gap <= bound => Standing::Rests,
            true => Standing::Open,
            false => Standing::Moves,
        }
    };
    let few = contacts.len() + blocks.len() <= FEW;
    let balance = !warm || few || world.steps.is_multiple_of(EVERY) || world.steps.is_power_of_two();
    let lighten = warm && (few || world.steps.is_multiple_of(LIGHTER_EVERY));
    if balance {
        let root = &bodies.root_inverse_mass;
        let held = |i: usize, k: usize| {
            let root = root[i][k];
            if root > 0.0 { (bodies.velocity[i][k] - work.free[i][k]) / root } else { 0.0 }
        };
        tasks::fill(&mut work.held, bodies.len(), |i| std::array::from_fn(|k| held(i, k)));
    }
    let ways = (balance.then_some(work.held.as_slice()), lighten.then_some(PART));
    work.systems.full.least_start(&standing, ways, &mut work.lightest);
}
