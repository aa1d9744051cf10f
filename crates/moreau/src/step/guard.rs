//! Limits that a step must keep to, and what is said of one that does not.

use super::Workspace;
use super::localise::smaller;
use crate::bodies::Bodies;
use crate::contacts::Contact;
use crate::space::Space;
use crate::world::{Guard, World};
use moreau_solve::tasks;

/// How a step broke a limit of [`Guard`](crate::world::Guard).
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Breach {
    /// Two bodies overlap too much at the predicted configuration.
    #[error("bodies {} and {} overlap by {depth:.3e} m, where {allowed:.3e} m are allowed", bodies[0], bodies[1])]
    Penetration {
        /// Their indices.
        bodies: [usize; 2],
        /// How deep, m.
        depth: f64,
        /// How deep it may be, m.
        allowed: f64,
    },
    /// The centre of a free body is outside the domain.
    #[error("body {body} left the domain: its centre is at {position:?} m")]
    Domain {
        /// Its index.
        body: usize,
        /// Its centre, m.
        position: Vec<f64>,
    },
    /// The step created energy.
    #[error("{created:.3e} J were created, where {allowed:.3e} J are allowed a step")]
    Energy {
        /// How much, J.
        created: f64,
        /// How much may be, J.
        allowed: f64,
    },
}

/// Returns the first limit that is broken after a (part of a) step that created so much energy (J).
pub(super) fn check<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &Workspace<S, D, N>,
    created: f64,
) -> Option<Breach> {
    let (guard, bodies) = (&world.guard, &world.bodies);
    let deepest = || guard.penetration.and_then(|part| penetration(bodies, &work.found, part));
    let outside = || guard.domain.and_then(|domain| outside(bodies, &domain));
    deepest().or_else(outside).or_else(|| energy(guard, created))
}

/// Returns the limit of energy if a step that created so much (J) broke it.
pub(super) fn energy<const D: usize>(guard: &Guard<D>, created: f64) -> Option<Breach> {
    let allowed = guard.energy.filter(|&allowed| created > allowed)?;
    Some(Breach::Energy { created, allowed })
}

/// Returns the bounding radius of the smaller body of a contact, m.
pub(super) fn smaller_radius<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    contact: &Contact<D>,
) -> f64 {
    smaller(bodies, [contact.key.a, contact.key.b].map(|body| body as usize))
}

/// The overlap that exceeds what is allowed by most.
fn penetration<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    found: &[Contact<D>],
    part: f64,
) -> Option<Breach> {
    let allowed = |c: &Contact<D>| part * smaller_radius(bodies, c);
    let excess = |c: usize| -found[c].gap / allowed(&found[c]);
    let worse = |a: Option<usize>, b: Option<usize>| if b.map_or(0.0, excess) > a.map_or(0.0, excess) { b } else { a };
    let worst = tasks::fold(0..found.len(), &|part: std::ops::Range<usize>| part.map(Some).fold(None, worse), &worse)?;
    let contact = &found[worst];
    let bodies = [contact.key.a, contact.key.b].map(|i| i as usize);
    (excess(worst) > 1.0).then(|| Breach::Penetration { bodies, depth: -contact.gap, allowed: allowed(contact) })
}

/// The first free body whose centre is outside.
fn outside<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    [low, high]: &[[f64; D]; 2],
) -> Option<Breach> {
    let is_outside = |&i: &usize| {
        let position = &bodies.pose[i].position;
        bodies.is_free(i) && !(0..D).all(|k| (low[k]..=high[k]).contains(&position[k]))
    };
    let body = tasks::fold(0..bodies.len(), &|mut part: std::ops::Range<usize>| part.find(is_outside), &Option::or)?;
    Some(Breach::Domain { body, position: bodies.pose[body].position.to_vec() })
}
