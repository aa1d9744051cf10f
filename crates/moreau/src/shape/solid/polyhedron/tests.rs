use super::*;
use glam::DVec3;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// All vertices behind all faces and on the planes of their own, faces counter-clockwise, edges between their faces, Euler's formula.
fn is_sound(body: &Polyhedron, flat: f64) {
    let level = 8.0 * flat * body.radius();
    for face in 0..body.faces() {
        let corners: Vec<usize> = body.face(face).iter().map(|&i| usize::from(i)).collect();
        let (n, at) = (DVec3::from(body.normal(face)), |i: usize| DVec3::from(body.vertex(i)));
        assert!(corners.len() > 2 && (n.length() - 1.0).abs() < 1e-12);
        for i in 0..body.vertices() {
            let over = n.dot(at(i) - at(corners[0]));
            assert!(over <= level, "vertex {i} is {over:e} over face {face}");
            assert!(!corners.contains(&i) || over >= -level, "corner {i} is {over:e} under face {face}");
        }
        for k in 0..corners.len() {
            let [p, q, r] = [0, 1, 2].map(|j| at(corners[(k + j) % corners.len()]));
            assert!((q - p).cross(r - q).dot(n) > 0.0, "corner {k} of face {face} turns inwards");
        }
    }
    for edge in body.edges() {
        assert!(edge.faces.iter().all(|&face| edge.ends.iter().all(|end| body.face(usize::from(face)).contains(end))));
    }
    assert_eq!(body.vertices() + body.faces(), body.edges().len() + 2);
}

fn turned(points: &[[f64; 3]], q: [f64; 4], at: [f64; 3]) -> Vec<[f64; 3]> {
    let turn = DQuat::from_array(q).normalize();
    points.iter().map(|&p| (turn * DVec3::from(p) + DVec3::from(at)).into()).collect()
}

fn block(size: [f64; 3]) -> Vec<[f64; 3]> {
    (0..8).map(|i| std::array::from_fn(|k| if i >> k & 1 == 1 { size[k] } else { 0.0 })).collect()
}

fn prism(sides: usize) -> Vec<[f64; 3]> {
    let angle = |i: usize| TAU * i as f64 / sides as f64;
    (0..2 * sides).map(|i| [angle(i / 2).cos(), angle(i / 2).sin(), if i % 2 == 1 { 1.0 } else { 0.0 }]).collect()
}

#[test]
fn the_hull_of_a_box_is_the_box() {
    let (body, pose) = Polyhedron::hull(&block([1.0, 2.0, 3.0])).unwrap();
    is_sound(&body, 1e-9);
    assert_eq!((body.vertices(), body.faces(), body.edges().len()), (8, 6, 12));
    assert_eq!((pose.position, pose.rotation), ([0.5, 1.0, 1.5], DQuat::IDENTITY));
    let found = body.mass(2.0);
    for (found, right) in found.iter().zip([12.0, 12.0, 12.0, 13.0, 10.0, 5.0]) {
        assert!((found - right).abs() < 1e-13, "{found} {right}");
    }
}

#[test]
fn a_prism_has_caps_of_as_many_corners_as_it_has_sides() {
    for sides in [3, 16, 64, 500] {
        let (body, _) = Polyhedron::hull(&prism(sides)).unwrap();
        is_sound(&body, 1e-9);
        assert_eq!((body.vertices(), body.faces()), (2 * sides, sides + 2));
        let area = 0.5 * sides as f64 * (TAU / sides as f64).sin();
        assert!((body.volume() - area).abs() < 1e-12 * PI);
    }
}

#[test]
fn points_inside_on_faces_and_on_edges_are_left_out() {
    let grid: Vec<[f64; 3]> = (0..125).map(|i| [f64::from(i % 5), f64::from(i / 5 % 5), f64::from(i / 25)]).collect();
    let (body, _) = Polyhedron::hull(&turned(&grid, [0.3, 0.1, -0.2, 0.9], [7.0, 0.0, -3.0])).unwrap();
    is_sound(&body, 1e-9);
    assert_eq!((body.vertices(), body.faces()), (8, 6));
    assert!((body.volume() - 64.0).abs() < 1e-11);
}

