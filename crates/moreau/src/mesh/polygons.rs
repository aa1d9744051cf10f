//! Meshes of polygons.

use super::{Mesh, merge};

/// The part of a mesh's extent below which points of a file are one: far below what files tell, far above how equal numbers are rounded.
const ONE_POINT: f64 = 1e-9;

/// Points, and faces that name three or more of them each, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    /// m.
    pub points: Vec<[f64; 3]>,
    /// Indices of points, from 0.
    pub faces: Vec<Vec<u32>>,
}

impl PolygonMesh {
    /// The same surface with each point once, for files whose faces have vertices of their own; see [`Mesh::merged`]. Faces stay, also those that have no area.
    #[must_use]
    pub fn merged(&self, tolerance: f64) -> Self {
        merge::merged_polygons(self, tolerance)
    }

    /// The same with points one that are nearer to each other than a part in 10⁹ of the mesh's extent.
    pub(super) fn of_file(&self) -> Self {
        let extent = |k: usize| {
            let (low, high) =
                self.points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p[k]), high.max(p[k])));
            high - low
        };
        self.merged(ONE_POINT * (0..3).map(extent).fold(0.0, f64::max))
    }

    /// Each face as a fan of triangles around its first corner. The fan of a face that is plane and convex covers it.
    pub fn triangulated(&self) -> Mesh {
        let fan = |face: &Vec<u32>| {
            let first = face.first().copied().unwrap_or(0);
            face.windows(2).skip(1).map(move |side| [first, side[0], side[1]]).collect::<Vec<_>>()
        };
        Mesh { points: self.points.clone(), triangles: self.faces.iter().flat_map(fan).collect() }
    }
}
