//! Stages 4 to 8: which bodies meet, and the problem that this poses. What the step before left is taken up here.

use super::localise::{DEEPEST, Localiser, margins, speed};
use super::system::Kind;
use super::turning::Turning;
use super::{Workspace, recall};
use crate::bodies::Bodies;
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
    if approach {
        tasks::fill(&mut work.speeds, bodies.len(), |i| fastest(world, i, &work.free[i]));
        hand_on(bodies, &work.previous, &mut work.speeds);
    }
    tasks::fill(&mut work.reach, bodies.len(), |i| {
        let [beside, rounding] = margins(bodies, i, 0.01);
        if approach {
            return 2.0 * h * work.speeds[i] + beside + rounding;
        }
        // What acts when closed is looked for farther off where it would be passed.
        let way = 2.0 * h * fastest(world, i, &work.free[i]);
        if way > DEEPEST * bodies.shape[i].bounding_radius().unwrap_or(f64::INFINITY) {
            way + beside + rounding
        } else {
            rounding
        }
    });
    work.detector.detect::<S, N>(&bodies.shape, &work.middle, &work.reach, |i| !bodies.is_free(i), &mut work.found);
    work.joints.part(&world.joints, &mut work.found);
}

/// The greatest speed of a point of body `i` in the step, as far as it is known before the solve, m/s. Contacts matter as far as it may travel, doubled for what
/// other contacts add to its speed, and by a part of its size. Those that act only when closed matter within rounding, but for what would be passed.
fn fastest<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, i: usize, free: &[f64; N]) -> f64 {
    let radius = world.bodies.shape[i].bounding_radius().unwrap_or(0.0);
    speed::<D, N>(radius, free).max(speed::<D, N>(radius, &world.bodies.velocity[i]))
}

/// Through how many bodies an impact is handed on in looking for contacts.
const HANDED_ON: usize = 3;

/// Gives free bodies the speed of those that they touched in the step before: what is hit may go as fast as what hits it, and so may what that touches. Of a body at
/// rest contacts would be found a step too late otherwise.
fn hand_on<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    previous: &[(ContactKey, [f64; D])],
    speeds: &mut [f64],
) {
    for _ in 0..HANDED_ON {
        for (key, _) in previous {
            let pair = [key.a, key.b].map(|body| body as usize);
            let fastest = pair.iter().filter_map(|&body| speeds.get(body).copied()).fold(0.0, f64::max);
            pair.into_iter().filter(|&body| body < bodies.len() && bodies.is_free(body)).for_each(|body| speeds[body] = fastest);
        }
    }
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
    let (free, remainders, previous) = (&work.free, &work.remainders, &work.previous);
    let localiser = Localiser { world, middle: &work.middle, free, spins, remainders, last, previous, h };
    localiser.each(&work.found, &mut work.contacts);
    work.joints.localise(world, &work.middle, &work.free, h);
    if world.settings.start == Start::Warm {
        recall::recall(&work.previous, &mut work.contacts);
        work.joints.recall();
    }
    work.systems.get(kind).fill(bodies, &work.middle, &work.contacts, &mut work.curve);
    if kind == Kind::Full {
        work.systems.full.join(bodies, &work.joints.blocks);
        recall::lighten(world, work, h);
    }
    kind
}
