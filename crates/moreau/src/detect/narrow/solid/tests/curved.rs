//! Capsules and cylinders against everything convex, in thousands of random places.
//!
//! A gap between bodies that are apart is proved from both sides: no two of their points are nearer, because along the normal they
//! are so far apart, and two of them are as near, those on both sides of the point of contact. Of bodies that overlap the normal
//! proves that the depth is enough to part them; that no other direction does with less is tried out on a sphere of directions.

use super::*;
use crate::shape::solid::{Edge, Faceted};
use rand::RngExt;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// A body as these tests know it: its greatest coordinate along a direction, and how far a point is outside (not above 0 inside).
#[derive(Clone, Debug)]
struct Body {
    form: Form,
    pose: Pose,
}

#[derive(Clone, Debug)]
enum Form {
    Shape(SolidShape),
    /// With two faces that lie on each other, as the triangles of a mesh.
    Triangle([[f64; 3]; 3]),
}

impl Faceted for [[f64; 3]; 3] {
    fn vertices(&self) -> usize {
        3
    }

    fn vertex(&self, i: usize) -> [f64; 3] {
        self[i]
    }

    fn faces(&self) -> usize {
        2
    }

    fn normal(&self, i: usize) -> [f64; 3] {
        let [p, q, r] = self.map(DVec3::from);
        ((q - p).cross(r - p).normalize() * if i == 0 { 1.0 } else { -1.0 }).to_array()
    }

    fn face(&self, i: usize) -> &[u16] {
        [&[0, 1, 2], &[0, 2, 1]][i]
    }

    fn edges(&self) -> &[Edge] {
        const { &[Edge { ends: [0, 1], faces: [0, 1] }, Edge { ends: [1, 2], faces: [0, 1] }, Edge { ends: [2, 0], faces: [0, 1] }] }
    }

    fn radius(&self) -> f64 {
        self.iter().map(|&v| DVec3::from(v).length()).fold(0.0, f64::max)
    }

    fn inner(&self) -> f64 {
        // Its origin may be anywhere.
        f64::NEG_INFINITY
    }
}

impl Body {
    fn height(&self, direction: DVec3) -> f64 {
        let n = self.pose.rotation.conjugate() * direction;
        direction.dot(self.pose.position.into())
            + match &self.form {
                Form::Shape(SolidShape::Ball(ball)) => ball.radius,
                Form::Shape(SolidShape::Cuboid(cuboid)) => DVec3::from(cuboid.half).dot(n.abs()),
                Form::Shape(SolidShape::Capsule(capsule)) => capsule.radius + capsule.half * n.z.abs(),
                Form::Shape(SolidShape::Cylinder(cylinder)) => cylinder.radius * n.x.hypot(n.y) + cylinder.half * n.z.abs(),
                Form::Triangle(triangle) => triangle.map(|v| n.dot(v.into())).into_iter().fold(f64::NEG_INFINITY, f64::max),
                Form::Shape(_) => unreachable!("of other bodies"),
            }
    }

    fn outside(&self, point: DVec3) -> f64 {
        let x = self.pose.rotation.conjugate() * (point - DVec3::from(self.pose.position));
        match &self.form {
            Form::Shape(SolidShape::Ball(ball)) => x.length() - ball.radius,
            Form::Shape(SolidShape::Cuboid(cuboid)) => (x.abs() - DVec3::from(cuboid.half)).max_element(),
            Form::Shape(SolidShape::Capsule(capsule)) => {
                (x - DVec3::new(0.0, 0.0, x.z.clamp(-capsule.half, capsule.half))).length() - capsule.radius
            }
            Form::Shape(SolidShape::Cylinder(cylinder)) => (x.x.hypot(x.y) - cylinder.radius).max(x.z.abs() - cylinder.half),
            Form::Triangle(triangle) => {
                let [p, q, r] = triangle.map(DVec3::from);
                let n = DVec3::from(triangle.normal(0));
                let beyond = |p: DVec3, q: DVec3| (q - p).normalize().cross(n).dot(x - p);
                n.dot(x - p).abs().max(beyond(p, q)).max(beyond(q, r)).max(beyond(r, p))
            }
            Form::Shape(_) => unreachable!("of other bodies"),
        }
    }

    fn size(&self) -> f64 {
        match &self.form {
            Form::Shape(shape) => shape.bounding_radius().unwrap(),
            Form::Triangle(triangle) => triangle.radius(),
        }
    }
}

/// How far two bodies are apart along a unit vector.
fn apart(a: &Body, b: &Body, n: DVec3) -> f64 {
    -b.height(-n) - a.height(n)
}

