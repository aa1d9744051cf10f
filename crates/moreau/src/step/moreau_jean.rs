//! The step, on one screen: Moreau-Jean time stepping (section 3 of Barboteu & Dumont 2017; Jean 1999).

use super::created::Created;
use super::failed::{self, FAILED_KEPT, FailedSolve};
use super::joints::{RESOLVED, StepJoints};
use super::record::{StepRecord, energies};
use super::system::Kind;
use super::workspace::Before;
use super::{Breach, StepError, Workspace, assemble, closing, correct, forces, guard, integrate, recall};
use crate::contacts::Contact;
use crate::space::{Pose, Space};
use crate::world::{OnBreach, OnFailure, World};
use moreau_solve::files::ProblemFile;
use moreau_solve::residual::larger;
use moreau_solve::{Report, Status, tasks};
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// In how many parts a step may be done.
const MOST_PARTS: u32 = 64;

/// Advances the world by one step.
///
/// # Errors
/// After any of them the world is as before the step.
/// [`StepError::Unconverged`] where the policy says to stop,
/// [`StepError::NotFinite`] where a velocity or position ceases to be a number, [`StepError::Overflow`] where a number of the record does,
/// [`StepError::Breach`] where the step breaks a limit.
pub fn step<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
) -> Result<StepRecord, StepError> {
    step_until(world, work, &AtomicBool::new(false))
}

/// The same, unless `stop` is set before it is done: then it is given up within a sweep of the solver.
///
/// # Errors
/// As [`step`], and [`StepError::Interrupted`].
pub fn step_until<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    stop: &AtomicBool,
) -> Result<StepRecord, StepError> {
    S::step(world, work, stop)
}

/// [`step_until`], in whatever dimension.
pub(crate) fn step_in<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    stop: &AtomicBool,
) -> Result<StepRecord, StepError> {
    work.begin(world);
    let done = whole(world, work, stop);
    if done.is_err() {
        work.take_back(world);
    }
    done
}

fn whole<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    stop: &AtomicBool,
) -> Result<StepRecord, StepError> {
    let started = Instant::now();
    work.failed.last = None;
    work.ledger.open(|| energies(&world.bodies, &world.gravity));
    work.ledger.bring(world.act());
    let mut record = StepRecord { step: world.steps + 1, bodies: world.bodies.present(), ..StepRecord::default() };
    let end = world.time + world.settings.h;
    advance(world, work, &mut record, world.settings.h, stop)?;
    correct(world, work, &mut record, stop)?;
    world.steps += 1;
    // Halves add up to h only to rounding; the clock counts whole steps.
    world.time = end;
    record.time = end;
    record.seconds.step = started.elapsed().as_secs_f64();
    Ok(record)
}

/// Corrects positions at the end of a step, if that is asked for, and books what it created.
fn correct<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    record: &mut StepRecord,
    stop: &AtomicBool,
) -> Result<(), StepError> {
    if world.settings.max_penetration.is_none() {
        return Ok(());
    }
    let dissipated = work.ledger.dissipated();
    record.seconds.detect += correct::at_end(world, work, stop)?;
    record.created.correction += larger(0.0, dissipated - work.ledger.dissipated());
    check_finite(world)?;
    close(world, work, record)?;
    match guard::energy(&world.guard, record.created.total()) {
        Some(breach) if world.guard.policy != OnBreach::Warn => Err(StepError::Breach { time: world.time, breach }),
        Some(breach) => {
            // A breach by energy is of all that the step created.
            if record.breach.as_ref().is_none_or(|before| matches!(before, Breach::Energy { .. })) {
                record.breach = Some(breach);
            }
            Ok(())
        }
        None => Ok(()),
    }
}

/// Closes the books of a (part of a) step: energies at its end. Fails where a number of the record is not finite.
fn close<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &Workspace<S, D, N>,
    record: &mut StepRecord,
) -> Result<(), StepError> {
    record.energy = work.ledger.energy(energies(&world.bodies, &world.gravity));
    let Some(what) = record.not_finite() else { return Ok(()) };
    let part = match what {
        "kinetic energy" => 0,
        "potential energy" => 1,
        _ => return Err(StepError::Overflow { what, body: None, time: world.time }),
    };
    let body = (0..world.bodies.len()).find(|&i| !world.bodies.energy(i, &world.gravity)[part].is_finite());
    Err(StepError::Overflow { what, body, time: world.time })
}

