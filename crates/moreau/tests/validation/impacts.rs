//! 1. The bouncing ball.

use super::{close, plane, run, solid};
use moreau::space::Space;
use moreau::world::World;

/// Heights of the rebounds against e^{2n} h₀, and the time of rest against √(2h₀/g)·(1+e)/(1−e).
fn bounces<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>) {
    let (e, g, h0, radius, up) = (0.8_f64, 9.81_f64, 1.0_f64, 0.1, D - 1);
    let h = world.settings.h;
    let (mut peaks, mut rest) = (Vec::new(), 0.0);
    let mut before = 0.0;
    run(&mut world, 250_000, |world, _, _| {
        let v = world.bodies.velocity[1][up];
        let height = world.bodies.pose[1].position[up] - radius;
        if before > 0.0 && v <= 0.0 {
            peaks.push(height);
        }
        if v.abs() > 2.0 * g * h {
            rest = world.time;
        }
        before = v;
    });
    // An impact is seen up to one step late, so that the ball has sunk by up to v h below its height: v² then differs by 2 g v h, a
    // relative 2 v h/h₀ of the height each time.
    let speed = (2.0 * g * h0).sqrt();
    for (n, peak) in peaks.iter().take(8).enumerate() {
        let n = n as i32 + 1;
        close(*peak, e.powi(2 * n) * h0, 2.0 * f64::from(n) * speed * h, &format!("height of rebound {n}"));
    }
    // Each of the some fifty impacts until v < 2 g h is late by up to h.
    let expected = (2.0 * h0 / g).sqrt() * (1.0 + e) / (1.0 - e);
    close(rest, expected, 100.0 * h, "time of rest");
    close(world.bodies.velocity[1][up], 0.0, 1e-12, "velocity at rest");
}

#[test]
fn a_ball_rebounds_to_e_to_the_2n() {
    bounces(solid("01-bouncing-ball/scene.toml", &[]));
}

#[test]
fn a_disk_rebounds_to_e_to_the_2n() {
    bounces(plane("01-bouncing-ball/scene-2d.toml", &[]));
}
