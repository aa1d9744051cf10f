use super::*;
use crate::shape::Shape;
use crate::shape::solid::{Ball, Capsule, Cuboid, Cylinder, HalfSpace};
use glam::{DQuat, DVec3};

mod boxes;
mod curved;
mod level;
mod polyhedra;
mod resting;
mod surfaces;

type Found = (u64, [f64; 3], [f64; 3], f64);

fn at(position: [f64; 3], rotation: DQuat) -> Pose {
    Pose { position, rotation }
}

/// Contacts in the order given; checks that the other order finds the same ones the other way round.
fn touch(a: impl Into<SolidShape>, pose_a: Pose, b: impl Into<SolidShape>, pose_b: Pose, reach: f64) -> Vec<Found> {
    let (a, b) = (a.into(), b.into());
    assert!(a.has_pair(&b) && b.has_pair(&a));
    let (mut found, mut reversed) = (Vec::new(), Vec::new());
    SolidShape::collide((&a, &pose_a), (&b, &pose_b), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    SolidShape::collide((&b, &pose_b), (&a, &pose_a), reach, &mut |f, p, n, g| reversed.push((f, p, n.map(|x| -x), g)));
    // Around one centre the fixed normal does not turn with the order.
    if !(0..3).all(|k| (pose_a.position[k] - pose_b.position[k]).abs() < 1e-100) || a.name() != b.name() {
        assert_eq!(found, reversed);
    }
    found
}

fn near(found: &[Found], expected: &[Found]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((f, p, n, g), (right_f, right_p, right_n, right_g)) in found.iter().zip(expected) {
        let close = |x: &[f64; 3], y: &[f64; 3]| (DVec3::from(*x) - DVec3::from(*y)).length() < 1e-14;
        assert!(f == right_f && close(p, right_p) && close(n, right_n) && (g - right_g).abs() < 1e-14, "{found:?}");
    }
}

const UP: DQuat = DQuat::IDENTITY;

#[test]
fn two_balls_touch_on_the_line_of_centres() {
    let (one, two) = (Ball { radius: 1.0 }, Ball { radius: 2.0 });
    let found = touch(one, at([0.0; 3], UP), two, at([0.0, 2.4, 3.2], UP), 1.0);
    near(&found, &[(0, [0.0, 0.9, 1.2], [0.0, 0.6, 0.8], 1.0)]);
    assert!(touch(one, at([0.0; 3], UP), two, at([0.0, 2.4, 3.2], UP), 0.99).is_empty());
}

#[test]
fn balls_around_one_centre_have_a_fixed_normal() {
    for apart in [0.0, 1e-200] {
        let found = touch(Ball { radius: 1.0 }, at([0.0; 3], UP), Ball { radius: 2.0 }, at([apart, 0.0, 0.0], UP), 0.0);
        near(&found, &[(0, [0.0, 0.0, -0.5], [0.0, 0.0, 1.0], -3.0)]);
    }
}

#[test]
fn a_ball_over_a_tilted_half_space() {
    let tilt = DQuat::from_rotation_arc(DVec3::Z, DVec3::new(0.6, 0.0, 0.8));
    let wall = at([1.0, 7.0, 1.0], tilt);
    let found = touch(Ball { radius: 0.5 }, at([1.6, 0.0, 1.8], UP), HalfSpace, wall, 0.6);
    near(&found, &[(0, [1.15, 0.0, 1.2], [-0.6, 0.0, -0.8], 0.5)]);
}

#[test]
fn a_box_stands_on_four_corners() {
    let cuboid = Cuboid::new([2.0, 4.0, 6.0]).unwrap();
    let found = touch(cuboid, at([0.0, 0.0, 2.5], UP), HalfSpace, at([0.0; 3], UP), 0.1);
    let down = [0.0, 0.0, -1.0];
    let corner = |f, x, y| (f, [x, y, -0.25], down, -0.5);
    near(&found, &[corner(0, -1.0, -2.0), corner(1, 1.0, -2.0), corner(2, -1.0, 2.0), corner(3, 1.0, 2.0)]);
    assert_eq!(touch(cuboid, at([0.0, 0.0, 3.0], UP), HalfSpace, at([0.0; 3], UP), 6.0).len(), 8);
}

#[test]
fn a_ball_outside_a_box_is_near_a_face_an_edge_or_a_corner() {
    let cuboid = Cuboid { half: [1.0, 2.0, 3.0] };
    let ball = Ball { radius: 1.0 };
    let s = 0.5_f64.sqrt();
    let quarter = DQuat::from_xyzw(0.0, 0.0, s, s); // x to y, y to −x
    let origin = at([0.0; 3], UP);
    near(&touch(cuboid, origin, ball, at([1.5, 1.0, 0.0], UP), 0.0), &[(0, [0.75, 1.0, 0.0], [1.0, 0.0, 0.0], -0.5)]);
    near(&touch(cuboid, origin, ball, at([1.6, -2.8, 0.5], UP), 0.1), &[(0, [1.0, -2.0, 0.5], [0.6, -0.8, 0.0], 0.0)]);
    let corner = touch(cuboid, origin, ball, at([2.0, 3.0, 4.0], UP), 1.0);
    let third = (1.0_f64 / 3.0).sqrt();
    let middle = 0.5 * (3.0_f64.sqrt() - 1.0) * third;
    near(&corner, &[(0, [1.0 + middle, 2.0 + middle, 3.0 + middle], [third; 3], 3.0_f64.sqrt() - 1.0)]);
    let turned = at([5.0, 0.0, 0.0], quarter);
    near(&touch(cuboid, turned, ball, at([7.5, 0.0, 0.0], UP), 0.0), &[(0, [6.75, 0.0, 0.0], [1.0, 0.0, 0.0], -0.5)]);
}

#[test]
fn a_ball_goes_through_the_face_of_a_box_without_a_jump() {
    let cuboid = Cuboid { half: [1.0, 2.0, 3.0] };
    let ball = Ball { radius: 0.5 };
    for height in [2.0, 2.9, 3.0 - 1e-15, 3.0, 3.0 + 1e-15, 3.0 + 1e-200, 3.1] {
        let found = touch(cuboid, at([0.0; 3], UP), ball, at([0.9, 0.0, height], UP), 0.0);
        if height > 2.95 {
            near(&found, &[(0, [0.9, 0.0, 0.5 * (3.0 + height - 0.5)], [0.0, 0.0, 1.0], height - 3.5)]);
        } else {
            near(&found, &[(0, [0.7, 0.0, height], [1.0, 0.0, 0.0], -0.6)]);
        }
    }
    // At the very centre, on an edge and on a corner the normal is a face's.
    for centre in [[0.0; 3], [1.0, 2.0, 0.0], [-1.0, 2.0, 3.0]] {
        let found = touch(cuboid, at([0.0; 3], UP), ball, at(centre, UP), 0.0);
        assert_eq!(found[0].2.map(f64::abs), [1.0, 0.0, 0.0]);
    }
}

#[test]
fn what_has_no_row_is_said_and_finds_nothing() {
    let wall = SolidShape::from(HalfSpace);
    assert!(!wall.has_pair(&wall));
    let pose = at([0.0; 3], UP);
    SolidShape::collide((&wall, &pose), (&wall, &pose), 1.0, &mut |_, _, _, _| unreachable!());
}

#[test]
fn a_body_that_is_nowhere_touches_nothing() {
    let nowhere = at([f64::NAN; 3], UP);
    assert!(touch(Cuboid { half: [1.0; 3] }, nowhere, Ball { radius: 1.0 }, at([0.0; 3], UP), 1.0).is_empty());
    assert!(touch(Ball { radius: 1.0 }, nowhere, Ball { radius: 1.0 }, at([0.0; 3], UP), 1.0).is_empty());
    assert!(touch(Cuboid { half: [1.0; 3] }, nowhere, HalfSpace, at([0.0; 3], UP), 1.0).is_empty());
}
