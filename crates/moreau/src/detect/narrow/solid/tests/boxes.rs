//! Boxes on boxes: against closed forms, and against distances found by trying all corners and edges.

use super::*;
use proptest::prelude::*;

/// The contacts of a with b.
fn contacts(a: Cuboid, pose_a: Pose, b: Cuboid, pose_b: Pose, reach: f64) -> Vec<Found> {
    let mut found = Vec::new();
    let (a, b) = (SolidShape::from(a), SolidShape::from(b));
    SolidShape::collide((&a, &pose_a), (&b, &pose_b), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    found
}

const CUBE: Cuboid = Cuboid { half: [1.0; 3] };

/// Points and features of a cube on a cube: normals up and this gap.
fn on_top(found: &[Found], gap: f64) -> Vec<[f64; 2]> {
    for (_, p, n, g) in found {
        assert!((n[2] - 1.0).abs() < 1e-12 && (g - gap).abs() < 1e-11 && (p[2] - 1.0 - 0.5 * gap).abs() < 1e-11, "{found:?}");
    }
    found.iter().map(|(_, p, ..)| [p[0], p[1]]).collect()
}

#[test]
fn a_cube_stands_on_a_cube_at_the_corners_of_what_they_share() {
    let found = contacts(CUBE, at([0.0; 3], UP), CUBE, at([0.5, 0.25, 1.9], UP), 0.0);
    let mut points = on_top(&found, -0.1);
    points.sort_by(|p, q| p.partial_cmp(q).unwrap());
    assert_eq!(points, [[-0.5, -0.75], [-0.5, 1.0], [1.0, -0.75], [1.0, 1.0]]);
    // A small cube within the face of a large one, and the large one on the small one.
    let small = Cuboid { half: [0.25; 3] };
    assert_eq!(on_top(&contacts(CUBE, at([0.0; 3], UP), small, at([0.3, 0.3, 1.25], UP), 0.0), 0.0).len(), 4);
    let found = contacts(small, at([0.3, 0.3, 0.75], UP), CUBE, at([0.0, 0.0, 2.0], UP), 0.0);
    assert!(found.len() == 4 && on_top(&found, 0.0).iter().all(|p| p.iter().all(|x| ((x - 0.3).abs() - 0.25).abs() < 1e-12)));
    // Turned by an eighth: of eight corners the four that are farthest out.
    let eighth = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_4);
    assert_eq!(on_top(&contacts(CUBE, at([0.0; 3], UP), CUBE, at([0.0, 0.0, 2.0], eighth), 1e-9), 0.0).len(), 4);
}

#[test]
fn features_of_boxes_at_rest_do_not_flicker() {
    for shift in [[0.0, 0.0], [0.7, 0.0], [0.7, 0.3]] {
        let mut first: Option<Vec<u64>> = None;
        for k in 0..200 {
            let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 1e-15;
            let turn = |seed: i32| DQuat::from_xyzw(tiny(seed), tiny(seed + 1), tiny(seed + 2), 1.0).normalize();
            let above = at([shift[0] + tiny(1), shift[1] + tiny(2), 2.0 + tiny(3)], turn(4));
            let found = contacts(CUBE, at([tiny(8), tiny(9), tiny(10)], turn(11)), CUBE, above, 1e-9);
            on_top(&found, 0.0);
            let features: Vec<u64> = found.iter().map(|contact| contact.0).collect();
            assert!(features.len() == 4 && first.get_or_insert(features.clone()) == &features, "{shift:?}: {features:x?}");
        }
    }
}

