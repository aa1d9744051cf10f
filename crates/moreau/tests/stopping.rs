//! A step is done whole or not at all: one that is stopped, or fails, leaves the world and the workspace as they were before it.

use moreau::checkpoint::Checkpoint;
use moreau::observe::Summary;
use moreau::scene::{AnyWorld, Scene};
use moreau::space::Space;
use moreau::step::{StepError, Workspace, step, step_until};
use moreau::world::World;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// All that the steps to come depend on, as a checksum.
fn state<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, work: &Workspace<S, D, N>) -> [u8; 32] {
    Checkpoint::take("", (Summary::default(), Vec::new()), world, work).state_digest()
}

/// A shipped scene with changes, after some steps.
fn built(name: &str, sets: &[&str], after: u64) -> AnyWorld {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    let text = std::fs::read_to_string(&path).unwrap();
    let mut world = Scene::parse_with(&text, name, &sets).and_then(|scene| scene.build(u64::MAX)).unwrap();
    match &mut world {
        AnyWorld::Plane(world) => advance(world, after),
        AnyWorld::Solid(world) => advance(world, after),
    }
    world
}

fn advance<S: Space<D, N>, const D: usize, const N: usize>(world: &mut World<S, D, N>, steps: u64) {
    let mut work = Workspace::default();
    (0..steps).for_each(|_| drop(step(world, &mut work).unwrap()));
}

/// Steps of two copies of a world: one is left alone, and `disturb` tries each step of the other before it is done. Their states are the same
/// after each.
fn disturbed<S: Space<D, N>, const D: usize, const N: usize>(
    start: &World<S, D, N>,
    steps: u64,
    mut disturb: impl FnMut(u64, &mut World<S, D, N>, &mut Workspace<S, D, N>),
) {
    let (mut quiet, mut world) = (start.clone(), start.clone());
    let (mut alone, mut work) = (Workspace::default(), Workspace::default());
    for k in start.steps..start.steps + steps {
        step(&mut quiet, &mut alone).unwrap();
        disturb(k, &mut world, &mut work);
        if world.steps == k {
            step(&mut world, &mut work).unwrap();
        }
        assert!(state(&world, &work) == state(&quiet, &alone), "after step {}", k + 1);
    }
}

/// Stops each step after its first sweep; gives how many there were to stop.
fn stopped_at_once<S: Space<D, N>, const D: usize, const N: usize>(start: &World<S, D, N>, steps: u64) -> u64 {
    let mut count = 0;
    disturbed(start, steps, |k, world, work| {
        let before = state(world, work);
        // What has nothing to solve is done before it can be stopped.
        if let Err(error) = step_until(world, work, &AtomicBool::new(true)) {
            assert!(matches!(error, StepError::Interrupted { .. }), "{error}");
            assert_eq!(world.steps, k);
            assert!(state(world, work) == before, "step {} was not taken back", k + 1);
            count += 1;
        }
    });
    count
}

#[test]
fn a_step_that_is_stopped_is_taken_back() {
    // Events, a source and a sink; a driven drum with positions put right; joints.
    for (name, after, steps, at_least) in
        [("gate.toml", 500, 1100, 1000), ("drum.toml", 400, 40, 10), ("slider-crank.toml", 0, 100, 100)]
    {
        let count = match built(name, &[], after) {
            AnyWorld::Plane(world) => stopped_at_once(&world, steps),
            AnyWorld::Solid(world) => stopped_at_once(&world, steps),
        };
        assert!(count >= at_least, "{name}: {count} steps were stopped");
    }
}

/// Stops each step later and later, until it is done first; whether some were done in parts.
fn stopped_anywhere<S: Space<D, N>, const D: usize, const N: usize>(start: &World<S, D, N>, steps: u64) -> bool {
    let mut parts = false;
    disturbed(start, steps, |k, world, work| {
        let mut wait = Duration::ZERO;
        while world.steps == k {
            let stop = AtomicBool::new(false);
            std::thread::scope(|scope| {
                let thread = scope.spawn(|| {
                    std::thread::park_timeout(wait);
                    stop.store(true, Ordering::Relaxed);
                });
                let done = step_until(world, work, &stop);
                match done {
                    Ok(record) => parts |= record.h < world.settings.h,
                    Err(error) => assert!(matches!(error, StepError::Interrupted { .. }), "{error}"),
                }
                thread.thread().unpark();
            });
            wait += wait / 2 + Duration::from_micros(100);
        }
    });
    parts
}

#[test]
fn it_does_not_matter_when_a_step_is_stopped() {
    // Many sweeps, positions put right at the end, and steps that are done in parts.
    let tight = ["solver.tolerance=1e-6", "solver.max_penetration=1e-6"];
    let parts = ["solver.on_failure=\"halve\"", "time.step=8e-2"];
    for (name, sets, after, in_parts) in [
        ("drum.toml", &tight[..], 300, false),
        ("slider-crank.toml", &parts, 3, true),
        ("slider-crank.toml", &tight[..1], 100, false),
    ] {
        let parts = match built(name, sets, after) {
            AnyWorld::Plane(world) => stopped_anywhere(&world, 5),
            AnyWorld::Solid(world) => stopped_anywhere(&world, 5),
        };
        assert_eq!(parts, in_parts, "{name}");
    }
}

/// Lets each step fail for want of sweeps first.
fn failed_first<S: Space<D, N>, const D: usize, const N: usize>(start: &World<S, D, N>) {
    let mut count = 0;
    disturbed(start, 20, |_, world, work| {
        let (before, settings) = (state(world, work), world.settings);
        world.settings.solver.max_sweeps = 1;
        world.settings.solver.tolerance = 1e-14;
        world.settings.on_failure = moreau::world::OnFailure::Stop;
        let failed = step(world, work);
        world.settings = settings;
        if let Err(error) = failed {
            assert!(matches!(error, StepError::Unconverged { .. }), "{error}");
            assert!(state(world, work) == before);
            count += 1;
        }
    });
    assert_eq!(count, 20);
}

#[test]
fn a_step_that_fails_is_taken_back() {
    match built("drum.toml", &[], 400) {
        AnyWorld::Plane(world) => failed_first(&world),
        AnyWorld::Solid(world) => failed_first(&world),
    }
}
