//! Limits of file sizes, full disks without room for names, and runs that end early: a message that names the user's files, code 1, no half
//! rows, and always a checkpoint to go on from.
#![cfg(target_os = "linux")]

mod common;

use common::{Place, Ran, TEN, without_seconds};
use moreau::checkpoint;
use std::process::Command;

/// Runs a line of the shell, in which $MOREAU is the program.
fn shell(place: &Place, line: &str) -> Ran {
    let program = place.command(&[]);
    let mut shell = Command::new("sh");
    let output = shell.args(["-c", line]).current_dir(place.path("")).env("MOREAU", program.get_program()).output().expect("sh");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Ran { words: line.to_owned(), code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

/// No file of a run has a temporary name, and no table ends in half a row.
#[track_caller]
fn is_whole(place: &Place, folder: &str) {
    let all = place.all(folder);
    assert!(all.keys().all(|name| !name.contains(".moreau-")), "{:?}", all.keys());
    let table = place.read(&format!("{folder}/steps.csv"));
    let commas = |line: &str| line.matches(',').count();
    assert!(table.is_empty() || table.ends_with('\n'), "{:?}", &table[table.len() - 80..]);
    assert!(table.lines().all(|line| commas(line) == 34), "{table}");
}

/// A limit that is met early leaves the checkpoint of the start, one that is met later a later one; the signal that the system sends is caught.
#[test]
fn a_limit_of_file_sizes_is_a_message_and_a_checkpoint() {
    let place = Place::with("ten.toml", TEN);
    let kinds = "output.kinds='[\"steps\"]'";
    let words = |folder: &str| format!("run ten.toml --quiet --steps 2000 --out {folder} --set {kinds}");
    let ran = shell(&place, &format!("exec $MOREAU {}", words("whole")));
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    for (blocks, every) in [(20, 0), (400, 0), (400, 100)] {
        let folder = format!("to-{blocks}-{every}");
        let more = format!("--set checkpoint.every={every} --set checkpoint.seconds=1e308");
        let ran = shell(&place, &format!("ulimit -f {blocks}; exec $MOREAU {} {more}", words(&folder)));
        ran.fails(1, &[&format!("cannot write {folder}/steps.csv: File too large"), &format!("moreau run --resume {folder}")]);
        assert!(!ran.err.contains(".moreau-"), "{}", ran.err);
        is_whole(&place, &folder);
        let last = checkpoint::last_step(&place.path(&folder)).expect("a checkpoint");
        assert_eq!(last > 0, every > 0, "step {last}");
        assert!(ran.err.contains(&format!("to go on from step {last}: ")), "{}", ran.err);
        place.moreau(&["run", "--resume", &folder, "--quiet"]).fine();
        let steps = |folder: &str| without_seconds(&place.read(&format!("{folder}/steps.csv")));
        assert!(steps(&folder) == steps("whole"), "steps.csv of {folder}");
    }
}

#[test]
fn a_limit_that_is_met_at_once_leaves_nothing() {
    let place = Place::with("ten.toml", TEN);
    let ran = shell(&place, "ulimit -f 1; exec $MOREAU run ten.toml --out small");
    ran.fails(1, &["cannot write small/run.json: file too large", "ulimit -f"]);
    assert!(!place.path("small").exists());
    // Other commands answer as well.
    place.moreau(&["run", "ten.toml", "--quiet"]).fine();
    let before = place.all(".");
    for words in ["report out/ten", "plot out/ten", "render out/ten", "compare ten.toml --local pdas --quiet --plot errors.svg"] {
        let ran = shell(&place, &format!("ulimit -f 1; exec $MOREAU {words} > /dev/null"));
        ran.fails(1, &["cannot write "]);
        assert!(!ran.err.contains(".moreau-"), "{}", ran.err);
        assert!(place.all(".") == before, "{words}");
    }
}

#[test]
fn a_disk_without_room_for_names_is_a_message() {
    if !Command::new("unshare").args(["-rm", "true"]).status().is_ok_and(|status| status.success()) {
        eprintln!("this system lets us mount nothing: left out");
        return;
    }
    let place = Place::with("ten.toml", TEN);
    std::fs::create_dir(place.path("disk")).unwrap();
    for names in 2..12 {
        let run = "$MOREAU run ten.toml --quiet --out disk/run; code=$?; rm -rf kept; cp -r disk kept; exit $code";
        let mount = format!("mount -t tmpfs -o nr_inodes={names} none disk");
        let ran = shell(&place, &format!("exec unshare -rm sh -c '{mount} && {run}'"));
        ran.fails(1, &["cannot write", "disk/run"]);
        assert!(!ran.err.contains(".moreau-"), "{}", ran.err);
        let kept = place.all("kept");
        assert!(kept.keys().all(|name| !name.contains(".moreau-")), "{:?}", kept.keys());
        // Nothing is left, or the run goes on.
        if !kept.is_empty() {
            assert!(ran.err.contains("moreau run --resume disk/run"), "{}: {:?}", ran.err, kept.keys());
            place.moreau(&["run", "--resume", "kept/run", "--quiet"]).fine();
        }
    }
}

#[test]
fn a_run_that_fails_goes_on_from_the_step_before() {
    let place = Place::with("ten.toml", TEN);
    let strict = ["--set", "solver.on_failure=stop", "--set", "solver.max_sweeps=1", "--set", "solver.tolerance=1e-12"];
    let all = ["--quiet", "--set", "output.kinds=[\"steps\", \"measures\", \"vtk\", \"trajectory\"]"];
    let ran = place.moreau(&[&["run", "ten.toml", "--out", "failed"][..], &strict, &all].concat());
    ran.fails(4, &["did not converge", "to go on from step 1: moreau run --resume failed"]);
    let mild = ["--set", "solver.on_failure=warn", "--set", "solver.max_sweeps=100000", "--set", "solver.tolerance=1e-7"];
    place.moreau(&[&["run", "--resume", "failed", "--quiet"][..], &mild].concat()).fine();
    place.moreau(&[&["run", "ten.toml", "--out", "whole"][..], &all, &mild].concat()).fine();
    for name in ["measures.csv", "vtk/bodies.pvd", "vtk/contacts.pvd", "vtk/bodies_00000000.vtp", "vtk/contacts_00000020.vtp"] {
        assert!(place.all("failed")[name] == place.all("whole")[name], "{name}");
    }
    let state = |folder: &str| checkpoint::newest(&place.path(folder)).unwrap().0.state_digest();
    assert_eq!(state("failed"), state("whole"));
    let steps = |folder: &str| without_seconds(&place.read(&format!("{folder}/steps.csv")));
    assert_eq!(steps("failed"), steps("whole"));
    let frames =
        |folder: &str| moreau::trajectory::Trajectory::open(&place.path(&format!("{folder}/trajectory.h5"))).unwrap().frames();
    assert_eq!(frames("failed"), frames("whole"));
}

#[test]
fn checkpoints_that_no_clock_reaches_are_those_of_the_start_and_the_end() {
    let place = Place::with("ten.toml", TEN);
    for seconds in ["1e308", "1e20"] {
        place.moreau(&["run", "ten.toml", "--quiet", "--out", seconds, "--set", &format!("checkpoint.seconds={seconds}")]).fine();
        let kept: Vec<String> = place.all(seconds).into_keys().filter(|name| name.starts_with("checkpoint-")).collect();
        assert_eq!(kept, ["checkpoint-000000000000.bin", "checkpoint-000000000020.bin"], "{seconds}");
        place.moreau(&["run", "--resume", seconds, "--steps", "25", "--quiet"]).fine();
    }
    place.moreau(&["run", "ten.toml", "--quiet", "--out", "none", "--set", "checkpoint.seconds=0"]).fine();
    assert!(checkpoint::last_step(&place.path("none")).is_none());
}
