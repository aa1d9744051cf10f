//! Known results: one folder a result under `validation/`, with its scene, the expected value, its source and the tolerance argued.

mod arch;
mod blocks;
mod chain;
mod convergence;
mod cylinders;
mod hexagonal;
mod impacts;
mod interfaces;
mod reactions;
mod rocking;
mod rolling;

use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid, Space};
use moreau::step::{StepRecord, Workspace, step};
use moreau::world::World;
use std::path::PathBuf;

/// The scene of a known result, with overrides.
fn scene(file: &str, sets: &[&str]) -> AnyWorld {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../validation").join(file);
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scene = Scene::load_with(&path, &sets).unwrap_or_else(|error| panic!("{error}"));
    scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}"))
}

fn solid(file: &str, sets: &[&str]) -> World<Solid, 3, 6> {
    match scene(file, sets) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("{file} is of the plane"),
    }
}

fn plane(file: &str, sets: &[&str]) -> World<Plane, 2, 3> {
    match scene(file, sets) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("{file} is of space"),
    }
}

/// Runs `steps` steps, each of which must converge, and shows each to `see`.
fn run<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    steps: u64,
    mut see: impl FnMut(&World<S, D, N>, &Workspace<S, D, N>, &StepRecord),
) {
    let mut work = Workspace::default();
    for _ in 0..steps {
        let record = step(world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged(), "step {} did not converge: {:?}", record.step, record.residual);
        see(world, &work, &record);
    }
}

/// |found − expected| ≤ tolerance, with a message.
fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} is not {expected} to {tolerance:e}");
}
