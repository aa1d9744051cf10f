//! 2 and 3. Blocks that slide, stick and topple.

use super::{close, plane, run, solid};
use moreau::space::Space;
use moreau::world::World;

const G: f64 = 9.81;

/// v = 6 m/s, μ = 0.5: stops after t = v/(μ g), d = v²/(2 μ g) = 3.670 m, and never lifts off by a micrometre.
fn slides_and_stops<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>) {
    let (v, mu, up, h) = (6.0, 0.5, D - 1, world.settings.h);
    let start = world.bodies.pose[1].position;
    let (mut lift, mut moving) = (0.0_f64, 0.0);
    run(&mut world, 15_000, |world, _, _| {
        lift = lift.max(world.bodies.pose[1].position[up] - start[up]);
        if world.bodies.velocity[1][0] > 1e-9 {
            moving = world.time;
        }
    });
    // In each step the block loses exactly μ g h, so it stops within the step that holds v/(μ g): off by h, and by v h with v < μ g h.
    close(moving, v / (mu * G), h, "time of sliding");
    close(world.bodies.pose[1].position[0] - start[0], v * v / (2.0 * mu * G), mu * G * h * h, "distance of sliding");
    assert!(lift <= 1e-9, "it lifted off by {lift} m");
    close(world.bodies.velocity[1][0], 0.0, 1e-12, "velocity at the end");
}

#[test]
fn a_box_slides_three_metres_sixty_seven() {
    slides_and_stops(solid("02-sliding-block/scene.toml", &[]));
}

#[test]
fn a_polygon_slides_three_metres_sixty_seven() {
    slides_and_stops(plane("02-sliding-block/scene-2d.toml", &[]));
}

/// tan θ ≤ μ: no creep in a million steps.
///
/// The velocity that the solver leaves is of the order of rounding, 1e-17 m/s. Were all of it to one side it would come to
/// 1e-14 m in the thousand seconds of the run; a solver that left its tolerance of a usual 1e-7 m/s would come to 1e-4 m.
fn sticks<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>, steps: u64) {
    let start = world.bodies.pose[1];
    run(&mut world, steps, |_, _, _| {});
    let end = world.bodies.pose[1];
    for k in 0..D {
        close(end.position[k], start.position[k], 1e-14, "creep");
    }
    let turned: f64 = S::quaternion(end.rotation).iter().zip(S::quaternion(start.rotation)).map(|(a, b)| (a - b).abs()).sum();
    close(turned, 0.0, 1e-14, "turning");
}

#[test]
fn a_polygon_on_an_incline_does_not_creep_in_a_million_steps() {
    sticks(plane("03-block-on-incline/scene-2d.toml", &[]), 1_000_000);
}

#[test]
fn a_box_on_an_incline_does_not_creep_in_a_million_steps() {
    sticks(solid("03-block-on-incline/scene.toml", &[]), 1_000_000);
}

/// tan θ > μ: a = g (sin θ − μ cos θ). The scheme integrates a constant acceleration exactly, so only rounding is left.
#[test]
fn a_block_on_a_steep_incline_slides() {
    let mut world = plane("03-block-on-incline/scene-2d.toml", &["default_law.coulomb.friction=0.3"]);
    run(&mut world, 1000, |_, _, _| {});
    let theta = 0.45_f64.atan();
    let speed = world.bodies.velocity[1][0].hypot(world.bodies.velocity[1][1]);
    close(speed, G * (theta.sin() - 0.3 * theta.cos()), 1e-9, "speed after one second");

    let mut world = solid("03-block-on-incline/scene.toml", &["default_law.coulomb.friction=0.3"]);
    run(&mut world, 1000, |_, _, _| {});
    close(world.bodies.velocity[1][0], 4.0 - 0.3 * 9.0, 1e-9, "speed after one second in space");
}

/// A block of base b and height h topples where tan θ > b/h and it sticks: tan θ = 0.45 here.
#[test]
fn a_slender_block_topples_and_a_stout_one_stands() {
    let tall = |ratio: f64| {
        let (b, h) = (0.1, 0.1 / ratio);
        format!("bodies.1.shape.polygon.vertices=[[{}, 0.0], [{}, 0.0], [{}, {h}], [{}, {h}]]", -b, b, b, -b)
    };
    // b/h = 2 · 0.1 / (0.1 / ratio) = 2 · ratio.
    for (ratio, topples) in [(0.2 * 1.125 * 1.02, false), (0.2 * 1.125 * 0.98, true)] {
        let mut world = plane("03-block-on-incline/scene-2d.toml", &["default_law.coulomb.friction=0.9", &tall(ratio)]);
        let before = world.bodies.pose[1].rotation;
        run(&mut world, 2000, |_, _, _| {});
        let after = world.bodies.pose[1].rotation;
        let turned = (before[0] * after[1] - before[1] * after[0]).abs();
        assert_eq!(turned > 0.1, topples, "b/h = {}: turned by {turned}", 2.0 * ratio);
        assert!(topples || turned < 1e-12, "a standing block must not rock: {turned}");
    }
}
