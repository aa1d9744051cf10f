//! 11. Three cylinders.

use super::{plane, run};

/// By how much the top cylinder sinks in two seconds, m.
fn sinks(between: f64, on_floor: f64) -> f64 {
    let sets = [format!("default_law.coulomb.friction={between}"), format!("laws.0.law.coulomb.friction={on_floor}")];
    let mut world = plane("11-three-cylinders/scene.toml", &sets.each_ref().map(String::as_str));
    let start = world.bodies.pose[3].position[1];
    run(&mut world, 2000, |_, _, _| {});
    start - world.bodies.pose[3].position[1]
}

/// It stands only if μ ≥ 2 − √3 between cylinders and μ ≥ (2 − √3)/3 on the floor: each end of a contact between two cylinders is 15 degrees
/// from where it would slide, and the floor carries three times what the top one presses through it.
///
/// Two parts in a hundred above both limits it stands; that much below one of them, the other one far above, it falls. Standing is exact
/// up to the tolerance of the solver, 1e-10 of the velocities, in each of 2 000 steps. Falling, the forces that are missing
/// are some hundredths of the weight, so that in two seconds it sinks by centimetres.
#[test]
fn three_cylinders_stand_if_both_frictions_are_enough() {
    let limit = 2.0 - 3.0_f64.sqrt();
    let stood = sinks(1.02 * limit, 1.02 * limit / 3.0);
    assert!(stood.abs() < 1e-9, "it sank by {stood} m");
    for (between, on_floor) in [(0.98 * limit, limit), (2.0 * limit, 0.98 * limit / 3.0)] {
        let sank = sinks(between, on_floor);
        assert!(sank > 0.01, "at {between} and {on_floor} it sank by {sank} m only");
    }
}
