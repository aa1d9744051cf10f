//! Ctrl-C: the program ends within a second, with code 130 and every whole step that it computed.
#![cfg(unix)]

mod common;

use common::problems::{chain, put};
use common::{Place, TEN};
use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A child that does not outlive its test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It has ended already where the test went well.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Running {
    fn start(place: &Place, words: &[&str]) -> Self {
        let mut command = place.command(words);
        Self(command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts"))
    }

    /// Sends SIGINT, as a terminal does on Ctrl-C.
    fn interrupt(&self) {
        self.send("INT");
    }

    fn send(&self, signal: &str) {
        let words = ["-c", "kill -$1 \"$0\"", &self.0.id().to_string(), signal];
        let status = Command::new("sh").args(words).status().expect("sh");
        assert!(status.success(), "the program ended before it was interrupted");
    }

    /// Waits for the end, at most 20 s: the exit code, the standard output and error.
    fn end(mut self) -> (Option<i32>, String, String) {
        let until = Instant::now() + Duration::from_secs(20);
        let status = loop {
            match self.0.try_wait().expect("the child is there") {
                Some(status) => break status,
                None if Instant::now() > until => panic!("the program goes on after Ctrl-C"),
                None => std::thread::sleep(Duration::from_millis(10)),
            }
        };
        let (mut out, mut err) = (String::new(), String::new());
        self.0.stdout.take().expect("a pipe").read_to_string(&mut out).expect("text");
        self.0.stderr.take().expect("a pipe").read_to_string(&mut err).expect("text");
        (status.code(), out, err)
    }
}

/// Waits until `file` is longer than its first line, at most 10 s.
fn wait_for_rows(place: &Place, file: &str) {
    let until = Instant::now() + Duration::from_secs(10);
    while std::fs::metadata(place.path(file)).map_or(0, |file| file.len()) < 1000 {
        assert!(Instant::now() < until, "{file} does not grow");
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn a_run_keeps_what_it_computed() {
    let place = Place::with("ten.toml", TEN);
    // A step takes some ten microseconds: so many take hours.
    let words = ["run", "ten.toml", "--out", "long", "--steps", "1000000000", "--set", "output.every=1000"];
    let running = Running::start(&place, &words);
    wait_for_rows(&place, "long/steps.csv");
    running.interrupt();
    let (code, out, err) = running.end();
    assert_eq!(code, Some(130), "{err}");

    let steps = place.summary("long")["steps"].as_u64().unwrap();
    assert!(0 < steps && steps < 1_000_000_000);
    let go_on = format!("; to go on from step {steps}: moreau run --resume long");
    let message = format!("interrupted: the {steps} steps before are kept in long{go_on}\n");
    assert_eq!(err, message, "one message and no progress bar");
    assert!(out.contains(&format!("{steps} steps")) && out.contains("results in long"), "{out}");

    // Each step has its row, and no row is cut off.
    let csv = place.read("long/steps.csv");
    assert!(csv.ends_with('\n') && csv.lines().count() as u64 == 1 + steps, "{steps} steps");
    let commas = |line: &str| line.matches(',').count();
    assert!(csv.lines().all(|line| commas(line) == commas(csv.lines().next().unwrap())));
    assert!(csv.lines().last().unwrap().starts_with(&format!("{steps},")));

    // The collections are whole and name the files that are there.
    for kind in ["bodies", "contacts"] {
        let pvd = place.read(&format!("long/vtk/{kind}.pvd"));
        assert!(pvd.trim_end().ends_with("</VTKFile>"), "{pvd}");
        let last = format!("{kind}_{:08}.vtp", steps / 1000 * 1000);
        assert!(pvd.contains(&last) && place.path("long/vtk").join(&last).exists(), "{last} is missing");
    }
    let left: Vec<String> = place.all("long").into_keys().filter(|name| name.contains(".moreau")).collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn a_quiet_run_says_only_that_it_was_interrupted() {
    let place = Place::with("ten.toml", TEN);
    let words = ["run", "ten.toml", "--out", "long", "--steps", "1000000000", "--quiet", "--set", "output.every=0"];
    let running = Running::start(&place, &words);
    wait_for_rows(&place, "long/steps.csv");
    running.interrupt();
    let (code, out, err) = running.end();
    assert_eq!((code, out.as_str()), (Some(130), ""));
    assert!(err.starts_with("interrupted: ") && err.lines().count() == 1, "{err}");
}

#[test]
fn a_system_that_goes_down_may_ask_a_run_to_end() {
    let place = Place::with("ten.toml", TEN);
    for signal in ["TERM", "HUP"] {
        let words = ["run", "ten.toml", "--out", signal, "--steps", "1000000000", "--quiet", "--set", "output.every=0"];
        let running = Running::start(&place, &words);
        wait_for_rows(&place, &format!("{signal}/steps.csv"));
        running.send(signal);
        let (code, _, err) = running.end();
        assert_eq!(code, Some(130), "{err}");
        assert!(err.contains(&format!("moreau run --resume {signal}")), "{err}");
        let steps = place.summary(signal)["steps"].as_u64().unwrap();
        place.moreau(&["run", "--resume", signal, "--steps", &(steps + 10).to_string(), "--quiet"]).fine();
        assert_eq!(place.summary(signal)["steps"], steps + 10);
    }
}

#[test]
fn two_runs_do_not_write_into_one_folder() {
    let place = Place::with("ten.toml", TEN);
    let words = ["run", "ten.toml", "--out", "mine", "--steps", "1000000000", "--quiet", "--set", "output.every=0"];
    let running = Running::start(&place, &words);
    wait_for_rows(&place, "mine/steps.csv");
    for words in [&["run", "ten.toml", "--out", "mine"][..], &["run", "--resume", "mine"]] {
        place.moreau(words).fails(1, &["cannot write into mine: another run is at work there"]);
    }
    running.interrupt();
    assert_eq!(running.end().0, Some(130));
    let steps = place.summary("mine")["steps"].as_u64().unwrap();
    assert_eq!(place.read("mine/steps.csv").lines().count() as u64, 1 + steps);
    place.moreau(&["run", "ten.toml", "--out", "mine", "--quiet", "--force"]).fine();
}

/// What makes a step take hours.
const HOURS: [&str; 6] =
    ["--set", "solver.max_sweeps=1000000000000", "--set", "solver.tolerance=1e-300", "--set", "solver.global=nlgs"];

/// Waits until there is such a file, and a little more.
fn wait_for(path: &std::path::Path) {
    let until = Instant::now() + Duration::from_secs(10);
    while !path.exists() {
        assert!(Instant::now() < until, "it does not begin");
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(300));
}

#[test]
fn a_step_is_given_up_within_a_second_and_the_one_before_it_is_kept() {
    let place = Place::with("ten.toml", TEN);
    for signal in ["INT", "TERM"] {
        let words = [&["run", "ten.toml", "--out", signal, "--quiet"][..], &HOURS].concat();
        let running = Running::start(&place, &words);
        wait_for(&place.path(&format!("{signal}/scene.toml")));
        let since = Instant::now();
        running.send(signal);
        let (code, _, err) = running.end();
        assert!(since.elapsed() < Duration::from_secs(1), "{:?}", since.elapsed());
        assert_eq!(code, Some(130), "{err}");
        let steps = place.summary(signal)["steps"].as_u64().unwrap();
        assert!(err.contains(&format!("the {steps} steps before are kept in {signal}; to go on from step {steps}: ")), "{err}");
        // No file has the step that was given up.
        assert_eq!(place.read(&format!("{signal}/steps.csv")).lines().count() as u64, 1 + steps);
    }
}

#[test]
fn a_solve_is_given_up_within_a_second_and_tells_how_far_it_came() {
    let place = Place::new();
    put(&place, "p.dat", &chain(100));
    let hours = ["--max-sweeps", "1000000000000", "--tolerance", "1e-300", "--global", "nlgs"];
    let running = Running::start(&place, &[&["solve", "p.dat", "--json"][..], &hours].concat());
    std::thread::sleep(Duration::from_millis(500));
    let since = Instant::now();
    running.interrupt();
    let (code, out, err) = running.end();
    assert!(since.elapsed() < Duration::from_secs(1), "{:?}", since.elapsed());
    assert_eq!(code, Some(130), "{err}");
    assert!(out.contains("\"interrupted\""), "{out}");
}

#[test]
fn a_second_signal_ends_it_at_once() {
    let place = Place::new();
    // A pipe that nobody writes into is waited for: no flag is looked at.
    let made = Command::new("mkfifo").arg(place.path("p.dat")).status().expect("mkfifo");
    assert!(made.success());
    let running = Running::start(&place, &["solve", "p.dat"]);
    std::thread::sleep(Duration::from_millis(300));
    running.interrupt();
    std::thread::sleep(Duration::from_millis(300));
    running.interrupt();
    let (code, out, err) = running.end();
    assert_eq!((code, out.as_str(), err.as_str()), (Some(130), "", ""));
}

#[test]
fn a_comparison_ends_with_what_it_has() {
    let place = Place::with("ten.toml", TEN);
    // The comparison's own step comes early, so that the long run of the first method is what is interrupted.
    let words = ["compare", "ten.toml", "--at", "3", "--csv", "table.csv", "--set", "time.steps=1000000000"];
    let running = Running::start(&place, &words);
    // It writes nothing on its way that could be waited for.
    std::thread::sleep(Duration::from_secs(2));
    running.interrupt();
    let (code, out, err) = running.end();
    assert_eq!(code, Some(130), "{err}");
    assert!(err.starts_with("interrupted: "), "{err}");
    assert!(out.contains("nlgs+sbp") && !out.contains("nlgs+pdas"), "the first method, and none after it:\n{out}");
    assert!(place.read("table.csv").contains("nlgs,sbp,"));
}
