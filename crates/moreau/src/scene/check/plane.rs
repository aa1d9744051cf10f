//! Checks of compounds, and of the shapes of the plane that are made of several points: what the shapes themselves say of them.

use super::bodies::{orientation_of, shape};
use super::vector;
use crate::scene::dimension::{self, points};
use crate::scene::error::Fault;
use crate::scene::path::KeyPath;
use crate::scene::{Numbers, PartSpec, Scene, ShapeSpec};
use crate::shape::ShapeError;
use crate::shape::plane::{Polygon, Polyline, decompose};

/// What a shape says of itself, in words, and what would be right.
pub(in crate::scene) type Refusal = (ShapeError, String, &'static str);

/// What is wrong with a polygon, if anything.
pub(in crate::scene) fn polygon_error(vertices: Vec<[f64; 2]>, concave: bool) -> Option<Refusal> {
    let (error, what, hint) = if concave {
        (decompose(vertices).err()?, "not a polygon", "expected the corners of a polygon, in order around it")
    } else {
        (Polygon::new(vertices).err()?, "not a convex polygon", "expected the corners of a convex polygon, in order around it")
    };
    Some((error, format!("{what}: {error}"), hint))
}

/// As [`polygon_error`], of a polyline.
pub(in crate::scene) fn polyline_error(points: &[[f64; 2]], closed: bool) -> Option<Refusal> {
    let error = Polyline::new(points, closed).err()?;
    Some((error, format!("not a polyline: {error}"), "expected points in order along a chain that does not meet itself"))
}

pub(super) fn polygon(path: &KeyPath, vertices: &[Numbers<2>], concave: bool, file: Option<&str>) -> Result<(), Fault> {
    given(path, "vertices", vertices.is_empty(), file)?;
    at(path, "vertices", polygon_error(points(vertices), concave))
}

pub(super) fn polyline(path: &KeyPath, chain: &[Numbers<2>], closed: bool, file: Option<&str>) -> Result<(), Fault> {
    given(path, "points", chain.is_empty(), file)?;
    at(path, "points", polyline_error(&points(chain), closed))
}

/// Files are read with the scene and leave their points in their place.
fn given(path: &KeyPath, key: &str, is_empty: bool, file: Option<&str>) -> Result<(), Fault> {
    match (is_empty, file) {
        (false, None) => Ok(()),
        (true, None) => {
            Err(Fault::new(path.clone(), format!("no {key}"), format!("add `{key} = [[x, y], …]` or `file = \"…\"`")))
        }
        (_, Some(_)) => {
            let message = "a file that was not read";
            Err(Fault::new(path.then("file"), message, format!("expected a scene read by Scene::load, or {key}")))
        }
    }
}

fn at(path: &KeyPath, key: &str, wrong: Option<Refusal>) -> Result<(), Fault> {
    wrong.map_or(Ok(()), |(error, message, hint)| {
        let list = path.then(key);
        Err(Fault::new(error.vertex().map_or(list.clone(), |vertex| list.then(vertex)), message, hint))
    })
}

pub(super) fn compound(scene: &Scene, path: &KeyPath, parts: &[PartSpec]) -> Result<(), Fault> {
    for (i, part) in parts.iter().enumerate() {
        let path = path.then(i);
        if let ShapeSpec::Mesh { .. } = part.shape {
            let hint = "a mesh with decompose = true is a compound itself: make it a body of its own";
            return Err(Fault::new(path.then("shape"), "a mesh as a part", hint));
        }
        if !part.shape.has_mass() {
            let message = format!("a {} as a part: it has no mass", part.shape.name());
            return Err(Fault::new(path.then("shape"), message, "expected a shape that a free body can have"));
        }
        shape(scene, &part.shape, &path.then("shape"))?;
        vector(scene, path.then("position"), &part.position, true)?;
        if let Some(orientation) = &part.orientation {
            orientation_of(scene, orientation, &path.then("orientation"))?;
        }
    }
    // Concave polygons among them are several parts each, so the shape itself counts.
    let error = match scene.dimension.number() {
        2 => dimension::plane_compound(parts).and_then(Result::err),
        _ => dimension::solid_compound(parts).and_then(Result::err),
    };
    let Some(error) = error else { return Ok(()) };
    Err(Fault::new(path.clone(), format!("not a compound: {error}"), "expected 1 to 1024 convex parts"))
}
