//! The policy `dump`: steps that fail leave their problem behind, and `solve` solves what the step would have.

mod common;

use common::problems::get;
use common::{Place, TEN};
use moreau::scene::{AnyWorld, Scene};
use moreau::step::{Workspace, step};
use serde_json::Value;

const DUMP: [&str; 8] =
    ["run", "ten.toml", "--set", "solver.on_failure=dump", "--set", "solver.max_sweeps=3", "--set", "solver.tolerance=1e-9"];

/// The files of the summary.
fn dumped(place: &Place, folder: &str) -> Vec<String> {
    let names = place.summary(folder)["failed_problems"].as_array().unwrap().clone();
    names.iter().map(|name| name.as_str().unwrap().to_owned()).collect()
}

/// What happens in step `number` of TEN when all solves converge: velocities and impulses of the contacts, each with the law's shift
/// on the velocity, as the problem counts it.
fn by_the_step(number: u64, sets: &[&str]) -> (Vec<f64>, Vec<f64>) {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scene = Scene::parse_with(TEN, "ten.toml", &sets).unwrap();
    let AnyWorld::Solid(mut world) = scene.build(u64::MAX).unwrap() else { panic!("a scene of space") };
    let mut work = Workspace::default();
    for _ in 0..number {
        assert!(step(&mut world, &mut work).unwrap().converged());
    }
    let velocity = |c: &moreau::step::Localised<3>| (0..3).map(|i| c.after[i] + c.form.shift[i]).collect::<Vec<_>>();
    (work.contacts().iter().flat_map(velocity).collect(), work.contacts().iter().flat_map(|c| c.impulse).collect())
}

#[test]
fn a_failed_step_is_solved_again_from_its_file() {
    let place = Place::with("ten.toml", TEN);
    let out = place.moreau(&DUMP).fine();
    let names = dumped(&place, "out/ten");
    assert_eq!(names.len() as u64, place.summary("out/ten")["unconverged_steps"].as_u64().unwrap());
    assert!(!names.is_empty() && out.contains(&format!("moreau solve out/ten/{}", names[0])), "{out}");
    let first: u64 = names[0].trim_start_matches("failed-step-").trim_end_matches(".hdf5").parse().unwrap();

    // Until then all solves converged: with more sweeps the same steps are taken, and this one is the one that would have been.
    let file = format!("out/ten/{}", names[0]);
    let problem = get(&place, &file);
    assert_eq!((problem.info.title.as_deref(), problem.guesses.len()), (Some(&*format!("step {first}")), 2));
    place.moreau(&["solve", &file, "--out", "solved.hdf5", "--tolerance", "1e-12"]).fine();
    let solution = get(&place, "solved.hdf5").solution.unwrap();
    let (u, r) = by_the_step(first, &["solver.tolerance=1e-12", "solver.max_sweeps=100000"]);
    let close = |a: &[f64], b: &[f64]| {
        let scale = a.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-6 * scale)
    };
    assert!(close(&u, &solution.u), "{u:?}\n{:?}", solution.u);
    assert!(close(&r, &solution.r), "{r:?}\n{:?}", solution.r);
}

#[test]
fn the_same_settings_fail_in_the_same_way() {
    let place = Place::with("ten.toml", TEN);
    // A stored W does not know of colours: the order is that of the contacts.
    place.moreau(&[&DUMP[..], &["--set", "solver.order=natural", "--set", "solver.global=nlgs"]].concat()).fine();
    let name = format!("out/ten/{}", dumped(&place, "out/ten").last().unwrap());
    let words = ["solve", &name, "--start", "guess", "--max-sweeps", "3", "--tolerance", "1e-9", "--criterion", "eps_glob"];
    let ran = place.moreau(&[&words[..], &["--global", "nlgs", "--out", "again.hdf5", "--json"]].concat());
    let row: Value = serde_json::from_str(&ran.out).unwrap();
    assert!(ran.code == Some(4) && row["status"] == "max_sweeps" && row["sweeps"] == 3, "{ran:?}");
    let again = get(&place, "again.hdf5");
    let (ended, solution) = (&again.guesses[1], again.solution.as_ref().unwrap());
    // W is stored here and went through the bodies there: equal but for rounding.
    let scale = ended.r.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
    assert!(ended.r.iter().zip(&solution.r).all(|(a, b)| (a - b).abs() <= 1e-9 * scale), "{ended:?}\n{solution:?}");
}

#[test]
fn steps_without_friction_have_zeros_for_tangents() {
    let frictionless = TEN.replace("coulomb = { friction = 0.3, ", "frictionless = { ");
    let place = Place::with("ten.toml", &frictionless);
    let words = [&DUMP[..4], &["--set", "solver.max_sweeps=1", "--set", "solver.tolerance=1e-12"]].concat();
    place.moreau(&words).fine();
    let names = dumped(&place, "out/ten");
    let file = format!("out/ten/{}", names.first().expect("one sweep is not enough for all steps"));
    let problem = get(&place, &file);
    assert_eq!(problem.dimension, 3);
    assert!(problem.mu.iter().all(|&mu| mu == 0.0));
    let (w, q) = problem.local().unwrap();
    assert!(w.entries().all(|(i, j, _)| i % 3 == 0 && j % 3 == 0) && q.iter().enumerate().all(|(i, &x)| i % 3 == 0 || x == 0.0));
    place.moreau(&["solve", &file]).fine();
}

#[test]
fn held_contacts_have_no_place_in_the_files() {
    // On approach a contact that is still open slides.
    let sticking = TEN.replace("coulomb = { friction = 0.3, ", "sticking = { acts = \"closed\", ");
    let place = Place::with("ten.toml", &sticking);
    let out = place.moreau(&[&DUMP[..4], &["--set", "solver.max_sweeps=1", "--set", "solver.tolerance=1e-12"]].concat()).fine();
    assert!(dumped(&place, "out/ten").is_empty());
    assert!(out.contains("no problem file could be made of step") && out.contains("Sticking"), "{out}");
}

#[test]
fn at_most_twenty_problems_are_kept_and_old_ones_go() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--steps", "1"]).fine();
    place.write("out/ten/failed-step-999.hdf5", "of an earlier run");
    let words =
        [&DUMP[..4], &["--force", "--steps", "60", "--set", "solver.max_sweeps=1", "--set", "solver.tolerance=1e-12"]].concat();
    let out = place.moreau(&words).fine();
    let names = dumped(&place, "out/ten");
    assert!(names.len() == 20 && out.contains("of the first 20 that failed"), "{out}");
    let there = place.all("out/ten").into_keys().filter(|name| name.starts_with("failed-step-")).count();
    assert_eq!(there, 20);
}

#[test]
fn what_cannot_be_written_ends_a_run_with_its_summary() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&DUMP).fine();
    let name = dumped(&place, "out/ten").remove(0);
    let first: u64 = name.trim_start_matches("failed-step-").trim_end_matches(".hdf5").parse().unwrap();
    // A folder in the place of the file is found when the file is to be written, in the middle of the run.
    std::fs::remove_file(place.path("out/ten").join(&name)).unwrap();
    std::fs::create_dir(place.path("out/ten").join(&name)).unwrap();
    let ran = place.moreau(&[&DUMP[..], &["--force"]].concat());
    ran.fails(1, &[&name, "cannot be written", &format!("of the {first} steps that were done the first 0 are kept in out/ten")]);
    assert_eq!(place.summary("out/ten")["steps"], first);
    assert_eq!(place.read("out/ten/steps.csv").lines().count() as u64, 1 + first);
}
