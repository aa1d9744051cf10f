//! Contacts that turn (theory, section 23): bodies that roll or stick keep their height and their energy to second order in the step, at rest nothing
//! changes, and rows that stay frozen are of first order.

use glam::{DQuat, DVec3};
use moreau::convergence::study;
use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid};
use moreau::step::{StepRecord, Workspace, step};
use moreau::world::World;
use std::sync::atomic::AtomicBool;

const UP: DVec3 = DVec3::Z;
const GROUND: &str = "shape = { half_space = { normal = [0.0, 0.0, 1.0] } }";

fn load(text: &str) -> Scene {
    Scene::parse(text, "turning.toml").unwrap_or_else(|error| panic!("{error}"))
}

fn solid(text: &str) -> World<Solid, 3, 6> {
    match load(text).build(u64::MAX) {
        Ok(AnyWorld::Solid(world)) => world,
        other => panic!("{:?}", other.err()),
    }
}

fn plane(text: &str) -> World<Plane, 2, 3> {
    match load(text).build(u64::MAX) {
        Ok(AnyWorld::Plane(world)) => world,
        other => panic!("{:?}", other.err()),
    }
}

fn list(v: DVec3) -> String {
    format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
}

/// A body that touches a fixed one at one point, with no velocity there.
struct Lasting {
    ground: String,
    shape: String,
    position: DVec3,
    turn: (DVec3, f64),
    point: DVec3,
    spin: DVec3,
    friction: f64,
}

impl Lasting {
    /// A body that stands on the ground with the lowest of these points (in its own frame) and turns about it.
    fn on_ground(shape: &str, points: &[DVec3], axis: DVec3, degrees: f64, spin: DVec3) -> Self {
        let turn = DQuat::from_axis_angle(axis.normalize(), degrees.to_radians());
        let lowest = points.iter().map(|&p| turn * p).min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
        let position = DVec3::new(0.0, 0.0, -lowest.z);
        let (ground, shape) = (GROUND.to_owned(), shape.to_owned());
        Self { ground, shape, position, turn: (axis, degrees), point: position + lowest, spin, friction: 3.0 }
    }

    fn scene(&self, step: f64, steps: u64) -> String {
        let velocity = -self.spin.cross(self.point - self.position);
        format!(
            "dimension = 3\ngravity = [0.0, 0.0, -9.81]\ntime = {{ step = {step:?}, steps = {steps} }}\n\
             solver = {{ start = \"warm\", criterion = \"scaled\", tolerance = 1e-12 }}\nmaterials.m.density = 1000.0\n\
             default_law.coulomb = {{ friction = {:?}, acts = \"approach\" }}\n\
             bodies = [\n  {{ material = \"m\", motion = \"fixed\", position = [0.0, 0.0, 0.0], {} }},\n  {{ material = \"m\", shape = {{ {} }}, position = {}, velocity = {}, \
             spin = {}, orientation = {{ axis = {}, degrees = {:?} }} }},\n]\n",
            self.friction,
            self.ground,
            self.shape,
            list(self.position),
            list(velocity),
            list(self.spin),
            list(self.turn.0),
            self.turn.1,
        )
    }
}

/// The lowest points of a cylinder's two rims so turned.
fn rims(radius: f64, half: f64, axis: DVec3, degrees: f64) -> Vec<DVec3> {
    let down = DQuat::from_axis_angle(axis.normalize(), degrees.to_radians()).inverse() * -UP;
    let out = DVec3::new(down.x, down.y, 0.0).normalize() * radius;
    vec![out + half * UP, out - half * UP]
}

fn corners(x: f64, y: f64, z: f64) -> Vec<DVec3> {
    let side = |corner: u32, bit: u32, half: f64| if corner >> bit & 1 == 0 { -half } else { half };
    (0..8).map(|corner| DVec3::new(side(corner, 0, x), side(corner, 1, y), side(corner, 2, z))).collect()
}

fn orders(scene: &Scene) -> [f64; 3] {
    let levels = study(scene, 3, u64::MAX, &AtomicBool::new(false), |_| {}).unwrap();
    assert!(levels.len() == 4 && levels.iter().all(|level| level.unconverged == 0));
    levels[2].difference.unwrap().orders(&levels[3].difference.unwrap())
}