#[test]
fn what_touches_along_an_edge_touches_at_its_ends() {
    for (shift, ends) in [(0.0, [-1.0, 1.0]), (0.3, [-0.7, 1.0])] {
        let mut first: Option<(Vec<u64>, [f64; 3])> = None;
        for k in 0..200 {
            let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 1e-15;
            let turn = |seed: i32| DQuat::from_xyzw(tiny(seed), tiny(seed + 1), tiny(seed + 2), 1.0).normalize();
            let beside = at([2.0 + tiny(1), shift + tiny(2), 2.0 + tiny(3)], turn(4));
            let found = contacts(CUBE, at([tiny(8), tiny(9), tiny(10)], turn(11)), CUBE, beside, 1e-9);
            let features: Vec<u64> = found.iter().map(|contact| contact.0).collect();
            let (known, normal) = first.get_or_insert((features.clone(), found[0].2));
            assert!(features.len() == 2 && *known == features, "{shift}: {found:x?}");
            let mut along: Vec<f64> = found.iter().map(|(_, p, ..)| p[1]).collect();
            along.sort_by(f64::total_cmp);
            assert!(along.iter().zip(ends).all(|(y, end)| (y - end).abs() < 1e-11), "{shift}: {along:?}");
            let flat = |n: &[f64; 3]| (0..3).all(|i| (n[i] - normal[i]).abs() < 1e-11);
            assert!(found.iter().all(|(_, _, n, _)| flat(n)), "{shift}: {found:?}");
        }
    }
}

#[test]
fn edges_cross_at_one_point() {
    // One cube on its edge along x, another on its edge along y above it.
    let turned = |axis: DVec3| DQuat::from_axis_angle(axis, std::f64::consts::FRAC_PI_4);
    let found =
        contacts(CUBE, at([0.0; 3], turned(DVec3::X)), CUBE, at([0.2, 0.3, 2.0 * 2.0_f64.sqrt() - 0.1], turned(DVec3::Y)), 0.0);
    assert_eq!(found.len(), 1);
    let (_, p, n, g) = found[0];
    assert!((g + 0.1).abs() < 1e-14 && (n[2] - 1.0).abs() < 1e-14, "{found:?}");
    assert!((DVec3::from(p) - DVec3::new(0.2, 0.0, 2.0_f64.sqrt() - 0.05)).length() < 1e-13, "{found:?}");
}

#[test]
fn a_corner_stands_on_a_face_and_corners_have_the_direction_between_them() {
    let on_tip = DQuat::from_rotation_arc(DVec3::ONE.normalize(), DVec3::NEG_Z);
    let found = contacts(CUBE, at([0.0; 3], UP), CUBE, at([0.1, 0.2, 1.0 + 3.0_f64.sqrt() - 0.01], on_tip), 0.0);
    assert!(found.len() == 1 && (found[0].3 + 0.01).abs() < 1e-14 && (found[0].1[0] - 0.1).abs() < 1e-14, "{found:?}");
    let found = contacts(CUBE, at([0.0; 3], UP), CUBE, at([2.2, 2.3, 2.6], UP), 0.8);
    let n = DVec3::new(0.2, 0.3, 0.6) / 0.7;
    assert!(found.len() == 1 && (found[0].3 - 0.7).abs() < 1e-14 && (DVec3::from(found[0].2) - n).length() < 1e-14, "{found:?}");
}

/// A box with its axes and corners in the world, for the slow computations below.
struct Placed {
    half: DVec3,
    pose: Pose,
    axes: [DVec3; 3],
    corners: [DVec3; 8],
}

impl Placed {
    fn new(cuboid: Cuboid, pose: Pose) -> Self {
        let half = DVec3::from(cuboid.half);
        let sign = |i: usize, k: usize| if i >> k & 1 == 0 { -1.0 } else { 1.0 };
        let corner = |i: usize| half * DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2));
        Self {
            half,
            pose,
            axes: DVec3::AXES.map(|axis| pose.rotation * axis),
            corners: std::array::from_fn(|i| DVec3::from(pose.position) + pose.rotation * corner(i)),
        }
    }

    /// Returns the point of the box that is nearest to `x`.
    fn nearest(&self, x: DVec3) -> DVec3 {
        let local = self.pose.rotation.conjugate() * (x - DVec3::from(self.pose.position));
        DVec3::from(self.pose.position) + self.pose.rotation * local.clamp(-self.half, self.half)
    }

    fn edges(&self) -> impl Iterator<Item = [DVec3; 2]> {
        let ends = |i: usize, k: usize| (i >> k & 1 == 0).then(|| [self.corners[i], self.corners[i | 1 << k]]);
        (0..8).flat_map(move |i| (0..3).filter_map(move |k| ends(i, k)))
    }
}

