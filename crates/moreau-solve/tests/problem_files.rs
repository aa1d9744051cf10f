//! Problems that other programs dumped: the folder that the environment variable MOREAU_PROBLEMS names, which is no part of this
//! project. Each is read, written in both formats, read back and compared.
#![cfg(feature = "files")]

use moreau_solve::files::{self, Equations, ProblemFile};
use std::path::{Path, PathBuf};

/// The problem files of the folder, if there is one.
fn problems() -> Vec<PathBuf> {
    let Some(folder) = std::env::var_os("MOREAU_PROBLEMS") else {
        println!("skipped: MOREAU_PROBLEMS names no folder of problems");
        return Vec::new();
    };
    let folder = Path::new(&folder);
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry of the folder").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| ["dat", "hdf5"].iter().any(|known| e == *known)));
    paths.sort();
    paths
}

#[test]
fn every_problem_survives_both_formats() {
    let folder = tempfile::tempdir().expect("a folder");
    for path in problems() {
        let problem = files::read(&path).unwrap_or_else(|e| panic!("{e}"));
        for ending in ["hdf5", "dat"] {
            let copy = folder.path().join("copy").with_extension(ending);
            let lost = files::write(&copy, &problem).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            let back = files::read(&copy).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            back.same_as(&problem).unwrap_or_else(|e| panic!("{} as {ending}: {e}", path.display()));
            if ending == "hdf5" {
                assert!(lost.is_empty());
                let extras = |p: &ProblemFile| (p.info.clone(), p.guesses.clone(), p.solution.clone());
                assert_eq!(extras(&back), extras(&problem), "{}", path.display());
            }
        }
    }
}

#[test]
fn every_problem_can_be_solved_for() {
    for path in problems() {
        let problem = files::read(&path).unwrap_or_else(|e| panic!("{e}"));
        let (w, q) = problem.local().unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        problem.any_problem().unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert_eq!((w.rows, q.len()), (w.columns, w.rows));
        let kind = if matches!(problem.equations, Equations::Global { .. }) { "global" } else { "local" };
        let size = problem.dimension;
        let mut blocks: Vec<_> = w.entries().map(|(i, j, _)| (i / size, j / size)).collect();
        blocks.sort_unstable();
        blocks.dedup();
        println!(
            "{:45} {kind:6} d={size} N={:4} blocks={:6} asymmetry={:8.1e} {:?}",
            path.file_name().unwrap_or_default().to_string_lossy(),
            problem.contacts(),
            blocks.len(),
            w.asymmetry(),
            problem.notes
        );
    }
}

/// The seeds of the fuzz targets, among which is what they have found.
#[test]
fn every_seed_is_read_or_refused() {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    // Where the crate is packed alone there are none.
    let Ok(folders) = std::fs::read_dir(seeds) else { return };
    for folder in folders {
        for seed in std::fs::read_dir(folder.expect("a folder").path()).expect("a folder of seeds") {
            if let Ok(problem) = files::read(&seed.expect("a seed").path()) {
                let _ = problem.any_problem();
            }
        }
    }
}

/// The rank of (W + Wᵀ)/2 by Cholesky's method with the greatest pivot first, and the least pivot that is left, relative to the
/// greatest: of a semidefinite matrix it is zero but for rounding.
fn rank(w: &files::Csr) -> (usize, f64) {
    let n = w.rows;
    let mut a = vec![0.0; n * n];
    for (i, j, x) in w.entries() {
        a[i * n + j] += 0.5 * x;
        a[j * n + i] += 0.5 * x;
    }
    let greatest = (0..n).map(|i| a[i * n + i]).fold(0.0, f64::max);
    let mut left: Vec<usize> = (0..n).collect();
    let mut rank = 0;
    while let Some(at) = (0..left.len()).max_by(|&k, &l| a[left[k] * (n + 1)].total_cmp(&a[left[l] * (n + 1)])) {
        let pivot = a[left[at] * (n + 1)];
        if pivot <= 1e-10 * greatest {
            break;
        }
        rank += 1;
        let k = left.swap_remove(at);
        let row: Vec<f64> = a[k * n..(k + 1) * n].to_vec();
        for &i in &left {
            let factor = row[i] / pivot;
            if factor != 0.0 {
                a[i * n..(i + 1) * n].iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    let least = left.iter().map(|&i| a[i * (n + 1)]).fold(0.0, f64::min);
    (rank, least / greatest)
}

/// Blocks that were read row by row would make W indefinite.
#[test]
fn a_tower_is_semidefinite_and_of_the_rank_it_is_known_for() {
    for path in problems().iter().filter(|path| path.ends_with("KaplasTower-i1061-4.dat")) {
        let (w, _) = files::read(path).and_then(|problem| problem.local()).unwrap_or_else(|e| panic!("{e}"));
        let (rank, least) = rank(&w);
        assert_eq!((w.rows, rank), (1710, 504));
        assert!(least > -1e-10 && w.asymmetry() < 1e-12, "{least} {}", w.asymmetry());
    }
}
