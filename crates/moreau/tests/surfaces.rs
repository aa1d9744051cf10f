//! Meshes and height fields in scenes: what moves on them moves as on a plane, and what is wrong with them is said.

use moreau::scene::{AnyWorld, Scene};
use moreau::shape::SolidShape;
use moreau::space::Solid;
use moreau::step::{Workspace, step};
use moreau::world::World;

type Space = World<Solid, 3, 6>;

fn world(text: &str) -> Space {
    let scene = Scene::parse(text, "test.toml").unwrap_or_else(|error| panic!("{error}"));
    match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("of the plane"),
    }
}

const HEAD: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 1e-3, steps = 1000 }
solver = { criterion = "scaled", tolerance = 1e-13 }
materials.stone.density = 1000.0
"#;

/// A body `[[bodies]]` of stone.
fn body(shape: &str, position: [f64; 3], more: &str) -> String {
    format!("[[bodies]]\nshape.{shape}\nmaterial = \"stone\"\nposition = {position:?}\n{more}\n")
}

/// A level height field of `cells` by `cells`, and the corner at which it begins to have its middle at the origin.
fn level(cells: usize, spacing: f64) -> (String, [f64; 3]) {
    let row = vec!["0.0"; cells + 1].join(", ");
    let rows = vec![format!("[{row}]"); cells + 1].join(", ");
    let low = -0.5 * spacing * cells as f64;
    (format!("height_field = {{ spacing = [{spacing}, {spacing}], heights = [{rows}] }}"), [low, low, 0.0])
}

fn steps(world: &mut Space, count: usize, mut see: impl FnMut(&Space, usize)) {
    let mut work = Workspace::default();
    for _ in 0..count {
        let record = step(world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged(), "{record:?}");
        see(world, record.contacts as usize);
    }
}

/// Runs a body on a half-space and on a level height field: the same at each step.
///
/// The contacts are the same points, so only the solver's tolerance of 1e-13 of a velocity and rounding can differ: far below 1e-9 in a
/// thousand steps.
fn same_as_on_a_plane(law: &str, bodies: &str) {
    let (field, corner) = level(24, 0.13);
    let head = format!("{HEAD}default_law.{law}\n");
    let plane = body("half_space = { normal = [0.0, 0.0, 1.0] }", [0.0; 3], "");
    let mut plane = world(&format!("{head}{plane}{bodies}"));
    let mut mesh = world(&format!("{head}{}{bodies}", body(&field, corner, "")));
    let mut path = Vec::new();
    steps(&mut plane, 800, |world, _| path.push((world.bodies.pose[1], world.bodies.velocity[1])));
    let mut at = 0;
    steps(&mut mesh, 800, |world, _| {
        let (pose, velocity) = path[at];
        let (found, speed) = (world.bodies.pose[1], world.bodies.velocity[1]);
        for k in 0..3 {
            assert!((found.position[k] - pose.position[k]).abs() < 1e-9, "step {at}: {found:?} is not {pose:?}");
        }
        let turned = found.rotation - pose.rotation;
        assert!(turned.length() < 1e-9, "step {at}: {found:?} is not {pose:?}");
        assert!((0..6).all(|k| (speed[k] - velocity[k]).abs() < 1e-9), "step {at}: {speed:?} is not {velocity:?}");
        at += 1;
    });
    let far = path[799].0.position[0] - path[0].0.position[0];
    assert!(far > 0.3, "{far} m is not far enough to cross triangles");
}

#[test]
fn a_ball_slides_and_rolls_on_a_mesh_as_on_a_plane() {
    let bodies = body("ball = { radius = 0.1 }", [-1.0, -0.3, 0.1], "velocity = [1.5, 0.4, 0.0]\nspin = [3.0, -20.0, 2.0]");
    same_as_on_a_plane("coulomb = { friction = 0.2 }", &bodies);
}

#[test]
fn a_ball_bounces_on_a_mesh_as_on_a_plane() {
    let bodies = body("ball = { radius = 0.1 }", [-1.0, -0.3, 0.3], "velocity = [1.5, 0.4, 0.0]\nspin = [3.0, -20.0, 2.0]");
    same_as_on_a_plane("coulomb = { friction = 0.2, restitution = 0.7 }", &bodies);
}

