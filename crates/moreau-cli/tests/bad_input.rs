//! A scene with a fault ends the program with code 3 and a message of file, line and remedy, before anything is written.

mod common;

use common::Place;

/// A scene without a fault; each test breaks one of its lines.
const WHOLE: &str = r#"dimension = 3
gravity = [0.0, 0.0, -9.81]
[time]
step = 1e-4
steps = 10
theta = 0.5
[materials]
glass.density = 2500.0
steel.density = 7800.0
[default_law]
coulomb = { friction = 0.3, restitution = 0.5 }
[start]
max_overlap = 0.01
[[bodies]]
shape.half_space = { normal = [0.0, 0.0, 1.0] }
material = "steel"
position = [0.0, 0.0, 0.0]
[[bodies]]
name = "low"
shape.ball = { radius = 0.1 }
material = "glass"
position = [0.0, 0.0, 0.1]
[[bodies]]
name = "high"
shape.ball = { radius = 0.2 }
material = "glass"
position = [0.0, 0.0, 0.5]
[[generate]]
material = "glass"
count = 8
radii.uniform = { min = 0.05, max = 0.1 }
packing = { min = [1.0, 1.0, 0.0], max = [2.0, 2.0, 1.0] }
"#;

/// Two triangles in the plane.
const PLANE: &str = r#"dimension = 2
time = { step = 1e-4, steps = 10 }
materials.glass.density = 2500.0
[[bodies]]
shape.polygon = { vertices = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]] }
material = "glass"
position = [0.5, 0.5]
"#;

/// `run` and `check` refuse the scene with all of `wanted`, and leave the folder as it was.
#[track_caller]
fn refused(scene: &str, wanted: &[&str]) {
    let place = Place::with("bad.toml", scene);
    for words in [&["run", "bad.toml"][..], &["run", "bad.toml", "--out", "deep/er"], &["check", "bad.toml"]] {
        place.refuses(words, 3, wanted);
    }
}

/// As [`refused`], for `scene` with `line` replaced; the message names and shows that line.
#[track_caller]
fn broken(scene: &str, line: &str, by: &str, wanted: &[&str]) {
    assert_eq!(scene.matches(line).count(), 1, "`{line}` must stand once in the scene");
    let scene = scene.replace(line, by);
    let number = 1 + scene.lines().position(|l| l.contains(by)).expect("the line is there");
    let (place, shown) = (format!("error: bad.toml:{number}:"), scene.lines().nth(number - 1).unwrap_or_default());
    let shown = format!("{number} | {shown}");
    refused(&scene, &[&[place.as_str(), &shown, "^"], wanted].concat());
}

#[test]
fn the_scenes_that_are_broken_below_are_whole() {
    for scene in [WHOLE, PLANE] {
        Place::with("whole.toml", scene).moreau(&["check", "whole.toml"]).fine();
    }
}

#[test]
fn unknown_keys_name_the_nearest() {
    broken(WHOLE, "steps = 10", "stps = 10", &["unknown key `stps`", "did you mean `steps`?"]);
    broken(WHOLE, "{ radius = 0.1 }", "{ raduis = 0.1 }", &["unknown key `raduis`", "did you mean `radius`?"]);
}

#[test]
fn wrong_types_say_what_is_expected() {
    broken(WHOLE, "{ radius = 0.1 }", "{ radius = \"big\" }", &["radius", "expected a number"]);
    broken(WHOLE, "steps = 10", "steps = 2.5", &["time.steps", "expected a whole number"]);
    broken(WHOLE, "count = 8", "count = -8", &["generate[0].count", "expected a whole number"]);
    broken(WHOLE, "step = 1e-4", "step = = 1e-4", &["not valid TOML"]);
}

#[test]
fn sizes_and_densities_are_positive() {
    broken(WHOLE, "{ radius = 0.1 }", "{ radius = -0.1 }", &["radius is -0.1", "expected a positive number, in m"]);
    broken(WHOLE, "glass.density = 2500.0", "glass.density = -1.0", &["density is -1", "expected a positive number, in kg/m³"]);
    broken(WHOLE, "step = 1e-4", "step = 0.0", &["step is 0", "expected a positive number, in s"]);
}

