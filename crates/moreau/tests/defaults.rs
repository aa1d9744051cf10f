//! What a scene gets without asking: fast bodies stop at thin plates, overlaps stay small, sizes do not matter, and grips hold.

use moreau::scene::{AnyWorld, Scene};
use moreau::space::Solid;
use moreau::step::{StepRecord, Workspace, step};
use moreau::world::World;

fn build(text: &str, sets: &[String]) -> World<Solid, 3, 6> {
    let scene = Scene::parse_with(text, "scene.toml", sets).unwrap_or_else(|error| panic!("{error}"));
    match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("the scene is in space"),
    }
}

fn run(world: &mut World<Solid, 3, 6>, steps: u64) -> Vec<StepRecord> {
    let mut work = Workspace::default();
    (0..steps).map(|_| step(world, &mut work).unwrap_or_else(|error| panic!("{error}"))).collect()
}

/// Bodies of a centimetre fly half a metre at a plate of two millimetres, in steps of 1 ms in which they go up to 30 cm.
#[test]
fn what_is_fast_stops_at_a_thin_plate() {
    let shapes = [
        "ball = { radius = 0.01 }",
        "box = { size = [0.02, 0.02, 0.02] }",
        "capsule = { radius = 0.005, length = 0.02 }",
        "cylinder = { radius = 0.01, length = 0.01 }",
    ];
    for (speed, restitution) in [(5, 0.0), (50, 0.0), (50, 1.0), (300, 0.0), (300, 0.5), (300, 1.0)] {
        let starts = [(-0.5, "approach"), (-0.523, "approach"), (-0.5, "closed"), (-0.523, "closed")];
        for (shape, (start, acts)) in shapes.into_iter().flat_map(|shape| starts.map(|start| (shape, start))) {
            let text = format!(
                "dimension = 3\ntime = {{ step = 1e-3, steps = 1 }}\nmaterials.m.density = 1000.0\n\
                 default_law.coulomb = {{ friction = 0.3, restitution = {restitution:?}, acts = \"{acts}\" }}\n\
                 [[bodies]]\nmotion = \"fixed\"\nshape.box.size = [0.002, 1.0, 1.0]\nmaterial = \"m\"\nposition = [0.0, 0.0, 0.0]\n\
                 [[bodies]]\nshape.{shape}\nmaterial = \"m\"\nposition = [{start:?}, 0.1, 0.05]\nvelocity = [{speed}.0, 2.0, 1.0]\n"
            );
            let mut world = build(&text, &[]);
            let steps = 700 / speed + 10;
            let records = run(&mut world, steps);
            let (x, v) = (world.bodies.pose[1].position[0], world.bodies.velocity[1][0]);
            let said = format!("{shape} from {start} at {speed} m/s, e = {restitution}: at {x}, {v} m/s");
            assert!(x < 0.0, "{said}");
            assert!(v < 0.5 * f64::from(speed as u32), "{said}");
            let overlap = records.iter().map(|record| record.overlap).fold(0.0, f64::max);
            assert!(overlap <= 1.001e-3, "{said}, overlap {overlap}");
            assert!(records.iter().all(|record| record.created.total() < 1e-3 * records[0].energy.kinetic), "{said}");
        }
    }
}

/// Three cubes on each other, a micrometre to a kilometre: none sinks or moves by more than a millionth of its size in a thousand steps, and all
/// sizes take about as many sweeps.
#[test]
fn a_stack_stands_whatever_its_size() {
    for size in [1e-6_f64, 1e-3, 1.0, 1e3] {
        let mut text = format!(
            "dimension = 3\ngravity = [0.0, 0.0, -9.81]\ntime = {{ step = {:?}, steps = 1 }}\nmaterials.m.density = 2000.0\n\
             default_law.coulomb.friction = 0.3\n[[bodies]]\nmotion = \"fixed\"\nshape.half_space.normal = [0.0, 0.0, 1.0]\n\
             material = \"m\"\nposition = [0.0, 0.0, 0.0]\n",
            1e-3 * size.sqrt()
        );
        for i in 0..3 {
            let height = size * (0.5 + f64::from(i));
            text += &format!(
                "[[bodies]]\nshape.box.size = [{size:?}, {size:?}, {size:?}]\nmaterial = \"m\"\nposition = [0.0, 0.0, {height:?}]\n"
            );
        }
        let mut world = build(&text, &[]);
        let before = world.bodies.pose.clone();
        let records = run(&mut world, 1000);
        assert!(records.iter().all(StepRecord::converged));
        for (i, (now, before)) in world.bodies.pose.iter().zip(&before).enumerate() {
            let moved = (0..3).map(|k| (now.position[k] - before.position[k]).abs()).fold(0.0, f64::max);
            assert!(moved <= 1e-6 * size, "body {i} of {size} m moved by {moved} m");
        }
        let sweeps = records.iter().map(|record| record.sweeps).sum::<u64>() as f64 / 1000.0;
        assert!(sweeps < 20.0, "{size} m: {sweeps} sweeps a step");
    }
}

