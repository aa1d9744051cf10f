//! Bodies from files of meshes and assemblies, and what hostile ones get: an error that says where, or a sound run.

use moreau::scene::{AnyWorld, Scene};
use moreau::shape::SolidShape;
use moreau::space::Solid;
use moreau::step::{Workspace, step};
use moreau::world::World;
use std::fmt::Write;
use std::path::PathBuf;
use tempfile::TempDir;

const HEAD: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 1e-3, steps = 1000 }
solver = { criterion = "scaled", tolerance = 1e-8, start = "warm", global = "auto" }
materials.stone.density = 1000.0
default_law.coulomb = { friction = 0.5 }
containers = [{ min = [-9, -9, 0], max = [9, 9, 9], open = ["-x", "+x", "-y", "+y", "+z"], material = "stone" }]
"#;

/// The corners of a box, by three bits, and its sides as faces of OBJ, counter-clockwise seen from outside.
fn box_obj(low: [f64; 3], high: [f64; 3]) -> String {
    let mut obj = String::new();
    for i in 0..8 {
        let [x, y, z] = [0, 1, 2].map(|k| if i >> k & 1 == 1 { high[k] } else { low[k] });
        writeln!(obj, "v {x} {y} {z}").unwrap();
    }
    obj + "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n"
}

/// A folder with these files and a scene of one body.
fn folder(files: &[(&str, &str)], body: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, format!("{HEAD}{body}")).unwrap();
    (folder, path)
}

fn built(files: &[(&str, &str)], body: &str) -> Result<World<Solid, 3, 6>, String> {
    let (_folder, path) = folder(files, body);
    let scene = Scene::load(&path).map_err(|error| error.to_string())?;
    // What was read is all that is needed.
    assert_eq!(Scene::parse(&scene.to_toml(), "elsewhere.toml").unwrap().bodies, scene.bodies);
    match scene.build(u64::MAX).map_err(|error| error.to_string())? {
        AnyWorld::Solid(world) => Ok(world),
        AnyWorld::Plane(_) => panic!("of the plane"),
    }
}

fn run(world: &mut World<Solid, 3, 6>, steps: usize) {
    let mut work = Workspace::default();
    for _ in 0..steps {
        let record = step(world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged(), "{record:?}");
    }
}

/// A body `[[bodies]]` of this shape in the middle of the ground at this height.
fn at(shape: &str, height: f64) -> String {
    format!("[[bodies]]\nshape.{shape}\nmaterial = \"stone\"\nposition = [0.0, 0.0, {height}]\n")
}

#[test]
fn a_polyhedron_of_a_file_in_mm_stands_where_it_is_put() {
    let obj = box_obj([0.0; 3], [100.0, 200.0, 300.0]);
    let mut world = built(&[("block.obj", &obj)], &at("polyhedron = { file = \"block.obj\", scale = 0.001 }", 0.0)).unwrap();
    assert!((world.bodies.mass[0][0] - 6.0).abs() < 1e-9, "{:?}", world.bodies.mass[0]);
    run(&mut world, 500);
    let [x, y, z] = world.bodies.pose[0].position;
    assert!((x - 0.05).abs() < 1e-9 && (y - 0.1).abs() < 1e-9 && (z - 0.15).abs() < 1e-9, "{x} {y} {z}");
}

/// A stair of three cubes of 0.1 m, two below and one on the first of them.
#[test]
fn a_concave_mesh_is_one_body_with_the_mass_of_the_whole() {
    // A staircase in the x-z plane, extruded along y.
    let outline = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.1, 0.1], [0.1, 0.2], [0.0, 0.2]];
    let mut obj = String::new();
    for y in [0.0, 0.1] {
        outline.iter().for_each(|[x, z]| writeln!(obj, "v {x} {y} {z}").unwrap());
    }
    // Both ends of two rectangles each, then the sides.
    obj += "f 1 2 3 4\nf 1 4 5 6\nf 10 9 8 7\nf 12 11 10 7\n";
    (0..6).for_each(|k| writeln!(obj, "f {} {} {} {}", k + 1, k + 7, (k + 1) % 6 + 7, (k + 1) % 6 + 1).unwrap());
    let mut world = built(&[("stair.obj", &obj)], &at("mesh = { file = \"stair.obj\", decompose = true }", 0.0)).unwrap();
    let SolidShape::Compound(compound) = &world.bodies.shape[0] else { panic!("a compound") };
    assert!((2..=8).contains(&compound.parts().len()), "{} pieces", compound.parts().len());
    assert!((world.bodies.mass[0][0] - 3.0).abs() < 1e-12);
    // About the centre: two cubes at a distance along x, one above the first.
    let centre = world.bodies.pose[0].position;
    let right = [0.25 / 3.0, 0.05, 0.25 / 3.0];
    assert!((0..3).all(|k| (centre[k] - right[k]).abs() < 1e-12), "{centre:?}");
    run(&mut world, 500);
    let end = world.bodies.pose[0].position;
    // The pieces keep to the surface to about half a cube of the grid in which the mesh is cut: 0.2/64/2 m.
    assert!((0..3).all(|k| (end[k] - right[k]).abs() < 2e-3), "{end:?}");
}

