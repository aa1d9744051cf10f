use super::*;

/// A unit cube at a height, its faces in COMPAS's order.
fn cube(z: f64, wrap: &str) -> String {
    let vertex: Vec<String> = [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let z = f64::from(p[2]) + z;
            // x is left out where it is the default.
            if p[0] == 0 {
                format!(r#""{i}": {{"y": {}, "z": {z}}}"#, p[1])
            } else {
                format!(r#""{i}": {{"x": 1.0, "y": {}, "z": {z}}}"#, p[1])
            }
        })
        .collect();
    let data = format!(
        r#"{{"attributes": {{"name": "cube"}}, "default_vertex_attributes": {{"x": 0.0, "y": 0.0, "z": 0.0}},
        "vertex": {{{}}}, "face": {{"0": [0, 1, 2, 3], "1": [0, 3, 5, 4], "2": [3, 2, 6, 5], "3": ["2", "1", "7", "6"],
        "4": [1, 0, 4, 7], "10": [4, 5, 6, 7]}}}}"#,
        vertex.join(", ")
    );
    wrap.replace("DATA", &data)
}

fn assembly(text: &str) -> Assembly {
    Assembly::from_json(text.as_bytes(), "test.json").unwrap_or_else(|error| panic!("{error}"))
}

fn check(assembly: &Assembly, shift: f64) {
    assert_eq!(assembly.blocks.len(), 2);
    for (i, block) in assembly.blocks.iter().enumerate() {
        let mass = *block.mesh.triangulated().closed().unwrap_or_else(|error| panic!("{error}")).mass();
        let right = [0.5 + shift, 0.5, 0.5 + i as f64];
        assert!((mass.volume - 1.0).abs() < 1e-14 && (0..3).all(|k| (mass.centre[k] - right[k]).abs() < 1e-14), "{mass:?}");
        assert_eq!(block.support, i == 0);
    }
    assert_eq!(assembly.interfaces.len(), 1);
    assert_eq!(assembly.interfaces[0].blocks, [0, 1]);
    assert_eq!(assembly.interfaces[0].points, [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]]);
}

const POINTS: &str = "[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0]]";

#[test]
fn an_assembly_of_compas_2_is_read() {
    let wrap = r#"{"dtype": "compas_assembly.datastructures/Block", "data": DATA, "guid": "1"}"#;
    let text = format!(
        r#"{{"dtype": "compas_assembly.datastructures/Assembly", "data": {{"attributes": {{"name": "Assembly"}}, "graph":
        {{"dtype": "compas.datastructures/Graph", "data": {{"default_node_attributes": {{"is_support": false}},
        "node": {{"10": {{"block": {}}}, "2": {{"block": {}, "is_support": true}}}},
        "edge": {{"2": {{"10": {{"interfaces": [{{"dtype": "compas_assembly.datastructures/Interface", "data": {{"points": {POINTS}}}}}]}}}}}}}}}}}}}}"#,
        cube(1.0, wrap),
        cube(0.0, wrap)
    );
    let assembly = assembly(&text);
    check(&assembly, 0.0);
    assert_eq!((assembly.blocks[0].key.as_str(), assembly.blocks[0].name.as_deref()), ("2", Some("cube")));
}

#[test]
fn an_assembly_of_compas_1_is_read() {
    let wrap =
        r#"{"dtype": "compas_assembly.datastructures/Block", "value": {"data": DATA, "datatype": "Block", "compas": "1.6.3"}}"#;
    let text = format!(
        r#"{{"dtype": "compas_assembly.datastructures/Assembly", "value": {{"data": {{"node": {{"0": {{"x": 0.5, "is_support": 1, "block": {}}},
        "1": {{"block": {}}}}}, "edge": {{"0": {{"1": {{"interface": {{"dtype": "Interface", "value": {{"data": {{"points": {POINTS}}},
        "datatype": "Interface"}}}}}}}}, "1": {{}}}}, "node_attributes": {{"block": null}}}}, "datatype": "Assembly", "compas": "1.6.3"}}}}"#,
        cube(0.0, wrap),
        cube(1.0, wrap)
    );
    check(&assembly(&text), 0.0);
}

#[test]
fn the_first_format_is_read() {
    let text = format!(
        r#"{{"assembly": {{"vertex": {{"0": {{"is_support": true}}, "1": {{"is_support": false}}}},
        "edge": {{"0": {{"1": {{"interface_points": {POINTS}, "interface_type": "face_face"}}}}}}}},
        "blocks": {{"0": {}, "1": {}}}}}"#,
        cube(0.0, "DATA"),
        // Of the oldest files a face is a way from key to key.
        cube(1.0, "DATA").replace("[0, 1, 2, 3]", r#"{"0": 1, "1": 2, "2": 3, "3": 0}"#)
    );
    check(&assembly(&text), 0.0);
}

