//! Drives, removals, sources and sinks in scene files: what is wrong is named with its place and what would be right.

use moreau::scene::Scene;

const SCENE: &str = r#"dimension = 3
time = { step = 1e-3, steps = 100 }
materials.glass.density = 2500.0
[[bodies]]
shape.half_space = { normal = [0.0, 0.0, 1.0] }
material = "glass"
position = [0.0, 0.0, 0.0]
drive = [{ position = [0.0, 0.0, { sine = { amplitude = 0.1, frequency = 2.0 } }] }]
[[bodies]]
shape.ball = { radius = 0.1 }
material = "glass"
position = [0.0, 0.0, 0.5]
removed_at = 0.9
[[bodies.drive]]
from = 0.1
velocity = [0.0, { ramp = { from = 0.0, to = 1.0, begin = 0.1, end = 0.2 } }, 0.0]
axis = [0.0, 0.0, 1.0]
spin = { table = { times = [0.0, 1.0], values = [0.0, 2.0] } }
[[bodies.drive]]
from = 0.4
force = [1.0, 0.0, 0.0]
torque = [0.0, 0.0, 1.0]
[[bodies.drive]]
from = 0.6
motion = "fixed"
[[sources]]
material = "glass"
radii.constant = 0.05
min = [1.0, 1.0, 1.0]
max = [2.0, 2.0, 2.0]
rate = 100.0
[[sinks]]
min = [-1.0, -1.0, -2.0]
max = [1.0, 1.0, -1.0]
"#;

fn error(line: &str, by: &str) -> (String, String) {
    assert_eq!(SCENE.matches(line).count(), 1, "`{line}` must stand once in the scene");
    let text = SCENE.replace(line, by);
    let error = Scene::parse(&text, "bad.toml").and_then(|scene| scene.build(u64::MAX).map(drop)).expect_err(by);
    (error.place.key.clone(), error.to_string())
}

#[test]
fn the_scene_that_tests_break_is_right_and_written_out_the_same() {
    let scene = Scene::parse(SCENE, "right.toml").unwrap_or_else(|e| panic!("{e}"));
    scene.build(u64::MAX).unwrap_or_else(|e| panic!("{e}"));
    let again = Scene::parse(&scene.to_toml(), "again.toml").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(again, scene);
    assert_eq!(scene.estimate().bodies, 2 + 11, "one each 10 ms from 0 to 0.1 s");
    assert_eq!(scene.body_label(2), "number 0 of sources[0]");
}

#[test]
fn what_is_wrong_in_a_drive_is_named() {
    let drive = "bodies[1].drive";
    let cases = [
        ("from = 0.4", "from = 0.1", format!("{drive}[1].from"), "order of their times"),
        ("from = 0.1", "from = -0.1", format!("{drive}[0].from"), "0 (the start of the run)"),
        ("from = 0.6", "from = 0.95", format!("{drive}[2].from"), "before removed_at"),
        ("removed_at = 0.9", "removed_at = -1.0", "bodies[1].removed_at".to_owned(), "0 (the start of the run)"),
        (
            "frequency = 2.0",
            "frequency = 0.0",
            "bodies[0].drive[0].position[2].sine.frequency".to_owned(),
            "positive number, in Hz",
        ),
        (
            "frequency = 2.0",
            "frequncy = 2.0",
            "bodies[0].drive[0].position[2].sine.frequncy".to_owned(),
            "did you mean `frequency`?",
        ),
        ("{ sine = ", "{ sin = ", "bodies[0].drive[0].position[2]".to_owned(), "unknown name `sin`"),
        ("begin = 0.1, end = 0.2", "begin = 0.2, end = 0.2", format!("{drive}[0].velocity[1].ramp.end"), "end after begin"),
        ("times = [0.0, 1.0]", "times = [1.0, 1.0]", format!("{drive}[0].spin.table.times[1]"), "ascending"),
        ("times = [0.0, 1.0]", "times = [0.0]", format!("{drive}[0].spin.table.values"), "a value for each time"),
        ("axis = [0.0, 0.0, 1.0]\n", "\n", format!("{drive}[0].spin"), "without an axis"),
        ("axis = [0.0, 0.0, 1.0]\n", "axis = [0.0, 0.0, 0.0]\n", format!("{drive}[0].axis"), "without a length"),
        ("axis = [0.0, 0.0, 1.0]\n", "axis = [0.0, 0.0, 1.0]\nangle = 1.0\n", format!("{drive}[0].angle"), "keep one of them"),
        ("force = [1.0, 0.0, 0.0]", "force = [1.0, 0.0]", format!("{drive}[1].force"), "expected 3 functions"),
        ("force = [1.0, 0.0, 0.0]", "velocity = [1.0, 0.0, 0.0]", format!("{drive}[1].torque"), "only free bodies follow forces"),
        ("motion = \"fixed\"", "motion = \"driven\"", format!("{drive}[2].motion"), "a driven body without a motion"),
        ("motion = \"fixed\"", "", format!("{drive}[2]"), "a drive that does nothing"),
        ("from = 0.1\n", "from = 0.1\nmotion = \"free\"\n", format!("{drive}[0].motion"), "only driven bodies move as given"),
        (
            "drive = [{ position",
            "drive = [{ from = 0.5, motion = \"free\" }, { from = 1.0, position",
            "bodies[0].drive[0].motion".to_owned(),
            "no mass",
        ),
        (
            "drive = [{ position",
            "velocity = [0.0, 0.0, 1.0]\ndrive = [{ position",
            "bodies[0].velocity".to_owned(),
            "beside a drive",
        ),
        ("drive = [{ position", "motion = \"fixed\"\ndrive = [{ position", "bodies[0].motion".to_owned(), "the drive says how"),
    ];
    let mut wrong = Vec::new();
    for (line, by, key, wanted) in cases {
        let (found, text) = error(line, by);
        if found != key || !text.contains(wanted) {
            wrong.push(format!("`{by}` gives {found}, not {key}: {text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_is_wrong_in_a_source_or_sink_is_named() {
    let cases = [
        ("rate = 100.0", "rate = -1.0", "sources[0].rate", "positive number, in 1/s"),
        ("rate = 100.0", "", "sources[0]", "either `rate` or `interval`"),
        ("rate = 100.0", "rate = 1.0\ninterval = 1.0", "sources[0]", "either `rate` or `interval`"),
        ("rate = 100.0", "rate = 1.0\ncount = 0", "sources[0].count", "1 or more"),
        ("rate = 100.0", "rate = 1.0\nfrom = 2.0\nuntil = 1.0", "sources[0].until", "at or after from"),
        ("rate = 100.0", "rate = 1e12", "sources[0]", "can be numbered"),
        ("max = [2.0, 2.0, 2.0]", "max = [2.0, 1.0, 2.0]", "sources[0].max[1]", "max above min"),
        ("max = [2.0, 2.0, 2.0]", "max = [2.0, 1.05, 2.0]", "sources[0].max[1]", "the largest has room"),
        ("max = [1.0, 1.0, -1.0]", "max = [1.0, 1.0, -3.0]", "sinks[0].max[2]", "max above min"),
        ("max = [1.0, 1.0, -1.0]", "max = [1.0, 1.0]", "sinks[0].max", "expected 3 numbers"),
    ];
    let mut wrong = Vec::new();
    for (line, by, key, wanted) in cases {
        let (found, text) = error(line, by);
        if found != key || !text.contains(wanted) {
            wrong.push(format!("`{by}` gives {found}, not {key}: {text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
