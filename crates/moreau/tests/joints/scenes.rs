//! Joints of scenes: what is wrong is said.

use super::{head, plane};
use moreau::scene::Scene;
use moreau::step::{Workspace, step};

const BASE: &str = "dimension = 3
time = { step = 1e-3, steps = 1 }
materials.steel.density = 1000.0
[[bodies]]
name = \"wall\"
motion = \"fixed\"
shape.ball = { radius = 0.1 }
material = \"steel\"
position = [0.0, 0.0, 0.0]
[[bodies]]
name = \"door\"
shape.ball = { radius = 0.1 }
material = \"steel\"
position = [1.0, 0.0, 0.0]
[[joints]]
name = \"post\"
kind.ball = { anchor = [0.5, 0.0, 0.0] }
between = [\"wall\", \"door\"]
";

/// Breaks a line of the scene and checks what is said of which key.
#[track_caller]
fn broken(line: &str, by: &str, key: &str, wanted: &[&str]) {
    assert_eq!(BASE.matches(line).count(), 1, "{line}");
    let error = Scene::parse(&BASE.replace(line, by), "bad.toml").expect_err(by);
    let text = error.to_string();
    assert_eq!(error.place.key, key, "{text}");
    wanted.iter().for_each(|part| assert!(text.contains(part), "{text} does not say `{part}`"));
}

const BALL: &str = "kind.ball = { anchor = [0.5, 0.0, 0.0] }";
const BETWEEN: &str = "between = [\"wall\", \"door\"]\n";

#[test]
fn what_is_wrong_with_a_joint_is_said() {
    let between = |names: &str| format!("between = {names}\n");
    broken(BETWEEN, &between("[\"wall\", \"dor\"]"), "joints[0].between[1]", &["no body is named `dor`", "did you mean `door`?"]);
    broken(BETWEEN, &between("[]"), "joints[0].between", &["0 names", "one or two"]);
    broken(BETWEEN, &between("[\"door\", \"wall\", \"wall\"]"), "joints[0].between", &["3 names"]);
    broken(BETWEEN, &between("[\"door\", \"door\"]"), "joints[0].between[1]", &["joined to itself"]);
    broken(BETWEEN, &between("[\"wall\"]"), "joints[0].between", &["do not give way", "at least one body that is free"]);
    broken(BALL, "kind.ball = { anchor = [0.5, 0.0] }", "joints[0].kind.ball.anchor", &["2 components", "expected 3 numbers"]);
    broken(BALL, "kind.hinge = { anchor = [0.5, 0.0, 0.0] }", "joints[0].kind.hinge", &["a hinge without an axis"]);
    let flat = "kind.hinge = { anchor = [0.5, 0.0, 0.0], axis = [0.0, 0.0, 0.0] }";
    broken(BALL, flat, "joints[0].kind.hinge.axis", &["without a length"]);
    broken(BALL, "kind.slider = { axis = [] }", "joints[0].kind.slider.axis", &["0 components"]);
    broken(BALL, "kind.rope = { axis = [] }", "joints[0].kind.rope", &["rope", "`fixed`", "`slider`"]);
    let none = "kind.distance = { from = [0.5, 0.0, 0.0], to = [0.5, 0.0, 0.0] }";
    broken(BALL, none, "joints[0].kind.distance.to", &["points that are not apart"]);
    let twice = format!("{BETWEEN}[[joints]]\nname = \"post\"\n{BALL}\nbetween = [\"door\"]\n");
    broken(BETWEEN, &twice, "joints[1].name", &["a name that is taken", "joints[0]"]);
    let plane = BASE
        .replace("dimension = 3", "dimension = 2")
        .replace("ball = { radius", "disk = { radius")
        .replace(", 0.0, 0.0]", ", 0.0]");
    let error = Scene::parse(&plane, "bad.toml").expect_err("a ball joint in the plane");
    assert!(error.to_string().contains("a pin in the plane is a hinge"), "{error}");
    let axis = plane.replace("kind.ball = { anchor = [0.5, 0.0] }", "kind.hinge = { anchor = [0.5, 0.0], axis = [0.0, 1.0] }");
    let error = Scene::parse(&axis, "bad.toml").expect_err("an axis in the plane");
    assert_eq!(error.place.key, "joints[0].kind.hinge.axis", "{error}");
}

/// Problem files know contacts alone: the problem of a step with joints is refused by the name of what it holds.
#[test]
fn a_failed_step_with_joints_says_why_there_is_no_file() {
    let mut text = head(2, 1e-3).replace("\"stop\"", "\"dump\", max_sweeps = 10");
    let disks = [("a", "motion = \"driven\"\nvelocity = [1.0, 0.0]"), ("b", "")].map(|(name, motion)| {
        format!("[[bodies]]\nname = \"{name}\"\nshape.disk = {{ radius = 0.2 }}\nmaterial = \"steel\"\nposition = [0.0, 0.0]\n{motion}\n")
    });
    text += &disks.concat();
    // What holds b to the world does not let it go with a.
    text += "[[joints]]\nkind.fixed = {}\nbetween = [\"b\"]\n[[joints]]\nkind.fixed = {}\nbetween = [\"a\", \"b\"]\n";
    let (mut world, mut work) = (plane(&text), Workspace::default());
    assert!(!step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}")).converged());
    let reason = work.take_failed().expect("the solve failed").problem.expect_err("no place for joints").to_string();
    assert!(reason.contains("contact 0 has Bilateral"), "{reason}");
}

/// The scene that a run writes down is the scene that was run.
#[test]
fn joints_are_written_as_they_are_read() {
    let kinds = ["kind.fixed = {}", "kind.slider = { axis = [1.0, 0.0, 0.0] }", BALL];
    for kind in kinds {
        let scene = Scene::parse(&BASE.replace(BALL, kind), "joint.toml").unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(Scene::parse(&scene.to_toml(), "again.toml").unwrap_or_else(|error| panic!("{error}")), scene);
    }
}