/// Returns the greatest separation of two boxes over their normals and the cross products of their edges. It is negative where the boxes overlap:
/// then it is minus the length of the shortest translation that parts them.
fn separation(a: &Placed, b: &Placed) -> f64 {
    let crosses = a.axes.iter().flat_map(|u| b.axes.iter().map(|v| u.cross(*v).normalize_or_zero()));
    let directions = a.axes.into_iter().chain(b.axes).chain(crosses).filter(|n| *n != DVec3::ZERO).flat_map(|n| [n, -n]);
    let least = |of: &Placed, n: DVec3| of.corners.iter().map(|corner| n.dot(*corner)).fold(f64::INFINITY, f64::min);
    directions.map(|n| least(b, n) + least(a, -n)).fold(f64::NEG_INFINITY, f64::max)
}

/// Returns the distance of two boxes, 0 where they overlap. It is that of a corner of one to the other box or that of an edge of each, and all of
/// these are tried.
///
/// Alternating projections would be shorter and are wrong. Between two faces at a small angle α a projection reduces the error by a part of about α²,
/// so millions of them leave a distance that is too large.
fn distance(a: &Placed, b: &Placed) -> f64 {
    if separation(a, b) <= 0.0 {
        return 0.0;
    }
    let to_box =
        |from: &Placed, to: &Placed| from.corners.map(|x| x.distance(to.nearest(x))).into_iter().fold(f64::INFINITY, f64::min);
    let between = |[p, q]: [DVec3; 2], [r, e]: [DVec3; 2]| {
        let (u, v, w) = (q - p, e - r, r - p);
        let across = u.cross(v);
        // Parallel edges are nearest at an end too, and the ends are corners.
        let [s, t] = if across == DVec3::ZERO {
            [0.0; 2]
        } else {
            [v, u].map(|other| w.cross(other).dot(across) / across.length_squared())
        };
        (p + s.clamp(0.0, 1.0) * u).distance(r + t.clamp(0.0, 1.0) * v)
    };
    let edges = a.edges().flat_map(|one| b.edges().map(move |other| between(one, other)));
    edges.fold(to_box(a, b).min(to_box(b, a)), f64::min)
}

fn cuboid() -> impl Strategy<Value = Cuboid> {
    prop::array::uniform3(0.1..1.0_f64).prop_map(|half| Cuboid { half })
}

fn rotation() -> impl Strategy<Value = DQuat> {
    prop::array::uniform4(-1.0..1.0_f64).prop_filter_map("not zero", |[x, y, z, w]| {
        let q = DQuat::from_xyzw(x, y, z, w);
        (q.length() > 0.1).then(|| q.normalize())
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn gaps_are_distances(a in cuboid(), b in cuboid(), turn_a in rotation(), turn_b in rotation(), way in rotation(), far in 0.3..3.0_f64) {
        let pose_a = at([0.3, -0.2, 0.1], turn_a);
        let between: DVec3 = way * DVec3::X * far;
        let pose_b = at((DVec3::from(pose_a.position) + between).to_array(), turn_b);
        let found = contacts(a, pose_a, b, pose_b, 5.0);
        prop_assert!(!found.is_empty() && found.len() <= 4);
        let least = found.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        prop_assert!(found.iter().all(|(_, _, n, _)| (DVec3::from(*n).length() - 1.0).abs() < 1e-12));
        let placed = |shift: DVec3| Placed::new(b, at((DVec3::from(pose_b.position) + shift).to_array(), turn_b));
        let (first, second) = (Placed::new(a, pose_a), placed(DVec3::ZERO));
        let right = separation(&first, &second).min(0.0) + distance(&first, &second);
        // Of directions that are as good as each other to within what is level, a face comes first.
        let level = 2e-9 * (DVec3::from(a.half).length() + DVec3::from(b.half).length());
        prop_assert!((least - right).abs() < level, "the gap is {right} and not {least}");
        // Moved along the normal until they are a hundredth apart, they are.
        let normal = found.iter().min_by(|x, y| x.3.total_cmp(&y.3)).map(|contact| DVec3::from(contact.2));
        let moved = distance(&first, &placed((0.01 - least) * normal.unwrap()));
        prop_assert!((moved - 0.01).abs() < level, "{moved} is not 0.01; the gap was {least}");
        // The other way round the same.
        let back = contacts(b, pose_b, a, pose_a, 5.0);
        let other = back.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
        prop_assert!((least - other).abs() < 1e-8, "{least} but {other} the other way round");
    }
}
