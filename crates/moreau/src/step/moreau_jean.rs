//! The step, on one screen: Moreau-Jean time stepping (section 3 of Barboteu & Dumont 2017; Jean 1999).

use super::failed::{self, FAILED_KEPT, FailedSolve};
use super::localise::{Localiser, rounding};
use super::record::{StepRecord, energies};
use super::system::Kind;
use super::workspace::Before;
use super::{StepError, Workspace, forces, integrate};
use crate::shape::Shape;
use crate::space::Space;
use crate::world::{OnFailure, Start, World};
use moreau_solve::files::ProblemFile;
use moreau_solve::{Acts, Report, Status};
use std::time::Instant;

/// How many contacts are localised at a time, by all threads; bounds the memory between localising and assembling.
const CHUNK: usize = 4096;

/// How often a step may be halved.
const HALVINGS: u32 = 6;

/// Advances the world by one step.
///
/// # Errors
/// [`StepError::Unconverged`] where the policy says to stop; the world is then as before the step.
/// [`StepError::NotFinite`] where a velocity or position ceases to be a number.
pub fn step<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
) -> Result<StepRecord, StepError> {
    let started = Instant::now();
    work.failed.last = None;
    work.ledger.open(|| energies(&world.bodies, &world.gravity));
    let mut record = StepRecord { step: world.steps + 1, bodies: world.bodies.len(), ..StepRecord::default() };
    let end = world.time + world.settings.h;
    if let Err(error) = advance(world, work, &mut record, world.settings.h, 0) {
        if let Some(before) = work.before.take() {
            before.restore(world, &mut work.ledger);
        }
        return Err(error);
    }
    work.before = None;
    world.steps += 1;
    // Halves add up to h only to rounding; the clock counts whole steps.
    world.time = end;
    record.time = end;
    record.energy = work.ledger.energy(energies(&world.bodies, &world.gravity));
    record.seconds.step = started.elapsed().as_secs_f64();
    Ok(record)
}

/// One step of length `h`, or two of half its length where the solve fails and the policy asks for it.
fn advance<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    record: &mut StepRecord,
    h: f64,
    depth: u32,
) -> Result<(), StepError> {
    let theta = world.settings.theta;
    // 1-2 forces, v_free = v + h M⁻¹ f
    forces::free_velocity(&world.bodies, &world.gravity, h, &mut work.free);
    // 3 q_m = q + h (1 − θ) v
    integrate::predict(&world.bodies, h, theta, &mut work.middle);
    // 4 contacts at q_m, sorted by key
    let clock = Instant::now();
    detect(world, work, h);
    record.seconds.detect += clock.elapsed().as_secs_f64();
    // 5-8 last impulses, laws, H, W_ii, q
    let clock = Instant::now();
    let kind = assemble(world, work, h);
    record.seconds.localise += clock.elapsed().as_secs_f64();
    // 9 impulses
    let clock = Instant::now();
    let dumps = world.settings.on_failure == OnFailure::Dump && work.failed.count < FAILED_KEPT;
    if dumps {
        work.systems.get(kind).impulses(&mut work.failed.start);
    }
    let report = work.systems.get(kind).solve(&world.settings.solver);
    record.seconds.solve += clock.elapsed().as_secs_f64();
    record.sweeps += report.sweeps;
    if report.status != Status::Converged {
        if dumps {
            keep_failed(world, work, kind, &report);
        }
        match world.settings.on_failure {
            OnFailure::Halve if depth < HALVINGS => {
                work.before.get_or_insert_with(|| Before::of(world, &work.ledger));
                advance(world, work, record, 0.5 * h, depth + 1)?;
                return advance(world, work, record, 0.5 * h, depth + 1);
            }
            OnFailure::Warn | OnFailure::Dump if report.status != Status::NotFinite => {}
            _ => return Err(unconverged(world.time + h, &report)),
        }
    }
    // 10 v⁺ = v_free + M⁻¹ H p
    work.systems.get(kind).answer(&mut work.contacts);
    work.after.clone_from(&work.free);
    work.systems.get(kind).deposit(&world.bodies, &work.middle, &mut work.after);
    note(record, work, report);
    work.ledger.book(&world.bodies, &world.gravity, [&work.free, &work.after], &work.contacts, (h, theta));
    // 11 q⁺ = q_m + h θ v⁺
    let taken = integrate::advance(&mut world.bodies, &work.middle, [&work.free, &work.after], h, theta);
    work.ledger.dissipate(taken);
    remember(work);
    world.time += h;
    check_finite(world)
}

/// Keeps the problem whose solve failed.
fn keep_failed<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    kind: Kind,
    report: &Report,
) {
    let step = world.steps + 1;
    let info = failed::info(step, world.time + world.settings.h, &world.settings, report);
    let problem = work.systems.get(kind).problem(&work.failed.start);
    work.failed.last = Some(FailedSolve { step, problem: problem.map(|problem| ProblemFile { info, ..problem }) });
    work.failed.count += 1;
}

