//! Bodies that land on a ground of two adjoining pieces slide across the joint without friction and without a rebound: they keep their speed and their height.

use moreau::scene::{AnyWorld, Scene};
use moreau::space::Solid;
use moreau::step::{Workspace, step};
use moreau::world::World;

/// Six bodies at 2 m/s, 15 cm or less above the ground.
fn build(ground: &str, acts: &str, [h, tolerance]: [f64; 2]) -> World<Solid, 3, 6> {
    let lying = "orientation = { axis = [0.0, 1.0, 0.0], degrees = 90.0 }";
    let across = "orientation = { axis = [1.0, 0.0, 0.0], degrees = 90.0 }";
    let yaw = "orientation = { axis = [0.0, 0.0, 1.0], degrees = 30.0 }";
    let sliders = [
        ("ball = { radius = 0.1 }", ""),
        ("capsule = { radius = 0.1, length = 0.3 }", lying),
        ("capsule = { radius = 0.1, length = 0.3 }", across),
        ("box = { size = [0.2, 0.2, 0.2] }", ""),
        ("box = { size = [0.2, 0.2, 0.2] }", yaw),
        ("cylinder = { radius = 0.1, length = 0.2 }", ""),
    ];
    let mut text = format!(
        "dimension = 3\ngravity = [0.0, 0.0, -9.81]\ntime = {{ step = {h:?}, steps = 1500 }}\n\
         solver = {{ start = \"warm\", criterion = \"scaled\", tolerance = {tolerance:?} }}\nmaterials.m.density = 1000.0\n\
         default_law.coulomb = {{ friction = 0.0, acts = \"{acts}\" }}\n{ground}"
    );
    for (i, (shape, more)) in sliders.into_iter().enumerate() {
        text += &format!(
            "[[bodies]]\nshape.{shape}\nmaterial = \"m\"\nposition = [-1.5, {:?}, 0.25]\nvelocity = [2.0, 0.0, 0.0]\n{more}\n",
            0.8 * i as f64 - 2.0
        );
    }
    match Scene::parse(&text, "seams.toml").unwrap_or_else(|error| panic!("{error}")).build(u64::MAX).unwrap() {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("the scene is in space"),
    }
}

/// Runs a scene over the joint and checks each free body.
fn slides(ground: &[String; 2], order: [usize; 2], acts: &str, tolerance: f64) {
    let both = format!("{}{}", ground[order[0]], ground[order[1]]);
    let (mut world, mut work) = (build(&both, acts, [1e-3, tolerance]), Workspace::default());
    let mut heights = Vec::new();
    for i in 0..1500 {
        let record = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged(), "step {}: {:?}", record.step, record.residual);
        // All have landed, none has reached the joint.
        if i == 500 {
            heights = world.bodies.pose.iter().map(|pose| pose.position[2]).collect();
        }
    }
    for i in world.bodies.len() - 6..world.bodies.len() {
        let (position, v) = (&world.bodies.pose[i].position, &world.bodies.velocity[i]);
        assert!(position[0] > 0.5, "body {i} stays at {position:?}");
        assert!((v[0] - 2.0).abs() < 1e-6, "body {i} goes on at {} m/s, {acts}, {order:?}", v[0]);
        assert!((position[2] - heights[i]).abs() < 1e-6, "body {i} goes from {} m to {} m", heights[i], position[2]);
    }
}

fn both_orders_and_laws(ground: &[String; 2], tolerance: f64) {
    for acts in ["closed", "approach"] {
        slides(ground, [0, 1], acts, tolerance);
        slides(ground, [1, 0], acts, tolerance);
    }
}

#[test]
fn bodies_slide_from_box_to_box() {
    both_orders_and_laws(&[-2.0, 2.0].map(|x| {
        format!("[[bodies]]\nmotion = \"fixed\"\nshape.box = {{ size = [4, 8.0, 1.0] }}\nmaterial = \"m\"\nposition = [{x:?}, 0.0, -0.5]\n")
    }), 1e-9);
}

