//! What a step does besides contacts between free bodies: loads, driven bodies, closing gaps, and what happens when a solve fails.

use moreau::observe::{Frame, Observer, OutputError};
use moreau::run::{End, Task, run};
use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid};
use moreau::step::{FailedSolve, StepError, Workspace, step};
use moreau::world::World;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

const FLOOR: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 1e-3, steps = 1000 }
solver = { criterion = "scaled", tolerance = 1e-13 }
materials.stone.density = 1000.0
default_law.coulomb = { friction = 0.5 }

[[bodies]]
name = "floor"
shape.half_space = { normal = [0.0, 0.0, 1.0] }
material = "stone"
position = [0.0, 0.0, 0.0]

[[bodies]]
name = "block"
shape.box = { size = [0.2, 0.2, 0.1] }
material = "stone"
position = [0.0, 0.0, 0.05]
"#;

fn world(text: &str, sets: &[&str]) -> AnyWorld {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scene = Scene::parse_with(text, "test.toml", &sets).unwrap_or_else(|error| panic!("{error}"));
    scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}"))
}

fn solid(text: &str, sets: &[&str]) -> World<Solid, 3, 6> {
    match world(text, sets) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("of the plane"),
    }
}

fn plane(text: &str, sets: &[&str]) -> World<Plane, 2, 3> {
    match world(text, sets) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("of space"),
    }
}

/// A belt at 1 m/s takes a block along at μ g until it moves with it; what the belt does is half lost in friction.
#[test]
fn a_driven_floor_takes_a_block_along_and_its_work_is_booked() {
    let mut world = solid(FLOOR, &["bodies.0.motion=driven", "bodies.0.velocity=[1.0, 0.0, 0.0]"]);
    let mut work = Workspace::default();
    let mut last = None;
    for _ in 0..100 {
        last = Some(step(&mut world, &mut work).unwrap());
    }
    assert!((world.bodies.velocity[1][0] - 0.5).abs() < 1e-9, "v = μ g t: {:?}", world.bodies.velocity[1]);
    for _ in 0..400 {
        last = Some(step(&mut world, &mut work).unwrap());
    }
    assert!((world.bodies.velocity[1][0] - 1.0).abs() < 1e-9);
    let energy = last.unwrap().energy;
    let kinetic = 0.5 * 4.0; // 4 kg at 1 m/s
    assert!((energy.work - 2.0 * kinetic).abs() < 1e-6 && (energy.dissipated - kinetic).abs() < 1e-2, "{energy:?}");
    assert!(energy.balance_error.abs() < 1e-12 * kinetic, "{energy:?}");
}

/// A constant force and torque on a body that touches nothing: v = f t/m, ω = τ t/J, exactly.
#[test]
fn loads_accelerate() {
    let sets = ["gravity=[0.0, 0.0, 0.0]", "bodies.1.position=[0.0, 0.0, 5.0]", "bodies.1.force=[8.0, 0.0, 0.0]"];
    let mut world = solid(FLOOR, &[&sets[..], &["bodies.1.torque=[0.0, 0.0, 0.02]"]].concat());
    let mut work = Workspace::default();
    let mut last = None;
    for _ in 0..1000 {
        last = Some(step(&mut world, &mut work).unwrap());
    }
    let (v, inertia) = (world.bodies.velocity[1], 4.0 * (0.04 + 0.04) / 12.0);
    assert!((v[0] - 2.0).abs() < 1e-12 && (v[5] - 0.02 / inertia).abs() < 1e-12, "{v:?}");
    assert!((world.bodies.pose[1].position[0] - 1.0).abs() < 1e-12, "θ = 1/2 integrates f t²/2m exactly");
    let energy = last.unwrap().energy;
    assert!((energy.work - energy.kinetic).abs() < 1e-12 && energy.dissipated.abs() < 1e-12, "{energy:?}");
}

const DISK: &str = r#"
dimension = 2
gravity = [0.0, -10.0]
time = { step = 1e-2, steps = 100 }
solver = { criterion = "scaled", tolerance = 1e-13 }
materials.stone.density = 1000.0
default_law.coulomb = { friction = 0.3 }