/// Asserts second order, and first with frozen rows where the contact moves over the body.
#[track_caller]
fn is_of_second_order(name: &str, text: &str, frozen_is_first: bool) {
    let mut scene = load(text);
    let [position, velocity, _] = orders(&scene);
    assert!(position > 1.85 && velocity > 1.8, "{name}: {position} {velocity}");
    scene.time.rows = moreau::world::Rows::Frozen;
    let frozen = orders(&scene);
    assert!(!frozen_is_first || frozen[0] < 1.3, "{name}: frozen rows are of order {}", frozen[0]);
}

#[test]
fn bodies_that_turn_on_the_ground_are_of_second_order() {
    let y = DVec3::Y;
    let tilted = DVec3::new(1.0, 0.6, 0.0);
    let spin = DVec3::new(0.4, 0.2, 3.0);
    let tetrahedron = [[0.0, 0.0, 0.0], [0.2, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.2]];
    let cases = [
        ("rim", Lasting::on_ground("cylinder = { radius = 0.1, length = 0.2 }", &rims(0.1, 0.1, y, 30.0), y, 30.0, spin)),
        ("disk", Lasting::on_ground("cylinder = { radius = 0.1, length = 0.02 }", &rims(0.1, 0.01, y, 60.0), y, 60.0, spin)),
        ("corner", Lasting::on_ground("box = { size = [0.2, 0.15, 0.1] }", &corners(0.1, 0.075, 0.05), tilted, 40.0, spin)),
        ("edge", Lasting::on_ground("box = { size = [0.2, 0.15, 0.1] }", &corners(0.1, 0.075, 0.05), y, 30.0, y)),
        (
            "hull",
            Lasting::on_ground(
                &format!("polyhedron = {{ points = {tetrahedron:?} }}"),
                &tetrahedron.map(|p| DVec3::from(p) - DVec3::splat(0.05)),
                tilted,
                10.0,
                spin,
            ),
        ),
    ];
    for (name, mut case) in cases {
        if name == "hull" {
            // Its own frame is turned: it stands where the scene puts it.
            let turn = DQuat::from_axis_angle(tilted.normalize(), 10.0_f64.to_radians());
            let lowest = tetrahedron.map(|p| turn * (DVec3::from(p) - DVec3::splat(0.05)));
            let lowest = lowest.into_iter().min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
            case.position = DVec3::new(0.0, 0.0, -lowest.z);
            case.point = case.position + lowest;
        }
        is_of_second_order(name, &case.scene(4e-3, 16), name != "hull");
    }
    // The lowest point of a capsule is under the centre of its end.
    let end = DQuat::from_axis_angle(y, 30.0_f64.to_radians()) * DVec3::new(0.0, 0.0, -0.15);
    let capsule = Lasting {
        ground: GROUND.to_owned(),
        shape: "capsule = { radius = 0.05, length = 0.3 }".to_owned(),
        position: DVec3::new(0.0, 0.0, 0.05 - end.z),
        turn: (y, 30.0),
        point: DVec3::new(end.x, 0.0, 0.0),
        spin,
        friction: 3.0,
    };
    is_of_second_order("capsule", &capsule.scene(4e-3, 16), true);
    let side = Lasting {
        shape: "cylinder = { radius = 0.1, length = 0.2 }".to_owned(),
        position: DVec3::new(0.0, 0.0, 0.1),
        turn: (DVec3::X, 90.0),
        point: DVec3::ZERO,
        spin: DVec3::new(0.0, 5.0, 0.0),
        ..capsule
    };
    is_of_second_order("cylinder on its side", &side.scene(4e-3, 16), false);
}

