//! Exact convex pieces of a mesh of few faces, such as a block of masonry.
//!
//! The hull of the mesh is cut along the planes of those faces that do not lie on it, each cell only where a face reaches into it. No face then
//! crosses a cell, so that a cell is in the body or outside as a whole (its winding number says which). Cells that are convex together are
//! joined again. Pieces have no parts outside the body, where those of a grid of cubes bridge hollows by up to a cube.

use super::{Piece, hull};
use crate::mesh::{Mesh, moments_of};
use glam::DVec3;
use std::f64::consts::PI;

/// Of the size of the mesh: the distance from a plane below which a point lies on it, as for faces of files, which have few digits.
const ON: f64 = 1e-6;

/// The most planes of faces that do not lie on the hull. Meshes with more are curved, and are cut by a grid of cubes.
const MOST_PLANES: usize = 64;

/// The most cells.
const MOST_CELLS: usize = 256;

/// By which part of the volume the pieces together may miss it, and pieces that are joined their hull.
const VOLUME: f64 = 1e-6;

/// The plane of some triangles: a point p lies on it where normal · p = offset.
struct Plane {
    normal: DVec3,
    offset: f64,
    triangles: Vec<[DVec3; 3]>,
}

impl Plane {
    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// Cuts a closed mesh of this volume into at most `most` pieces; nothing if it has too many faces, or if rounding gets in the way.
pub(super) fn pieces(mesh: &Mesh, volume: f64, most: usize) -> Option<Vec<Piece>> {
    let points: Vec<DVec3> = mesh.points.iter().map(|&p| p.into()).collect();
    let corners = || mesh.triangles.iter().map(|triangle| triangle.map(|i| points[i as usize]));
    let used: Vec<DVec3> = corners().flatten().collect();
    let (low, high) = used.iter().fold((used[0], used[0]), |(low, high), &p| (low.min(p), high.max(p)));
    let level = ON * (high - low).max_element();
    let planes = planes(corners(), &used, level)?;
    let mut cells = vec![hull(&used)?];
    for plane in &planes {
        let mut cut = Vec::with_capacity(cells.len() + 1);
        for cell in cells {
            match split(&cell, plane, level) {
                Split::No => cut.push(cell),
                Split::Two(parts) => cut.extend(parts),
                Split::Failed => return None,
            }
        }
        cells = cut;
        if cells.len() > MOST_CELLS {
            return None;
        }
    }
    cells.retain(|cell| is_inside(centre(cell), corners()));
    let total: f64 = cells.iter().map(size).sum();
    if (total - volume).abs() > VOLUME * volume {
        return None;
    }
    let cells = joined(cells, level);
    (cells.len() <= most).then_some(cells)
}

/// The planes of the triangles that have points of the mesh in front of them, each once; nothing if there are too many.
fn planes(all: impl Iterator<Item = [DVec3; 3]>, points: &[DVec3], level: f64) -> Option<Vec<Plane>> {
    let mut planes: Vec<Plane> = Vec::new();
    for corners in all {
        let [p, q, r] = corners;
        let normal = (q - p).cross(r - p).normalize();
        let offset = normal.dot(p);
        if let Some(known) = planes.iter_mut().find(|plane| corners.iter().all(|&p| plane.height(p).abs() <= level)) {
            known.triangles.push(corners);
        } else if points.iter().any(|&point| normal.dot(point) - offset > level) {
            planes.push(Plane { normal, offset, triangles: vec![corners] });
            if planes.len() > MOST_PLANES {
                return None;
            }
        }
    }
    Some(planes)
}

enum Split {
    No,
    Two([Piece; 2]),
    Failed,
}

/// Cuts a cell along a plane if a triangle of the plane reaches into it.
fn split(cell: &Piece, plane: &Plane, level: f64) -> Split {
    let heights: Vec<(DVec3, f64)> = cell.points.iter().map(|&p| p.into()).map(|p| (p, plane.height(p))).collect();
    let crosses = heights.iter().any(|(_, h)| *h > level) && heights.iter().any(|(_, h)| *h < -level);
    if !crosses || !plane.triangles.iter().any(|triangle| reaches_into(triangle, cell, level)) {
        return Split::No;
    }
    // The section of a convex body is the hull of where the ways between points on either side go through the plane.
    let mut section = Vec::new();
    for (p, above) in heights.iter().filter(|(_, h)| *h > level) {
        for (q, below) in heights.iter().filter(|(_, h)| *h < -level) {
            section.push(*p + (*q - *p) * (above / (above - below)));
        }
    }
    let side = |sign: f64| {
        let kept = heights.iter().filter(|(_, h)| sign * h >= -level).map(|(p, _)| *p);
        hull(&apart(kept.chain(section.iter().copied()), level))
    };
    match (side(1.0), side(-1.0)) {
        (Some(above), Some(below)) => Split::Two([above, below]),
        _ => Split::Failed,
    }
}

/// The points that are farther than `level` from those before them.
fn apart(points: impl Iterator<Item = DVec3>, level: f64) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = Vec::new();
    for point in points {
        if !kept.iter().any(|other| (*other - point).length() <= 0.1 * level) {
            kept.push(point);
        }
    }
    kept
}

