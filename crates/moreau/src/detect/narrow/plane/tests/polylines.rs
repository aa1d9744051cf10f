//! Bodies on polylines: against distances found by trying everything, and against half-planes.

use super::outlines::{Outline, assert_steady, contacts};
use super::*;
use crate::shape::plane::{Capsule, Polyline};
use proptest::prelude::*;

fn turned(angle: f64) -> [f64; 2] {
    [angle.cos(), angle.sin()]
}

fn line(points: &[[f64; 2]], closed: bool) -> PlaneShape {
    Polyline::new(points, closed).unwrap().into()
}

fn square() -> PlaneShape {
    Polygon::rectangle(1.0, 1.0).unwrap().into()
}

fn disk(radius: f64) -> PlaneShape {
    Disk { radius }.into()
}

/// The contacts with a fixed chain.
fn on(ground: &PlaneShape, body: &PlaneShape, pose: &Pose, reach: f64) -> Vec<Found> {
    let found = contacts(ground, &at([0.0; 2], UP), body, pose, reach);
    let reversed = contacts(body, pose, ground, &at([0.0; 2], UP), reach);
    assert!(
        found.iter().zip(&reversed).all(|(a, b)| a.0 == b.0 && a.1 == b.1 && a.2 == b.2.map(|x| -x)),
        "{found:?} {reversed:?}"
    );
    found
}

fn summary(found: &[Found]) -> Vec<(u64, [f64; 2])> {
    found.iter().map(|(feature, _, normal, _)| (*feature, normal.map(|x| (x * 1e6).round() / 1e6 + 0.0))).collect()
}

#[test]
fn a_straight_chain_of_any_slope_is_a_half_plane() {
    for slope in [0.0, 0.37, -1.2] {
        let (c, s) = (f64::cos(slope), f64::sin(slope));
        let points: Vec<_> = (-50..=50).map(|k| 0.1 * f64::from(k)).map(|x| [x * c, x * s]).collect();
        let ground = line(&points, false);
        let capsule = Capsule::new(0.3, 0.8).unwrap().into();
        for body in [square(), disk(0.5), capsule] {
            for k in 0..1000 {
                // Past every joint, at heights around touching, turned a little and much.
                let (x, up) = (0.0137 * f64::from(k % 300) - 2.0, 0.3 + 0.001 * f64::from(k % 400));
                let pose =
                    at([x * c - up * s, x * s + up * c], turned(slope + 0.01 * f64::from(k % 7) + 0.7 * f64::from(k / 500)));
                let found = on(&ground, &body, &pose, 0.05);
                let right = contacts(&HalfPlane.into(), &at([0.0; 2], [c, s]), &body, &pose, 0.05);
                // Of corners far behind the surface the chain leaves out those that face away from it.
                let count = right.iter().filter(|contact| contact.3 > -0.2 && contact.3 < 0.05 - 1e-9).count();
                let close = |a: &&Found| {
                    right.iter().any(|b| {
                        (0..2).all(|k| (a.1[k] - b.1[k]).abs() < 1e-12 && (a.2[k] - b.2[k]).abs() < 1e-9)
                            && (a.3 - b.3).abs() < 1e-12
                    })
                };
                assert!(found.len() >= count && found.iter().filter(close).count() == found.len(), "{found:?} is not {right:?}");
            }
        }
    }
}

#[test]
fn a_disk_passes_over_ridges_and_lies_in_valleys() {
    let roof = line(&[[-2.0, -2.0], [0.0, 0.0], [2.0, -2.0]], false);
    // Over the left side, over the ridge, over the right side: never more than one.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let left = on(&roof, &disk(1.0), &at([-1.2, 0.2], UP), 0.1);
    assert!(left.len() == 1 && (left[0].2[0] + half).abs() < 1e-15 && left[0].0 == 1, "{left:?}");
    near(&on(&roof, &disk(1.0), &at([0.0, 1.1], UP), 0.2), &[(1 << 32, [0.0, 0.05], [0.0, 1.0], 0.1)]);
    for k in 0..=1000 {
        let angle = 0.2 + 2.7 * f64::from(k) / 1000.0;
        assert_eq!(on(&roof, &disk(1.0), &at([angle.cos(), angle.sin()], UP), 1e-3).len(), 1);
    }
    let valley = line(&[[-2.0, 2.0], [0.0, 0.0], [2.0, 2.0]], false);
    let found = on(&valley, &disk(half), &at([0.0, 1.0], UP), 1e-9);
    let rounded = (half * 1e6).round() / 1e6;
    assert_eq!(summary(&found), [(1, [rounded, rounded]), ((1 << 32) | 1, [-rounded, rounded])]);
    // The end of a chain holds from above and not from behind.
    let shelf = line(&[[0.0, 0.0], [2.0, 0.0]], false);
    near(&on(&shelf, &disk(1.0), &at([-0.6, 0.8], UP), 1e-9), &[(0, [0.0, 0.0], [-0.6, 0.8], 0.0)]);
    assert!(on(&shelf, &disk(1.0), &at([-0.6, -0.6], UP), 1e-9).is_empty());
}

