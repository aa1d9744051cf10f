//! Whatever a scene is, it is refused, or its world is built and takes three steps: each is done with numbers, or fails and leaves the world as it was.
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau::checkpoint::Checkpoint;
use moreau::observe::Summary;
use moreau::scene::{AnyWorld, Scene};
use moreau::space::Space;
use moreau::step::{Workspace, step};
use moreau::world::World;

/// What is larger is as good, and slow.
const BODIES: u64 = 200;
const MEMORY: u64 = 1 << 26;

fuzz_target!(|text: &str| {
    // Files that it names are not there.
    let Ok(scene) = Scene::parse(text, "nowhere/fuzz.toml") else { return };
    if scene.estimate().bodies > BODIES {
        return;
    }
    match scene.build(MEMORY) {
        Ok(AnyWorld::Plane(world)) => steps(world),
        Ok(AnyWorld::Solid(world)) => steps(world),
        Err(_) => {}
    }
});

fn steps<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>) {
    let solver = &mut world.settings.solver;
    solver.max_sweeps = solver.max_sweeps.min(50);
    let mut work = Workspace::default();
    for _ in 0..3 {
        let before = state(&world, &work);
        match step(&mut world, &mut work) {
            Ok(record) => {
                assert!(record.energy.kinetic.is_finite() && record.energy.potential.is_finite(), "{record:?}");
                for i in (0..world.bodies.len()).filter(|&i| world.bodies.is_present(i)) {
                    assert!(world.bodies.pose[i].position.iter().chain(&world.bodies.velocity[i]).all(|x| x.is_finite()));
                }
            }
            Err(_) => {
                assert!(state(&world, &work) == before);
                return;
            }
        }
    }
}

fn state<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, work: &Workspace<S, D, N>) -> [u8; 32] {
    Checkpoint::take("", (Summary::default(), Vec::new()), world, work).state_digest()
}