#[test]
fn the_blocks_of_an_assembly_stand_on_each_other() {
    let block = |z: f64, support: bool| {
        let corner = |i: usize| {
            let [x, y, up] = [0, 1, 2].map(|k| (i >> k & 1) as f64);
            format!("\"{i}\": {{\"x\": {x}, \"y\": {y}, \"z\": {}}}", up + z)
        };
        let corners = (0..8).map(corner).collect::<Vec<_>>().join(", ");
        let faces = "\"0\": [0, 4, 6, 2], \"1\": [1, 3, 7, 5], \"2\": [0, 1, 5, 4], \"3\": [2, 6, 7, 3], \"4\": [0, 2, 3, 1], \"5\": [4, 5, 7, 6]";
        format!(
            "{{\"block\": {{\"dtype\": \"Block\", \"data\": {{\"attributes\": {{\"name\": \"block\"}}, \"vertex\": {{{corners}}}, \"face\": {{{faces}}}}}}}, \"is_support\": {support}}}"
        )
    };
    let json =
        format!("{{\"graph\": {{\"node\": {{\"0\": {}, \"1\": {}}}, \"edge\": {{}}}}}}", block(0.0, true), block(1.0, false));
    let import = "[[import]]\nassembly = { file = \"two.json\", material = \"stone\", scale = 0.5 }\n";
    let mut world = built(&[("two.json", &json)], import).unwrap();
    assert!(!world.bodies.is_free(0) && world.bodies.is_free(1));
    run(&mut world, 300);
    assert!((world.bodies.pose[1].position[2] - 0.75).abs() < 1e-9, "{:?}", world.bodies.pose[1]);

    let error = built(&[("two.json", &json.replace("[4, 5, 7, 6]", "[4, 5, 7]"))], import).unwrap_err();
    assert!(error.contains("import[0].assembly.file") && error.contains("block \"0\"") && error.contains("open"), "{error}");
    let error = built(&[("two.json", &json)], &import.replace("stone", "stine")).unwrap_err();
    assert!(error.contains("did you mean `stone`?"), "{error}");
}

