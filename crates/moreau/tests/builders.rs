//! Builders: what they make is what they say, neighbours share their faces, and what should stand stands.

use glam::DVec3;
use moreau::contacts::Contact;
use moreau::detect::Detector;
use moreau::scene::{AnyWorld, Scene};
use moreau::shape::PlaneShape;
use moreau::space::{Plane, Solid, Space};
use moreau::step::{Workspace, step};
use moreau::world::World;
use std::f64::consts::PI;

/// A scene with a ground and one builder.
fn text(dimension: usize, kind: &str) -> String {
    let (gravity, ground, origin) = match dimension {
        2 => ("[0, -9.81]", "half_plane = { normal = [0, 1] }", "[0, 0]"),
        _ => ("[0, 0, -9.81]", "half_space = { normal = [0, 0, 1] }", "[0, 0, 0]"),
    };
    format!(
        "dimension = {dimension}\ngravity = {gravity}\ntime = {{ step = 1e-3, steps = 10 }}\n\
         solver = {{ start = \"warm\", criterion = \"scaled\", tolerance = 1e-8, max_sweeps = 100000 }}\nmaterials.stone.density = 1000.0\n\
         default_law.coulomb.friction = 0.6\n\
         [[bodies]]\nname = \"ground\"\nshape.{ground}\nmaterial = \"stone\"\nposition = {origin}\n\
         [[build]]\nname = \"it\"\nmaterial = \"stone\"\nposition = {origin}\nkind.{kind}\n"
    )
}

fn scene(dimension: usize, kind: &str) -> Scene {
    Scene::parse(&text(dimension, kind), "build.toml").unwrap_or_else(|error| panic!("{error}"))
}

fn solid(kind: &str) -> World<Solid, 3, 6> {
    match scene(3, kind).build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("of space"),
    }
}

fn plane(kind: &str) -> World<Plane, 2, 3> {
    match scene(2, kind).build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("of the plane"),
    }
}

/// Volume, or area, of all that is built.
fn volume<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> f64 {
    (0..world.bodies.len()).filter(|&i| world.bodies.is_free(i)).map(|i| world.bodies.mass[i][0] / 1000.0).sum()
}

/// Points of contact within a micrometre, of all pairs.
fn contacts<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> Vec<Contact<D>> {
    let bodies = &world.bodies;
    let mut contacts = Vec::new();
    let reach = vec![5e-7; bodies.len()];
    Detector::new().detect::<S, N>(&bodies.shape, &bodies.pose, &reach, |i| !bodies.is_free(i), &mut contacts);
    contacts
}

/// Pairs of bodies that share a face, with the numbers of the builder's bodies; the ground is body 0. Fails where a gap is anything but
/// rounding.
fn faces<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> Vec<(u32, u32)> {
    let contacts = contacts(world);
    for contact in &contacts {
        assert!(contact.gap.abs() < 1e-12, "{} and {}: a gap of {:e}", contact.key.a, contact.key.b, contact.gap);
    }
    let mut pairs: Vec<(u32, u32)> = contacts.iter().map(|contact| (contact.key.a, contact.key.b)).collect();
    pairs.dedup();
    pairs.retain(|&pair| {
        let points: Vec<[f64; D]> = contacts.iter().filter(|c| (c.key.a, c.key.b) == pair).map(|c| c.point).collect();
        size(&points) > 1e-6
    });
    pairs
}

/// The greatest length between some points in the plane, in space the greatest area between three: nothing at a corner or along an edge.
fn size<const D: usize>(points: &[[f64; D]]) -> f64 {
    let way = |p: &[f64; D], q: &[f64; D]| -> [f64; 3] { std::array::from_fn(|k| if k < D { q[k] - p[k] } else { 0.0 }) };
    let mut largest = 0.0_f64;
    for p in points {
        for q in points {
            let u = DVec3::from(way(p, q));
            largest = if D == 2 {
                largest.max(u.length())
            } else {
                points.iter().fold(largest, |most, r| most.max(u.cross(way(p, r).into()).length()))
            };
        }
    }
    largest
}