#[test]
fn a_box_slides_on_a_mesh_as_on_a_plane() {
    for degrees in ["0.0", "27.0"] {
        let more = format!("velocity = [1.5, 0.4, 0.0]\norientation = {{ axis = [0.0, 0.0, 1.0], degrees = {degrees} }}");
        let bodies = body("box = { size = [0.4, 0.3, 0.2] }", [-1.0, -0.3, 0.1], &more);
        same_as_on_a_plane("coulomb = { friction = 0.2 }", &bodies);
    }
}

#[test]
fn what_rolls_slides_or_stands_on_a_plane_does_so_on_a_mesh() {
    let across = "orientation = { axis = [1.0, 0.0, 0.0], degrees = 90 }\nvelocity = [1.2, 0.0, 0.0]\nspin = [0.0, 12.0, 0.0]";
    let upright = "velocity = [1.5, 0.4, 0.0]\norientation = { axis = [0.0, 0.0, 1.0], degrees = 11 }";
    let wedge = "polyhedron.points = [[-0.2, -0.1, -0.1], [0.2, -0.1, -0.1], [0.2, 0.1, -0.1], [-0.2, 0.1, -0.1], [-0.05, 0, 0.1], [0.05, 0, 0.1]]";
    for (shape, height, more) in [
        ("capsule = { radius = 0.1, length = 0.31 }", 0.1, across),
        ("cylinder = { radius = 0.1, length = 0.31 }", 0.1, across),
        ("cylinder = { radius = 0.17, length = 0.2 }", 0.1, upright),
        (wedge, 0.1, upright),
    ] {
        same_as_on_a_plane("coulomb = { friction = 0.2 }", &body(shape, [-1.0, -0.3, height], more));
    }
}

/// Without friction, because with it the moment of four contacts about the vertical depends on how they share the weight.
#[test]
fn a_box_glides_and_spins_on_a_mesh_as_on_a_plane() {
    let more = "velocity = [1.0, 0.2, 0.0]\nspin = [0.0, 0.0, 4.0]";
    same_as_on_a_plane("frictionless = {}", &body("box = { size = [0.4, 0.3, 0.2] }", [-1.0, -0.3, 0.1], more));
}

#[test]
fn a_box_at_rest_on_a_mesh_stays_where_it_is() {
    let (field, corner) = level(20, 0.07);
    let ground = body(&field, corner, "");
    for (size, place) in [(0.41, [0.013, 0.027, 0.205]), (0.28, [0.0, 0.0, 0.14]), (0.02, [0.031, 0.0, 0.01])] {
        let block = body(&format!("box = {{ size = [{size}, {size}, {size}] }}"), place, "");
        let mut world = world(&format!("{HEAD}default_law.coulomb = {{ friction = 0.5 }}\n{ground}{block}"));
        let start = world.bodies.pose[1];
        steps(&mut world, 2000, |_, contacts| assert_eq!(contacts, 4));
        let end = world.bodies.pose[1];
        // What the solver leaves is rounding, as on a half-space.
        assert!((0..3).all(|k| (end.position[k] - start.position[k]).abs() < 1e-13), "{end:?}");
        assert!((end.rotation - start.rotation).length() < 1e-13, "{end:?}");
    }
}

/// Two planes that fall off by 1:4 on both sides of the y axis, as an inline mesh, driven at velocity zero.
const RIDGE: &str = "mesh = { points = [[-4, -1, -1], [0, -1, 0], [4, -1, -1], [-4, 1, -1], [0, 1, 0], [4, 1, -1]], \
                     triangles = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]] }";

