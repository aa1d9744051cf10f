//! 8. A block that rocks on its corners.

use super::{close, plane};
use moreau::step::{Workspace, step};

const G: f64 = 9.81;
const HALF: [f64; 2] = [0.05, 0.5];

/// The time in which the exact equation, θ̈ = −p² sin(α − θ), leads from rest at `start` to θ = 0: ∫ dθ/θ̇ with θ̇² of the energy. With
/// θ = start (1 − s²) the integrand is smooth.
fn quarter(p: f64, alpha: f64, start: f64) -> f64 {
    let n = 20_000;
    let speed = |theta: f64| p * (2.0 * ((alpha - start).cos() - (alpha - theta).cos())).sqrt();
    let at = |k: usize| (k as f64 + 0.5) / f64::from(n);
    (0..n as usize).map(|k| 2.0 * start * at(k) / speed(start * (1.0 - at(k) * at(k)))).sum::<f64>() / f64::from(n)
}

#[test]
fn a_rocking_block_lands_when_housner_says_and_keeps_the_part_of_its_spin_that_he_says() {
    let [b, height] = HALF;
    let (alpha, r) = ((b / height).atan(), b.hypot(height));
    let (p, start) = ((3.0 * G / (4.0 * r)).sqrt(), 0.5 * alpha);
    // Standing on the corner at the origin, tilted away from it.
    let mut world = plane("08-rocking-block/scene.toml", &[&format!("bodies.1.orientation={}", -start)]);
    let (mut work, h) = (Workspace::default(), world.settings.h);
    let mut spins = Vec::new();
    let mut landed = None;
    while landed.is_none_or(|(step, _)| spins.len() < step + 40) {
        let record = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged() && spins.len() < 10_000);
        spins.push(world.bodies.velocity[1][2]);
        if landed.is_none() && work.contacts().iter().any(|c| c.contact.key.feature == 0 && c.impulse[0] > 0.0) {
            landed = Some((spins.len(), world.time));
        }
    }
    let (at, time) = landed.unwrap();
    let exact = quarter(p, alpha, start);
    close(time - 0.5 * h, exact, 1.5 * h, "time of landing");
    let housner = (1.0 / (1.0 - start / alpha)).acosh() / p;
    // sin x for x leaves out x³/6 of an acceleration, at angles up to α: up to α²/6 of it, and half of that part of the time.
    close(exact, housner, alpha * alpha / 12.0 * exact, "time of landing by Housner");
    // Within the step of the impact gravity still acts; afterwards the spin is that of the new corner.
    let (before, after) = (spins[at - 2], spins[at]);
    close(after / before, 1.0 - 1.5 * alpha.sin().powi(2), 1e-3, "ratio of spins");
}