fn close(found: f64, expected: f64, part: f64) {
    assert!((found / expected - 1.0).abs() < part, "{found} is not {expected}");
}

#[test]
fn stones_of_an_arch_share_their_joints_and_have_the_area_of_a_ring_of_chords() {
    let (n, r, t, depth) = (15, 2.0, 0.3, 0.7);
    // A ring sector of straight sides: ½ (r_o² − r_i²) sin(π/n) = r t sin(π/n).
    let area = f64::from(n) * r * t * (PI / f64::from(n)).sin();
    let spec = format!("stones = {n}, radius = {r}, thickness = {t}");
    let flat = plane(&format!("arch = {{ {spec} }}"));
    let deep = solid(&format!("arch = {{ {spec}, depth = {depth} }}"));
    close(volume(&flat), area, 1e-12);
    close(volume(&deep), area * depth, 1e-12);
    // Both feet on the ground, and each stone with the next.
    let mut expected: Vec<(u32, u32)> = vec![(0, 1), (0, n as u32)];
    expected.extend((1..n as u32).map(|i| (i, i + 1)));
    assert_eq!((faces(&flat), faces(&deep)), (expected.clone(), expected));
}

#[test]
fn arches_of_any_kind_have_their_span_and_fit_their_springers() {
    for (joints, degrees) in [("radial", 120.0), ("vertical", 120.0), ("radial", 180.0), ("vertical", 180.0)] {
        let spec = format!("stones = 6, span = 2.0, thickness = 0.2, joints = \"{joints}\", degrees = {degrees:?}");
        for dimension in [2, 3] {
            let depth = if dimension == 3 { ", depth = 0.5" } else { "" };
            let scene = scene(dimension, &format!("arch = {{ {spec}, springers = \"fixed\"{depth} }}"));
            assert_eq!(scene.body_label(1), "voussoir 0 of build[0] \"it\"");
            assert_eq!(scene.body_label(7), "springer 6 of build[0] \"it\"");
            let (pairs, feet) = match scene.build(u64::MAX).unwrap() {
                AnyWorld::Plane(world) => (faces(&world), lowest(&world)),
                AnyWorld::Solid(world) => (faces(&world), lowest(&world)),
            };
            let wanted: Vec<(u32, u32)> = (1..6).map(|i| (i, i + 1)).chain([(1, 7), (6, 8)]).collect();
            assert!(wanted.iter().all(|pair| pairs.contains(pair)), "{joints} {degrees} {dimension}: {pairs:?}");
            close(feet, 1.0, 1e-12);
        }
    }
}

/// The least distance from the middle at which stone 0, which is body 1, touches the ground.
fn lowest<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> f64 {
    let ours = contacts(world).into_iter().filter(|contact| (contact.key.a, contact.key.b) == (0, 1));
    ours.map(|contact| contact.point[0]).fold(f64::INFINITY, f64::min)
}

#[test]
fn an_arcade_is_solid_between_ground_and_level_but_for_its_openings() {
    let (arches, n) = (3.0, 10.0);
    let spec = "arches = 3, stones = 10, span = 2.0, pier = 0.8, height = 2.0, blocks = 4, level = 1.5";
    let flat = plane(&format!("arcade = {{ {spec} }}"));
    let deep = solid(&format!("arcade = {{ {spec}, depth = 0.6 }}"));
    assert_eq!((flat.bodies.len(), deep.bodies.len()), (1 + 16 + 30, 1 + 16 + 30));
    // An opening is a rectangle and half of a polygon of twice n sides.
    let opening = 2.0 * 2.0 + 0.5 * n * (PI / n).sin();
    let area = (arches * 2.8 + 0.8) * 3.5 - arches * opening;
    close(volume(&flat), area, 1e-12);
    close(volume(&deep), 0.6 * area, 1e-12);
    // Piers: 3 joints of each and its foot; arches: 9 joints and two feet each; three stones beside three
    // others at each of the two places where arches meet.
    assert_eq!((faces(&flat).len(), faces(&deep).len()), (4 * 4 + 3 * 11 + 6, 4 * 4 + 3 * 11 + 6));
}

