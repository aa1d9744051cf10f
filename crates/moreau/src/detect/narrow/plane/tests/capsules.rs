//! Capsules: against closed forms, and against distances found by trying everything.

use super::outlines::{Outline, assert_steady, contacts};
use super::*;
use crate::shape::plane::Capsule;
use proptest::prelude::*;

fn turned(angle: f64) -> [f64; 2] {
    [angle.cos(), angle.sin()]
}

fn capsule(radius: f64, length: f64) -> Capsule {
    Capsule::new(radius, length).unwrap()
}

#[test]
fn a_capsule_lies_on_two_points_and_stands_on_one() {
    let found = touch(capsule(0.5, 2.0), at([0.0, 0.4], UP), HalfPlane, at([0.0; 2], UP), 0.0);
    near(&found, &[(0, [-1.0, -0.05], [0.0, -1.0], -0.1), (1, [1.0, -0.05], [0.0, -1.0], -0.1)]);
    let found = touch(capsule(0.5, 2.0), at([0.0, 1.5], [0.0, 1.0]), HalfPlane, at([0.0; 2], UP), 0.0);
    near(&found, &[(0, [0.0, 0.0], [0.0, -1.0], 0.0)]);
}

#[test]
fn a_disk_touches_a_capsule_at_its_side_or_its_end() {
    let arm = capsule(0.5, 2.0);
    near(&touch(arm, at([0.0; 2], UP), Disk { radius: 1.0 }, at([0.7, 1.4], UP), 0.0), &[(0, [0.7, 0.45], [0.0, 1.0], -0.1)]);
    near(&touch(arm, at([0.0; 2], UP), Disk { radius: 1.0 }, at([2.2, 1.6], UP), 0.6), &[(0, [1.45, 0.6], [0.6, 0.8], 0.5)]);
    near(&touch(arm, at([0.0; 2], UP), Disk { radius: 1.0 }, at([0.2, 0.0], UP), 0.0), &[(0, [0.2, -0.25], [0.0, 1.0], -1.5)]);
}

#[test]
fn capsules_lie_on_each_other_and_on_blocks_along_what_they_share() {
    let arm = capsule(0.5, 2.0);
    let up = [0.0, 1.0];
    // Moved to the right: from the upper's left end to the lower's right end.
    let found = touch_alike(&arm.into(), &at([0.0; 2], UP), &arm.into(), &at([0.6, 0.9], UP), 0.0);
    near(&found, &[(1, [-0.4, 0.45], up, -0.1), (2, [1.0, 0.45], up, -0.1)]);
    // On a block 2 wide and 4 high: both ends stand out, and the corners of the block hold it.
    let found = touch(rectangle(), at([0.0; 2], UP), capsule(0.5, 3.0), at([0.2, 2.5], UP), 0.0);
    near(&found, &[(4, [1.0, 2.0], up, 0.0), (6, [-1.0, 2.0], up, 0.0)]);
}

/// Contacts of two shapes of a kind; the other order has the same points and gaps, and opposite normals.
fn touch_alike(a: &PlaneShape, pose_a: &Pose, b: &PlaneShape, pose_b: &Pose, reach: f64) -> Vec<Found> {
    let found = contacts(a, pose_a, b, pose_b, reach);
    let mut reversed = contacts(b, pose_b, a, pose_a, reach);
    assert_eq!(found.len(), reversed.len());
    for (_, point, normal, gap) in &found {
        let same = |other: &Found| {
            (0..2).all(|k| (other.1[k] - point[k]).abs() < 1e-12 && (other.2[k] + normal[k]).abs() < 1e-12)
                && (other.3 - gap).abs() < 1e-12
        };
        let place = reversed.iter().position(same).unwrap_or_else(|| panic!("{found:?} is not {reversed:?}"));
        reversed.remove(place);
    }
    found
}

