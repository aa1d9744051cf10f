//! Driven bodies and imposed forces against closed forms.

use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid, Space};
use moreau::step::{StepRecord, Workspace, step};
use moreau::world::World;
use std::f64::consts::{PI, TAU};

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

/// Takes so many steps, each of which must converge and leave the energy ledger closed, and shows each.
fn run<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    steps: u64,
    mut see: impl FnMut(&World<S, D, N>, &StepRecord),
) {
    let mut work = Workspace::default();
    for _ in 0..steps {
        let record = step(world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        let energy = &record.energy;
        assert!(record.converged(), "{record:?}");
        let scale = 1.0 + energy.kinetic + energy.potential.abs() + energy.work.abs() + energy.dissipated.abs();
        assert!(energy.balance_error.abs() < 1e-12 * scale, "{energy:?}");
        see(world, &record);
    }
}

#[track_caller]
fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} is not {expected} to {tolerance:e}");
}

/// A ball on a plate whose height is A sin(2π f t − π/2), at its lowest at the start.
const PLATE: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 2e-4, steps = 5000 }
solver = { criterion = "scaled", tolerance = 1e-12 }
materials.steel.density = 1000.0

[[bodies]]
shape.half_space = { normal = [0.0, 0.0, 1.0] }
material = "steel"
position = [0.0, 0.0, -0.01]
drive = [{ position = [0.0, 0.0, { sine = { amplitude = 0.01, frequency = 4.0, phase = -1.5707963267948966 } }] }]

[[bodies]]
shape.ball = { radius = 0.05 }
material = "steel"
position = [0.0, 0.0, 0.04]
"#;

/// 0.01 (2π 4)² = 6.3 m/s² is below g: the ball stays on the plate. Both follow the same velocities, the ball by the trapezoidal rule,
/// which misses h² a/6 at most, and falls (g + a) h² where that opens the contact for a step.
#[test]
fn a_ball_follows_a_plate_that_shakes_less_than_gravity() {
    for acts in ["closed", "approach"] {
        let mut world = solid(PLATE, &[&format!("default_law={{ frictionless = {{ acts = \"{acts}\" }} }}")]);
        let mut farthest = 0.0_f64;
        run(&mut world, 5000, |world, _| {
            let bodies = &world.bodies;
            farthest = farthest.max((bodies.pose[1].position[2] - bodies.pose[0].position[2] - 0.05).abs());
        });
        assert!(farthest < 2.0 * 17.0 * 2e-4_f64.powi(2), "{acts}: {farthest:e} m apart");
    }
}

/// 0.01 (2π 8)² = 25 m/s² is above g: the ball leaves where the plate falls faster than it, and flies as a stone does.
#[test]
fn a_ball_leaves_a_plate_that_shakes_more_than_gravity() {
    let (amplitude, omega, g) = (0.01, TAU * 8.0, 10.0);
    let mut world = solid(PLATE, &["bodies.0.drive.0.position.2.sine.frequency=8.0"]);
    // A ω² sin(ω t − π/2) = g.
    let leaves = ((g / (amplitude * omega * omega)).asin() + PI / 2.0) / omega;
    let height = amplitude * (omega * leaves - PI / 2.0).sin();
    let speed = amplitude * omega * (omega * leaves - PI / 2.0).cos();
    let (top, highest) = (leaves + speed / g, height + 0.5 * speed * speed / g + 0.05);
    let (mut found, mut at) = (f64::NEG_INFINITY, 0.0);
    run(&mut world, (1.2 * top / 2e-4) as u64, |world, _| {
        let z = world.bodies.pose[1].position[2];
        if z > found {
            (found, at) = (z, world.time);
        }
    });
    // The contact opens at the end of a step: the speed is right to h times the difference of accelerations, which is of order h too.
    close(found, highest, 1e-5, "greatest height");
    close(at, top, 3.0 * 2e-4, "when");
}

const SPACE: &str = r#"
dimension = 3
time = { step = 1e-3, steps = 1000 }
solver = { criterion = "scaled", tolerance = 1e-13 }
materials.steel.density = 1000.0
default_law.frictionless = { restitution = 1.0 }

[[bodies]]
shape.box = { size = [0.2, 0.2, 0.2] }
material = "steel"
position = [0.0, 0.0, 0.0]
drive = [{ velocity = [1.5, 0.0, 0.0] }]

[[bodies]]
shape.ball = { radius = 0.05 }
material = "steel"
position = [0.2, 0.0, 0.0]
"#;

#[test]
fn an_elastic_ball_leaves_a_piston_at_twice_its_speed() {
    let mut world = solid(SPACE, &[]);
    let mut work = 0.0;
    run(&mut world, 1000, |_, record| work = record.energy.work);
    close(world.bodies.velocity[1][0], 3.0, 1e-12, "velocity");
    close(world.bodies.pose[0].position[0], 1.5, 1e-13, "the piston's place");
    close(work, 0.5 * world.bodies.mass[1][0] * 9.0, 1e-12, "work");
}

