//! Bodies that come and go: gates, sources, sinks.

use moreau::observe::{Observer, VtkOutput};
use moreau::run::{Task, run};
use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Solid, Space};
use moreau::step::{StepRecord, Workspace, step};
use moreau::world::World;
use std::sync::atomic::AtomicBool;

type SolidWorld = World<Solid, 3, 6>;

fn solid(text: &str, sets: &[&str]) -> SolidWorld {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scene = Scene::parse_with(text, "test.toml", &sets).unwrap_or_else(|error| panic!("{error}"));
    match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("of the plane"),
    }
}

/// Takes so many steps, each of which must converge and leave the energy ledger closed, and shows each.
fn steps(world: &mut SolidWorld, count: u64, mut see: impl FnMut(&SolidWorld, &StepRecord)) {
    let mut work = Workspace::default();
    for _ in 0..count {
        let record = step(world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        let energy = &record.energy;
        assert!(record.converged(), "{record:?}");
        let scale = 1.0 + energy.kinetic + energy.potential.abs() + energy.work.abs() + energy.dissipated.abs();
        assert!(energy.balance_error.abs() < 1e-12 * scale, "{energy:?}");
        see(world, &record);
    }
}

const GATE: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 1e-3, steps = 400 }
solver = { criterion = "scaled", tolerance = 1e-12 }
materials.steel.density = 1000.0
default_law.coulomb = { friction = 0.3 }

[[bodies]]
name = "gate"
shape.box = { size = [1.0, 1.0, 0.1] }
material = "steel"
position = [0.0, 0.0, -0.05]
motion = "fixed"
removed_at = 0.1

[[bodies]]
shape.ball = { radius = 0.05 }
material = "steel"
position = [0.0, 0.0, 0.05]
"#;

/// A ball lies on the gate until 0.1 s, and then falls g t²/2; with θ = 1/2 that is exact.
#[test]
fn a_ball_falls_from_the_time_at_which_its_gate_is_removed() {
    let mut world = solid(GATE, &[]);
    steps(&mut world, 400, |world, record| {
        let fallen = (world.time - 0.1).max(0.0);
        let z = world.bodies.pose[1].position[2];
        assert!((z - 0.05 + 5.0 * fallen * fallen).abs() < 1e-12, "{z} at {}", world.time);
        assert_eq!((record.bodies, record.contacts), if fallen > 1e-9 { (1, 0) } else { (2, 1) });
    });
    assert_eq!((world.schedule.removed(), world.bodies.present(), world.bodies.len()), (1, 1, 2));
}

/// A source over a floor with a hole's worth of sink below: what rains through.
const RAIN: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 1e-3, steps = 1500 }
solver = { criterion = "scaled", tolerance = 1e-9, start = "warm" }
materials.glass.density = 2500.0
default_law.coulomb = { friction = 0.3 }

[[bodies]]
shape.box = { size = [0.2, 0.2, 0.02] }
material = "glass"
position = [0.0, 0.0, -0.01]
motion = "fixed"

[[bodies]]
shape.box = { size = [0.02, 0.02, 0.02] }
material = "glass"
position = [5.0, 0.0, 0.0]

[[sources]]
material = "glass"
radii.uniform = { min = 0.008, max = 0.012 }
min = [-0.07, -0.07, 0.2]
max = [0.07, 0.07, 0.25]
rate = 400.0
from = 0.1
velocity = [0.0, 0.0, -1.0]

[[sinks]]
min = [-10.0, -10.0, -0.7]
max = [10.0, 10.0, -0.3]
"#;

fn bits(world: &SolidWorld, bodies: impl Iterator<Item = usize>) -> Vec<u64> {
    let pose = |i: usize| {
        let pose = &world.bodies.pose[i];
        pose.position.into_iter().chain(Solid::quaternion(pose.rotation))
    };
    bodies.flat_map(|i| pose(i).chain(world.bodies.velocity[i])).map(f64::to_bits).collect()
}

/// One ball each 2.5 ms from 0.1 s on; what has come is there or has been removed; the ledger closes; any number of threads gives the
/// same bits.
#[test]
fn a_source_brings_its_rate_and_a_sink_takes_what_falls_into_it() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = solid(RAIN, &[]);
            steps(&mut world, 1500, |world, record| {
                // Events of a step happen at its beginning.
                let since = world.time - 1e-3 - 0.1;
                let due = if since < -1e-9 { 0 } else { (since / 2.5e-3 + 1e-6).floor() as u64 + 1 };
                let (came, went) = (world.schedule.inserted(), world.schedule.removed());
                assert_eq!(came, due, "at {}", world.time);
                assert_eq!((record.bodies as u64, world.bodies.present() as u64), (2 + came - went, 2 + came - went));
            });
            assert!(world.schedule.removed() > 100, "{} fell off", world.schedule.removed());
            bits(&world, 0..world.bodies.len())
        })
    };
    let once = run(1);
    assert!(run(2) == once && run(3) == once);
}

