//! Meshes of polygons.

use super::Mesh;

/// Points, and faces that name three or more of them each, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    /// m.
    pub points: Vec<[f64; 3]>,
    /// Indices of points, from 0.
    pub faces: Vec<Vec<u32>>,
}

impl PolygonMesh {
    /// Each face as a fan of triangles around its first corner. The fan of a face that is plane and convex covers it.
    pub fn triangulated(&self) -> Mesh {
        let fan = |face: &Vec<u32>| {
            let first = face.first().copied().unwrap_or(0);
            face.windows(2).skip(1).map(move |side| [first, side[0], side[1]]).collect::<Vec<_>>()
        };
        Mesh { points: self.points.clone(), triangles: self.faces.iter().flat_map(fan).collect() }
    }
}
