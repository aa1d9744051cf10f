//! `solve`: the table, the lines of JSON, the certificate, the solution in a file, exit codes.

mod common;

use common::Place;
use common::problems::{chain, get, put, stacked};
use serde_json::Value;

#[test]
fn a_table_has_a_row_a_file() {
    let place = Place::new();
    put(&place, "chain.dat", &chain(7));
    put(&place, "stacked.hdf5", &stacked());
    let out = place.moreau(&["solve", "chain.dat", "stacked.hdf5"]).fine();
    let rows: Vec<Vec<&str>> = out.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(
        rows[0],
        ["file", "dimension", "contacts", "status", "sweeps", "scaled", "siconos", "eps_glob", "seconds", "method"]
    );
    assert_eq!(rows.len(), 3, "no certificates for several files:\n{out}");
    assert_eq!((rows[1][..4].to_vec(), rows[1].len()), (vec!["chain.dat", "3", "7", "converged"], 10));
    assert_eq!(rows[2][..4], ["stacked.hdf5", "2", "2", "converged"]);
    let with = place.moreau(&["solve", "chain.dat", "stacked.hdf5", "--certificate"]).fine();
    assert_eq!(with.matches("worst contact").count(), 2, "{with}");
}

#[test]
fn a_single_file_gets_its_certificate() {
    let place = Place::new();
    // One token more than the text needs: the reader says so.
    let text = moreau::solve::files::write_text(&chain(1)).unwrap();
    place.write("one.dat", format!("{text} 7\n"));
    let out = place.moreau(&["solve", "one.dat", "--global", "nlgs", "--local", "eal", "--start", "guess"]).fine();
    for words in ["status", "scaled", "siconos", "eps_glob", "cone", "complementarity", "nlgs: converged", "nlgs+eal"] {
        assert!(out.contains(words), "{words}:\n{out}");
    }
    assert!(out.contains("`7` at the end is ignored") && out.contains("there is no guess"), "{out}");
}

#[test]
fn json_has_the_promised_keys() {
    let place = Place::new();
    put(&place, "chain.dat", &chain(7));
    put(&place, "stacked.hdf5", &stacked());
    let words = ["solve", "chain.dat", "stacked.hdf5", "--json", "--global", "accelerated", "--repeat", "3"];
    let out = place.moreau(&words).fine();
    let rows: Vec<Value> = out.lines().map(|line| serde_json::from_str(line).expect("an object a line")).collect();
    assert_eq!(rows.len(), 2);
    let row = &rows[0];
    assert_eq!((&row["file"], &row["status"]), (&"chain.dat".into(), &"converged".into()));
    assert_eq!((&row["dimension"], &row["contacts"]), (&3.into(), &7.into()));
    assert_eq!((&row["global"], &row["local"]), (&"accelerated".into(), &"pdas".into()));
    assert!(row["sweeps"].as_u64().unwrap() > 0 && row["seconds"].as_f64().unwrap() >= 0.0);
    for key in ["residual_scaled", "residual_siconos"] {
        assert!(row[key].as_f64().unwrap() <= 1e-8, "{key} is {}", row[key]);
    }
    for key in ["eps_glob", "motion", "cone", "complementarity", "worst_error"] {
        assert!(row[key].is_f64(), "{key} is {}", row[key]);
    }
    assert!(row["worst_contact"].as_u64().unwrap() < 7 && row["notes"].as_array().unwrap().is_empty());
    let stage = &row["stages"][0];
    assert_eq!((&stage["method"], &stage["status"]), (&"accelerated".into(), &"converged".into()));
    assert!(stage["sweeps"] == row["sweeps"] && stage["error"].is_f64(), "{stage}");
}

