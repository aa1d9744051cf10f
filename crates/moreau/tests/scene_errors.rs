//! Whatever is wrong in a scene, the error names the file, the line, the key and what would be right.

use moreau::scene::{LineColumn, Scene, SceneError};

/// A scene in space without a fault; each test breaks one of its lines.
const SOLID: &str = r#"dimension = 3
gravity = [0.0, 0.0, -9.81]
[time]
step = 1e-4
steps = 10
theta = 0.5
[solver]
local = "pdas"
tolerance = 1e-7
order = { shuffled = 7 }
[materials]
glass.density = 2500.0
steel.density = 7800.0
[default_law]
frictionless = { restitution = 0.5 }
[[laws]]
between = ["glass", "steel"]
law.coulomb = { friction = 0.3 }
[[bodies]]
name = "floor"
shape.half_space = { normal = [0.0, 0.0, 1.0] }
material = "steel"
position = [0.0, 0.0, 0.0]
[[bodies]]
name = "first"
shape.ball = { radius = 0.1 }
material = "glass"
position = [0.0, 0.0, 0.1]
[[bodies]]
shape.ball = { radius = 0.2 }
material = "glass"
position = [0.0, 0.0, 0.5]
orientation = { axis = [0.0, 0.0, 1.0], degrees = 30.0 }
spin = [0.0, 0.0, 1.0]
[[generate]]
material = "glass"
count = 8
radii.uniform = { min = 0.05, max = 0.1 }
lattice = { min = [1.0, 1.0, 0.0], max = [2.0, 2.0, 1.0] }
"#;

/// The same in the plane.
const PLANE: &str = r#"dimension = 2
time = { step = 1e-4, steps = 10 }
materials.glass.density = 2500.0
[[containers]]
min = [0.0, 0.0]
max = [1.0, 1.0]
open = ["+y"]
material = "glass"
[[bodies]]
shape.polygon = { vertices = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]] }
material = "glass"
position = [0.5, 0.5]
orientation = 0.5
spin = 1.0
"#;

fn read(text: &str) -> Result<(), SceneError> {
    Scene::parse(text, "bad.toml")?.build(1 << 30).map(drop)
}

/// Replaces one line of `scene` and checks that the error stands in that line, at `key`, and says each of `wanted`.
#[track_caller]
fn broken(scene: &str, line: &str, by: &str, key: &str, wanted: &[&str]) {
    assert_eq!(scene.matches(line).count(), 1, "`{line}` must stand once in the scene");
    let number = scene.lines().position(|l| l.contains(line)).unwrap() + 1;
    let error = read(&scene.replace(line, by)).expect_err(by);
    let text = error.to_string();
    assert_eq!(error.place.file, "bad.toml");
    assert_eq!(error.place.at.map(|at| at.line), Some(number), "{text}");
    assert_eq!(error.place.key, key, "{text}");
    assert!(text.starts_with(&format!("bad.toml:{number}:")), "{text}");
    let shown = scene.replace(line, by).lines().nth(number - 1).unwrap().to_owned();
    assert!(text.contains(&format!("{number} | {shown}")) && text.contains('^'), "{text}");
    for words in wanted {
        assert!(text.contains(words), "`{words}` is not in:\n{text}");
    }
    assert!(!error.hint.is_empty(), "{text}");
}

#[test]
fn the_scenes_that_are_broken_below_are_whole() {
    read(SOLID).unwrap();
    read(PLANE).unwrap();
}

