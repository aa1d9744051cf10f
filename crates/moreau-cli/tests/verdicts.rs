//! The verdict on a run: the terminal, summary.json, the page and the exit code say the same.

mod common;

use common::Place;
use serde_json::Value;

/// A square whose corner meets the floor with full normal restitution and sticks, theory (45): 0.19 J are created, a seventh of the energy.
const KANE: &str = r#"dimension = 2
time = { step = 1e-3, steps = 5 }
solver = { criterion = "scaled", tolerance = 1e-12 }
materials.steel.density = 2.0
default_law.coulomb = { friction = 2.0, restitution = 1.0, tangential_restitution = 0.0 }
output.every = 1
bodies = [
  { material = "steel", position = [0.0, 0.0], shape.half_plane.normal = [0.0, 1.0] },
  { material = "steel", position = [0.0, 0.6125724356957945], orientation = -0.2617993877991494, velocity = [-0.4, -1.0], shape.box.size = [1.0, 1.0] },
]
"#;

/// A disk that rests.
const REST: &str = r#"dimension = 2
gravity = [0.0, -10.0]
time = { step = 1e-3, steps = 20 }
materials.steel.density = 2.0
default_law.coulomb = { friction = 0.5 }
output.every = 5
bodies = [
  { material = "steel", position = [0.0, 0.0], shape.half_plane.normal = [0.0, 1.0] },
  { material = "steel", position = [0.0, 0.5], shape.disk.radius = 0.5 },
]
"#;

/// The verdict in the head of the page of a run.
fn on_page(place: &Place, folder: &str) -> Value {
    place.moreau(&["report", folder]).fine();
    let page = place.read(&format!("{folder}/report.html"));
    let (_, rest) = page.split_once(r#"<script type="application/json" id="meta">"#).expect("the page has its data");
    let meta: Value = serde_json::from_str(rest.split_once("</script>").expect("an end").0).expect("it is JSON");
    meta["verdict"].clone()
}

/// Checks that summary.json and the page of a run give the same verdict; returns its reasons.
#[track_caller]
fn same_everywhere(place: &Place, folder: &str, reliable: bool) -> Vec<String> {
    let (verdict, page) = (place.summary(folder)["verdict"].clone(), on_page(place, folder));
    assert_eq!(verdict["reliable"], reliable, "{verdict:#}");
    for key in ["reliable", "reasons", "checks"] {
        assert_eq!(page[key], verdict[key], "{key}");
    }
    serde_json::from_value(verdict["reasons"].clone()).expect("reasons are words")
}

#[test]
fn a_run_that_creates_energy_says_so_everywhere() {
    let place = Place::with("kane.toml", KANE);
    let said = place.moreau(&["run", "kane.toml"]).fine();
    let reasons = same_everywhere(&place, "out/kane", false);
    assert!(reasons.len() == 1 && reasons[0].starts_with("0.190 J were created, "), "{reasons:?}");
    assert!(reasons[0].contains("0.190 J by contacts (most in step 1: 0.190 J)"), "{reasons:?}");
    let end = format!("\nverdict: NOT TO BE RELIED ON\n  - {}\n", reasons[0]);
    assert!(said.ends_with(&end), "{said}");
    let created = &place.summary("out/kane")["energy"]["created"];
    assert_eq!((&created["worst_step"]["contacts"]["step"], &created["joints"]), (&1.into(), &0.0.into()), "{created:#}");
    // The table has it by step and part.
    let table = place.read("out/kane/steps.csv");
    let place_of = |name: &str| table.lines().next().unwrap().split(',').position(|column| column == name).expect(name);
    let first: Vec<f64> = table.lines().nth(1).unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
    assert!(first[place_of("created")] == first[place_of("created_contacts")] && first[place_of("created")] > 0.18);
    // A run of which there is no summary, as after a kill, is judged by its steps alone: by the same function.
    let with_summary = on_page(&place, "out/kane");
    std::fs::remove_file(place.path("out/kane/summary.json")).unwrap();
    let without = on_page(&place, "out/kane");
    assert_eq!((&without["reliable"], &without["reasons"]), (&with_summary["reliable"], &with_summary["reasons"]));
}

#[test]
fn strict_ends_with_a_code_of_its_own() {
    let place = Place::with("kane.toml", KANE);
    let ran = place.moreau(&["run", "kane.toml", "--strict", "--quiet"]);
    ran.fails(6, &["the run is not to be relied on: 0.190 J were created"]);
    assert!(place.path("out/kane/trajectory.h5").exists() && same_everywhere(&place, "out/kane", false).len() == 1);
    // Quiet is not silent.
    let ran = place.moreau(&["run", "kane.toml", "--quiet", "--force"]);
    assert!(ran.code == Some(0) && ran.out.is_empty() && ran.err.contains("the run is not to be relied on: 0.190 J"), "{ran:?}");
    place.write("rest.toml", REST);
    let said = place.moreau(&["run", "rest.toml", "--strict"]).fine();
    assert!(said.ends_with("\nverdict: all checks passed\n"), "{said}");
    assert_eq!(same_everywhere(&place, "out/rest", true), [""; 0]);
    assert_eq!(place.moreau(&["run", "rest.toml", "--strict", "--quiet", "--force"]).fine(), "");
}

#[test]
fn steps_that_do_not_converge_and_limits_that_are_broken_are_reasons() {
    let place = Place::with("rest.toml", REST);
    let ran = place.moreau(&["run", "rest.toml", "--strict", "--set", "guard.max=[1.0,0.4]", "--set", "guard.min=[-1.0,-1.0]"]);
    assert_eq!(ran.code, Some(6), "{ran:?}");
    let reasons = same_everywhere(&place, "out/rest", false);
    assert!(reasons.len() == 1 && reasons[0].contains("20 steps broke a limit of [guard]; the first: step 1"), "{reasons:?}");
    place.write("kane.toml", KANE);
    // One projected step with a parameter does not solve a contact with friction.
    let sets = ["--set", "solver.max_sweeps=1", "--set", "solver.local=sbp", "--set", "solver.global=nlgs"];
    let said = place.moreau(&[["run", "kane.toml"].as_slice(), &sets].concat()).fine();
    let reasons = same_everywhere(&place, "out/kane", false);
    assert!(reasons[0].starts_with("the solver did not meet its criterion in "), "{reasons:?}");
    assert!(reasons.iter().all(|reason| said.contains(&format!("  - {reason}\n"))), "{said}");
}

#[test]
fn numbers_that_overflow_end_the_run_with_a_message() {
    let place = Place::with("rest.toml", REST);
    let sets = ["--set", "bodies.1.velocity=[1e300,0.0]", "--set", "bodies.1.position=[0.0,50.0]"];
    let ran = place.moreau(&[["run", "rest.toml"].as_slice(), &sets].concat());
    assert_eq!(ran.code, Some(4), "{ran:?}");
    assert!(
        ran.err.starts_with("error: ") && ran.err.contains("left the finite numbers") && ran.err.contains("t = 0.001 s"),
        "{}",
        ran.err
    );
    assert!(ran.out.contains("verdict: NOT TO BE RELIED ON\n  - the run failed: "), "{}", ran.out);
    let verdict = &place.summary("out/rest")["verdict"];
    assert!(
        verdict["reliable"] == false && verdict["reasons"][0].as_str().unwrap().contains("left the finite numbers"),
        "{verdict:#}"
    );
    let table = place.read("out/rest/steps.csv");
    assert!(!table.contains("inf") && !table.contains("NaN"), "{table}");
}