#[test]
fn all_listed_methods_solve() {
    let place = Place::new();
    put(&place, "chain.dat", &chain(5));
    for table in ["global", "local"] {
        let listed = place.moreau(&["list", table]).fine();
        for name in listed.lines().map(|line| line.split_whitespace().next().unwrap()) {
            let ran = place.moreau(&["solve", "chain.dat", &format!("--{table}"), name, "--json"]);
            let row: Value = serde_json::from_str(&ran.out).unwrap_or_else(|error| panic!("{name}: {error}\n{}", ran.err));
            let fine = row["status"] == "converged" && ran.code == Some(0);
            assert!(fine || (row["status"] == "unsuited" && ran.code == Some(4)), "{name}: {row}");
        }
    }
}

#[test]
fn the_solution_is_written_with_its_velocities() {
    let place = Place::new();
    put(&place, "stacked.dat", &stacked());
    place.moreau(&["solve", "stacked.dat", "--out", "solved.hdf5", "--tolerance", "1e-12"]).fine();
    let solved = get(&place, "solved.hdf5");
    assert_eq!(solved.same_as(&stacked()), Ok(()));
    let solution = solved.solution.expect("a solution");
    let v = solution.v.expect("the problem is global");
    // Both bodies rest on each other: the ground carries all of 3, and friction 0.3 of what presses.
    assert!((solution.r[0] - 3.0).abs() < 1e-9 && (solution.r[2] - 1.0).abs() < 1e-9, "{:?}", solution.r);
    assert!(v[0].abs() < 1e-9 && v[2].abs() < 1e-9 && (solution.u[3] - (v[3] - v[1])).abs() < 1e-9, "{v:?}");
    // The file with its solution is a problem as any other; its solution is kept when it is converted.
    place.moreau(&["solve", "solved.hdf5"]).fine();
    place.moreau(&["convert", "solved.hdf5", "again.h5"]).fine();
    assert_eq!(get(&place, "again.h5").solution.map(|s| s.r), Some(solution.r));
}

#[test]
fn a_solution_needs_a_format_that_has_a_place_for_it() {
    let place = Place::new();
    put(&place, "a.dat", &chain(2));
    put(&place, "b.dat", &chain(2));
    place.refuses(&["solve", "a.dat", "--out", "s.dat"], 2, &["no place for a solution", "s.hdf5"]);
    place.refuses(&["solve", "a.dat", "--out", "s"], 2, &["names no format", ".hdf5"]);
    place.refuses(&["solve", "a.dat", "b.dat", "--out", "s.hdf5"], 2, &["one problem", "2 are to be solved"]);
    place.refuses(&["solve", "a.dat", "--out", "no/such/s.hdf5"], 1, &["cannot write no/such/s.hdf5"]);
}

#[test]
fn a_solve_that_does_not_converge_is_told_by_the_code() {
    let place = Place::new();
    put(&place, "chain.dat", &chain(30));
    put(&place, "easy.dat", &chain(1));
    let limits = ["--global", "nlgs", "--max-sweeps", "2", "--tolerance", "1e-12"];
    let ran = place.moreau(&[&["solve", "chain.dat"][..], &limits].concat());
    assert!(ran.code == Some(4) && ran.out.contains("max_sweeps"), "{ran:?}");
    assert!(ran.err.starts_with("error: chain.dat: ") && ran.err.contains("--max-sweeps"), "{}", ran.err);
    let ran = place.moreau(&[&["solve", "easy.dat", "chain.dat", "--json"][..], &limits].concat());
    assert!(ran.code == Some(4) && ran.out.lines().count() == 2, "{ran:?}");
    assert!(ran.err.contains("1 of 2") || ran.err.contains("chain.dat"), "{}", ran.err);
}