#[test]
fn unknown_keys_name_the_nearest() {
    let known = ["unknown key `tolernce` in [solver]", "did you mean `tolerance`?", "known keys: `global`"];
    broken(SOLID, "tolerance = 1e-7", "tolernce = 1e-7", "solver.tolernce", &known);
    broken(SOLID, "name = \"first\"", "nme = \"first\"", "bodies[1].nme", &["did you mean `name`?"]);
    let known = ["unknown key `fricton` in [laws[0].law.coulomb]", "did you mean `friction`?"];
    broken(SOLID, "law.coulomb = { friction = 0.3 }", "law.coulomb = { fricton = 0.3 }", "laws[0].law.coulomb.fricton", &known);
    let known = ["unknown key `radios`", "did you mean `radius`?"];
    broken(SOLID, "{ radius = 0.2 }", "{ radius = 0.2, radios = 1 }", "bodies[2].shape.ball.radios", &known);
    let known = ["unknown key `gravty` at the top of the scene", "did you mean `gravity`?"];
    broken(SOLID, "gravity = [0.0, 0.0, -9.81]", "gravty = [0.0, 0.0, -9.81]", "gravty", &known);
}

#[test]
fn unknown_names_name_the_nearest() {
    broken(SOLID, "\"pdas\"", "\"pads\"", "solver.local", &["unknown name `pads`", "did you mean `pdas`?"]);
    broken(
        SOLID,
        "shape.ball = { radius = 0.1 }",
        "shape.bal = { radius = 0.1 }",
        "bodies[1].shape.bal",
        &["did you mean `ball`?"],
    );
    broken(
        SOLID,
        "law.coulomb = {",
        "law.colomb = {",
        "laws[0].law.colomb",
        &["unknown name `colomb`", "did you mean `coulomb`?"],
    );
    let wanted = ["unknown material `steal`", "did you mean `steel`? known materials: `glass`, `steel`"];
    broken(SOLID, "[\"glass\", \"steel\"]", "[\"glass\", \"steal\"]", "laws[0].between[1]", &wanted);
    broken(SOLID, "material = \"steel\"", "material = \"stel\"", "bodies[0].material", &["did you mean `steel`?"]);
    broken(SOLID, "{ shuffled = 7 }", "{ shufled = 7 }", "solver.order.shufled", &["did you mean `shuffled`?"]);
    broken(PLANE, "[\"+y\"]", "[\"y\"]", "containers[0].open[0]", &["unknown name `y`", "`+y`"]);
}

#[test]
fn wrong_types_say_what_is_expected() {
    broken(
        SOLID,
        "radius = 0.1 }",
        "radius = \"big\" }",
        "bodies[1].shape.ball.radius",
        &["found string \"big\"", "expected a number"],
    );
    broken(SOLID, "steps = 10", "steps = -10", "time.steps", &["expected a whole number, 0 or more"]);
    broken(SOLID, "steps = 10", "steps = 1.5", "time.steps", &["expected a whole number"]);
    broken(SOLID, "dimension = 3", "dimension = 4", "dimension", &["found dimension 4", "expected 2 or 3"]);
    broken(SOLID, "shape.ball = { radius = 0.1 }", "shape = \"ball\"", "bodies[1].shape", &["a bare name", "expected a table"]);
    broken(
        SOLID,
        "spin = [0.0, 0.0, 1.0]",
        "spin = \"fast\"",
        "bodies[2].spin",
        &["expected a number (in the plane) or an array of 3"],
    );
    broken(
        SOLID,
        "normal = [0.0, 0.0, 1.0]",
        "normal = [0.0, 1.0]",
        "bodies[0].shape.half_space.normal",
        &["expected 3 numbers"],
    );
    broken(SOLID, "{ radius = 0.1 }", "{ }", "bodies[1].shape.ball", &["`radius` is missing"]);
    let two = "{ radius = 0.1 }\nshape.box = { size = [1, 1, 1] }";
    broken(SOLID, "{ radius = 0.1 }", two, "bodies[1].shape", &["one choice is needed here"]);
    broken(SOLID, "steps = 10", "steps = 10 10", "", &["not valid TOML"]);
    broken(SOLID, "steps = 10", "steps = 10000000000000000000", "time.steps", &["too large"]);
}

