mod moving;
mod settled;

use super::broad::tests::Dice;
use super::*;
use crate::contacts::ContactKey;
use crate::shape::Shape;
use crate::shape::plane::{Disk, HalfPlane, Polygon};
use crate::shape::solid::{Ball, Cuboid, HalfSpace};
use crate::shape::{PlaneShape, SolidShape};
use crate::space::{Plane, Solid};
use glam::DQuat;

type Scene<T, R, const D: usize> = (Vec<T>, Vec<Pose<R, D>>, Vec<f64>);

/// Every fifth body is driven.
fn driven(body: usize) -> bool {
    body.is_multiple_of(5)
}

fn brute_force<S: Space<D, N>, const D: usize, const N: usize>(scene: &Scene<S::Shape, S::Rotation, D>) -> Vec<Contact<D>> {
    let (shapes, poses, reach) = scene;
    let mut out = Vec::new();
    for i in 0..shapes.len() {
        for j in i + 1..shapes.len() {
            if driven(i) && driven(j) {
                continue;
            }
            S::Shape::collide(
                (&shapes[i], &poses[i]),
                (&shapes[j], &poses[j]),
                reach[i] + reach[j],
                &mut |feature, point, normal, gap| {
                    out.push(Contact { key: ContactKey { a: i as u32, b: j as u32, feature }, point, normal, gap });
                },
            );
        }
    }
    out
}

/// The contacts without those that seams hide, which is a question to all contacts of a body together.
fn mended<S: Space<D, N>, const D: usize, const N: usize>(
    (shapes, poses, reach): &Scene<S::Shape, S::Rotation, D>,
    mut contacts: Vec<Contact<D>>,
) -> Vec<Contact<D>> {
    let scene = super::Scene::<S, D, N> { shapes, poses, reach };
    let bounds: Vec<_> = (0..shapes.len()).map(|i| Bound::of(&scene, i)).collect();
    Seams::default().mend(&scene, &bounds, &driven, &mut contacts);
    contacts
}

fn detected<S: Space<D, N>, const D: usize, const N: usize>(scene: &Scene<S::Shape, S::Rotation, D>) -> Vec<Contact<D>> {
    let mut out = Vec::new();
    Detector::new().detect::<S, N>(&scene.0, &scene.1, &scene.2, driven, &mut out);
    out
}

/// Disks, polygons and two half-planes, radius ratio 100, somewhere around the origin.
fn plane_scene(count: usize, dice: &mut Dice) -> Scene<PlaneShape, [f64; 2], 2> {
    let mut scene = Scene::default();
    for body in 0..count {
        let size = 0.05 / (1.0 + 99.0 * dice.roll());
        scene.0.push(match body % 100 {
            3 | 50 => HalfPlane.into(),
            n if n % 3 == 0 => Polygon::new(vec![[0.0, 0.0], [size, 0.0], [1.5 * size, size], [0.0, size]]).unwrap().0.into(),
            _ => Disk::new(size).unwrap().into(),
        });
        let [x, y] = [dice.roll() - 0.5, dice.roll() - 0.5];
        let length = (x * x + y * y).sqrt();
        scene.1.push(Pose { position: [dice.roll() - 0.5, dice.roll() - 0.5], rotation: [x / length, y / length] });
        scene.2.push(0.01 * size);
    }
    scene
}

/// Balls, boxes and half-spaces, radius ratio 100.
fn solid_scene(count: usize, dice: &mut Dice) -> Scene<SolidShape, DQuat, 3> {
    let mut scene = Scene::default();
    for body in 0..count {
        let size = 0.1 / (1.0 + 99.0 * dice.roll());
        scene.0.push(match body % 100 {
            3 | 50 => HalfSpace.into(),
            n if n % 3 == 0 => Cuboid::new([size, 1.5 * size, 2.0 * size]).unwrap().into(),
            _ => Ball::new(size).unwrap().into(),
        });
        let mut centred = || dice.roll() - 0.5;
        let rotation = DQuat::from_xyzw(centred(), centred(), centred(), centred()).normalize();
        scene.1.push(Pose { position: [centred(), centred(), centred()], rotation });
        scene.2.push(0.01 * size);
    }
    scene
}

#[test]
fn contacts_of_the_plane_are_those_of_all_against_all_to_the_bit() {
    for seed in 0..5 {
        let scene = plane_scene(600, &mut Dice(seed));
        let expected = mended::<Plane, 2, 3>(&scene, brute_force::<Plane, 2, 3>(&scene));
        assert!(expected.len() > 1000);
        assert_eq!(detected::<Plane, 2, 3>(&scene), expected);
    }
}

#[test]
fn contacts_of_space_are_those_of_all_against_all_to_the_bit() {
    for seed in 0..5 {
        let scene = solid_scene(600, &mut Dice(seed));
        let expected = mended::<Solid, 3, 6>(&scene, brute_force::<Solid, 3, 6>(&scene));
        assert!(expected.len() > 1000);
        assert_eq!(detected::<Solid, 3, 6>(&scene), expected);
    }
}

#[test]
fn contacts_ascend_strictly_by_key_and_lie_within_reach() {
    let scene = solid_scene(600, &mut Dice(42));
    let contacts = detected::<Solid, 3, 6>(&scene);
    assert!(contacts.is_sorted_by(|x, y| x.key < y.key));
    for Contact { key, normal: [x, y, z], gap, .. } in contacts {
        assert!(key.a < key.b && gap <= scene.2[key.a as usize] + scene.2[key.b as usize]);
        assert!((x * x + y * y + z * z - 1.0).abs() < 1e-14);
    }
}

#[test]
fn bodies_that_are_nowhere_or_reach_everywhere_do_no_harm() {
    let mut scene = solid_scene(300, &mut Dice(9));
    scene.1[10].position[1] = f64::NAN;
    scene.1[50].position[0] = f64::NAN;
    scene.1[11].position = [f64::INFINITY; 3];
    scene.1[12].position = [1e12, -1e12, 1e12];
    scene.2[13] = f64::INFINITY;
    scene.2[14] = f64::NAN;
    scene.2[16] = -1e-3;
    scene.1[17].rotation = DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0);
    let contacts = detected::<Solid, 3, 6>(&scene);
    let nowhere = |body| [10, 11, 50].contains(&body);
    let mut expected = brute_force::<Solid, 3, 6>(&scene);
    expected.retain(|contact| !nowhere(contact.key.a) && !nowhere(contact.key.b));
    assert_eq!(contacts, mended::<Solid, 3, 6>(&scene, expected));
    assert!(contacts.iter().any(|contact| contact.key.b == 13), "an infinite reach reaches everything");
}

#[test]
fn what_a_detector_keeps_from_call_to_call_changes_nothing() {
    let mut detector = Detector::<2>::new();
    let mut out = Vec::new();
    for (seed, count) in [(1, 300), (2, 900), (3, 0), (4, 50)] {
        let scene = plane_scene(count, &mut Dice(seed));
        detector.detect::<Plane, 3>(&scene.0, &scene.1, &scene.2, driven, &mut out);
        assert_eq!(out, detected::<Plane, 2, 3>(&scene));
    }
}
