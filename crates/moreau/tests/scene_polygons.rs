//! Polygons and polylines from files, and what is said of wrong ones.

use moreau::scene::{AnyWorld, Scene, SceneError};
use std::path::Path;

const HEAD: &str = r#"
dimension = 2
time = { step = 1e-3, steps = 10 }
materials.stone.density = 1000.0
"#;

/// Reads a scene beside which a file lies.
fn read(bodies: &str, file: &str, text: &str) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("stones")).unwrap();
    std::fs::write(folder.path().join(file), text).unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, format!("{HEAD}{bodies}")).unwrap();
    Scene::load(&path)
}

fn masses(scene: &Scene) -> Vec<f64> {
    match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Plane(world) => world.bodies.mass.iter().map(|mass| mass[0]).collect(),
        AnyWorld::Solid(_) => panic!("the scene is plane"),
    }
}

const ONE: &str = "[[bodies]]\nshape.polygon.file = \"stones/one.csv\"\nmaterial = \"stone\"\nposition = [1.0, 2.0]\n";

const MANY: &str = "[[import]]\npolygons = { file = \"many.csv\", material = \"stone\", decompose = true }\n";

#[test]
fn a_polygon_of_a_file_takes_the_file_s_place() {
    let scene = read(ONE, "stones/one.csv", "x,y\n0,0\n2,0\n2,1\n0,1\n").unwrap();
    assert_eq!(masses(&scene), [2000.0]);
    // What is written down needs no file any more.
    let again = Scene::parse(&scene.to_toml(), "elsewhere.toml").unwrap();
    assert_eq!(again, scene);
}