/// Without gravity all stay where they appeared, so that all pairs can be looked at; when the region is full the rest wait.
#[test]
fn bodies_appear_where_they_overlap_nothing_and_wait_for_room() {
    let sets = ["gravity=[0.0, 0.0, 0.0]", "sources.0.velocity=[0.0, 0.0, 0.0]", "sources.0.rate=1000.0", "sources.0.tries=20"];
    let mut world = solid(RAIN, &[&sets[..], &["bodies.1.position=[0.0, 0.0, 0.22]"]].concat());
    steps(&mut world, 1000, |_, _| {});
    let bodies = &world.bodies;
    let came = world.schedule.inserted();
    // Random insertion fills at most 0.38 of the volume, which is 90 balls; less near walls.
    assert!((40..90).contains(&came), "{came} came of 900 that were due");
    let present: Vec<usize> = (2..bodies.len()).filter(|&i| bodies.is_present(i)).collect();
    assert_eq!(present.len() as u64, came);
    let radius = |i: usize| (bodies.mass[i][0] / (2500.0 * 4.0 / 3.0 * std::f64::consts::PI)).cbrt();
    for (n, &i) in present.iter().enumerate() {
        let at = bodies.pose[i].position;
        let inside =
            |k: usize| at[k] - radius(i) >= [-0.07, -0.07, 0.2][k] - 1e-15 && at[k] + radius(i) <= [0.07, 0.07, 0.25][k] + 1e-15;
        assert!((0..3).all(inside), "{at:?}");
        // The distance from the box in the middle of the region.
        let from_box = (0..3).map(|k| ((at[k] - [0.0, 0.0, 0.22][k]).abs() - 0.01).max(0.0).powi(2)).sum::<f64>().sqrt();
        assert!(from_box > radius(i), "{at:?}");
        for &j in &present[..n] {
            let apart = (0..3).map(|k| (at[k] - bodies.pose[j].position[k]).powi(2)).sum::<f64>().sqrt();
            assert!(apart > (radius(i) + radius(j)) * (1.0 - 1e-12), "{i} and {j} overlap");
        }
    }
}

/// Bodies that are removed at once leave no trace: all others get the same bits as in a scene that never had them.
#[test]
fn a_run_with_removed_bodies_is_that_of_a_scene_without_them() {
    let heap = |extra: &str| {
        format!(
            r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = {{ step = 1e-3, steps = 300 }}
solver = {{ tolerance = 1e-5, start = "warm" }}
materials.glass.density = 2500.0
default_law.coulomb = {{ friction = 0.3 }}
containers = [{{ min = [0.0, 0.0, 0.0], max = [0.06, 0.06, 0.2], open = ["+z"], material = "glass" }}]
{extra}
[[generate]]
material = "glass"
count = 60
radii.uniform = {{ min = 0.004, max = 0.006 }}
packing = {{ min = [0.0, 0.0, 0.02], max = [0.06, 0.06, 0.1] }}
"#
        )
    };
    let gone = r#"
[[bodies]]
shape.ball = { radius = 0.009 }
material = "glass"
position = [0.03, 0.03, 0.01]
removed_at = 0.0
[[bodies]]
shape.box = { size = [0.06, 0.06, 0.002] }
material = "glass"
position = [0.03, 0.03, 0.11]
motion = "fixed"
removed_at = 0.0
[[bodies]]
shape.half_space = { normal = [0.0, 0.0, 1.0] }
material = "glass"
position = [0.0, 0.0, -1.0]
removed_at = 0.0
"#;
    let (mut with, mut without) = (solid(&heap(gone), &[]), solid(&heap(""), &[]));
    steps(&mut with, 300, |_, _| {});
    let mut active = 0;
    steps(&mut without, 300, |_, record| active = record.active);
    assert!(active > 60, "{active} contacts are no heap");
    assert!(bits(&with, 3..with.bodies.len()) == bits(&without, 0..without.bodies.len()));
    assert!(bits(&with, 0..3).chunks(13).all(|body| f64::from_bits(body[0]).is_nan()));
}

/// ParaView's files have a point for each body that is there.
#[test]
fn files_leave_out_who_is_not_there() {
    let folder = tempfile::tempdir().unwrap();
    let mut world = solid(RAIN, &["sinks.0.max.2=-0.01"]);
    let mut observers: [Box<dyn Observer<Solid, 3, 6>>; 1] = [Box::new(VtkOutput::create(folder.path(), 50).unwrap())];
    let mut counts = vec![world.bodies.present()];
    let stop = AtomicBool::new(false);
    run(&mut world, &mut Workspace::default(), Task::new(600), &mut observers, &stop, |record| {
        if record.step % 50 == 0 {
            counts.push(record.bodies);
        }
    })
    .unwrap();
    assert!(counts[0] == 2 && counts[12] > 50 && world.schedule.removed() > 0, "{counts:?}");
    for (frame, count) in counts.iter().enumerate() {
        let file = std::fs::read(folder.path().join(format!("bodies_{:08}.vtp", 50 * frame))).unwrap();
        let said = format!("NumberOfPoints=\"{count}\"");
        assert!(file.windows(said.len()).any(|part| part == said.as_bytes()), "frame {frame} has not {count} points");
    }
}

/// A ball hangs by a rod from another, which hangs from the world until it is removed: then the first one falls as a free body does.
#[test]
fn a_joint_ends_with_the_first_of_its_bodies_that_is_removed() {
    let mut world = solid(
        r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 1e-3, steps = 300 }
solver = { criterion = "scaled", tolerance = 1e-12 }
materials.steel.density = 1000.0
[[bodies]]
name = "upper"
shape.ball.radius = 0.1
material = "steel"
position = [0.0, 0.0, 1.0]
removed_at = 0.1
[[bodies]]
name = "lower"
shape.ball.radius = 0.1
material = "steel"
position = [0.0, 0.0, 0.0]
[[joints]]
between = ["upper"]
kind.ball.anchor = [0.0, 0.0, 2.0]
[[joints]]
between = ["upper", "lower"]
kind.distance = { from = [0.0, 0.0, 1.0], to = [0.0, 0.0, 0.0] }
"#,
        &[],
    );
    steps(&mut world, 100, |world, _| assert!(world.bodies.pose[1].position[2].abs() < 1e-9));
    steps(&mut world, 200, |_, _| {});
    let (z, v) = (world.bodies.pose[1].position[2], world.bodies.velocity[1][2]);
    assert!((v + 2.0).abs() < 1e-9 && (z + 0.2).abs() < 1e-9, "{z} m, {v} m/s");
}
