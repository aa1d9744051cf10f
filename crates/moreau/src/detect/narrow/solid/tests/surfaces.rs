//! Bodies on surfaces of triangles: against half-spaces, distances to all triangles, and closed forms.

use super::*;
use crate::mesh::{Heights, Mesh};
use crate::shape::solid::Surface;
use proptest::prelude::*;

fn contacts(surface: &Surface, body: impl Into<SolidShape>, pose: Pose, reach: f64) -> Vec<Found> {
    let mut found = Vec::new();
    let (surface, body) = (SolidShape::from(surface.clone()), body.into());
    let here = at([0.0; 3], UP);
    SolidShape::collide((&surface, &here), (&body, &pose), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    assert!(found.is_sorted_by(|a, b| a.0 < b.0), "features ascend: {found:?}");
    found
}

/// A grid of `count` by `count` heights around the origin.
fn field(count: usize, spacing: f64, height: impl Fn(f64, f64) -> f64) -> Surface {
    let low = -0.5 * spacing * (count - 1) as f64;
    let at = |i: usize| low + spacing * i as f64;
    let rows = (0..count).map(|j| (0..count).map(|i| height(at(i), at(j))).collect()).collect();
    Surface::new(Heights { origin: [low, low, 0.0], spacing: [spacing; 2], rows }.mesh().unwrap()).unwrap()
}

/// A mesh of two rectangles that meet along the y axis, each rising by `slope` away from it.
fn fold(slope: f64) -> Surface {
    let points =
        vec![[-1.0, -1.0, slope], [0.0, -1.0, 0.0], [1.0, -1.0, slope], [-1.0, 1.0, slope], [0.0, 1.0, 0.0], [1.0, 1.0, slope]];
    Surface::new(Mesh { points, triangles: vec![[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]] }).unwrap()
}

/// The distance to a triangle: to its plane where the foot is inside, else to the nearest of its edges.
fn distance(corners: [DVec3; 3], x: DVec3) -> f64 {
    let n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    let edge = |k: usize| (corners[k], corners[(k + 1) % 3] - corners[k]);
    if (0..3).all(|k| n.cross(edge(k).1).dot(x - edge(k).0) >= 0.0) {
        return n.dot(x - corners[0]).abs();
    }
    let to_edge = |(p, way): (DVec3, DVec3)| (x - p - ((x - p).dot(way) / way.length_squared()).clamp(0.0, 1.0) * way).length();
    (0..3).map(|k| to_edge(edge(k))).fold(f64::INFINITY, f64::min)
}

/// Returns false if a point is straight below a triangle.
fn is_over([a, b, c]: [DVec3; 3], x: DVec3) -> bool {
    let n = (b - a).cross(c - a);
    let beside = [(a, b), (b, c), (c, a)].into_iter().any(|(p, q)| (q - p).truncate().perp_dot((x - p).truncate()) < 0.0);
    beside || n.dot(x - a) > 0.0
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// The least gap is the distance to all triangles; no other point is nearer to the ball than what is around it.
    #[test]
    fn a_ball_over_terrain_is_as_far_as_the_nearest_triangle(
        x in -0.9..0.9_f64, y in -0.9..0.9_f64, above in 0.01..0.4_f64, radius in 0.02..0.4_f64, rough in 0.0..0.6_f64, turn in 0.0..6.0_f64
    ) {
        let height = |x: f64, y: f64| rough * (5.0 * x + turn).sin() * (4.0 * y - turn).cos() + 0.3 * rough * (17.0 * x * y).sin();
        let surface = field(21, 0.1, height);
        let mesh = surface.mesh();
        let triangle = |i: usize| mesh.triangles[i].map(|k| DVec3::from(mesh.points[k as usize]));
        let centre = DVec3::new(x, y, height(x, y) + 0.2 * rough + above);
        // Between its heights the field is flat, so that the centre may be behind it.
        prop_assume!((0..mesh.triangles.len()).all(|i| is_over(triangle(i), centre)));
        let right = (0..mesh.triangles.len()).map(|i| distance(triangle(i), centre)).fold(f64::INFINITY, f64::min) - radius;
        let found = contacts(&surface, Ball { radius }, at(centre.to_array(), UP), 1.0);
        let least = found.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        // Beyond the reach there may be none.
        prop_assert!((least - right).abs() < 1e-12 || right > 1.0, "{least} is not {right}");
        for (i, (_, point, normal, gap)) in found.iter().enumerate() {
            let (point, normal) = (DVec3::from(*point), DVec3::from(*normal));
            // A normal that differs from a triangle's by less than 1e-7 counts as the triangle's.
            let arm = radius + 0.5 * gap;
            prop_assert!((point - centre + arm * normal).length() < 1e-12 + 1e-7 * arm.abs());
            prop_assert!(found[..i].iter().all(|other| (DVec3::from(other.1) - point).length() > 1e-9), "a point twice: {found:?}");
        }
    }

    /// On a plane of many triangles all normals are the plane's, and the deepest point is as deep as in a half-space.
    #[test]
    fn a_tilted_box_does_not_feel_how_a_plane_is_divided(
        x in -0.3..0.3_f64, y in -0.3..0.3_f64, turn in 0.0..7.0_f64, tilt in 0.0..0.02_f64, depth in 0.0..1e-3_f64, cells in 2..30_usize
    ) {
        let surface = field(cells + 1, 4.0 / cells as f64, |_, _| 0.0);
        let cuboid = Cuboid { half: [0.4, 0.3, 0.2] };
        let rotation = DQuat::from_rotation_z(turn) * DQuat::from_rotation_x(tilt);
        let low = (0..8).map(|k| (rotation * DVec3::from(cuboid.corner(k))).z).fold(f64::INFINITY, f64::min);
        let pose = at([x, y, -low - depth], rotation);
        let found = contacts(&surface, cuboid, pose, 0.0);
        prop_assert!(!found.is_empty() && found.len() <= 4, "{found:?}");
        prop_assert!(found.iter().all(|contact| contact.2 == [0.0, 0.0, 1.0]), "{found:?}");
        let least = found.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        prop_assert!((least + depth).abs() < 1e-12, "{least} is not {}", -depth);
    }
}

#[test]
fn a_box_stands_on_a_fine_mesh_at_its_corners() {
    // 0.41 over cells of 0.07: corners fall anywhere in triangles; 0.35 and 0.14: on their corners and edges.
    for (half, place) in [(0.41, [0.013, 0.027]), (0.35, [0.0, 0.0]), (0.14, [0.035, 0.0]), (0.01, [0.0, 0.035])] {
        let surface = field(41, 0.07, |_, _| 0.0);
        for turn in [0.0, 0.4, std::f64::consts::FRAC_PI_4] {
            let rotation = DQuat::from_rotation_z(turn);
            let pose = at([place[0], place[1], half - 1e-6], rotation);
            let found = contacts(&surface, Cuboid { half: [half; 3] }, pose, 1e-9);
            assert_eq!(found.len(), 4, "{half}, {turn}: {found:?}");
            for (x, y) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
                let corner = DVec3::from(pose.position) + rotation * DVec3::new(x * half, y * half, -half);
                let is_it = |point: [f64; 3]| (DVec3::from(point) - corner - DVec3::Z * 5e-7).length() < 1e-11;
                assert!(found.iter().any(|contact| is_it(contact.1)), "{half}, {turn}, {corner}: {found:?}");
            }
        }
    }
}