/// One step of length `h`, or two of half its length, or four of a quarter, where it fails and the policy asks for it.
fn advance<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    record: &mut StepRecord,
    h: f64,
    stop: &AtomicBool,
) -> Result<(), StepError> {
    let (solves, limits) = (world.settings.on_failure == OnFailure::Halve, world.guard.policy == OnBreach::Halve);
    if !solves && !limits {
        return attempt(world, work, record, h, stop);
    }
    let (before, so_far) = (Before::of(world, &work.ledger), record.clone());
    let mut parts = 1;
    loop {
        let result = (0..parts).try_for_each(|_| attempt(world, work, record, h / f64::from(parts), stop));
        let Err(error) = result else { return Ok(()) };
        before.restore(world, &mut work.ledger);
        let again = match error {
            StepError::Unconverged { .. } | StepError::SolveNotFinite { .. } => solves,
            StepError::OpenJoint { .. } | StepError::StrainedBody { .. } => solves,
            StepError::Interrupted { .. } => false,
            StepError::NotFinite { .. } | StepError::Overflow { .. } | StepError::Breach { .. } => limits,
        };
        if !again || parts == MOST_PARTS {
            return Err(error);
        }
        // What was done in vain took its time all the same.
        *record = StepRecord { sweeps: record.sweeps, seconds: record.seconds, ..so_far.clone() };
        parts *= 2;
    }
}

/// One step of length `h`.
fn attempt<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    record: &mut StepRecord,
    h: f64,
    stop: &AtomicBool,
) -> Result<(), StepError> {
    let (theta, start) = (world.settings.theta, world.time);
    // 1-2 drives, forces, v_free = v + h M⁻¹ f
    world.schedule.begin_step(&mut world.bodies, start, h);
    forces::free_velocity(&world.bodies, &world.gravity, h, &mut work.free);
    world.schedule.end_velocities(&world.bodies, start, h, &mut work.free);
    // 3 q_m = q + h (1 − θ) v
    integrate::predict(&world.bodies, h, theta, &mut work.middle);
    // 4 contacts at q_m, sorted by key
    let clock = Instant::now();
    assemble::detect(world, work, h);
    let dissipated = work.ledger.dissipated();
    if correct::at_start(world, work, h, stop)? {
        assemble::detect(world, work, h);
    }
    let corrected = larger(0.0, dissipated - work.ledger.dissipated());
    record.seconds.detect += clock.elapsed().as_secs_f64();
    // 5-8 last impulses, laws, H, W_ii, q
    let clock = Instant::now();
    let kind = assemble::assemble(world, work, h);
    record.seconds.localise += clock.elapsed().as_secs_f64();
    // 9 impulses
    let clock = Instant::now();
    let dumps = world.settings.on_failure == OnFailure::Dump && work.failed.count < FAILED_KEPT;
    if dumps || world.guard.dumps() {
        work.systems.get(kind).impulses(&mut work.failed.start);
    }
    let report = closing::solve(world, work, (kind, h), stop);
    record.seconds.solve += clock.elapsed().as_secs_f64();
    record.sweeps += report.sweeps;
    if report.status == Status::Interrupted {
        return Err(StepError::Interrupted { time: world.time + h });
    }
    if report.status != Status::Converged {
        if dumps {
            keep_failed(world, work, kind, (world.time + h, &report));
        }
        match world.settings.on_failure {
            OnFailure::Warn | OnFailure::Dump if report.status != Status::NotFinite => {}
            _ => return Err(unconverged(world.time + h, &report, &work.joints)),
        }
    }
    // 10 v⁺ = v_free + M⁻¹ H p
    work.systems.get(kind).answer(&mut work.contacts);
    if !world.joints.is_empty() {
        work.systems.full.answer_joints(&mut work.joints.blocks);
        work.joints.react::<S>(&world.joints, &work.middle);
    }
    work.after.clone_from(&work.free);
    work.systems.get(kind).deposit(&world.bodies, &work.middle, &mut work.after);
    recall::remember(work, &world.bodies.velocity);
    record.h = h;
    let velocities = [work.free.as_slice(), work.after.as_slice()];
    let lift = work.ledger.book(&world.bodies, &world.gravity, velocities, &work.contacts, (h, theta), &mut work.balance);
    work.ledger.book_joints(&work.joints.blocks);
    let mut created = work.islands.created(&world.bodies, &work.contacts, &work.joints.blocks);
    // 11 q⁺ = q_m + h θ v⁺
    let [taken, scheme] = integrate::advance(&mut world.bodies, &work.middle, velocities, &work.balance, (h, theta));
    work.ledger.dissipate(taken);
    (created.scheme, created.correction) = (scheme, corrected);
    work.swept = report.sweeps;
    world.time += h;
    world.schedule.place(&mut world.bodies, world.time);
    check_finite(world)?;
    let breach = guard::check(world, work, created.total());
    if let Some(breach) = breach {
        if world.guard.policy != OnBreach::Warn {
            if world.guard.dumps() {
                keep_failed(world, work, kind, (world.time, &report));
            }
            return Err(StepError::Breach { time: world.time, breach });
        }
        record.breach.get_or_insert(breach);
    }
    note(world, record, work, (report, created, lift));
    close(world, work, record)
}