[[bodies]]
shape.half_plane = { normal = [0.0, 1.0] }
material = "stone"
position = [0.0, 0.0]

[[bodies]]
shape.disk = { radius = 0.1 }
material = "stone"
position = [0.0, 1.1]
"#;

/// A law that acts on approach lets nothing sink in, whatever the step; one that waits until the gap is closed sinks by up to v h, and where that is more
/// than a tenth of the body acts on approach too.
#[test]
fn acting_on_approach_does_not_penetrate() {
    let deepest = |sets: &[&str]| {
        let mut world = plane(DISK, sets);
        let mut work = Workspace::default();
        (0..300).map(|_| step(&mut world, &mut work).unwrap().penetration).fold(0.0, f64::max)
    };
    assert!(deepest(&[]) < 1e-15);
    let closed = ["default_law.coulomb.acts=closed", "solver.max_penetration=never"];
    assert!(deepest(&closed) <= 1e-2, "not deeper than a tenth of the disk");
    assert!(deepest(&[closed[0], closed[1], "time.step=2e-3"]) > 1e-3, "the step of this test is long on purpose");
}

/// θ = 1 damps a bouncing spin and fall no more than its identity says: the ledger closes for any θ.
#[test]
fn the_ledger_closes_for_any_theta() {
    for theta in ["0.5", "0.75", "1.0"] {
        let sets = [&format!("time.theta={theta}"), "bodies.1.velocity=[1.0, 0.0, 0.0]", "bodies.1.position=[0.0, 0.0, 0.5]"];
        let mut world = solid(FLOOR, &[sets[0], sets[1], sets[2], "bodies.1.spin=[3.0, 5.0, 1.0]"]);
        let mut work = Workspace::default();
        for _ in 0..1000 {
            let energy = step(&mut world, &mut work).unwrap().energy;
            let scale = energy.kinetic + energy.potential + 1.0;
            assert!(energy.balance_error.abs() < 1e-11 * scale, "θ = {theta}: {energy:?}");
        }
    }
}

/// A dozen frictional balls in a heap, and far too few sweeps for them.
fn hopeless(policy: &str, sweeps: u64) -> World<Solid, 3, 6> {
    let heap = r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 1e-2, steps = 100 }
materials.stone.density = 1000.0
default_law.coulomb = { friction = 0.5 }
[[containers]]
min = [0.0, 0.0, 0.0]
max = [0.3, 0.3, 1.0]
material = "stone"
[[generate]]
material = "stone"
radii.constant = 0.05
lattice = { kind = "cubic", min = [0.0, 0.0, 0.0], max = [0.3, 0.3, 0.6], spacing = 0.1 }
"#;
    let sets = [
        format!("solver.max_sweeps={sweeps}"),
        format!("solver.on_failure={policy}"),
        "solver.tolerance=1e-10".to_owned(),
        "solver.criterion=eps_glob".to_owned(),
    ];
    solid(heap, &sets.each_ref().map(String::as_str))
}

#[test]
fn a_failed_solve_is_counted_or_ends_the_run_with_the_world_as_it_was() {
    let mut world = hopeless("warn", 2);
    let record = step(&mut world, &mut Workspace::default()).unwrap();
    assert!(!record.converged() && record.sweeps == 2, "{record:?}");
    for policy in ["stop", "halve"] {
        let mut world = hopeless(policy, 2);
        let (pose, velocity) = (world.bodies.pose.clone(), world.bodies.velocity.clone());
        let error = step(&mut world, &mut Workspace::default()).unwrap_err();
        assert!(matches!(error, StepError::Unconverged { sweeps: 2, .. }), "{error}");
        assert_eq!((world.bodies.pose, world.bodies.velocity, world.steps, world.time), (pose, velocity, 0, 0.0), "{policy}");
    }
}

/// Counts what it is shown, and cannot write after `full` frames.
struct Counter<'a> {
    full: u32,
    seen: &'a AtomicU32,
    failed: &'a AtomicU32,
    finished: &'a AtomicU32,
}

