//! Bodies that stand half on a piece and are tilted a little keep the points of their faces, closed and open, whichever way they are tilted.

use super::*;
use crate::mesh::Heights;
use crate::shape::solid::{Polyhedron, Surface};

/// A piece of ground, from x = 0 to 3, with its surface at z = 0.
fn piece() -> (SolidShape, Pose) {
    (Cuboid { half: [1.5, 8.0, 0.5] }.into(), at([1.5, 0.0, -0.5], UP))
}

fn contacts((ground, pose): &(SolidShape, Pose), shape: &SolidShape, at: Pose, reach: f64) -> Vec<Found> {
    let mut found = Vec::new();
    SolidShape::collide((ground, pose), (shape, &at), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    found
}

/// Bodies of height 2 · `half`, the turn that lays them down, and how many points they have on a piece that bears half of them.
fn bodies() -> Vec<(SolidShape, DQuat, f64, usize)> {
    let pill = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let corners = [[-1.0, -1.0], [1.2, -0.8], [1.0, 1.0], [0.0, 1.3], [-0.9, 0.7]];
    let points: Vec<[f64; 3]> = [-1.0, 1.0].into_iter().flat_map(|z| corners.map(|[x, y]| [x, y, z])).collect();
    let (prism, own) = Polyhedron::hull(&points).expect("they have a hull");
    vec![
        (Cuboid { half: [1.0; 3] }.into(), UP, 1.0, 4),
        (Cylinder { radius: 1.0, half: 1.0 }.into(), UP, 1.0, 4),
        (Capsule { radius: 1.0, half: 2.0 }.into(), pill, 1.0, 2),
        (prism.into(), own.rotation, 1.0, 4),
    ]
}

#[test]
fn a_body_half_on_a_piece_has_all_points_of_its_face() {
    let ground = piece();
    for (shape, laid, half, count) in bodies() {
        for (tilt, gap) in [(1e-5, -1e-7), (1e-5, 1e-7), (-1e-5, -1e-7), (-1e-5, 1e-7), (1e-4, -1e-6), (1e-6, 0.0)] {
            for axis in [DVec3::Y, DVec3::X, DVec3::new(0.6, 0.8, 0.0)] {
                let turn = DQuat::from_axis_angle(axis, tilt) * laid;
                let found = contacts(&ground, &shape, at([0.0, 0.0, half + gap], turn), 0.05);
                let told = format!("{} tilted by {tilt} about {axis}, {gap} m apart: {found:?}", shape.name());
                assert_eq!(found.len(), count, "{told}");
                // Along the normal of the face, and as far apart as the body's own plane is there.
                for (_, p, n, g) in &found {
                    let height = DQuat::from_axis_angle(axis, tilt).mul_vec3(DVec3::Z);
                    let plane = gap - (height.x * p[0] + height.y * p[1]) / height.z;
                    assert!(n[2] > 1.0 - 1e-7 && (g - plane).abs() < 1e-8 + 1e-3 * plane.abs(), "{told}: not {plane}");
                }
            }
        }
    }
}

/// A plane is one however it is cut: a tilted body keeps points on all sides of its middle, and its lowest one.
#[test]
fn a_tilted_body_does_not_feel_the_triangles_of_a_plane() {
    for (spacing, x, y) in [(0.21, 0.0, 0.0), (0.21, 0.11, 0.03), (0.7, 0.35, 0.2), (1.9, 0.1, -0.6), (1.9, 0.95, 0.95)] {
        let rows = vec![vec![0.0; 31]; 31];
        let origin = [-15.0 * spacing, -15.0 * spacing, 0.0];
        let surface = Surface::new(Heights { origin, spacing: [spacing; 2], rows }.mesh().unwrap()).unwrap();
        let ground = (SolidShape::from(surface), at([0.0; 3], UP));
        for (shape, laid, half, count) in bodies() {
            for (tilt, gap) in [(1e-5, -1e-7), (1e-5, 1e-7), (1e-5, -1e-9), (1e-4, -1e-6), (1e-6, 0.0), (2e-8, 1e-9)] {
                for axis in [DVec3::Y, DVec3::X, DVec3::new(0.6, 0.8, 0.0), DVec3::new(0.8, -0.6, 0.0)] {
                    let tilted = DQuat::from_axis_angle(axis, tilt);
                    let found = contacts(&ground, &shape, at([x, y, half + gap], tilted * laid), 0.05);
                    let told = format!("{} tilted by {tilt} about {axis}, {gap} m apart over {spacing}: {found:?}", shape.name());
                    assert_eq!(found.len(), count, "{told}");
                    let up = tilted * DVec3::Z;
                    let plane = |p: &[f64; 3]| gap - (up.x * (p[0] - x) + up.y * (p[1] - y)) / up.z;
                    assert!(found.iter().all(|(_, p, n, g)| *n == [0.0, 0.0, 1.0] && (g - plane(p)).abs() < 2e-8), "{told}");
                    // The capsule lies along x. Of eight points of a rim two neighbours may be left out, and the cosine of 67.5 degrees is 0.3827.
                    for angle in (0..32).map(|k| f64::from(k) * std::f64::consts::TAU / 32.0) {
                        let out = |p: &[f64; 3]| angle.cos() * (p[0] - x) + angle.sin() * (p[1] - y);
                        let most = found.iter().map(|(_, p, ..)| out(p)).fold(f64::NEG_INFINITY, f64::max);
                        let least = if count == 2 { 1.9 * angle.cos().abs() - 1e-9 } else { 0.38 };
                        assert!(most >= least, "{told}: {most} along {angle}");
                    }
                }
            }
        }
    }
}

/// Five corners: three of them would have the middle on their border.
#[test]
fn a_prism_of_five_corners_stands_on_four() {
    let ground = piece();
    let (prism, laid, ..) = bodies().swap_remove(3);
    for degrees in 0..72 {
        let turn = DQuat::from_rotation_z(f64::from(5 * degrees).to_radians()) * laid;
        let found = contacts(&ground, &prism, at([1.5, 0.0, 1.0], turn), 1e-9);
        let mut points: Vec<f64> = found.iter().map(|(_, p, ..)| (p[1]).atan2(p[0] - 1.5)).collect();
        points.sort_by(f64::total_cmp);
        let widest = (0..points.len()).map(|i| {
            let next = if i + 1 < points.len() { points[i + 1] } else { points[0] + std::f64::consts::TAU };
            next - points[i]
        });
        assert!(points.len() == 4 && widest.fold(0.0, f64::max) < 3.0, "turned by {} degrees: {found:?}", 5 * degrees);
    }
}
