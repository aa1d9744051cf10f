//! Boxes, capsules, polylines, compounds and concave polygons in motion.

use moreau::scene::{AnyWorld, Scene};
use moreau::space::Plane;
use moreau::step::{StepRecord, Workspace, step};
use moreau::world::World;
use std::fmt::Write;

type Flat = World<Plane, 2, 3>;

/// A scene of the plane under gravity with these bodies; friction 0.5, solved to rounding.
fn world(bodies: &str) -> Flat {
    let head = r#"
        dimension = 2
        gravity = [0.0, -9.81]
        time = { step = 1e-3, steps = 1000 }
        solver = { criterion = "scaled", tolerance = 1e-13, max_sweeps = 100000 }
        materials.stone.density = 1000.0
        default_law.coulomb.friction = 0.5
    "#;
    let scene = Scene::parse(&format!("{head}{bodies}"), "scene.toml").unwrap_or_else(|error| panic!("{error}"));
    match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("the scene is plane"),
    }
}

/// Runs, each step converged, and gives the last step's record.
fn run(world: &mut Flat, steps: u64, mut see: impl FnMut(&Flat)) -> StepRecord {
    let mut work = Workspace::default();
    let mut last = None;
    for _ in 0..steps {
        let record = step(world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged(), "step {}: {:?}", record.step, record.residual);
        see(world);
        last = Some(record);
    }
    last.expect("at least one step")
}

/// Position and rotation of the last body after each step.
fn path(bodies: &str, steps: u64) -> Vec<[f64; 4]> {
    let mut path = Vec::new();
    run(&mut world(bodies), steps, |world| {
        let pose = world.bodies.pose.last().expect("a body");
        path.push([pose.position[0], pose.position[1], pose.rotation[0], pose.rotation[1]]);
    });
    path
}