/// The centre keeps to the slope, to an arc around the ridge, and to the other slope; energy says how fast.
#[test]
fn a_ball_goes_over_a_ridge_on_an_arc() {
    let (radius, slope) = (0.5, 0.25_f64);
    let normal = [1.0, slope].map(|x| x / (1.0 + slope * slope).sqrt()); // cos, sin
    // At a distance of 1.5 from the ridge, on its lower side; the speed leaves 0.4 m/s² · 1 m for the top.
    let (x, z) = (-1.5 * normal[0] - radius * normal[1], -1.5 * normal[1] + radius * normal[0]);
    let rise = radius - z;
    let speed = (2.0 * 10.0 * rise + 0.25_f64).sqrt();
    let velocity = format!("velocity = [{}, 0.0, {}]", speed * normal[0], speed * normal[1]);
    let bodies =
        body(RIDGE, [0.0; 3], "motion = \"driven\"") + &body(&format!("ball = {{ radius = {radius} }}"), [x, 0.1, z], &velocity);
    let mut world = world(&format!("{HEAD}default_law.frictionless = {{}}\n{bodies}"));
    let (mut on_arc, mut passed) = (0, false);
    steps(&mut world, 2200, |world, contacts| {
        let ([x, _, z], v) = (world.bodies.pose[1].position, world.bodies.velocity[1]);
        // Along the ridge where the ball is above it, else to the slope.
        let over = x.abs() <= radius * normal[1];
        let distance = if over { x.hypot(z) } else { normal[0] * z + normal[1] * x.abs() };
        // It leaves the arc's chord by h² v²/2r in a step.
        assert!((distance - radius).abs() < 1e-4, "{distance} at {x}, {z}");
        assert!(contacts <= 1, "{contacts} at {x}, {z}");
        on_arc += usize::from(over);
        let right = speed * speed - 20.0 * (z - (radius - rise));
        // Each step on the arc turns the velocity by h v/r and loses that part's square, of which there are hundreds.
        assert!((v[0] * v[0] + v[2] * v[2] - right).abs() < 5e-3, "{v:?}, {right}");
        passed |= x > 0.5;
    });
    assert!(on_arc > 100 && passed, "{on_arc} steps on the arc");
}

#[test]
fn a_ball_rests_in_a_valley() {
    let valley = RIDGE.replace("-4, -1, -1", "-4, -1, 1").replace("4, -1, -1", "4, -1, 1").replace("1, -1]", "1, 1]");
    let up = 0.5 * (1.0 + 0.0625_f64).sqrt();
    let ball = body("ball = { radius = 0.5 }", [0.0, 0.1, up], "");
    let mut world = world(&format!("{HEAD}default_law.coulomb = {{ friction = 0.3 }}\n{}{ball}", body(&valley, [0.0; 3], "")));
    steps(&mut world, 500, |_, contacts| assert_eq!(contacts, 2));
    let [x, y, z] = world.bodies.pose[1].position;
    assert!(x.abs() < 1e-12 && (y - 0.1).abs() < 1e-12 && (z - up).abs() < 1e-12);
}

/// A look at all triangles for each body would take half a minute.
#[test]
fn a_hundred_thousand_triangles_do_not_hold_up_the_steps() {
    let count = 225_usize;
    let height = |i: usize, j: usize| 0.3 * (0.31 * i as f64).sin() * (0.23 * j as f64).cos();
    let row = |j: usize| (0..count).map(|i| format!("{:.6}", height(i, j))).collect::<Vec<_>>().join(", ");
    let rows = (0..count).map(|j| format!("[{}]", row(j))).collect::<Vec<_>>().join(", ");
    let ground = body(&format!("height_field = {{ spacing = [0.1, 0.1], heights = [{rows}] }}"), [0.0; 3], "");
    let balls = "[[generate]]\nmaterial = \"stone\"\nradii.constant = 0.12\n\
                 lattice = { kind = \"cubic\", min = [1.0, 1.0, 0.5], max = [21.0, 21.0, 1.2], spacing = 0.6 }\n";
    let mut world = world(&format!("{HEAD}default_law.coulomb = {{ friction = 0.3 }}\n{ground}{balls}").replace("1e-13", "1e-8"));
    let SolidShape::Surface(surface) = &world.bodies.shape[0] else { panic!("a height field is a surface") };
    assert!(world.bodies.len() > 1000 && surface.mesh().triangles.len() > 100_000);
    let mut most = 0;
    steps(&mut world, 400, |_, contacts| most = most.max(contacts));
    assert!(most > 500, "{most} contacts");
}