#[test]
fn features_of_a_box_at_rest_on_the_corners_of_triangles_do_not_flicker() {
    let surface = field(21, 0.1, |_, _| 0.0);
    let mut first: Option<Vec<u64>> = None;
    for k in 0..200 {
        let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 1e-15;
        let rotation = DQuat::from_xyzw(tiny(4), tiny(5), tiny(6), 1.0).normalize();
        let pose = at([tiny(1), tiny(2), 0.3 + tiny(3)], rotation);
        let found = contacts(&surface, Cuboid { half: [0.3; 3] }, pose, 1e-9);
        let features: Vec<u64> = found.iter().map(|contact| contact.0).collect();
        assert!(features.len() == 4 && first.get_or_insert(features.clone()) == &features, "{features:x?}");
    }
}

#[test]
fn a_ball_in_a_valley_touches_both_sides_once() {
    let s = 0.5_f64.sqrt();
    for y in [0.0, 0.3, -0.77] {
        let found = contacts(&fold(1.0), Ball { radius: 0.2 }, at([0.0, y, 0.2 / s], UP), 1e-9);
        assert_eq!(found.len(), 2, "{found:?}");
        for (_, point, normal, gap) in found {
            assert!(gap.abs() < 1e-15 && (normal[2] - s).abs() < 1e-15 && (normal[0].abs() - s).abs() < 1e-15);
            assert!((point[0] + 0.2 * s * normal[0].signum()).abs() < 1e-15 && (point[1] - y).abs() < 1e-15);
        }
    }
}

#[test]
fn a_ball_on_a_ridge_has_any_normal_between_those_of_the_sides() {
    for lean in [-0.7, -0.3, 0.0, 0.5, 0.78] {
        let normal = DVec3::new(f64::sin(lean), 0.0, f64::cos(lean));
        let found = contacts(&fold(-1.0), Ball { radius: 0.2 }, at((0.2 * normal).to_array(), UP), 1e-9);
        assert_eq!(found.len(), 1, "{lean}: {found:?}");
        assert!((DVec3::from(found[0].2) - normal).length() < 1e-14 && found[0].3.abs() < 1e-14);
    }
}

