//! Positions put right where bodies overlap by more than is allowed.
//!
//! The scheme forbids velocities that would make an overlap deeper, but keeps one that is there: of an impact that was found a step late, of
//! frames that turned during a step, of the solver's tolerance over many steps. Where an overlap exceeds the allowed part ε of the smaller
//! body's radius R, all bodies are moved by the least displacement in the norm of M that leaves none deeper than half of that,
//!
//!   min ½ δ·M δ   with   gap + H_n* δ ≥ −½ ε R   at every contact,
//!
//! which is the problem of a step without friction with gaps for velocities; theory (67). That is done at the end of a step, which is what is drawn, and
//! at the prediction of the next, where contacts act. Velocities stay as they are, so no kinetic energy
//! is made; the height that weights gain is booked as energy created.

mod doubt;
mod held;

use super::integrate::predict;
use super::localise::{margins, smaller, speed};
use super::record::energies;
use super::system::Kind;
use super::{Localised, StepError, Workspace};
use crate::bodies::Bodies;
use crate::contacts::Contact;
use crate::shape::Shape;
use crate::space::Space;
use crate::world::World;
use held::{Held, shift};
use moreau_solve::{Criterion, Settings, Status, tasks};
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// How often the problem, which is linear in δ, is posed anew in one step: of a thousand stones that land half of what is left remains each time.
const ROUNDS: usize = 16;

/// In the first of them bodies are also turned, which disturbs least. Then they are only shifted: gaps of flat faces are linear in that, where
/// one that turns dips its other corners in.
const TURNING: usize = 4;

/// What a solve of it is good for: a displacement is right to a small part of what is allowed.
const TOLERANCE: f64 = 1e-6;

/// Scratch, kept from step to step.
pub(super) struct Correction<const D: usize, const N: usize> {
    doubtful: Vec<(u32, u32)>,
    reach: Vec<f64>,
    found: Vec<Contact<D>>,
    contacts: Vec<Localised<D>>,
    held: Held<D, N>,
    /// How far the bodies came last, m and rad.
    displacement: Vec<[f64; N]>,
}

impl<const D: usize, const N: usize> Default for Correction<D, N> {
    fn default() -> Self {
        let (doubtful, reach, found, contacts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { doubtful, reach, found, contacts, held: Held::default(), displacement: Vec::new() }
    }
}

/// Puts the positions right at the end of a step, if that is asked for and some overlap may be too deep there; gives the seconds that contacts
/// were looked for.
///
/// # Errors
/// [`StepError::Interrupted`] alone, as of all functions here.
pub(super) fn at_end<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    stop: &AtomicBool,
) -> Result<f64, StepError> {
    let Some(part) = world.settings.max_penetration else { return Ok(0.0) };
    let clock = Instant::now();
    let doubt = doubt::may_be_too_deep(world, work, part);
    let seconds = clock.elapsed().as_secs_f64();
    Ok(if doubt { seconds + positions(world, work, (part, 0.0), stop)? } else { seconds })
}

/// Puts the positions right where contacts that were found at the prediction of a step of length `h` are too deep: of the solver's tolerance, of an impact
/// that turned what the rows of the beginning did not foresee, of the scene as it was given, of bodies that an event brought, of a drive that jumped. True
/// if bodies were moved; the caller then finds contacts anew.
pub(super) fn at_start<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    h: f64,
    stop: &AtomicBool,
) -> Result<bool, StepError> {
    let Some(part) = world.settings.max_penetration else { return Ok(false) };
    let too_deep = |range: Range<usize>| work.found[range].iter().any(|c| is_too_deep(&world.bodies, c, part));
    let too_deep = tasks::fold(0..work.found.len(), &too_deep, &|a, b| a || b);
    if too_deep {
        positions(world, work, (part, h), stop)?;
    }
    Ok(too_deep)
}

/// Whether an overlap is deeper than is allowed; by rounding is not.
fn is_too_deep<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    contact: &Contact<D>,
    part: f64,
) -> bool {
    contact.gap < 0.0 && -contact.gap > (1.0 + 1e-9) * allowed(bodies, pair_of(contact), part)
}