#[test]
fn parameters_keep_to_their_ranges() {
    for wrong in ["-0.1", "1.1"] {
        let by = format!("restitution = {wrong}");
        broken(WHOLE, "restitution = 0.5", &by, &[&format!("restitution is {wrong}"), "expected a number from 0 to 1"]);
    }
    broken(WHOLE, "friction = 0.3", "friction = -0.3", &["friction is -0.3", "0 or more"]);
    for wrong in ["0.49", "1.01", "-0.5"] {
        broken(WHOLE, "theta = 0.5", &format!("theta = {wrong}"), &[&format!("theta is {wrong}"), "a number from 0.5", "to 1"]);
    }
}

#[test]
fn materials_and_laws_exist() {
    let wanted = ["unknown material `stel`", "did you mean `steel`?", "`glass`, `steel`"];
    broken(WHOLE, "material = \"steel\"", "material = \"stel\"", &wanted);
    broken(WHOLE, "coulomb = {", "colomb = {", &["unknown name `colomb`", "did you mean `coulomb`?"]);
}

#[test]
fn bodies_may_overlap_only_by_the_stated_part() {
    let line = "position = [0.0, 0.0, 0.5]";
    // Radii 0.1 and 0.2 at a distance of 0.298 overlap by 0.002, two hundredths of the smaller radius.
    let wanted = ["bodies[1] \"low\" and bodies[2] \"high\" overlap", "0.0200 of the smaller", "start.max_overlap = 0.01"];
    broken(WHOLE, line, "position = [0.0, 0.0, 0.398]", &wanted);
    let place = Place::with("near.toml", &WHOLE.replace(line, "position = [0.0, 0.0, 0.3995]"));
    place.moreau(&["check", "near.toml"]).fine();
}

#[test]
fn nan_and_infinity_are_refused() {
    for wrong in ["nan", "inf", "-inf", "1e999"] {
        let wanted = ["expected a finite number"];
        broken(WHOLE, "position = [0.0, 0.0, 0.5]", &format!("position = [0.0, {wrong}, 0.5]"), &wanted);
        broken(WHOLE, "gravity = [0.0, 0.0, -9.81]", &format!("gravity = [0.0, 0.0, {wrong}]"), &wanted);
        broken(WHOLE, "step = 1e-4", &format!("step = {wrong}"), &wanted);
    }
}

#[test]
fn an_empty_scene_is_refused() {
    refused("", &["error: bad.toml", "`dimension` is missing", "needs a value for `dimension`"]);
    refused("dimension = 3\ntime = { step = 1e-4, steps = 10 }\n", &["error: bad.toml", "no bodies", "add [[bodies]]"]);
}

#[test]
fn polygons_are_convex() {
    let (line, notch) = ("[0.1, 0.0], [0.0, 0.1]]", "[0.1, 0.0], [0.02, 0.02], [0.0, 0.1]]");
    broken(PLANE, line, notch, &["not a convex polygon: the boundary", "vertex 2", "expected the corners of a convex polygon"]);
    // A bow tie crosses itself, whichever of its vertices is blamed.
    broken(PLANE, line, "[0.1, 0.1], [0.1, 0.0], [0.0, 0.1]]", &["not a convex polygon", "expected the corners"]);
}

#[test]
fn memory_is_counted_before_any_body_is_made() {
    let wanted = ["4000000003 bodies need about", "GiB are there", "expected fewer bodies"];
    broken(WHOLE, "count = 8", "count = 4_000_000_000", &wanted);
    broken(WHOLE, "count = 8", "count = 1_000_000_000_000", &["1000000000000 bodies", "expected fewer bodies"]);
    // A lattice that is to fill a cubic kilometre counts its sites without visiting them.
    let scene = WHOLE.replace("count = 8\n", "");
    let (line, by) =
        ("packing = { min = [1.0, 1.0, 0.0], max = [2.0, 2.0, 1.0] }", "lattice = { min = [0, 0, 1], max = [1e3, 1e3, 1e3] }");
    broken(&scene, line, by, &["bodies", "expected fewer bodies"]);
}
