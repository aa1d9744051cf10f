//! `profile`: results.csv, performance profiles as CSV and SVG, a table.

mod common;

use common::Place;
use common::problems::{chain, put, stacked};

const WORDS: [&str; 8] = ["profile", "all", "--global", "nlgs,accelerated", "--local", "pdas,exact", "--out", "prof"];

fn place() -> Place {
    let place = Place::new();
    put(&place, "all/b.dat", &chain(12));
    put(&place, "all/a.hdf5", &stacked());
    put(&place, "all/c.txt", &chain(40));
    place.write("all/README.md", "not a problem");
    place
}

#[test]
fn a_profile_has_a_row_a_problem_and_method() {
    let place = place();
    let out = place.moreau(&WORDS).fine();
    let csv = place.read("prof/results.csv");
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let header = "file,dimension,contacts,global,local,status,sweeps,seconds,scaled,siconos,eps_glob";
    assert_eq!(csv.lines().next(), Some(header));
    assert_eq!(rows.len(), 1 + 3 * 4);
    assert_eq!(rows[1][..6], ["a.hdf5", "2", "2", "nlgs", "pdas", "converged"]);
    assert_eq!(rows[12][..6], ["c.txt", "3", "40", "accelerated", "exact", "converged"]);
    for row in &rows[1..] {
        assert!(row.len() == 11 && row[8].parse::<f64>().unwrap() <= 1e-8, "{row:?}");
    }
    for method in ["nlgs+pdas", "nlgs+exact", "accelerated+pdas", "accelerated+exact"] {
        let row: Vec<&str> = out.lines().find(|line| line.starts_with(method)).unwrap().split_whitespace().collect();
        assert!(row[1] == "3" && row[5].parse::<f64>().unwrap() >= 1.0, "{row:?}");
    }
}

#[test]
fn the_figures_of_a_profile_have_the_form_that_is_asked_for() {
    let place = place();
    place.moreau(&[&WORDS[..], &["--figures", "pdf"]].concat()).fine();
    for what in ["time", "sweeps"] {
        assert!(std::fs::read(place.path(&format!("prof/profile-{what}.pdf"))).unwrap().starts_with(b"%PDF"), "{what}");
    }
    assert!(!place.path("prof/profile-time.svg").exists());
}

#[test]
fn profiles_rise_to_the_part_that_is_solved() {
    let place = place();
    place.moreau(&WORDS).fine();
    for what in ["time", "sweeps"] {
        let csv = place.read(&format!("prof/profile-{what}.csv"));
        assert_eq!(csv.lines().next(), Some("tau,nlgs+pdas,nlgs+exact,accelerated+pdas,accelerated+exact"));
        let rows: Vec<Vec<f64>> =
            csv.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
        assert_eq!(rows[0][0], 1.0);
        assert!(rows[0][1..].iter().any(|&part| part > 0.0), "some method is the best on some problem");
        assert!(rows.windows(2).all(|w| w[0][0] < w[1][0] && (1..5).all(|m| w[0][m] <= w[1][m])), "{csv}");
        assert!(rows.last().unwrap()[1..].iter().all(|&part| part == 1.0), "{csv}");
        let svg = place.read(&format!("prof/profile-{what}.svg"));
        assert!(svg.starts_with("<svg") && svg.contains("accelerated+exact") && !svg.contains("NaN"), "{what}");
    }
    // What depends on no clock is the same again.
    let (sweeps, figure) = (place.read("prof/profile-sweeps.csv"), place.read("prof/profile-sweeps.svg"));
    place.moreau(&[&WORDS[..], &["--force"]].concat()).fine();
    assert_eq!((place.read("prof/profile-sweeps.csv"), place.read("prof/profile-sweeps.svg")), (sweeps, figure));
}

#[test]
fn what_does_not_converge_is_not_solved() {
    let place = place();
    let out = place.moreau(&["profile", "all", "--global", "nlgs", "--max-sweeps", "1", "--out", "prof"]).fine();
    let row: Vec<&str> = out.lines().find(|line| line.starts_with("nlgs+pdas")).unwrap().split_whitespace().collect();
    assert_eq!(row, ["nlgs+pdas", "0", "0", "-", "0", "-"]);
    assert!(place.read("prof/results.csv").contains("b.dat,3,12,nlgs,pdas,max_sweeps,1,"));
}

#[test]
fn a_wrong_file_does_not_stop_a_profile() {
    let place = place();
    place.write("all/bad.dat", "2 1 oops");
    let ran = place.moreau(&WORDS);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.err.contains("bad.dat: line 1") && ran.err.contains("1 of 4 files"), "{}", ran.err);
    assert!(ran.out.contains("3 problems to strict"), "{}", ran.out);
    assert_eq!(place.read("prof/results.csv").lines().count(), 13);
}

#[test]
fn folders_are_asked_for_before_anything_is_solved() {
    let place = place();
    std::fs::create_dir(place.path("none")).unwrap();
    place.write("taken", "mine");
    place.refuses(&["profile", "no/such", "--out", "prof"], 1, &["no/such: cannot be read"]);
    place.refuses(&["profile", "none", "--out", "prof"], 1, &["none: has no problem files", ".hdf5"]);
    place.refuses(&["profile", "all", "--out", "taken"], 1, &["cannot write into taken"]);
}