#[test]
fn bodies_that_roll_over_curved_ones_are_of_second_order() {
    let slope = DVec3::new(0.3_f64.sin(), 0.0, 0.3_f64.cos());
    let ball = |ground: &str, spin: DVec3| Lasting {
        ground: ground.to_owned(),
        shape: "ball = { radius = 0.1 }".to_owned(),
        position: 0.3 * slope,
        turn: (UP, 0.0),
        point: 0.2 * slope,
        spin,
        friction: 1.0,
    };
    let lying = "orientation = { axis = [1.0, 0.0, 0.0], degrees = 90.0 }";
    let ground = "shape = { ball = { radius = 0.2 } }";
    is_of_second_order("ball on ball", &ball(ground, DVec3::new(0.2, 2.0, 1.0)).scene(4e-3, 20), true);
    let ground = format!("shape = {{ cylinder = {{ radius = 0.2, length = 2.0 }} }}, {lying}");
    is_of_second_order("ball on cylinder", &ball(&ground, DVec3::new(-1.0, 2.0, 0.5)).scene(4e-3, 20), false);
    // The rim of a cylinder on a capsule across it.
    let lowest = rims(0.1, 0.025, DVec3::Y, 20.0);
    let turn = DQuat::from_axis_angle(DVec3::Y, 20.0_f64.to_radians());
    let lowest = lowest.into_iter().map(|p| turn * p).min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
    let rim = Lasting {
        ground: "shape = { capsule = { radius = 0.05, length = 2.0 } }, orientation = { axis = [0.0, 1.0, 0.0], degrees = 90.0 }"
            .to_owned(),
        shape: "cylinder = { radius = 0.1, length = 0.05 }".to_owned(),
        position: DVec3::new(-lowest.x, 0.0, 0.05 - lowest.z),
        turn: (DVec3::Y, 20.0),
        point: DVec3::new(0.0, 0.0, 0.05),
        spin: DVec3::new(0.3, 0.2, 3.0),
        friction: 2.0,
    };
    is_of_second_order("rim on capsule", &rim.scene(4e-3, 16), true);
    // An edge of a box on an edge.
    let axis = DVec3::new(1.0, 0.2, 0.0);
    let turn = DQuat::from_axis_angle(axis.normalize(), 25.0_f64.to_radians());
    let (way, corner) = (turn * DVec3::X, turn * DVec3::new(0.0, -0.1, -0.05));
    let crossing = corner - way * (corner.x / way.x);
    let top = DVec3::new(0.0, 0.0, 0.1 * 2.0_f64.sqrt());
    let edge = Lasting {
        ground: "shape = { box = { size = [0.2, 2.0, 0.2] } }, orientation = { axis = [0.0, 1.0, 0.0], degrees = 45.0 }"
            .to_owned(),
        shape: "box = { size = [0.3, 0.2, 0.1] }".to_owned(),
        position: top - DVec3::new(0.0, 0.0, crossing.z),
        turn: (axis, 25.0),
        point: crossing + top - DVec3::new(0.0, 0.0, crossing.z),
        spin: DVec3::new(0.3, 0.6, 0.5),
        friction: 3.0,
    };
    is_of_second_order("edge on edge", &edge.scene(4e-3, 16), true);
}

/// The same for a body of the plane that stands on its lowest point (given in its frame) and turns about it.
fn in_plane(ground: &str, shape: &str, lowest: [f64; 2], degrees: f64, spin: f64) -> String {
    let (sin, cos) = f64::to_radians(degrees).sin_cos();
    let [x, y] = [cos * lowest[0] - sin * lowest[1], sin * lowest[0] + cos * lowest[1]];
    format!(
        "dimension = 2\ngravity = [0.0, -9.81]\ntime = {{ step = 4e-3, steps = 16 }}\n\
         solver = {{ start = \"warm\", criterion = \"scaled\", tolerance = 1e-12 }}\nmaterials.m.density = 1000.0\n\
         default_law.coulomb = {{ friction = 3.0, acts = \"approach\" }}\n\
         bodies = [\n  {{ material = \"m\", motion = \"fixed\", position = [0.0, 0.0], {ground} }},\n  {{ material = \"m\", shape = {{ {shape} }}, position = [0.0, {:?}], \
         velocity = [{:?}, {:?}], spin = {spin:?}, orientation = {degrees:?} }},\n]\n",
        -y,
        spin * y,
        -spin * x,
    )
}

#[test]
fn bodies_of_the_plane_that_turn_are_of_second_order() {
    let half_plane = "shape = { half_plane = { normal = [0.0, 1.0] } }";
    let polyline = "shape = { polyline = { points = [[-3.0, 0.0], [-0.013, 0.0], [3.0, 0.0]] } }";
    let bar = "box = { size = [0.2, 0.1] }";
    for ground in [half_plane, polyline] {
        is_of_second_order(ground, &in_plane(ground, bar, [-0.1, -0.05], 60.0, 1.0), false);
    }
    // A capsule's end is a ball: its lowest point is straight under the centre of it.
    let degrees = 50.0_f64;
    let (sin, cos) = degrees.to_radians().sin_cos();
    let under = [-0.1 - 0.05 * sin, -0.05 * cos];
    is_of_second_order("capsule", &in_plane(half_plane, "capsule = { length = 0.2, radius = 0.05 }", under, degrees, 1.0), false);
    let parts = "compound = { parts = [{ shape = { box = { size = [0.2, 0.1] } }, position = [0.0, 0.0] }] }";
    is_of_second_order("compound", &in_plane(half_plane, parts, [-0.1, -0.05], 60.0, 1.0), false);
}

