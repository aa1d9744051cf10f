//! Runs that are to give the same again: from their own scene.toml, into the same folder, on more threads; and where they go.

mod common;

use common::{Place, TEN, without_seconds};

/// A thousand balls that touch their neighbours on a lattice: some 2900 contacts, enough for threads to share.
const THOUSAND: &str = r#"dimension = 3
gravity = [0.5, 0.25, -9.81]
time = { step = 1e-3, steps = 10 }
solver = { tolerance = 1e-5, start = "warm" }
materials.glass.density = 2500.0
default_law.coulomb = { friction = 0.3 }
output.every = 5
[[containers]]
min = [0.0, 0.0, 0.0]
max = [0.2, 0.2, 0.4]
open = ["+z"]
material = "glass"
[[generate]]
material = "glass"
count = 1000
radii.constant = 0.01
lattice = { min = [0.0, 0.0, 0.0], max = [0.2, 0.2, 0.3], spacing = 0.02 }
"#;

/// Two runs wrote the same frames, byte for byte, and the same steps.csv but for the seconds.
#[track_caller]
fn same(place: &Place, one: &str, other: &str) {
    let (ours, theirs) = (place.all(&format!("{one}/vtk")), place.all(&format!("{other}/vtk")));
    assert_eq!(ours.keys().collect::<Vec<_>>(), theirs.keys().collect::<Vec<_>>());
    assert!(ours.len() > 2, "no frames");
    for (name, content) in &ours {
        assert!(content == &theirs[name], "vtk/{name} of {one} and {other} differ");
    }
    let steps = |folder: &str| without_seconds(&place.read(&format!("{folder}/steps.csv")));
    assert_eq!(steps(one), steps(other));
}

#[test]
fn the_scene_in_the_folder_runs_again() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--out", "one", "--set", "solver.local=sbp", "--set", "output.every=4"]).fine();
    place.moreau(&["run", "one/scene.toml", "--out", "two"]).fine();
    same(&place, "one", "two");
    // Overrides are part of what was run.
    assert_eq!(place.summary("two")["solver"]["local"], "sbp");
    assert_eq!(place.read("one/scene.toml"), place.read("two/scene.toml"));
}

#[test]
fn the_same_scene_gives_the_same_twice() {
    let place = Place::with("ten.toml", TEN);
    for out in ["one", "two"] {
        place.moreau(&["run", "ten.toml", "--out", out]).fine();
    }
    same(&place, "one", "two");
}

#[test]
fn threads_do_not_change_a_bit() {
    let place = Place::with("thousand.toml", THOUSAND);
    for threads in ["1", "2", "5"] {
        place.moreau(&["run", "thousand.toml", "--threads", threads, "--out", threads]).fine();
        let summary = place.summary(threads);
        assert_eq!(summary["threads"].to_string(), threads);
        assert!(summary["contacts_mean"].as_f64().unwrap() > 1500.0, "too few contacts to be shared out: {summary}");
    }
    same(&place, "1", "2");
    same(&place, "1", "5");
}

#[test]
fn a_second_run_replaces_the_first_where_it_is_told_to() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--out", "same"]).fine();
    place.write("same/notes.txt", "not of the program");
    let other = ["--steps", "6", "--set", "output.every=3"];
    place.moreau(&[&["run", "ten.toml", "--out", "same", "--force"][..], &other].concat()).fine();
    place.moreau(&[&["run", "ten.toml", "--out", "fresh"][..], &other].concat()).fine();
    same(&place, "same", "fresh");
    assert_eq!(place.summary("same")["steps"], 6);
    assert_eq!(place.read("same/scene.toml"), place.read("fresh/scene.toml"));
    assert_eq!(place.read("same/notes.txt"), "not of the program");
    // What the second run does not write is not left from the first.
    place.moreau(&["run", "ten.toml", "--out", "same", "--force", "--set", "output.kinds=[]"]).fine();
    let files: Vec<String> = place.all("same").into_keys().collect();
    let checkpoints = ["checkpoint-000000000000.bin", "checkpoint-000000000020.bin"];
    assert_eq!(files, [&checkpoints[..], &["notes.txt", "run.json", "scene.toml", "summary.json"]].concat());
}

#[test]
fn a_run_leaves_no_files_but_its_own() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--set", "output.every=0"]).fine();
    let checkpoints = ["checkpoint-000000000000.bin", "checkpoint-000000000020.bin"];
    let others = ["run.json", "scene.toml", "steps.csv", "summary.json", "trajectory.h5"];
    let files = [&checkpoints[..], &others].concat().into_iter().map(|file| format!("out/ten/{file}"));
    let expected = [vec!["out".to_owned(), "out/ten".to_owned()], files.collect(), vec!["ten.toml".to_owned()]].concat();
    assert_eq!(place.all(".").into_keys().collect::<Vec<_>>(), expected);
    assert_eq!(place.read("ten.toml"), TEN);
}

#[test]
fn results_go_where_they_are_asked_to() {
    let place = Place::with("scenes/a.b.toml", TEN);
    let run = |more: &[&str]| place.moreau(&[&["run", "scenes/a.b.toml"], more].concat()).fine();
    // The default is named after the scene file, below the folder that the program runs in.
    assert!(run(&[]).contains("results in out/a.b\n"));
    assert!(run(&["--set", "output.folder=as/said"]).contains("results in as/said\n"));
    // The command line is closer than the scene.
    assert!(run(&["--set", "output.folder=not/here", "--out", "but/here"]).contains("results in but/here\n"));
    for folder in ["out/a.b", "as/said", "but/here"] {
        assert_eq!(place.summary(folder)["steps"], 20, "{folder}");
    }
    assert!(!place.path("not").exists());
}

#[test]
fn steps_and_values_can_be_set_for_one_run() {
    let place = Place::with("ten.toml", TEN);
    let words = ["run", "ten.toml", "--steps", "3", "--set", "time.steps=9", "--set", "solver.tolerance=1e-4", "--set"];
    place.moreau(&[&words[..], &["generate.0.count=4"]].concat()).fine();
    let summary = place.summary("out/ten");
    assert_eq!((&summary["steps"], &summary["bodies"]), (&3.into(), &9.into()), "`--steps` goes before `--set`");
    assert_eq!(summary["solver"]["tolerance"], 1e-4);
    let scene = place.read("out/ten/scene.toml");
    assert!(scene.contains("steps = 3\n") && scene.contains("tolerance = 0.0001\n") && scene.contains("count = 4\n"), "{scene}");
}
