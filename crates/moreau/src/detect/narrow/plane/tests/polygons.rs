//! Polygons on polygons: against closed forms, and against distances found by trying every vertex against every side.

use super::*;
use proptest::prelude::*;
use std::f64::consts::PI;

fn turned(angle: f64) -> [f64; 2] {
    [angle.cos(), angle.sin()]
}

/// The contacts of a with b.
fn contacts(a: &Polygon, pose_a: &Pose, b: &Polygon, pose_b: &Pose, reach: f64) -> Vec<Found> {
    let mut found = Vec::new();
    let (a, b) = (PlaneShape::from(a.clone()), PlaneShape::from(b.clone()));
    PlaneShape::collide((&a, pose_a), (&b, pose_b), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    found
}

#[test]
fn a_block_stands_on_a_block_at_the_ends_of_what_they_share() {
    let below = at([0.0, 0.0], UP);
    let up = [0.0, 1.0];
    // Moved to the right: from the upper's corner 0 to the lower's corner 2. The lower one is the first body, with even numbers.
    let found = contacts(&rectangle(), &below, &rectangle(), &at([0.5, 3.75], UP), 0.0);
    near(&found, &[(1, [-0.5, 1.875], up, -0.25), (4, [1.0, 1.875], up, -0.25)]);
    // Opposite corners count as the first body's.
    let found = contacts(&rectangle(), &below, &rectangle(), &at([0.0, 4.0], UP), 0.0);
    near(&found, &[(4, [1.0, 2.0], up, 0.0), (6, [-1.0, 2.0], up, 0.0)]);
    // A smaller one within the larger one's side.
    let small = Polygon::new(vec![[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]).unwrap().0;
    let found = contacts(&rectangle(), &below, &small, &at([0.2, 2.6], UP), 0.2);
    near(&found, &[(1, [-0.3, 2.05], up, 0.1), (3, [0.7, 2.05], up, 0.1)]);
}

#[test]
fn features_of_blocks_at_rest_do_not_flicker() {
    // Parallel sides and opposite corners, moved by rounding: either may become the reference, and none may show.
    for shift in [0.0, 0.7] {
        for k in 0..200 {
            let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 1e-15;
            let pose = at([shift + tiny(1), 4.0 + tiny(2)], turned(tiny(3)));
            let found = contacts(&rectangle(), &at([tiny(5), tiny(6)], turned(tiny(7))), &rectangle(), &pose, 1e-9);
            let features: Vec<u64> = found.iter().map(|contact| contact.0).collect();
            assert_eq!(features, if shift == 0.0 { [4, 6] } else { [1, 4] }, "{found:?}");
            assert!(found.iter().all(|(_, _, n, g)| (n[1] - 1.0).abs() < 1e-12 && g.abs() < 1e-11));
        }
    }
}

#[test]
fn corners_that_touch_have_one_normal_whatever_the_rounding() {
    for k in 0..200 {
        let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 1e-15;
        let pose = at([2.0 + tiny(1), 4.0 + tiny(2)], turned(tiny(3)));
        let found = contacts(&rectangle(), &at([tiny(5), tiny(6)], turned(tiny(7))), &rectangle(), &pose, 1e-9);
        assert!(found.len() == 1 && found[0].0 == 1, "{found:?}");
        assert!((found[0].2[0] - 1.0).abs() < 1e-12 && found[0].3.abs() < 1e-11, "{found:?}");
    }
}

#[test]
fn a_corner_stands_on_a_side_at_one_point_and_corners_have_the_direction_between_them() {
    let diamond = at([0.3, 2.0 + 5.0_f64.sqrt() - 0.1], turned(PI / 2.0 - 2.0_f64.atan()));
    let found = contacts(&rectangle(), &at([0.0; 2], UP), &rectangle(), &diamond, 0.0);
    assert!(found.len() == 1 && (found[0].3 + 0.1).abs() < 1e-14 && (found[0].1[0] - 0.3).abs() < 1e-14, "{found:?}");
    let found = contacts(&rectangle(), &at([0.0; 2], UP), &rectangle(), &at([2.3, 4.4], UP), 0.6);
    near(&found, &[(4, [1.15, 2.2], [0.6, 0.8], 0.5)]);
}

/// The least distance between two polygons that are apart: of every vertex from every side.
fn distance(a: &Polygon, pose_a: &Pose, b: &Polygon, pose_b: &Pose) -> f64 {
    let world = |pose: &Pose, v: [f64; 2]| {
        let v = Plane::rotate(pose.rotation, v);
        [pose.position[0] + v[0], pose.position[1] + v[1]]
    };
    let one_way = |a: &Polygon, pose_a: &Pose, b: &Polygon, pose_b: &Pose| {
        let mut least = f64::INFINITY;
        for v in a.vertices().map(|v| world(pose_a, v)) {
            for side in b.sides() {
                let (s, e) = (world(pose_b, side.start), world(pose_b, side.end));
                let (d, w) = ([e[0] - s[0], e[1] - s[1]], [v[0] - s[0], v[1] - s[1]]);
                let t = ((d[0] * w[0] + d[1] * w[1]) / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
                least = least.min((w[0] - t * d[0]).hypot(w[1] - t * d[1]));
            }
        }
        least
    };
    one_way(a, pose_a, b, pose_b).min(one_way(b, pose_b, a, pose_a))
}

/// A convex polygon: points on an ellipse at these angles.
fn polygon() -> impl Strategy<Value = Polygon> {
    (prop::collection::vec(0.05..1.0_f64, 3..9), 0.2..1.0_f64).prop_filter_map("convex", |(steps, flat)| {
        let all: f64 = steps.iter().sum();
        let mut angle = 0.0;
        let points = steps.iter().map(|step| {
            angle += 2.0 * PI * step / all;
            [angle.cos(), flat * angle.sin()]
        });
        Polygon::new(points.collect()).ok().map(|(polygon, _)| polygon)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gaps_are_distances(a in polygon(), b in polygon(), way in 0.0..6.3, far in 0.5..3.0, turn in 0.0..6.3) {
        let (pose_a, pose_b) = (at([0.3, -0.2], turned(0.4)), at([0.3 + far * f64::cos(way), far * f64::sin(way) - 0.2], turned(turn)));
        let found = contacts(&a, &pose_a, &b, &pose_b, 5.0);
        prop_assert!(!found.is_empty() && found.len() <= 2);
        let least = found.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        if least > 0.0 {
            let right = distance(&a, &pose_a, &b, &pose_b);
            prop_assert!((least - right).abs() < 1e-8, "{least} is not {right}");
        }
        for (_, _, normal, _) in &found {
            prop_assert!((normal[0].hypot(normal[1]) - 1.0).abs() < 1e-12);
        }
        // Moved apart by the depth along the normal they just touch.
        if least < 0.0 {
            let n = found[0].2;
            let moved = at([pose_b.position[0] - (least - 1e-6) * n[0], pose_b.position[1] - (least - 1e-6) * n[1]], pose_b.rotation);
            let right = distance(&a, &pose_a, &b, &moved);
            prop_assert!((right - 1e-6).abs() < 1e-8, "after moving by {least}: {right} apart");
        }
    }
}