#[test]
fn a_block_model_is_read_with_its_transformations() {
    let mesh = r#"{"dtype": "compas.datastructures/Mesh", "data": DATA, "name": "Box"}"#;
    let moved = r#"{"dtype": "compas.geometry/Transformation", "data": {"matrix": [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}}"#;
    let element = |z: f64, support: bool| {
        let geometry = cube(z, mesh);
        format!(
            r#"{{"dtype": "compas_dem.elements/Block", "data": {{"transformation": {moved}, "name": "Block", "geometry": {geometry}, "is_support": {support}}}}}"#
        )
    };
    let point = |x: f64, y: f64| format!(r#"{{"dtype": "compas.geometry/Point", "data": [{x:?}, {y:?}, 1.0]}}"#);
    let contact = format!(
        r#"{{"dtype": "compas_dem.interactions/FrictionContact", "data": {{"points": [{}, {}, {}], "size": 1.0}}}}"#,
        point(0.0, 0.0),
        point(1.0, 0.0),
        point(1.0, 1.0)
    );
    let text = format!(
        r#"{{"dtype": "compas_dem.models/BlockModel", "data": {{"transformation": null, "elements": {{"b": {}, "a": {}}},
        "graph": {{"node": {{"0": {{"element": "b"}}, "1": {{"element": "a"}}}}, "edge": {{"0": {{"1": {{"contacts": [{contact}]}}}}}}}}}}}}"#,
        element(0.0, true),
        element(1.0, false)
    );
    check(&assembly(&text), 2.0);
}

#[test]
fn a_list_of_meshes_is_read() {
    let wrap = r#"{"dtype": "compas.datastructures/Mesh", "data": DATA}"#;
    let polyhedron =
        r#"{"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]}"#;
    let read = assembly(&format!("[{}, {polyhedron}]", cube(0.0, wrap)));
    assert!(read.blocks.len() == 2 && read.interfaces.is_empty() && read.blocks.iter().all(|block| !block.support));
    let volume = read.blocks[1].mesh.triangulated().closed().unwrap().mass().volume;
    assert!((volume - 1.0 / 6.0).abs() < 1e-15);
}

