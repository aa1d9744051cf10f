//! Arches, walls, columns, domes, rows: neighbours share their faces, and what should stand stands.

use super::{close, contacts, faces, lowest, plane, scene, solid, volume};
use moreau::scene::AnyWorld;
use moreau::space::Space;
use moreau::step::{Workspace, step};
use moreau::world::World;
use std::f64::consts::PI;

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
///
/// Contacts act when closed. The arch of vertical joints, which friction alone holds, has at 0.6 a rest and a fall that both obey the law; on approach
/// sweeps end at the fall, and ADMM at the rest.
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
