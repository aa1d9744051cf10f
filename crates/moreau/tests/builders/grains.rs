//! Drums, hoppers and ballast.

use super::{close, contacts, plane, scene, solid, text};
use moreau::scene::{AnyWorld, Scene};
use moreau::shape::PlaneShape;
use moreau::space::{Solid, Space};
use std::f64::consts::PI;

#[test]
fn a_drum_turns_about_its_axis_and_weighs_what_its_plates_do() {
    let scene = Scene::parse(
        &text(3, "drum = { radius = 1.0, length = 2.0, thickness = 0.1, sides = 20, closed = true, spin = 3 }")
            .replace("name = \"it\"", "name = \"it\"\norientation = { axis = [0, 0, 1], degrees = 90 }")
            .replacen("position = [0, 0, 0]", "position = [0, 0, -5]", 1),
        "drum.toml",
    )
    .unwrap();
    let AnyWorld::Solid(world) = scene.build(u64::MAX).unwrap() else { panic!("of space") };
    let polygon = |radius: f64| 0.5 * 20.0 * radius * radius * (2.0 * PI / 20.0).sin();
    let mass = 1000.0 * (2.0 * (polygon(1.1) - polygon(1.0)) + 2.0 * 0.1 * polygon(1.1));
    assert_eq!((world.bodies.len(), world.bodies.is_free(1)), (2, false));
    close(world.bodies.mass[1][0], mass, 1e-9);
    // Against y before the turn, so along x after it.
    let spin = Solid::spin_in_world(world.bodies.pose[1].rotation, &world.bodies.velocity[1]);
    assert!((spin[0] - 3.0).abs() < 1e-9 && spin[1].abs() < 1e-9 && spin[2].abs() < 1e-9, "{spin:?}");
    let flat = plane("drum = { radius = 1.0, thickness = 0.1, sides = 20, spin = 3 }");
    close(flat.bodies.mass[1][0], 1000.0 * (polygon(1.1) - polygon(1.0)), 1e-12);
    assert_eq!(flat.bodies.velocity[1], [0.0, 0.0, 3.0]);
    assert!(flat.bodies.pose[1].position.iter().all(|x| x.abs() < 1e-15));
}

#[test]
fn a_hopper_keeps_its_opening_and_its_plates_their_thickness() {
    // Run 0.3, rise 0.4, slope 0.5: what is 0.05 across is 0.05 · 0.5 / 0.4 along the horizontal.
    let spec = "hopper = { opening = 0.4, top = 1.0, height = 0.4, thickness = 0.05 }";
    let (flat, deep) = (plane(spec), solid(spec));
    assert_eq!((flat.bodies.len(), deep.bodies.len()), (3, 5));
    let wide = 0.05 / 0.8;
    close(flat.bodies.mass[1][0] / 1000.0, wide * 0.4, 1e-12);
    // Four plates together: the difference of two frustums of pyramids, h (a² + a b + b²) / 3.
    let frustum = |a: f64, b: f64| 0.4 * (a * a + a * b + b * b) / 3.0;
    let sum: f64 = deep.bodies.mass[1..].iter().map(|mass| mass[0] / 1000.0).sum();
    close(sum, frustum(0.4 + 2.0 * wide, 1.0 + 2.0 * wide) - frustum(0.4, 1.0), 1e-12);
    let angle = solid(&format!(
        "hopper = {{ opening = 0.4, top = 1.0, degrees = {}, thickness = 0.05 }}",
        (4.0_f64 / 3.0).atan().to_degrees()
    ));
    close(angle.bodies.mass[1][0], deep.bodies.mass[1][0], 1e-12);
}

#[test]
fn ballast_does_not_touch() {
    for (dimension, axes) in [(2, ""), (3, ", flatness = 0.5")] {
        let corner = |x: f64| format!("{:?}", vec![x; dimension]);
        let spec = format!(
            "ballast = {{ count = 60, radii.uniform = {{ min = 0.5, max = 1.0 }}, elongation = 0.8{axes}, seed = 5, \
             packing = {{ min = {}, max = {} }} }}",
            corner(1.0),
            corner(if dimension == 2 { 40.0 } else { 16.0 })
        );
        match scene(dimension, &spec).build(u64::MAX).unwrap() {
            AnyWorld::Plane(world) => assert!(contacts(&world).is_empty() && world.bodies.len() == 61),
            AnyWorld::Solid(world) => assert!(contacts(&world).is_empty() && world.bodies.len() == 61),
        }
    }
}

