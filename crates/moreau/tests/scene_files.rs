//! The shipped scenes, the schema, and what scenes become.

use moreau::bodies::Motion;
use moreau::scene::{AnyWorld, Scene, template};
use moreau::space::{Plane, Solid, Space};
use std::path::{Path, PathBuf};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

fn shipped() -> Vec<PathBuf> {
    let folders = [scenes(), scenes().join("paper")];
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap()).map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    files.sort();
    files
}

#[test]
fn every_shipped_scene_builds_and_names_its_schema() {
    assert!(shipped().len() >= 8);
    for path in shipped() {
        let text = std::fs::read_to_string(&path).unwrap();
        let schema = text.lines().next().unwrap().strip_prefix("#:schema ").expect("the first line names the schema");
        assert!(path.parent().unwrap().join(schema).exists(), "{}", path.display());
        let scene = Scene::load(&path).unwrap_or_else(|e| panic!("{e}"));
        scene.build(1 << 30).unwrap_or_else(|e| panic!("{e}"));
        assert!(text.lines().all(|line| line.chars().count() <= 130), "{}", path.display());
    }
}

#[test]
fn a_scene_written_out_is_the_same_scene() {
    for path in shipped() {
        let scene = Scene::load_with(&path, &["time.steps=7".to_owned()]).unwrap();
        let text = scene.to_toml();
        let again = Scene::parse(&text, "again.toml").unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!(again.time.steps, 7);
        assert_eq!(again, scene);
    }
}

/// `MOREAU_BLESS=1 cargo test -p moreau --test scene_files` writes the schema anew.
#[test]
fn the_schema_is_up_to_date() {
    let path = scenes().join("schema.json");
    let schema = format!("{:#}\n", Scene::schema());
    if std::env::var_os("MOREAU_BLESS").is_some() {
        std::fs::write(&path, &schema).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == schema, "scenes/schema.json is out of date: run this test with MOREAU_BLESS=1");
}

#[test]
fn every_field_of_the_schema_is_described() {
    fn walk(value: &serde_json::Value, at: &str) {
        let Some(object) = value.as_object() else { return };
        if let Some(properties) = object.get("properties").and_then(|p| p.as_object()) {
            for (name, property) in properties {
                let variant = object.get("additionalProperties").is_some() && object.get("description").is_some();
                assert!(property.get("description").is_some() || variant || property.get("$ref").is_some(), "{at}.{name}");
            }
        }
        for (name, inner) in object {
            match inner {
                serde_json::Value::Array(items) => items.iter().for_each(|item| walk(item, &format!("{at}.{name}"))),
                inner => walk(inner, &format!("{at}.{name}")),
            }
        }
    }
    walk(&Scene::schema(), "");
}

#[test]
fn the_template_becomes_a_scene_of_any_name() {
    for name in ["hourglass", "a \"quoted\" \\ name"] {
        let text = template(name);
        assert!(!text.contains("NAME") && !text.contains("#:schema"));
        Scene::parse(&text, "new.toml").unwrap_or_else(|e| panic!("{e}")).build(1 << 30).unwrap_or_else(|e| panic!("{e}"));
    }
}

const HEAD: &str = "time = { step = 1e-4, steps = 1000 }\nmaterials.glass.density = 2.0\nmaterials.steel.density = 3.0\n";

