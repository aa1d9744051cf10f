//! Convex polyhedra on each other and on boxes: gaps proved by what they mean. A normal along which two bodies are g apart proves that
//! they are no nearer; two of their points g apart along it prove that they are no farther. Of an overlap no direction is shorter.

use super::*;
use crate::shape::solid::{Faceted, Polyhedron};
use proptest::prelude::*;

fn contacts<A: Into<SolidShape> + Clone, B: Into<SolidShape> + Clone>(a: (&A, Pose), b: (&B, Pose), reach: f64) -> Vec<Found> {
    let mut found = Vec::new();
    let (shape_a, shape_b) = (a.0.clone().into(), b.0.clone().into());
    SolidShape::collide((&shape_a, &a.1), (&shape_b, &b.1), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    found
}

fn vertices<F: Faceted>((body, pose): (&F, Pose)) -> impl Iterator<Item = DVec3> + '_ {
    (0..body.vertices()).map(move |i| DVec3::from(pose.position) + pose.rotation * DVec3::from(body.vertex(i)))
}

/// How far apart along a direction.
fn apart<A: Faceted, B: Faceted>(a: (&A, Pose), b: (&B, Pose), n: DVec3) -> f64 {
    let end = vertices(a).map(|v| n.dot(v)).fold(f64::NEG_INFINITY, f64::max);
    vertices(b).map(|v| n.dot(v)).fold(f64::INFINITY, f64::min) - end
}

/// How far outside of a body a point is; negative inside.
fn outside<F: Faceted>((body, pose): (&F, Pose), p: DVec3) -> f64 {
    let p = pose.rotation.conjugate() * (p - DVec3::from(pose.position));
    let over = |face: usize| DVec3::from(body.normal(face)).dot(p - DVec3::from(body.vertex(usize::from(body.face(face)[0]))));
    (0..body.faces()).map(over).fold(f64::NEG_INFINITY, f64::max)
}

/// Checks the contacts of two bodies that all touch or are in reach; sizes are near 1.
fn proves<A: Faceted, B: Faceted>(a: (&A, Pose), b: (&B, Pose), found: &[Found], dice: &mut u64) {
    let level = 1e-8;
    assert!(!found.is_empty() && found.len() <= 4, "{found:?}");
    assert!(found.is_sorted_by(|p, q| p.0 < q.0));
    let &(_, p, n, gap) = found.iter().min_by(|p, q| p.3.total_cmp(&q.3)).unwrap();
    let (p, n) = (DVec3::from(p), DVec3::from(n));
    assert!((n.length() - 1.0).abs() < 1e-12);
    // Points of a face are kept where two edges have a normal that is 0.14 mrad from the face's; sizes are below 4.
    let along = apart(a, b, n) - gap;
    assert!(
        along < level && along > if found.len() > 1 { -6e-4 } else { -level },
        "along the normal they are {} apart, not {gap}",
        apart(a, b, n)
    );
    let (on_a, on_b) = (p - 0.5 * gap * n, p + 0.5 * gap * n);
    assert!(outside(a, on_a) < level && outside(b, on_b) < level, "{} {}", outside(a, on_a), outside(b, on_b));
    if gap < 0.0 {
        let mut roll = || {
            *dice = dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (*dice >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        // Directions everywhere, and near the one found.
        for k in 0..400 {
            let r = DVec3::new(roll(), roll(), roll());
            let other = if k < 200 { r.normalize() } else { (n + 0.1_f64.powi(k % 8) * r).normalize() };
            assert!(apart(a, b, other) < gap + 2.0 * level, "along {other} they overlap by less");
        }
    }
}

fn points() -> impl Strategy<Value = Vec<[f64; 3]>> {
    prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 4..24)
}

/// Corners on a ball: many faces of one size.
fn stone() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let on_ball = |v: [f64; 3]| DVec3::from(v).normalize().to_array();
    prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64).prop_map(on_ball), 8..40)
}