/// Where a driven body is at the end of each step, to rounding: velocities are integrated exactly, positions taken as they are.
#[test]
fn driven_bodies_are_where_their_functions_say() {
    let sine = "{ sine = { amplitude = 0.3, frequency = 2.5, phase = 0.7, offset = 0.1 } }";
    let table = "{ table = { times = [0.1, 0.35, 0.6004], values = [0.0, 1.0, -0.5] } }";
    let ramp = "{ ramp = { from = 1.0, to = 3.0, begin = 0.2, end = 0.5 } }";
    let wave = |t: f64| 0.1 + 0.3 * (TAU * 2.5 * t + 0.7).sin();
    let wave_sum = |t: f64| 0.1 * t + 0.3 / (TAU * 2.5) * (0.7_f64.cos() - (TAU * 2.5 * t + 0.7).cos());
    let line = |t: f64| 1.0 + 2.0 * ((t - 0.2) / 0.3).clamp(0.0, 1.0);
    let line_sum = |t: f64| {
        t + if t < 0.2 {
            0.0
        } else if t < 0.5 {
            (t - 0.2).powi(2) / 0.3
        } else {
            0.3 + 2.0 * (t - 0.5)
        }
    };
    let points = |t: f64| match t {
        _ if t < 0.1 => 0.0,
        _ if t < 0.35 => 4.0 * (t - 0.1),
        _ if t < 0.6004 => 1.0 - 1.5 * (t - 0.35) / 0.2504,
        _ => -0.5,
    };
    let turn = "axis = [0.0, 0.0, 2.0]";
    let drive = |what: &str, angle: &str| format!("bodies.0.drive=[{{ {what} = [{sine}, {ramp}, {table}], {turn}, {angle} }}]");
    let sets = [drive("position", &format!("angle = {ramp}")), drive("velocity", &format!("spin = {sine}"))];
    for (set, itself) in sets.iter().zip([true, false]) {
        let mut world = solid(SPACE, &[set, "bodies.1.position=[9.0, 9.0, 9.0]"]);
        run(&mut world, 1000, |world, _| {
            let (t, pose) = (world.time, &world.bodies.pose[0]);
            let (x, y, angle) = if itself {
                (wave(t) - wave(0.0), line(t) - line(0.0), line(t) - 1.0)
            } else {
                (wave_sum(t), line_sum(t), wave_sum(t))
            };
            close(pose.position[0], x, 1e-13, "sine");
            close(pose.position[1], y, 1e-13, "ramp");
            if itself {
                close(pose.position[2], points(t), 1e-13, "table");
            }
            let [east, ..] = Solid::rotate(pose.rotation, [1.0, 0.0, 0.0]);
            close(east, angle.cos(), 1e-13, "turn");
        });
    }
}

/// A belt that gathers speed slower than μ g takes a block along with it, one that does so faster loses it until it keeps pace.
#[test]
fn a_block_on_a_conveyor_keeps_pace_or_slides_at_mu_g() {
    let belt = r#"
dimension = 2
gravity = [0.0, -10.0]
time = { step = 1e-3, steps = 1000 }
solver = { criterion = "scaled", tolerance = 1e-13 }
materials.stone.density = 1000.0
default_law.coulomb = { friction = 0.2 }

[[bodies]]
shape.half_plane = { normal = [0.0, 1.0] }
material = "stone"
position = [0.0, 0.0]
drive = [{ velocity = [{ ramp = { from = 0.0, to = 1.0, begin = 0.0, end = 0.25 } }, 0.0] }]

[[bodies]]
shape.polygon = { vertices = [[-0.1, -0.05], [0.1, -0.05], [0.1, 0.05], [-0.1, 0.05]] }
material = "stone"
position = [0.0, 0.05]
"#;
    // 4 m/s² is more than μ g = 2 m/s²: it slides until 0.5 s.
    let mut work = 0.0;
    run(&mut plane(belt, &[]), 1000, |world, record| {
        close(world.bodies.velocity[1][0], (2.0 * world.time).min(1.0), 1e-9, "sliding");
        work = record.energy.work;
    });
    // The belt does μ m g on its own way, 1 · (0.5 − 0.125) m.
    close(work, 0.2 * 20.0 * 10.0 * 0.375, 1e-6, "work of the belt");
    // 1 m/s² is less.
    run(&mut plane(belt, &["bodies.0.drive.0.velocity.0.ramp.end=1.0"]), 1000, |world, _| {
        close(world.bodies.velocity[1][0], world.time, 1e-9, "taken along");
    });
}

