//! Files with flipped bits and cut ends. Those of a run are refused with a message, or read as they were written: never a panic, never other
//! numbers. Meshes are refused, or read as sound ones.

use moreau::checkpoint::{self, Checkpoints};
use moreau::mesh::compas::Assembly;
use moreau::mesh::{Closed, Mesh, MeshError, MeshFile};
use moreau::observe::{Observer, TrajectoryOutput};
use moreau::run::{Task, run};
use moreau::scene::{AnyWorld, Scene};
use moreau::space::Solid;
use moreau::step::Workspace;
use moreau::trajectory::{Precision, Trajectory};
use rand::{Rng, SeedableRng};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

const SCENE: &str = r#"
title = "twenty balls"
dimension = 3
gravity = [0.0, 0.0, -9.81]
time = { step = 1e-3, steps = 60 }
solver.start = "warm"
materials.glass.density = 2500.0
default_law.coulomb = { friction = 0.3 }
containers = [{ min = [0.0, 0.0, 0.0], max = [0.1, 0.1, 0.4], open = ["+z"], material = "glass" }]
generate = [{ material = "glass", count = 20, radii.constant = 0.01, lattice = { min = [0.0, 0.0, 0.0], max = [0.1, 0.1, 0.2] } }]
"#;

/// Runs the scene with a trajectory and checkpoints each ten steps; gives the paths of the trajectory and of the last checkpoint.
fn made(folder: &Path) -> [PathBuf; 2] {
    let scene = Scene::parse(SCENE, "twenty.toml").unwrap();
    let AnyWorld::Solid(mut world) = scene.build(u64::MAX).unwrap() else { panic!("the scene is in space") };
    let path = folder.join("trajectory.h5");
    let output = TrajectoryOutput::create(&path, &world, ("twenty balls", 2, Precision::Single)).unwrap();
    let mut observers: Vec<Box<dyn Observer<Solid, 3, 6>>> = vec![Box::new(output)];
    let task = Task { kept: Some((SCENE, Checkpoints::new(folder, 10, 0.0))), ..Task::new(60) };
    run(&mut world, &mut Workspace::default(), task, &mut observers, &AtomicBool::new(false), |_| {}).unwrap();
    [path, folder.join("checkpoint-000000000060.bin")]
}

/// The bytes 200 times with a bit flipped and 200 times cut off, each with the place, and whether it is cut there.
fn damages(whole: &[u8]) -> impl Iterator<Item = (Vec<u8>, usize, bool)> {
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(7);
    (0..400).map(move |case| {
        let (mut bytes, cut) = (whole.to_vec(), case % 2 == 1);
        let at = (random.next_u64() % bytes.len() as u64) as usize;
        if cut {
            bytes.truncate(at);
        } else {
            bytes[at] ^= 1 << (random.next_u64() % 8);
        }
        (bytes, at, cut)
    })
}

/// Reads a file damaged in 400 ways; `read` gives what is in it, or a message. Says how many were refused.
fn damaged<T: PartialEq>(path: &Path, read: impl Fn(&Path) -> Result<T, String>) -> usize {
    let whole = std::fs::read(path).unwrap();
    let right = read(path).unwrap();
    let mut refused = 0;
    for (bytes, at, cut) in damages(&whole) {
        std::fs::write(path, &bytes).unwrap();
        match read(path) {
            Ok(content) => assert!(content == right, "byte {at} of {}, cut {cut}: read as something else", whole.len()),
            Err(message) => {
                assert!(!message.is_empty());
                refused += 1;
            }
        }
    }
    std::fs::write(path, whole).unwrap();
    refused
}

#[test]
fn a_damaged_checkpoint_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [_, path] = made(folder.path());
    let refused = damaged(&path, |path| checkpoint::read(path).map_err(|error| error.to_string()));
    assert_eq!(refused, 400, "a checksum leaves no doubt");
}

#[test]
fn a_damaged_trajectory_is_refused_or_read_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let [path, _] = made(folder.path());
    let all = |path: &Path| -> Result<_, String> {
        let trajectory = Trajectory::open(path).map_err(|error| error.to_string())?;
        let frames: Result<Vec<_>, _> = (0..trajectory.frames()).map(|i| trajectory.frame(i)).collect();
        let columns = trajectory.columns().map_err(|error| error.to_string())?;
        Ok((trajectory.header().clone(), frames.map_err(|error| error.to_string())?, columns))
    };
    let refused = damaged(&path, all);
    assert!(refused > 200, "{refused}");
}

/// Triangles of a tetrahedron of odd corners, seen from outside.
const TETRAHEDRON: [[[f32; 3]; 3]; 4] = {
    let [o, x, y, z] = [[0.125, 0.25, -0.5], [1.75, 0.125, 0.0625], [0.375, 2.25, 0.125], [0.25, 0.5, 1.625]];
    [[o, y, x], [o, x, z], [x, y, z], [o, z, y]]
};