#[test]
fn a_wall_has_halves_at_the_ends_of_every_second_course() {
    for (bond, count) in [("running", 3 * 5 + 1), ("stack", 3 * 5)] {
        let spec = format!("courses = 3, bricks = 5, gap = 0.02, bond = \"{bond}\"");
        let flat = plane(&format!("wall = {{ size = [0.5, 0.2], {spec} }}"));
        let deep = solid(&format!("wall = {{ size = [0.5, 0.3, 0.2], {spec} }}"));
        assert_eq!((flat.bodies.len(), deep.bodies.len()), (count + 1, count + 1));
        // All courses are as long; those with halves have a joint more.
        let joints = if bond == "running" { 4.0 + 5.0 + 4.0 } else { 12.0 };
        let area = 0.2 * (3.0 * (5.0 * 0.5 + 4.0 * 0.02) - 0.02 * joints);
        close(volume(&flat), area, 1e-12);
        close(volume(&deep), 0.3 * area, 1e-12);
        // Five feet; a brick of a running bond lies on two.
        let beds = if bond == "running" { 5 + 10 + 10 } else { 15 };
        assert_eq!((faces(&flat).len(), faces(&deep).len()), (beds, beds), "{bond}");
    }
    // Without a gap neighbours share their joints, too.
    let close_set = solid("wall = { size = [0.5, 0.3, 0.2], courses = 3, bricks = 5 }");
    assert_eq!(faces(&close_set).len(), 25 + 4 + 5 + 4);
}

#[test]
fn stones_of_a_dry_wall_fill_it_and_keep_to_their_limits() {
    let spec = "layers = 6, stones = 7, irregularity = 0.4, seed = 3";
    let flat = plane(&format!("dry_stone = {{ size = [0.5, 0.2], {spec} }}"));
    let deep = solid(&format!("dry_stone = {{ size = [0.5, 0.3, 0.2], {spec} }}"));
    assert_eq!((flat.bodies.len(), deep.bodies.len()), (1 + 6 * 7 + 3, 1 + 6 * 7 + 3));
    close(volume(&deep), 0.3 * volume(&flat), 1e-12);
    // Heights: the mean of six in 0.2 (1 ± 0.4).
    let height = volume(&flat) / 3.5;
    assert!(height > 6.0 * 0.12 && height < 6.0 * 0.28 && (height - 1.2).abs() > 1e-3, "{height}");
    for (i, mass) in flat.bodies.mass.iter().enumerate().skip(1) {
        let area = mass[0] / 1000.0;
        assert!(area > 0.3 * 0.5 * 0.12 && area < 1.4 * 0.5 * 0.28, "stone {i}: {area}");
    }
    // Each stone stands on one at least, and next to its neighbour: all gaps are rounding.
    let joints = 3 * 6 + 3 * 7;
    assert!(faces(&flat).len() >= joints + 45 && faces(&deep).len() == faces(&flat).len());
}

#[test]
fn a_column_is_a_prism_over_a_polygon() {
    let drums = solid("column = { drums = 5, height = 3.0, radius = 0.4, sides = 10 }");
    close(volume(&drums), 3.0 * 0.5 * 10.0 * 0.16 * (2.0 * PI / 10.0).sin(), 1e-12);
    assert_eq!(faces(&drums), [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)]);
    close(volume(&solid("column = { drums = 5, height = 3.0, width = 0.4, depth = 0.3 }")), 0.36, 1e-12);
    close(volume(&solid("column = { drums = 5, height = 3.0, width = 0.4 }")), 0.48, 1e-12);
    close(volume(&plane("column = { drums = 5, height = 3.0, width = 0.4 }")), 1.2, 1e-12);
}

