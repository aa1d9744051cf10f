//! What is called converged holds the law: measured here from W, q and r alone, by projections of its own.

mod measured;

use measured::{Dense, Measured};
use moreau_solve::global::GLOBAL_METHODS;
use moreau_solve::residual::{MOST_ERRORS, MOST_SCALED};
use moreau_solve::{
    CRITERIA, Cone, Criterion, Delassus, GlobalMethod, LocalMethod, Problem, Report, Residual, Scratch, Settings, Status, solve,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A problem with random bodies, half of the velocities such as impulses can change and half any: not all have a solution.
fn problem<const D: usize>(seed: u64, cone: Cone, contacts: usize, deficient: bool) -> (Dense<D>, Vec<[f64; D]>, Vec<Cone>) {
    let rng = &mut Pcg64Mcg::seed_from_u64(seed);
    let columns = if deficient { (contacts * D).div_ceil(2) } else { contacts * D + 2 };
    let size: f64 = 10.0_f64.powi(rng.random_range(-2..3));
    let rows: Vec<f64> = (0..contacts * D * columns).map(|_| size * rng.random_range(-1.0..1.0)).collect();
    let row = |i: usize| &rows[i * columns..(i + 1) * columns];
    let product = |i: usize, j: usize| row(i).iter().zip(row(j)).map(|(x, y)| x * y).sum();
    let block = |c: usize, d: usize| std::array::from_fn(|i| std::array::from_fn(|j| product(c * D + i, d * D + j)));
    let w = (0..contacts).map(|c| (0..contacts).map(|d| block(c, d)).collect()).collect();
    let motion: Vec<f64> = (0..columns).map(|_| rng.random_range(-1.0..1.0)).collect();
    let reached = seed.is_multiple_of(2);
    let along = |i: usize| row(i).iter().zip(&motion).map(|(x, v)| x * v).sum::<f64>();
    let any: Vec<f64> = (0..contacts * D).map(|_| rng.random_range(-1.0..1.0)).collect();
    let q = (0..contacts).map(|c| std::array::from_fn(|i| if reached { along(c * D + i) } else { any[c * D + i] })).collect();
    (w, q, vec![cone; contacts])
}

fn solved<const D: usize>(w: &Dense<D>, q: &[[f64; D]], cones: &[Cone], settings: &Settings) -> (Report, Vec<[f64; D]>) {
    let operator = Delassus::dense(w);
    let mut r = vec![[0.0; D]; q.len()];
    let report = solve(&Problem { operator: &operator, q, cones }, settings, &mut r, &mut Scratch::default());
    (report, r)
}

/// The bounds that docs/theory.md states, with room for the rounding of two ways to the same number.
fn check(measured: &Measured, settings: &Settings, what: &str) {
    let tolerance = settings.tolerance;
    let (scaled, error) = match settings.criterion {
        Criterion::Scaled | Criterion::Strict => (tolerance, f64::INFINITY),
        Criterion::Siconos => (tolerance.max(MOST_SCALED.min(MOST_ERRORS * tolerance)), f64::INFINITY),
        Criterion::EpsGlob => (MOST_SCALED, MOST_ERRORS * tolerance),
    };
    let room = |bound: f64| 1.001 * bound + 1e-12;
    assert!(measured.scaled <= room(scaled), "{what} claims to have converged with a scaled residual of {:e}", measured.scaled);
    assert!(measured.error <= room(error), "{what} claims to have converged with a mean error of {:e}", measured.error);
}

/// All methods by all criteria on problems of one law; answers how many solves converged and how many did not.
fn holds<const D: usize>(cone: Cone) -> [u32; 2] {
    let mut counts = [0; 2];
    for seed in 0..8 {
        for deficient in [false, true] {
            let (w, q, cones) = problem::<D>(seed, cone, 1 + seed as usize, deficient);
            for &(global, row) in GLOBAL_METHODS {
                for &(criterion, criterion_row) in CRITERIA {
                    for tolerance in [1e-3, 1e-8] {
                        let settings = Settings { global, criterion, tolerance, max_sweeps: 300, ..Settings::default() };
                        let (report, r) = solved(&w, &q, &cones, &settings);
                        assert!(r.as_flattened().iter().all(|x| x.is_finite()));
                        let converged = report.status == Status::Converged;
                        counts[usize::from(!converged)] += 1;
                        if converged {
                            let what = format!("{} by {} at {tolerance:e} on {cone:?}, D = {D}", row.name, criterion_row.name);
                            check(&measured::dense(&w, &q, &cones, &r), &settings, &what);
                        }
                    }
                }
            }
        }
    }
    counts
}

#[test]
fn what_converged_obeys_its_law() {
    let rolling = Cone::Rolling { mu: 0.4, mu_r: 0.05 };
    let mut counts = [0; 2];
    let mut add = |more: [u32; 2]| counts = [counts[0] + more[0], counts[1] + more[1]];
    add(holds::<1>(Cone::Signorini));
    add(holds::<2>(Cone::Signorini));
    add(holds::<3>(Cone::Signorini));
    for mu in [0.1, 0.8] {
        add(holds::<2>(Cone::Coulomb(mu)));
        add(holds::<3>(Cone::Coulomb(mu)));
    }
    add(holds::<2>(Cone::Sticking));
    add(holds::<3>(Cone::Sticking));
    add(holds::<3>(rolling));
    add(holds::<5>(rolling));
    add(holds::<1>(Cone::Bilateral { held: 0b1 }));
    add(holds::<2>(Cone::Bilateral { held: 0b10 }));
    add(holds::<3>(Cone::Bilateral { held: 0b101 }));
    add(holds::<5>(Cone::Bilateral { held: 0b11111 }));
    // Both kinds were seen, or the test says nothing.
    assert!(counts[0] > 1000 && counts[1] > 100, "{counts:?}");
}

/// Local methods that claim no velocity, and those that approach the cone.
#[test]
fn what_converged_obeys_its_law_with_every_local_method() {
    let locals = [LocalMethod::Sbp, LocalMethod::Sal, LocalMethod::Ebp, LocalMethod::Eal, LocalMethod::Exact];
    for local in locals {
        for seed in 0..12 {
            let (w, q, cones) = problem::<3>(seed, Cone::Coulomb(0.4), 4, seed % 3 == 0);
            for global in [GlobalMethod::Nlgs, GlobalMethod::Accelerated, GlobalMethod::ActiveSet] {
                let settings = Settings { global, local, tolerance: 1e-6, max_sweeps: 500, ..Settings::default() };
                let (report, r) = solved(&w, &q, &cones, &settings);
                if report.status == Status::Converged {
                    let what = format!("{} with {}", global.name(), local.name());
                    check(&measured::dense(&w, &q, &cones, &r), &settings, &what);
                }
            }
        }
    }
}

/// At a limit of n sweeps the answer is as good as the best that was measured of the n, all of them with a history, and as that under any smaller limit;
/// and the report measures that answer.
#[test]
fn at_every_limit_the_best_impulses_are_the_answer() {
    for &(global, row) in GLOBAL_METHODS {
        for criterion in [Criterion::EpsGlob, Criterion::Scaled, Criterion::Strict] {
            for (seed, cone) in [(3, Cone::Coulomb(0.9)), (5, Cone::Signorini), (7, Cone::Rolling { mu: 0.5, mu_r: 0.1 })] {
                for history in [true, false] {
                    let settings = Settings { global, criterion, tolerance: 1e-11, history, ..Settings::default() };
                    limits_tell(&settings, seed, cone, &format!("{} by {} on {cone:?}", row.name, criterion.name()));
                }
            }
        }
    }
}

fn limits_tell(settings: &Settings, seed: u64, cone: Cone, what: &str) {
    let (w, q, cones) = problem::<3>(seed, cone, 9, true);
    let mut so_far = f64::INFINITY;
    for limit in (1..60).chain((60..400).step_by(7)) {
        let settings = Settings { max_sweeps: limit, ..*settings };
        let (report, r) = solved(&w, &q, &cones, &settings);
        // A solution need not have the least ε_glob: others may have had less of it without being one.
        if matches!(report.status, Status::Unsuited | Status::Converged) {
            continue;
        }
        let answer = report.residual.of(settings.criterion);
        let best = report.history.iter().map(|row| row.residual.of(settings.criterion)).fold(f64::INFINITY, f64::min);
        let room = |x: f64| 1.000_001 * x + 1e-12;
        assert!(answer <= room(best), "{what}, {limit} sweeps: {answer:e}, and {best:e} was seen");
        assert!(answer <= room(so_far), "{what}, {limit} sweeps: {answer:e}, and {so_far:e} with a smaller limit");
        so_far = so_far.min(answer);
        let measured = measured::dense(&w, &q, &cones, &r);
        let other = report.residual.scaled;
        let alike = (measured.scaled - other).abs() <= 1e-9 * other + 1e-12;
        assert!(alike, "{what}, {limit} sweeps: {other:e} is reported for {measured:?}");
    }
}

#[test]
fn what_is_not_finite_is_no_certificate() {
    let fine = Residual { scaled: 1e-9, siconos: 1e-9, ..Residual::default() };
    for &(criterion, row) in CRITERIA {
        assert!(fine.certifies(criterion, 1e-8), "{}", row.name);
        for bad in [f64::NAN, f64::INFINITY] {
            for part in 0..6 {
                let mut residual = fine;
                let parts = [&mut residual.eps_glob.cone, &mut residual.eps_glob.motion, &mut residual.scaled];
                let others = [&mut residual.siconos, &mut residual.error, &mut residual.complementarity];
                *parts.into_iter().chain(others).nth(part).unwrap() = bad;
                assert!(!residual.certifies(criterion, 1e-8), "{} with {bad} in part {part}", row.name);
            }
        }
    }
    assert!(Residual { error: 2e-7, ..fine }.certifies(Criterion::EpsGlob, 1e-7));
    assert!(!Residual { error: 2e-6, ..fine }.certifies(Criterion::EpsGlob, 1e-7));
    assert!(!Residual { scaled: 0.02, ..fine }.certifies(Criterion::EpsGlob, 1e-7));
    assert!(!Residual { scaled: 1e-6, ..fine }.certifies(Criterion::Siconos, 1e-8));
    // Too large to be squared, and so not to be judged.
    let huge = vec![vec![[[1e-200]]]];
    for &(global, row) in GLOBAL_METHODS {
        let (report, r) =
            solved(&huge, &[[-1e200]], &[Cone::Signorini], &Settings { global, max_sweeps: 50, ..Settings::default() });
        assert!(report.status != Status::Converged && r[0][0].is_finite(), "{}: {report:?}", row.name);
    }
}

/// ε_glob sees impulses outside of their cone, whose motion and power it would not: u = 0 with an impulse that pulls.
#[test]
fn impulses_that_pull_count() {
    let w = Delassus::dense(&[vec![[[2.0, 0.0], [0.0, 4.0]]]]);
    for (cone, w_c, r) in [(Cone::Coulomb(0.5), 3.0, [-1.0, 0.0]), (Cone::Signorini, 2.0, [-1.0, 0.0])] {
        let q = [[2.0, 0.0]];
        let problem = Problem { operator: &w, q: &q, cones: &[cone] };
        let residual = moreau_solve::residual::measure(&problem, &vec![r], &[r], None);
        assert_eq!((residual.eps_glob.total(), residual.eps_glob.cone), (w_c, w_c), "{cone:?}");
    }
}
