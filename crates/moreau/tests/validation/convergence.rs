//! `validation/13-order-of-convergence`: how errors go with the length of a step.

use moreau::convergence::study;
use moreau::scene::Scene;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// The orders in position, velocity and energy that four runs tell at their end.
fn orders(file: &str, theta: f64) -> [f64; 3] {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../validation/13-order-of-convergence").join(file);
    let scene = Scene::load_with(&path, &[format!("time.theta={theta}")]).unwrap_or_else(|error| panic!("{error}"));
    let levels = study(&scene, 3, u64::MAX, &AtomicBool::new(false), |_| {}).unwrap();
    assert!(levels.iter().all(|level| level.unconverged == 0) && levels.len() == 4);
    let [.., coarse, fine] = levels.as_slice() else { panic!("four runs") };
    coarse.difference.unwrap().orders(&fine.difference.unwrap())
}

#[track_caller]
fn near(orders: &[f64], expected: f64, tolerance: f64) {
    assert!(orders.iter().all(|order| (order - expected).abs() <= tolerance), "{orders:?}, not {expected}");
}

#[test]
fn smooth_motion_is_of_second_order_for_a_half_and_of_first_for_one() {
    near(&orders("smooth.toml", 0.5), 2.0, 0.1);
    near(&orders("smooth.toml", 1.0), 1.0, 0.1);
}

#[test]
fn impacts_are_of_first_order() {
    for theta in [0.5, 1.0] {
        near(&orders("impacts.toml", theta)[..2], 1.0, 0.2);
    }
}
