//! Folders that runs write into: what somebody else has put there stays, and an earlier run stays unless `--force` is given.

mod common;

use common::{Place, TEN};

/// Names in a folder, without those below its folders.
fn names(place: &Place, folder: &str) -> Vec<String> {
    place.all(folder).into_keys().filter(|name| !name.contains('/')).collect()
}

#[test]
fn a_folder_that_holds_anything_is_refused() {
    let place = Place::with("ten.toml", TEN);
    for name in ["scene.toml", "summary.json", "steps.csv", "trajectory.h5", "vtk/bodies_00000000.vtp", "notes", ".hidden"] {
        let folder = format!("of-{}", name.replace(['/', '.'], "-"));
        place.write(&format!("{folder}/{name}"), "mine");
        let (top, wanted) = (name.split('/').next().unwrap(), format!("cannot write into {folder}: it holds "));
        let run = ["run", "ten.toml", "--out", &folder];
        place.refuses(&run, 1, &[&wanted, top, "nothing of it is overwritten", "--out", "--new"]);
        // No marker, no force.
        let wanted = [wanted.as_str(), "--force removes nothing there, for it has no run.json of a run"];
        place.refuses(&[&run[..], &["--force"]].concat(), 1, &wanted);
        place.refuses(&[&run[..], &["--convergence"]].concat(), 1, &["nothing of it is overwritten"]);
    }
    // The folder that the program runs in is one of these.
    place.refuses(&["run", "ten.toml", "--out", "."], 1, &["cannot write into .: it holds ", "and 4 more"]);
    std::fs::create_dir(place.path("empty")).unwrap();
    place.moreau(&["run", "ten.toml", "--out", "empty"]).fine();
}

#[test]
fn a_run_json_of_somebody_else_marks_nothing() {
    let place = Place::with("ten.toml", TEN);
    let outside = r#"{"format": "moreau run", "layout": 1, "files": ["run.json", "../ten.toml"]}"#;
    for content in ["{}", "not JSON", r#"{"format": "moreau run", "layout": 99, "files": []}"#, outside] {
        place.write("other/run.json", content);
        place.refuses(&["run", "ten.toml", "--out", "other", "--force"], 1, &["it holds run.json", "no run.json of a run"]);
    }
}

#[test]
fn an_earlier_run_stays_unless_it_is_replaced() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml"]).fine();
    let short = ["run", "ten.toml", "--steps", "6"];
    let advice = ["moreau run --resume out/ten", "--force", "--out", "--new"];
    place.refuses(&short, 1, &[&["cannot write into out/ten: it holds "], &advice[..]].concat());
    // A scene of the same stem has the same folder.
    place.write("other/ten.toml", TEN);
    place.refuses(&["run", "other/ten.toml"], 1, &advice);

    for command in ["report", "plot", "render"] {
        place.moreau(&[command, "out/ten"]).fine();
    }
    place.moreau(&["run", "ten.toml", "--convergence"]).fine();
    for mine in ["notes.txt", "vtk/mine.vtp", "vtk/bodies_last.vtp", "checkpoint-of-mine.bin", "failed-step-x.hdf5", "page.html"]
    {
        place.write(&format!("out/ten/{mine}"), "mine");
    }
    place.moreau(&[&short[..], &["--force", "--set", "output.kinds=[]"]].concat()).fine();
    let (checkpoints, mine) = (
        ["checkpoint-000000000000.bin", "checkpoint-000000000006.bin", "checkpoint-of-mine.bin"],
        ["failed-step-x.hdf5", "notes.txt", "page.html", "run.json", "scene.toml", "summary.json", "vtk"],
    );
    assert_eq!(names(&place, "out/ten"), [&checkpoints[..], &mine].concat());
    assert_eq!(place.all("out/ten/vtk").into_keys().collect::<Vec<_>>(), ["bodies_last.vtp", "mine.vtp"]);
    assert_eq!(place.summary("out/ten")["steps"], 6);
}

#[test]
fn force_needs_no_earlier_run_and_never_takes_the_scene() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--force"]).fine();
    place.refuses(&["run", "out/ten/scene.toml", "--out", "out/ten", "--force"], 1, &["it is the scene to run"]);
    place.refuses(&["run", "--resume", "out/ten", "--force"], 2, &["--resume", "--force"]);
}

#[test]
fn new_folders_are_numbered() {
    let place = Place::with("ten.toml", TEN);
    let run = |more: &[&str]| place.moreau(&[&["run", "ten.toml", "--new"], more].concat()).fine();
    for folder in ["out/ten", "out/ten-2", "out/ten-3"] {
        assert!(run(&[]).contains(&format!("results in {folder}\n")));
    }
    place.write("mine-2", "a file has the name");
    assert!(run(&["--out", "mine"]).contains("results in mine\n"));
    assert!(run(&["--out", "mine"]).contains("results in mine-3\n"));
    assert_eq!(place.read("mine-2"), "a file has the name");
    place.refuses(&["run", "ten.toml", "--new", "--force"], 2, &["--new", "--force"]);
    place.refuses(&["run", "ten.toml", "--new", "--out", ".."], 2, &["--new: .. has no name"]);
}

#[test]
fn the_marker_lists_what_the_run_may_make() {
    let place = Place::with("ten.toml", TEN);
    let all = "output.kinds=[\"steps\",\"measures\",\"vtk\",\"trajectory\"]";
    place.moreau(&["run", "ten.toml", "--set", all]).fine();
    let marker: serde_json::Value = serde_json::from_str(&place.read("out/ten/run.json")).unwrap();
    assert_eq!((&marker["layout"], &marker["version"]), (&1.into(), &env!("CARGO_PKG_VERSION").into()));
    let listed: Vec<&str> = marker["files"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    for (name, content) in place.all("out/ten") {
        let digits = name.chars().filter(char::is_ascii_digit).collect::<String>();
        let pattern = if digits.len() > 5 { name.replace(&digits, "{step}") } else { name.clone() };
        assert!(content.is_none() || listed.contains(&pattern.as_str()), "{name} is not in {listed:?}");
    }
}

#[test]
fn going_on_marks_a_folder_and_takes_no_file_for_its_own_that_it_did_not_write() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--out", "old", "--set", "output.kinds=[\"steps\"]"]).fine();
    std::fs::remove_file(place.path("old/run.json")).unwrap();
    place.write("old/measures.csv", "mine");
    let more = ["run", "--resume", "old", "--steps", "30"];
    let measures = ["--set", "output.kinds=[\"steps\",\"measures\"]"];
    place.refuses(&[&more[..], &measures].concat(), 1, &["cannot write old/measures.csv", "move it away"]);
    place.moreau(&more).fine();
    assert_eq!(place.read("old/measures.csv"), "mine");
    assert!(place.path("old/run.json").exists());
}