fn stl_binary() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend(4_u32.to_le_bytes());
    for triangle in TETRAHEDRON {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn stl_text() -> Vec<u8> {
    let facet = |t: [[f32; 3]; 3]| {
        let corners: String = t.iter().map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).collect();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    format!("solid t\n{}endsolid t\n", TETRAHEDRON.map(facet).concat()).into_bytes()
}

fn obj() -> Vec<u8> {
    let corners = [0, 1, 2].map(|k| TETRAHEDRON[2][k]).into_iter().chain([TETRAHEDRON[0][0]]);
    let points: String = corners.map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    format!("{points}f 4 2 1\nf 4 1 3\nf 1 2 3\nf 4 3 2\n").into_bytes()
}

fn compas() -> Vec<u8> {
    let block = r#"{"vertex": {"0": {"x": 0.5, "y": 0, "z": 0}, "1": {"x": 1.5, "y": 0, "z": 0}, "2": {"x": 0, "y": 1, "z": 0},
        "3": {"x": 0, "y": 0, "z": 1}}, "face": {"0": [0, 2, 1], "1": [0, 1, 3], "2": [1, 2, 3], "3": [0, 3, 2]}}"#;
    format!(r#"{{"assembly": {{"vertex": {{"0": {{"is_support": true}}}}, "edge": {{"0": {{}}}}}}, "blocks": {{"0": {block}}}}}"#)
        .into_bytes()
}

/// PLY, binary with big numbers first.
fn ply() -> Vec<u8> {
    let head = "ply\nformat binary_big_endian 1.0\nelement vertex 12\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n\
                property list uchar int vertex_indices\nend_header\n";
    let mut bytes = head.as_bytes().to_vec();
    bytes.extend(TETRAHEDRON.iter().flatten().flatten().flat_map(|x| x.to_be_bytes()));
    for i in 0..4_i32 {
        bytes.push(3);
        (0..3).for_each(|k| bytes.extend((3 * i + k).to_be_bytes()));
    }
    bytes
}

fn glb() -> Vec<u8> {
    let binary: Vec<u8> = TETRAHEDRON.iter().flatten().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let mut json =
        r#"{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 12}],
        "bufferViews": [{"buffer": 0, "byteLength": 144}], "buffers": [{"byteLength": 144}]}"#
            .as_bytes()
            .to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let number = |n: usize| (n as u32).to_le_bytes();
    let length = 28 + json.len() + binary.len();
    [b"glTF", &number(2)[..], &number(length), &number(json.len()), b"JSON", &json, &number(binary.len()), b"BIN\0", &binary]
        .concat()
}

/// Who reads the bytes of one kind of mesh.
type Reader<'a> = &'a dyn Fn(&[u8]) -> Result<Vec<Closed>, MeshError>;

/// Meshes have no checksum: a flipped digit is another number. But what is read is a body with a volume, and a cut end is found.
#[test]
fn a_damaged_mesh_is_refused_or_closed_and_cuts_are_found() {
    let closed = |mesh: Result<Mesh, MeshError>| mesh.and_then(Mesh::closed).map(|closed| vec![closed]);
    let of_blocks = |assembly: Assembly| assembly.blocks.iter().map(|block| block.mesh.triangulated().closed()).collect();
    let stl = |bytes: &[u8]| closed(Mesh::from_stl(bytes, "damaged.stl"));
    let file = |file: Result<MeshFile, MeshError>| closed(file.map(|file| file.mesh));
    let kinds: [(Vec<u8>, Reader<'_>); 6] = [
        (stl_binary(), &stl),
        (stl_text(), &stl),
        (obj(), &|bytes| closed(Mesh::from_obj(bytes, "damaged.obj"))),
        (ply(), &|bytes| file(MeshFile::from_ply(bytes, "damaged.ply"))),
        (glb(), &|bytes| file(MeshFile::from_gltf(bytes, "damaged.glb"))),
        (compas(), &|bytes| Assembly::from_json(bytes, "damaged.json").and_then(of_blocks)),
    ];
    for (kind, (whole, read)) in kinds.into_iter().enumerate() {
        let right = read(&whole).unwrap();
        let mut refused = 0;
        for (bytes, at, cut) in damages(&whole) {
            match read(&bytes) {
                Ok(bodies) => {
                    assert!(!cut || bodies == right, "kind {kind}: cut at byte {at}, and read as something else");
                    assert!(bodies.iter().all(|body| body.mass().volume > 0.0), "kind {kind}, byte {at}");
                }
                Err(error) => {
                    assert!(!error.to_string().is_empty());
                    refused += 1;
                }
            }
        }
        assert!(refused > 250, "kind {kind}: {refused}");
    }
}