/// Moves the bodies until no overlap is too deep where a step of length `ahead` predicts them; gives the seconds that contacts were looked for.
fn positions<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    (part, ahead): (f64, f64),
    stop: &AtomicBool,
) -> Result<f64, StepError> {
    let mut seconds = 0.0;
    look_ahead(world, work, ahead);
    let since = world.settings.h;
    let (_, before) = energies(&world.bodies, &world.gravity);
    work.correction.displacement.clear();
    work.correction.displacement.extend(world.bodies.velocity.iter().map(|v| v.map(|x| since * x)));
    work.correction.held.begin(world);
    for round in 0..ROUNDS {
        let clock = Instant::now();
        detect(world, work, part);
        seconds += clock.elapsed().as_secs_f64();
        let found = &work.correction.found;
        if !found.iter().any(|c| is_too_deep(&world.bodies, c, part)) {
            break;
        }
        let kind = match round {
            // What is joined cannot give way without turning.
            _ if !world.joints.is_empty() => Kind::Full,
            ..TURNING => Kind::Normal,
            _ => Kind::Central,
        };
        if !displace(world, work, (part, kind), stop)? {
            break;
        }
        look_ahead(world, work, ahead);
    }
    let (_, after) = energies(&world.bodies, &world.gravity);
    work.ledger.dissipate(before - after);
    Ok(seconds)
}

/// Places the bodies where a step of length `h` looks for contacts.
fn look_ahead<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, work: &mut Workspace<S, D, N>, h: f64) {
    predict(&world.bodies, h, world.settings.theta, &mut work.middle);
}

/// No point of body `i` goes farther than this in the time in which it is displaced so (m and rad; or a velocity, then in a second).
fn way_of<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, i: usize, displacement: &[f64; N]) -> f64 {
    speed::<D, N>(bodies.shape[i].bounding_radius().unwrap_or(0.0), displacement)
}

/// The bodies of a contact.
fn pair_of<const D: usize>(contact: &Contact<D>) -> (u32, u32) {
    (contact.key.a, contact.key.b)
}

/// How deep two bodies may overlap, m.
fn allowed<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, (a, b): (u32, u32), part: f64) -> f64 {
    part * smaller(bodies, [a, b].map(|body| body as usize))
}

/// The contacts of the bodies where they were looked ahead to, with those that a displacement may close: one about as long as how far they came last, which is
/// how deep overlaps are.
fn detect<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, work: &mut Workspace<S, D, N>, part: f64) {
    let (bodies, correction) = (&world.bodies, &mut work.correction);
    let reach = |i: usize| margins(bodies, i, part).iter().sum::<f64>() + way_of(bodies, i, &correction.displacement[i]);
    correction.reach.clear();
    correction.reach.extend((0..bodies.len()).map(reach));
    let driven = |i: usize| !bodies.is_free(i);
    work.detector.detect::<S, N>(&bodies.shape, &work.middle, &correction.reach, driven, &mut correction.found);
    work.joints.part(&world.joints, &mut correction.found);
}

/// Moves the bodies by the least displacement that helps; false where joints leave them no way out.
fn displace<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    (part, kind): (f64, Kind),
    stop: &AtomicBool,
) -> Result<bool, StepError> {
    if kind == Kind::Full {
        work.correction.held.place(world);
    }
    let (bodies, correction) = (&mut world.bodies, &mut work.correction);
    correction.contacts.clear();
    correction.contacts.extend(correction.found.iter().map(|contact| {
        let mut room = [0.0; D];
        room[0] = contact.gap + 0.5 * allowed(bodies, pair_of(contact), part);
        Localised::new(*contact, S::frame(contact.normal), None, [[0.0; D], room, [0.0; D]])
    }));
    work.systems.get(kind).fill(bodies, &work.middle, &correction.contacts, &mut work.curve);
    if kind == Kind::Full {
        work.systems.full.join(bodies, &correction.held.blocks);
    }
    let system = work.systems.get(kind);
    let settings = Settings { criterion: Criterion::Scaled, tolerance: TOLERANCE, history: false, ..world.settings.solver };
    let status = system.solve(&settings, stop).status;
    if status == Status::Interrupted {
        return Err(StepError::Interrupted { time: world.time });
    }
    correction.displacement.clear();
    correction.displacement.resize(bodies.len(), [0.0; N]);
    system.deposit(bodies, &work.middle, &mut correction.displacement);
    shift(bodies, &correction.displacement);
    if kind == Kind::Full {
        correction.held.restore(world, &mut work.joints.elimination);
    }
    Ok(kind != Kind::Full || status == Status::Converged)
}
