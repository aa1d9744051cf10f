//! What a run leaves behind: summary.json, steps.csv, vtk/, scene.toml, a few lines for a person, an exit code.

mod common;

use common::{Place, TEN};
use serde_json::Value;

/// The columns of steps.csv, in order.
const COLUMNS: &str = "step,time,bodies,contacts,active,sweeps,converged,breach,eps_motion,eps_bipotential,eps_penetration,eps_cone,eps_glob,\
    scaled_residual,penetration,overlap,joint_error,joint_gap,kinetic,potential,work,dissipated,impact,friction,balance_error,\
    created,created_contacts,created_joints,created_correction,created_scheme,lift,\
    seconds_detect,seconds_localise,seconds_solve,seconds_step";

fn ten() -> Place {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml"]).fine();
    place
}

/// One column of steps.csv.
#[track_caller]
fn column(place: &Place, name: &str) -> Vec<f64> {
    let text = place.read("out/ten/steps.csv");
    let index = COLUMNS.split(',').position(|column| column == name).expect(name);
    text.lines().skip(1).map(|row| row.split(',').nth(index).unwrap().parse().unwrap()).collect()
}

#[test]
fn the_summary_has_the_documented_keys() {
    let summary = ten().summary("out/ten");
    let keys = "steps bodies contacts_last contacts_mean sweeps_mean sweeps_max unconverged_steps eps_glob_max penetration_max \
        energy.kinetic energy.potential energy.work energy.dissipated energy.impact energy.friction energy.balance_error \
        seconds.total seconds.detect seconds.localise seconds.solve seconds.output threads solver.tolerance";
    for key in keys.split_whitespace() {
        let value = key.split('.').fold(&summary, |value, part| &value[part]);
        assert!(value.as_f64().is_some_and(f64::is_finite), "{key} is {value}");
    }
    let cores = std::thread::available_parallelism().unwrap().get();
    assert_eq!((&summary["steps"], &summary["bodies"], &summary["threads"]), (&20.into(), &15.into(), &cores.into()));
    assert_eq!(summary["solver"]["tolerance"], 1e-7);
    assert_eq!((&summary["solver"]["global"], &summary["solver"]["local"]), (&"accelerated".into(), &"pdas".into()));
    assert_eq!(summary["version"], env!("CARGO_PKG_VERSION"));
    let parts = ["detect", "localise", "solve", "output"].map(|part| summary["seconds"][part].as_f64().unwrap());
    assert!(parts.iter().all(|&part| part >= 0.0) && parts.iter().sum::<f64>() <= summary["seconds"]["total"].as_f64().unwrap());
}

#[test]
fn the_summary_sums_up_the_steps() {
    let place = ten();
    let summary = place.summary("out/ten");
    let number = |value: &Value| value.as_f64().unwrap();
    // The reader of JSON may round the last digit otherwise than the reader of numbers.
    let same = |value: &Value, expected: f64| (number(value) - expected).abs() <= 1e-15 * expected.abs();
    let (contacts, sweeps) = (column(&place, "contacts"), column(&place, "sweeps"));
    assert_eq!(number(&summary["contacts_last"]), contacts[19]);
    assert!((number(&summary["contacts_mean"]) - contacts.iter().sum::<f64>() / 20.0).abs() < 1e-12);
    assert!((number(&summary["sweeps_mean"]) - sweeps.iter().sum::<f64>() / 20.0).abs() < 1e-12);
    for (key, name) in [("sweeps_max", "sweeps"), ("eps_glob_max", "eps_glob"), ("penetration_max", "penetration")] {
        assert!(same(&summary[key], column(&place, name).into_iter().fold(0.0, f64::max)), "{key}");
    }
    for name in ["kinetic", "potential", "work", "dissipated", "impact", "friction", "balance_error"] {
        assert!(same(&summary["energy"][name], column(&place, name)[19]), "{name}");
    }
    let unconverged = column(&place, "converged").iter().filter(|&&converged| converged == 0.0).count();
    assert_eq!(summary["unconverged_steps"], unconverged);
    assert!(contacts.iter().any(|&count| count > 0.0), "the scene was to have contacts");
}

#[test]
fn steps_csv_has_a_row_a_step() {
    let place = ten();
    let text = place.read("out/ten/steps.csv");
    assert_eq!(text.lines().next(), Some(COLUMNS));
    assert!(text.lines().count() == 21 && text.ends_with('\n'));
    for (i, row) in text.lines().skip(1).enumerate() {
        let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap_or_else(|_| panic!("`{cell}` in {row}"))).collect();
        assert_eq!(cells.len(), COLUMNS.split(',').count(), "{row}");
        assert!(cells.iter().all(|cell| cell.is_finite()), "{row}");
        assert!(cells[0] == (i + 1) as f64 && (cells[1] - 1e-3 * cells[0]).abs() < 1e-12 && cells[2] == 15.0, "{row}");
    }
}