#[test]
fn bodies_of_space_arrive_as_they_are_written() {
    let text = format!(
        "dimension = 3\ngravity = [0, 0, -1]\n{HEAD}
        [[laws]]
        between = [\"steel\", \"glass\"]
        law.coulomb.friction = 0.25
        [[bodies]]
        name = \"block\"
        shape.box.size = [1, 2, 3]
        material = \"steel\"
        position = [1, 2, 3]
        orientation = {{ axis = [0, 0, 2], degrees = 90 }}
        velocity = [4, 5, 6]
        spin = [1, 0, 0]
        force = [7, 8, 9]
        torque = [0, 1, 0]
        [[bodies]]
        shape.half_space.normal = [3, 0, 4]
        material = \"glass\"
        position = [0, 0, -9]
        [[bodies]]
        shape.ball.radius = 1
        material = \"glass\"
        motion = \"driven\"
        position = [50, 0, 0]
        velocity = [1, 0, 0]
        [[containers]]
        min = [-99, -99, -99]
        max = [99, 99, 99]
        open = [\"+z\", \"-x\"]
        material = \"glass\"\n"
    );
    let scene = Scene::parse(&text, "space.toml").unwrap();
    let AnyWorld::Solid(world) = scene.build(u64::MAX).unwrap() else { panic!("a scene of space") };
    let bodies = &world.bodies;
    assert_eq!((bodies.len(), world.gravity, scene.frames_every()), (7, [0.0, 0.0, -1.0], 10));
    assert_eq!(bodies.mass[0][0], 18.0);
    // The block's own x axis points along the world's y: a spin about the world's x is one about its −y.
    assert_eq!(Solid::rotate(bodies.pose[0].rotation, [1.0, 0.0, 0.0]).map(|x| (x * 1e12).round() / 1e12), [0.0, 1.0, 0.0]);
    let spin = [bodies.velocity[0][3], bodies.velocity[0][4], bodies.velocity[0][5]];
    assert!(spin.iter().zip([0.0, -1.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-15), "{spin:?}");
    assert_eq!(bodies.velocity[0][..3], [4.0, 5.0, 6.0]);
    assert_eq!(bodies.load[0], [7.0, 8.0, 9.0, 0.0, 1.0, 0.0]);
    let normal = Solid::rotate(bodies.pose[1].rotation, [0.0, 0.0, 1.0]);
    assert!(normal.iter().zip([0.6, 0.0, 0.8]).all(|(a, b)| (a - b).abs() < 1e-15), "{normal:?}");
    assert_eq!(bodies.motion[..4], [Motion::Free, Motion::Driven, Motion::Driven, Motion::Driven]);
    assert_eq!(scene.material_names(), ["glass", "steel"]);
    assert_eq!((bodies.material[0], bodies.material[1]), (1, 0));
    assert_eq!(world.laws.get(0, 1).name(), "coulomb");
    assert_eq!(world.laws.get(1, 1).name(), "frictionless");
    assert_eq!((scene.body_name(0).as_deref(), scene.body_name(1)), (Some("block"), None));
    assert_eq!(scene.body_label(0), "bodies[0] \"block\"");
    assert_eq!(scene.body_label(3), "wall +x of containers[0]");
    assert_eq!(scene.body_label(6), "wall -z of containers[0]");
    // Each wall looks inwards.
    for wall in 3..7 {
        let pose = &bodies.pose[wall];
        let inward = Solid::rotate(pose.rotation, [0.0, 0.0, 1.0]);
        let along: f64 = (0..3).map(|k| inward[k] * pose.position[k]).sum();
        assert!((along + 99.0).abs() < 1e-12, "{wall}");
    }
}

#[test]
fn bodies_of_the_plane_arrive_as_they_are_written() {
    let text = format!(
        "dimension = 2\n{HEAD}
        [[bodies]]
        shape.polygon.vertices = [[0, 0], [0, 2], [4, 2], [4, 0]]
        material = \"glass\"
        position = [10, 20]
        orientation.degrees = 90
        spin = 3
        [[bodies]]
        shape.half_plane.normal = [1, 0]
        material = \"glass\"
        position = [-1, 0]\n"
    );
    let AnyWorld::Plane(world) = Scene::parse(&text, "plane.toml").unwrap().build(u64::MAX).unwrap() else {
        panic!("a plane scene")
    };
    let bodies = &world.bodies;
    // The centroid (2, 1) turned by a quarter is (−1, 2).
    assert_eq!(bodies.pose[0].position, [9.0, 22.0]);
    assert_eq!(bodies.mass[0][0], 16.0);
    assert_eq!(bodies.velocity[0], [0.0, 0.0, 3.0]);
    assert_eq!(Plane::rotate(bodies.pose[1].rotation, [0.0, 1.0]), [1.0, 0.0]);
}