/// Keeps the problem of a (part of a) step to `time`.
fn keep_failed<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    kind: Kind,
    (time, report): (f64, &Report),
) {
    let step = world.steps + 1;
    let info = failed::info(step, time, &world.settings, report);
    let problem = work.systems.get(kind).problem(&work.failed.start);
    work.failed.last = Some(FailedSolve { step, problem: problem.map(|problem| ProblemFile { info, ..problem }) });
    work.failed.count += 1;
}

/// Adds a solve to the record of its step, with the energy that it created; the worst residual of several solves counts.
fn note<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    record: &mut StepRecord,
    work: &mut Workspace<S, D, N>,
    (report, created, lift): (Report, Created, f64),
) {
    record.contacts = work.contacts.len();
    let (contacts, found) = (&work.contacts, &work.found);
    let active = |part: Range<usize>| contacts[part].iter().filter(|c| c.impulse != [0.0; D]).count();
    record.active = tasks::fold(0..contacts.len(), &active, &|a, b| a + b);
    let larger_of = |a: [f64; 2], b: [f64; 2]| [larger(a[0], b[0]), larger(a[1], b[1])];
    let deep = |c: &Contact<D>| if c.gap >= 0.0 { [0.0; 2] } else { [-c.gap, -c.gap / guard::smaller_radius(&world.bodies, c)] };
    let deepest = |part: Range<usize>| found[part].iter().map(deep).fold([0.0; 2], larger_of);
    let [penetration, overlap] = tasks::fold(0..found.len(), &deepest, &larger_of);
    record.penetration = larger(record.penetration, penetration);
    record.overlap = larger(record.overlap, overlap);
    record.joint_error = larger(record.joint_error, work.joints.left);
    record.joint_gap = larger(record.joint_gap, work.joints.gap(&world.joints, &world.bodies));
    record.created.add(&created);
    record.lift = larger(record.lift, lift);
    if report.status != Status::Converged {
        record.status = report.status;
    }
    // Not `>=`: a NaN is the worst, and stays.
    let better = report.residual.eps_glob.total() < record.residual.eps_glob.total();
    if !better && !record.residual.eps_glob.total().is_nan() {
        record.residual = report.residual;
    }
    work.history = report.history;
}

fn unconverged<const D: usize, const N: usize>(time: f64, report: &Report, joints: &StepJoints<D, N>) -> StepError {
    if report.status == Status::NotFinite {
        return StepError::SolveNotFinite { time, sweeps: report.sweeps };
    }
    if report.status == Status::Stalled {
        if let Some((joint, error, bound)) = joints.open() {
            return StepError::OpenJoint { time, joint, error, bound };
        }
        if let Some((body, swing)) = joints.strain {
            return StepError::StrainedBody { time, body, swing, allowed: RESOLVED };
        }
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
        let (velocity, Pose { position, rotation }) = (&world.bodies.velocity[i], &world.bodies.pose[i]);
        let rotation = S::numbers(*rotation);
        velocity.iter().chain(position).chain(&rotation).all(|x| x.is_finite()) || !world.bodies.is_present(i)
    };
    let first = |mut part: Range<usize>| part.find(|&i| !finite(i));
    match tasks::fold(0..world.bodies.len(), &first, &Option::or) {
        Some(body) => Err(StepError::NotFinite { body, time: world.time }),
        None => Ok(()),
    }
}