#[test]
fn a_box_astride_a_ridge_touches_it_along_its_length() {
    let found = contacts(&fold(-1.0), Cuboid { half: [0.5, 0.4, 0.1] }, at([0.1, 0.05, 0.1], UP), 1e-9);
    let mut ends: Vec<f64> = found.iter().map(|contact| contact.1[1]).collect();
    ends.sort_by(f64::total_cmp);
    assert!(found.iter().all(|(_, p, n, g)| p[0].abs() < 1e-12 && (n[2] - 1.0).abs() < 1e-12 && g.abs() < 1e-12), "{found:?}");
    assert!(ends.len() == 2 && (ends[0] + 0.35).abs() < 1e-12 && (ends[1] - 0.45).abs() < 1e-12, "{ends:?}");
}

#[test]
fn an_edge_of_a_box_crosses_a_ridge_at_one_point() {
    // Turned so that an edge along x is its lowest part.
    let turned = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_4);
    let found = contacts(&fold(-1.0), Cuboid { half: [0.5, 0.1, 0.1] }, at([0.1, 0.2, 0.1 * 2.0_f64.sqrt()], turned), 1e-9);
    assert_eq!(found.len(), 1, "{found:?}");
    let (_, point, normal, gap) = found[0];
    assert!((DVec3::from(point) - DVec3::new(0.0, 0.2, 0.0)).length() < 1e-12 && gap.abs() < 1e-12, "{found:?}");
    assert!((normal[2] - 1.0).abs() < 1e-12);
}

#[test]
fn nothing_touches_the_back_of_a_surface() {
    let surface = field(11, 0.2, |_, _| 0.0);
    assert!(contacts(&surface, Ball { radius: 0.3 }, at([0.03, 0.02, -0.2], UP), 1.0).is_empty());
    assert!(contacts(&surface, Cuboid { half: [0.3; 3] }, at([0.03, 0.02, -0.2], UP), 0.0).is_empty());
}

#[test]
fn a_body_deeper_than_triangles_are_wide_is_still_met() {
    let surface = field(21, 0.1, |x, y| 0.1 * (3.0 * x).sin() * (2.0 * y).cos());
    let pose = at([0.11, 0.07, 0.11], DQuat::from_rotation_x(0.1));
    let found = contacts(&surface, Cuboid { half: [0.2, 0.15, 0.1] }, pose, 0.01);
    assert!(found.iter().any(|contact| contact.3 < 0.0) && found.iter().all(|contact| contact.2[2] > 0.5), "{found:?}");
}

#[test]
fn at_the_rim_of_a_surface_a_ball_rolls_off() {
    let surface = field(3, 1.0, |_, _| 0.0); // from −1 to 1
    let touch = |x: f64, z: f64| contacts(&surface, Ball { radius: 0.5 }, at([x, 0.2, z], UP), 1e-9);
    let over = touch(1.3, 0.4);
    assert_eq!(over.len(), 1);
    assert!((DVec3::from(over[0].2) - DVec3::new(0.6, 0.0, 0.8)).length() < 1e-14, "{over:?}");
    assert!(touch(1.3, -0.4).is_empty(), "below the rim is behind the surface");
}

#[test]
fn a_surface_turned_and_moved_has_its_contacts_turned_and_moved() {
    let surface = SolidShape::from(field(21, 0.1, |x, y| 0.1 * (3.0 * x).sin() * (2.0 * y).cos()));
    let body = SolidShape::from(Cuboid { half: [0.2, 0.15, 0.1] });
    let touch = |a: Pose, b: Pose| {
        let mut found = Vec::new();
        SolidShape::collide((&surface, &a), (&body, &b), 0.01, &mut |f, p, n, g| found.push((f, p, n, g)));
        found
    };
    let rotation = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_z(-2.0);
    let place = DVec3::new(3.0, -1.0, 7.0);
    let pose = at([0.11, 0.07, 0.18], DQuat::from_rotation_x(0.1));
    let plain = touch(at([0.0; 3], UP), pose);
    let moved = touch(
        at(place.to_array(), rotation),
        at((place + rotation * DVec3::from(pose.position)).to_array(), rotation * pose.rotation),
    );
    assert!(!plain.is_empty() && plain.len() == moved.len(), "{plain:?} {moved:?}");
    for ((f, p, n, g), (right_f, right_p, right_n, right_g)) in moved.iter().zip(&plain) {
        assert!(f == right_f && (g - right_g).abs() < 1e-12, "{plain:?} {moved:?}");
        assert!((DVec3::from(*p) - place - rotation * DVec3::from(*right_p)).length() < 1e-12);
        assert!((DVec3::from(*n) - rotation * DVec3::from(*right_n)).length() < 1e-12);
    }
}
