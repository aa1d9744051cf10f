//! What shows a run: pages, pictures, plots, of runs that are over and of one that was killed.

mod common;

use common::{Place, TEN};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Three disks on the ground, in the plane.
const PLANE: &str = r#"dimension = 2
gravity = [0.0, -9.81]
time = { step = 1e-3, steps = 200 }
materials.steel.density = 7800.0
default_law.coulomb = { friction = 0.5 }
output.every = 20
bodies = [
  { name = "ground", material = "steel", shape.half_plane.normal = [0, 1], position = [0, 0] },
  { material = "steel", shape.disk.radius = 0.5, position = [0, 0.5] },
  { material = "steel", shape.disk.radius = 0.5, position = [1, 0.5] },
  { material = "steel", shape.box.size = [1.0, 0.2], position = [0.5, 1.3] },
]
"#;

/// The places of all bodies in the last frame of a page, from its own data.
fn meta(page: &str) -> serde_json::Value {
    let (_, rest) = page.split_once(r#"<script type="application/json" id="meta">"#).expect("the page has its data");
    serde_json::from_str(rest.split_once("</script>").expect("an end").0).expect("it is JSON")
}

#[test]
fn a_report_is_one_page_with_the_run_in_it() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--set", "title=\"<b>ten</b> & more\""]).fine();
    let said = place.moreau(&["report", "out/ten"]).fine();
    assert!(said.starts_with("out/ten/report.html (") && said.ends_with(": 5 frames\n"), "{said}");
    let page = place.read("out/ten/report.html");
    assert!(page.starts_with("<!doctype html>") && page.contains("<title>&lt;b>ten&lt;/b> &amp; more</title>"));
    for far in ["http://", "https://", "<!--style-->", "<!--script-->", "<!--data-->", " src="] {
        assert!(
            !page.contains(far)
                || far.starts_with("http") && page.matches(far).count() == page.matches("http://www.w3.org").count(),
            "{far}"
        );
    }
    let meta = meta(&page);
    assert_eq!(meta["title"], "<b>ten</b> & more");
    assert_eq!((meta["dimension"].as_u64(), meta["frames"]["step"].as_array().unwrap().len()), (Some(3), 5));
    assert_eq!(meta["verdict"]["steps"], 20);
    assert_eq!(meta["verdict"]["unconverged_steps"], place.summary("out/ten")["unconverged_steps"]);
    assert_eq!(meta["verdict"]["scaled_residual_max"], place.summary("out/ten")["scaled_residual_max"]);
    assert_eq!(meta["steps"]["sweeps"].as_array().unwrap().len(), 20);

    // Of a page that must be small frames are left out, and the last is kept.
    let said = place.moreau(&["report", "out/ten", "--max-size", "0", "--out", "small.html"]).fine();
    assert!(said.contains("2 frames, one in"), "{said}");
    let small = self::meta(&place.read("small.html"));
    assert_eq!(small["frames"]["step"], serde_json::json!([0, 20]));
}

#[test]
fn pictures_and_plots_are_files_of_their_kinds() {
    let place = Place::with("ten.toml", TEN);
    place.write("plane.toml", PLANE);
    place.moreau(&["run", "ten.toml"]).fine();
    place.moreau(&["run", "plane.toml"]).fine();
    let png = b"\x89PNG\r\n\x1a\n".as_slice();
    let draws = |words: &[&str], out: &str, begin: &[u8]| {
        let mut words = words.to_vec();
        words.extend(["--out", out]);
        let said = place.moreau(&words).fine();
        assert!(said.starts_with(out), "{said}");
        let bytes = std::fs::read(place.path(out)).unwrap();
        assert!(bytes.starts_with(begin) && bytes.len() > 500, "{out}: {:?}", &bytes[..20.min(bytes.len())]);
    };
    draws(&["render", "out/ten", "--size", "160x120"], "ten.png", png);
    draws(&["render", "out/ten", "--size", "160x120", "--chains", "--time", "0.01", "--look=-1,0,-0.5"], "chains.png", png);
    draws(&["render", "out/ten", "--size", "80x60", "--colour", "speed"], "ten.gif", b"GIF89a");
    draws(&["render", "out/plane", "--chains"], "plane.svg", b"<");
    draws(&["render", "out/plane"], "plane.pdf", b"%PDF-");
    draws(&["render", "out/plane", "--size", "200x0"], "plane.png", png);
    draws(&["render", "out/plane", "--size", "100x0", "--every", "0.05"], "plane.gif", b"GIF89a");
    draws(&["plot", "out/ten"], "ten.svg", b"<svg");
    draws(&["plot", "out/plane", "--what", "sweeps,seconds,balance,contacts"], "plane-plot.png", png);
    draws(&["plot", "out/ten", "--what", "energy"], "energy.pdf", b"%PDF-");
}