/// Between two concentric spheres a stone is the difference of two similar pyramids with their top in the centre, over the trapezoid of four
/// points of a sphere.
#[test]
fn stones_of_a_dome_share_their_faces_and_have_the_volume_of_pyramids() {
    let (courses, n, inner, outer): (u32, u32, f64, f64) = (5, 12, 1.8, 2.2);
    let pyramid = |low: f64, high: f64| {
        let half = (PI / f64::from(n)).sin();
        let (below, above) = (low.cos() * half, high.cos() * half);
        // The middles of the two parallel sides, in the plane of the meridian between them.
        let middle = |latitude: f64| [latitude.cos() * (PI / f64::from(n)).cos(), latitude.sin()];
        let ([a, b], [c, d]) = (middle(low), middle(high));
        // Height of the trapezoid times its distance from the centre is twice a triangle's area.
        (below + above) * (a * d - b * c) / 3.0
    };
    let shell = outer.powi(3) - inner.powi(3);
    let oculus: f64 = 0.4;
    for (spec, step, keystone) in [("", PI / 2.0 / 5.5, true), (", oculus = 0.4", (oculus / inner).acos() / 5.0, false)] {
        let world = solid(&format!("dome = {{ courses = 5, stones = 12, radius = 2.0, thickness = 0.4{spec} }}"));
        let rings: f64 = (0..courses).map(|k| pyramid(step * f64::from(k), step * f64::from(k + 1))).sum();
        // The keystone's base is a regular polygon of n corners on the last parallel.
        let last: f64 = 5.0 * step;
        let key = 0.5 * f64::from(n) * last.cos().powi(2) * (2.0 * PI / f64::from(n)).sin() * last.sin() / 3.0;
        let volumes = shell * (f64::from(n) * rings + if keystone { key } else { 0.0 });
        close(volume(&world), volumes, 1e-12);
        // Feet, beds, joints, and the keystone's sides.
        let count = 12 + 4 * 12 + 5 * 12 + if keystone { 12 } else { 0 };
        assert_eq!(faces(&world).len(), count, "{spec}");
    }
}

#[test]
fn dominoes_stand_in_a_row_and_the_first_touches_the_ground_with_its_edge() {
    let flat = plane("dominoes = { count = 4, size = [0.01, 0.05], spacing = 0.03, tilt_degrees = 10 }");
    let deep = solid("dominoes = { count = 4, size = [0.01, 0.02, 0.05], spacing = 0.03, tilt_degrees = 10 }");
    assert_eq!((faces(&flat).len(), faces(&deep).len()), (3, 3));
    assert_eq!((contacts(&flat).len(), contacts(&deep).len()), (3 * 2 + 1, 3 * 4 + 2));
    close(flat.bodies.pose[4].position[0], 0.09, 1e-12);
    // The lower front edge stays where it was.
    close(contacts(&flat)[0].point[0], 0.005, 1e-12);
}

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

#[test]
fn built_bodies_have_names_and_labels_between_those_of_bodies_and_walls() {
    let text = text(2, "column = { drums = 3, height = 3, width = 1 }")
        + "[[build]]\nkind.dominoes = { count = 2, size = [0.1, 1], spacing = 1 }\nmaterial = \"stone\"\nposition = [3, 0]\n\
           [[containers]]\nmin = [-9, -9]\nmax = [9, 9]\nmaterial = \"stone\"\n";
    let scene = Scene::parse(&text, "names.toml").unwrap();
    let names: Vec<_> = (0..10).map(|i| scene.body_name(i).map(|name| name.to_string())).collect();
    let named = |name: &str| Some(name.to_owned());
    assert_eq!(names[..6], [named("ground"), named("it.0"), named("it.1"), named("it.2"), None, None]);
    assert_eq!(
        ["ground", "it.0", "it.2", "it.3", "it.02", "it"].map(|name| scene.body_named(name)),
        [Some(0), Some(1), Some(3), None, None, None]
    );
    assert_eq!(scene.body_label(2), "drum 1 of build[0] \"it\"");
    assert_eq!(scene.body_label(5), "domino 1 of build[1]");
    assert_eq!(scene.body_label(6), "wall -x of containers[0]");
    let estimate = scene.estimate();
    assert_eq!((estimate.bodies, estimate.free_bodies), (10, 5));
    let AnyWorld::Plane(world) = scene.build(u64::MAX).unwrap() else { panic!("of the plane") };
    assert_eq!(world.bodies.len(), 10);
    close(world.bodies.pose[5].position[0], 4.0, 1e-12);
}

