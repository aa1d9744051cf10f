//! Files of a run with flipped bits and cut ends: each is refused with a message, or read as it was written. Never a panic, never other numbers.

use moreau::checkpoint::{self, Checkpoints};
use moreau::observe::{Observer, TrajectoryOutput};
use moreau::run::{Task, run};
use moreau::scene::{AnyWorld, Scene};
use moreau::space::Solid;
use moreau::step::Workspace;
use moreau::trajectory::{Precision, Trajectory};
use rand::{Rng, SeedableRng};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

const SCENE: &str = r#"
title = "twenty balls"
dimension = 3
gravity = [0.0, 0.0, -9.81]
time = { step = 1e-3, steps = 60 }
solver.start = "warm"
materials.glass.density = 2500.0
default_law.coulomb = { friction = 0.3 }
containers = [{ min = [0.0, 0.0, 0.0], max = [0.1, 0.1, 0.4], open = ["+z"], material = "glass" }]
generate = [{ material = "glass", count = 20, radii.constant = 0.01, lattice = { min = [0.0, 0.0, 0.0], max = [0.1, 0.1, 0.2] } }]
"#;

/// Runs the scene with a trajectory and checkpoints each ten steps; gives the paths of the trajectory and of the last checkpoint.
fn made(folder: &Path) -> [PathBuf; 2] {
    let scene = Scene::parse(SCENE, "twenty.toml").unwrap();
    let AnyWorld::Solid(mut world) = scene.build(u64::MAX).unwrap() else { panic!("the scene is in space") };
    let path = folder.join("trajectory.h5");
    let output = TrajectoryOutput::create(&path, &world, ("twenty balls", 2, Precision::Single)).unwrap();
    let mut observers: Vec<Box<dyn Observer<Solid, 3, 6>>> = vec![Box::new(output)];
    let task = Task { kept: Some((SCENE, Checkpoints::new(folder, 10, 0.0))), ..Task::new(60) };
    run(&mut world, &mut Workspace::default(), task, &mut observers, &AtomicBool::new(false), |_| {}).unwrap();
    [path, folder.join("checkpoint-000000000060.bin")]
}

/// Reads a file 200 times with a bit flipped and 200 times with its end cut off; `read` gives what is in it, or a message. Says how many
/// were refused.
fn damaged<T: PartialEq>(path: &Path, read: impl Fn(&Path) -> Result<T, String>) -> usize {
    let whole = std::fs::read(path).unwrap();
    let right = read(path).unwrap();
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(7);
    let mut refused = 0;
    for case in 0..400 {
        let mut bytes = whole.clone();
        let at = (random.next_u64() % bytes.len() as u64) as usize;
        if case % 2 == 0 {
            bytes[at] ^= 1 << (random.next_u64() % 8);
        } else {
            bytes.truncate(at);
        }
        std::fs::write(path, &bytes).unwrap();
        match read(path) {
            Ok(content) => assert!(content == right, "case {case} at byte {at} of {} is read as something else", whole.len()),
            Err(message) => {
                assert!(!message.is_empty());
                refused += 1;
            }
        }
    }
    std::fs::write(path, whole).unwrap();
    refused
}

#[test]
fn a_damaged_checkpoint_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [_, path] = made(folder.path());
    let refused = damaged(&path, |path| checkpoint::read(path).map_err(|error| error.to_string()));
    assert_eq!(refused, 400, "a checksum leaves no doubt");
}

#[test]
fn a_damaged_trajectory_is_refused_or_read_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = made(folder.path());
    let all = |path: &Path| -> Result<_, String> {
        let trajectory = Trajectory::open(path).map_err(|error| error.to_string())?;
        let frames: Result<Vec<_>, _> = (0..trajectory.frames()).map(|i| trajectory.frame(i)).collect();
        let columns = trajectory.columns().map_err(|error| error.to_string())?;
        Ok((trajectory.header().clone(), frames.map_err(|error| error.to_string())?, columns))
    };
    let refused = damaged(&path, all);
    assert!(refused > 200, "{refused}");
}
