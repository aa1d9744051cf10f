//! Experiment 1 of the paper: what Table 1 says of sweeps, and a ball that slides without rolling. Experiment 2: what momentum saves.

use moreau::compare::Probe;
use moreau::scene::{AnyWorld, Scene};
use moreau::solve::{GlobalMethod, LocalMethod};
use moreau::space::Space;
use moreau::step::{Workspace, step};
use moreau::world::World;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// 2 000 steps: PDAS needs one sweep each, EBP and EAL at most two, SBP and SAL the 17 or 18 of Table 1 at the ρ of the scene.
fn slides<S: Space<D, N>, const D: usize, const N: usize>(start: &World<S, D, N>) {
    use LocalMethod::{Eal, Ebp, Exact, Pdas, Sal, Sbp};
    for (local, sweeps) in [(Pdas, 1..=1), (Exact, 1..=1), (Ebp, 1..=2), (Eal, 1..=2), (Sbp, 17..=18), (Sal, 17..=18)] {
        let mut world = start.clone();
        world.settings.solver.local = local;
        let mut work = Workspace::default();
        for _ in 0..2000 {
            let record = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
            assert!(record.converged() && record.contacts == 1, "{}: {record:?}", local.name());
            assert!(sweeps.contains(&record.sweeps), "{}: {} sweeps in step {}", local.name(), record.sweeps, record.step);
        }
        let v = world.bodies.velocity[1];
        assert!((v[0] - 1.5).abs() < 1e-12, "{}: {} m/s", local.name(), v[0]);
        assert!(v[D..].iter().all(|&spin| spin == 0.0), "{}: it rolls, {v:?}", local.name());
        let travelled = world.bodies.pose[1].position[0] - start.bodies.pose[1].position[0];
        assert!((travelled - 0.3).abs() < 1e-12, "{}: {travelled} m in 0.2 s", local.name());
    }
}

fn load(file: &str) -> AnyWorld {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes/paper").join(file);
    let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
    scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn one_ball_slides_without_rolling_in_as_many_sweeps_as_table_1_says() {
    for file in ["sliding-ball.toml", "sliding-ball-2d.toml"] {
        match load(file) {
            AnyWorld::Plane(world) => slides(&world),
            AnyWorld::Solid(world) => slides(&world),
        }
    }
}

/// Experiment 2, PDAS: mean sweeps a step over all of it.
fn sweeps<S: Space<D, N>, const D: usize, const N: usize>(start: &World<S, D, N>, global: GlobalMethod) -> f64 {
    let mut world = start.clone();
    world.settings.solver.global = global;
    let mut work = Workspace::default();
    let mut sweeps = 0;
    for _ in 0..1000 {
        let record = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged(), "{}: step {}", global.name(), record.step);
        sweeps += record.sweeps;
    }
    sweeps as f64 / 1000.0
}

#[test]
fn accelerated_sweeps_of_the_sedimentation_are_three_tenths_of_plain_ones_and_end_in_the_same_velocities() {
    let AnyWorld::Solid(start) = load("sedimentation.toml") else { panic!("a scene in space") };
    let (plain, accelerated) = (sweeps(&start, GlobalMethod::Nlgs), sweeps(&start, GlobalMethod::Accelerated));
    assert!(accelerated <= 0.3 * plain, "{accelerated} sweeps a step, {plain} plain");
    let probe = Probe::new(&start, 1000, 1e-11, &AtomicBool::new(false)).expect("no output").expect("it converges");
    let (_, difference) = probe.take((GlobalMethod::Accelerated, LocalMethod::Pdas), &AtomicBool::new(false));
    assert!(difference < 1e-7, "velocities differ by {difference}");
}
