//! Meshes of triangles: read from files, checked, weighed, cut into convex pieces.
//!
//! A [`Mesh`] is what a file holds: points and triangles, closed or not. [`Mesh::closed`] makes a [`Closed`] one of it, or says why it
//! bounds no volume; only that has a volume, a centre and an inertia ([`Closed::mass`]) and convex pieces ([`Closed::pieces`]). Lengths in
//! m.
//!
//! Files are read whole and within limits ([`MOST_BYTES`], [`MOST_TRIANGLES`], [`LARGEST`]); any bytes give a mesh or a [`MeshError`].

pub mod compas;

mod closed;
mod crossings;
mod edges;
mod error;
mod file;
mod gltf;
mod heights;
mod merge;
mod obj;
mod pieces;
mod ply;
mod polygons;
mod stl;
mod tree;
mod vector;

pub use closed::Closed;
pub(crate) use edges::{Edges, HIDDEN, NONE};
pub use error::{MeshError, Place};
pub use file::{MeshFile, Object};
pub use heights::Heights;
pub use pieces::{Cutting, Piece};
pub use polygons::PolygonMesh;
pub(crate) use tree::{Aabb, Tree};

use crate::shape::solid::Moments;
use std::path::Path;

/// The most bytes that a file may have: 1 GiB.
pub const MOST_BYTES: u64 = 1 << 30;

/// The most triangles that a mesh may have: contacts number them with 22 bits.
pub const MOST_TRIANGLES: usize = 1 << 22;

/// Coordinates must be below this, m: moments of inertia are of the fifth power.
pub const LARGEST: f64 = 1e60;

/// Points, and triangles that name three of them each, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// m.
    pub points: Vec<[f64; 3]>,
    /// Indices of points, from 0.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Reads all triangles of a file by the end of its name; see [`MeshFile::load`].
    ///
    /// # Errors
    /// As [`MeshFile::load`].
    pub fn load(path: &Path) -> Result<Self, MeshError> {
        MeshFile::load(path).map(|file| file.mesh)
    }

    /// Reads STL, as text or binary, with equal points merged ([`Mesh::merged`]). Normals, names and attributes are passed over.
    ///
    /// # Errors
    /// What is wrong, with its line or byte; `file` is what errors call the bytes.
    pub fn from_stl(bytes: &[u8], file: &str) -> Result<Self, MeshError> {
        MeshFile::from_stl(bytes, file).map(|file| file.mesh)
    }

    /// Reads Wavefront OBJ: `v` and `f`, faces of more than three corners cut into triangles; points nearer to each other than a part in 10⁹ of the extent
    /// become one. All else is passed over.
    ///
    /// # Errors
    /// What is wrong, with its line; `file` is what errors call the bytes.
    pub fn from_obj(bytes: &[u8], file: &str) -> Result<Self, MeshError> {
        MeshFile::from_obj(bytes, file).map(|file| file.mesh)
    }

    /// The same surface with each point once: points at a distance of at most `tolerance` (m) from an earlier one become that one; at 0
    /// those that are equal to the bit. Triangles that lose a corner are left out. A tolerance below 0 is 0.
    #[must_use]
    pub fn merged(&self, tolerance: f64) -> Self {
        merge::merged(self, tolerance)
    }

    /// The mesh enlarged by a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { points: self.points.iter().map(|p| p.map(|x| factor * x)).collect(), triangles: self.triangles.clone() }
    }

    /// Checks that the mesh bounds a volume once: indices, sizes, areas, that each edge is shared by two triangles that run along it to and
    /// fro, that no two triangles cross, and that the volume is not zero. One that is inside out as a whole is turned around, and
    /// [`Closed::turned`] says so.
    ///
    /// # Errors
    /// The first kind of thing that is wrong, with the first places.
    pub fn closed(self) -> Result<Closed, MeshError> {
        closed::closed(self)
    }

    /// The corners of triangle `i`.
    pub(crate) fn corners(&self, i: usize) -> [[f64; 3]; 3] {
        self.triangles[i].map(|point| self.points[point as usize])
    }

    /// Checks what every use of a mesh needs: few enough triangles, at least one, corners that exist and are somewhere, and areas.
    pub(crate) fn check(&self) -> Result<(), MeshError> {
        let count = self.triangles.len();
        if count == 0 {
            return Err(MeshError::Empty);
        }
        if count > MOST_TRIANGLES {
            return Err(MeshError::TooMany { count, what: "triangles", most: MOST_TRIANGLES });
        }
        if let Some(point) = self.points.iter().position(|p| p.iter().any(|x| x.abs() >= LARGEST || x.is_nan())) {
            return Err(MeshError::Nowhere { point, at: self.points[point] });
        }
        let number = self.points.len();
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if let Some(&point) = corners.iter().find(|&&point| point as usize >= number) {
                return Err(MeshError::NoSuchPoint { triangle, point, count: number });
            }
            if vector::area(self.corners(triangle)).is_none() {
                return Err(MeshError::NoArea { triangle, corners: self.corners(triangle) });
            }
        }
        Ok(())
    }
}

/// The moments of what triangles bound that are counter-clockwise seen from outside; the volume is negative where they are clockwise.
/// Triangles that name no point count nothing.
pub(crate) fn moments_of(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Moments {
    let at = |index: u32| points.get(index as usize).copied();
    Moments::of_closed(triangles.iter().filter_map(|&[a, b, c]| Some([at(a)?, at(b)?, at(c)?])))
}

/// The bytes of a file that is not too large.
pub(crate) fn bytes_of(path: &Path) -> Result<Vec<u8>, MeshError> {
    use std::io::Read;
    let file = path.display().to_string();
    let cannot = |e: std::io::Error| MeshError::read(&file, Place::File, format!("cannot be read: {e}"), "expected a file");
    let mut bytes = Vec::new();
    std::fs::File::open(path).map_err(cannot)?.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(cannot)?;
    if bytes.len() as u64 > MOST_BYTES {
        let hint = format!("expected at most {MOST_BYTES} bytes");
        return Err(MeshError::read(&file, Place::File, "the file is too large", hint));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests;
