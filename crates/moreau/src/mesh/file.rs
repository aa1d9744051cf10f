//! What a file of meshes holds: one mesh, the objects that it consists of, and what its reader had to say.

use super::{Mesh, MeshError, Place, bytes_of, gltf, obj, ply, stl};
use crate::disjoint::representative;
use std::collections::BTreeMap;
use std::path::Path;

/// The content of a file of meshes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// All triangles of the file.
    pub mesh: Mesh,
    /// The objects in the order in which the file begins them. Each triangle belongs to one of them.
    pub objects: Vec<Object>,
    /// What the file has wrong that did not prevent reading it, a sentence each, with the name of the file.
    pub remarks: Vec<String>,
}

/// A part of a file that has a name, or could have one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Object {
    /// Its name in the file.
    pub name: Option<String>,
    /// Indices of its triangles, from 0, ascending.
    pub triangles: Vec<u32>,
}

impl MeshFile {
    /// Reads a file; the end of its name says which format it has.
    ///
    /// # Errors
    /// Returned if the file cannot be read, is too large, has none of the formats, or is damaged.
    pub fn load(path: &Path) -> Result<Self, MeshError> {
        let file = path.display().to_string();
        let extension = path.extension().map(|end| end.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("stl") => Self::from_stl(&bytes_of(path)?, &file),
            Some("obj") => Self::from_obj(&bytes_of(path)?, &file),
            Some("ply") => Self::from_ply(&bytes_of(path)?, &file),
            Some("gltf" | "glb") => gltf::read(&bytes_of(path)?, &file, path.parent()),
            _ => {
                let hint = "expected a name that ends in .stl, .obj, .ply, .gltf or .glb";
                Err(MeshError::read(&file, Place::File, "not known by its name", hint))
            }
        }
    }

    /// Reads STL as [`Mesh::from_stl`] does. Each solid of a text file is an object.
    ///
    /// # Errors
    /// As [`Mesh::from_stl`].
    pub fn from_stl(bytes: &[u8], file: &str) -> Result<Self, MeshError> {
        stl::read(bytes, file)
    }

    /// Reads Wavefront OBJ as [`Mesh::from_obj`] does. Objects are those of lines `o`, in a file without such lines those of lines `g`.
    ///
    /// # Errors
    /// As [`Mesh::from_obj`].
    pub fn from_obj(bytes: &[u8], file: &str) -> Result<Self, MeshError> {
        obj::read(bytes, file)
    }

    /// Reads PLY, as text or binary of either order of bytes: vertices and faces, cut into triangles. All is one object.
    ///
    /// # Errors
    /// Returned if the bytes are not PLY, lack vertices or faces, or are damaged.
    pub fn from_ply(bytes: &[u8], file: &str) -> Result<Self, MeshError> {
        ply::read(bytes, file)
    }

    /// Reads glTF 2.0, as JSON or binary (GLB), whose buffers are all in `bytes`. Each node with a mesh is an object, placed by the
    /// transforms of the nodes. Coordinates are taken as they are: by the specification y points up.
    ///
    /// # Errors
    /// Returned if the bytes are not glTF 2.0, have compressed or sparse meshes, or are damaged.
    pub fn from_gltf(bytes: &[u8], file: &str) -> Result<Self, MeshError> {
        gltf::read(bytes, file, None)
    }

    /// Merges equal points, as [`Mesh::merged`] does. Objects lose the triangles that lose a corner.
    #[must_use]
    pub(super) fn merged(self, tolerance: f64) -> Self {
        let (mesh, index) = super::merge::merged_with_index(&self.mesh, tolerance);
        let renamed = |object: Object| {
            let triangles = object.triangles.iter().filter_map(|&i| index[i as usize]).collect();
            Object { triangles, ..object }
        };
        Self { mesh, objects: self.objects.into_iter().map(renamed).collect(), ..self }
    }

    /// Returns the mesh of one object, with the points that it uses in their order.
    pub fn object(&self, number: usize) -> Mesh {
        let Some(object) = self.objects.get(number) else { return Mesh::default() };
        self.mesh.part(&object.triangles)
    }

    /// True if there are two objects or more, and no two of them share a point. Such objects are separate things, and not
    /// faces of one thing.
    pub fn has_separate_objects(&self) -> bool {
        let mut owner = vec![None; self.mesh.points.len()];
        let mut filled = 0;
        for (number, object) in self.objects.iter().enumerate() {
            filled += usize::from(!object.triangles.is_empty());
            for &point in object.triangles.iter().flat_map(|&i| &self.mesh.triangles[i as usize]) {
                let Some(owner) = owner.get_mut(point as usize) else { return false };
                if owner.is_some_and(|owner| owner != number) {
                    return false;
                }
                *owner = Some(number);
            }
        }
        filled > 1
    }
}

impl Mesh {
    /// Returns the parts that share no points with each other, in the order of their first triangles.
    pub fn parts(&self) -> Vec<Self> {
        let mut root: Vec<u32> = (0..self.points.len() as u32).collect();
        for &[a, b, c] in &self.triangles {
            let first = representative(&mut root, a);
            for other in [b, c] {
                let other = representative(&mut root, other);
                root[other as usize] = first;
            }
        }
        let mut number = BTreeMap::new();
        let mut parts: Vec<Vec<u32>> = Vec::new();
        for (i, triangle) in (0..).zip(&self.triangles) {
            let part = *number.entry(representative(&mut root, triangle[0])).or_insert(parts.len());
            if part == parts.len() {
                parts.push(Vec::new());
            }
            parts[part].push(i);
        }
        parts.iter().map(|triangles| self.part(triangles)).collect()
    }

    /// Returns these triangles, with the points that they use in their order.
    pub(super) fn part(&self, triangles: &[u32]) -> Self {
        let triangles: Vec<[u32; 3]> = triangles.iter().map(|&i| self.triangles[i as usize]).collect();
        let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let place = |point: u32| used.binary_search(&point).map_or(point, |place| place as u32);
        Self {
            points: used.iter().map(|&point| self.points[point as usize]).collect(),
            triangles: triangles.iter().map(|corners| corners.map(place)).collect(),
        }
    }
}