#[test]
fn a_wrong_file_is_named_and_the_others_are_solved() {
    let place = Place::new();
    put(&place, "chain.dat", &chain(3));
    let text = place.read("chain.dat");
    place.write("cut.dat", &text[..text.len() / 2]);
    place.write("words.dat", "3 one 2");
    place.write("empty.hdf5", "");
    put(&place, "whole.hdf5", &chain(3));
    let bytes = std::fs::read(place.path("whole.hdf5")).unwrap();
    place.write("cut.hdf5", &bytes[..bytes.len() / 2]);
    std::fs::create_dir(place.path("folder.dat")).unwrap();
    place.refuses(&["solve", "none.dat"], 1, &["error: none.dat: cannot be read", ".hdf5"]);
    place.refuses(&["solve", "folder.dat"], 1, &["error: folder.dat: cannot be read"]);
    place.refuses(&["solve", "cut.dat"], 3, &["error: cut.dat: "]);
    place.refuses(&["solve", "words.dat"], 3, &["error: words.dat: line 1, column 3", "one"]);
    place.refuses(&["solve", "empty.hdf5"], 3, &["error: empty.hdf5: "]);
    place.refuses(&["solve", "cut.hdf5"], 3, &["error: cut.hdf5: "]);
    // The ending says nothing to the reader.
    std::fs::rename(place.path("whole.hdf5"), place.path("whole.json")).unwrap();
    let ran = place.moreau(&["solve", "cut.dat", "chain.dat", "none.dat", "whole.json"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.out.lines().count() == 3 && ran.out.contains("chain.dat") && ran.out.contains("whole.json"), "{}", ran.out);
    for words in ["error: cut.dat: ", "error: none.dat: ", "2 of 4 files could not be solved"] {
        assert!(ran.err.contains(words), "{words}:\n{}", ran.err);
    }
}

#[test]
fn a_singular_mass_is_named() {
    let place = Place::new();
    let mut problem = stacked();
    if let moreau::solve::files::Equations::Global { m, .. } = &mut problem.equations {
        *m = moreau::solve::files::SparseMatrix::from_entries(4, 4, [(0, 0, 1.0)].into_iter());
    }
    put(&place, "singular.hdf5", &problem);
    place.refuses(&["solve", "singular.hdf5"], 3, &["error: singular.hdf5: M: is singular"]);
}

#[test]
fn convert_goes_both_ways_and_says_what_is_lost() {
    let place = Place::new();
    put(&place, "stacked.hdf5", &stacked());
    let out = place.moreau(&["convert", "stacked.hdf5", "stacked.dat"]).fine();
    assert_eq!(out.lines().count(), 1, "{out}");
    for words in ["stacked.hdf5: a global problem", "contacts: 2", "stacked.dat", "no place for the guesses", "title"] {
        assert!(out.contains(words), "{words}:\n{out}");
    }
    let out = place.moreau(&["convert", "stacked.dat", "back.h5"]).fine();
    assert!(out.contains("FCLIB") && !out.contains("no place"), "{out}");
    assert_eq!(get(&place, "back.h5").same_as(&stacked()), Ok(()));
    place.refuses(&["convert", "stacked.dat", "other.json"], 2, &["other.json", "names no format", ".hdf5"]);
    place.refuses(&["convert", "stacked.dat", "stacked.dat"], 2, &["would be overwritten"]);
    place.refuses(&["convert", "none.dat", "other.hdf5"], 1, &["none.dat: cannot be read"]);
    place.refuses(&["convert", "stacked.dat", "no/such/a.hdf5"], 1, &["cannot write no/such/a.hdf5"]);
}

#[test]
fn what_explains_a_folder_is_passed_over_but_not_what_claims_to_be_a_problem() {
    let place = Place::new();
    put(&place, "chain.dat", &chain(7));
    place.write("README.md", "# Problems\n");
    let ran = place.moreau(&["solve", "README.md", "chain.dat"]);
    assert!(ran.code == Some(0) && ran.err.starts_with("note: passed over: README.md"), "{ran:?}");
    assert_eq!(ran.out.lines().count(), 2);
    place.write("broken.dat", "# Problems\n");
    assert_eq!(place.moreau(&["solve", "broken.dat", "chain.dat"]).code, Some(3));
    place.refuses(&["solve", "README.md"], 3, &["README.md"]);
}
