//! Experiment 1 of the paper: what Table 1 says of sweeps, and a ball that slides without rolling.

use moreau::scene::{AnyWorld, Scene};
use moreau::solve::LocalMethod;
use moreau::space::Space;
use moreau::step::{Workspace, step};
use moreau::world::World;
use std::path::PathBuf;

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

#[test]
fn one_ball_slides_without_rolling_in_as_many_sweeps_as_table_1_says() {
    for file in ["sliding-ball.toml", "sliding-ball-2d.toml"] {
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes/paper").join(file);
        let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
        match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
            AnyWorld::Plane(world) => slides(&world),
            AnyWorld::Solid(world) => slides(&world),
        }
    }
}
