use super::*;
use crate::shape::Shape;
use crate::shape::plane::{Disk, HalfPlane, Polygon};

mod capsules;
mod compounds;
mod outlines;
mod polygons;
mod polylines;

type Found = (u64, [f64; 2], [f64; 2], f64);

const UP: [f64; 2] = [1.0, 0.0];

fn at(position: [f64; 2], rotation: [f64; 2]) -> Pose {
    Pose { position, rotation }
}

/// A rectangle 2 wide and 4 high.
fn rectangle() -> Polygon {
    Polygon::new(vec![[-1.0, -2.0], [1.0, -2.0], [1.0, 2.0], [-1.0, 2.0]]).unwrap().0
}

/// Contacts in the order given; checks that the other order finds the same ones the other way round.
fn touch(a: impl Into<PlaneShape>, pose_a: Pose, b: impl Into<PlaneShape>, pose_b: Pose, reach: f64) -> Vec<Found> {
    let (a, b) = (a.into(), b.into());
    assert!(a.has_pair(&b) && b.has_pair(&a));
    let (mut found, mut reversed) = (Vec::new(), Vec::new());
    PlaneShape::collide((&a, &pose_a), (&b, &pose_b), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    PlaneShape::collide((&b, &pose_b), (&a, &pose_a), reach, &mut |f, p, n, g| reversed.push((f, p, n.map(|x| -x), g)));
    // Around one centre the fixed normal does not turn with the order.
    if !(0..2).all(|k| (pose_a.position[k] - pose_b.position[k]).abs() < 1e-100) || a.name() != b.name() {
        assert_eq!(found, reversed);
    }
    found
}

fn near(found: &[Found], expected: &[Found]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((f, p, n, g), (right_f, right_p, right_n, right_g)) in found.iter().zip(expected) {
        let close = |x: &[f64; 2], y: &[f64; 2]| x.iter().zip(y).all(|(x, y)| (x - y).abs() < 1e-14);
        assert!(f == right_f && close(p, right_p) && close(n, right_n) && (g - right_g).abs() < 1e-14, "{found:?}");
    }
}

#[test]
fn two_disks_touch_on_the_line_of_centres() {
    let found = touch(Disk { radius: 1.0 }, at([0.0; 2], UP), Disk { radius: 2.0 }, at([2.4, 3.2], UP), 1.0);
    near(&found, &[(0, [0.9, 1.2], [0.6, 0.8], 1.0)]);
    let found = touch(Disk { radius: 1.0 }, at([0.0; 2], UP), Disk { radius: 2.0 }, at([0.0; 2], UP), 0.0);
    near(&found, &[(0, [0.0, -0.5], [0.0, 1.0], -3.0)]);
}

#[test]
fn a_disk_over_a_tilted_half_plane() {
    // The normal is the y axis turned: (−sin φ, cos φ).
    let found = touch(Disk { radius: 0.5 }, at([0.4, 1.8], UP), HalfPlane, at([1.0, 1.0], [0.8, 0.6]), 0.6);
    near(&found, &[(0, [0.85, 1.2], [0.6, -0.8], 0.5)]);
}

#[test]
fn a_rectangle_stands_on_two_vertices() {
    let found = touch(rectangle(), at([0.0, 1.5], UP), HalfPlane, at([9.0, 0.0], UP), 0.1);
    near(&found, &[(0, [-1.0, -0.25], [0.0, -1.0], -0.5), (1, [1.0, -0.25], [0.0, -1.0], -0.5)]);
    // Lying on its side, its x axis up, it stands on the vertices of its left side.
    let found = touch(rectangle(), at([0.0, 1.0], [0.0, 1.0]), HalfPlane, at([0.0; 2], UP), 0.0);
    near(&found, &[(0, [2.0, 0.0], [0.0, -1.0], 0.0), (3, [-2.0, 0.0], [0.0, -1.0], 0.0)]);
}

#[test]
fn a_disk_outside_a_polygon_is_near_a_side_or_a_vertex() {
    let disk = Disk { radius: 1.0 };
    let origin = at([0.0; 2], UP);
    near(&touch(rectangle(), origin, disk, at([1.5, 1.0], UP), 0.0), &[(0, [0.75, 1.0], [1.0, 0.0], -0.5)]);
    near(&touch(rectangle(), origin, disk, at([-1.6, 2.8], UP), 0.1), &[(0, [-1.0, 2.0], [-0.6, 0.8], 0.0)]);
    let turned = at([5.0, 0.0], [0.0, 1.0]);
    near(&touch(rectangle(), turned, disk, at([7.5, 0.0], UP), 0.0), &[(0, [6.75, 0.0], [1.0, 0.0], -0.5)]);
}

#[test]
fn beyond_a_sharp_tip_the_tip_is_nearest() {
    let (needle, centre) = Polygon::new(vec![[0.0, -0.1], [10.0, 0.0], [0.0, 0.1]]).unwrap();
    for offset in [-0.5, 0.0, 0.5] {
        let disk = at([11.0 - centre[0], offset - centre[1]], UP);
        let length = (1.0 + offset * offset).sqrt();
        let found = touch(needle.clone(), at([0.0; 2], UP), Disk { radius: 1.0 }, disk, 1.0);
        assert!((found[0].3 - (length - 1.0)).abs() < 1e-14 && (found[0].2[1] - offset / length).abs() < 1e-14, "{found:?}");
    }
}

#[test]
fn a_disk_goes_through_the_side_of_a_polygon_without_a_jump() {
    for x in [0.9, 1.0 - 1e-15, 1.0, 1.0 + 1e-15, 1.1] {
        let found = touch(rectangle(), at([0.0; 2], UP), Disk { radius: 0.5 }, at([x, 0.3], UP), 0.0);
        near(&found, &[(0, [0.5 * (1.0 + x - 0.5), 0.3], [1.0, 0.0], x - 1.5)]);
    }
    let found = touch(rectangle(), at([0.0; 2], UP), Disk { radius: 0.5 }, at([1.0, 2.0], UP), 0.0);
    assert!(found[0].3 == -0.5 && found[0].2.map(f64::abs).iter().sum::<f64>() == 1.0, "{found:?}");
}

#[test]
fn a_body_that_is_nowhere_touches_nothing() {
    let nowhere = at([f64::NAN; 2], UP);
    assert!(touch(rectangle(), nowhere, Disk { radius: 1.0 }, at([0.0; 2], UP), 1.0).is_empty());
    assert!(touch(Disk { radius: 1.0 }, nowhere, HalfPlane, at([0.0; 2], UP), 1.0).is_empty());
}

#[test]
fn what_has_no_row_is_said() {
    let wall = PlaneShape::from(HalfPlane);
    assert!(!wall.has_pair(&wall));
}
