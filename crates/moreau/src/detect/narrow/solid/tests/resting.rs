//! Capsules and cylinders that stand and lie: points in known places, under names that stay.

use super::*;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

const DRUM: Cylinder = Cylinder { radius: 1.0, half: 2.0 };
const PILL: Capsule = Capsule { radius: 0.5, half: 2.0 };
const SLAB: Cuboid = Cuboid { half: [4.0, 4.0, 1.0] };

/// The axis along x.
fn lying() -> DQuat {
    DQuat::from_xyzw(0.0, FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2)
}

fn contacts(a: impl Into<SolidShape>, pose_a: Pose, b: impl Into<SolidShape>, pose_b: Pose, reach: f64) -> Vec<Found> {
    let (a, b) = (a.into(), b.into());
    let mut found = Vec::new();
    SolidShape::collide((&a, &pose_a), (&b, &pose_b), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    found
}

/// Checks normals up, gaps and heights; gives the points seen from above, in order.
fn on_top(found: &[Found], height: f64, gap: f64) -> Vec<[f64; 2]> {
    for (_, p, n, g) in found {
        let up = (DVec3::from(*n) - DVec3::Z).length() < 1e-12;
        assert!(up && (g - gap).abs() < 1e-11 && (p[2] - height - 0.5 * gap).abs() < 1e-11, "{found:?}");
    }
    let mut points: Vec<[f64; 2]> = found.iter().map(|(_, p, ..)| [p[0], p[1]]).collect();
    points.sort_by(|p, q| p.partial_cmp(q).unwrap());
    points
}

fn same(points: &[[f64; 2]], expected: &[[f64; 2]]) {
    assert_eq!(points.len(), expected.len(), "{points:?}");
    for (p, right) in points.iter().zip(expected) {
        assert!((p[0] - right[0]).abs() + (p[1] - right[1]).abs() < 1e-11, "{points:?} are not {expected:?}");
    }
}

const S: f64 = FRAC_1_SQRT_2;
/// Where a drum stands.
const SQUARE: [[f64; 2]; 4] = [[-S, -S], [-S, S], [S, -S], [S, S]];

#[test]
fn a_cylinder_stands_on_four_points_of_its_rim() {
    for gap in [0.1, 0.0, -0.1] {
        let drum = at([0.0, 0.0, 2.0 + gap], UP);
        same(&on_top(&touch(HalfSpace, at([0.0; 3], UP), DRUM, drum, 0.2), 0.0, gap), &SQUARE);
        same(&on_top(&touch(SLAB, at([0.0, 0.0, -1.0], UP), DRUM, drum, 0.2), 0.0, gap), &SQUARE);
        // On an equal one, and on a wider one: the rim within the other cap.
        same(&on_top(&contacts(DRUM, at([0.0, 0.0, -2.0], UP), DRUM, drum, 0.2), 0.0, gap), &SQUARE);
        let wide = Cylinder { radius: 1.5, half: 1.0 };
        same(&on_top(&contacts(wide, at([0.3, 0.0, -1.0], UP), DRUM, drum, 0.2), 0.0, gap), &SQUARE);
    }
}

#[test]
fn a_cylinder_over_an_edge_stands_on_what_is_over_the_face() {
    let found = touch(SLAB, at([0.0, 0.0, -1.0], UP), DRUM, at([4.6, 0.0, 2.0], UP), 1e-9);
    let points = on_top(&found, 0.0, 0.0);
    // The edge cuts the rim at y = ±0.8.
    assert!(
        points.contains(&[4.0, -0.8]) || points.iter().any(|p| (p[0] - 4.0).abs() + (p[1] + 0.8).abs() < 1e-12),
        "{points:?}"
    );
    assert!(points.len() == 4 && points.iter().all(|p| p[0] < 4.0 + 1e-12 && (p[0] - 4.6).hypot(p[1]) < 1.0 + 1e-12));
    // Two caps share a lens from x = 0.2 to 1, with its corners at y = ±0.8.
    let found = contacts(DRUM, at([0.0, 0.0, -2.0], UP), DRUM, at([1.2, 0.0, 2.0], UP), 1e-9);
    same(&on_top(&found, 0.0, 0.0), &[[0.2, 0.0], [0.6, -0.8], [0.6, 0.8], [1.0, 0.0]]);
}

#[test]
fn cylinders_and_capsules_lie_on_both_ends_of_a_line() {
    let ends = [[-2.0, 0.0], [2.0, 0.0]];
    let plane = at([0.0; 3], UP);
    same(&on_top(&touch(HalfSpace, plane, DRUM, at([0.0, 0.0, 1.0], lying()), 1e-9), 0.0, 0.0), &ends);
    same(&on_top(&touch(HalfSpace, plane, PILL, at([0.0, 0.0, 0.5], lying()), 1e-9), 0.0, 0.0), &ends);
    let slab = at([0.0, 0.0, -1.0], UP);
    same(&on_top(&touch(SLAB, slab, DRUM, at([0.0, 0.0, 0.9], lying()), 1e-9), 0.0, -0.1), &ends);
    same(&on_top(&touch(SLAB, slab, PILL, at([0.0, 0.0, 0.5], lying()), 1e-9), 0.0, 0.0), &ends);
    // Over an edge it ends there.
    same(&on_top(&touch(SLAB, slab, PILL, at([3.0, 0.0, 0.5], lying()), 1e-9), 0.0, 0.0), &[[1.0, 0.0], [4.0, 0.0]]);
    same(&on_top(&touch(SLAB, slab, DRUM, at([3.0, 0.0, 1.0], lying()), 1e-9), 0.0, 0.0), &[[1.0, 0.0], [4.0, 0.0]]);
    // Side by side, one farther along by one.
    let beside = [[-1.0, 0.0], [2.0, 0.0]];
    let (low, high) = (at([0.0, 0.0, -1.0], lying()), at([1.0, 0.0, 1.0], lying()));
    same(&on_top(&contacts(DRUM, low, DRUM, high, 1e-9), 0.0, 0.0), &beside);
    let (low, high) = (at([0.0, 0.0, -0.5], lying()), at([1.0, 0.0, 0.5], lying()));
    same(&on_top(&contacts(PILL, low, PILL, high, 1e-9), 0.0, 0.0), &beside);
    same(&on_top(&touch(DRUM, at([0.0, 0.0, -1.0], lying()), PILL, high, 1e-9), 0.0, 0.0), &beside);
    // Lying on the cap of one that stands.
    same(
        &on_top(&contacts(DRUM, at([0.0, 0.0, -2.0], UP), DRUM, at([0.0, 0.0, 1.0], lying()), 1e-9), 0.0, 0.0),
        &[[-1.0, 0.0], [1.0, 0.0]],
    );
}

#[test]
fn crossed_cylinders_and_capsules_touch_at_one_point() {
    let across = DQuat::from_rotation_z(FRAC_PI_2) * lying();
    same(
        &on_top(&contacts(DRUM, at([0.0, 0.3, -1.0], lying()), DRUM, at([0.5, 0.0, 1.0], across), 1e-9), 0.0, 0.0),
        &[[0.5, 0.3]],
    );
    same(
        &on_top(&contacts(PILL, at([0.0, 0.3, -0.5], lying()), PILL, at([0.5, 0.0, 0.5], across), 1e-9), 0.0, 0.0),
        &[[0.5, 0.3]],
    );
    same(&on_top(&touch(DRUM, at([0.0, 0.3, -1.0], lying()), PILL, at([0.5, 0.0, 0.5], across), 1e-9), 0.0, 0.0), &[[0.5, 0.3]]);
}

#[test]
fn a_tilted_cylinder_touches_with_the_lowest_point_of_its_rim() {
    // Tilted by 3-4-5 about y: the lowest point is at −0.8 along x and −0.6 along z of its axes' plane.
    let tilt = DQuat::from_xyzw(0.0, 0.1_f64.sqrt(), 0.0, 0.9_f64.sqrt());
    let (x, z) = (0.6 * 2.0 - 0.8, 0.8 * 2.0 + 0.6);
    for (other, pose) in [(SolidShape::from(HalfSpace), at([0.0; 3], UP)), (SLAB.into(), at([0.0, 0.0, -1.0], UP))] {
        let found = touch(other, pose, DRUM, at([1.0, 0.0, z], tilt), 1e-9);
        assert!(found.len() == 1, "{found:?}");
        let (p, n) = (DVec3::from(found[0].1), DVec3::from(found[0].2));
        assert!((p - DVec3::new(1.0 - x - 1.6, 0.0, 0.0)).length() < 1e-14 || (p.y.abs() + p.z.abs() < 1e-14), "{found:?}");
        assert!((n - DVec3::Z).length() < 1e-15 && found[0].3.abs() < 1e-14);
    }
}

#[test]
fn a_ball_is_near_a_cap_a_side_or_a_rim() {
    let ball = Ball { radius: 1.0 };
    let origin = at([0.0; 3], UP);
    near(&touch(DRUM, origin, ball, at([0.5, 0.0, 3.5], UP), 1.0), &[(0, [0.5, 0.0, 2.25], [0.0, 0.0, 1.0], 0.5)]);
    near(&touch(DRUM, origin, ball, at([0.0, -1.75, 1.0], UP), 1.0), &[(0, [0.0, -0.875, 1.0], [0.0, -1.0, 0.0], -0.25)]);
    near(&touch(DRUM, origin, ball, at([1.6, 0.0, 2.8], UP), 1.0), &[(0, [1.0, 0.0, 2.0], [0.6, 0.0, 0.8], 0.0)]);
    near(&touch(DRUM, origin, ball, at([0.0; 3], UP), 1.0), &[(0, [0.0; 3], [1.0, 0.0, 0.0], -2.0)]);
    near(&touch(PILL, origin, ball, at([0.9, 0.0, 3.2], UP), 1.0), &[(0, [0.3, 0.0, 2.4], [0.6, 0.0, 0.8], 0.0)]);
}

/// A pair that rests, and how it trembles.
fn still(a: impl Into<SolidShape>, pose_a: Pose, b: impl Into<SolidShape>, pose_b: Pose, count: usize) {
    let (a, b) = (a.into(), b.into());
    let mut first: Option<Vec<u64>> = None;
    for k in 0..200 {
        let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 2e-15;
        let moved = |pose: Pose, seed: i32| {
            let turn = DQuat::from_xyzw(tiny(seed), tiny(seed + 1), tiny(seed + 2), 1.0).normalize();
            let [x, y, z] = pose.position;
            at([x + tiny(seed + 3), y + tiny(seed + 4), z + tiny(seed + 5)], turn * pose.rotation)
        };
        let found = contacts(a.clone(), moved(pose_a, 1), b.clone(), moved(pose_b, 11), 1e-9);
        let features: Vec<u64> = found.iter().map(|contact| contact.0).collect();
        assert!(found.len() == count && first.get_or_insert(features.clone()) == &features, "{a:?} {b:?}: {features:x?}");
        // Gaps are of the trembling, and so are normals.
        for (_, _, n, g) in &found {
            assert!(g.abs() < 2e-11 && (DVec3::from(*n) - DVec3::Z).length() < 2e-9, "{found:?}");
        }
    }
}

#[test]
fn features_and_normals_of_bodies_at_rest_do_not_flicker() {
    let slab = at([0.0, 0.0, -1.0], UP);
    let plane = at([0.0; 3], UP);
    for turn in [0.0, 0.3, FRAC_PI_2 / 4.0, FRAC_PI_2 / 2.0] {
        let turn = DQuat::from_rotation_z(turn);
        let drum = at([0.0, 0.0, 2.0], turn);
        still(HalfSpace, plane, DRUM, drum, 4);
        still(SLAB, slab, DRUM, drum, 4);
        still(DRUM, at([0.0, 0.0, -2.0], UP), DRUM, drum, 4);
        still(DRUM, at([0.0, 0.0, -2.0], lying()), SLAB, at([0.0, 0.0, 0.0], turn), 2);
        still(Cylinder { radius: 0.5, half: 1.0 }, at([0.4, 0.1, -1.0], turn), DRUM, at([0.0, 0.0, 2.0], UP), 4);
    }
    // Half over an edge, a corner, the rim of another.
    for x in [4.0, 4.5] {
        still(SLAB, slab, DRUM, at([x, 0.0, 2.0], UP), 4);
        still(SLAB, slab, DRUM, at([x, x, 2.0], UP), 4);
        still(SLAB, slab, DRUM, at([x, 0.0, 1.0], lying()), 2);
        still(SLAB, slab, PILL, at([x, 0.0, 0.5], lying()), 2);
    }
    still(DRUM, at([0.0, 0.0, -2.0], UP), DRUM, at([0.8, 0.5, 2.0], UP), 4);
    // Along an edge, exactly over it.
    let along = DQuat::from_rotation_z(FRAC_PI_2) * lying();
    still(SLAB, slab, DRUM, at([4.0, 0.0, 1.0], along), 2);
    still(SLAB, slab, PILL, at([4.0, 0.0, 0.5], along), 2);
    for shift in [0.0, 0.7] {
        still(DRUM, at([0.0, 0.0, -1.0], lying()), DRUM, at([shift, 0.0, 1.0], lying()), 2);
        still(PILL, at([0.0, 0.0, -0.5], lying()), PILL, at([shift, 0.0, 0.5], lying()), 2);
        still(DRUM, at([0.0, 0.0, -1.0], lying()), PILL, at([shift, 0.0, 0.5], lying()), 2);
        still(DRUM, at([0.0, 0.0, -2.0], UP), DRUM, at([shift, 0.0, 1.0], lying()), 2);
        still(DRUM, at([0.0, 0.0, -2.0], UP), PILL, at([shift, 0.0, 0.5], lying()), 2);
    }
    // Standing on one end.
    still(SLAB, slab, PILL, at([0.0, 0.0, 2.5], UP), 1);
    still(PILL, at([0.0, 0.0, -2.5], UP), PILL, at([0.0, 0.0, 2.5], UP), 1);
    still(DRUM, at([0.0, 0.0, -2.0], UP), PILL, at([0.0, 0.0, 2.5], UP), 1);
}

/// Around its axis it can turn as it likes.
#[test]
fn a_rolling_cylinder_keeps_its_features() {
    for turn in (0..100).map(|k| 0.1 * f64::from(k)) {
        let pose = at([0.0, 0.0, 1.0], lying() * DQuat::from_rotation_z(turn));
        for (other, below) in [(SolidShape::from(HalfSpace), 0.0), (SLAB.into(), -1.0)] {
            let found = touch(other, at([0.0, 0.0, below], UP), DRUM, pose, 1e-9);
            let names: Vec<u64> = found.iter().map(|contact| contact.0 & 0xffff_0000 | (contact.0 >> 15 & 1)).collect();
            assert!(
                found.len() == 2 && names[0] != names[1] && found.iter().all(|contact| contact.0 & 0x3fff_7ffe == 0),
                "{found:?}"
            );
        }
    }
}

#[test]
fn a_curved_body_that_is_nowhere_touches_nothing() {
    let shapes: [SolidShape; 5] =
        [Ball { radius: 1.0 }.into(), Cuboid { half: [1.0; 3] }.into(), PILL.into(), DRUM.into(), HalfSpace.into()];
    for place in [at([f64::NAN; 3], UP), at([0.0, f64::NAN, 0.0], UP), at([0.0; 3], DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0))] {
        for other in shapes.clone() {
            for curved in [SolidShape::from(PILL), DRUM.into()] {
                assert!(contacts(curved.clone(), place, other.clone(), at([0.0; 3], UP), 1.0).is_empty(), "{curved:?} {other:?}");
                // A ball looks the same however it is turned.
                if other.name() != "ball" || place.position[1].is_nan() {
                    assert!(
                        contacts(curved.clone(), at([0.0; 3], UP), other.clone(), place, 1.0).is_empty(),
                        "{curved:?} {other:?}"
                    );
                }
            }
        }
    }
}