#[test]
fn joints_know_built_bodies_by_name() {
    let arch = "arch = { stones = 4, radius = 1.0, thickness = 0.3, springers = \"fixed\" }";
    let joint = |between: &str| format!("{}[[joints]]\nkind.hinge.anchor = [0, 1]\nbetween = [{between}]\n", text(2, arch));
    let scene = Scene::parse(&joint("\"it.1\", \"it.2\""), "joint.toml").unwrap();
    let AnyWorld::Plane(world) = scene.build(u64::MAX).unwrap() else { panic!("of the plane") };
    assert_eq!(world.joints.len(), 1);
    assert_eq!(world.joints[0].bodies, [Some(2), Some(3)]);
    let error = Scene::parse(&joint("\"it.4\", \"it.5\""), "joint.toml").expect_err("two springers").to_string();
    assert!(error.contains("do not give way"), "{error}");
    let error = Scene::parse(&joint("\"it.6\""), "joint.toml").expect_err("six stones").to_string();
    assert!(error.contains("no body is named `it.6`") && error.contains("`it.0`"), "{error}");
}

#[test]
fn builders_can_be_turned() {
    let turned = text(3, "wall = { size = [0.5, 0.3, 0.2], courses = 2, bricks = 3 }")
        .replace("name = \"it\"", "name = \"it\"\norientation = { axis = [0, 0, 1], degrees = 90 }");
    let AnyWorld::Solid(world) = Scene::parse(&turned, "turned.toml").unwrap().build(u64::MAX).unwrap() else {
        panic!("of space")
    };
    let first = world.bodies.pose[1].position;
    assert!((first[0]).abs() < 1e-12 && (first[1] + 0.5).abs() < 1e-12 && (first[2] - 0.1).abs() < 1e-12, "{first:?}");
    assert_eq!(faces(&world).len(), 3 + 6 + 2 + 3);
}

/// Runs two hundred steps and gives the kinetic energy at the end over the weight's work along a millimetre.
fn unrest<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>) -> f64 {
    let mut work = Workspace::default();
    let mut kinetic = 0.0;
    for _ in 0..200 {
        let record = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged(), "step {}: {:?}", record.step, record.residual);
        kinetic = record.energy.kinetic;
    }
    kinetic / (volume(&world) * 1000.0 * 9.81 * 1e-3)
}

/// A free fall of 200 steps would give 200 of this measure. A solver of tolerance 1e-8 leaves velocities of some 1e-8 of those of one step's
/// fall, g h = 1e-2 m/s, whose squares are 1e-20.
#[test]
fn what_should_stand_stands() {
    for kind in [
        "arch = { stones = 9, radius = 1.0, thickness = 0.2 }",
        "arch = { stones = 6, span = 2.0, thickness = 0.4, joints = \"vertical\", degrees = 60, springers = \"fixed\" }",
        "arcade = { arches = 2, stones = 9, span = 2.0, pier = 1.2, height = 1.5, blocks = 3, level = 1.6 }",
        "wall = { size = [0.5, 0.2], courses = 6, bricks = 4 }",
        "dry_stone = { size = [0.5, 0.2], layers = 5, stones = 5, seed = 1 }",
        "column = { drums = 6, height = 3.0, width = 0.6 }",
        "dominoes = { count = 5, size = [0.01, 0.05], spacing = 0.03 }",
        "card_house = { levels = 3, size = [0.09, 0.002], degrees = 15 }",
    ] {
        let found = unrest(plane(kind));
        assert!(found < 1e-12, "{kind}: {found:e}");
    }
    for kind in [
        "arch = { stones = 9, radius = 1.0, thickness = 0.2, depth = 0.4 }",
        "wall = { size = [0.5, 0.3, 0.2], courses = 5, bricks = 4 }",
        "dry_stone = { size = [0.5, 0.3, 0.2], layers = 4, stones = 4, seed = 1 }",
        "column = { drums = 6, height = 3.0, radius = 0.4, sides = 10 }",
        "dome = { courses = 4, stones = 8, radius = 2.0, thickness = 0.5, oculus = 0.5 }",
        "card_house = { levels = 2, size = [0.09, 0.06, 0.002], degrees = 15 }",
    ] {
        let found = unrest(solid(kind));
        assert!(found < 1e-12, "{kind}: {found:e}");
    }
}