fn rotation() -> impl Strategy<Value = DQuat> {
    prop::array::uniform4(-1.0..1.0_f64).prop_filter_map("not zero", |q| {
        let q = DQuat::from_array(q);
        (q.length() > 0.1).then(|| q.normalize())
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gaps_of_polyhedra_are_proved(a in prop_oneof![points(), stone()], b in prop_oneof![points(), stone()], turns in (rotation(), rotation(), rotation()), far in 0.0..3.0_f64, seed: u64) {
        let (a, b) = (Polyhedron::hull(&a).unwrap().0, Polyhedron::hull(&b).unwrap().0);
        let pose_a = at([0.3, -0.2, 0.1], turns.0);
        let pose_b = at((DVec3::from(pose_a.position) + turns.2 * DVec3::X * far).to_array(), turns.1);
        let found = contacts((&a, pose_a), (&b, pose_b), 9.0);
        proves((&a, pose_a), (&b, pose_b), &found, &mut seed.clone());
        let back = contacts((&b, pose_b), (&a, pose_a), 9.0);
        let least = |found: &[Found]| found.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        prop_assert!((least(&found) - least(&back)).abs() < 1e-8);
    }

    #[test]
    fn gaps_of_polyhedra_and_boxes_are_proved(a in points(), half in prop::array::uniform3(0.1..1.0_f64), turns in (rotation(), rotation(), rotation()), far in 0.0..3.0_f64, seed: u64) {
        let (a, b) = (Polyhedron::hull(&a).unwrap().0, Cuboid { half });
        let (pose_a, pose_b) = (at([0.0; 3], turns.0), at((turns.2 * DVec3::X * far).to_array(), turns.1));
        let found = contacts((&a, pose_a), (&b, pose_b), 9.0);
        proves((&a, pose_a), (&b, pose_b), &found, &mut seed.clone());
        let mut flipped: Vec<Found> = contacts((&b, pose_b), (&a, pose_a), 9.0);
        flipped.iter_mut().for_each(|contact| contact.2 = contact.2.map(|x| -x));
        prop_assert_eq!(found, flipped);
    }

    #[test]
    fn a_polyhedron_over_a_half_space_has_its_lowest_corner_among_at_most_four(a in prop_oneof![points(), stone()], turns in (rotation(), rotation())) {
        let a = Polyhedron::hull(&a).unwrap().0;
        let (pose, wall) = (at([0.1, 0.2, 0.3], turns.0), at([-0.5, 0.0, 0.2], turns.1));
        let found = contacts((&a, pose), (&HalfSpace, wall), 9.0);
        let up = turns.1 * DVec3::Z;
        let height = |v: DVec3| up.dot(v - DVec3::from(wall.position));
        let lowest = vertices((&a, pose)).map(height).fold(f64::INFINITY, f64::min);
        let least = found.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        prop_assert!((least - lowest).abs() < 1e-12 && found.len() <= 4 && found.is_sorted_by(|p, q| p.0 < q.0));
        for (f, p, n, g) in found {
            let corner = DVec3::from(pose.position) + pose.rotation * DVec3::from(a.vertex(f as usize));
            prop_assert!((DVec3::from(p) - 0.5 * g * DVec3::from(n) * -1.0 - corner).length().min((DVec3::from(p) + 0.5 * g * up - corner).length()) < 1e-12);
            prop_assert!((DVec3::from(n) + up).length() < 1e-12);
        }
    }
}

/// A prism of this many sides, one high.
fn prism(sides: usize) -> Polyhedron {
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / sides as f64;
    let points: Vec<[f64; 3]> = (0..2 * sides).map(|i| [angle(i / 2).cos(), angle(i / 2).sin(), (i % 2) as f64]).collect();
    Polyhedron::hull(&points).unwrap().0
}

#[test]
fn prisms_of_many_sides_stand_on_each_other_on_four_points_that_do_not_flicker() {
    for sides in [5, 16, 40, 100] {
        let body = prism(sides);
        let mut first: Option<Vec<u64>> = None;
        for k in 0..200 {
            let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 1e-15;
            let turn = |seed: i32| DQuat::from_xyzw(tiny(seed), tiny(seed + 1), tiny(seed + 2), 1.0).normalize();
            let below = at([tiny(8), tiny(9), tiny(10)], turn(11));
            let found = contacts((&body, below), (&body, at([0.3 + tiny(1), 0.1 + tiny(2), 1.0 + tiny(3)], turn(4))), 1e-9);
            assert!(found.iter().all(|(_, _, n, g)| (n[2] - 1.0).abs() < 1e-12 && g.abs() < 1e-11), "{found:?}");
            let features: Vec<u64> = found.iter().map(|contact| contact.0).collect();
            assert!(features.len() == 4 && first.get_or_insert(features.clone()) == &features, "{sides}: {features:x?}");
            let ground = at([0.0, 0.0, -0.5], UP);
            let on_ground = contacts((&body, below), (&HalfSpace, ground), 1e-9);
            assert_eq!(on_ground.len(), 4, "{sides}");
        }
    }
}
