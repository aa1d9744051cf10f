//! 9. At rest the support reactions carry the weight, and its moment.

use super::{close, plane};
use moreau::step::{StepRecord, Workspace, step};

/// On its way to rest some steps of the pile may miss the tolerance, as plain NLGS does with friction; the last one must not.
#[test]
fn reactions_sum_to_the_weight_and_its_moment() {
    let mut world = plane("09-support-reactions/scene.toml", &[]);
    let h = world.settings.h;
    let mut work = Workspace::default();
    let mut last = StepRecord::default();
    for _ in 0..5000 {
        last = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
    }
    assert!(last.converged(), "{last:?}");
    let (mut force, mut moment) = ([0.0; 2], 0.0);
    for c in work.contacts() {
        let [a, b] = [c.contact.key.a as usize, c.contact.key.b as usize];
        if world.bodies.is_free(a) == world.bodies.is_free(b) {
            continue;
        }
        // The impulse is that on body b; a support is whichever is fixed.
        let sign = if world.bodies.is_free(b) { 1.0 } else { -1.0 };
        let p: [f64; 2] = std::array::from_fn(|k| sign * (c.frame[0][k] * c.impulse[0] + c.frame[1][k] * c.impulse[1]) / h);
        force[0] += p[0];
        force[1] += p[1];
        moment += c.contact.point[0] * p[1] - c.contact.point[1] * p[0];
    }
    let bodies = &world.bodies;
    let free: Vec<usize> = (0..bodies.len()).filter(|&i| bodies.is_free(i)).collect();
    let weight: f64 = free.iter().map(|&i| 9.81 * bodies.mass[i][0]).sum();
    let weight_moment: f64 = free.iter().map(|&i| 9.81 * bodies.mass[i][0] * bodies.pose[i].position[0]).sum();
    let speed = free.iter().map(|&i| bodies.velocity[i][0].hypot(bodies.velocity[i][1])).fold(0.0, f64::max);

    assert!(speed < 1e-6, "not at rest: {speed} m/s");
    // What is left of motion accounts for the rest: Δv of at most twice the speed, in one step.
    let tolerance = 2.0 * speed * weight / (9.81 * h) + 1e-9 * weight;
    close(force[0], 0.0, tolerance, "sum of horizontal reactions");
    close(force[1], weight, tolerance, "sum of vertical reactions");
    close(moment, weight_moment, 2.0 * tolerance, "moment of the reactions");
}