/// F = m a: the velocity is the exact integral of the force. Positions are its trapezoidal sum, which for a force that grows as c t
/// is c t³/6m + h² c t/12m, to rounding.
#[test]
fn a_force_gives_its_impulse_exactly() {
    let sine = "{ sine = { amplitude = 40.0, frequency = 3.0 } }";
    let ramp = "{ ramp = { from = 0.0, to = 6.0, begin = 0.0, end = 2.0 } }";
    let set = format!("bodies.0.drive=[{{ force = [{sine}, {ramp}, 1.0], torque = [0.0, 0.0, {ramp}] }}]");
    let mut world = solid(SPACE, &[&set, "bodies.0.force=[0.0, 0.0, 3.0]", "bodies.1.position=[9.0, 9.0, 9.0]"]);
    let (m, inertia, h) = (8.0, 8.0 * 0.08 / 12.0, 1e-3);
    run(&mut world, 1000, |world, _| {
        let (t, v, x) = (world.time, &world.bodies.velocity[0], &world.bodies.pose[0].position);
        close(v[0], 40.0 / m / (TAU * 3.0) * (1.0 - (TAU * 3.0 * t).cos()), 1e-12, "sine");
        close(v[1], 3.0 * t * t / 2.0 / m, 1e-13, "ramp");
        close(v[2], 4.0 * t / m, 1e-13, "constant, and the body's own");
        close(v[5], 3.0 * t * t / 2.0 / inertia, 1e-10, "torque");
        close(x[1], 3.0 * t.powi(3) / 6.0 / m + h * h * 3.0 * t / 12.0 / m, 1e-13, "way under the ramp");
        close(x[2], 4.0 * t * t / 2.0 / m, 1e-13, "way under the constant");
    });
}

/// Held until 0.1 s, then free with a force, then free without, then held again, then moved.
#[test]
fn a_body_is_freed_and_held_at_its_times() {
    let drive = "bodies.0.drive=[{ from = 0.0, motion = \"fixed\" }, { from = 0.1, force = [8.0, 0.0, 0.0] }, { from = 0.3, motion = \
                 \"free\" }, { from = 0.5, motion = \"fixed\" }, { from = 0.7, velocity = [0.0, 2.0, 0.0] }]";
    let mut world = solid(SPACE, &[drive, "bodies.1.position=[9.0, 9.0, 9.0]", "gravity=[0.0, 0.0, -10.0]"]);
    let fall = |t: f64| -5.0 * (t.clamp(0.1, 0.5) - 0.1).powi(2);
    let way = |t: f64| 0.5 * (t.clamp(0.1, 0.3) - 0.1).powi(2) + 0.2 * (t.clamp(0.3, 0.5) - 0.3);
    let mut last = None;
    run(&mut world, 1000, |world, record| {
        let (t, x) = (world.time, &world.bodies.pose[0].position);
        close(x[2], fall(t), 1e-13, "height");
        close(x[0], way(t), 1e-13, "way");
        close(x[1], 2.0 * (t - 0.7).max(0.0), 1e-13, "moved");
        last = Some(record.energy);
    });
    let energy = last.unwrap();
    // The other ball falls alone: m g² t²/2 gained, and as much lost in height. All that the first had went with its being held.
    let ball = world.bodies.mass[1][0];
    close(energy.kinetic, ball * 50.0, 1e-9, "kinetic energy");
    // At 0.1 s the first came in with no energy, at 0.5 s it went with what its force and its fall had given it: its work was 8 N · 20 mm,
    // its kinetic energy then 4 kg (0.2² + 4²) m²/s², its potential energy −64 J.
    close(energy.work, 8.0 * 0.02 - (4.0 * (0.04 + 16.0) - 8.0 * 10.0 * 0.8), 1e-9, "work, and what came and went");
}

/// A rod that turns moves a disk at its side by ω × arm, without friction too.
#[test]
fn a_turning_rod_pushes_along_its_normal() {
    let rod = r#"
dimension = 2
time = { step = 1e-4, steps = 10 }
solver = { criterion = "scaled", tolerance = 1e-13 }
materials.steel.density = 1000.0
default_law.frictionless = {}

[[bodies]]
shape.polygon = { vertices = [[-0.5, -0.05], [0.5, -0.05], [0.5, 0.05], [-0.5, 0.05]] }
material = "steel"
position = [0.0, 0.0]
drive = [{ spin = 2.0 }]

[[bodies]]
shape.disk = { radius = 0.05 }
material = "steel"
position = [0.4, 0.1]
"#;
    let mut world = plane(rod, &[]);
    run(&mut world, 1, |_, _| {});
    close(world.bodies.velocity[1][1], 0.8, 1e-3, "velocity of the disk"); // the normal has turned by 1e-4 at the prediction
    close(world.bodies.velocity[1][2], 0.0, 1e-15, "spin of the disk");
    run(&mut world, 9, |_, _| {});
    let [cosine, sine] = world.bodies.pose[0].rotation;
    close(sine.atan2(cosine), 2e-3, 1e-15, "angle of the rod");
}

/// Halves of a step that fails give the driven body the same places.
#[test]
fn a_driven_body_is_in_its_place_after_a_step_that_was_halved() {
    let sets = ["solver.on_failure=halve", "solver.max_sweeps=1", "default_law.frictionless.restitution=0.0", "time.step=1e-2"];
    let drive = "bodies.0.drive=[{ velocity = [{ sine = { amplitude = 1.0, frequency = 1.0 } }, 0.0, 0.0] }]";
    let mut world = solid(SPACE, &[&sets[..], &[drive, "bodies.1.position=[0.15, 0.0, 0.0]"]].concat());
    run(&mut world, 20, |world, _| {
        close(world.bodies.pose[0].position[0], (1.0 - (TAU * world.time).cos()) / TAU, 1e-14, "place");
    });
}
