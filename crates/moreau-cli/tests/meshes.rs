//! Files of meshes as a user meets them: what is wrong and does no harm is printed as a note, and the command goes on.

mod common;

use common::Place;

/// A ground and a body of a file, which `SHAPE` says.
const SCENE: &str = r#"dimension = 3
gravity = [0.0, 0.0, -9.81]
time = { step = 1e-3, steps = 5 }
materials.stone.density = 1000.0
default_law.coulomb = { friction = 0.5 }
containers = [{ min = [-9, -9, 0], max = [9, 9, 9], open = ["-x", "+x", "-y", "+y", "+z"], material = "stone" }]
"#;

const BODY: &str =
    "[[bodies]]\nshape.mesh = { file = \"FILE\", decompose = true }\nmaterial = \"stone\"\nposition = [0.0, 0.0, 0.0]\n";

/// A tetrahedron of a right angle, seen from outside.
const TETRAHEDRON: [[[f32; 3]; 3]; 4] = {
    let [o, x, y, z] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    [[o, y, x], [o, x, z], [x, y, z], [o, z, y]]
};

/// Binary STL whose head says `count` triangles, with bytes behind the last.
fn stl(count: u32, behind: &[u8]) -> Vec<u8> {
    let mut bytes = b"solid made by a program".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for triangle in TETRAHEDRON {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes.extend(behind);
    bytes
}

#[test]
fn stl_with_a_wrong_count_is_read_with_a_note() {
    let place = Place::with("scene.toml", &(SCENE.to_owned() + &BODY.replace("FILE", "it.stl")));
    for (bytes, note) in [
        (stl(4, b""), ""),
        (
            stl(7, b""),
            "note: bodies[0].shape.mesh.file: it.stl: the number of triangles is given as 7, and there are 4; all 4 were read",
        ),
        (stl(4, b"made by me"), "it.stl: 10 bytes after the last triangle were left out"),
    ] {
        place.write("it.stl", bytes);
        for words in [&["check", "scene.toml"][..], &["run", "scene.toml", "--new", "--quiet"]] {
            let ran = place.moreau(words);
            let lines: Vec<&str> = ran.err.lines().filter(|line| !line.contains("the run is not to be relied on")).collect();
            assert_eq!((ran.code, lines.len()), (Some(0), usize::from(!note.is_empty())), "{ran:?}");
            assert!(ran.err.contains(note), "{ran:?}");
        }
    }
    place.write("it.stl", &stl(4, b"")[..250]);
    place.refuses(&["check", "scene.toml"], 3, &["it.stl, byte 80: 250 bytes where 4 triangles take 284"]);
}

#[test]
fn objects_in_one_body_are_noted_and_an_edge_of_four_triangles_is_named() {
    let tetrahedron = |at: i32, first: i32| {
        let points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|[x, y, z]| format!("v {} {y} {z}\n", x + at)).concat();
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
            .map(|[a, b, c]| format!("f {} {} {}\n", a + first, b + first, c + first));
        points + &faces.concat()
    };
    let place = Place::with("scene.toml", &(SCENE.to_owned() + &BODY.replace("FILE", "it.obj")));
    place.write("it.obj", format!("o a\n{}o b\n{}", tetrahedron(0, 1), tetrahedron(2, 5)));
    let ran = place.moreau(&["check", "scene.toml"]);
    let note = "note: bodies[0].shape.mesh.file: it.obj has 2 objects that share no points";
    assert!(ran.code == Some(0) && ran.err.contains(note), "{ran:?}");
    place.write("each.toml", SCENE.to_owned() + "[[import]]\nmeshes = { file = \"it.obj\", material = \"stone\" }\n");
    assert!(place.moreau(&["check", "each.toml"]).fine().contains("3 (2 free, 1 fixed or driven)"));

    // Mirrored at x = 0, so that both share the edge along z and that along y.
    let mirrored = "v -1 0 0\nf 1 5 3\nf 1 4 5\nf 5 4 3\nf 1 3 4\n";
    place.write("it.obj", tetrahedron(0, 1) + mirrored);
    place.refuses(&["check", "scene.toml"], 3, &["3 edges have four triangles or more", "[0.0, 0.0, 1.0]"]);
    let ground = SCENE.to_owned() + &BODY.replace("FILE", "it.obj").replace(", decompose = true", "");
    place.write("ground.toml", ground);
    place.moreau(&["check", "ground.toml"]).fine();
}
