//! ADMM through the bodies against ADMM through W, and `auto` where impulses are far from unique.

use moreau_solve::operator::NONE;
use moreau_solve::{Cone, Criterion, Delassus, GlobalMethod, MatrixFree, Operator, Problem, Report, Settings, Status, solve};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A tower of blocks in space, four contacts at the corners of each face, jostled: all fall, slide and turn a little, so that joints can hold.
fn tower(blocks: usize, seed: u64, cone: Cone) -> (MatrixFree<3, 6>, Vec<[f64; 3]>, Vec<Cone>) {
    let rng = &mut Pcg64Mcg::seed_from_u64(seed);
    let mut operator = MatrixFree::default();
    operator.clear(blocks);
    for block in 0..blocks {
        for [x, y] in [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]] {
            // Normal up and two tangents at (x, y, ∓1/2) of a block of mass 1 and moments 1/2.
            let rows = |z: f64, sign: f64| {
                let row = |n: [f64; 3]| {
                    let arm = [x, y, z];
                    let turn = |k: usize| arm[(k + 1) % 3] * n[(k + 2) % 3] - arm[(k + 2) % 3] * n[(k + 1) % 3];
                    std::array::from_fn(|k| sign * if k < 3 { n[k] } else { std::f64::consts::SQRT_2 * turn(k - 3) })
                };
                [row([0.0, 0.0, 1.0]), row([1.0, 0.0, 0.0]), row([0.0, 1.0, 0.0])]
            };
            let below = if block == 0 { NONE } else { block as u32 - 1 };
            operator.push([below, block as u32], [rows(0.5, -1.0), rows(-0.5, 1.0)]);
        }
    }
    let velocity = |_| std::array::from_fn(|k| 0.3 * rng.random_range(-1.0..1.0) - if k == 2 { 1.0 } else { 0.0 });
    let velocities = (0..blocks).map(velocity).collect();
    let q: Vec<_> = (0..operator.len()).map(|c| operator.apply(&velocities, c)).collect();
    let cones = vec![cone; q.len()];
    (operator, q, cones)
}

fn settings(global: GlobalMethod) -> Settings {
    Settings { global, criterion: Criterion::Scaled, tolerance: 1e-10, max_sweeps: 20_000, ..Settings::default() }
}

fn solved<O: Operator<3>>(operator: &O, q: &[[f64; 3]], cones: &[Cone], global: GlobalMethod, r: &mut [[f64; 3]]) -> Report {
    solve(&Problem { operator, q, cones }, &settings(global), r, &mut Default::default())
}

#[test]
fn both_ways_give_the_same_velocities() {
    for cone in [Cone::Signorini, Cone::Coulomb(0.0), Cone::Coulomb(0.6), Cone::Sticking, Cone::Bilateral { held: 0b101 }] {
        for seed in 0..8 {
            let (free, q, cones) = tower(3, seed, cone);
            let stored = Delassus::assemble(&free);
            let (mut r, mut s) = (vec![[0.0; 3]; q.len()], vec![[0.0; 3]; q.len()]);
            let one = solved(&free, &q, &cones, GlobalMethod::Admm, &mut r);
            let two = solved(&stored, &q, &cones, GlobalMethod::Admm, &mut s);
            assert_eq!((one.status, two.status), (Status::Converged, Status::Converged), "{cone:?}, {seed}");
            let (mut y, mut z) = (Default::default(), Default::default());
            free.start(&r, &mut y);
            free.start(&s, &mut z);
            for (one, two) in y.as_flattened().iter().zip(z.as_flattened()) {
                assert!((one - two).abs() < 1e-7, "{cone:?}, {seed}: {one} is not {two}");
            }
        }
    }
}

#[test]
fn the_answer_is_an_answer_without_a_step() {
    let (free, q, cones) = tower(4, 1, Cone::Coulomb(0.5));
    let mut r = vec![[0.0; 3]; q.len()];
    assert!(solved(&free, &q, &cones, GlobalMethod::Admm, &mut r).sweeps > 0);
    let answer = r.clone();
    let again = solved(&free, &q, &cones, GlobalMethod::Admm, &mut r);
    assert_eq!((again.status, again.sweeps), (Status::Converged, 0));
    // But for the rounding of its projection.
    assert!(r.as_flattened().iter().zip(answer.as_flattened()).all(|(r, s)| (r - s).abs() < 1e-15), "{r:?} is not {answer:?}");
}

#[test]
fn auto_ends_what_sweeps_would_crawl_on() {
    let (free, q, cones) = tower(30, 5, Cone::Coulomb(0.7));
    let [mut r, mut s] = [(); 2].map(|()| vec![[0.0; 3]; q.len()]);
    let auto = solved(&free, &q, &cones, GlobalMethod::Auto, &mut r);
    assert_eq!(auto.status, Status::Converged);
    assert!(auto.stages.iter().any(|stage| stage.method == GlobalMethod::Admm), "{:?}", auto.stages);
    let as_many = Settings { max_sweeps: 4 * auto.sweeps, ..settings(GlobalMethod::Nlgs) };
    let sweeps = solve(&Problem { operator: &free, q: &q, cones: &cones }, &as_many, &mut s, &mut Default::default());
    assert_eq!(sweeps.status, Status::MaxSweeps, "{} against {}", sweeps.sweeps, auto.sweeps);
}
