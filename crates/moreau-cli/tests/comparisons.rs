//! `compare`: a row a method, the table as CSV, errors by sweep as SVG, and code 5 where methods do not agree.

mod common;

use common::{Place, TEN};

/// The rows of the table, without its title and header.
fn rows(out: &str) -> Vec<Vec<&str>> {
    out.lines().filter(|line| line.starts_with("nlgs+")).map(|line| line.split_whitespace().collect()).collect()
}

#[test]
fn the_table_has_a_row_a_method() {
    let place = Place::with("ten.toml", TEN);
    let before = place.all(".");
    let out = place.moreau(&["compare", "ten.toml"]).fine();
    let names: Vec<&str> = rows(&out).iter().map(|row| row[0]).collect();
    assert_eq!(names, ["nlgs+sbp", "nlgs+sal", "nlgs+ebp", "nlgs+eal", "nlgs+pdas"], "{out}");
    for words in ["ten: 15 bodies, 20 steps", "method", "sweeps/step", "total s", "unconverged", "difference"] {
        assert!(out.contains(words), "`{words}`:\n{out}");
    }
    assert!(!out.contains('\x1b') && place.all(".") == before, "a comparison writes only the files that it is asked for");

    let out = place.moreau(&["compare", "ten.toml", "--local", "exact,eal", "--at", "4", "--repeat", "2"]).fine();
    let table = rows(&out);
    assert_eq!(table.iter().map(|row| row[0]).collect::<Vec<_>>(), ["nlgs+exact", "nlgs+eal"], "{out}");
    for row in &table {
        assert_eq!(row.len(), 8, "{out}");
        assert!(row[1..].iter().all(|cell| cell.parse::<f64>().is_ok_and(f64::is_finite)), "{out}");
    }
    // One of the methods is the fastest, by either clock.
    for column in [3, 5] {
        assert!(table.iter().any(|row| row[column] == "1.00"), "{out}");
    }
}

#[test]
fn the_table_goes_to_csv_and_the_errors_to_svg() {
    let place = Place::with("ten.toml", TEN);
    let words = ["compare", "ten.toml", "--local", "sbp,ebp,pdas", "--csv", "table.csv", "--plot", "errors.svg"];
    place.moreau(&words).fine();

    let csv = place.read("table.csv");
    let (table, history) = csv.split_once("\n\n").expect("two tables");
    assert_eq!(table.lines().next().map(|line| line.starts_with("global,local,steps,sweeps_mean,")), Some(true), "{csv}");
    assert!(history.starts_with("global,local,sweep,"), "{csv}");
    for part in [table, history] {
        let columns = |line: &str| line.split(',').count();
        assert!(part.lines().all(|line| columns(line) == columns(part.lines().next().unwrap())), "{csv}");
    }
    assert_eq!(table.lines().count(), 4, "{csv}");
    for method in ["nlgs,sbp,", "nlgs,ebp,", "nlgs,pdas,"] {
        assert_eq!(table.matches(method).count(), 1, "{csv}");
        // Sweeps are counted from 1, and the last meets the tolerance.
        let sweeps: Vec<&str> = history.lines().filter_map(|line| line.strip_prefix(method)).collect();
        assert!(sweeps[0].starts_with("1,"), "{csv}");
        let total: f64 = sweeps[sweeps.len() - 1].split(',').nth(4).unwrap().parse().unwrap();
        assert!(total <= 1e-7, "{method} ends at {total}");
    }

    let svg = place.read("errors.svg");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{svg}");
    assert_eq!(svg.matches("<path").count() + svg.matches("<polyline").count(), 3, "a curve a method: {svg}");
    for words in ["nlgs+sbp", "nlgs+ebp", "nlgs+pdas", "ten: error by sweep at step 20"] {
        assert!(svg.contains(words), "`{words}`: {svg}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{svg}");
    assert_eq!(place.all(".").into_keys().collect::<Vec<_>>(), ["errors.svg", "table.csv", "ten.toml"]);
}

#[test]
fn figures_are_what_their_names_ask_for() {
    let place = Place::with("ten.toml", TEN);
    for (name, starts) in [("errors.png", b"\x89PNG".as_slice()), ("errors.pdf", b"%PDF")] {
        place.moreau(&["compare", "ten.toml", "--local", "pdas", "--plot", name]).fine();
        assert!(std::fs::read(place.path(name)).unwrap().starts_with(starts), "{name}");
    }
    place.moreau(&["compare", "ten.toml", "--local", "pdas", "--rho", "0.5,1", "--plot", "rho.pdf"]).fine();
    assert!(std::fs::read(place.path("rho.pdf")).unwrap().starts_with(b"%PDF"));
    place.refuses(&["compare", "ten.toml", "--plot", "errors.jpg"], 2, &["errors.jpg", ".svg, .png or .pdf"]);
}

#[test]
fn methods_that_disagree_are_an_error() {
    let place = Place::with("ten.toml", TEN);
    // So loose a tolerance is met by one sweep, which is no answer yet, and each method stops elsewhere.
    let loose = ["--set", "solver.tolerance=1e3", "--set", "solver.rho.relative=0.01"];
    let ran = place.moreau(&[&["compare", "ten.toml", "--local", "exact,sbp"], &loose[..]].concat());
    assert_eq!(ran.code, Some(5), "{ran:?}");
    assert!(ran.err.starts_with("error: nlgs+") && ran.err.contains("in step 20"), "{}", ran.err);
    assert_eq!(rows(&ran.out).len(), 2, "the table is printed all the same:\n{}", ran.out);
}

#[test]
fn a_method_that_fails_is_an_error() {
    let place = Place::with("ten.toml", TEN);
    let words = ["compare", "ten.toml", "--local", "pdas", "--set", "solver.max_sweeps=1", "--set", "solver.on_failure=stop"];
    let ran = place.moreau(&words);
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(ran.err.starts_with("error: nlgs+pdas: ") && ran.err.contains("did not converge"), "{}", ran.err);
}