#[test]
fn bodies_slide_from_height_field_to_height_field() {
    let row = "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]";
    let heights = [row; 9].join(", ");
    both_orders_and_laws(&[-4.0, 0.0].map(|x| {
        format!(
            "[[bodies]]\nshape.height_field = {{ spacing = [0.5, 1.0], heights = [{heights}] }}\nmaterial = \"m\"\nposition = [{x:?}, -4.0, 0.0]\n"
        )
    }), 1e-9);
}

/// Each box hides three cylinders that end level with its surface. A capsule that slides along its axis touches a cylinder in the middle while its
/// round end meets the far side of it.
#[test]
fn bodies_slide_over_hidden_cylinders() {
    let cylinder = |x: f64| {
        format!(
            "[[bodies]]\nmotion = \"fixed\"\nshape.cylinder = {{ radius = 0.2, length = 8.0 }}\nmaterial = \"m\"\n\
             position = [{x:?}, 0.0, -0.2]\norientation = {{ axis = [1.0, 0.0, 0.0], degrees = 90.0 }}\n"
        )
    };
    let piece = |side: f64| {
        let x = 2.0 * side;
        format!(
            "[[bodies]]\nmotion = \"fixed\"\nshape.box = {{ size = [4, 8.0, 0.5] }}\nmaterial = \"m\"\nposition = [{x:?}, 0.0, -0.25]\n"
        ) + &[0.3, 0.6, 0.9].map(|x| cylinder(x * side)).concat()
    };
    // At 1e-9 a step in which a box lies on three pieces at once reaches the limit of sweeps.
    both_orders_and_laws(&[-1.0, 1.0].map(piece), 1e-8);
}

/// A wall that stands on the ground is no seam: its side is touched from outside.
#[test]
fn a_wall_stops_what_slides() {
    let slab =
        "[[bodies]]\nmotion = \"fixed\"\nshape.box = { size = [8, 8.0, 1.0] }\nmaterial = \"m\"\nposition = [0.0, 0.0, -0.5]\n";
    let wall =
        "[[bodies]]\nmotion = \"fixed\"\nshape.box = { size = [0.2, 8.0, 1.0] }\nmaterial = \"m\"\nposition = [0.6, 0.0, 0.5]\n";
    let (mut world, mut work) = (build(&format!("{slab}{wall}"), "approach", [1e-3, 1e-9]), Workspace::default());
    (0..1500).for_each(|_| assert!(step(&mut world, &mut work).is_ok()));
    for i in 2..world.bodies.len() {
        assert!(world.bodies.pose[i].position[0] < 0.5 - 0.09, "body {i} is at {:?}", world.bodies.pose[i].position);
    }
}

/// With the default tolerance bodies sink in by a few nanometres, tilt by 1e-5 and stay on all points of their faces: over ten seams, in steps of 10 ms, speeds
/// stay within 1 mm/s.
#[test]
fn a_coarse_solve_loses_no_point_of_a_face_at_a_seam() {
    let piece = |i: i32| {
        let x = -2.5 + 0.6 * f64::from(i);
        format!(
            "[[bodies]]\nmotion = \"fixed\"\nshape.box = {{ size = [0.6, 8.0, 1.0] }}\nmaterial = \"m\"\nposition = [{x:?}, 0.0, -0.5]\n"
        )
    };
    let ground: String = (0..16).map(piece).collect();
    let (mut world, mut work) = (build(&ground, "approach", [1e-2, 1e-4]), Workspace::default());
    for i in 0..330 {
        step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        for (body, v) in world.bodies.velocity.iter().enumerate().skip(16).filter(|_| i > 30) {
            let off = [v[0] - 2.0, v[1], v[2]].into_iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            assert!(off < 1e-3, "body {body} goes at {v:?} in step {i}");
        }
    }
}