#[test]
fn what_is_no_assembly_is_said_with_the_way_to_it() {
    let error = |text: &str| Assembly::from_json(text.as_bytes(), "test.json").unwrap_err().to_string();
    for (text, words) in [
        ("{", "test.json:1: not valid JSON"),
        ("{}", "no assembly; expected `graph`"),
        (r#"{"node": {"3": {"block": null}}}"#, "node.3: no `block`"),
        (r#"{"node": {"0": {"block": {"vertex": {"0": {"x": 1}}, "face": {}}}}}"#, "node.0.block.vertex.0: no y"),
        (r#"{"elements": {"a": {"geometry": {"vertex": {}, "face": {"7": [1, 2, 3]}}}}}"#, "face.7.0: no vertex `1`"),
        (r#"[{"vertices": [[0, 0]], "faces": []}]"#, "0.vertices.0: 2 numbers; expected 3"),
        (r#"[{"vertices": [[0, 0, "a"]], "faces": []}]"#, "0.vertices.0.2: not a number"),
        (r#"[{"vertices": [], "faces": [[0, 0]]}]"#, "0.faces.0: a face with 2 corners"),
    ] {
        let message = error(text);
        assert!(message.contains(words), "{text}: {message}");
    }
}

fn volume_and_centre(block: &Block) -> (f64, [f64; 3]) {
    let mass = *block.mesh.triangulated().closed().unwrap_or_else(|error| panic!("{error}")).mass();
    (mass.volume, mass.centre)
}

fn rounded(x: f64) -> f64 {
    (1e9 * x).round() / 1e9
}

fn shift(x: f64) -> String {
    format!(
        r#"{{"dtype": "compas.geometry/Transformation", "data": {{"matrix": [[1, 0, 0, {x:?}], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}}}}"#
    )
}

/// Elements in a list are known by their guid; a group moves what is in it, and the model all.
#[test]
fn elements_may_be_a_list_or_stand_in_groups() {
    let mesh = r#"{"dtype": "compas.datastructures/Mesh", "data": DATA}"#;
    let element = |z: f64, guid: &str, more: &str| {
        let geometry = cube(z, mesh);
        format!(
            r#"{{"dtype": "compas_dem.elements/Block", "data": {{"transformation": null, "geometry": {geometry}{more}}}, "guid": "{guid}"}}"#
        )
    };
    let (one, two) = (element(0.0, "p", r#", "is_support": true"#), element(1.0, "q", r#", "material": "m""#));
    let model = |elements: &str, graph: &str| {
        format!(
            r#"{{"dtype": "compas_dem.models/BlockModel", "data": {{"transformation": null, "elements": [{elements}],
            "materials": {{"m": {{"dtype": "compas_model.materials/Stone", "data": {{"density": 2700.0}}}}}}{graph}}}}}"#
        )
    };
    let read = assembly(&model(&format!("{one}, {two}"), ""));
    let keys: Vec<_> = read.blocks.iter().map(|block| (block.key.as_str(), block.support, block.density)).collect();
    assert_eq!(keys, [("0", true, None), ("1", false, Some(2700.0))]);
    let graph =
        r#", "graph": {"node": {"7": {"element": "q"}, "3": {"element": "p"}}, "edge": {"3": {"7": {"modifiers": [{}]}}}}"#;
    let read = assembly(&model(&format!("{one}, {two}"), graph));
    let keys: Vec<_> = read.blocks.iter().map(|block| (block.key.as_str(), rounded(volume_and_centre(block).1[2]))).collect();
    assert_eq!(keys, [("3", 0.5), ("7", 1.5)]);
    assert!(read.remarks[0].contains("modifiers"), "{:?}", read.remarks);

    let group = format!(r#""g": {{"dtype": "compas_model.elements/Group", "data": {{"transformation": {}}}}}"#, shift(10.0));
    let text = format!(
        r#"{{"transformation": {}, "elements": {{{group}, "p": {one}, "q": {two}}}, "graph": {{"node": {{"0": {{"element": "g"}},
        "1": {{"element": "p"}}, "2": {{"element": "q"}}}}, "edge": {{"0": {{"1": {{}}}}}}}},
        "tree": {{"root": {{"children": [{{"name": "g", "element": "g", "children": [{{"element": "p"}}]}}, {{"element": "q"}}]}}}}}}"#,
        shift(100.0)
    );
    let read = assembly(&text);
    let places: Vec<_> = read.blocks.iter().map(|block| (block.key.as_str(), rounded(volume_and_centre(block).1[0]))).collect();
    assert_eq!(places, [("1", 110.5), ("2", 100.5)]);
}

#[test]
fn lists_hold_meshes_elements_and_lists() {
    let mesh = cube(0.0, "DATA");
    for (text, count) in [
        (format!("[[{mesh}, {mesh}], {mesh}]"), 3),
        (format!(r#"[{{"geometry": {mesh}}}, {mesh}]"#), 2),
        (format!(r#"{{"meshes": [{mesh}, {mesh}]}}"#), 2),
        (format!(r#"{{"blocks": {{"a": {mesh}, "b": {{"geometry": {mesh}, "is_support": true}}}}}}"#), 2),
    ] {
        let read = assembly(&text);
        assert_eq!(read.blocks.len(), count, "{text}");
        assert!(read.blocks.iter().all(|block| (volume_and_centre(block).0 - 1.0).abs() < 1e-14));
    }
}

#[test]
fn densities_and_flags_of_blocks_are_read() {
    let wrap = r#"{"attributes": {"density": 2000, "is_fixed": true, "is_top": 0}, "REST"#;
    let mesh = cube(0.0, "DATA").replacen(r#"{"attributes": {"name": "cube"}, ""#, &wrap.replace("REST", ""), 1);
    let text = format!(r#"{{"node": {{"0": {{"block": {mesh}, "density": 1800.5}}, "1": {{"block": {mesh}, "chosen": 1}}}}}}"#);
    let read = assembly(&text);
    assert_eq!(read.blocks.iter().map(|block| block.density).collect::<Vec<_>>(), [Some(1800.5), Some(2000.0)]);
    assert!(!read.blocks[0].flags.contains(&"chosen".into()) && read.blocks[1].flags.contains(&"chosen".into()));
    assert!(read.blocks.iter().all(|block| block.flags.contains(&"is_fixed".into()) && !block.flags.contains(&"is_top".into())));
    let error = Assembly::from_json(text.replace("1800.5", "-1").as_bytes(), "x.json").unwrap_err().to_string();
    assert!(error.contains("node.0.density: a density of -1"), "{error}");
}
