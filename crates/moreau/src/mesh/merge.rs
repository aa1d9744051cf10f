//! Points that are one.

use super::vector::{dot, sub};
use super::{Mesh, PolygonMesh};
use std::collections::HashMap;

/// See [`Mesh::merged`]. A corner that names no point goes on doing so.
pub(super) fn merged(mesh: &Mesh, tolerance: f64) -> Mesh {
    merged_with_index(mesh, tolerance).0
}

/// The same, and for each triangle its number among those that stay.
pub(super) fn merged_with_index(mesh: &Mesh, tolerance: f64) -> (Mesh, Vec<Option<u32>>) {
    let (points, index) = joined(&mesh.points, tolerance);
    let (mut triangles, mut numbers) = (Vec::with_capacity(mesh.triangles.len()), Vec::with_capacity(mesh.triangles.len()));
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| index.get(i as usize).copied().unwrap_or(i));
        let stays = a != b && b != c && c != a;
        numbers.push(stays.then_some(triangles.len() as u32));
        if stays {
            triangles.push([a, b, c]);
        }
    }
    (Mesh { points, triangles }, numbers)
}

/// See [`PolygonMesh::merged`].
pub(super) fn merged_polygons(mesh: &PolygonMesh, tolerance: f64) -> PolygonMesh {
    let (points, index) = joined(&mesh.points, tolerance);
    let face = |corners: &Vec<u32>| corners.iter().map(|&i| index.get(i as usize).copied().unwrap_or(i)).collect();
    PolygonMesh { points, faces: mesh.faces.iter().map(face).collect() }
}

/// The points that stay, and for each point the number of the one that it becomes. Cells as wide as the tolerance hold the points that stay; the 27
/// cells around a point hold all points near it. The code reads the map by key alone, so the map's order has no effect.
fn joined(all: &[[f64; 3]], tolerance: f64) -> (Vec<[f64; 3]>, Vec<u32>) {
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut cells: HashMap<[u64; 3], Vec<u32>> = HashMap::new();
    let mut index = Vec::with_capacity(all.len());
    for &point in all {
        let near = if tolerance > 0.0 {
            neighbourhood(cell(point, tolerance))
                .filter_map(|key| cells.get(&key))
                .flatten()
                .copied()
                .filter(|&i| square(points[i as usize], point) <= tolerance * tolerance)
                .min()
        } else {
            cells.get(&bits(point)).and_then(|same| same.first().copied())
        };
        index.push(near.unwrap_or_else(|| {
            let key = if tolerance > 0.0 { cell(point, tolerance) } else { bits(point) };
            points.push(point);
            let new = (points.len() - 1) as u32;
            cells.entry(key).or_default().push(new);
            new
        }));
    }
    (points, index)
}

/// Minus zero is zero.
fn bits(point: [f64; 3]) -> [u64; 3] {
    point.map(|x| (x + 0.0).to_bits())
}

/// The cell of a point; far out, where cells are narrower than the spacing of numbers, neighbours are no longer told apart.
fn cell(point: [f64; 3], width: f64) -> [u64; 3] {
    point.map(|x| (x / width).floor() as i64 as u64)
}

fn neighbourhood([x, y, z]: [u64; 3]) -> impl Iterator<Item = [u64; 3]> {
    let beside = |a: u64| [a.wrapping_sub(1), a, a.wrapping_add(1)];
    beside(x)
        .into_iter()
        .flat_map(move |x| beside(y).into_iter().flat_map(move |y| beside(z).into_iter().map(move |z| [x, y, z])))
}

fn square(a: [f64; 3], b: [f64; 3]) -> f64 {
    let between = sub(a, b);
    dot(between, between)
}
