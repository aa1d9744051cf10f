//! All local solvers give the exact one's velocities on the paper's sedimentation, with and without friction, in both dimensions.

use moreau::compare::Probe;
use moreau::scene::{AnyWorld, Scene};
use moreau::solve::GlobalMethod;
use moreau::solve::local::LOCAL_METHODS;
use moreau::space::Space;
use moreau::world::World;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// At ε_glob ≤ 1e-12 velocities must agree to 1e-6 of the greatest one: six orders for what errors add up to along chains.
fn agree<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>, at: u64) {
    world.settings.solver.max_sweeps = 2_000_000;
    let probe = Probe::new(&world, at, 1e-12, &AtomicBool::new(false)).unwrap().expect("the run must arrive");
    for &(local, row) in LOCAL_METHODS {
        let (history, difference) = probe.take((GlobalMethod::Nlgs, local), &AtomicBool::new(false));
        assert!(history.len() > 20, "{}: {} sweeps are no test", row.name, history.len());
        assert!(difference < 1e-6, "{} differs from the exact local solver by {difference:e} in step {at}", row.name);
    }
}

fn scene(file: &str, sets: &[&str], at: u64) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes/paper").join(file);
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scene = Scene::load_with(&path, &sets).unwrap_or_else(|error| panic!("{error}"));
    match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Plane(world) => agree(world, at),
        AnyWorld::Solid(world) => agree(world, at),
    }
}

/// Warm starts on the way only save time; the step that is compared starts cold, in a workspace of its own.
const FRICTION: [&str; 2] = ["default_law={ coulomb = { friction = 0.3 } }", "solver.start=\"warm\""];

#[test]
fn balls_without_friction() {
    for at in [300, 650, 1000] {
        scene("sedimentation.toml", &[], at);
    }
}

#[test]
fn disks_without_friction() {
    for at in [300, 700] {
        scene("sedimentation-2d.toml", &[], at);
    }
}

#[test]
fn balls_with_friction() {
    scene("sedimentation.toml", &FRICTION, 700);
}

#[test]
fn disks_with_friction() {
    scene("sedimentation-2d.toml", &FRICTION, 500);
}
