//! Disks that are full, folders that become read-only, files that are damaged: a message, a code, and nothing lost but the steps since the
//! last checkpoint.
#![cfg(target_os = "linux")]

mod common;

use common::{Place, Ran, TEN, without_seconds};
use std::process::Command;

/// The run that nothing disturbs, and the words for one in another folder.
const WORDS: [&str; 8] = ["run", "ten.toml", "--quiet", "--steps", "4000", "--set", "checkpoint.every=200", "--out"];

/// Runs a line of the shell, in which $MOREAU is the program.
fn shell(place: &Place, line: &str) -> Ran {
    let program = place.command(&[]);
    let words = ["-c", line];
    let output =
        Command::new("sh").args(words).current_dir(place.path("")).env("MOREAU", program.get_program()).output().expect("sh");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Ran { words: line.to_owned(), code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

/// The run in this folder goes on, and ends as the one that nothing disturbed.
#[track_caller]
fn goes_on(place: &Place, folder: &str) {
    place.moreau(&["run", "--resume", folder, "--quiet"]).fine();
    same(place, folder);
}

/// The run in this folder is as the one that nothing disturbed.
#[track_caller]
fn same(place: &Place, folder: &str) {
    let steps = |folder: &str| without_seconds(&place.read(&format!("{folder}/steps.csv")));
    assert!(steps(folder) == steps("whole"), "steps.csv");
    let state = |folder: &str| moreau::checkpoint::newest(&place.path(folder)).unwrap().0.state_digest();
    assert_eq!(state(folder), state("whole"));
}

fn whole() -> Place {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&[&WORDS[..], &["whole"]].concat()).fine();
    place
}

/// A file that may not grow beyond so many blocks of 512 bytes: what a full disk says, without one.
#[test]
fn a_quota_ends_a_run_with_its_last_checkpoint() {
    let place = whole();
    for blocks in [1, 20, 400, 1500] {
        let folder = format!("quota{blocks}");
        let line = format!("ulimit -f {blocks}; exec $MOREAU {} {folder}", WORDS.join(" "));
        let ran = shell(&place, &line);
        ran.fails(1, &["cannot write"]);
        if blocks < 400 {
            assert!(!place.path(&folder).exists(), "there was no room for the start");
        } else {
            assert!(ran.err.contains(&format!("moreau run --resume {folder}")), "{}", ran.err);
            goes_on(&place, &folder);
        }
    }
}

#[test]
fn a_full_disk_ends_a_run_with_its_last_checkpoint() {
    if !Command::new("unshare").args(["-rm", "true"]).status().is_ok_and(|status| status.success()) {
        eprintln!("this system lets us mount nothing: left out");
        return;
    }
    let place = whole();
    std::fs::create_dir(place.path("disk")).unwrap();
    let run = format!("$MOREAU {} disk/run; code=$?; cp -r disk/run kept; exit $code", WORDS.join(" "));
    let ran = shell(&place, &format!("exec unshare -rm sh -c 'mount -t tmpfs -o size=1m none disk && {run}'"));
    ran.fails(1, &["cannot write", "moreau run --resume"]);
    goes_on(&place, "kept");
}

#[test]
fn a_folder_that_becomes_read_only_ends_a_run_with_its_last_checkpoint() {
    let place = Place::with("ten.toml", TEN);
    // Root may write anywhere unless it is forbidden to.
    let powerless = "setpriv --bounding-set=-dac_override,-dac_read_search";
    let root = shell(&place, "id -u").out.trim() == "0";
    if root && shell(&place, &format!("{powerless} true")).code != Some(0) {
        eprintln!("this system does not let us take rights away: left out");
        return;
    }
    let words = WORDS.join(" ").replace("4000", "400000");
    let run = format!(
        "{} $MOREAU {words} folder & while ! ls folder/checkpoint-* > /dev/null 2>&1; do sleep 0.01; done",
        if root { powerless } else { "" }
    );
    let ran = shell(&place, &format!("{run}; chmod 555 folder; wait $!; code=$?; chmod 755 folder; exit $code"));
    ran.fails(1, &["cannot write", "moreau run --resume folder"]);
    let steps = moreau::checkpoint::last_step(&place.path("folder")).expect("a checkpoint") + 100;
    place.moreau(&["run", "ten.toml", "--quiet", "--steps", &steps.to_string(), "--out", "whole"]).fine();
    place.moreau(&["run", "--resume", "folder", "--quiet", "--steps", &steps.to_string()]).fine();
    same(&place, "folder");
}

#[test]
fn a_damaged_checkpoint_is_passed_over() {
    let place = whole();
    let [before, last] = ["checkpoint-000000003800.bin", "checkpoint-000000004000.bin"].map(|name| format!("whole/{name}"));
    place.moreau(&[&WORDS[..], &["broken"]].concat()).fine();
    let damage = |name: &str| {
        let name = name.replace("whole", "broken");
        let mut bytes = std::fs::read(place.path(&name)).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 16;
        place.write(&name, bytes);
    };
    damage(&last);
    let ran = place.moreau(&["run", "--resume", "broken", "--quiet"]);
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    assert!(ran.err.starts_with("note: went back to the checkpoint before: broken/checkpoint-000000004000.bin: it is damaged"));
    goes_on(&place, "broken");
    damage(&last);
    damage(&before);
    place.refuses(&["run", "--resume", "broken"], 1, &["checkpoint-000000004000.bin: it is damaged: its checksum is wrong"]);
}

#[test]
fn what_cannot_be_gone_on_with_is_refused() {
    let place = whole();
    place.moreau(&[&WORDS[..], &["other"]].concat()).fine();
    let restore =
        |name: &str| place.write(&format!("other/{name}"), std::fs::read(place.path(&format!("whole/{name}"))).unwrap());
    let resume = ["run", "--resume", "other", "--steps", "4100"];
    // A table in which someone changed a digit.
    let steps = place.read("other/steps.csv");
    place.write("other/steps.csv", steps.replacen("10,", "11,", 1));
    place.refuses(&resume, 1, &["cannot go on with other/steps.csv: it is not what the run wrote"]);
    place.write("other/steps.csv", &steps[..steps.len() / 2]);
    place.refuses(&resume, 1, &["cannot go on with other/steps.csv"]);
    place.write("other/steps.csv", steps);
    // A trajectory that is cut off.
    let trajectory = std::fs::read(place.path("other/trajectory.h5")).unwrap();
    place.write("other/trajectory.h5", &trajectory[..trajectory.len() / 2]);
    place.refuses(&resume, 1, &["other/trajectory.h5"]);
    restore("trajectory.h5");
    // Other bodies.
    place.refuses(&[&resume[..], &["--set", "generate.0.count=9"]].concat(), 3, &["it has other bodies than the run had"]);
    // No run at all.
    place.refuses(&["run", "--resume", "nowhere"], 1, &["nowhere: there is no checkpoint to go on from"]);
    // A file that was moved away begins anew, with a word about it.
    std::fs::remove_file(place.path("other/steps.csv")).unwrap();
    let ran = place.moreau(&[&resume[..], &["--quiet"]].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    assert!(ran.err.contains("note: began it anew from here: other/steps.csv is not there any more"), "{}", ran.err);
    assert!(place.read("other/steps.csv").lines().nth(1).unwrap().starts_with("4001,"));
}

#[test]
fn a_step_that_breaks_a_limit_is_named_and_can_be_done_otherwise() {
    let place = Place::with("ten.toml", TEN);
    let run = |out: &str, more: &[&str]| {
        let words = ["run", "ten.toml", "--quiet", "--out", out, "--set", "time.step=2e-3", "--set", "guard.penetration=0.02"];
        // Overlaps are to stay, and to be found a step late.
        let sinks = ["--set", "solver.max_penetration=never", "--set", "default_law.coulomb.acts=closed"];
        place.moreau(&[&words[..], &["--set", "checkpoint.every=1"], &sinks, more].concat())
    };
    let warned = run("warned", &[]);
    assert_eq!(warned.code, Some(0), "{}", warned.err);
    assert!(warned.err.contains("steps broke a limit of [guard]; the first: step "), "{}", warned.err);
    let summary = place.summary("warned");
    assert!(summary["breaches"].as_u64().unwrap() > 0 && summary["first_breach"].as_str().unwrap().contains("overlap by"));
    let stopped = run("stopped", &["--set", "guard.policy=stop"]);
    stopped.fails(
        4,
        &["in the step to t = ", "bodies ", " overlap by ", " is ", "problems of 1 failed solves", "moreau run --resume stopped"],
    );
    assert!(place.all("stopped").keys().any(|name| name.starts_with("failed-step-")), "its problem");
    place.moreau(&["run", "--resume", "stopped", "--quiet", "--set", "guard.penetration=0.5"]).fine();
}