/// True if part of the triangle is deeper than `level` inside the cell (Sutherland & Hodgman 1974).
fn reaches_into(triangle: &[DVec3; 3], cell: &Piece, level: f64) -> bool {
    let mut polygon = triangle.to_vec();
    for face in &cell.triangles {
        let [p, q, r] = face.map(|i| DVec3::from(cell.points[i as usize]));
        let normal = (q - p).cross(r - p).normalize_or_zero();
        let depth = |s: DVec3| -normal.dot(s - p) - level;
        let mut inside = Vec::with_capacity(polygon.len() + 1);
        for (i, &s) in polygon.iter().enumerate() {
            let next = polygon[(i + 1) % polygon.len()];
            let (a, b) = (depth(s), depth(next));
            if a > 0.0 {
                inside.push(s);
            }
            if (a > 0.0) != (b > 0.0) {
                inside.push(s + (next - s) * (a / (a - b)));
            }
        }
        // A face without an area says nothing.
        if normal != DVec3::ZERO {
            polygon = inside;
        }
        if polygon.len() < 3 {
            return false;
        }
    }
    true
}

fn centre(cell: &Piece) -> DVec3 {
    cell.points.iter().map(|&p| DVec3::from(p)).sum::<DVec3>() / cell.points.len() as f64
}

fn size(cell: &Piece) -> f64 {
    moments_of(&cell.points, &cell.triangles).volume
}

/// True if a point, which lies on no triangle, is inside what the triangles bound: the sum of the solid angles that they fill (Van Oosterom &
/// Strackee 1983).
fn is_inside(point: DVec3, triangles: impl Iterator<Item = [DVec3; 3]>) -> bool {
    let angle = |corners: [DVec3; 3]| {
        let [a, b, c] = corners.map(|p| p - point);
        let (x, y, z) = (a.length(), b.length(), c.length());
        2.0 * libm::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
    };
    triangles.map(angle).sum::<f64>() > 2.0 * PI
}

/// Joins cells of which two are convex together, again and again until no two are.
fn joined(mut cells: Vec<Piece>, level: f64) -> Vec<Piece> {
    let mut before = cells.len() + 1;
    while cells.len() < before {
        before = cells.len();
        let mut first = 0;
        while first < cells.len() {
            let found = (first + 1..cells.len()).find_map(|second| Some((second, union(&cells[first], &cells[second], level)?)));
            match found {
                Some((second, whole)) => {
                    cells[first] = whole;
                    cells.remove(second);
                }
                None => first += 1,
            }
        }
    }
    cells
}

/// The union of two cells that touch, if it is convex.
fn union(a: &Piece, b: &Piece, level: f64) -> Option<Piece> {
    let around = |cell: &Piece| {
        let points = || cell.points.iter().map(|&p| DVec3::from(p));
        (points().fold(DVec3::INFINITY, DVec3::min), points().fold(DVec3::NEG_INFINITY, DVec3::max))
    };
    let ((low, high), (other_low, other_high)) = (around(a), around(b));
    if (low - other_high).max_element() > level || (other_low - high).max_element() > level {
        return None;
    }
    let whole = hull(&apart(a.points.iter().chain(&b.points).map(|&p| p.into()), level))?;
    (size(&whole) <= (1.0 + VOLUME) * (size(a) + size(b))).then_some(whole)
}