#[test]
fn lengths_and_densities_are_positive() {
    for wrong in ["0.0", "-0.1"] {
        let radius = ["radius is", "expected a positive number, in m"];
        broken(SOLID, "radius = 0.1 }", &format!("radius = {wrong} }}"), "bodies[1].shape.ball.radius", &radius);
        let density = ["density is", "expected a positive number"];
        broken(SOLID, "glass.density = 2500.0", &format!("glass.density = {wrong}"), "materials.glass.density", &density);
        broken(SOLID, "step = 1e-4", &format!("step = {wrong}"), "time.step", &["expected a positive number, in s"]);
        broken(SOLID, "tolerance = 1e-7", &format!("tolerance = {wrong}"), "solver.tolerance", &["a positive, finite number"]);
        broken(SOLID, "min = 0.05", &format!("min = {wrong}"), "generate[0].radii.uniform.min", &["expected a positive number"]);
    }
    broken(
        SOLID,
        "[[generate]]",
        "[[generate]]\npacking = { min = [3, 3, 3], max = [4, 4, 4] }",
        "generate[0]",
        &["keep one of them"],
    );
    broken(SOLID, "max = 0.1 }", "max = 0.01 }", "generate[0].radii.uniform.max", &["expected max at or above min"]);
    for extreme in ["1e-300", "1e300", "1e160"] {
        let words = ["radius is 1e", "from 1e-50 to 1e50: others have no mass"];
        broken(SOLID, "radius = 0.2 }", &format!("radius = {extreme} }}"), "bodies[2].shape.ball.radius", &words);
    }
    // A sieve curve of such sizes was drawn from without end.
    let sieve = "radii.sieve = [[0.02, 0.0], [1e300, 1.0]]";
    broken(SOLID, "radii.uniform = { min = 0.05, max = 0.1 }", sieve, "generate[0].radii.sieve[1][0]", &["from 1e-50 to 1e50"]);
}

#[test]
fn parameters_keep_to_their_ranges() {
    let range = ["expected a number from 0 to 1"];
    for wrong in ["-0.1", "1.1"] {
        let by = format!("restitution = {wrong}");
        broken(SOLID, "restitution = 0.5", &by, "default_law.frictionless.restitution", &range);
    }
    broken(SOLID, "friction = 0.3", "friction = -0.3", "laws[0].law.coulomb.friction", &["expected a finite number, 0 or more"]);
    for wrong in ["0.49", "1.01"] {
        broken(SOLID, "theta = 0.5", &format!("theta = {wrong}"), "time.theta", &["expected a number from 0.5"]);
    }
    broken(SOLID, "[\"glass\", \"steel\"]", "[\"glass\"]", "laws[0].between", &["expected the names of two materials"]);
    broken(SOLID, "name = \"first\"", "name = \"floor\"", "bodies[1].name", &["a name that is taken"]);
    broken(SOLID, "normal = [0.0, 0.0, 1.0]", "normal = [0, 0, 0]", "bodies[0].shape.half_space.normal", &["not all zero"]);
    let free = "material = \"steel\"\nmotion = \"free\"";
    let error = read(&SOLID.replace("material = \"steel\"", free)).unwrap_err();
    assert_eq!((error.place.key.as_str(), error.place.at.unwrap().line), ("bodies[0].motion", 23), "{error}");
}

#[test]
fn nan_and_infinity_are_refused_everywhere() {
    let wanted = ["expected a finite number"];
    broken(SOLID, "gravity = [0.0, 0.0, -9.81]", "gravity = [0.0, 0.0, nan]", "gravity[2]", &wanted);
    broken(SOLID, "radius = 0.1 }", "radius = inf }", "bodies[1].shape.ball.radius", &wanted);
    broken(SOLID, "friction = 0.3", "friction = -inf", "laws[0].law.coulomb.friction", &wanted);
    broken(SOLID, "degrees = 30.0", "degrees = nan", "bodies[2].orientation.degrees", &wanted);
    broken(SOLID, "radius = 0.1 }", "radius = 1e999 }", "bodies[1].shape.ball.radius", &wanted);
}

