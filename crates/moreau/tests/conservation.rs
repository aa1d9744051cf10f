//! Momentum and energy in random scenes, in both dimensions, for every law and every local solver.

use moreau::bodies::{Bodies, Body, Motion};
use moreau::events::Schedule;
use moreau::laws::Laws;
use moreau::shape::plane::Disk;
use moreau::shape::solid::Ball;
use moreau::solve::local::LOCAL_METHODS;
use moreau::solve::{Acts, Criterion, Law, LocalMethod, Settings, law};
use moreau::space::{Plane, Pose, Solid, Space};
use moreau::step::{Workspace, step};
use moreau::world::{Guard, OnFailure, Rows, Start, StepSettings, World};
use proptest::prelude::*;

/// A generator of numbers from -1 to 1, so that one seed describes a scene.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Free round bodies near the sites of a lattice, about half of the neighbours overlapping: contacts in chains and loops, with
/// nothing fixed.
fn cluster<S: Space<D, N>, const D: usize, const N: usize>(
    seed: u64,
    law: Law,
    local: LocalMethod,
    shape: impl Fn(f64) -> S::Shape,
) -> World<S, D, N> {
    let mut numbers = Numbers(seed);
    let mut bodies = Bodies::default();
    for place in 0..12 {
        let site = [place % 2, place / 2 % 2, place / 4];
        let mut body = Body {
            shape: shape(0.3 + 0.03 * numbers.next()),
            pose: Pose {
                position: std::array::from_fn(|k| {
                    0.6 * f64::from(if D == 2 && k == 1 { place / 2 } else { site[k] }) + 0.03 * numbers.next()
                }),
                rotation: S::IDENTITY,
            },
            velocity: std::array::from_fn(|_| numbers.next()),
            density: 1000.0 + 500.0 * numbers.next(),
            material: 0,
            motion: Motion::Free,
            load: [0.0; N],
        };
        body.pose.rotation = S::turn(S::IDENTITY, &body.velocity, 1.0);
        bodies.push(body);
    }
    let solver = Settings { local, criterion: Criterion::Scaled, tolerance: 1e-11, max_sweeps: 100_000, ..Settings::default() };
    let settings = StepSettings {
        h: 1e-3,
        theta: 0.5,
        rows: Rows::Turning,
        max_penetration: None,
        start: Start::Cold,
        on_failure: OnFailure::Stop,
        solver,
    };
    let (laws, gravity, schedule) = (Laws::new(1, law), [0.0; D], Schedule::default());
    World { bodies, laws, joints: Vec::new(), gravity, schedule, guard: Guard::default(), settings, time: 0.0, steps: 0 }
}

fn three<const D: usize>(v: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|k| v.get(k).copied().unwrap_or(0.0))
}

/// Linear and angular momentum about the origin, and their scale.
fn momentum<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> ([f64; 6], f64) {
    let (mut sum, mut scale) = ([0.0; 6], 0.0);
    let bodies = &world.bodies;
    for i in 0..bodies.len() {
        let (x, v) = (three(&bodies.pose[i].position), &bodies.velocity[i]);
        let p = three(&std::array::from_fn::<f64, D, _>(|k| bodies.mass[i][k] * v[k]));
        let spin = S::spin_in_world(bodies.pose[i].rotation, &std::array::from_fn(|k| bodies.mass[i][k] * v[k]));
        for k in 0..3 {
            let (j, l) = ((k + 1) % 3, (k + 2) % 3);
            sum[k] += p[k];
            sum[3 + k] += spin[k] + x[j] * p[l] - x[l] * p[j];
            scale += p[k].abs();
        }
    }
    (sum, scale)
}

fn kinetic<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> f64 {
    let bodies = &world.bodies;
    (0..bodies.len()).map(|i| (0..N).map(|k| 0.5 * bodies.mass[i][k] * bodies.velocity[i][k].powi(2)).sum::<f64>()).sum()
}

/// Five steps; `elastic`: energy must be kept, else it must not grow.
fn conserves<S: Space<D, N>, const D: usize, const N: usize>(
    mut world: World<S, D, N>,
    elastic: bool,
    name: &str,
) -> Result<(), TestCaseError> {
    let mut work = Workspace::default();
    let (before, scale) = momentum(&world);
    let mut energy = kinetic(&world);
    let mut touched = 0;
    for _ in 0..5 {
        let record = step(&mut world, &mut work).map_err(|error| TestCaseError::fail(format!("{name}: {error}")))?;
        touched += record.active;
        let now = kinetic(&world);
        // The solver's tolerance is 1e-11 of the velocities; energy errors are of that order times velocity.
        prop_assert!(now <= energy * (1.0 + 1e-9), "{name}: energy grew from {energy} to {now}");
        if elastic {
            prop_assert!((now / energy - 1.0).abs() < 1e-9, "{name}: energy fell from {energy} to {now}");
        }
        prop_assert!(record.energy.balance_error.abs() < 1e-12 * energy, "{name}: ledger {:e}", record.energy.balance_error);
        energy = now;
    }
    prop_assume!(touched > 0);
    let (after, _) = momentum(&world);
    for k in 0..6 {
        prop_assert!((after[k] - before[k]).abs() < 1e-13 * scale, "{name}: momentum {before:?} became {after:?}");
    }
    Ok(())
}

fn both(seed: u64, law: Law, local: LocalMethod, elastic: bool, name: &str) -> Result<(), TestCaseError> {
    conserves(cluster::<Plane, 2, 3>(seed, law, local, |radius| Disk { radius }.into()), elastic, &format!("{name} 2D"))?;
    conserves(cluster::<Solid, 3, 6>(seed, law, local, |radius| Ball { radius }.into()), elastic, &format!("{name} 3D"))
}

fn coulomb(friction: f64, e: f64, acts: Acts) -> Law {
    Law::Coulomb(law::Coulomb { friction, restitution: e, tangential_restitution: Some(e), acts })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// e = 1, no friction: all is kept.
    #[test]
    fn elastic_impacts_keep_energy_and_momentum(seed: u64) {
        for &(local, row) in LOCAL_METHODS {
            let law = Law::Frictionless(law::Frictionless { restitution: 1.0, acts: Acts::Closed });
            both(seed, law, local, true, row.name)?;
        }
    }

    /// Any law: momentum is kept, energy never grows. With friction the tangential restitution is the normal one; where they
    /// differ Newton's law itself may create energy (Kane & Levinson 1985), which is no fault of the scheme.
    #[test]
    fn no_law_creates_energy(seed: u64, e in 0.0..1.0f64, mu in 0.0..1.0f64) {
        let laws = [
            ("frictionless", Law::Frictionless(law::Frictionless { restitution: e, acts: Acts::Closed })),
            ("coulomb", coulomb(mu, e, Acts::Closed)),
            ("coulomb on approach", coulomb(mu, 0.0, Acts::Approach)),
            ("sticking", Law::Sticking(law::Sticking { restitution: 0.0, acts: Acts::Closed })),
        ];
        for (name, law) in laws {
            for &(local, row) in LOCAL_METHODS {
                both(seed, law, local, false, &format!("{name}, {}", row.name))?;
            }
        }
    }
}