#[test]
fn an_import_makes_a_body_a_polygon() {
    let text = "# two stones\nid,x,y\nbig,0,0\nbig,2,0\nbig,2,2\nbig,1,0.5\nbig,0,2\nsmall,5,0\nsmall,6,0\nsmall,5,1\n";
    let scene = read(MANY, "many.csv", text).unwrap();
    assert_eq!(scene.body_label(0), "bodies[0] \"import[0] big\"");
    let found = masses(&scene);
    // The square less the notch: 4 − 2 · 1.5 / 2.
    assert!((found[0] - 2500.0).abs() < 1e-9 && (found[1] - 500.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn a_chain_of_a_file_is_a_ground() {
    let bodies = "[[bodies]]\nshape.polyline.file = \"ground.csv\"\nmaterial = \"stone\"\nposition = [0.0, 0.0]\n";
    let text: String = (0..100_000).map(|k| format!("{:?},{:?}\n", 0.01 * f64::from(k), f64::from(k % 7))).collect();
    let ball = "[[bodies]]\nshape.disk.radius = 0.1\nmaterial = \"stone\"\nposition = [500.0, 9.0]\n";
    assert_eq!(masses(&read(&format!("{bodies}{ball}"), "ground.csv", &text).unwrap()).len(), 2);
}

/// The error of a file is at the key that names it and says file and line.
fn refused(bodies: &str, file: &str, text: &str, key: &str, wanted: &[&str]) {
    let error = read(bodies, file, text).expect_err(text);
    assert_eq!(error.place.key, key, "{error}");
    assert!(error.place.at.is_some() && !error.hint.is_empty(), "{error}");
    for words in wanted {
        assert!(error.to_string().contains(words), "`{words}` is not in:\n{error}");
    }
}

#[test]
fn what_is_wrong_in_a_file_is_named_with_its_line() {
    let key = "bodies[0].shape.polygon.file";
    let one = |text: &str, wanted: &[&str]| refused(ONE, "stones/one.csv", text, key, wanted);
    one("0,0\n1,0\n1,one\n", &["stones/one.csv:3: `one` is not a finite number"]);
    one("0,0\n1,0,0\n", &["stones/one.csv:2: 3 columns where there are 2"]);
    one("", &["stones/one.csv has no points"]);
    one("# a notch\n0,0\n1,0\n0.3,0.3\n0,1\n", &["stones/one.csv:4: not a convex polygon", "vertex 2", "decompose = true"]);
    one("0,0\n1,0\n0,1\n\n5,5\n6,5\n5,6\n", &["stones/one.csv:5: a second outline begins", "[[import]]"]);
    let missing = "cannot read";
    refused(ONE, "other.csv", "0,0\n", key, &[missing, "one.csv"]);
    refused(&ONE.replace("stones/one.csv", "stones"), "other.csv", "", key, &[missing, "not a file"]);
    let bow_tie = "0,0\n1,0\n0,1\n\n5,0\n6,1\n6,0\n5,1\n";
    refused(MANY, "many.csv", bow_tie, "import[0].polygons.file", &["many.csv:7: not a polygon", "edges 0 and 2 meet"]);
    let wood = MANY.replace("\"stone\"", "\"wood\"");
    refused(&wood, "many.csv", "0,0\n1,0\n0,1\n", "import[0].polygons.material", &["unknown material `wood`"]);
}

#[test]
fn a_path_is_relative_to_the_scene_or_as_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("one.csv");
    std::fs::write(&file, "0,0\n1,0\n0,1\n").unwrap();
    let bodies = ONE.replace("stones/one.csv", &file.display().to_string());
    let name = Path::new("nowhere").join("scene.toml").display().to_string();
    assert_eq!(masses(&Scene::parse(&format!("{HEAD}{bodies}"), &name).unwrap()), [500.0]);
}

/// The error of a scene without files.
fn wrong(shape: &str, key: &str, wanted: &[&str]) {
    let text = format!("{HEAD}[[bodies]]\nshape.{shape}\nmaterial = \"stone\"\nposition = [0.0, 0.0]\n");
    let error = Scene::parse(&text, "scene.toml").expect_err(shape);
    assert_eq!(error.place.key, format!("bodies[0].shape.{key}"), "{error}");
    for words in wanted {
        assert!(error.to_string().contains(words), "`{words}` is not in:\n{error}");
    }
}

#[test]
fn shapes_of_the_plane_say_what_they_need() {
    wrong("box.size = [1.0, 1.0, 1.0]", "box.size", &["3 components where dimension = 2", "expected 2 numbers"]);
    wrong("box.size = [1.0, -1.0]", "box.size[1]", &["expected a positive number, in m"]);
    wrong("capsule = { radius = 0.1, length = 0.0 }", "capsule.length", &["expected a positive number, in m"]);
    wrong("polygon = {}", "polygon", &["no vertices", "`file = "]);
    wrong("polygon = { vertices = [[0, 0]], file = \"a.csv\" }", "polygon", &["vertices and a file"]);
    let bow_tie = "polygon = { decompose = true, vertices = [[0, 0], [1, 1], [1, 0], [0, 1]] }";
    wrong(bow_tie, "polygon.vertices[2]", &["not a polygon", "edges 0 and 2 meet"]);
    wrong("polyline.points = [[0, 0], [1, 0], [0.5, 0]]", "polyline.points[1]", &["turns back on itself"]);
    wrong("polyline.points = [[0, 0]]", "polyline.points", &["1 points; it needs at least 2"]);
    wrong("compound.parts = []", "compound.parts", &["a compound without parts", "expected 1 to 1024"]);
    let ground = "compound.parts = [{ shape.half_plane.normal = [0, 1] }]";
    wrong(ground, "compound.parts[0].shape", &["a half_plane as a part"]);
    wrong("compound.parts = [{ shape.disk.radius = -1.0 }]", "compound.parts[0].shape.disk.radius", &["expected a positive"]);
    wrong("compound.parts = [{ shape.ball.radius = 1.0 }]", "compound.parts[0].shape", &["a ball where dimension = 2"]);
    let place = "compound.parts = [{ shape.disk.radius = 1.0, position = [1.0] }]";
    wrong(place, "compound.parts[0].position", &["1 component where dimension = 2"]);
}

#[test]
fn a_chain_is_fixed_or_driven() {
    let body = "[[bodies]]\nshape.polyline.points = [[0, 0], [1, 0]]\nmaterial = \"stone\"\nposition = [0.0, 0.0]\n";
    Scene::parse(&format!("{HEAD}{body}orientation = 0.1\n"), "scene.toml").unwrap();
    let error = Scene::parse(&format!("{HEAD}{body}motion = \"free\"\n"), "scene.toml").unwrap_err();
    assert!(error.to_string().contains("a polyline that is free"), "{error}");
}
