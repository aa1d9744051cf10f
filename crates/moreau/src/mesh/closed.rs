//! Meshes that bound a volume.

use super::edges::LISTED;
use super::{Edges, Mesh, MeshError, crossings, moments_of, vector};
use crate::shape::solid::Moments;
use std::collections::BTreeMap;

/// Of the surface times its root: the volume below which there is none, because rounding decides its sign.
const HOLLOW: f64 = 1e-12;

/// A mesh that bounds a volume, facing outward: see [`Mesh::closed`].
#[derive(Clone, Debug, PartialEq)]
pub struct Closed {
    mesh: Mesh,
    turned: bool,
    mass: Moments,
}

impl Closed {
    /// The mesh, facing outward.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Whether it faced inward as it was given, and was turned around.
    pub fn turned(&self) -> bool {
        self.turned
    }

    /// Its volume, centre and inertia, exact but for rounding.
    pub fn mass(&self) -> &Moments {
        &self.mass
    }
}

/// See [`Mesh::closed`].
pub(super) fn closed(mut mesh: Mesh) -> Result<Closed, MeshError> {
    mesh.check()?;
    points_apart(&mesh)?;
    let edges = Edges::of(&mesh)?;
    let ends = |&(triangle, k): &(u32, usize)| {
        let corners = mesh.corners(triangle as usize);
        [corners[k], corners[(k + 1) % 3]]
    };
    if !edges.shared.is_empty() {
        return Err(MeshError::Shared { count: edges.shared.len(), edges: edges.shared.iter().take(LISTED).map(ends).collect() });
    }
    if !edges.open.is_empty() {
        return Err(MeshError::Open { count: edges.open.len(), edges: edges.open.iter().take(LISTED).map(ends).collect() });
    }
    crossings::check(&mesh)?;
    let area: f64 = (0..mesh.triangles.len()).filter_map(|i| vector::area(mesh.corners(i))).sum();
    let volume = moments_of(&mesh.points, &mesh.triangles).volume;
    // A volume that is no number is none.
    if volume.is_nan() || volume.abs() <= HOLLOW * area * area.sqrt() {
        return Err(MeshError::NoVolume { volume, area });
    }
    let turned = volume < 0.0;
    if turned {
        mesh.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
    let mass = moments_of(&mesh.points, &mesh.triangles);
    Ok(Closed { mesh, turned, mass })
}

/// No two points that triangles use in one place.
fn points_apart(mesh: &Mesh) -> Result<(), MeshError> {
    let mut used = vec![false; mesh.points.len()];
    mesh.triangles.iter().flatten().for_each(|&point| used[point as usize] = true);
    let mut seen = BTreeMap::new();
    for (second, &at) in mesh.points.iter().enumerate().filter(|&(i, _)| used[i]) {
        if let Some(first) = seen.insert(at.map(|x| (x + 0.0).to_bits()), second) {
            return Err(MeshError::SamePoint { first, second, at });
        }
    }
    Ok(())
}