fn farthest(a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().flatten().zip(b.iter().flatten()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

const FLOOR: &str = r#"
    [[bodies]]
    shape.half_plane.normal = [0.0, 1.0]
    material = "stone"
    position = [0.0, 0.0]
"#;

/// The same ground as a chain of a hundred segments of uneven lengths, 10 m.
fn chain() -> String {
    let mut points = String::new();
    for k in 0..=100 {
        let x = 0.1 * f64::from(k) - 1.0 + if k % 3 == 1 { 0.033 } else { 0.0 };
        // Writing to a string cannot fail.
        let _ = write!(points, "[{x:?}, 0.0], ");
    }
    format!("[[bodies]]\nshape.polyline.points = [{points}]\nmaterial = \"stone\"\nposition = [0.0, 0.0]\n")
}

#[test]
fn what_slides_or_rolls_over_a_chain_of_segments_moves_as_on_a_half_plane() {
    let body = |shape: &str, y: f64, spin: f64| {
        format!(
            "[[bodies]]\nshape.{shape}\nmaterial = \"stone\"\nposition = [0.0, {y}]\nvelocity = [6.0, 0.0]\nspin = {spin:?}\n"
        )
    };
    for body in [
        body("box.size = [0.4, 0.2]", 0.1, 0.0),
        body("capsule = { radius = 0.1, length = 0.5 }", 0.1, 0.0),
        body("disk.radius = 0.2", 0.2, -10.0),
        // Thrown, so that it tumbles.
        body("box.size = [0.4, 0.2]", 0.5, -9.0),
    ] {
        let (flat, segments) = (path(&format!("{FLOOR}{body}"), 1200), path(&format!("{}{body}", chain()), 1200));
        assert!(flat[1199][0] > 2.0, "it must go some way");
        let difference = farthest(&flat, &segments);
        assert!(difference < 1e-9, "{body} differs by {difference:e}");
    }
}

/// Whether the last body stays within a nanometre for a second, and on how many points it stands.
fn stands_on(bodies: &str) -> usize {
    let mut world = world(bodies);
    let body = world.bodies.len() - 1;
    let start = world.bodies.pose[body];
    let record = run(&mut world, 1000, |world| {
        let pose = world.bodies.pose[body];
        let moved = (0..2).map(|k| (pose.position[k] - start.position[k]).abs() + (pose.rotation[k] - start.rotation[k]).abs());
        assert!(moved.sum::<f64>() < 1e-9, "it moved from {start:?} to {pose:?}");
    });
    record.active
}

#[test]
fn a_dumb_bell_rests_on_two_points() {
    let bell = r#"
        [[bodies]]
        shape.compound.parts = [
            { shape.disk.radius = 0.2, position = [0.0, 0.2] },
            { shape.disk.radius = 0.1, position = [1.0, 0.1] },
        ]
        material = "stone"
        position = [0.3, 0.0]
    "#;
    assert_eq!(stands_on(&format!("{FLOOR}{bell}")), 2);
    assert_eq!(stands_on(&format!("{}{bell}", chain())), 2);
}

#[test]
fn a_compound_l_lies_still_and_a_capsule_lies_on_a_chain() {
    let l = r#"
        [[bodies]]
        shape.compound.parts = [
            { shape.box.size = [0.3, 0.1], position = [0.15, 0.05] },
            { shape.box.size = [0.1, 0.1], position = [0.05, 0.15] },
        ]
        material = "stone"
        position = [0.0, 0.0]
    "#;
    assert_eq!(stands_on(&format!("{FLOOR}{l}")), 2);
    assert_eq!(stands_on(&format!("{}{l}", chain())), 2);
    let capsule = r#"
        [[bodies]]
        shape.capsule = { radius = 0.1, length = 0.33 }
        material = "stone"
        position = [0.5, 0.1]
    "#;
    assert_eq!(stands_on(&format!("{}{capsule}", chain())), 2);
}

#[test]
fn a_capsule_in_a_valley_bears_on_both_flanks_as_statics_says() {
    // Flanks of 45°, its axis horizontal and shorter than the valley is wide: each end bears one flank. By symmetry the normal forces n and
    // the friction f, up along the flank, fulfil √2 (n + f) = m g; without friction n = m g / √2.
    let mut world = world(
        r#"
        [[bodies]]
        shape.polyline.points = [[-3.0, 3.0], [-1.0, 1.0], [0.0, 0.0], [2.0, 2.0], [3.0, 3.0]]
        material = "stone"
        position = [0.0, 0.0]
        [[bodies]]
        shape.capsule = { radius = 0.1, length = 0.4 }
        material = "stone"
        position = [0.0, 0.3414213562373095]
    "#,
    );
    let mut work = Workspace::default();
    for _ in 0..500 {
        assert!(step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}")).converged());
    }
    let weight = world.bodies.mass[1][0] * 9.81 * world.settings.h;
    let contacts = work.contacts();
    assert_eq!(contacts.len(), 2);
    for contact in contacts {
        let [normal, tangent] = contact.impulse;
        let upwards = std::f64::consts::FRAC_1_SQRT_2 * (normal + tangent.abs());
        assert!((upwards - 0.5 * weight).abs() < 1e-9 * weight, "{:?} under {weight}", contact.impulse);
    }
    assert!(world.bodies.velocity[1].iter().all(|v| v.abs() < 1e-12), "{:?}", world.bodies.velocity[1]);
}

#[test]
fn an_l_by_its_outline_moves_as_the_l_of_two_boxes() {
    let thrown = "material = \"stone\"\nposition = [0.0, 0.6]\nvelocity = [1.0, 0.0]\nspin = -6.0\norientation = 0.4\n";
    let polygon = format!(
        "[[bodies]]\nshape.polygon = {{ vertices = [[0, 0], [0.3, 0], [0.3, 0.1], [0.1, 0.1], [0.1, 0.2], [0, 0.2]], decompose = true }}\n{thrown}"
    );
    let boxes = format!(
        "[[bodies]]\nshape.compound.parts = [{{ shape.box.size = [0.3, 0.1], position = [0.15, 0.05] }}, {{ shape.box.size = [0.1, 0.1], position = [0.05, 0.15] }}]\n{thrown}"
    );
    let (one, other) = (path(&format!("{FLOOR}{polygon}"), 1000), path(&format!("{FLOOR}{boxes}"), 1000));
    // What the pieces share bears twice, which moves nothing; the two mass matrices differ by rounding, and impacts amplify it.
    let difference = farthest(&one, &other);
    assert!(difference < 1e-9, "they differ by {difference:e}");
    let last = one[999];
    assert!((last[1] - one[998][1]).abs() < 1e-9 && last[0] > 0.05, "it came to rest on the ground: {last:?}");
}
