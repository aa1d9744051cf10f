//! 4, 5 and 6. From sliding to rolling, rolling down an incline, backspin.

use super::{close, plane, run, solid};
use moreau::space::Space;
use moreau::world::World;

const G: f64 = 9.81;
const MU: f64 = 0.3;
const RADIUS: f64 = 0.1;

/// Velocity along x and the time and place at which rolling begins: v = ω R to rounding.
fn to_rolling<S: Space<D, N>, const D: usize, const N: usize>(world: &mut World<S, D, N>, steps: u64) -> (f64, f64, f64) {
    let start = world.bodies.pose[1].position[0];
    let mut rolls = None;
    run(world, steps, |world, _, _| {
        let body = &world.bodies;
        let spin = S::spin_in_world(body.pose[1].rotation, &body.velocity[1]);
        // Rolling towards +x: about +y in space, about −z in the plane.
        let rim = if D == 3 { RADIUS * spin[1] } else { -RADIUS * spin[2] };
        if rolls.is_none() && (body.velocity[1][0] - rim).abs() < 1e-10 {
            rolls = Some((world.time, body.pose[1].position[0] - start));
        }
    });
    let (time, distance) = rolls.expect("it must come to rolling");
    (world.bodies.velocity[1][0], time, distance)
}

/// The slip ends within one step, in which the change from sliding to rolling is one impulse: times are off by h, distances by v h.
#[test]
fn a_sphere_rolls_at_five_sevenths() {
    let mut world = solid("04-sliding-to-rolling/scene.toml", &["bodies.1.velocity=[2.0, 0.0, 0.0]"]);
    let (v, h) = (2.0, world.settings.h);
    let (end, time, distance) = to_rolling(&mut world, 5000);
    close(end, 5.0 * v / 7.0, 1e-10, "velocity of rolling");
    close(time, 2.0 * v / (7.0 * MU * G), h, "time of sliding");
    close(distance, 12.0 * v * v / (49.0 * MU * G), v * h, "distance of sliding");
}

#[test]
fn a_disk_rolls_at_two_thirds() {
    let mut world = plane("04-sliding-to-rolling/scene-2d.toml", &["bodies.1.velocity=[2.0, 0.0]"]);
    let (v, h) = (2.0, world.settings.h);
    let (end, time, distance) = to_rolling(&mut world, 5000);
    close(end, 2.0 * v / 3.0, 1e-10, "velocity of rolling");
    close(time, v / (3.0 * MU * G), h, "time of sliding");
    close(distance, 5.0 * v * v / (18.0 * MU * G), v * h, "distance of sliding");
}

/// A constant acceleration is integrated exactly; what is left is the solver's tolerance over 10⁴ steps.
fn rolls_down<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>, part: f64, down: f64) {
    run(&mut world, 10_000, |_, _, _| {});
    close(world.bodies.velocity[1][0], part * down, 1e-9, "velocity after one second");
    close(world.bodies.pose[1].position[0], 0.5 * part * down, 1e-9, "distance after one second");
}

/// a = (5/7) g sin θ where μ ≥ (2/7) tan θ; gravity is turned instead of the floor: tan θ = 0.9, (2/7) tan θ = 0.257 < 0.3.
#[test]
fn a_sphere_rolls_down_at_five_sevenths_of_g_sin() {
    rolls_down(solid("05-rolling-down-incline/scene.toml", &["gravity=[4.5, 0.0, -5.0]"]), 5.0 / 7.0, 4.5);
}

/// a = (2/3) g sin θ where μ ≥ (1/3) tan θ: tan θ = 0.8, (1/3) tan θ = 0.267 < 0.3.
#[test]
fn a_disk_rolls_down_at_two_thirds_of_g_sin() {
    rolls_down(plane("05-rolling-down-incline/scene-2d.toml", &["gravity=[4.0, -5.0]"]), 2.0 / 3.0, 4.0);
}

/// Steeper, it slides: a = g (sin θ − μ cos θ).
#[test]
fn a_sphere_on_a_steep_incline_slides() {
    let mut world = solid("05-rolling-down-incline/scene.toml", &["gravity=[6.0, 0.0, -5.0]"]);
    run(&mut world, 1000, |_, _, _| {});
    close(world.bodies.velocity[1][0], (6.0 - MU * 5.0) * 0.1, 1e-10, "velocity after a tenth of a second");
}

/// Thrown at v with backspin ω it ends at (5v − 2Rω)/7, forwards or backwards.
#[test]
fn backspin_ends_at_five_v_less_two_r_omega_over_seven() {
    for (v, omega) in [(1.0, 10.0), (1.0, 60.0)] {
        let sets = [format!("bodies.1.velocity=[{v:?}, 0.0, 0.0]"), format!("bodies.1.spin=[0.0, {:?}, 0.0]", -omega)];
        let mut world = solid("06-backspin/scene.toml", &[&sets[0], &sets[1]]);
        let (end, _, _) = to_rolling(&mut world, 10_000);
        close(end, (5.0 * v - 2.0 * RADIUS * omega) / 7.0, 1e-9, "velocity of rolling");
    }
}