/// In mm, beside the scene.
#[test]
fn files_lie_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v -1000 -1000 0\nv 1000 -1000 0\nv 1000 1000 0\nv -1000 1000 0\nf 1 2 3 4\n";
    std::fs::write(folder.path().join("plate.obj"), obj).unwrap();
    std::fs::write(folder.path().join("hills.csv"), "0, 0, 0\n0, 0.5, 0\n0, 0, 0\n").unwrap();
    let plate = body("mesh = { file = \"plate.obj\", scale = 0.001 }", [0.0; 3], "");
    let hills = body("height_field = { file = \"hills.csv\", spacing = [1.0, 2.0], origin = [10.0, 0.0, 0.0] }", [0.0; 3], "");
    let ball = body("ball = { radius = 0.1 }", [0.3, 0.2, 0.1], "");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, format!("{HEAD}{plate}{hills}{ball}")).unwrap();
    let AnyWorld::Solid(mut world) = Scene::load(&path).unwrap().build(u64::MAX).unwrap() else { panic!("of the plane") };
    steps(&mut world, 10, |world, contacts| assert!(contacts == 1 && world.bodies.pose[2].position == [0.3, 0.2, 0.1]));
    std::fs::write(folder.path().join("plate.off"), obj).unwrap();
    std::fs::write(&path, format!("{HEAD}{}{hills}{ball}", plate.replace(".obj", ".off"))).unwrap();
    let error = Scene::load(&path).unwrap_err().to_string();
    assert!(error.contains("expected a name that ends in .stl, .obj, .ply, .gltf or .glb"), "{error}");
    std::fs::write(&path, format!("{HEAD}{plate}{hills}{ball}")).unwrap();
    std::fs::write(folder.path().join("plate.obj"), obj.replace("f 1 2 3 4", "f 1 2 3 5")).unwrap();
    let error = Scene::load(&path).unwrap_err().to_string();
    assert!(error.contains("bodies[0].shape.mesh.file") && error.contains("plate.obj:5: a corner `5`"), "{error}");
}

#[test]
fn what_is_wrong_with_a_surface_is_said() {
    let error = |shape: &str, more: &str| {
        let text = format!("{HEAD}{}{}", body(shape, [0.0; 3], more), body("ball = { radius = 0.1 }", [0.0, 0.0, 9.0], ""));
        let scene = Scene::parse(&text, "test.toml").and_then(|scene| scene.build(u64::MAX).map(drop));
        scene.map_or_else(|error| error.to_string(), |()| String::new())
    };
    let square = "points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]";
    for (shape, more, words) in [
        (format!("mesh = {{ {square}, triangles = [[0, 1, 2]] }}"), "motion = \"free\"", "a mesh that is free: it has no mass"),
        (format!("mesh = {{ {square}, triangles = [[0, 1, 4]] }}"), "", "triangles[0][2]: there is no point 4"),
        (format!("mesh = {{ {square}, triangles = [[0, 1]] }}"), "", "expected an array of length 3"),
        (format!("mesh = {{ {square}, triangles = [[0, 1, 1]] }}"), "", "triangle 0 has no area"),
        (
            format!("mesh = {{ {square}, triangles = [[0, 1, 2], [0, 2, 3], [0, 1, 3]] }}"),
            "",
            "2 edges lie between triangles that face",
        ),
        (format!("mesh = {{ {square}, triangles = [[0, 1, 2]], file = \"a.stl\" }}"), "", "points and triangles and a file"),
        (format!("mesh = {{ {square}, triangles = [[0, 1, 2]], scale = 0.0 }}"), "", "a scale without a file"),
        ("mesh = {}".into(), "", "no triangles"),
        ("mesh = { file = \"none.stl\" }".into(), "", "cannot read none.stl"),
        ("height_field = { spacing = [1.0, 1.0], heights = [[0, 1], [2]] }".into(), "", "heights[1]: 1 height"),
        ("height_field = { spacing = [1.0, 1.0], heights = [[0, 1]] }".into(), "", "1 row of 2 heights"),
        ("height_field = { spacing = [1.0, -1.0], heights = [[0, 1], [0, 1]] }".into(), "", "spacing[1]: spacing is -1"),
    ] {
        let message = error(&shape, more);
        assert!(message.contains(words), "{shape}: {message}");
    }
    let scene =
        format!("{HEAD}{}", body("mesh = { points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles = [[0, 1, 2]] }", [0.0; 3], ""))
            .replace("dimension = 3", "dimension = 2");
    let error = Scene::parse(&scene.replace("gravity = [0.0, 0.0, -10.0]", ""), "test.toml").unwrap_err().to_string();
    assert!(error.contains("a mesh where dimension = 2"), "{error}");
}
