//! Joints against closed forms, conservation and statics.

mod drift;
mod driven;
mod heavy;
mod mechanisms;
mod pendulums;
mod scenes;
mod statics;

use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid, Space};
use moreau::step::{StepRecord, Workspace, step};
use moreau::world::World;

/// The head of a scene whose solves are tight, so that what is measured is the scheme's.
fn head(dimension: usize, h: f64) -> String {
    let gravity = if dimension == 2 { "[0.0, -9.81]" } else { "[0.0, 0.0, -9.81]" };
    format!(
        "dimension = {dimension}\ngravity = {gravity}\ntime = {{ step = {h:e}, steps = 1 }}\n\
         solver = {{ criterion = \"scaled\", tolerance = 1e-12, start = \"warm\", on_failure = \"stop\" }}\n\
         materials.steel.density = 1000.0\n"
    )
}

fn build(text: &str) -> AnyWorld {
    let scene = Scene::parse(text, "joints.toml").unwrap_or_else(|error| panic!("{error}"));
    scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}"))
}

fn plane(text: &str) -> World<Plane, 2, 3> {
    match build(text) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("of space"),
    }
}

fn solid(text: &str) -> World<Solid, 3, 6> {
    match build(text) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("of the plane"),
    }
}

/// Takes `steps` steps, each of which must converge and balance its ledger, and shows each to `see`.
fn run<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    steps: u64,
    mut see: impl FnMut(&World<S, D, N>, &Workspace<S, D, N>, &StepRecord),
) {
    let mut work = Workspace::default();
    for _ in 0..steps {
        let record = step(world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        let energy = &record.energy;
        let size = energy.kinetic + energy.potential.abs() + energy.work.abs() + energy.dissipated.abs();
        assert!(energy.balance_error.abs() <= 1e-9 * size.max(1.0), "step {}: {energy:?}", record.step);
        see(world, &work, &record);
    }
}

/// |found − expected| ≤ tolerance, with a message.
#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} is not {expected} to {tolerance:e}");
}

/// The largest error of position of all joints with the bodies where they are, m.
fn error<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> f64 {
    let errors = world.joints.iter().map(|joint| joint.error::<S, N>(&world.bodies.pose, joint.arm(&world.bodies)));
    errors.fold(0.0, f64::max)
}