/// Seen from every side, a stone of the plane is once as wide as its sieve and, across that, as long as its elongation says.
#[test]
fn a_stone_is_as_wide_as_its_sieve_and_as_long_as_its_elongation_says() {
    let world = plane(
        "ballast = { count = 20, radii.constant = 1.0, corners = 9, elongation = 0.8, seed = 2, \
         lattice = { min = [0, 0], max = [20, 20] } }",
    );
    for shape in &world.bodies.shape[1..] {
        let PlaneShape::Polygon(stone) = shape else { panic!("a stone that is no polygon") };
        assert_eq!(stone.vertices().len(), 9);
        let width = |[x, y]: [f64; 2]| {
            let along = |p: [f64; 2]| x * p[0] + y * p[1];
            let (low, high) = (stone.vertices().map(along), stone.vertices().map(along));
            high.fold(f64::NEG_INFINITY, f64::max) - low.fold(f64::INFINITY, f64::min)
        };
        // A ten-thousandth of a half turn moves a corner by less than 4e-4 m.
        let off = |k: u32| {
            let (sine, cosine) = (PI * f64::from(k) / 1e4).sin_cos();
            (width([cosine, sine]) - 2.5).abs().max((width([-sine, cosine]) - 2.0).abs())
        };
        let least = (0..10_000).map(off).fold(f64::INFINITY, f64::min);
        assert!(least < 1e-3, "{least}");
    }
}

/// Stones of 2.5 × 2 × 1 m fill about as much as their ellipsoid, neither splinters nor boxes, and their long axes point every way alike.
#[test]
fn ballast_is_of_many_forms_and_turned_every_way() {
    let spec = "ballast = { count = 4000, radii.constant = 1.0, corners = 16, elongation = 0.8, flatness = 0.5, \
                lattice = { min = [0, 0, 0], max = [70, 70, 70] } }";
    let world = solid(spec);
    let ellipsoid = 1000.0 * 4.0 / 3.0 * PI * 1.25 * 0.5;
    let mut axes = [0.0; 3];
    for i in 1..world.bodies.len() {
        let mass = world.bodies.mass[i][0];
        assert!(mass < 1.2 * ellipsoid && mass > 0.3 * ellipsoid, "{mass} of {ellipsoid}");
        // The principal axis of least inertia, the long one.
        let [_, _, _, a, b, c] = world.bodies.mass[i];
        let least = if a < b && a < c {
            [1.0, 0.0, 0.0]
        } else if b < c {
            [0.0, 1.0, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        };
        let long = Solid::rotate(world.bodies.pose[i].rotation, least);
        (0..3).for_each(|k| axes[k] += long[k] * long[k] / 4000.0);
    }
    // The squares of a random direction's components are 1/3 on average, with a deviation of 0.3 / √4000.
    assert!(axes.iter().all(|mean| (mean - 1.0 / 3.0).abs() < 0.02), "{axes:?}");
}

#[test]
fn the_same_seed_gives_the_same_bodies() {
    for (dimension, kind) in [
        (
            3,
            "ballast = { count = 50, radii.uniform = { min = 0.5, max = 1.0 }, packing = { min = [1, 1, 1], max = [20, 20, 20] }",
        ),
        (2, "ballast = { count = 50, radii.uniform = { min = 0.5, max = 1.0 }, packing = { min = [1, 1], max = [50, 50] }"),
        (2, "dry_stone = { size = [0.5, 0.2], layers = 5, stones = 6"),
    ] {
        let bodies = |seed: &str| match scene(dimension, &format!("{kind}, seed = {seed} }}")).build(u64::MAX).unwrap() {
            AnyWorld::Plane(world) => format!("{:?}{:?}", world.bodies.pose, world.bodies.shape),
            AnyWorld::Solid(world) => format!("{:?}{:?}", world.bodies.pose, world.bodies.shape),
        };
        assert!(bodies("7") == bodies("7") && bodies("7") != bodies("8"), "{kind}");
    }
}