#[test]
fn measures_are_in_the_page_and_in_plots() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--set", "output.kinds=[\"steps\",\"trajectory\",\"measures\"]"]).fine();
    place.moreau(&["report", "out/ten"]).fine();
    let page = place.read("out/ten/report.html");
    let start = page.find("id=\"meta\">").unwrap() + "id=\"meta\">".len();
    let meta: serde_json::Value = serde_json::from_str(page[start..].split("</script>").next().unwrap()).unwrap();
    let written = place.read("out/ten/measures.csv");
    let mut lines = written.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert!(rows.len() > 1);
    for (k, name) in names.iter().enumerate() {
        let shown: Vec<f64> = serde_json::from_value(meta["measures"][name].clone()).unwrap();
        // Reading JSON rounds.
        let alike = |(shown, row): (&f64, &Vec<f64>)| (shown - row[k]).abs() <= 1e-15 * row[k].abs();
        assert!(shown.len() == rows.len() && shown.iter().zip(&rows).all(alike), "{name}: {shown:?}");
    }
    place.moreau(&["plot", "out/ten", "--what", "coordination,solid-fraction,anisotropy,pressure", "--out", "m.svg"]).fine();
    assert!(place.read("m.svg").contains("without rattlers"));
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml"]).fine();
    place.refuses(&["report", "nowhere"], 1, &["nowhere has no trajectory.h5", "name the folder that moreau run wrote"]);
    place.refuses(&["plot", "out/ten", "--out", "plot.jpg"], 2, &["plot.jpg", ".svg, .png or .pdf"]);
    place.refuses(
        &["plot", "out/ten", "--what", "pressure"],
        2,
        &["out/ten", "no measures.csv", "\"measures\" among output.kinds"],
    );
    place.refuses(&["render", "out/ten", "--out", "picture.svg"], 2, &["picture.svg"]);
    place.refuses(&["render", "out/ten", "--size", "big"], 2, &["1280x960 is one"]);
    place.refuses(&["render", "out/ten", "--look", "1,2"], 2, &["--look has 2 numbers; three are right"]);
    place.write("out/ten/trajectory.h5", "no HDF5");
    place.refuses(&["report", "out/ten"], 1, &["out/ten/trajectory.h5"]);
}

/// Killed at once, a run leaves a trajectory that can be read to its last whole frame.
#[test]
fn a_run_that_was_killed_can_be_looked_at() {
    let place = Place::with("ten.toml", TEN);
    let words =
        ["run", "ten.toml", "--out", "long", "--steps", "1000000000", "--set", "output={kinds=[\"trajectory\"],every=100}"];
    let mut child = place.command(&words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let until = Instant::now() + Duration::from_secs(60);
    while std::fs::metadata(place.path("long/trajectory.h5")).map_or(0, |file| file.len()) < 3_000_000 {
        assert!(Instant::now() < until, "the trajectory does not grow");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!place.path("long/summary.json").exists());
    place.moreau(&["report", "long"]).fine();
    place.moreau(&["plot", "long"]).fine();
    place.moreau(&["render", "long", "--size", "80x60"]).fine();
    let meta = meta(&place.read("long/report.html"));
    let steps = meta["frames"]["step"].as_array().unwrap();
    assert!(steps.len() > 1 && steps[0] == 0, "{} frames", steps.len());
    assert!(meta["verdict"]["steps"].as_u64() >= steps[steps.len() - 1].as_u64());
}

/// A scene of a few bytes that was put beside the trajectory of another run asks for more memory than there is.
#[test]
fn a_scene_of_another_run_is_not_built_to_be_counted() {
    let place = Place::with("ten.toml", TEN);
    place.moreau(&["run", "ten.toml", "--out", "ten", "--quiet"]).fine();
    let scene = place.read("ten/scene.toml");
    assert!(scene.contains("count = 10"), "{scene}");
    for count in ["12", "4000000000"] {
        place.write("ten/scene.toml", scene.replace("count = 10", &format!("count = {count}")).replace("0.03", "3000.0"));
        for words in [["report", "ten"], ["render", "ten"]] {
            place.moreau(&words).fails(1, &["they are of two runs", "the trajectory has 15"]);
        }
    }
}