/// Euler's disk in steady rolling with its centre at rest: a cylinder of radius a and half the length b at the tilt α. With the contact at p = a e − b d from the
/// centre (d the axis, e the way down in the cap) the spin ω is along p, and angular momentum turns about the vertical as the torque m g has it:
///
///   ω² = g (a c − b s) |p|² s / (a (A a c − B b s)),   A = a²/4 + b²/3, B = a²/2, s = sin α, c = cos α.
fn euler_disk(degrees: f64, h: f64, steps: u64) -> (World<Solid, 3, 6>, [f64; 2]) {
    let (a, b, g) = (0.04, 0.004, 9.81);
    let (s, c) = degrees.to_radians().sin_cos();
    let p = DVec3::new(a * c - b * s, 0.0, -(a * s + b * c));
    let (across, along) = (a * a / 4.0 + b * b / 3.0, a * a / 2.0);
    let square = g * p.x * p.length_squared() * s / (a * (across * a * c - along * b * s));
    let spin = -p.normalize() * square.sqrt();
    let disk = Lasting {
        ground: GROUND.to_owned(),
        shape: format!("cylinder = {{ radius = {a}, length = {} }}", 2.0 * b),
        position: DVec3::new(0.0, 0.0, -p.z),
        turn: (DVec3::Y, degrees),
        point: DVec3::new(p.x, 0.0, 0.0),
        spin,
        friction: 1.0,
    };
    (solid(&disk.scene(h, steps)), [-p.z, spin.length()])
}

/// Height, tilt (rad), spin and energy of the disk, each relative to its start; and the deepest overlap, m.
fn rolled(degrees: f64, h: f64, seconds: f64) -> ([f64; 4], f64) {
    let steps = (seconds / h).round() as u64;
    let (mut world, [height, spin]) = euler_disk(degrees, h, steps);
    let mut work = Workspace::default();
    let energy = |r: &StepRecord| r.energy.kinetic + r.energy.potential;
    let (mut first, mut last, mut deepest) = (None, 0.0, 0.0_f64);
    for _ in 0..steps {
        let record = step(&mut world, &mut work).unwrap();
        assert!(record.converged());
        last = energy(&record);
        first.get_or_insert(last);
        deepest = deepest.max(record.penetration);
    }
    let axis = world.bodies.pose[1].rotation * UP;
    let tilt = axis.truncate().length().atan2(axis.z.abs());
    let spun = DVec3::new(world.bodies.velocity[1][3], world.bodies.velocity[1][4], world.bodies.velocity[1][5]).length();
    let relative = [
        world.bodies.pose[1].position[2] / height - 1.0,
        tilt / degrees.to_radians() - 1.0,
        spun / spin - 1.0,
        last / first.unwrap() - 1.0,
    ];
    (relative, deepest)
}

#[test]
fn a_disk_rolls_on_its_rim_for_ever() {
    for degrees in [3.0, 10.0, 30.0] {
        let (relative, deepest) = rolled(degrees, 1e-4, 10.0);
        assert!(relative.iter().all(|x| x.abs() < 1e-3), "{degrees} degrees: {relative:?}");
        assert!(deepest < 1e-5, "{degrees} degrees: {deepest} m");
    }
}

#[test]
fn what_a_disk_loses_is_of_second_order() {
    let lost = [4e-4, 2e-4, 1e-4].map(|h| rolled(10.0, h, 0.3).0[3].abs());
    assert!(lost[0] > 3.4 * lost[1] && lost[1] > 3.4 * lost[2], "{lost:?}");
}

