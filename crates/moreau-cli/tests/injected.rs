//! A run changes files by calls, and each of them fails once: the run names the file, leaves nothing half written, and goes on to the same bits.
#![cfg(target_os = "linux")]

mod common;

use common::{Place, Ran, TEN, without_seconds};
use std::path::PathBuf;
use std::process::Command;

const WORDS: [&str; 8] = ["run", "ten.toml", "--quiet", "--steps", "10", "--set", "checkpoint.every=5", "--out"];

/// Builds the library that makes calls fail; see there.
fn library(place: &Place) -> PathBuf {
    let (source, library) = (concat!(env!("CARGO_MANIFEST_DIR"), "/tests/common/fault.c"), place.path("fault.so"));
    let words = ["-shared", "-fPIC", "-O1", source, "-ldl", "-o"];
    let built = Command::new("cc").args(words).arg(&library).status().expect("a C compiler");
    assert!(built.success());
    library
}

/// Runs the program with the library, of which `variable` asks something.
fn run(place: &Place, folder: &str, (variable, value): (&str, &str)) -> Ran {
    let words = [&WORDS[..], &[folder]].concat();
    let mut command = place.command(&words);
    command.env("LD_PRELOAD", place.path("fault.so")).env(variable, value);
    let output = command.output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Ran { words: words.join(" "), code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

/// Both folders hold the same run: the same files, of which those with no clock in them are the same to the last bit.
#[track_caller]
fn same(place: &Place, folder: &str, what: &str) {
    let (ours, theirs) = (place.all(folder), place.all("whole"));
    let names = |all: &std::collections::BTreeMap<String, Option<Vec<u8>>>| all.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&ours), names(&theirs), "{what}");
    for (name, content) in &ours {
        let timed =
            ["checkpoint-", "summary.json", "steps.csv", "trajectory.h5", "run.json"].iter().any(|timed| name.starts_with(timed));
        assert!(timed || content == &theirs[name], "{what}: {name}");
    }
    let steps = |folder: &str| without_seconds(&place.read(&format!("{folder}/steps.csv")));
    assert!(steps(folder) == steps("whole"), "{what}: steps.csv");
    let state = |folder: &str| moreau::checkpoint::newest(&place.path(folder)).unwrap().0.state_digest();
    assert_eq!(state(folder), state("whole"), "{what}");
    let frames = |folder: &str| {
        let trajectory = moreau::trajectory::Trajectory::open(&place.path(&format!("{folder}/trajectory.h5"))).unwrap();
        (0..trajectory.frames()).map(|i| trajectory.frame(i).unwrap()).collect::<Vec<_>>()
    };
    assert!(frames(folder) == frames("whole"), "{what}: trajectory.h5");
}

#[test]
fn every_write_may_fail() {
    let all = "output = { every = 5, kinds = [\"vtk\", \"steps\", \"trajectory\", \"measures\"] }";
    let place = Place::with("ten.toml", &TEN.replace("output.every = 5", all));
    library(&place);
    run(&place, "whole", ("FAULT_COUNT", "count")).fine();
    let count: u64 = place.read("count").trim().parse().unwrap();
    assert!(count > 200, "the library is not heard of: {count} calls");
    let (mut ended, mut harmless) = (0, 0);
    for n in 1..=count {
        let ran = run(&place, "run", ("FAULT_AT", &n.to_string()));
        let what = format!("call {n} of {count}: {}", ran.err);
        if ran.code == Some(0) {
            harmless += 1;
        } else {
            ended += 1;
            ran.fails(1, &["cannot write"]);
            let why = ["No space left on device", "no storage space"].iter().any(|why| ran.err.contains(why));
            assert!(why, "{what}");
            assert!(ran.err.contains("run") && !ran.err.contains(".moreau"), "it names no file of the user's: {what}");
            let begun = place.path("run/run.json").exists();
            assert!(begun || place.all("run").is_empty(), "{what}: left {:?}", place.all("run").keys());
            let again = if begun { vec!["run", "--resume", "run", "--quiet"] } else { [&WORDS[..], &["run"]].concat() };
            place.moreau(&again).fine();
        }
        same(&place, "run", &what);
        std::fs::remove_dir_all(place.path("run")).unwrap();
    }
    println!("{count} calls: {ended} ended the run, {harmless} did no harm");
    assert!(ended > 9 * harmless, "{ended} ended the run, {harmless} did not");
}
