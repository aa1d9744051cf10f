//! 12. A hexagonal packing of disks between two stresses.

use moreau::run::{End, Task, run};
use moreau::scene::{AnyWorld, Scene};
use moreau::step::Workspace;
use std::fmt::Write;
use std::sync::atomic::AtomicBool;

const ROWS: usize = 7;
/// Disks in every second row, beginning with the lowest; one less in the others.
const LONG: usize = 8;
const DIAMETER: f64 = 0.1;

/// Disks with the loads of these stresses, N/m.
fn packing(vertical: f64, lateral: f64) -> String {
    let mut text = String::from(include_str!("../../../../validation/12-hexagonal-packing/scene.toml"));
    let height = 0.5 * 3.0_f64.sqrt() * DIAMETER;
    for row in 0..ROWS {
        let short = row % 2;
        let count = LONG - short;
        for i in 0..count {
            let (x, y) = (DIAMETER * (i as f64 + 0.5 * short as f64), 0.5 * DIAMETER + height * row as f64);
            let end = if i == 0 {
                1.0
            } else if i + 1 == count {
                -1.0
            } else {
                0.0
            };
            let outermost = if row == 0 || row + 1 == ROWS { 0.5 } else { 1.0 };
            let side = if short == 0 { end * outermost * 2.0 * height * lateral } else { 0.0 };
            let above = if row + 1 < ROWS {
                0.0
            } else if end == 0.0 {
                1.0
            } else {
                0.5
            };
            let down = -above * vertical * DIAMETER;
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "\n[[bodies]]\nmaterial = \"glass\"\nshape.disk.radius = {}\nposition = [{x:?}, {y:?}]\nforce = [{side:?}, {down:?}]",
                0.5 * DIAMETER
            );
        }
    }
    text
}

/// The greatest way that a disk went in a second, in diameters.
fn moved(ratio: f64) -> f64 {
    let scene = Scene::parse(&packing(ratio * 100.0, 100.0), "packing.toml").unwrap_or_else(|error| panic!("{error}"));
    let AnyWorld::Plane(mut world) = scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) else {
        panic!("of the plane")
    };
    let start: Vec<[f64; 2]> = world.bodies.pose.iter().map(|pose| pose.position).collect();
    let outcome =
        run(&mut world, &mut Workspace::default(), Task::new(scene.time.steps), &mut [], &AtomicBool::new(false), |_| {})
            .unwrap();
    assert!(outcome.end == End::Done && outcome.summary.unconverged() == 0, "{:?}", outcome.end);
    let way = |(pose, from): (&moreau::space::Pose<[f64; 2], 2>, [f64; 2])| {
        (pose.position[0] - from[0]).hypot(pose.position[1] - from[1])
    };
    world.bodies.pose.iter().zip(start).map(way).fold(0.0, f64::max) / DIAMETER
}

#[test]
fn a_hexagonal_packing_fails_where_one_stress_is_three_times_the_other() {
    let (below, above) = (moved(3.0 * 0.99), moved(3.0 * 1.01));
    assert!(below < 1e-9, "below the limit it moved by {below} diameters");
    assert!(above > 0.01, "above the limit it moved by {above} diameters only");
}
