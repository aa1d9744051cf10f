//! Stages 4 to 8: which bodies meet, and the problem that this poses. What the step before left is taken up here.

use super::localise::{Localiser, margins, speed};
use super::system::Kind;
use super::turning::Turning;
use super::{Localised, Workspace};
use crate::contacts::ContactKey;
use crate::shape::Shape;
use crate::space::Space;
use crate::world::{Rows, Start, World};
use moreau_solve::{Acts, tasks};

/// Finds the contacts at the predicted configuration.
pub(super) fn detect<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    h: f64,
) {
    let bodies = &world.bodies;
    let approach = world.laws.iter().any(|law| law.acts() == Acts::Approach);
    tasks::fill(&mut work.reach, bodies.len(), |i| reach(world, i, &work.free[i], h, approach));
    work.detector.detect::<S, N>(&bodies.shape, &work.middle, &work.reach, |i| !bodies.is_free(i), &mut work.found);
    work.joints.part(&world.joints, &mut work.found);
}

/// How far from body `i` contacts matter. Closed ones: rounding. On approach: what it may travel in the step, doubled for what
/// other contacts add to its speed, and a part of its size.
fn reach<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    i: usize,
    free: &[f64; N],
    h: f64,
    approach: bool,
) -> f64 {
    let [beside, rounding] = margins(&world.bodies, i, 0.01);
    if !approach {
        return rounding;
    }
    let radius = world.bodies.shape[i].bounding_radius().unwrap_or(0.0);
    let fastest = speed::<D, N>(radius, free).max(speed::<D, N>(radius, &world.bodies.velocity[i]));
    2.0 * h * fastest + beside + rounding
}

/// Localises the contacts that were found into the system of the coordinates that they need.
pub(super) fn assemble<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    h: f64,
) -> Kind {
    let bodies = &world.bodies;
    let kind = Kind::of(world, &work.free, &work.found);
    let spins = (kind != Kind::Central).then(|| {
        work.spins.fill::<S, D, N>(&work.middle, [&bodies.velocity, &work.free]);
        &work.spins
    });
    work.remainders.clear();
    if world.settings.rows == Rows::Turning {
        let spins = spins.map(|spins| spins.before.as_slice());
        Turning { bodies, middle: &work.middle, spins, h }.fill(&work.found, &work.previous, &mut work.remainders);
    }
    let last = if world.settings.rows == Rows::Turning { work.last.as_slice() } else { &[] };
    let localiser = Localiser { world, middle: &work.middle, free: &work.free, spins, remainders: &work.remainders, last, h };
    localiser.each(&work.found, &mut work.contacts);
    work.joints.localise(world, &work.middle, &work.free, h);
    if world.settings.start == Start::Warm {
        recall(&work.previous, &mut work.contacts);
        work.joints.recall();
    }
    work.systems.get(kind).fill(bodies, &work.middle, &work.contacts, &mut work.curve);
    if kind == Kind::Full {
        work.systems.full.join(bodies, &work.joints.blocks);
    }
    kind
}

/// Gives contacts the impulses of the step before, as far as they had any. Both lists are sorted by key.
fn recall<const D: usize>(previous: &[(ContactKey, [f64; D])], contacts: &mut [Localised<D>]) {
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

/// Keeps the impulses of a step that was taken, for the next to start from.
pub(super) fn remember<S: Space<D, N>, const D: usize, const N: usize>(work: &mut Workspace<S, D, N>) {
    let contacts = &work.contacts;
    tasks::fill(&mut work.previous, contacts.len(), |c| (contacts[c].contact.key, contacts[c].impulse));
    work.joints.remember();
}
