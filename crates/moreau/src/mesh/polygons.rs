//! Meshes of polygons.

use super::vector::{cross, dot, length, sub};
use super::{Mesh, merge};

/// The part of a mesh's extent below which points of a file are one: far below what files tell, far above how equal numbers are rounded.
pub(super) const ONE_POINT: f64 = 1e-9;

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

    /// Cuts each face into triangles. A convex face becomes a fan around its first corner; a concave face is cut so that no triangle
    /// leaves it.
    pub fn triangulated(&self) -> Mesh {
        let triangles = self.faces.iter().flat_map(|face| triangles_of(&self.points, face)).collect();
        Mesh { points: self.points.clone(), triangles }
    }
}

/// Of the area of a face: twice the area below which three corners count as lying on a line.
const STRAIGHT: f64 = 1e-9;

/// The most corners of a face that is cut by ears, which takes their number squared or, at worst, cubed. Faces with more become fans.
const MOST_CORNERS: usize = 512;

/// Cuts a face into triangles, two fewer than it has corners.
pub(super) fn triangles_of(points: &[[f64; 3]], face: &[u32]) -> Vec<[u32; 3]> {
    if (4..=MOST_CORNERS).contains(&face.len())
        && let Some(flat) = flattened(points, face)
        && !is_convex(&flat)
        && let Some(cut) = ears(&flat)
    {
        return cut.into_iter().map(|corners| corners.map(|i| face[i])).collect();
    }
    let first = face.first().copied().unwrap_or(0);
    face.windows(2).skip(1).map(move |side| [first, side[0], side[1]]).collect()
}

/// The corners of a face in its mean plane, in lengths of the root of its area, counter-clockwise; none for a face without area.
fn flattened(points: &[[f64; 3]], face: &[u32]) -> Option<Vec<[f64; 2]>> {
    let at = |i: u32| points.get(i as usize).copied();
    let origin = at(*face.first()?)?;
    let corners = face.iter().map(|&i| Some(sub(at(i)?, origin))).collect::<Option<Vec<_>>>()?;
    let mut normal = [0.0; 3];
    for (i, &corner) in corners.iter().enumerate() {
        let turn = cross(corner, corners[(i + 1) % corners.len()]);
        (0..3).for_each(|k| normal[k] += turn[k]);
    }
    let area = length(normal);
    let scale = 1.0 / area.sqrt();
    let normal = normal.map(|x| x / area);
    // Any direction across the normal.
    let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let first = cross(axis, normal);
    let first = first.map(|x| x / length(first));
    let second = cross(normal, first);
    let flat: Vec<[f64; 2]> = corners.iter().map(|&p| [scale * dot(p, first), scale * dot(p, second)]).collect();
    flat.iter().flatten().all(|x| x.is_finite()).then_some(flat)
}

/// Twice the area of a triangle, positive if it is counter-clockwise.
fn turn(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

/// True if the fan around the first corner covers the polygon with triangles that all have an area.
fn is_convex(flat: &[[f64; 2]]) -> bool {
    let count = flat.len();
    let turns = |i: usize| turn(flat[i], flat[(i + 1) % count], flat[(i + 2) % count]);
    (0..count).all(|i| turns(i) >= -STRAIGHT) && (1..count - 1).all(|i| turn(flat[0], flat[i], flat[i + 1]) > STRAIGHT)
}

/// Cuts off one ear after the other: a corner whose triangle has an area and holds no other corner (Meisters 1975). Of the ears that there
/// are, the first counts. Returns nothing for a polygon that crosses itself.
fn ears(flat: &[[f64; 2]]) -> Option<Vec<[usize; 3]>> {
    let mut left: Vec<usize> = (0..flat.len()).collect();
    let mut cut = Vec::with_capacity(flat.len() - 2);
    while left.len() > 3 {
        let count = left.len();
        let ear = (0..count).find(|&i| {
            let corners = [left[(i + count - 1) % count], left[i], left[(i + 1) % count]];
            let [p, q, r] = corners.map(|i| flat[i]);
            let inside = |s: [f64; 2]| turn(p, q, s) >= -STRAIGHT && turn(q, r, s) >= -STRAIGHT && turn(r, p, s) >= -STRAIGHT;
            let holds = |&j: &usize| !corners.contains(&j) && ![p, q, r].contains(&flat[j]) && inside(flat[j]);
            turn(p, q, r) > STRAIGHT && !left.iter().any(holds)
        })?;
        cut.push([left[(ear + count - 1) % count], left[ear], left[(ear + 1) % count]]);
        left.remove(ear);
    }
    let last = [left[0], left[1], left[2]];
    (turn(flat[last[0]], flat[last[1]], flat[last[2]]) > STRAIGHT).then(|| {
        cut.push(last);
        cut
    })
}
