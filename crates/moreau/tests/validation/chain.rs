//! 7. A chain of equal balls, hit at one end.

use super::{close, run, solid};
use moreau::space::Solid;
use moreau::world::World;

/// Velocities from the struck end to the far one; the striker, a body of its own, comes before those of the lattice.
fn velocities(world: &World<Solid, 3, 6>) -> Vec<f64> {
    world.bodies.velocity.iter().map(|v| v[0]).collect()
}

/// Touching balls, Moreau-Newton law: the first leaves at (1 − e(N−1))v/N, all others at (1+e)v/N. An algebraic identity of the law:
/// only the solver's tolerance is left.
#[test]
fn touching_balls_leave_as_moreaus_law_says() {
    for e in [0.0, 0.3, 1.0] {
        let mut world = solid("07-chain-of-balls/scene.toml", &[&format!("default_law.frictionless.restitution={e:?}")]);
        let n = world.bodies.len() as f64;
        run(&mut world, 3, |_, _, _| {});
        let v = velocities(&world);
        close(v[0], (1.0 - e * (n - 1.0)) / n, 1e-10, "the first ball");
        for other in &v[1..] {
            close(*other, (1.0 + e) / n, 1e-10, "another ball");
        }
    }
}

/// With small gaps and e = 1 the impacts come one by one and only the last ball leaves, at v.
#[test]
fn with_gaps_only_the_last_ball_leaves() {
    // Spacing 0.1 of balls of radius 0.0495: gaps of 1 mm, ten steps of travel each.
    let mut world =
        solid("07-chain-of-balls/scene.toml", &["generate.0.radii.constant=0.0495", "bodies.0.shape.ball.radius=0.0495"]);
    run(&mut world, 200, |_, _, _| {});
    let v = velocities(&world);
    let (last, others) = v.split_last().expect("six balls");
    close(*last, 1.0, 1e-10, "the last ball");
    for other in others {
        close(*other, 0.0, 1e-10, "a ball that stays");
    }
}
