//! Which triangle lies beyond each edge of each triangle.

use super::{Mesh, MeshError};

/// In place of a triangle where there is none.
pub(crate) const NONE: u32 = u32::MAX;

/// How many edges or pairs an error lists.
pub(super) const LISTED: usize = 3;

/// The neighbours of each triangle: beyond edge `k`, which runs from corner `k` to the next, or [`NONE`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Edges {
    pub(crate) beyond: Vec<[u32; 3]>,
    /// Edges of one triangle alone, as (triangle, edge).
    pub(super) open: Vec<(u32, usize)>,
}

/// One side of an edge: its ends by number, the lower first, whether the triangle runs from the lower to the higher, and the triangle.
type Side = ([u32; 2], bool, u32, usize);

impl Edges {
    /// Finds the neighbours of a mesh whose corners exist.
    ///
    /// # Errors
    /// Edges with more than two triangles, then those between two triangles that run along them the same way.
    pub(crate) fn of(mesh: &Mesh) -> Result<Self, MeshError> {
        let mut sides: Vec<Side> = Vec::with_capacity(3 * mesh.triangles.len());
        for (triangle, corners) in (0..).zip(&mesh.triangles) {
            for k in 0..3 {
                let (from, to) = (corners[k], corners[(k + 1) % 3]);
                sides.push(([from.min(to), from.max(to)], from < to, triangle, k));
            }
        }
        sides.sort_unstable();
        let ends = |side: &Side| side.0.map(|point| mesh.points[point as usize]);
        let list = |wrong: Vec<&Side>| (wrong.len(), wrong.into_iter().take(LISTED).map(ends).collect());
        let (mut crowded, mut inconsistent) = (Vec::new(), Vec::new());
        let mut edges = Self { beyond: vec![[NONE; 3]; mesh.triangles.len()], open: Vec::new() };
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            match group {
                [one] => edges.open.push((one.2, one.3)),
                [one, other] if one.1 == other.1 => inconsistent.push(one),
                [one, other] => {
                    edges.beyond[one.2 as usize][one.3] = other.2;
                    edges.beyond[other.2 as usize][other.3] = one.2;
                }
                _ => crowded.push(&group[0]),
            }
        }
        if !crowded.is_empty() {
            let (count, edges) = list(crowded);
            return Err(MeshError::Crowded { count, edges });
        }
        if !inconsistent.is_empty() {
            let (count, edges) = list(inconsistent);
            return Err(MeshError::Inconsistent { count, edges });
        }
        edges.open.sort_unstable();
        Ok(edges)
    }
}
