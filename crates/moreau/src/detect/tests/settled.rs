//! How long the list of nearby pairs lasts where little moves, and that threads change nothing.

use super::*;

#[test]
fn turning_walls_keep_the_list_for_some_calls() {
    let mut scene = plane_scene(100, &mut Dice(4));
    let mut detector = Detector::<2>::new();
    let (mut found, mut expected, mut made) = (Vec::new(), Vec::new(), 0);
    for call in 0..300 {
        let (sin, cos) = (1e-3 * f64::from(call)).sin_cos();
        scene.1[3].rotation = [cos, sin];
        detector.detect::<Plane, 3>(&scene.0, &scene.1, &scene.2, driven, &mut found);
        Detector::new().detect::<Plane, 3>(&scene.0, &scene.1, &scene.2, driven, &mut expected);
        assert_eq!(found, expected, "call {call}");
        made += usize::from(detector.nearby.calls == 0);
    }
    assert!((10..100).contains(&made), "{made}");
}

/// Balls on a lattice in a box of five walls, in contact, that tremble.
fn trembling_box(side: usize, dice: &mut Dice) -> Scene<SolidShape, DQuat, 3> {
    let mut scene = Scene::default();
    for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0), (2, 1.0)] {
        let mut normal = [0.0; 3];
        normal[axis] = sign;
        let position = normal.map(|n: f64| if n < 0.0 { 2.0 * side as f64 - 1.0 } else { -1.0_f64 });
        let rotation = DQuat::from_rotation_arc(glam::DVec3::Z, normal.into());
        scene.0.push(HalfSpace.into());
        scene.1.push(Pose { position, rotation });
    }
    for i in 0..side.pow(3) {
        let site = [i / (side * side), i / side % side, i % side];
        scene.0.push(Ball::new(1.0).unwrap().into());
        scene.1.push(Pose { position: site.map(|x| 2.0 * x as f64 + 1e-4 * dice.roll()), rotation: DQuat::IDENTITY });
    }
    scene.2 = vec![1e-5; scene.0.len()];
    scene
}

#[test]
fn a_settled_box_makes_its_list_once() {
    let mut dice = Dice(11);
    let mut scene = trembling_box(6, &mut dice);
    let mut detector = Detector::<3>::new();
    let mut found = Vec::new();
    for call in 0..100 {
        for (body, pose) in scene.1.iter_mut().enumerate().skip(5) {
            pose.position = pose.position.map(|x| x + 1e-5 * (dice.roll() - 0.5));
            scene.2[body] = 1e-5 + 1e-9 * dice.roll();
        }
        detector.detect::<Solid, 6>(&scene.0, &scene.1, &scene.2, |i| i < 5, &mut found);
        assert_eq!(detector.nearby.calls, call);
        assert!(found.len() > 100);
    }
}

#[test]
fn threads_change_nothing() {
    let mut dice = Dice(12);
    let mut scene = trembling_box(22, &mut dice);
    let pools = [1, 2, 3].map(|threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap());
    let mut detectors = [0; 3].map(|_| (Detector::<3>::new(), Vec::new()));
    for _ in 0..4 {
        for pose in scene.1.iter_mut().skip(5) {
            pose.position = pose.position.map(|x| x + 0.1 * (dice.roll() - 0.5));
        }
        for ((detector, found), pool) in detectors.iter_mut().zip(&pools) {
            pool.install(|| detector.detect::<Solid, 6>(&scene.0, &scene.1, &scene.2, |i| i < 5, found));
        }
        let [(_, one), (_, two), (_, three)] = &detectors;
        assert!(one.len() > 5000 && one == two && two == three);
    }
}