fn contacts(a: &Body, b: &Body, reach: f64) -> Vec<Found> {
    let mut found = Vec::new();
    let mut emit = |f, p, n, g| found.push((f, p, n, g));
    match (&a.form, &b.form) {
        (Form::Shape(one), Form::Shape(two)) => SolidShape::collide((one, &a.pose), (two, &b.pose), reach, &mut emit),
        (Form::Shape(SolidShape::Ball(one)), Form::Triangle(two)) => {
            ball_facets::collide((one, &a.pose), (two, &b.pose), reach, &mut emit);
        }
        (Form::Shape(SolidShape::Capsule(one)), Form::Triangle(two)) => {
            capsule_facets::collide((one, &a.pose), (two, &b.pose), reach, &mut emit);
        }
        (Form::Shape(SolidShape::Cylinder(one)), Form::Triangle(two)) => {
            cylinder_facets::collide((one, &a.pose), (two, &b.pose), reach, &mut emit);
        }
        _ => return contacts(b, a, reach).into_iter().map(|(f, p, n, g)| (f, p, n.map(|x| -x), g)).collect(),
    }
    found
}

/// One of two lengths, mostly a few times the other and sometimes a thousand times.
fn length(dice: &mut Pcg64Mcg) -> f64 {
    let decades = if dice.random_bool(0.1) { 1.5 } else { 0.4 };
    10.0_f64.powf(dice.random_range(-decades..decades))
}

/// Ball, box, triangle, capsule, cylinder.
const KINDS: usize = 5;

fn form(kind: usize, dice: &mut Pcg64Mcg) -> Form {
    if kind == 2 {
        loop {
            let corners = [(); 3].map(|()| rotation(dice) * DVec3::X * length(dice));
            let centre = corners.into_iter().sum::<DVec3>() / 3.0;
            let [p, q, r] = corners.map(|v| v - centre);
            // A needle has no normal to speak of.
            if (q - p).cross(r - p).length() > 0.01 * (q - p).length() * (r - p).length() {
                return Form::Triangle([p, q, r].map(|v| v.to_array()));
            }
        }
    }
    let mut length = || length(dice);
    Form::Shape(match kind {
        0 => Ball { radius: length() }.into(),
        1 => Cuboid { half: [length(), length(), length()] }.into(),
        3 => Capsule { radius: length(), half: length() }.into(),
        _ => Cylinder { radius: length(), half: length() }.into(),
    })
}

/// Any rotation, or one of those that put axes along each other or at half a right angle, up to a small turn or none.
fn rotation(dice: &mut Pcg64Mcg) -> DQuat {
    if dice.random_bool(0.4) {
        let mut eighths = || std::f64::consts::FRAC_PI_4 * f64::from(dice.random_range(0..8));
        let turned = DQuat::from_rotation_z(eighths()) * DQuat::from_rotation_x(eighths()) * DQuat::from_rotation_z(eighths());
        let small = if dice.random_bool(0.5) { 10.0_f64.powf(dice.random_range(-14.0..-2.0)) } else { 0.0 };
        return turned * DQuat::from_rotation_x(small);
    }
    loop {
        let q = DQuat::from_array(std::array::from_fn(|_| dice.random_range(-1.0..1.0)));
        if q.length() > 0.1 {
            return q.normalize();
        }
    }
}

/// Two bodies that are apart along some direction by -0.5 to 0.5 of the smaller one's size, or by much less.
fn pair(kinds: [usize; 2], dice: &mut Pcg64Mcg) -> [Body; 2] {
    let way = rotation(dice) * DVec3::X;
    let [a, b] = kinds.map(|kind| Body { form: form(kind, dice), pose: at([0.0; 3], rotation(dice)) });
    let part = if dice.random_bool(0.3) { 10.0_f64.powf(dice.random_range(-12.0..0.0)) } else { 1.0 };
    let far = part * dice.random_range(-0.5..0.5) * a.size().min(b.size()) - apart(&a, &b, way);
    let position = if dice.random_bool(0.1) { [0.3, -0.2, 0.1] } else { [0.0; 3] };
    let pose = at((DVec3::from(position) + far * way).to_array(), b.pose.rotation);
    [Body { pose: at(position, a.pose.rotation), ..a }, Body { pose, ..b }]
}