/// The message of a scene that cannot be built.
#[track_caller]
fn refused(dimension: usize, kind: &str, key: &str, words: &[&str]) {
    let error =
        Scene::parse(&text(dimension, kind), "bad.toml").and_then(|scene| scene.build(1 << 30).map(drop)).expect_err(kind);
    let message = error.to_string();
    assert_eq!(error.place.key, key, "{message}");
    for word in words {
        assert!(message.contains(word), "`{word}` is not in:\n{message}");
    }
    assert!(!error.hint.is_empty(), "{message}");
}

#[test]
fn wrong_numbers_are_refused_by_name() {
    let arch = |rest: &str| format!("arch = {{ stones = 8, radius = 1.0, {rest} }}");
    refused(2, &arch("thickness = -0.1"), "build[0].kind.arch.thickness", &["thickness is -0.1", "positive number"]);
    refused(2, &arch("thickness = 2.5"), "build[0].kind.arch.thickness", &["less than twice the mean radius"]);
    refused(2, &arch("thickness = 0.1, span = 2.0"), "build[0].kind.arch", &["both of radius and span"]);
    refused(2, &arch("thickness = 0.1, depth = 1.0"), "build[0].kind.arch.depth", &["a depth where dimension = 2"]);
    refused(3, &arch("thickness = 0.1"), "build[0].kind.arch", &["`depth` is missing"]);
    refused(2, &arch("thickness = 0.1, degrees = 90"), "build[0].kind.arch.degrees", &["springers = \"fixed\""]);
    refused(2, &arch("thickness = 0.2, joints = \"vertical\""), "build[0].kind.arch.joints", &["fewer stones"]);
    refused(2, &arch("thickness = 0.2, joints = \"slanted\""), "build[0].kind.arch.joints", &["radial", "vertical"]);
    refused(2, &arch("thicknes = 0.2"), "build[0].kind.arch.thicknes", &["did you mean `thickness`?"]);
    refused(2, "arc = { stones = 8 }", "build[0].kind.arc", &["did you mean `arch`?"]);
    refused(2, "arch = { stones = 1, radius = 1.0, thickness = 0.1 }", "build[0].kind.arch.stones", &["2 or more"]);
    let arcade = "arcade = { arches = 2, stones = 9, span = 2.0, pier = 1.2, height = 1.5, blocks = 3, level = 0.9 }";
    refused(2, arcade, "build[0].kind.arcade.level", &["more than half the span"]);
    refused(2, "wall = { size = [1, 1, 1], courses = 2, bricks = 2 }", "build[0].kind.wall.size", &["length and height"]);
    refused(3, "wall = { size = [1, 1, 0], courses = 2, bricks = 2 }", "build[0].kind.wall.size[2]", &["positive number"]);
    refused(2, "wall = { size = [1, 1], courses = 2, bricks = 2, gap = 1.0 }", "build[0].kind.wall.gap", &["less than a brick"]);
    refused(2, "wall = { size = [1, 1], courses = 0, bricks = 2 }", "build[0].kind.wall.courses", &["1 or more"]);
    let count = "wall = { size = [1, 1], courses = 1000000, bricks = 1000000 }";
    refused(2, count, "build[0].kind", &["bodies here make more than"]);
    refused(2, "wall = { size = [1, 1], courses = 10000, bricks = 10000 }", "build[0]", &["GiB of memory"]);
    refused(2, "column = { drums = 2, height = 1, radius = 1 }", "build[0].kind.column.radius", &["expected a width"]);
    refused(3, "column = { drums = 2, height = 1 }", "build[0].kind.column", &["neither of radius and width"]);
    refused(3, "column = { drums = 2, height = 1, radius = 1, sides = 2 }", "build[0].kind.column.sides", &["3 to 360"]);
    let dome = "dome = { courses = 4, stones = 8, radius = 2.0, thickness = 0.5, oculus = 1.8 }";
    refused(3, dome, "build[0].kind.dome.oculus", &["less than the inner radius of 1.75"]);
    refused(2, dome, "build[0].kind", &["a dome where dimension = 2", "the builders of dimension 2 are arch"]);
    let stones = "dry_stone = { size = [1, 1], layers = 2, stones = 2, irregularity = 1.0 }";
    refused(2, stones, "build[0].kind.dry_stone.irregularity", &["from 0 to less than 1"]);
    let dominoes = "dominoes = { count = 2, size = [0.1, 1], spacing = 0.05 }";
    refused(2, dominoes, "build[0].kind.dominoes.spacing", &["at least the thickness"]);
    let lying = "dominoes = { count = 2, size = [0.1, 1], spacing = 0.2, tilt_degrees = 30 }";
    refused(2, lying, "build[0]", &["domino 0 of build[0] \"it\" and domino 1 of build[0] \"it\" overlap"]);
    let cards = "card_house = { levels = 2, size = [0.09, 0.002], degrees = 29.5 }";
    refused(2, cards, "build[0].kind.card_house.degrees", &["pairs of cards overlap"]);
    let drum = "drum = { radius = 1, length = 1, thickness = 0.1, sides = 2 }";
    refused(3, drum, "build[0].kind.drum.sides", &["3 to 1000"]);
    let still = "drum = { radius = 1, length = 1, thickness = 0.1, spin = 1 }\nmotion = \"fixed\"";
    refused(3, still, "build[0].motion", &["a spin of fixed bodies"]);
    let hopper = "hopper = { opening = 0.4, top = 0.3, height = 0.4, thickness = 0.05 }";
    refused(2, hopper, "build[0].kind.hopper.top", &["at least the opening"]);
    let ballast = |rest: &str| format!("ballast = {{ count = 9, radii.constant = 1.0, {rest} }}");
    refused(2, &ballast("seed = 1"), "build[0].kind.ballast", &["a lattice or a packing"]);
    let room = "packing = { min = [0, 0], max = [9, 9] }";
    refused(2, &ballast(room), "build[0].kind.ballast.packing", &["bodies fit"]);
    refused(2, &ballast(&format!("{room}, elongation = 1.5")), "build[0].kind.ballast.elongation", &["0.001 to 1"]);
    refused(2, &ballast(&format!("{room}, corners = 2")), "build[0].kind.ballast.corners", &["from 3"]);
    refused(2, &ballast(&format!("{room}, flatness = 0.5")), "build[0].kind.ballast.flatness", &["leave it out"]);
    refused(2, &ballast("packing = { min = [0], max = [9, 9] }"), "build[0].kind.ballast.packing.min", &["expected 2 numbers"]);
    refused(3, "arch = { stones = 8, radius = 1e-300, thickness = 1e-301, depth = 1 }", "build[0].kind", &["voussoir 0"]);
}

#[test]
fn names_that_are_taken_are_refused() {
    let column = "column = { drums = 3, height = 3, width = 1 }";
    let second =
        "\n[[build]]\nname = \"it\"\nkind.column = { drums = 1, height = 1, width = 1 }\nmaterial = \"stone\"\nposition = [9, 0]";
    refused(2, &format!("{column}{second}"), "build[1].name", &["build[0] has it already"]);
    let body = text(2, column).replace("name = \"ground\"", "name = \"it.2\"");
    let error = Scene::parse(&body, "bad.toml").expect_err("a name of the column's");
    assert!(error.to_string().contains("bodies[0].name: the name of a body of build[0]"), "{error}");
    refused(2, &format!("{column}\nmotion = \"loose\""), "build[0].motion", &["free"]);
}
