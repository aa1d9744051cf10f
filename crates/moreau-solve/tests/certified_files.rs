//! The claims of all methods on problems that other programs dumped, and on hard ones: the folders that the environment variables
//! MOREAU_PROBLEMS and MOREAU_PROBLEMS_HARD name, which are no part of this project.
#![cfg(feature = "files")]

mod measured;

use moreau_solve::files::{self, Answer, AnyProblem, Csr, ProblemFile};
use moreau_solve::global::GLOBAL_METHODS;
use moreau_solve::residual::{MOST_ERRORS, MOST_SCALED};
use moreau_solve::{CRITERIA, Cone, Criterion, GlobalMethod, Settings, Status};
use std::path::{Path, PathBuf};

/// The problem files of the folder that `variable` names, if it does.
fn problems(variable: &str) -> Vec<PathBuf> {
    let Some(folder) = std::env::var_os(variable) else {
        println!("skipped: {variable} names no folder of problems");
        return Vec::new();
    };
    let folder = Path::new(&folder);
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry of the folder").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| ["dat", "hdf5"].iter().any(|known| e == *known)));
    paths.sort();
    paths
}

/// One problem, read for the library and for the measure.
struct Case {
    file: ProblemFile,
    problem: AnyProblem,
    w: Csr,
    q: Vec<f64>,
    cones: Vec<Cone>,
    diagonal: Vec<f64>,
}

impl Case {
    fn read(path: &Path) -> Self {
        let file = files::read(path).unwrap_or_else(|e| panic!("{e}"));
        let (w, q) = file.local().unwrap_or_else(|e| panic!("{e}"));
        let problem = file.any_problem().unwrap_or_else(|e| panic!("{e}"));
        let law = |c: usize| match (file.mu[c], &file.mu_r) {
            (mu, Some(mu_r)) => Cone::Rolling { mu, mu_r: mu_r[c] },
            (0.0, None) => Cone::Signorini,
            (mu, None) => Cone::Coulomb(mu),
        };
        let cones = (0..file.contacts()).map(law).collect();
        let diagonal = (0..q.len()).map(|i| w.row(i).filter(|&(j, _)| j == i).map(|(_, x)| x).sum()).collect();
        Self { problem, w, q, cones, diagonal, file }
    }

    /// Measures an answer that claims to have converged.
    fn check(&self, answer: &Answer, settings: &Settings, what: &str) {
        let r = &answer.r;
        let u: Vec<f64> = (0..r.len()).map(|i| self.q[i] + self.w.row(i).map(|(j, x)| x * r[j]).sum::<f64>()).collect();
        let measured = measured::flat(self.file.dimension, &self.cones, &self.diagonal, &self.q, &u, r);
        let tolerance = settings.tolerance;
        let (scaled, error) = match settings.criterion {
            Criterion::Scaled | Criterion::Strict => (tolerance, f64::INFINITY),
            Criterion::Siconos => (tolerance.max(MOST_SCALED.min(MOST_ERRORS * tolerance)), f64::INFINITY),
            Criterion::EpsGlob => (MOST_SCALED, MOST_ERRORS * tolerance),
        };
        let met = measured.scaled <= 1.01 * scaled + 1e-11 && measured.error <= 1.01 * error + 1e-11;
        assert!(met, "{what} claims to have converged: {measured:?}");
    }
}

/// Solves by all methods and criteria with small limits; answers how many claimed to have converged.
fn claims_hold(variable: &str, sweeps: u64, seconds: f64) -> usize {
    let mut converged = 0;
    for path in problems(variable) {
        let case = Case::read(&path);
        for &(global, row) in GLOBAL_METHODS {
            // One step of Newton's method takes seconds there, whatever the limit.
            let slow = global == GlobalMethod::ActiveSet && case.q.len() > 3000;
            for &(criterion, criterion_row) in CRITERIA.iter().filter(|_| !slow) {
                for tolerance in [1e-4, 1e-7] {
                    let limits = Settings { max_sweeps: sweeps, max_seconds: Some(seconds), ..Settings::default() };
                    let settings = Settings { global, criterion, tolerance, ..limits };
                    let answer = case.problem.solve(&settings);
                    let what = format!("{}: {} by {} at {tolerance:e}", path.display(), row.name, criterion_row.name);
                    assert!(answer.r.iter().all(|x| x.is_finite()), "{what}: not finite");
                    if answer.report.status == Status::Converged {
                        case.check(&answer, &settings, &what);
                        converged += 1;
                        assert!(!path.ends_with("nosolution_jam.hdf5"), "{what}: there is no solution");
                    }
                }
            }
        }
    }
    converged
}

#[test]
fn claims_on_problems_of_other_programs_hold() {
    let converged = claims_hold("MOREAU_PROBLEMS", 300, 0.03);
    assert!(converged > 200 || std::env::var_os("MOREAU_PROBLEMS").is_none(), "{converged}");
}

#[test]
fn claims_on_hard_problems_hold() {
    claims_hold("MOREAU_PROBLEMS_HARD", 60, 0.1);
}

/// A limit in the middle of a stage: what an earlier stage had reached is not lost.
#[test]
fn a_limit_inside_a_stage_loses_nothing() {
    for path in problems("MOREAU_PROBLEMS_HARD").iter().filter(|path| path.ends_with("packing_1000_mass1e3.hdf5")) {
        let case = Case::read(path);
        let after = |global: GlobalMethod, max_sweeps: u64| {
            let settings = Settings { global, criterion: Criterion::Strict, tolerance: 1e-8, max_sweeps, ..Settings::default() };
            case.problem.solve(&settings).report.residual.of(Criterion::Strict)
        };
        let accelerated = after(GlobalMethod::Accelerated, 400);
        let auto = after(GlobalMethod::Auto, 402);
        assert!(auto <= 1.000_001 * accelerated, "{auto:e}, and {accelerated:e} after the first stage");
    }
}
