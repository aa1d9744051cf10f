//! The same run gives the same bits; bodies in another order give the same velocities, to the solver's tolerance.

use moreau::bodies::{Bodies, Body};
use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Solid, Space};
use moreau::step::{Workspace, step};
use moreau::world::World;
use std::path::PathBuf;

type SolidWorld = World<Solid, 3, 6>;

fn scene(file: &str, sets: &[&str]) -> SolidWorld {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(file);
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scene = Scene::load_with(&path, &sets).unwrap_or_else(|error| panic!("{error}"));
    match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("{file} is of the plane"),
    }
}

/// All numbers of the state, as bits.
fn bits(world: &SolidWorld) -> Vec<u64> {
    let pose = |i: usize| {
        let pose = &world.bodies.pose[i];
        pose.position.into_iter().chain(Solid::quaternion(pose.rotation))
    };
    (0..world.bodies.len()).flat_map(|i| pose(i).chain(world.bodies.velocity[i])).map(f64::to_bits).collect()
}

fn run(mut world: SolidWorld, steps: u64, threads: usize) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut work = Workspace::default();
        let mut most = 0;
        for _ in 0..steps {
            most = most.max(step(&mut world, &mut work).unwrap().contacts);
        }
        assert!(most > 1024, "{most} contacts are too few for several threads to share");
    });
    bits(&world)
}

#[test]
fn a_second_run_and_any_number_of_threads_give_the_same_bits() {
    let sets = ["generate.0.count=800", "default_law={ coulomb = { friction = 0.3 } }"];
    let world = || scene("box-of-balls.toml", &[sets[0], sets[1], "time.step=4e-4"]);
    let once = run(world(), 150, 1);
    for threads in [1, 2, 3, 8] {
        assert_eq!(run(world(), 150, threads), once, "{threads} threads");
    }
}

/// The same world with its bodies in reverse order.
fn reversed(world: &SolidWorld) -> SolidWorld {
    let old = &world.bodies;
    let mut bodies = Bodies::default();
    for i in (0..old.len()).rev() {
        bodies.push(Body {
            shape: old.shape[i].clone(),
            pose: old.pose[i],
            velocity: old.velocity[i],
            density: 2500.0,
            material: old.material[i],
            motion: old.motion[i],
            load: old.load[i],
        });
    }
    World { bodies, ..world.clone() }
}

/// Without friction velocities are unique, so any order must find them; impulses need not be.
#[test]
fn bodies_in_another_order_get_the_same_velocities() {
    let mut world = scene("paper/sedimentation.toml", &[]);
    let mut work = Workspace::default();
    for _ in 0..700 {
        step(&mut world, &mut work).unwrap();
    }
    world.settings.solver.tolerance = 1e-12;
    let mut other = reversed(&world);
    step(&mut world, &mut Workspace::default()).unwrap();
    step(&mut other, &mut Workspace::default()).unwrap();
    let difference = moreau::compare::disagreement(&world, &reversed(&other));
    assert!(difference < 1e-6, "velocities differ by {difference:e}");
}
