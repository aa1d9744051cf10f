//! Files that a scene names: they are read with it, and what they hold takes their place.

mod assembly;
mod meshes;
mod solid;
mod unread;

use super::check::{Refusal, polygon_error, polyline_error};
use super::error::Fault;
use super::path::{KeyPath, key_path};
use super::points::{Outline, outlines};
use super::shape::{PartSpec, ShapeSpec};
use super::spec::{BodySpec, Import, MotionKind};
use super::{Numbers, Scene};
use std::path::Path;

/// Reads the files of a scene; their paths are relative to `folder`.
pub(super) fn read(scene: &mut Scene, folder: &Path) -> Result<(), Fault> {
    for (i, body) in scene.bodies.iter_mut().enumerate() {
        shape(&mut body.shape, folder, &key_path!["bodies", i, "shape"], &mut scene.remarks.0)?;
    }
    for (i, import) in std::mem::take(&mut scene.import).into_iter().enumerate() {
        let path = key_path!["import", i];
        let (name, dimension) = match import {
            Import::Polygons { .. } => ("polygons", 2),
            Import::Assembly { .. } => ("assembly", 3),
            Import::Meshes { .. } => ("meshes", 3),
        };
        let path = path.then(name);
        if scene.dimension.number() != dimension {
            let message = format!("{name} where dimension = {}", scene.dimension.number());
            return Err(Fault::new(path, message, format!("expected dimension = {dimension}")));
        }
        match import {
            Import::Polygons { .. } => polygons(scene, import, i, folder, &path)?,
            Import::Assembly { .. } => assembly::read(scene, import, i, folder, &path)?,
            Import::Meshes { .. } => meshes::read(scene, import, i, folder, &path)?,
        }
    }
    Ok(())
}

fn shape(spec: &mut ShapeSpec, folder: &Path, path: &KeyPath, remarks: &mut Vec<String>) -> Result<(), Fault> {
    let path = path.then(spec.name());
    match spec {
        ShapeSpec::Polygon { vertices, file, decompose } => {
            let concave = *decompose;
            one(vertices, file, folder, (&path, "vertices"), |outline| polygon_error(outline.points.clone(), concave))
        }
        ShapeSpec::Polyline { points, file, closed } => {
            let closed = *closed;
            one(points, file, folder, (&path, "points"), |outline| polyline_error(&outline.points, closed))
        }
        ShapeSpec::Compound { parts } => {
            let mut parts = parts.iter_mut().enumerate();
            parts.try_for_each(|(i, PartSpec { shape: spec, .. })| {
                shape(spec, folder, &path.then("parts").then(i).then("shape"), remarks)
            })
        }
        _ => solid::shape(spec, folder, &path, remarks),
    }
}

/// What an outline does not keep to.
type Check<'a> = &'a dyn Fn(&Outline) -> Option<Refusal>;

/// Puts the one outline of a file in its place.
fn one(
    points: &mut Vec<Numbers<2>>,
    file: &mut Option<String>,
    folder: &Path,
    (path, key): (&KeyPath, &str),
    check: impl Fn(&Outline) -> Option<Refusal>,
) -> Result<(), Fault> {
    let Some(name) = taken(file, points.is_empty(), key, path)? else { return Ok(()) };
    let mut found = all(&name, folder, &path.then("file"), &check)?;
    if found.len() > 1 {
        let message = format!("{name}:{}: a second outline begins, where a shape has one", found[1].lines[0]);
        return Err(Fault::new(path.then("file"), message, "take out empty lines; for many polygons, use [[import]]"));
    }
    *points = found.pop().map_or(Vec::new(), |outline| outline.points.into_iter().map(Numbers).collect());
    Ok(())
}

/// The name of the file, of a shape that has one and nothing else.
fn taken(file: &mut Option<String>, is_empty: bool, what: &str, path: &KeyPath) -> Result<Option<String>, Fault> {
    match file.take() {
        Some(_) if !is_empty => Err(Fault::new(path.clone(), format!("{what} and a file"), "keep one of them")),
        name => Ok(name),
    }
}

/// All outlines of a file, each checked; at least one.
fn all(name: &str, folder: &Path, path: &KeyPath, check: Check<'_>) -> Result<Vec<Outline>, Fault> {
    let place = folder.join(name);
    let fault = |message: String, hint: &str| Fault::new(path.clone(), message, hint);
    unread::is_file(&place, path)?;
    let text = std::fs::read_to_string(&place).map_err(|e| unread::fault(path, &place, &e))?;
    let found = outlines(&text).map_err(|wrong| fault(format!("{name}:{}: {}", wrong.line, wrong.message), wrong.hint))?;
    if found.is_empty() {
        return Err(fault(format!("{name} has no points"), "expected a row x,y a point"));
    }
    for outline in &found {
        if let Some((error, message, hint)) = check(outline) {
            let line = error.vertex().and_then(|vertex| outline.lines.get(vertex)).unwrap_or(&outline.lines[0]);
            let from = outline.lines[0];
            return Err(fault(format!("{name}:{line}: {message} (vertex 0 is in line {from})"), hint));
        }
    }
    Ok(found)
}

fn polygons(scene: &mut Scene, import: Import, number: usize, folder: &Path, path: &KeyPath) -> Result<(), Fault> {
    let Import::Polygons { file, material, decompose, motion } = import else { return Ok(()) };
    let found = all(&file, folder, &path.then("file"), &|outline| polygon_error(outline.points.clone(), decompose))?;
    // Here, because the body that a later check would name is not in the text.
    super::check::material(scene, path.then("material"), &material)?;
    scene.bodies.extend(found.into_iter().enumerate().map(|(i, outline)| {
        let name = format!("import[{number}] {}", outline.id.unwrap_or_else(|| i.to_string()));
        let vertices = outline.points.into_iter().map(Numbers).collect();
        body(name, ShapeSpec::Polygon { vertices, file: None, decompose }, &material, vec![0.0; 2], motion)
    }));
    Ok(())
}

/// How a mesh becomes a body.
#[derive(Clone, Copy)]
struct Made {
    /// True if it may be cut into convex pieces.
    decompose: bool,
    concavity: Option<f64>,
    /// True if the body is fixed or driven, so that a mesh that bounds no volume can be a surface.
    is_fixed: bool,
}

/// A body at rest.
fn body(name: String, shape: ShapeSpec, material: &str, position: Vec<f64>, motion: Option<MotionKind>) -> BodySpec {
    BodySpec {
        name: Some(name),
        shape,
        material: material.to_owned(),
        density: None,
        position,
        orientation: None,
        velocity: Vec::new(),
        spin: None,
        motion,
        force: Vec::new(),
        torque: None,
        drive: Vec::new(),
        removed_at: None,
        max_overlap: None,
    }
}