#[test]
fn a_box_in_a_corner_touches_both_walls_whatever_the_rounding() {
    let corner = line(&[[0.0, 3.0], [0.0, 0.0], [3.0, 0.0]], false);
    // Corner 0 on both, corner 1 on the floor, corner 3 on the wall.
    let expected = [1, 4, (1 << 32) | 1, (1 << 32) | 2];
    assert_steady(&corner, &at([0.0; 2], UP), &square(), &at([0.5, 0.5], UP), &expected);
    for (x, y) in [(-1e-8, -1e-6), (-1e-6, -1e-8), (-1e-6, 1e-10), (1e-10, -1e-6)] {
        let found = on(&corner, &square(), &at([0.5 + x, 0.5 + y], UP), 1e-9);
        assert_eq!(found.iter().map(|contact| contact.0).collect::<Vec<_>>(), expected, "{found:?}");
    }
}

#[test]
fn a_box_at_the_edge_of_a_table_does_not_know_its_side() {
    // A block 4 wide and 1 high, clockwise, with a joint in the middle of its top.
    let table = line(&[[-2.0, -1.0], [-2.0, 0.0], [0.0, 0.0], [2.0, 0.0], [2.0, -1.0]], true);
    let up = [0.0, 1.0];
    // Flush with the edge, either corner of the two may hold, but each place once and never sideways.
    for k in 0..200 {
        let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 2e-15;
        let found = on(&table, &square(), &at([1.5 + tiny(1), 0.5 + tiny(2)], [1.0, tiny(3)]), 1e-9);
        assert_eq!(summary(&found), [((2 << 32) | 1, up), ((2 << 32) | 2, up)]);
    }
    // Hanging over: one corner of the box, and the edge of the table under its bottom.
    let found = on(&table, &square(), &at([1.8, 0.5 - 1e-6], UP), 1e-9);
    assert_eq!(summary(&found), [((2 << 32) | 1, up), (3 << 32, up)]);
    // Against the side of the table.
    let found = on(&table, &square(), &at([2.5, -0.2], UP), 1e-9);
    assert_eq!(summary(&found), [(3 << 32, [1.0, 0.0]), ((3 << 32) | 1, [1.0, 0.0])]);
    // A plate as thin as paper has two sides, and only one of them is touched.
    let paper = line(&[[-2.0, -1e-3], [-2.0, 0.0], [2.0, 0.0], [2.0, -1e-3]], true);
    for body in [square(), disk(0.5), Capsule::new(0.5, 0.7).unwrap().into()] {
        let found = on(&paper, &body, &at([0.3, 0.5 - 1e-7], UP), 1e-9);
        assert!(!found.is_empty() && found.iter().all(|contact| contact.2 == up && contact.0 >> 32 == 1), "{found:?}");
    }
}

#[test]
fn stairs_hold_a_box_by_treads_alone() {
    let stairs = line(&[[0.0, 2.0], [2.0, 2.0], [2.0, 1.0], [4.0, 1.0], [4.0, 0.0], [6.0, 0.0]], false);
    // Its left corner is within the upper tread, sunk in by little: the riser is half a metre away through the solid.
    let found = on(&stairs, &square(), &at([1.8, 2.5 - 1e-7], UP), 1e-9);
    assert_eq!(summary(&found), [(1, [0.0, 1.0]), (1 << 32, [0.0, 1.0])]);
}

#[test]
fn a_body_that_is_nowhere_touches_no_chain() {
    let ground = line(&[[0.0, 0.0], [1.0, 0.0]], false);
    for body in [square(), disk(1.0), Capsule::new(1.0, 1.0).unwrap().into()] {
        assert!(on(&ground, &body, &at([f64::NAN; 2], UP), 1.0).is_empty());
    }
}

