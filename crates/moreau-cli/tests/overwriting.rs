//! Files that commands write: one that exists is refused unless `--force` is given, or the program made it in the folder of a run.

mod common;

use common::problems::{chain, put};
use common::{Place, TEN};

/// The command writes `file`, refuses to write it again, and replaces it with `--force`.
#[track_caller]
fn replaces_only_by_force(place: &Place, words: &[&str], file: &str) {
    place.moreau(words).fine();
    place.write(file, "mine");
    place.refuses(words, 1, &[&format!("cannot write {file}: it exists already"), "--force"]);
    place.moreau(&[words, &["--force"]].concat()).fine();
    assert_ne!(std::fs::read(place.path(file)).unwrap(), b"mine", "{file}");
}

#[test]
fn files_that_are_named_are_replaced_only_by_force() {
    let place = Place::with("ten.toml", TEN);
    put(&place, "a.dat", &chain(3));
    put(&place, "all/a.dat", &chain(3));
    place.moreau(&["run", "ten.toml"]).fine();
    replaces_only_by_force(&place, &["report", "out/ten", "--out", "page.html"], "page.html");
    replaces_only_by_force(&place, &["plot", "out/ten", "--out", "plot.png"], "plot.png");
    replaces_only_by_force(&place, &["render", "out/ten", "--size", "80x60", "--out", "picture.png"], "picture.png");
    replaces_only_by_force(&place, &["render", "out/ten", "--size", "80x60", "--out", "movie.gif"], "movie.gif");
    replaces_only_by_force(&place, &["compare", "ten.toml", "--local", "pdas", "--csv", "table.csv"], "table.csv");
    replaces_only_by_force(&place, &["compare", "ten.toml", "--local", "pdas", "--plot", "errors.svg"], "errors.svg");
    replaces_only_by_force(&place, &["convert", "a.dat", "b.hdf5"], "b.hdf5");
    replaces_only_by_force(&place, &["solve", "a.dat", "--out", "solved.hdf5"], "solved.hdf5");
    let profile = ["profile", "all", "--out", "profiles"];
    replaces_only_by_force(&place, &profile, "profiles/results.csv");
    place.write("other/profile-time.svg", "mine");
    place.refuses(&["profile", "all", "--out", "other"], 1, &["cannot write other/profile-time.svg: it exists already"]);
    // A run's own files are no exception where they are named.
    place.refuses(&["compare", "ten.toml", "--csv", "out/ten/steps.csv"], 1, &["cannot write out/ten/steps.csv: it exists"]);
}

#[test]
fn the_programs_own_files_in_the_folder_of_a_run_are_replaced() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml"]).fine();
    for (command, file) in [("report", "report.html"), ("plot", "plot.svg"), ("render", "picture.png")] {
        let file = format!("out/ten/{file}");
        place.moreau(&[command, "out/ten"]).fine();
        let first = std::fs::read(place.path(&file)).unwrap();
        place.write(&file, "older");
        place.moreau(&[command, "out/ten"]).fine();
        assert!(std::fs::read(place.path(&file)).unwrap() == first, "{file}");
    }
    for _ in 0..2 {
        place.moreau(&["run", "ten.toml", "--convergence"]).fine();
    }
    // Without the marker nobody knows whose they are.
    std::fs::remove_file(place.path("out/ten/run.json")).unwrap();
    for (command, file) in [("report", "report.html"), ("plot", "plot.svg"), ("render", "picture.png")] {
        place.refuses(&[command, "out/ten"], 1, &[&format!("cannot write out/ten/{file}: it exists already"), "--force"]);
        place.moreau(&[command, "out/ten", "--force"]).fine();
    }
}

#[test]
fn a_study_marks_its_folder_and_replaces_its_own_table() {
    let place = Place::with("ten.toml", TEN);
    let study = ["run", "ten.toml", "--convergence", "1", "--out", "study"];
    place.moreau(&study).fine();
    assert_eq!(place.all("study").into_keys().collect::<Vec<_>>(), ["convergence.csv", "run.json"]);
    place.moreau(&study).fine();
    place.moreau(&[&study[..], &["--new"]].concat()).fine();
    assert!(place.path("study-2/convergence.csv").exists());
    place.refuses(&[&study[..], &["--force"]].concat(), 2, &["--force", "--convergence"]);
    place.moreau(&["run", "ten.toml", "--out", "study", "--force"]).fine();
    assert!(!place.path("study/convergence.csv").exists(), "it belonged to what was replaced");
}

#[cfg(target_os = "linux")]
#[test]
fn devices_are_never_replaced() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml"]).fine();
    place.refuses(
        &["report", "out/ten", "--out", "/dev/null", "--force"],
        1,
        &["cannot write /dev/null: it is not a plain file"],
    );
}
