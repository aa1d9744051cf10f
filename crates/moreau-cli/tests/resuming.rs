//! Runs that are killed and go on: with the bits of a run that nobody disturbed.
#![cfg(unix)]

mod common;

use common::{Place, TEN, without_seconds};
use moreau::checkpoint;
use moreau::trajectory::Trajectory;
use rand::{Rng, SeedableRng};
use std::process::{ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// All that a run keeps from step to step: grains that a source rains onto a plate that shakes, past a gate that goes, until a sink takes
/// them; a pendulum on a hinge; friction, and solves that start from the last impulses.
const BUSY: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -9.81]
time = { step = 5e-4, steps = 20000 }
solver = { tolerance = 1e-8, start = "warm" }
materials.stone.density = 2500.0
default_law.coulomb = { friction = 0.4, restitution = 0.2 }
output = { every = 100, kinds = ["steps", "measures", "vtk", "trajectory"], precision = "double" }
checkpoint.every = 100

[[bodies]]
name = "plate"
shape.box.size = [0.5, 0.5, 0.02]
material = "stone"
position = [0.0, 0.0, -0.01]
drive = [{ velocity = [{ sine = { amplitude = 0.05, frequency = 8.0 } }, 0.0, 0.0] }, { from = 2.0, motion = "fixed" }]

[[bodies]]
name = "gate"
shape.box.size = [0.02, 0.5, 0.2]
material = "stone"
position = [0.15, 0.0, 0.1]
motion = "fixed"
removed_at = 1.0

[[bodies]]
name = "bob"
shape.box.size = [0.03, 0.04, 0.05]
material = "stone"
position = [0.0, 0.0, 0.5]
velocity = [0.4, 0.0, 0.0]
spin = [0.0, 2.0, 0.0]

[[joints]]
kind.hinge = { anchor = [0.0, 0.0, 0.7], axis = [0.0, 1.0, 0.0] }
between = ["bob"]

[[sources]]
material = "stone"
radii.uniform = { min = 0.012, max = 0.02 }
min = [-0.1, -0.1, 0.2]
max = [0.1, 0.1, 0.3]
rate = 20.0
count = 30

[[sinks]]
min = [-10.0, -10.0, -10.0]
max = [10.0, 10.0, -0.5]
"#;

/// What two runs must share: the state at their end, the rows, the frames of both kinds, to the last bit.
#[track_caller]
fn same(place: &Place, one: &str, other: &str) {
    let last = |folder: &str| checkpoint::newest(&place.path(folder)).expect("a checkpoint").0;
    let (ours, theirs) = (last(one), last(other));
    assert_eq!((ours.steps(), ours.state_digest()), (theirs.steps(), theirs.state_digest()), "the state");
    let steps = |folder: &str| without_seconds(&place.read(&format!("{folder}/steps.csv")));
    assert!(steps(one) == steps(other), "steps.csv");
    assert!(place.read(&format!("{one}/measures.csv")) == place.read(&format!("{other}/measures.csv")), "measures.csv");
    let (ours, theirs) = (place.all(&format!("{one}/vtk")), place.all(&format!("{other}/vtk")));
    assert!(ours.keys().eq(theirs.keys()), "names in vtk/");
    ours.iter().for_each(|(name, content)| assert!(content == &theirs[name], "vtk/{name}"));
    let open = |folder: &str| Trajectory::open(&place.path(&format!("{folder}/trajectory.h5"))).expect("a trajectory");
    let (ours, theirs) = (open(one), open(other));
    assert_eq!((ours.header(), ours.steps()), (theirs.header(), theirs.steps()));
    // As text, for absent bodies are nowhere, which equals nothing.
    let frame = |trajectory: &Trajectory, i| format!("{:?}", trajectory.frame(i).unwrap());
    (0..ours.frames()).for_each(|i| assert!(frame(&ours, i) == frame(&theirs, i), "frame {i}"));
    let numbers = |trajectory: &Trajectory| trajectory.columns().unwrap()[..30].to_vec();
    assert!(numbers(&ours) == numbers(&theirs), "records");
    // Sums over all steps, whoever did them.
    let sums = |folder: &str| {
        let mut summary = place.summary(folder);
        for name in ["seconds", "threads", "memory_bytes"] {
            summary.as_object_mut().unwrap().remove(name);
        }
        summary
    };
    assert_eq!(sums(one), sums(other));
}

/// Starts the program, and kills it after a time; how it ended, if it did so before.
fn live(place: &Place, words: &[&str], time: Duration) -> Option<ExitStatus> {
    let mut child = place.command(words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("the program starts");
    let until = Instant::now() + time;
    while Instant::now() < until {
        if let Some(status) = child.try_wait().expect("the child is there") {
            return Some(status);
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().expect("SIGKILL");
    child.wait().expect("the child is there");
    None
}

/// Fifty, or as many as MOREAU_KILLS says, fifty at a time.
#[test]
fn fifty_kills_change_no_bit() {
    let wanted: u64 = std::env::var("MOREAU_KILLS").map_or(50, |count| count.parse().expect("a number of kills"));
    for round in 0..wanted.div_ceil(50) {
        kill_fifty_times(11 + round);
        println!("{} kills", 50 * (round + 1));
    }
}

fn kill_fifty_times(seed: u64) {
    let place = Place::with("busy.toml", BUSY);
    let clock = Instant::now();
    place.moreau(&["run", "busy.toml", "--out", "whole", "--threads", "2", "--quiet"]).fine();
    let whole = clock.elapsed();
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
    let mut kills = 0;
    let mut reached = 0;
    while kills < 50 {
        let begun = checkpoint::newest(&place.path("killed")).map(|(checkpoint, _)| checkpoint.steps());
        let threads = ["1", "2", "3", "8"][(random.next_u64() % 4) as usize];
        let what: &[&str] = if begun.is_ok() { &["--resume", "killed"] } else { &["busy.toml", "--out", "killed", "--force"] };
        let words = [&["run"], what, &["--quiet", "--threads", threads]].concat();
        // All lives together are about three quarters of what the whole run took.
        let part = (random.next_u64() % 1000) as f64 / 1000.0;
        match live(&place, &words, whole.mul_f64(0.03 * part)) {
            None => kills += 1,
            Some(status) => {
                assert!(status.success(), "{status}");
                panic!("the run came to its end after {kills} kills");
            }
        }
        let now = checkpoint::newest(&place.path("killed")).map_or(0, |(checkpoint, _)| checkpoint.steps());
        assert!(now >= reached, "nothing is lost but the steps since the last checkpoint");
        reached = now;
    }
    assert!(reached > 0, "no life was long enough for a checkpoint");
    place.moreau(&["run", "--resume", "killed", "--quiet"]).fine();
    same(&place, "whole", "killed");
    let left: Vec<String> = place.all("killed").into_keys().filter(|name| name.contains(".moreau-")).collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn a_run_that_is_over_can_be_made_longer() {
    let place = Place::with("ten.toml", TEN);
    let all = ["--set", "output.kinds=[\"steps\", \"measures\", \"vtk\", \"trajectory\"]", "--quiet"];
    place.moreau(&[&["run", "ten.toml", "--out", "long", "--steps", "300"][..], &all].concat()).fine();
    place.moreau(&[&["run", "ten.toml", "--out", "short", "--steps", "130"][..], &all].concat()).fine();
    let said = place.moreau(&["run", "--resume", "short", "--steps", "300"]).fine();
    assert!(said.contains("gone on from step 130"), "{said}");
    same(&place, "long", "short");
    // Again, with nothing left to do.
    place.moreau(&["run", "--resume", "short"]).fine();
    same(&place, "long", "short");
}