/// The frames of a collection: the files that it names, in order.
fn frames(place: &Place, folder: &str, collection: &str) -> Vec<String> {
    let text = place.read(&format!("{folder}/vtk/{collection}.pvd"));
    assert!(text.starts_with("<?xml") && text.trim_end().ends_with("</VTKFile>"), "{text}");
    text.split("file=\"").skip(1).map(|rest| rest.split('"').next().unwrap().to_owned()).collect()
}

#[test]
fn frames_come_as_often_as_asked() {
    let place = Place::with("ten.toml", TEN);
    for (every, steps) in [("5", &[0, 5, 10, 15, 20][..]), ("7", &[0, 7, 14]), ("100", &[0])] {
        place.moreau(&["run", "ten.toml", "--out", every, "--set", &format!("output.every={every}")]).fine();
        let mut expected = vec!["bodies.pvd".to_owned(), "contacts.pvd".to_owned()];
        for kind in ["bodies", "contacts"] {
            let files: Vec<String> = steps.iter().map(|step| format!("{kind}_{step:08}.vtp")).collect();
            assert_eq!(frames(&place, every, kind), files, "every {every}");
            expected.extend(files);
        }
        expected.sort();
        assert_eq!(place.all(&format!("{every}/vtk")).into_keys().collect::<Vec<_>>(), expected);
    }
}

#[test]
fn only_the_outputs_that_are_asked_for_are_written() {
    let place = Place::with("ten.toml", TEN);
    let files = |set: &str, out: &str| {
        place.moreau(&["run", "ten.toml", "--set", set, "--set", "checkpoint.seconds=0", "--out", out]).fine();
        place.all(out).into_keys().filter(|name| !name.contains('/')).collect::<Vec<_>>()
    };
    assert_eq!(files("output.kinds=[\"steps\"]", "a"), ["run.json", "scene.toml", "steps.csv", "summary.json"]);
    assert_eq!(files("output.kinds=[\"vtk\"]", "b"), ["run.json", "scene.toml", "summary.json", "vtk"]);
    assert_eq!(files("output.every=0", "c"), ["run.json", "scene.toml", "steps.csv", "summary.json", "trajectory.h5"]);
    assert_eq!(files("output.kinds=[\"trajectory\"]", "f"), ["run.json", "scene.toml", "summary.json", "trajectory.h5"]);
    let measured = ["measures.csv", "run.json", "scene.toml", "summary.json"];
    assert_eq!(files("output.kinds=[\"measures\"]", "e"), measured);
    assert_eq!(files("output.kinds=[]", "d"), ["run.json", "scene.toml", "summary.json"]);
}

#[test]
fn a_person_gets_a_few_plain_lines() {
    let place = Place::with("ten.toml", TEN);
    let out = place.moreau(&["run", "ten.toml"]).fine();
    for words in ["20 steps", "15 bodies", "pdas inside accelerated", "every step converged", "results in out/ten"] {
        assert!(out.contains(words), "{out}");
    }
    assert!(!out.contains(['\x1b', '\r']), "control codes in a pipe: {out:?}");
    assert_eq!(place.moreau(&["run", "ten.toml", "--quiet", "--force"]).fine(), "");
}

#[test]
fn a_solve_that_fails_counts_or_stops_as_the_scene_says() {
    let place = Place::with("ten.toml", TEN);
    let words = ["run", "ten.toml", "--set", "solver.max_sweeps=1", "--set"];
    let out = place.moreau(&[&words[..], &["solver.on_failure=warn"]].concat()).fine();
    let unconverged = place.summary("out/ten")["unconverged_steps"].as_u64().unwrap();
    assert!(unconverged > 0 && out.contains(&format!("{unconverged} steps did NOT converge")), "{out}");

    let ran = place.moreau(&[&words[..], &["solver.on_failure=stop", "--quiet", "--force"]].concat());
    ran.fails(4, &["did not converge", "solver.max_sweeps", "steps before are kept in out/ten"]);
    let steps = place.summary("out/ten")["steps"].as_u64().unwrap();
    assert!(steps < 20 && place.read("out/ten/steps.csv").lines().count() as u64 == 1 + steps);
}