#[test]
fn capsules_in_line_touch_at_their_ends() {
    // Turned by rounding either way, too.
    for turn in [0.0, 1e-15, -1e-15, 1e-13, -1e-13] {
        let found =
            contacts(&capsule(0.5, 2.0).into(), &at([0.0; 2], UP), &capsule(0.5, 1.0).into(), &at([2.4, 0.0], [1.0, turn]), 0.0);
        assert!(found.len() == 1 && (found[0].3 + 0.1).abs() < 1e-12 && (found[0].2[0] - 1.0).abs() < 1e-12, "{found:?}");
    }
}

#[test]
fn features_of_capsules_at_rest_do_not_flicker() {
    let arm: PlaneShape = capsule(0.5, 2.0).into();
    assert_steady(&arm, &at([0.0, 0.5], UP), &HalfPlane.into(), &at([0.0; 2], UP), &[0, 1]);
    assert_steady(&arm, &at([0.0, 0.0], UP), &arm, &at([0.0, 1.0], UP), &[0, 2]);
}

#[test]
fn a_capsule_that_is_nowhere_touches_nothing() {
    let nowhere = at([f64::NAN; 2], UP);
    for other in [PlaneShape::from(rectangle()), Disk { radius: 1.0 }.into(), HalfPlane.into(), capsule(1.0, 1.0).into()] {
        assert!(contacts(&capsule(1.0, 1.0).into(), &nowhere, &other, &at([0.0; 2], UP), 1.0).is_empty());
    }
}

fn any_shape() -> impl Strategy<Value = PlaneShape> {
    prop_oneof![
        (0.1..1.0_f64).prop_map(|radius| Disk { radius }.into()),
        (0.05..0.6_f64, 0.2..2.0_f64).prop_map(|(r, l)| capsule(r, l).into()),
        (0.2..2.0_f64, 0.2..2.0_f64).prop_map(|(w, h)| Polygon::rectangle(w, h).unwrap().into()),
        (0.2..1.5_f64, -0.5..0.5_f64).prop_map(|(w, x)| Polygon::new(vec![[-w, -0.3], [w, -0.4], [x, 0.8]]).unwrap().0.into()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gaps_are_distances(r in 0.05..0.6_f64, l in 0.2..2.0_f64, other in any_shape(), way in 0.0..6.3, far in 0.0..3.0, turn in 0.0..6.3) {
        let (arm, pose) = (PlaneShape::from(capsule(r, l)), at([0.3, -0.2], turned(0.4)));
        let place = at([0.3 + far * f64::cos(way), far * f64::sin(way) - 0.2], turned(turn));
        let found = touch_alike(&arm, &pose, &other, &place, 5.0);
        prop_assert!(!found.is_empty() && found.len() <= 2);
        let least = found.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        let (a, b) = (Outline::of(&arm, &pose), Outline::of(&other, &place));
        let inside = matches!(&other, PlaneShape::Polygon(p) if (0..2).any(|i| {
            let at = Plane::unrotate(place.rotation, [0, 1].map(|k| a.segments[0][i][k] - place.position[k]));
            p.sides().iter().all(|s| (0..2).map(|k| s.normal[k] * (at[k] - s.start[k])).sum::<f64>() < 0.0)
        }));
        if !a.crosses(&b) && !inside {
            // The cores are apart, whether or not the bodies are.
            let right = a.apart(&b);
            prop_assert!((least - right).abs() < 1e-8, "{least} is not {right}");
            for (_, point, n, gap) in &found {
                let side = |s: f64| [0, 1].map(|k| point[k] + 0.5 * s * gap * n[k]);
                prop_assert!((n[0].hypot(n[1]) - 1.0).abs() < 1e-12);
                if *gap < least + 1e-9 {
                    prop_assert!(a.distance(side(-1.0)).abs() < 1e-7 && b.distance(side(1.0)).abs() < 1e-7, "{found:?}");
                }
            }
        } else {
            // Moved apart by the depth along the normal they just touch.
            let n = found[0].2;
            let moved = at([0, 1].map(|k| place.position[k] - (least - 1e-6) * n[k]), place.rotation);
            let right = a.apart(&Outline::of(&other, &moved));
            prop_assert!((right - 1e-6).abs() < 1e-8, "after moving by {least}: {right} apart");
        }
    }
}
