//! Triangles that go through each other.
//!
//! Two triangles cross where an edge of one goes through the inside of the other: its ends lie on different sides of the plane, and it
//! passes all three edges of the other on the same side, by signed volumes (Guigue & Devillers 2003). Triangles that touch, that share an
//! edge, or that lie in one plane are left alone.

use super::edges::LISTED;
use super::vector::{cross, dot, length, sub};
use super::{Aabb, Mesh, MeshError, Tree};

/// Of the product of the lengths that make a signed volume: below it rounding decides the sign, and nothing crosses.
const ROUNDING: f64 = 1e-12;

pub(super) fn check(mesh: &Mesh) -> Result<(), MeshError> {
    let boxes: Vec<Aabb> = (0..mesh.triangles.len()).map(|i| Aabb::around(mesh.corners(i))).collect();
    let tree = Tree::new(boxes.iter().copied());
    let mut pairs = Vec::new();
    let mut count = 0;
    for (i, around) in boxes.iter().enumerate() {
        tree.meeting(around, |j| {
            if (j as usize) > i && cross_each_other(mesh, [i, j as usize]) {
                count += 1;
                if pairs.len() < LISTED {
                    pairs.push([i as u32, j]);
                }
            }
        });
    }
    if count == 0 { Ok(()) } else { Err(MeshError::Crossing { count, pairs }) }
}

fn cross_each_other(mesh: &Mesh, [i, j]: [usize; 2]) -> bool {
    let (a, b) = (mesh.triangles[i], mesh.triangles[j]);
    let shared = |point: &u32| b.contains(point);
    if a.iter().filter(|point| shared(point)).count() > 1 {
        return false;
    }
    let goes_through = |edges: [u32; 3], other: [u32; 3]| {
        (0..3).map(|k| [edges[k], edges[(k + 1) % 3]]).any(|edge| {
            // An edge that ends at a corner of the other triangle touches it there.
            !edge.iter().any(|point| other.contains(point)) && pierces(edge.map(|p| at(mesh, p)), other.map(|p| at(mesh, p)))
        })
    };
    goes_through(a, b) || goes_through(b, a)
}

fn at(mesh: &Mesh, point: u32) -> [f64; 3] {
    mesh.points[point as usize]
}

/// Whether the segment goes through the inside of the triangle.
fn pierces([p, q]: [[f64; 3]; 2], [a, b, c]: [[f64; 3]; 3]) -> bool {
    if side(a, b, c, p) * side(a, b, c, q) >= 0.0 {
        return false;
    }
    let turns = [side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)];
    turns.iter().all(|&turn| turn > 0.0) || turns.iter().all(|&turn| turn < 0.0)
}

/// The sign of the volume of a tetrahedron; 0 where it is flat but for rounding.
fn side(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> f64 {
    let (u, v, w) = (sub(b, a), sub(c, a), sub(d, a));
    let volume = dot(cross(u, v), w);
    if volume.abs() > ROUNDING * length(u) * length(v) * length(w) { volume.signum() } else { 0.0 }
}