/// The best direction of a sphere of them, made better by small turns, each less than the one before.
fn best_by_search(a: &Body, b: &Body, dice: &mut Pcg64Mcg) -> f64 {
    let mut sphere: Vec<(f64, DVec3)> = Vec::new();
    for _ in 0..1500 {
        let n = rotation(dice) * DVec3::Z;
        sphere.push((apart(a, b, n), n));
    }
    sphere.sort_by(|(s, _), (t, _)| t.total_cmp(s));
    let mut best = f64::NEG_INFINITY;
    for &(mut s, mut n) in sphere.iter().take(6) {
        let mut turn = 0.1;
        while turn > 1e-10 {
            let mut better = false;
            for _ in 0..12 {
                let to = DVec3::from_array(std::array::from_fn(|_| dice.random_range(-1.0..1.0)));
                let m = (n + turn * to).normalize();
                if apart(a, b, m) > s {
                    (s, n, better) = (apart(a, b, m), m, true);
                }
            }
            if !better {
                turn *= 0.6;
            }
        }
        best = best.max(s);
    }
    best
}

/// Checks one pair; `search` says whether to look for better directions.
fn check(a: &Body, b: &Body, search: bool, dice: &mut Pcg64Mcg) {
    let size = a.size() + b.size();
    let found = contacts(a, b, size);
    let place = || format!("{a:?}\n{b:?}\n{found:?}");
    assert!(!found.is_empty() && found.len() <= 4, "{}", place());
    let least = found.iter().min_by(|x, y| x.3.total_cmp(&y.3)).unwrap();
    let (gap, n) = (least.3, DVec3::from(least.2));
    // Points of a face are kept where two edges have a normal that is 0.14 mrad from the face's.
    let below = if found.len() > 1 { 1.5e-4 } else { 2e-9 } * size;
    let along = apart(a, b, n) - gap;
    assert!(along < 2e-9 * size && along > -below, "{} along the normal, not {gap}: {}", apart(a, b, n), place());
    for &(f, p, n, g) in &found {
        let (p, n) = (DVec3::from(p), DVec3::from(n));
        assert!((n.length() - 1.0).abs() < 1e-12 && f < 1 << 32, "{}", place());
        let [on_a, on_b] = [p - 0.5 * g * n, p + 0.5 * g * n];
        let off = a.outside(on_a).max(b.outside(on_b));
        assert!(off < 2e-9 * size, "{f:x} is {off} outside: {}", place());
    }
    assert!(found.windows(2).all(|two| two[0].0 < two[1].0), "features ascend: {}", place());
    if search && gap < 0.0 {
        let better = best_by_search(a, b, dice);
        assert!(better < gap + 1e-8 * size, "{better} would be better than {gap}: {}", place());
    }
    let back = contacts(b, a, size);
    let other = back.iter().map(|contact| contact.3).fold(f64::INFINITY, f64::min);
    assert!((gap - other).abs() < 1e-8 * size, "{gap} but {other} the other way round: {}", place());
}

fn check_all(seed: u64, count: usize, search: bool) {
    let mut dice = Pcg64Mcg::seed_from_u64(seed);
    for first in 0..KINDS {
        for second in 3..KINDS {
            for _ in 0..count {
                let [a, b] = pair([first, second], &mut dice);
                check(&a, &b, search, &mut dice);
            }
        }
    }
}

#[test]
fn gaps_and_depths_are_enough_and_points_lie_on_both_bodies() {
    check_all(1, 5000, false);
}

/// Balls have one pair with all that has flat faces; on a box there is a shorter way.
#[test]
fn balls_meet_triangles() {
    let mut dice = Pcg64Mcg::seed_from_u64(4);
    for round in 0..5000 {
        let [a, b] = pair([0, 2], &mut dice);
        check(&a, &b, round % 10 == 0, &mut dice);
    }
}

#[test]
fn no_direction_parts_bodies_with_less() {
    check_all(2, 200, true);
}

/// The way of faces of any number on the box, which has a shorter one of its own.
#[test]
fn a_ball_on_faces_is_a_ball_on_a_box() {
    let mut dice = Pcg64Mcg::seed_from_u64(3);
    for _ in 0..5000 {
        let [a, b] = pair([0, 1], &mut dice);
        let (Form::Shape(SolidShape::Ball(ball)), Form::Shape(SolidShape::Cuboid(cuboid))) = (&a.form, &b.form) else {
            unreachable!()
        };
        let mut found = Vec::new();
        ball_facets::collide((ball, &a.pose), (cuboid, &b.pose), a.size() + b.size(), &mut |f, p, n, g| found.push((f, p, n, g)));
        let right = contacts(&a, &b, a.size() + b.size());
        let size = a.size() + b.size();
        let near = |x: [f64; 3], y: [f64; 3]| (DVec3::from(x) - DVec3::from(y)).length() < 1e-9 * size;
        assert!(
            found.len() == 1 && near(found[0].1, right[0].1) && (found[0].3 - right[0].3).abs() < 1e-12 * size,
            "{found:?} {right:?}"
        );
    }
}
