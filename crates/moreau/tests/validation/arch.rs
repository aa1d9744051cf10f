//! 10. A semicircular arch of equal stones with radial joints.

use super::close;
use moreau::run::{End, run};
use moreau::scene::{AnyWorld, Scene};
use moreau::step::Workspace;
use std::f64::consts::PI;
use std::fmt::Write;
use std::sync::atomic::AtomicBool;

/// The scene of an arch with mean radius 1 m on a floor: n stones of this thickness, m.
fn arch(n: usize, thickness: f64) -> String {
    let mut text = String::from(include_str!("../../../../validation/10-arch/scene.toml"));
    let (inner, outer) = (1.0 - 0.5 * thickness, 1.0 + 0.5 * thickness);
    for i in 0..n {
        let at = |joint: usize, r: f64| {
            let angle = PI * joint as f64 / n as f64;
            // The feet stand on the floor exactly.
            let height = if joint == 0 || joint == n { 0.0 } else { r * angle.sin() };
            format!("[{:?}, {height:?}]", r * angle.cos())
        };
        let vertices = [at(i, inner), at(i, outer), at(i + 1, outer), at(i + 1, inner)].join(", ");
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "\n[[bodies]]\nname = \"stone {i}\"\nmaterial = \"stone\"\nposition = [0.0, 0.0]\nshape.polygon = {{ vertices = [{vertices}] }}"
        );
    }
    text
}

/// Whether the arch still stands after two seconds.
fn stands(n: usize, thickness: f64) -> bool {
    let scene = Scene::parse(&arch(n, thickness), "arch.toml").unwrap_or_else(|error| panic!("{error}"));
    let AnyWorld::Plane(mut world) = scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) else {
        panic!("of the plane")
    };
    let start: Vec<f64> = world.bodies.pose.iter().map(|pose| pose.position[1]).collect();
    let outcome = run(&mut world, &mut Workspace::default(), scene.time.steps, &mut [], &AtomicBool::new(false), |_| {}).unwrap();
    assert!(outcome.end == End::Done, "{:?}", outcome.end);
    let sunk = world.bodies.pose.iter().zip(start).map(|(pose, y)| (y - pose.position[1]).abs()).fold(0.0, f64::max);
    sunk < 1e-7
}

/// The least thickness over mean radius at which an arch stands, by bisection between three parts in a hundred below and above of what statics
/// says of stones with straight sides; see the folder.
///
/// One that stands moves by the error of the solver, some 1e-11 m; one that is a ten-thousandth too thin is pushed out of balance by about a
/// ten-thousandth of its weight, and moves by 1e-4 m in two seconds. What is left is the width of the last step of the bisection.
#[test]
fn an_arch_stands_above_its_least_thickness_and_falls_below() {
    for (n, least) in [(7, 0.095_703), (15, 0.106_068), (25, 0.106_959)] {
        let (mut falls, mut stood) = (0.97 * least, 1.03 * least);
        assert!(stands(n, stood) && !stands(n, falls), "{n} stones");
        while stood - falls > 6e-4 * least {
            let middle = 0.5 * (falls + stood);
            if stands(n, middle) { stood = middle } else { falls = middle }
        }
        close(0.5 * (falls + stood), least, 1e-3 * least, "least thickness");
    }
}
