//! `list`, `schema`, `new` and `check`.

mod common;

use common::{Place, TEN};

/// The first words of the rows of `moreau list`.
fn listed(place: &Place, table: &str) -> Vec<String> {
    let out = place.moreau(&["list", table]).fine();
    for row in out.lines() {
        assert!(row.split_whitespace().count() >= 4, "no description in `{row}`");
    }
    out.lines().map(|row| row.split_whitespace().next().unwrap().to_owned()).collect()
}

#[test]
fn tables_have_a_row_for_each_name() {
    let known = [
        ("laws", &["frictionless", "coulomb", "sticking"][..]),
        ("local", &["sbp", "sal", "ebp", "eal", "pdas", "exact"]),
        ("global", &["nlgs", "accelerated"]),
        ("criteria", &["eps_glob", "scaled", "siconos", "strict"]),
        (
            "shapes",
            &[
                "ball",
                "box",
                "half_space",
                "disk",
                "polygon",
                "half_plane",
                "capsule",
                "cylinder",
                "polyhedron",
                "compound",
                "polyline",
            ],
        ),
        ("builders", &["arch", "wall", "dome", "ballast"]),
        ("outputs", &["vtk", "steps", "measures"]),
    ];
    for (table, names) in known {
        let rows = listed(&Place::new(), table);
        for name in names {
            // Some shapes are in both dimensions.
            assert!(
                (1..=2).contains(&rows.iter().filter(|row| row == name).count()),
                "`{name}` in `moreau list {table}`: {rows:?}"
            );
        }
    }
}

#[test]
fn scenes_can_name_all_that_is_listed() {
    let place = Place::with("ten.toml", TEN);
    let set = |table: &str, value: fn(&str) -> String| {
        for name in listed(&place, table) {
            place.moreau(&["check", "ten.toml", "--set", &value(&name)]).fine();
        }
    };
    set("local", |name| format!("solver.local={name}"));
    set("global", |name| format!("solver.global={name}"));
    set("criteria", |name| format!("solver.criterion={name}"));
    set("outputs", |name| format!("output.kinds=[\"{name}\"]"));
    set("laws", |name| format!("default_law={{ {name} = {} }}", if name == "coulomb" { "{ friction = 0.3 }" } else { "{}" }));
}

#[test]
fn the_schema_is_json() {
    let out = Place::new().moreau(&["schema"]).fine();
    let schema: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(schema["title"], "Scene");
    for key in ["dimension", "gravity", "time", "solver", "materials", "bodies", "containers", "generate", "output"] {
        assert!(schema["properties"][key].is_object(), "{key} is not in the schema");
    }
}

#[test]
fn a_new_scene_runs() {
    let place = Place::new();
    assert!(place.moreau(&["new", "heap"]).fine().contains("moreau run heap.toml"));
    assert!(place.read("heap.toml").contains("title = \"heap\""));
    place.moreau(&["check", "heap.toml"]).fine();
    place.moreau(&["run", "heap.toml", "--steps", "5"]).fine();
    assert_eq!(place.summary("out/heap")["steps"], 5);
    // The ending may be given, and names need not be fit for a title.
    place.moreau(&["new", "pile.toml"]).fine();
    place.moreau(&["new", "a \"b\" c"]).fine();
    for file in ["pile.toml", "a \"b\" c.toml"] {
        place.moreau(&["check", file]).fine();
    }
    assert!(!place.path("pile.toml.toml").exists());
}

#[test]
fn new_never_overwrites() {
    let place = Place::with("heap.toml", "mine");
    std::fs::create_dir(place.path("hill.toml")).unwrap();
    let before = place.all(".");
    for (name, file) in [("heap", "heap.toml"), ("heap.toml", "heap.toml"), ("hill", "hill.toml")] {
        place.moreau(&["new", name]).fails(1, &[file, "exists already", "choose another name"]);
    }
    assert_eq!(place.all("."), before);
}

#[test]
fn check_tells_what_would_run_and_writes_nothing() {
    let scene = r#"dimension = 3
time = { step = 1e-3, steps = 250 }
materials.glass.density = 3000.0
[[bodies]]
shape.ball = { radius = 0.1 }
material = "glass"
position = [0.5, 0.5, 0.5]
[[bodies]]
shape.half_space = { normal = [0, 0, 1] }
material = "glass"
position = [0, 0, 0]
"#;
    let place = Place::with("one.toml", scene);
    let out = place.moreau(&["check", "one.toml", "--set", "solver.local=eal"]).fine();
    let row = |name: &str| {
        let row = out.lines().find(|line| line.split_whitespace().next() == Some(name));
        row.unwrap_or_else(|| panic!("no {name}:\n{out}")).split_once(' ').unwrap().1.trim().to_owned()
    };
    assert_eq!(row("dimension"), "3D");
    assert_eq!(row("bodies"), "2 (1 free, 1 fixed or driven)");
    // 4/3 π r³ ϱ = 4 π kg.
    assert_eq!(row("mass"), "1.256637e1 kg");
    assert_eq!(row("box"), "[0.4000, 0.4000, 0.4000] to [0.6000, 0.6000, 0.6000] m");
    assert_eq!(row("time"), "250 steps of 1e-3 s, to t = 0.250000 s");
    assert!(row("solver").starts_with("eal inside accelerated"), "{out}");
    assert!(row("memory").contains("MiB"), "{out}");
    assert_eq!(place.all(".").len(), 1);
}
