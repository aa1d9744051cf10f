//! Files of several meshes, each a body.

use super::solid;
use super::{Made, body};
use crate::mesh::{Mesh, MeshFile};
use crate::scene::check;
use crate::scene::error::Fault;
use crate::scene::path::KeyPath;
use crate::scene::spec::{Import, MotionKind, Split};
use crate::scene::{Numbers, Scene, ShapeSpec};
use crate::shape::solid::Polyhedron;
use std::collections::BTreeSet;
use std::path::Path;

/// By which part of its volume a body may fall short of its hull and count as convex: files are written with few digits.
const CONVEX: f64 = 1e-4;

/// Makes a body of each object of a file.
pub(super) fn read(scene: &mut Scene, import: Import, number: usize, folder: &Path, path: &KeyPath) -> Result<(), Fault> {
    let Import::Meshes { file, material, scale, split, decompose, concavity, motion } = import else { return Ok(()) };
    check::concavity(path, concavity, decompose)?;
    let found = solid::read(&file, scale, folder, path)?;
    let place = path.then("file");
    // Here, because the body that a later check would name is not in the text.
    check::material(scene, path.then("material"), &material)?;
    let mut remark = |text: &str| scene.remarks.0.push(format!("{place}: {text}"));
    found.remarks.iter().for_each(|text| remark(text));
    let parts = bodies_of(&found, split);
    if split == Split::Objects && parts.len() == 1 && found.mesh.parts().len() > 1 {
        remark(&format!(
            "{file} has one object, of several parts that share no points; to make a body of each, add split = \"parts\""
        ));
    }
    let mut names = BTreeSet::new();
    for (i, (name, mesh)) in parts.into_iter().enumerate() {
        let made = Made { decompose, concavity, is_fixed: matches!(motion, Some(MotionKind::Fixed | MotionKind::Driven)) };
        let called = name.unwrap_or_else(|| i.to_string());
        let shape = shape_of(&mesh, made)
            .map_err(|(message, hint)| Fault::new(place.clone(), format!("{file}: object {called:?}: {message}"), hint))?;
        let mut unique = format!("import[{number}] {called}");
        if !names.insert(unique.clone()) {
            unique = format!("{unique} ({i})");
            names.insert(unique.clone());
        }
        scene.bodies.push(body(unique, shape, &material, vec![0.0; 3], motion));
    }
    Ok(())
}

/// The meshes that become bodies, with their names.
fn bodies_of(found: &MeshFile, split: Split) -> Vec<(Option<String>, Mesh)> {
    match split {
        Split::Parts => found.mesh.parts().into_iter().map(|part| (None, part)).collect(),
        Split::Objects => {
            let filled = found.objects.iter().enumerate().filter(|(_, object)| !object.triangles.is_empty());
            filled.map(|(i, object)| (object.name.clone(), found.object(i))).collect()
        }
    }
}

/// The shape of a body that a mesh bounds, or what is wrong and what would be right. A fixed or driven mesh that bounds none is a surface.
pub(super) fn shape_of(mesh: &Mesh, made: Made) -> Result<ShapeSpec, (String, &'static str)> {
    let Made { decompose, concavity, is_fixed } = made;
    let spec = |mesh: &Mesh, decompose: bool| ShapeSpec::Mesh {
        points: mesh.points.iter().copied().map(Numbers).collect(),
        triangles: mesh.triangles.clone(),
        file: None,
        scale: None,
        decompose,
        concavity: concavity.filter(|_| decompose),
    };
    let closed = match mesh.clone().closed() {
        Ok(closed) => closed,
        Err(_) if is_fixed && !decompose => return Ok(spec(mesh, false)),
        Err(error) => return Err((error.to_string(), "expected the closed surface of a body")),
    };
    let points = &closed.mesh().points;
    let hull = Polyhedron::hull_within(points, ShapeSpec::FLAT_IN_FILES).ok();
    let bridged = hull.is_none_or(|(hull, _)| hull.volume() > (1.0 + CONVEX) * closed.mass().volume);
    match (bridged, decompose, is_fixed) {
        (false, ..) => {
            let points = points.iter().copied().map(Numbers).collect();
            Ok(ShapeSpec::Polyhedron { points, file: None, scale: None, flat: Some(ShapeSpec::FLAT_IN_FILES) })
        }
        (true, true, _) => Ok(spec(closed.mesh(), true)),
        (true, false, true) => Ok(spec(closed.mesh(), false)),
        (true, false, false) => {
            Err(("the body is not convex".into(), "add decompose = true to cut such bodies into convex pieces"))
        }
    }
}
