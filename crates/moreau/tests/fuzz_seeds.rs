//! What the fuzz targets begin with, and what they have found, goes through the same readers here.

use moreau::checkpoint::Checkpoint;
use moreau::mesh::compas::Assembly;
use moreau::mesh::{Mesh, MeshFile};
use moreau::observe::Summary;
use moreau::scene::{AnyWorld, Scene};
use moreau::shape::solid::Surface;
use moreau::step::{Workspace, step};
use moreau::trajectory::Trajectory;
use std::path::{Path, PathBuf};

fn seeds(target: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds").join(target);
    let mut files: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty(), "{}", folder.display());
    files
}

fn bytes(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn look_at(mesh: Result<Mesh, impl std::fmt::Display>) {
    let Ok(mesh) = mesh else { return };
    let _ = Surface::new(mesh.clone());
    if let Ok(closed) = mesh.closed() {
        assert!(closed.mass().volume > 0.0);
    }
}

#[test]
fn meshes() {
    seeds("mesh_stl").iter().for_each(|path| look_at(Mesh::from_stl(&bytes(path), "seed.stl")));
    seeds("mesh_obj").iter().for_each(|path| look_at(Mesh::from_obj(&bytes(path), "seed.obj")));
    seeds("mesh_ply").iter().for_each(|path| look_at(MeshFile::from_ply(&bytes(path), "seed.ply").map(|file| file.mesh)));
    seeds("mesh_gltf").iter().for_each(|path| look_at(MeshFile::from_gltf(&bytes(path), "seed.glb").map(|file| file.mesh)));
    for path in seeds("mesh_compas") {
        let Ok(assembly) = Assembly::from_json(&bytes(&path), "seed.json") else { continue };
        assembly.blocks.into_iter().for_each(|block| look_at(Ok::<_, String>(block.mesh.triangulated())));
    }
}

#[test]
fn scenes() {
    for path in seeds("scene") {
        let Ok(scene) = Scene::parse(&String::from_utf8_lossy(&bytes(&path)), "nowhere/seed.toml") else { continue };
        assert!(Scene::parse(&scene.to_toml(), "nowhere/seed.toml").unwrap() == scene, "{}", path.display());
    }
}

/// The first two seeds of checkpoints, of the layout that is current: after 20 and after 60 steps of a scene.
fn write_checkpoints(text: &str) {
    for (name, steps) in [("1.bin", 20), ("2.bin", 60)] {
        let AnyWorld::Solid(mut world) = Scene::parse(text, "checkpoint.toml").unwrap().build(u64::MAX).unwrap() else {
            panic!()
        };
        let mut work = Workspace::default();
        (0..steps).for_each(|_| assert!(step(&mut world, &mut work).is_ok()));
        let checkpoint = Checkpoint::take(text, (Summary::default(), Vec::new()), &world, &work);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds/checkpoint").join(name);
        std::fs::write(path, postcard::to_stdvec(&checkpoint).unwrap()).unwrap();
    }
}

/// With MOREAU_BLESS=1 the seeds are written again, after the layout of checkpoints has changed.
#[test]
fn checkpoints() {
    let text = include_str!("../../../fuzz/seeds/scene/events.toml");
    if std::env::var_os("MOREAU_BLESS").is_some() {
        write_checkpoints(text);
    }
    let mut taken = 0;
    for path in seeds("checkpoint") {
        let Ok(checkpoint) = postcard::from_bytes::<Checkpoint>(&bytes(&path)) else { continue };
        let scene = Scene::parse(text, "checkpoint.toml").unwrap();
        let AnyWorld::Solid(mut world) = scene.build(u64::MAX).unwrap() else { panic!("the scene is in space") };
        let mut work = Workspace::default();
        if checkpoint.restore(&mut world, &mut work).is_ok() {
            let _ = step(&mut world, &mut work);
            taken += 1;
        }
    }
    assert!(taken >= 2, "the first two are whole: {taken}");
}

#[test]
fn trajectories() {
    let mut whole = 0;
    for path in seeds("trajectory") {
        let Ok(trajectory) = Trajectory::open(&path) else { continue };
        whole += usize::from((0..trajectory.frames()).all(|i| trajectory.frame(i).is_ok()) && trajectory.columns().is_ok());
    }
    assert!(whole >= 1);
}