/// The hull that was tried first, quickhull in triangles, leaves out the thickness of nearly all of these.
#[test]
fn plates_and_needles_keep_their_thickness() {
    let mut random = proptest::test_runner::TestRunner::deterministic();
    random
        .run(&(prop::array::uniform4(-1.0..1.0_f64), prop::array::uniform3(-10.0..10.0_f64)), |(q, at)| {
            for size in [[1.0, 1.0, 1e-3], [1.0, 1e-3, 1e-3], [1000.0, 1.0, 1.0]] {
                let (body, _) = Polyhedron::hull(&turned(&block(size), q, at)).unwrap();
                is_sound(&body, 1e-9);
                assert_eq!(body.vertices(), 8);
                let volume: f64 = size.iter().product();
                assert!((body.volume() / volume - 1.0).abs() < 1e-9);
            }
            Ok(())
        })
        .unwrap();
}

#[test]
fn corners_of_single_precision_make_flat_faces_where_that_is_asked() {
    let rough: Vec<[f64; 3]> = turned(&prism(12), [0.5, 0.1, -0.2, 0.7], [3.0, -5.0, 2.0]);
    let rough: Vec<[f64; 3]> = rough.iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
    let (body, _) = Polyhedron::hull_within(&rough, 1e-6).unwrap();
    is_sound(&body, 1e-6);
    assert_eq!((body.vertices(), body.faces()), (24, 14));
}

proptest! {
    #[test]
    fn hulls_of_random_points_hold_them_all(seed in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 4..80)) {
        let (body, pose) = Polyhedron::hull(&seed).unwrap();
        is_sound(&body, 1e-9);
        for p in &seed {
            let p = pose.rotation.conjugate() * (DVec3::from(*p) - DVec3::from(pose.position));
            for face in 0..body.faces() {
                let n = DVec3::from(body.normal(face));
                prop_assert!(n.dot(p - DVec3::from(body.vertex(usize::from(body.face(face)[0])))) < 1e-8);
            }
        }
    }

    #[test]
    fn points_on_a_sphere_are_all_corners(seed in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 4..60)) {
        let round: Vec<[f64; 3]> = seed.iter().map(|&p| DVec3::from(p).normalize().into()).collect();
        let (body, _) = Polyhedron::hull(&round).unwrap();
        is_sound(&body, 1e-9);
        prop_assert_eq!(body.vertices(), seed.len());
    }
}

#[test]
fn what_is_no_body_is_said() {
    let of = |points: &[[f64; 3]]| Polyhedron::hull(points).unwrap_err().to_string();
    assert!(of(&block([1.0; 3])[..3]).contains("at least 4"));
    assert!(of(&[[0.0; 3]; 8]).contains("one plane"));
    assert!(of(&block([1.0, 1.0, 0.0])).contains("one plane"));
    assert!(of(&block([1.0, 0.0, 0.0])).contains("one plane"));
    let mut nowhere = block([1.0; 3]);
    nowhere[5][1] = f64::NAN;
    assert!(of(&nowhere).contains("point 5"));
    assert!(of(&block([1e-80; 3])).contains("one plane"));
    assert!(of(&prism(2100)).contains("at most 4096"));
}

/// Meshes name a corner once for each face.
#[test]
fn a_hull_with_repeated_points_is_a_hull() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let once = Polyhedron::hull(&corners).unwrap().0;
    for again in [0.0, 1e-12] {
        let points: Vec<[f64; 3]> = (0..3).flat_map(|k| corners.map(|p| p.map(|x| x + f64::from(k) * again))).collect();
        let hull = Polyhedron::hull(&points).unwrap().0;
        assert_eq!(hull.vertices(), 4);
        assert!((hull.volume() - once.volume()).abs() < 1e-11);
    }
}