#[test]
fn features_on_a_chain_do_not_flicker() {
    let points: Vec<_> = (0..=100).map(|k| [0.1 * f64::from(k), 0.0]).collect();
    let ground = line(&points, false);
    assert_steady(&ground, &at([0.0; 2], UP), &square(), &at([2.53, 0.5], UP), &[(20 << 32) | 1, (30 << 32) | 2]);
    let capsule = Capsule::new(0.5, 1.0).unwrap().into();
    assert_steady(&ground, &at([0.0; 2], UP), &capsule, &at([2.53, 0.5], UP), &[(20 << 32) | 1, (30 << 32) | 2]);
}

/// A hilly ground, and heights over it.
fn ground() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec((0.05..0.6_f64, -0.4..0.4_f64), 4..30).prop_map(|steps| {
        let mut x = -2.0;
        let points = steps.into_iter().map(|(step, y)| {
            x += step;
            [x, y]
        });
        points.collect()
    })
}

fn body() -> impl Strategy<Value = PlaneShape> {
    prop_oneof![
        (0.1..1.0_f64).prop_map(disk),
        (0.05..0.6_f64, 0.2..2.0_f64).prop_map(|(r, l)| Capsule::new(r, l).unwrap().into()),
        (0.2..2.0_f64, 0.2..2.0_f64).prop_map(|(w, h)| Polygon::rectangle(w, h).unwrap().into()),
        (0.2..1.5_f64, -0.5..0.5_f64).prop_map(|(w, x)| Polygon::new(vec![[-w, -0.3], [w, -0.4], [x, 0.8]]).unwrap().0.into()),
    ]
}

proptest! {
    // More than half of the placements are partly in the ground, and not looked at.
    #![proptest_config(ProptestConfig { cases: 4000, max_global_rejects: 40_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// The core outside the solid: the least gap is the distance, and every contact is between two points of the surfaces.
    #[test]
    fn gaps_are_distances(points in ground(), body in body(), x in -1.5..4.0_f64, y in -0.3..1.8_f64, turn in 0.0..6.3) {
        let (chain, pose) = (line(&points, false), at([x, y], turned(turn)));
        let (a, b) = (Outline::of(&chain, &at([0.0; 2], UP)), Outline::of(&body, &pose));
        let over = |p: [f64; 2]| {
            points.windows(2).find(|w| w[0][0] <= p[0] && p[0] < w[1][0]).is_none_or(|w| {
                p[1] > w[0][1] + (w[1][1] - w[0][1]) * (p[0] - w[0][0]) / (w[1][0] - w[0][0])
            })
        };
        let ends = [points[0], points[points.len() - 1]];
        // Beyond its ends the chain has no side that is inside or outside.
        let within = b.segments.iter().flatten().all(|p| ends[0][0] < p[0] && p[0] < ends[1][0] && over(*p));
        let covers = matches!(&body, PlaneShape::Polygon(polygon) if points.iter().any(|p| {
            let at = Plane::unrotate(pose.rotation, [0, 1].map(|k| p[k] - pose.position[k]));
            polygon.sides().iter().all(|s| (0..2).map(|k| s.normal[k] * (at[k] - s.start[k])).sum::<f64>() < 0.0)
        }));
        prop_assume!(within && !covers && !a.crosses(&b));
        let right = a.apart(&b);
        let found = on(&chain, &body, &pose, 0.3);
        let least = found.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        if right < 0.3 - 1e-9 {
            prop_assert!((least - right).abs() < 1e-9, "{least} is not {right}: {found:?}");
        }
        for (_, point, n, gap) in &found {
            let side = |s: f64| [0, 1].map(|k| point[k] + 0.5 * s * gap * n[k]);
            prop_assert!((n[0].hypot(n[1]) - 1.0).abs() < 1e-12);
            // The higher end of a capsule is not what it has lowest there, so the point under it is a little inside.
            let (on_chain, on_body) = (a.distance(side(-1.0)), b.distance(side(1.0)));
            let exact = *gap < least + 1e-9 || body.name() != "capsule";
            prop_assert!(on_chain.abs() < 1e-8 && on_body < 1e-8 && (on_body > -1e-8 || !exact), "{found:?}");
        }
        // No two at one place.
        for (i, a) in found.iter().enumerate() {
            for b in &found[..i] {
                let apart = (a.1[0] - b.1[0]).hypot(a.1[1] - b.1[1]) + (a.2[0] - b.2[0]).hypot(a.2[1] - b.2[1]);
                prop_assert!(apart > 1e-7, "{found:?}");
            }
        }
    }
}
