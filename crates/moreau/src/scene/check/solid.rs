//! Checks of shapes that are made of points and triangles: what costs little. A mesh is looked at as a whole when it is built.

use super::{finite, plural, positive};
use crate::scene::error::Fault;
use crate::scene::path::KeyPath;
use crate::scene::{Numbers, ShapeSpec};
use crate::shape::solid::Polyhedron;

/// Polyhedra, meshes and height fields.
pub(super) fn pointed(shape: &ShapeSpec, path: &KeyPath) -> Result<(), Fault> {
    match shape {
        ShapeSpec::Polyhedron { points, file, scale, flat } => {
            read(path, "points", points.is_empty(), file.as_deref(), scale.as_ref())?;
            polyhedron(path, points, *flat)
        }
        ShapeSpec::Mesh { points, triangles, file, scale, decompose, concavity } => {
            read(path, "triangles", triangles.is_empty(), file.as_deref(), scale.as_ref())?;
            mesh(path, points, triangles)?;
            self::concavity(path, *concavity, *decompose)
        }
        ShapeSpec::HeightField { spacing, heights, file, origin } => {
            read(path, "heights", heights.is_empty(), file.as_deref(), None)?;
            field(path, heights, spacing, origin.as_ref())
        }
        _ => Ok(()),
    }
}

/// The tolerance of convex pieces, which only cut meshes have.
pub(in crate::scene) fn concavity(path: &KeyPath, concavity: Option<f64>, decompose: bool) -> Result<(), Fault> {
    match concavity {
        Some(_) if !decompose => {
            Err(Fault::new(path.then("concavity"), "a concavity of what is not cut", "add decompose = true, or leave it out"))
        }
        Some(x) if !(0.0..=1.0).contains(&x) => {
            Err(Fault::new(path.then("concavity"), format!("concavity is {x}"), "expected a number from 0 to 1"))
        }
        _ => Ok(()),
    }
}

/// Files are read with the scene and leave what they hold in their place.
fn read(path: &KeyPath, key: &str, is_empty: bool, file: Option<&str>, scale: Option<&f64>) -> Result<(), Fault> {
    if file.is_some() {
        let message = "a file that was not read";
        return Err(Fault::new(path.then("file"), message, format!("expected a scene read by Scene::load, or {key}")));
    }
    if is_empty {
        return Err(Fault::new(path.clone(), format!("no {key}"), format!("add `{key} = […]` or `file = \"…\"`")));
    }
    scale.map_or(Ok(()), |_| {
        Err(Fault::new(path.then("scale"), "a scale without a file", format!("leave it out: {key} are in m")))
    })
}

fn polyhedron(path: &KeyPath, points: &[Numbers<3>], flat: Option<f64>) -> Result<(), Fault> {
    let flat = flat.unwrap_or(ShapeSpec::FLAT);
    if !(0.0..=0.01).contains(&flat) {
        return Err(Fault::new(path.then("flat"), format!("flat is {flat}"), "expected a number from 0 to 0.01"));
    }
    let path = path.then("points");
    let found = Polyhedron::hull_within(&points.iter().map(|point| point.0).collect::<Vec<_>>(), flat);
    let Err(error) = found else { return Ok(()) };
    let hint = "expected the corners of a convex polyhedron, in any order";
    let path = error.vertex().map_or(path.clone(), |vertex| path.then(vertex));
    Err(Fault::new(path, format!("not a convex polyhedron: {error}"), hint))
}

fn mesh(path: &KeyPath, points: &[Numbers<3>], triangles: &[[u32; 3]]) -> Result<(), Fault> {
    points.iter().enumerate().try_for_each(|(i, point)| finite(&path.then("points").then(i), &point.0))?;
    let missing = |corners: &[u32; 3]| corners.iter().position(|&point| point as usize >= points.len());
    let found = triangles.iter().enumerate().find_map(|(i, corners)| Some((i, missing(corners)?)));
    found.map_or(Ok(()), |(i, k)| {
        let hint = format!("expected an index below {}, the number of points", points.len());
        let message = format!("there is no point {}", triangles[i][k]);
        Err(Fault::new(path.then("triangles").then(i).then(k), message, hint))
    })
}

fn field(path: &KeyPath, heights: &[Vec<f64>], spacing: &Numbers<2>, origin: Option<&Numbers<3>>) -> Result<(), Fault> {
    spacing.0.iter().enumerate().try_for_each(|(k, &x)| positive(path.then("spacing").then(k), x, "in m"))?;
    origin.map_or(Ok(()), |origin| finite(&path.then("origin"), &origin.0))?;
    let columns = heights.first().map_or(0, Vec::len);
    for (j, row) in heights.iter().enumerate() {
        let path = path.then("heights").then(j);
        finite(&path, row)?;
        if row.len() != columns {
            let hint = format!("expected {columns}, as in the first row");
            return Err(Fault::new(path, plural(row.len(), "height"), hint));
        }
    }
    if columns < 2 || heights.len() < 2 {
        let message = format!("{} of {}", plural(heights.len(), "row"), plural(columns, "height"));
        return Err(Fault::new(path.then("heights"), message, "expected at least 2 rows of at least 2 heights"));
    }
    Ok(())
}
