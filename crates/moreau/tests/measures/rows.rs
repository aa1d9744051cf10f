//! `measures.csv`.

use super::*;
use moreau::measure::{extent, mean_stress, solid_fraction, stress_in};
use moreau::observe::{MeasuresCsv, Observer};
use moreau::run::{Task, run};
use std::sync::atomic::AtomicBool;

#[test]
fn a_row_comes_as_often_as_asked_and_says_what_the_functions_say() {
    let floor = "shape.half_plane = { normal = [0.0, 1.0] }\nposition = [0.0, 0.0]".to_owned();
    let mut world = plane([0.0, -10.0], &[floor, disk([0.0, 0.1], 0.1), disk([0.0, 0.3], 0.1)]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("measures.csv");
    let mut work = Workspace::default();
    let mut observers: Vec<Box<dyn Observer<Plane, 2, 3>>> = vec![Box::new(MeasuresCsv::create(&path, 2, 2).unwrap())];
    run(&mut world, &mut work, Task::new(6), &mut observers, &AtomicBool::new(false), |_| {}).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let (header, rows) = text.split_once('\n').unwrap();
    let stress = "stress_xx,stress_xy,stress_yx,stress_yy,pressure";
    let before = "step,time,coordination,coordination_without_rattlers,solid_fraction,fabric_anisotropy";
    assert_eq!(header, format!("{before},{stress},mean_normal_force,sliding_share"));
    let rows: Vec<Vec<f64>> =
        rows.lines().map(|row| row.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.iter().map(|row| row[0]).collect::<Vec<_>>(), [2.0, 4.0, 6.0]);

    let region = extent(&world.bodies).unwrap();
    let stress = stress_in(&world, work.contacts(), 1e-3, &region);
    let weight = 10.0 * world.bodies.mass[1][0];
    let mut right = vec![6.0, 6e-3, 1.5, 0.0, solid_fraction(&world, &region), 1.0];
    right.extend(stress.as_flattened().iter().chain(&[mean_stress(&stress), 1.5 * weight, 0.0]));
    assert_eq!(rows[2].len(), right.len());
    for (found, right) in rows[2].iter().zip(&right) {
        assert!((found - right).abs() <= 1e-9 * right.abs() + 1e-9, "{:?} {right:?}", rows[2]);
    }
    assert!((rows[2][4] - std::f64::consts::PI / 4.0).abs() < 1e-9);
}
