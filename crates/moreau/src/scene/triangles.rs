//! Bodies of triangles: from what a scene says to shapes.

use super::shape::ShapeSpec;
use super::values::Numbers;
use crate::mesh::{Closed, Cutting, Heights, Mesh};
use crate::shape::SolidShape;
use crate::shape::solid::{Compound, Polyhedron, Surface};
use crate::space::{Pose, Solid, Space};
use glam::DQuat;

/// A shape, and its own frame in its coordinates.
pub(super) type Shaped = (SolidShape, Pose<DQuat, 3>);

/// The shape that a scene gives by triangles, and nothing for other shapes.
///
/// # Errors
/// What is wrong with the triangles, and what would be right.
pub(super) fn shape(spec: &ShapeSpec) -> Option<Result<Shaped, String>> {
    match spec {
        ShapeSpec::Mesh { points, triangles, decompose, concavity, .. } => {
            let mesh = mesh(points, triangles);
            Some(if *decompose { pieces(mesh, *concavity) } else { surface(mesh) })
        }
        ShapeSpec::HeightField { spacing, heights, origin, .. } => {
            let origin = origin.map_or([0.0; 3], |origin| origin.0);
            let field = Heights { origin, spacing: spacing.0, rows: heights.clone() };
            Some(field.mesh().map_err(|error| error.to_string()).and_then(surface))
        }
        _ => None,
    }
}

fn mesh(points: &[Numbers<3>], triangles: &[[u32; 3]]) -> Mesh {
    Mesh { points: points.iter().map(|point| point.0).collect(), triangles: triangles.to_vec() }
}

fn surface(mesh: Mesh) -> Result<Shaped, String> {
    let surface = Surface::new(mesh).map_err(|error| format!("not a surface: {error}"))?;
    Ok((surface.into(), Pose { position: [0.0; 3], rotation: Solid::IDENTITY }))
}

/// The convex pieces of what a mesh bounds as one body, which weighs what the whole weighs.
fn pieces(mesh: Mesh, concavity: Option<f64>) -> Result<Shaped, String> {
    let closed = mesh.closed().map_err(|error| format!("not the boundary of a body: {error}"))?;
    compound(&closed, concavity).map_err(|error| format!("cannot be cut into convex pieces: {error}"))
}

fn compound(closed: &Closed, concavity: Option<f64>) -> Result<Shaped, String> {
    let otherwise = Cutting::default();
    let cutting = Cutting { concavity: concavity.unwrap_or(otherwise.concavity), ..otherwise };
    let pieces = closed.pieces(cutting).map_err(|error| error.to_string())?;
    // Splinters that are thin beyond rounding hold nothing.
    let parts = pieces.iter().filter_map(|piece| Polyhedron::hull(&piece.points).ok());
    let parts = parts.map(|(shape, own)| (shape.into(), own)).collect();
    let (compound, own) = Compound::with_moments(parts, closed.mass()).map_err(|error| error.to_string())?;
    Ok((compound.into(), own))
}

/// How many triangles a shape has.
pub(super) fn count(spec: &ShapeSpec) -> u64 {
    match spec {
        ShapeSpec::Mesh { triangles, .. } => triangles.len() as u64,
        ShapeSpec::HeightField { heights, .. } => {
            let columns = heights.first().map_or(0, Vec::len);
            2 * (heights.len().saturating_sub(1) as u64) * (columns.saturating_sub(1) as u64)
        }
        _ => 0,
    }
}
