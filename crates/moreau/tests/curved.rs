//! Cylinders and capsules that stand, lie, roll and topple.

use moreau::scene::{AnyWorld, Scene};
use moreau::space::Solid;
use moreau::step::{Workspace, step};
use moreau::world::World;

const G: f64 = 10.0;

/// A floor and one body on it; a step of 1 ms, friction 0.5.
fn on_floor(body: &str, more: &str) -> World<Solid, 3, 6> {
    let text = format!(
        r#"
dimension = 3
gravity = [0.0, 0.0, -{G:?}]
time = {{ step = 1e-3, steps = 1 }}
solver = {{ criterion = "scaled", tolerance = 1e-12 }}
materials.stone.density = 1000.0
default_law.coulomb = {{ friction = 0.5 }}

[[bodies]]
shape.half_space = {{ normal = [0.0, 0.0, 1.0] }}
material = "stone"
position = [0.0, 0.0, 0.0]

[[bodies]]
material = "stone"
{body}
{more}
"#
    );
    let scene = Scene::parse_with(&text, "test.toml", &[]).unwrap_or_else(|error| panic!("{error}"));
    let AnyWorld::Solid(world) = scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) else { panic!("of space") };
    world
}

/// Takes steps; gives the number of contacts of the last one.
fn run(world: &mut World<Solid, 3, 6>, steps: usize) -> usize {
    let mut work = Workspace::default();
    (0..steps).map(|_| step(world, &mut work).unwrap().contacts).last().unwrap()
}

/// Checks that a body stays where it is, to what the solver leaves: 1e-12 of the scaled residual a step.
fn rests(mut world: World<Solid, 3, 6>, contacts: usize) {
    let before = world.bodies.pose.clone();
    assert_eq!(run(&mut world, 2000), contacts);
    for (pose, before) in world.bodies.pose.iter().zip(&before) {
        for k in 0..3 {
            assert!((pose.position[k] - before.position[k]).abs() < 1e-9, "{pose:?} was {before:?}");
        }
        assert!(pose.rotation.angle_between(before.rotation) < 1e-7, "{pose:?} was {before:?}");
    }
}

const DRUM: &str = "shape.cylinder = { radius = 0.1, length = 0.4 }";
const LYING: &str = "orientation = { axis = [0, 1, 0], degrees = 90 }";

#[test]
fn a_cylinder_stands_on_its_cap() {
    rests(on_floor(DRUM, "position = [0.0, 0.0, 0.2]"), 4);
}

#[test]
fn a_capsule_and_a_cylinder_lie_still() {
    rests(on_floor("shape.capsule = { radius = 0.1, length = 0.4 }", &format!("position = [0.0, 0.0, 0.1]\n{LYING}")), 2);
    rests(on_floor(DRUM, &format!("position = [0.0, 0.0, 0.1]\n{LYING}")), 2);
}

#[test]
fn a_cylinder_stands_on_a_box_and_on_a_cylinder() {
    let slab = "shape.box = { size = [0.5, 0.5, 0.1] }\nposition = [0.0, 0.0, 0.05]";
    let above = "[[bodies]]\nmaterial = \"stone\"\nshape.cylinder = { radius = 0.1, length = 0.4 }\n";
    // A quarter of its width over the edge of the box; within the cap of a wider cylinder.
    rests(on_floor(slab, &format!("{above}position = [0.2, 0.1, 0.3]")), 8);
    let low = "shape.cylinder = { radius = 0.2, length = 0.1 }\nposition = [0.0, 0.0, 0.05]";
    rests(on_floor(low, &format!("{above}position = [0.05, 0.0, 0.3]")), 8);
}

/// A cylinder that stands on its rim falls back if its centre is behind the rim, and over if it is beyond.
#[test]
fn a_tilted_cylinder_topples_where_its_centre_passes_the_rim() {
    // tan of the tilt at which the centre is above the rim: 0.1/0.2.
    let critical = 0.5_f64.atan();
    for (tilt, falls) in [(critical - 0.02, false), (critical + 0.02, true)] {
        let height = 0.2 * tilt.cos() + 0.1 * tilt.sin();
        let pose = format!("position = [0.0, 0.0, {height:?}]\norientation = {{ axis = [0.0, 1.0, 0.0], angle = {tilt:?} }}");
        let mut world = on_floor(DRUM, &pose);
        run(&mut world, 5000);
        let up = (world.bodies.pose[1].rotation * glam::DVec3::Z).z;
        assert!(if falls { up.abs() < 0.1 } else { up > 0.99 }, "the axis of one tilted by {tilt} ends at {up}");
    }
}

/// a = (2/3) g sin θ where μ ≥ (1/3) tan θ; gravity is turned instead of the floor: tan θ = 0.8, (1/3) tan θ = 0.27 < 0.5.
#[test]
fn a_cylinder_rolls_down_at_two_thirds_of_g_sin() {
    let mut world = on_floor(DRUM, "position = [0.0, 0.0, 0.1]\norientation = { axis = [1, 0, 0], degrees = 90 }");
    world.gravity = [4.0, 0.0, -5.0];
    run(&mut world, 1000);
    let (v, x) = (world.bodies.velocity[1], world.bodies.pose[1].position);
    // A constant acceleration is integrated exactly.
    assert!((v[0] - 8.0 / 3.0).abs() < 1e-8 && (x[0] - 4.0 / 3.0).abs() < 1e-8, "{v:?} {x:?}");
    assert!(x[1].abs() < 1e-8 && (x[2] - 0.1).abs() < 1e-8, "{x:?}");
}