#[test]
fn vectors_and_shapes_fit_the_dimension() {
    let wanted = ["2 components where dimension = 3", "expected 3 numbers"];
    broken(SOLID, "position = [0.0, 0.0, 0.1]", "position = [0.0, 0.1]", "bodies[1].position", &wanted);
    broken(SOLID, "gravity = [0.0, 0.0, -9.81]", "gravity = [0.0, -9.81]", "gravity", &wanted);
    broken(SOLID, "spin = [0.0, 0.0, 1.0]", "spin = 1.0", "bodies[2].spin", &["expected 3 numbers"]);
    broken(SOLID, "{ axis = [0.0, 0.0, 1.0], degrees = 30.0 }", "0.5", "bodies[2].orientation", &["an angle without an axis"]);
    broken(
        SOLID,
        "shape.ball = { radius = 0.1 }",
        "shape.disk = { radius = 0.1 }",
        "bodies[1].shape",
        &["ball, box, capsule, cylinder, polyhedron, compound, mesh, height_field and half_space"],
    );
    broken(PLANE, "min = [0.0, 0.0]", "min = [0.0, 0.0, 0.0]", "containers[0].min", &["3 components where dimension = 2"]);
    broken(PLANE, "spin = 1.0", "spin = [0.0, 0.0, 1.0]", "bodies[0].spin", &["expected one number in the plane"]);
    broken(PLANE, "orientation = 0.5", "orientation = [0, 0, 0, 1]", "bodies[0].orientation", &["a quaternion in the plane"]);
    broken(PLANE, "[\"+y\"]", "[\"+z\"]", "containers[0].open[0]", &["-x, +x, -y, +y"]);
}

#[test]
fn polygons_are_convex() {
    let notch = "vertices = [[0.0, 0.0], [0.1, 0.0], [0.02, 0.02], [0.0, 0.1]]";
    let line = "vertices = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]]";
    broken(PLANE, line, notch, "bodies[0].shape.polygon.vertices[2]", &["not a convex polygon", "vertex 2"]);
    let star = "vertices = [[0.0, 1.0], [0.6, -0.8], [-1.0, 0.3], [1.0, 0.3], [-0.6, -0.8]]";
    let error = read(&PLANE.replace(line, star)).unwrap_err().to_string();
    assert!(error.contains("not a convex polygon"), "{error}");
    broken(PLANE, line, "vertices = [[0.0, 0.0], [0.1, 0.0]]", "bodies[0].shape.polygon.vertices", &["2 vertices"]);
}

#[test]
fn overlaps_at_the_start_name_both_bodies() {
    let wanted =
        ["bodies[1] \"first\" and bodies[2] overlap at the start by 5.0000e-2 m", "0.5000 of the smaller", "start.max_overlap"];
    broken(SOLID, "position = [0.0, 0.0, 0.5]", "position = [0.0, 0.0, 0.35]", "bodies[2].position", &wanted);
    // A thousandth of the smaller radius may overlap.
    read(&SOLID.replace("position = [0.0, 0.0, 0.1]", "position = [0.0, 0.0, 0.09991]")).unwrap();
    let text = format!("{SOLID}[start]\nmax_overlap = 0.6\n").replace("[0.0, 0.0, 0.5]", "[0.0, 0.0, 0.35]");
    read(&text).unwrap();
    let error = read(&SOLID.replace("[0.0, 0.0, 0.5]", "[1.0, 1.0, 0.3]")).unwrap_err().to_string();
    assert!(error.contains("bodies[2] and number 0 of generate[0] overlap"), "{error}");
}