impl Observer<Solid, 3, 6> for Counter<'_> {
    fn see(&mut self, _: &Frame<'_, Solid, 3, 6>) -> Result<(), OutputError> {
        match self.seen.fetch_add(1, Ordering::Relaxed) < self.full {
            true => Ok(()),
            false => Err(OutputError::Io { path: "full".into(), source: std::io::ErrorKind::StorageFull.into() }),
        }
    }

    fn see_failed(&mut self, failed: &FailedSolve) -> Result<Option<String>, OutputError> {
        self.failed.fetch_add(1, Ordering::Relaxed);
        assert!(failed.problem.is_ok(), "{:?}", failed.problem);
        Ok(Some(failed.file_name()))
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        self.finished.fetch_add(1, Ordering::Relaxed);
        Ok(())
    }
}

#[test]
fn an_observer_that_cannot_write_ends_the_run_and_all_observers_finish() {
    let [seen, failed, finished] = [const { AtomicU32::new(0) }; 3];
    let counter = |full| -> Box<dyn Observer<Solid, 3, 6> + '_> {
        Box::new(Counter { full, seen: &seen, failed: &failed, finished: &finished })
    };
    // Each frame is seen twice: the third frame is what the first of the two cannot write, and the second sees it all the same.
    let mut observers = [counter(4), counter(100)];
    let stop = AtomicBool::new(false);
    let mut world = hopeless("dump", 2);
    let unwritten = run(&mut world, &mut Workspace::default(), Task::new(10), &mut observers, &stop, |_| {}).unwrap_err();
    drop(observers);
    assert!(unwritten.to_string().contains("cannot write full"), "{unwritten}");
    assert_eq!((unwritten.outcome.end, unwritten.outcome.summary.steps()), (End::Unwritten, 2));
    assert_eq!([&seen, &failed, &finished].map(|count| count.load(Ordering::Relaxed)), [6, 4, 2]);
    let names = unwritten.outcome.summary.failed_problems();
    assert_eq!(names, ["failed-step-1.hdf5", "failed-step-1.hdf5", "failed-step-2.hdf5", "failed-step-2.hdf5"]);
}

/// Of a problem that is kept: the same number of contacts, and solved by the same method to the same impulses as by the step.
#[test]
fn a_kept_problem_is_the_one_that_the_step_failed_on() {
    let (mut warned, mut dumped) = (hopeless("warn", 2), hopeless("dump", 2));
    let (mut plain, mut work) = (Workspace::default(), Workspace::default());
    step(&mut warned, &mut plain).unwrap();
    step(&mut dumped, &mut work).unwrap();
    assert_eq!(warned.bodies.velocity, dumped.bodies.velocity, "to keep a problem changes nothing");
    assert!(plain.take_failed().is_none());
    let kept = work.take_failed().expect("the solve failed");
    assert!(kept.step == 1 && work.take_failed().is_none());
    let problem = kept.problem.expect("friction has a place in files");
    let impulses: Vec<f64> = work.contacts().iter().flat_map(|c| c.impulse).collect();
    assert_eq!(problem.guesses[1].r, impulses, "the second guess is where the solve ended");
    let u = work.contacts().iter().flat_map(|c| (0..3).map(|i| c.after[i] + c.form.shift[i]));
    assert!(u.zip(&problem.guesses[1].u).all(|(a, b)| (a - b).abs() < 1e-12), "W and q give the velocities of the step");
}

/// Halves that converge replace the step: more sweeps in all than one solve may take, and the clock as if nothing had been.
#[test]
fn a_step_that_fails_is_halved() {
    let fails = |sweeps: u64| step(&mut hopeless("stop", sweeps), &mut Workspace::default()).is_err();
    let needed = step(&mut hopeless("stop", 100_000), &mut Workspace::default()).unwrap().sweeps;
    // ε_glob is of velocities, which are half as large in half a step: just too few sweeps for the whole are enough for halves.
    let limit = (1..needed).rev().find(|&sweeps| fails(sweeps)).expect("one sweep is not enough");
    let mut world = hopeless("halve", limit);
    let record = step(&mut world, &mut Workspace::default()).unwrap();
    assert!(record.converged() && record.sweeps > limit, "{record:?}, at most {limit} a solve");
    assert!((world.time - 1e-2).abs() < 1e-15 && world.steps == 1);
}
