//! Which components of impulses and velocities a step has to know.

use crate::contacts::Contact;
use crate::shape::Shape;
use crate::space::Space;
use crate::world::World;
use moreau_solve::{Law, tasks};
use std::ops::Range;

/// Which coordinates a step needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::step) enum Kind {
    /// Some contact has friction, or there are joints.
    Full,
    /// None has: normals only.
    Normal,
    /// Some contact has friction, and all bodies are round.
    Round,
    /// None has, and all bodies are round: normals only, which never turn a body.
    Central,
}

impl Kind {
    /// The kind that these contacts need. Where an answer holds of all laws or bodies, contacts are not asked one by one.
    pub(in crate::step) fn of<S: Space<D, N>, const D: usize, const N: usize>(
        world: &World<S, D, N>,
        free: &[[f64; N]],
        found: &[Contact<D>],
    ) -> Self {
        if !world.joints.is_empty() {
            return Self::Full;
        }
        let bodies = &world.bodies;
        let of_contacts = |holds: &(dyn Fn(&Contact<D>) -> bool + Sync)| {
            tasks::fold(0..found.len(), &|part: Range<usize>| found[part].iter().all(holds), &|a, b| a && b)
        };
        let of_those_that_touch = |holds: &(dyn Fn(usize) -> bool + Sync)| {
            let of_all = tasks::fold(0..bodies.len(), &|mut part: Range<usize>| part.all(holds), &|a, b| a && b);
            of_all || of_contacts(&|c| holds(c.key.a as usize) && holds(c.key.b as usize))
        };
        let law = |c: &Contact<D>| world.laws.get(bodies.material[c.key.a as usize], bodies.material[c.key.b as usize]);
        let frictionless = world.laws.iter().all(Law::is_frictionless) || of_contacts(&|c| law(c).is_frictionless());
        // A driven body that turns moves others along its normals, unless it is round.
        let turns = |v: &[f64; N]| v[D..] != [0.0; N][D..];
        let still = |i: usize| !turns(&bodies.velocity[i]) && !turns(&free[i]);
        let round = |i: usize| bodies.shape[i].is_round() || !bodies.is_free(i) && (!frictionless || still(i));
        match (frictionless, of_those_that_touch(&round)) {
            (false, false) => Self::Full,
            (true, false) => Self::Normal,
            (false, true) => Self::Round,
            (true, true) => Self::Central,
        }
    }
}