/// Finds the contacts at the predicted configuration.
fn detect<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, work: &mut Workspace<S, D, N>, h: f64) {
    let bodies = &world.bodies;
    let approach = world.laws.iter().any(|law| law.acts() == Acts::Approach);
    work.reach.clear();
    work.reach.extend((0..bodies.len()).map(|i| reach(world, i, &work.free[i], h, approach)));
    work.detector.detect::<S, N>(&bodies.shape, &work.middle, &work.reach, |i| !bodies.is_free(i), &mut work.found);
}

/// How far from body `i` contacts matter. Closed ones: rounding. On approach: what it may travel in the step, doubled for what
/// other contacts add to its speed.
fn reach<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    i: usize,
    free: &[f64; N],
    h: f64,
    approach: bool,
) -> f64 {
    let radius = world.bodies.shape[i].bounding_radius().unwrap_or(0.0);
    let far = world.bodies.pose[i].position.iter().fold(0.0_f64, |far, x| far.max(x.abs()));
    let rounding = rounding(radius, far);
    if !approach {
        return rounding;
    }
    let speed = |v: &[f64; N]| {
        let spin = (D..N).map(|k| v[k] * v[k]).sum::<f64>().sqrt();
        (0..D).map(|k| v[k] * v[k]).sum::<f64>().sqrt() + spin * radius
    };
    2.0 * h * speed(free).max(speed(&world.bodies.velocity[i])) + 0.01 * radius + rounding
}

/// Localises the contacts that were found into the system of the coordinates that they need.
fn assemble<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    h: f64,
) -> Kind {
    let bodies = &world.bodies;
    work.contacts.clear();
    let law =
        |c: &crate::contacts::Contact<D>| world.laws.get(bodies.material[c.key.a as usize], bodies.material[c.key.b as usize]);
    let round = |body: u32| bodies.shape[body as usize].is_round() || !bodies.is_free(body as usize);
    let frictionless = work.found.iter().all(|c| law(c).is_frictionless());
    let kind = match (frictionless, work.found.iter().all(|c| round(c.key.a) && round(c.key.b))) {
        (false, false) => Kind::Full,
        (true, false) => Kind::Normal,
        (false, true) => Kind::Round,
        (true, true) => Kind::Central,
    };
    let system = work.systems.get(kind);
    system.clear(bodies);
    let spins = (kind != Kind::Central).then(|| {
        work.spins.fill::<S, D, N>(&work.middle, [&bodies.velocity, &work.free]);
        &work.spins
    });
    let localiser = Localiser { world, middle: &work.middle, free: &work.free, spins, h };
    let mut last = work.previous.iter().peekable();
    for chunk in work.found.chunks(CHUNK) {
        localiser.each(chunk, &mut work.prepared, |localised, q| {
            // Both lists are sorted by key: a merge finds the impulse of the step before.
            let key = localised.contact.key;
            while last.next_if(|(before, _)| *before < key).is_some() {}
            let start = match last.peek() {
                Some((before, r)) if *before == key && world.settings.start == Start::Warm => *r,
                _ => [0.0; D],
            };
            system.push(bodies, &work.middle, localised, q, &start);
            work.contacts.push(*localised);
        });
    }
    kind
}

/// Keeps the impulses of a step that was taken, for the next to start from.
fn remember<S: Space<D, N>, const D: usize, const N: usize>(work: &mut Workspace<S, D, N>) {
    work.previous.clear();
    work.previous.extend(work.contacts.iter().map(|c| (c.contact.key, c.impulse)));
}

/// Adds a solve to the record of its step; of several, the worst residual counts.
fn note<S: Space<D, N>, const D: usize, const N: usize>(record: &mut StepRecord, work: &mut Workspace<S, D, N>, report: Report) {
    record.contacts = work.contacts.len();
    record.active = work.contacts.iter().filter(|c| c.impulse != [0.0; D]).count();
    record.penetration = work.found.iter().map(|c| -c.gap).fold(record.penetration, f64::max);
    if report.status != Status::Converged {
        record.status = report.status;
    }
    let worse = report.residual.eps_glob.total() >= record.residual.eps_glob.total();
    if worse {
        record.residual = report.residual;
    }
    work.history = report.history;
}

fn unconverged(time: f64, report: &Report) -> StepError {
    if report.status == Status::NotFinite {
        return StepError::SolveNotFinite { time, sweeps: report.sweeps };
    }
    StepError::Unconverged {
        time,
        sweeps: report.sweeps,
        eps_glob: report.residual.eps_glob.total(),
        scaled: report.residual.scaled,
    }
}

fn check_finite<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> Result<(), StepError> {
    let finite = |i: usize| {
        world.bodies.velocity[i].iter().all(|x| x.is_finite()) && world.bodies.pose[i].position.iter().all(|x| x.is_finite())
    };
    match (0..world.bodies.len()).find(|&i| !finite(i)) {
        Some(body) => Err(StepError::NotFinite { body, time: world.time }),
        None => Ok(()),
    }
}