#[test]
fn a_ball_on_a_turntable_keeps_its_speed() {
    // With k = 2Ω/7 a ball that rolls goes round in circles (Earnshaw 1844).
    let drift = |h: f64| {
        let turns = 2.0 * std::f64::consts::PI / (2.0 / 7.0 * 2.0);
        let steps = (turns / h).round() as u64;
        let mut world = solid(&format!(
            "dimension = 3\ngravity = [0.0, 0.0, -9.81]\ntime = {{ step = {h:?}, steps = {steps} }}\n\
             solver = {{ start = \"warm\", criterion = \"scaled\", tolerance = 1e-12 }}\nmaterials.m.density = 1000.0\n\
             default_law.coulomb = {{ friction = 0.6 }}\nbodies = [\n\
             {{ material = \"m\", position = [0.0, 0.0, 0.0], drive = [{{ axis = [0.0, 0.0, 1.0], spin = 2.0 }}], {GROUND} }},\n\
             {{ material = \"m\", position = [0.4, 0.0, 0.05], velocity = [0.3, 0.1, 0.0], spin = [14.0, 6.0, 1.0], shape = {{ ball = {{ \
             radius = 0.05 }} }} }},\n]\n"
        ));
        let speed = |world: &World<Solid, 3, 6>| world.bodies.velocity[1][..2].iter().map(|x| x * x).sum::<f64>().sqrt();
        let (before, mut work) = (speed(&world), Workspace::default());
        (0..steps).for_each(|_| assert!(step(&mut world, &mut work).unwrap().converged()));
        (speed(&world) / before - 1.0).abs()
    };
    let drifts = [8e-3, 4e-3].map(drift);
    assert!(drifts[1] < 1e-4 && drifts[0] > 3.0 * drifts[1], "{drifts:?}");
}

#[test]
fn a_pole_falls_as_energy_has_it_and_lands_without_sinking_in() {
    let (a, b, g) = (0.005, 1.0, 9.81);
    for shape in ["cylinder", "capsule"] {
        let y = DVec3::Y;
        let mut pole =
            Lasting::on_ground("cylinder = { radius = 0.005, length = 2.0 }", &rims(a, b, y, 5.0), y, 5.0, DVec3::ZERO);
        pole.friction = 2.0;
        if shape == "capsule" {
            pole.shape = "capsule = { radius = 0.005, length = 2.0 }".to_owned();
            pole.position.z = a + b * 5.0_f64.to_radians().cos();
        }
        let mut world = solid(&pole.scene(1e-3, 3000));
        let (start, mut work) = (world.bodies.pose[1].position[2], Workspace::default());
        let (mut checked, mut deepest) = (false, 0.0_f64);
        for _ in 0..2000 {
            let record = step(&mut world, &mut work).unwrap();
            deepest = deepest.max(record.penetration);
            let height = world.bodies.pose[1].position[2];
            if height < 0.05 && !checked {
                checked = true;
                // It slips: where the cosine of its tilt is a third, the ground carries nothing.
                let (kept, fallen) =
                    (record.energy.kinetic + record.energy.friction, world.bodies.mass[1][0] * g * (start - height));
                assert!((kept / fallen - 1.0).abs() < 1e-3, "{shape}: {kept} J of {fallen} J");
            }
        }
        assert!(checked && deepest < 1e-4 * a, "{shape}: {deepest} m deep");
    }
}

#[test]
fn at_rest_nothing_changes() {
    let text = |rows: &str| {
        format!(
            "dimension = 2\ngravity = [2.0, -9.81]\ntime = {{ step = 1e-3, steps = 300, rows = \"{rows}\" }}\n\
             solver = {{ start = \"warm\", criterion = \"scaled\", tolerance = 1e-10 }}\nmaterials.m.density = 1000.0\n\
             default_law.coulomb = {{ friction = 0.5 }}\nbodies = [\n\
             {{ material = \"m\", motion = \"fixed\", position = [0.0, 0.0], shape = {{ half_plane = {{ normal = [0.0, 1.0] }} }} }},\n\
             {{ material = \"m\", shape = {{ box = {{ size = [0.2, 0.1] }} }}, position = [0.0, 0.05] }},\n\
             {{ material = \"m\", shape = {{ box = {{ size = [0.1, 0.1] }} }}, position = [0.01, 0.15] }},\n]\n"
        )
    };
    let [turning, frozen] = ["turning", "frozen"].map(|rows| {
        let (mut world, mut work) = (plane(&text(rows)), Workspace::default());
        (0..300).for_each(|_| assert!(step(&mut world, &mut work).unwrap().converged()));
        (world.bodies.pose, world.bodies.velocity)
    });
    // But for the start of the solves: with frozen rows it is not an equilibrium, (87), so rounding differs.
    for (one, other) in turning.0.iter().zip(&frozen.0) {
        let apart = (0..2).map(|k| (one.position[k] - other.position[k]).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-12 && (one.rotation[1] - other.rotation[1]).abs() < 1e-11, "{one:?}, {other:?}");
    }
}