/// The second of two texts of OBJ with its points counted from the end, so that it can follow the first: each has eight.
fn from_end(obj: &str) -> String {
    let word = |word: &str| word.parse::<i32>().map_or(word.to_owned(), |number| (number - 9).to_string());
    let line = |line: &str| match line.starts_with('f') {
        true => line.split(' ').map(word).collect::<Vec<_>>().join(" "),
        false => line.to_owned(),
    };
    obj.lines().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

fn remarks(files: &[(&str, &str)], body: &str) -> Vec<String> {
    let (_folder, path) = folder(files, body);
    Scene::load(&path).unwrap_or_else(|error| panic!("{error}")).remarks().to_vec()
}

#[test]
fn objects_of_a_file_are_bodies_if_the_scene_asks_for_it() {
    let low = box_obj([-0.1, -0.1, 0.0], [0.1, 0.1, 0.2]);
    let high = from_end(&box_obj([-0.1, -0.1, 0.3], [0.1, 0.1, 0.5]));
    let wall = format!("o low\n{low}o high\n{high}");
    let import = "[[import]]\nmeshes = { file = \"wall.obj\", material = \"stone\" }\n";
    let mut world = built(&[("wall.obj", &wall)], import).unwrap();
    // Two bodies and the ground.
    assert_eq!(world.bodies.len(), 3);
    run(&mut world, 600);
    let heights = [0, 1].map(|i| world.bodies.pose[i].position[2]);
    assert!((heights[0] - 0.1).abs() < 1e-6 && (heights[1] - 0.3).abs() < 1e-3, "{heights:?}");
    let (_folder, path) = folder(&[("wall.obj", &wall)], import);
    let scene = Scene::load(&path).unwrap();
    assert_eq!((scene.body_name(0).as_deref(), scene.body_name(1).as_deref()), (Some("import[0] low"), Some("import[0] high")));
    assert!(scene.remarks().is_empty());

    // As one body they are remarked, as ground they are not.
    let shape = "mesh = { file = \"wall.obj\", decompose = true }";
    let said = remarks(&[("wall.obj", &wall)], &at(shape, 0.0));
    assert!(
        said.len() == 1 && said[0].contains("bodies[0].shape.mesh.file") && said[0].contains("2 objects that share no points"),
        "{said:?}"
    );
    assert!(remarks(&[("wall.obj", &wall)], &at("mesh = { file = \"wall.obj\" }", 0.0)).is_empty());

    // Without names the parts are bodies, if that is asked for.
    let unnamed = format!("{low}{high}");
    let said = remarks(&[("wall.obj", &unnamed)], &import.replace(" }", ", decompose = true }"));
    assert!(said.len() == 1 && said[0].contains("split = \"parts\""), "{said:?}");
    let parts = import.replace(" }", ", split = \"parts\", motion = \"fixed\" }");
    let world = built(&[("wall.obj", &unnamed)], &parts).unwrap();
    assert!(world.bodies.len() == 3 && !world.bodies.is_free(0));
    let error = built(&[("wall.obj", &format!("o open\n{}", low.replace("f 5 6 8 7\n", "")))], import).unwrap_err();
    assert!(error.contains("object \"open\"") && error.contains("the mesh is open"), "{error}");
}

/// A ground of two steps whose boxes share an edge or a face: four triangles at some edges. A box that slides over it stays level.
#[test]
fn a_ground_of_boxes_that_share_edges_carries_bodies() {
    let ground = |second: [[f64; 3]; 2]| {
        let boxes = box_obj([-1.0, -1.0, 0.0], [0.0, 1.0, 0.5]) + &from_end(&box_obj(second[0], second[1]));
        let ground = at("mesh = { file = \"ground.obj\" }", 0.0);
        let slider = at("box = { size = [0.2, 0.2, 0.2] }", 0.6).replace("[0.0,", "[-0.5,") + "velocity = [2.0, 0.0, 0.0]\n";
        let smooth = format!("{ground}{slider}");
        built(&[("ground.obj", &boxes)], &smooth)
    };
    // A face in common, of boxes of one height.
    let mut world = ground([[0.0, -1.0, 0.0], [1.0, 1.0, 0.5]]).unwrap();
    world.laws = moreau::laws::Laws::new(1, moreau_solve::Law::Frictionless(Default::default()));
    run(&mut world, 400);
    let (pose, velocity) = (world.bodies.pose[1], world.bodies.velocity[1]);
    assert!((pose.position[2] - 0.6).abs() < 1e-6 && (velocity[0] - 2.0).abs() < 1e-6, "{pose:?} {velocity:?}");
    // An edge in common: a step up, which stops it.
    let mut world = ground([[0.0, -1.0, 0.5], [1.0, 1.0, 1.0]]).unwrap();
    run(&mut world, 400);
    let position = world.bodies.pose[1].position;
    assert!(position[0] < -0.1 + 1e-3 && (position[2] - 0.6).abs() < 1e-2, "{position:?}");
}

/// Blocks with a hook each, whose concave ends are faces of eight corners. A fan of triangles around the first corner of such a face reaches
/// into the other block.
#[test]
fn hooks_that_lie_in_each_other_do_not_overlap_at_the_start() {
    let hook = |outline: &[[f64; 2]], key: &str, support: bool| {
        let count = outline.len();
        let vertex = |(i, [x, z]): (usize, &[f64; 2])| {
            [
                format!("\"{i}\": {{\"x\": {x}, \"y\": 0, \"z\": {z}}}"),
                format!("\"{}\": {{\"x\": {x}, \"y\": 0.3, \"z\": {z}}}", i + count),
            ]
            .join(", ")
        };
        let vertices = outline.iter().enumerate().map(vertex).collect::<Vec<_>>().join(", ");
        let front: Vec<String> = (0..count).map(|i| i.to_string()).collect();
        let back: Vec<String> = (0..count).rev().map(|i| (i + count).to_string()).collect();
        let sides = (0..count)
            .map(|i| format!("\"{}\": [{}, {}, {}, {}]", i + 2, (i + 1) % count, i, i + count, (i + 1) % count + count));
        let faces =
            [format!("\"0\": [{}], \"1\": [{}]", front.join(", "), back.join(", "))].into_iter().chain(sides).collect::<Vec<_>>();
        format!(
            "\"{key}\": {{\"is_support\": {support}, \"block\": {{\"vertex\": {{{vertices}}}, \"face\": {{{}}}}}}}",
            faces.join(", ")
        )
    };
    // Seen from −y, counter-clockwise: an L that lies, and one that is put into it upside down. The step is at x = 0.5.
    let low = [[0.5, 0.5], [0.0, 0.5], [0.0, 0.0], [1.0, 0.0], [1.0, 0.25], [0.5, 0.25]];
    let high = [[0.5, 0.25], [1.0, 0.25], [1.0, 0.75], [0.0, 0.75], [0.0, 0.5], [0.5, 0.5]];
    for begin in 0..6 {
        let turned = |outline: &[[f64; 2]; 6]| {
            let mut outline = *outline;
            outline.rotate_left(begin);
            outline
        };
        let json = format!(
            "{{\"node\": {{{}, {}}}, \"edge\": {{}}}}",
            hook(&turned(&low), "low", true),
            hook(&turned(&high), "high", false)
        );
        let import = "[[import]]\nassembly = { file = \"hooks.json\", material = \"stone\", decompose = true }\n";
        let mut world = built(&[("hooks.json", &json)], import).unwrap_or_else(|error| panic!("{begin}: {error}"));
        // Blocks come in the order of their keys.
        assert!(world.bodies.is_free(0) && !world.bodies.is_free(1));
        let before = world.bodies.pose[0].position;
        run(&mut world, 50);
        let after = world.bodies.pose[0].position;
        assert!((0..3).all(|k| (after[k] - before[k]).abs() < 1e-4), "{begin}: {before:?} {after:?}");
    }
}

#[test]
fn an_import_names_supports_densities_and_overlaps() {
    let block = |z: f64, more: &str| {
        let corner = |i: usize| {
            let [x, y, up] = [0, 1, 2].map(|k| (i >> k & 1) as f64);
            format!("[{x}, {y}, {}]", up + z)
        };
        let corners = (0..8).map(corner).collect::<Vec<_>>().join(", ");
        let faces = "[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]";
        format!("{{\"geometry\": {{\"vertices\": [{corners}], \"faces\": [{faces}]}}{more}}}")
    };
    // The third stands 1 % of a block deep in the second.
    let json = format!(
        "{{\"elements\": [{}, {}, {}]}}",
        block(0.0, ""),
        block(1.0, ", \"density\": 2000"),
        block(1.99, ", \"held\": true")
    );
    let file = [("three.json", json.as_str())];
    let with = |more: &str| format!("[[import]]\nassembly = {{ file = \"three.json\", material = \"stone\"{more} }}\n");
    let error = built(&file, &with("")).unwrap_err();
    assert!(error.contains("overlap at the start by 1.0") && error.contains("start.max_overlap = 0.001"), "{error}");
    let masses = |more: &str| {
        let world = built(&file, &with(&format!(", max_overlap = 0.05{more}"))).unwrap_or_else(|error| panic!("{more}: {error}"));
        [0, 1, 2].map(|i| if world.bodies.is_free(i) { world.bodies.mass[i][0].round() } else { f64::INFINITY })
    };
    let held = f64::INFINITY;
    assert_eq!(masses(""), [1000.0, 2000.0, 1000.0]);
    assert_eq!(masses(", density = 500.0"), [500.0, 500.0, 500.0]);
    assert_eq!(masses(", density = 500.0, blocks.1.density = 700.0"), [500.0, 700.0, 500.0]);
    assert_eq!(masses(", supports.index = [0, 2]"), [held, 2000.0, held]);
    assert_eq!(masses(", supports.key = [\"1\"]"), [1000.0, held, 1000.0]);
    assert_eq!(masses(", supports.below = 0.5"), [held, 2000.0, 1000.0]);
    assert_eq!(masses(", supports.attribute = \"held\""), [1000.0, 2000.0, held]);
    assert_eq!(masses(", supports.below = 1.5, blocks = { 0 = { support = false } }"), [1000.0, held, 1000.0]);
    let only = ", blocks = { 2 = { max_overlap = 0.05 } }";
    assert!(built(&file, &with(only)).is_ok());
    let said = remarks(&file, &with(only));
    assert!(said.len() == 1 && said[0].contains("three.json gives 1 blocks a density of their own, 2000 kg/m³"), "{said:?}");
    for (more, words) in [
        (", supports.index = [3]", "there is no block 3"),
        (", supports.key = [\"3\"]", "there is no block `3`"),
        (", supports.below = -1.0", "no block begins below -1 m: the lowest point is at 0 m"),
        (", supports.attribute = \"is_fixed\"", "no block has the attribute `is_fixed` set"),
        (", blocks.7.density = 1.0", "there is no block `7`"),
        (", blocks.1.density = 0.0", "density is 0"),
        (", concavity = 0.1", "add decompose = true"),
    ] {
        let error = built(&file, &with(more)).unwrap_err();
        assert!(error.contains(words), "{more}: {error}");
    }
}

/// What is wrong with a mesh is said, whether it is to be a surface or a body; what is only ugly runs.
#[test]
fn hostile_meshes_get_an_error_or_a_sound_run() {
    let good = box_obj([-0.1, -0.1, 0.0], [0.1, 0.1, 0.2]);
    let flipped = good.replace("f 1 5 7 3", "f 3 7 5 1");
    let open = good.replace("f 5 6 8 7\n", "");
    let degenerate = format!("{good}f 1 2 2\n");
    // A second box across a corner of the first: its faces name the last eight points, counted from the end.
    let second = box_obj([0.0, 0.03, 0.1], [0.3, 0.35, 0.33]);
    let from_end = |word: &str| word.parse::<i32>().map_or(word.to_owned(), |number| (number - 9).to_string());
    let from_end = |line: &str| match line.starts_with('f') {
        true => line.split(' ').map(from_end).collect::<Vec<_>>().join(" "),
        false => line.to_owned(),
    };
    let crossing = format!("{good}{}", second.lines().map(from_end).collect::<Vec<_>>().join("\n"));
    let flat = box_obj([-0.1, -0.1, 0.0], [0.1, 0.1, 0.0]);
    let apart = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 0 0 0\nv 0 1 0\nv 0 0 1\nf 4 5 6\n";
    let needle = box_obj([-0.1, -1e-4, 0.0], [0.1, 1e-4, 2e-4]);
    for (what, obj, surface, body) in [
        ("flipped", flipped.as_str(), "triangles that face", "triangles that face"),
        ("open", open.as_str(), "", "open"),
        ("degenerate", degenerate.as_str(), "no area", "no area"),
        ("without volume", flat.as_str(), "no area", "no area"),
        ("that crosses itself", &crossing, "", "cross"),
        ("of points given twice", apart, "", "open"),
        ("as thin as a needle", needle.as_str(), "", ""),
        ("empty", "", "no triangles", "no triangles"),
        ("far", &good.replace("v 0.1", "v 1e300"), "below 1e60", "below 1e60"),
        ("no number", &good.replace("v 0.1", "v nan"), "nan", "nan"),
    ] {
        for (decompose, words) in [("", surface), (", decompose = true", body)] {
            let shape = at(&format!("mesh = {{ file = \"it.obj\"{decompose} }}"), 0.0);
            let ball = at("ball = { radius = 0.05 }", 3.0);
            match built(&[("it.obj", obj)], &format!("{shape}{ball}")) {
                Err(error) => assert!(!words.is_empty() && error.contains(words), "{what}{decompose}: {error}"),
                Ok(mut world) => {
                    assert!(words.is_empty(), "{what}{decompose} was taken");
                    run(&mut world, 900);
                    assert!(world.bodies.pose.iter().flat_map(|pose| pose.position).all(f64::is_finite), "{what}{decompose}");
                }
            }
        }
    }
}