/// A box of 4 g between two pads on sliders, each pressed with the force N; its weight m g is held at μ = m g/2N.
const GRIP: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -9.81]
time = { step = 0.001, steps = 1 }
solver.tolerance = 1e-9
materials.m.density = 1000.0
default_law.coulomb.friction = 1.0
[[bodies]]
name = "left"
shape.box = { size = [0.01, 0.03, 0.03] }
material = "m"
position = [-0.01, 0.0, 0.0]
force = [0.04, 0.0, 0.08829]
[[bodies]]
name = "right"
shape.box = { size = [0.01, 0.03, 0.03] }
material = "m"
position = [0.01, 0.0, 0.0]
force = [-0.04, 0.0, 0.08829]
[[bodies]]
shape.box = { size = [0.01, 0.02, 0.02] }
material = "m"
position = [0.0, 0.0, 0.0]
[[joints]]
kind.slider.axis = [1.0, 0.0, 0.0]
between = ["left"]
[[joints]]
kind.slider.axis = [1.0, 0.0, 0.0]
between = ["right"]
"#;

/// How far the box falls or moves in so many steps at `part` of the friction that holds it, m.
fn slips(grip: &str, part: f64, (global, start): (&str, &str), steps: u64) -> f64 {
    let friction = part * 0.004 * 9.81 / (2.0 * 0.04);
    let sets = [
        format!("default_law.coulomb.friction={friction:?}"),
        format!("solver.global=\"{global}\""),
        format!("solver.start=\"{start}\""),
    ];
    let mut world = build(grip, &sets);
    let records = run(&mut world, steps);
    assert!(part < 1.0 || records.iter().all(StepRecord::converged), "{part}, {global}, {start}");
    world.bodies.pose[2].position.iter().map(|x| x.abs()).fold(0.0, f64::max)
}

#[test]
fn a_box_between_pads_is_held_where_friction_can_hold_it_and_falls_where_it_cannot() {
    for global in ["accelerated", "auto", "nlgs", "active_set", "admm", "apgd", "cpg"] {
        for start in ["warm", "cold"] {
            for part in [1.01, 1.2, 3.0] {
                let moved = slips(GRIP, part, (global, start), 300);
                assert!(moved < 1e-10, "{global}, {start}: at {part} of the friction it needs the box moves by {moved} m");
            }
        }
    }
    for global in ["accelerated", "auto", "admm"] {
        let fell = slips(GRIP, 0.99, (global, "warm"), 300);
        // It is held by 0.99 of its weight: ½ 0.0981 m/s² (0.3 s)².
        assert!(fell > 4e-3, "{global}: it fell by {fell} m");
    }
}

#[test]
fn a_shelf_that_a_held_box_does_not_touch_changes_nothing() {
    // Contacts with a gap are in the problem, as the box could fall on the shelf within the step.
    let shelf = |gap: f64| {
        let z = -0.02 - gap;
        format!(
            "{GRIP}[[bodies]]\nmotion = \"fixed\"\nshape.box.size = [0.009, 0.02, 0.02]\nmaterial = \"m\"\nposition = [0.0, 0.0, {z:?}]\n"
        )
    };
    for gap in [1e-6, 5e-6] {
        let moved = slips(&shelf(gap), 1.01, ("accelerated", "warm"), 300);
        assert!(moved < 1e-10, "{gap} m above a shelf the box moves by {moved} m");
    }
}
