//! Files of meshes, heights and assemblies.

use super::{body, taken, unread};
use crate::mesh::compas::{Assembly, Block};
use crate::mesh::{Heights, Mesh, MeshError, PolygonMesh, bytes_of};
use crate::scene::check;
use crate::scene::error::Fault;
use crate::scene::path::KeyPath;
use crate::scene::spec::{Import, MotionKind};
use crate::scene::{Numbers, Scene, ShapeSpec};
use crate::shape::solid::Polyhedron;
use std::path::Path;

/// By which part of its volume a block may fall short of its hull and count as convex: files are written with few digits.
const CONVEX: f64 = 1e-4;

/// Reads the file of a polyhedron, a mesh or a height field, whose keys are at `path`, and puts what it holds in its place.
pub(super) fn shape(spec: &mut ShapeSpec, folder: &Path, path: &KeyPath) -> Result<(), Fault> {
    match spec {
        ShapeSpec::Polyhedron { points, file, scale, flat } => {
            let Some(name) = taken(file, points.is_empty(), "points", path)? else { return Ok(()) };
            flat.get_or_insert(ShapeSpec::FLAT_IN_FILES);
            *points = corners(&read(&name, scale.take(), folder, path)?);
        }
        ShapeSpec::Mesh { points, triangles, file, scale, .. } => {
            let is_empty = points.is_empty() && triangles.is_empty();
            let Some(name) = taken(file, is_empty, "points and triangles", path)? else { return Ok(()) };
            let mesh = read(&name, scale.take(), folder, path)?;
            *points = mesh.points.into_iter().map(Numbers).collect();
            *triangles = mesh.triangles;
        }
        ShapeSpec::HeightField { heights, file, .. } => {
            let Some(name) = taken(file, heights.is_empty(), "heights", path)? else { return Ok(()) };
            let path = path.then("file");
            *heights = bytes(&name, folder, &path)
                .and_then(|bytes| Heights::rows_of(&String::from_utf8_lossy(&bytes), &name).map_err(|e| wrong(&path, &e)))?;
        }
        _ => {}
    }
    Ok(())
}

fn read(name: &str, scale: Option<f64>, folder: &Path, path: &KeyPath) -> Result<Mesh, Fault> {
    let scale = factor(scale, path)?;
    let path = path.then("file");
    let place = folder.join(name);
    unread::is_file(&place, &path)?;
    let mesh = Mesh::load(&place).map_err(|error| wrong(&path, &error))?;
    if mesh.triangles.is_empty() {
        return Err(Fault::new(path, format!("{name} has no triangles"), "expected a mesh"));
    }
    Ok(mesh.scaled(scale))
}

fn factor(scale: Option<f64>, path: &KeyPath) -> Result<f64, Fault> {
    let scale = scale.unwrap_or(1.0);
    check::positive(path.then("scale"), scale, "such as 0.001 for a file in mm").map(|()| scale)
}

fn bytes(name: &str, folder: &Path, path: &KeyPath) -> Result<Vec<u8>, Fault> {
    let place = folder.join(name);
    unread::is_file(&place, path)?;
    bytes_of(&place).map_err(|error| wrong(path, &error))
}

fn wrong(path: &KeyPath, error: &MeshError) -> Fault {
    Fault::new(path.clone(), error.to_string(), "")
}

/// The points that triangles have, each once.
fn corners(mesh: &Mesh) -> Vec<Numbers<3>> {
    let mut used = vec![false; mesh.points.len()];
    mesh.triangles.iter().flatten().for_each(|&point| used[point as usize] = true);
    mesh.points.iter().zip(used).filter(|(_, used)| *used).map(|(&point, _)| Numbers(point)).collect()
}

/// The blocks of an assembly as bodies.
pub(super) fn assembly(scene: &mut Scene, import: Import, number: usize, folder: &Path, path: &KeyPath) -> Result<(), Fault> {
    let Import::Assembly { file, material, scale, decompose, motion } = import else { return Ok(()) };
    let scale = factor(scale, path)?;
    let place = path.then("file");
    let found = bytes(&file, folder, &place)
        .and_then(|bytes| Assembly::from_json(&bytes, &file).map_err(|error| wrong(&place, &error)))?;
    if found.blocks.is_empty() {
        return Err(Fault::new(place, format!("{file} has no blocks"), "expected an assembly"));
    }
    // Here, because the body that a later check would name is not in the text.
    check::material(scene, path.then("material"), &material)?;
    for block in found.blocks {
        let shape = block_of(&block, scale, decompose)
            .map_err(|(message, hint)| Fault::new(place.clone(), format!("{file}: block {:?}: {message}", block.key), hint))?;
        // Its key, because names of blocks are often all the same.
        let name = format!("import[{number}] {}", block.key);
        let motion = if block.support { Some(MotionKind::Fixed) } else { motion };
        scene.bodies.push(body(name, shape, &material, vec![0.0; 3], motion));
    }
    Ok(())
}

/// A block's shape, or what is wrong and what would be right.
fn block_of(Block { mesh, .. }: &Block, scale: f64, decompose: bool) -> Result<ShapeSpec, (String, &'static str)> {
    let PolygonMesh { points, .. } = mesh;
    let mesh = mesh.triangulated().scaled(scale);
    let closed = mesh.closed().map_err(|error| (error.to_string(), "expected the closed surface of a block"))?;
    let points: Vec<[f64; 3]> = points.iter().map(|point| point.map(|x| scale * x)).collect();
    let hull = Polyhedron::hull_within(&points, ShapeSpec::FLAT_IN_FILES).ok();
    let bridged = hull.is_none_or(|(hull, _)| hull.volume() > (1.0 + CONVEX) * closed.mass().volume);
    if !bridged {
        let points = points.into_iter().map(Numbers).collect();
        return Ok(ShapeSpec::Polyhedron { points, file: None, scale: None, flat: Some(ShapeSpec::FLAT_IN_FILES) });
    }
    if !decompose {
        return Err(("the block is not convex".into(), "add decompose = true to cut such blocks into convex pieces"));
    }
    let mesh = closed.mesh();
    Ok(ShapeSpec::Mesh {
        points: mesh.points.iter().copied().map(Numbers).collect(),
        triangles: mesh.triangles.clone(),
        file: None,
        scale: None,
        decompose: true,
        concavity: None,
    })
}