#[test]
fn boxes_may_touch_boxes_but_not_overlap() {
    let one = |height: f64| {
        format!("[[bodies]]\nshape.box = {{ size = [0.1, 0.1, 0.1] }}\nmaterial = \"glass\"\nposition = [5.0, 5.0, {height:?}]\n")
    };
    read(&format!("{SOLID}{}{}", one(5.0), one(5.1))).unwrap();
    let error = read(&format!("{SOLID}{}{}", one(5.0), one(5.05))).unwrap_err();
    assert!(error.to_string().contains("overlap at the start by 5.0000e-2 m"), "{error}");
    assert!(error.place.at.is_some());
}

#[test]
fn an_empty_scene_is_refused() {
    let error = read("dimension = 3\ntime = { step = 1e-4, steps = 10 }\n").unwrap_err().to_string();
    assert!(error.starts_with("bad.toml") && error.contains("no bodies") && error.contains("[[bodies]]"), "{error}");
    let error = read("").unwrap_err().to_string();
    assert!(error.contains("`dimension` is missing") || error.contains("`time` is missing"), "{error}");
}

#[test]
fn counts_and_memory_are_checked_before_anything_is_made() {
    let wanted = ["8000000000 bodies"];
    let packing = SOLID.replace("lattice", "packing");
    broken(&packing, "count = 8", "count = 8000000000", "generate[0].count", &wanted);
    let wanted = ["bodies need about", "GiB of memory"];
    broken(&packing, "count = 8", "count = 4000000000", "generate[0].count", &wanted);
    broken(SOLID, "count = 8", "count = 9000", "generate[0].count", &["on a lattice of 64 sites"]);
}

#[test]
fn a_packing_that_does_not_fit_says_how_many_did() {
    let text = SOLID.replace("lattice", "packing").replace("count = 8", "count = 8000");
    let error = read(&text).unwrap_err();
    assert!(error.message.contains("of 8000 bodies fit") && error.place.key == "generate[0].packing", "{error}");
}

#[test]
fn overrides_are_as_strict_as_the_file() {
    let set = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(|&s| s.to_owned()).collect();
        Scene::parse_with(SOLID, "scene.toml", &sets)
    };
    let scene =
        set(&["solver.tolerance=1e-9", "solver.local = sbp", "bodies.1.position=[0, 0, 0.11]", "solver.order=natural"]).unwrap();
    assert_eq!((scene.solver.tolerance, scene.solver.local.name()), (1e-9, "sbp"));
    assert_eq!(scene.bodies[1].position, [0.0, 0.0, 0.11]);
    assert_eq!(set(&["solver.rho.relative=0.4"]).unwrap().solver.rho, moreau_solve::Parameter::Relative(0.4));
    assert_eq!(set(&["output.folder=out/a-1"]).unwrap().output.folder.as_deref(), Some("out/a-1"));

    let error = set(&["time.steps=5", "solver.tolernce=1e-9"]).unwrap_err();
    assert_eq!((error.place.file.as_str(), error.place.at), ("--set", Some(LineColumn { line: 2, column: 8 })), "{error}");
    assert!(
        error.to_string().contains("2 | solver.tolernce=1e-9\n  |        ^^^^^^^^") && error.hint.contains("`tolerance`"),
        "{error}"
    );

    let cases = [
        ("time.theta=2", "theta is 2"),
        ("bodies.7.name=x", "no element `7`"),
        ("bodies.x.name=x", "is an array of 3"),
        ("nonsense", "without `=`"),
        ("time.step=nan", "finite"),
        ("time.step=fast", "expected a number"),
        ("gravity=[0, 0", "not valid TOML"),
        ("=3", "not valid TOML"),
        ("", "without `=`"),
    ];
    for (case, wanted) in cases {
        let error = set(&[case]).unwrap_err();
        assert!(error.place.file == "--set" && error.to_string().contains(wanted), "{case}: {error}");
    }
}

#[test]
fn a_missing_file_is_named() {
    let error = Scene::load(std::path::Path::new("no/such/scene.toml")).unwrap_err();
    assert!(error.to_string().starts_with("no/such/scene.toml: cannot read the scene"), "{error}");
}
