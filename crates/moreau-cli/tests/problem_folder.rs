//! Problems that other programs dumped: the folder that the environment variable MOREAU_PROBLEMS names, which is no part of this
//! project. Each is solved to the tolerance that its digits allow.

mod common;

use common::Place;
use moreau::solve::files;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The problem files of the folder, if there is one.
fn problems() -> Vec<PathBuf> {
    let Some(folder) = std::env::var_os("MOREAU_PROBLEMS") else {
        println!("skipped: MOREAU_PROBLEMS names no folder of problems");
        return Vec::new();
    };
    let folder = Path::new(&folder).canonicalize().unwrap_or_else(|e| panic!("{}: {e}", Path::new(&folder).display()));
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry of the folder").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| ["dat", "hdf5"].iter().any(|known| e == *known)));
    paths.sort();
    paths
}

/// Significant digits of the longest number of a text; of HDF5 all.
fn digits(path: &Path) -> usize {
    let bytes = std::fs::read(path).expect("a file of the folder");
    let Ok(text) = std::str::from_utf8(&bytes) else { return 17 };
    let significant = |token: &str| {
        let mantissa = token.split(['e', 'E']).next().unwrap_or_default();
        mantissa.chars().filter(char::is_ascii_digit).collect::<String>().trim_matches('0').len()
    };
    text.split_whitespace().filter(|token| token.contains('.')).map(significant).max().unwrap_or(0)
}

#[test]
fn every_problem_of_the_folder_is_solved() {
    let place = Place::new();
    let mut unsolved = Vec::new();
    for path in problems() {
        let name = path.to_string_lossy().into_owned();
        let contacts = files::read(&path).unwrap_or_else(|e| panic!("{e}")).contacts();
        // W and q of so few digits are no better known than that.
        let tolerance = if digits(&path) <= 8 { "1e-6" } else { "1e-8" };
        let ran = place.moreau(&["solve", &name, "--json", "--tolerance", tolerance, "--seconds", "120"]);
        let row: Value = serde_json::from_str(&ran.out).unwrap_or_else(|error| panic!("{name}: {error}\n{}", ran.err));
        assert_eq!(row["contacts"], contacts, "{name}");
        println!("{tolerance} {} {} {:.3} s {name}", row["status"], row["sweeps"], row["seconds"].as_f64().unwrap_or(f64::NAN));
        if row["status"] != "converged" {
            unsolved.push(format!("{name}: {} {} {}", row["status"], row["residual_scaled"], row["residual_siconos"]));
        }
    }
    assert!(unsolved.is_empty(), "{}", unsolved.join("\n"));
}
