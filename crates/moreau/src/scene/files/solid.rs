//! Files of meshes and heights as the shapes of single bodies.

use super::{taken, unread};
use crate::mesh::{Heights, Mesh, MeshError, MeshFile, bytes_of};
use crate::scene::check;
use crate::scene::error::Fault;
use crate::scene::path::KeyPath;
use crate::scene::{Numbers, ShapeSpec};
use std::path::Path;

/// Reads the file of a polyhedron, a mesh or a height field, whose keys are at `path`, and puts what it holds in its place.
pub(super) fn shape(spec: &mut ShapeSpec, folder: &Path, path: &KeyPath, remarks: &mut Vec<String>) -> Result<(), Fault> {
    match spec {
        ShapeSpec::Polyhedron { points, file, scale, flat } => {
            let Some(name) = taken(file, points.is_empty(), "points", path)? else { return Ok(()) };
            flat.get_or_insert(ShapeSpec::FLAT_IN_FILES);
            let found = read(&name, scale.take(), folder, path)?;
            remark(&found, &name, path, true, remarks);
            *points = corners(&found.mesh);
        }
        ShapeSpec::Mesh { points, triangles, file, scale, decompose, .. } => {
            let is_empty = points.is_empty() && triangles.is_empty();
            let Some(name) = taken(file, is_empty, "points and triangles", path)? else { return Ok(()) };
            let found = read(&name, scale.take(), folder, path)?;
            remark(&found, &name, path, *decompose, remarks);
            let mesh = found.mesh;
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

/// Adds what the reader of a file remarked. Where the file makes one body, objects that lie apart are likely meant to be several.
fn remark(found: &MeshFile, name: &str, path: &KeyPath, is_body: bool, remarks: &mut Vec<String>) {
    let mut add = |remark: &str| remarks.push(format!("{path}.file: {remark}"));
    found.remarks.iter().for_each(|remark| add(remark));
    if is_body && found.has_separate_objects() {
        let count = found.objects.len();
        add(&format!(
            "{name} has {count} objects that share no points, and they are one body here; to make a body of each, use [[import]] with meshes"
        ));
    }
}

/// Reads all that a file has, enlarged by `scale`.
pub(super) fn read(name: &str, scale: Option<f64>, folder: &Path, path: &KeyPath) -> Result<MeshFile, Fault> {
    let scale = factor(scale, path)?;
    let path = path.then("file");
    let place = folder.join(name);
    unread::is_file(&place, &path)?;
    let found = MeshFile::load(&place).map_err(|error| wrong(&path, &error))?;
    if found.mesh.triangles.is_empty() {
        return Err(Fault::new(path, format!("{name} has no triangles"), "expected a mesh"));
    }
    Ok(MeshFile { mesh: found.mesh.scaled(scale), ..found })
}

pub(super) fn factor(scale: Option<f64>, path: &KeyPath) -> Result<f64, Fault> {
    let scale = scale.unwrap_or(1.0);
    check::positive(path.then("scale"), scale, "such as 0.001 for a file in mm").map(|()| scale)
}

pub(super) fn bytes(name: &str, folder: &Path, path: &KeyPath) -> Result<Vec<u8>, Fault> {
    let place = folder.join(name);
    unread::is_file(&place, path)?;
    bytes_of(&place).map_err(|error| wrong(path, &error))
}

pub(super) fn wrong(path: &KeyPath, error: &MeshError) -> Fault {
    Fault::new(path.clone(), error.to_string(), "")
}

/// The points that triangles have, each once.
fn corners(mesh: &Mesh) -> Vec<Numbers<3>> {
    let mut used = vec![false; mesh.points.len()];
    mesh.triangles.iter().flatten().for_each(|&point| used[point as usize] = true);
    mesh.points.iter().zip(used).filter(|(_, used)| *used).map(|(&point, _)| Numbers(point)).collect()
}
