//! The convex hull of points as a polyhedron with flat faces of any number of corners, by gift wrapping (Chand & Kapur 1970).
//!
//! A face is a plane with all points behind it: its corners are the hull, in the plane, of the points that lie in it to within ε. Over each of
//! its edges the plane is turned until it meets points again, and these are on the next face. What deviates from a plane by rounding is so
//! never split into slivers, whose normals would be noise. A library's hull in triangles was tried: it lost the thickness of most plates of 1 to
//! 1000 (see the tests), which are stones as others are.

use crate::mesh::Mesh;
use crate::shape::ShapeError;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Largest coordinate whose fifth power, as in a moment of inertia, is far from overflow, m.
const FARTHEST: f64 = 1e50;

/// By how much ε may be made wider, by factors of ten, for points that are flat to a part of it only.
const WIDER: i32 = 3;

/// Vertices, and faces by their corners.
type Faces = (Vec<[f64; 3]>, Vec<Vec<u16>>);

/// Vertices of the hull and its faces, counter-clockwise seen from outside. Of the size, `flat` is what may deviate from a plane.
pub(super) fn hull(points: &[[f64; 3]], flat: f64) -> Result<Faces, ShapeError> {
    if points.len() < 4 {
        return Err(ShapeError::TooFewPoints { what: "polyhedron", count: points.len(), least: 4 });
    }
    if let Some(vertex) = points.iter().position(|p| !p.iter().all(|x| x.abs() < FARTHEST)) {
        let [x, y, z] = points[vertex];
        return Err(ShapeError::NotFinitePoint { vertex, x, y, z });
    }
    let points = &each_once(points, flat);
    // About the first point, so that bodies far from the origin lose nothing.
    let origin = DVec3::from(points[0]);
    let near: Vec<DVec3> = points.iter().map(|&p| DVec3::from(p) - origin).collect();
    let size = near.iter().map(|p| p.length()).fold(0.0, f64::max);
    check_volume(&near, size, flat)?;
    let tries = (0..=WIDER).map(|i| flat * 10.0_f64.powi(i) * size);
    let faces = tries.map(|eps| Wrap::new(&near, eps).faces()).find_map(|faces| faces).ok_or(ShapeError::NoHull)?;
    let used: BTreeSet<usize> = faces.iter().flatten().copied().collect();
    let place: BTreeMap<usize, u16> = used.iter().copied().zip(0..).collect();
    if used.len() > usize::from(u16::MAX) {
        return Err(ShapeError::TooMany { what: "corners of a polyhedron", count: used.len(), most: usize::from(u16::MAX) });
    }
    let faces = faces.iter().map(|face| face.iter().map(|i| place[i]).collect()).collect();
    Ok((used.into_iter().map(|i| points[i]).collect(), faces))
}

/// Points that are farther from each other than ε; of those that are nearer the first. Files name corners once for each face.
fn each_once(points: &[[f64; 3]], flat: f64) -> Vec<[f64; 3]> {
    let extent = |k: usize| points.iter().map(|p| (p[k] - points[0][k]).abs()).fold(0.0, f64::max);
    let soup = Mesh { points: points.to_vec(), triangles: Vec::new() };
    soup.merged(flat * (0..3).map(extent).fold(0.0, f64::max)).points
}

/// Refuses points that lie in one point, on one line or in one plane.
fn check_volume(points: &[DVec3], size: f64, flat: f64) -> Result<(), ShapeError> {
    let farthest = |of: &dyn Fn(DVec3) -> f64| {
        points.iter().map(|&p| (of(p), p)).fold((0.0, DVec3::ZERO), |best, next| if next.0 > best.0 { next } else { best })
    };
    let along = farthest(&|p| p.length()).1.normalize_or_zero();
    let (width, beside) = farthest(&|p| (p - along * along.dot(p)).length());
    let across = along.cross(beside).normalize_or_zero();
    let (height, _) = farthest(&|p| across.dot(p).abs());
    // The last condition is for bodies so small that their moments underflow.
    if !(width > flat * size && height > flat * size && width * height * size * size * size > f64::MIN_POSITIVE) {
        return Err(ShapeError::NoVolume);
    }
    Ok(())
}

struct Wrap<'a> {
    points: &'a [DVec3],
    /// What may deviate from a plane or a line, m.
    eps: f64,
}

impl<'a> Wrap<'a> {
    fn new(points: &'a [DVec3], eps: f64) -> Self {
        Self { points, eps }
    }

    /// All faces; `None` where ε does not tell apart what is one face and what two.
    fn faces(&self) -> Option<Vec<Vec<usize>>> {
        let mut faces: Vec<Vec<usize>> = Vec::new();
        let mut sides: BTreeSet<(usize, usize)> = BTreeSet::new();
        let mut open = VecDeque::from([self.first()?]);
        while let Some((from, to, normal)) = open.pop_front() {
            if sides.contains(&(from, to)) {
                continue;
            }
            let (face, normal) = self.face(from, normal)?;
            let over = |p: &DVec3| normal.dot(*p - self.points[face[0]]);
            if !has_side(&face, (from, to)) || self.points.iter().any(|p| over(p) > 4.0 * self.eps) {
                return None;
            }
            for k in 0..face.len() {
                let (p, q) = (face[k], face[(k + 1) % face.len()]);
                if !sides.insert((p, q)) {
                    return None;
                }
                if !sides.contains(&(q, p)) {
                    open.push_back((q, p, self.over(p, q, normal)?));
                }
            }
            faces.push(face);
        }
        let closed = sides.iter().all(|&(p, q)| sides.contains(&(q, p)));
        let corners: BTreeSet<usize> = faces.iter().flatten().copied().collect();
        // Euler's formula: one surface without holes.
        (closed && corners.len() + faces.len() == sides.len() / 2 + 2).then_some(faces)
    }

    /// A side of some face, and the normal of that face: a plane that touches the points from below is turned about a horizontal line, then
    /// about the edge that it meets.
    fn first(&self) -> Option<(usize, usize, DVec3)> {
        let key = |i: &usize| self.points[*i].to_array();
        let lowest = (0..self.points.len()).min_by(|i, j| key(i).partial_cmp(&key(j)).unwrap_or(std::cmp::Ordering::Equal))?;
        let normal = self.turned(lowest, DVec3::Z, -DVec3::X)?;
        // Of the points in that plane an edge, from the lowest point to where all others are to its left.
        let (face, normal) = self.face(lowest, normal).or_else(|| self.edge(lowest, normal))?;
        if face.len() > 2 {
            return Some((face[0], face[1], normal));
        }
        let normal = self.over(face[1], face[0], normal)?;
        let (face, normal) = self.face(face[0], normal)?;
        Some((face[0], face[1], normal))
    }

    /// Two ends of the points in a plane that all lie on a line.
    fn edge(&self, from: usize, normal: DVec3) -> Option<(Vec<usize>, DVec3)> {
        let far = |p: usize| (self.points[p] - self.points[from]).length();
        let flat = self.within(from, normal);
        let one = flat.iter().copied().max_by(|&i, &j| far(i).total_cmp(&far(j)))?;
        let apart = |p: usize| (self.points[p] - self.points[one]).length();
        let two = flat.iter().copied().max_by(|&i, &j| apart(i).total_cmp(&apart(j)))?;
        (apart(two) > self.eps).then(|| (vec![one, two], normal))
    }

    /// Points in the plane through a point.
    fn within(&self, from: usize, normal: DVec3) -> Vec<usize> {
        (0..self.points.len()).filter(|&i| normal.dot(self.points[i] - self.points[from]).abs() <= self.eps).collect()
    }

    /// The face in the plane through a point, counter-clockwise, with its normal from its own corners; `None` where it has no width.
    fn face(&self, from: usize, normal: DVec3) -> Option<(Vec<usize>, DVec3)> {
        let s = normal.any_orthonormal_vector();
        let t = normal.cross(s);
        let flat = |i: usize| (s.dot(self.points[i] - self.points[from]), t.dot(self.points[i] - self.points[from]));
        let mut within = self.within(from, normal);
        within.sort_by(|&i, &j| flat(i).partial_cmp(&flat(j)).unwrap_or(std::cmp::Ordering::Equal));
        let mut face = half(&within, &flat, self.eps);
        within.reverse();
        let back = half(&within, &flat, self.eps);
        face.pop();
        face.extend_from_slice(&back[..back.len().checked_sub(1)?]);
        let face = self.without_straight(face);
        if face.len() < 3 {
            return None;
        }
        let at = |k: usize| self.points[face[k]];
        let area: DVec3 = (1..face.len() - 1).map(|k| (at(k) - at(0)).cross(at(k + 1) - at(0))).sum();
        Some((face, area.normalize()))
    }

    /// Drops corners that lie on the line between their neighbours to within ε, and all but one of those in one place.
    fn without_straight(&self, mut face: Vec<usize>) -> Vec<usize> {
        let mut k = 0;
        while face.len() > 2 && k < face.len() {
            let (p, q, r) = (face[(k + face.len() - 1) % face.len()], face[k], face[(k + 1) % face.len()]);
            let (before, after) = (self.points[q] - self.points[p], self.points[r] - self.points[p]);
            let off = before.cross(after).length();
            if before.length() <= self.eps || off <= self.eps * after.length() {
                face.remove(k);
                k = 0;
            } else {
                k += 1;
            }
        }
        face
    }

    /// The normal of the face on the other side of the edge from p to q of the face with this normal.
    fn over(&self, p: usize, q: usize, normal: DVec3) -> Option<DVec3> {
        self.turned(p, (self.points[p] - self.points[q]).normalize_or_zero(), normal)
    }

    /// The plane through a point along an axis, with all points behind it, turned about the axis until it meets others: its normal. The axis
    /// runs so that the new face has its inside to the left.
    fn turned(&self, from: usize, axis: DVec3, normal: DVec3) -> Option<DVec3> {
        // Seen along the axis: `out` lies in the old plane and leads away from the old face, `up` is the old normal.
        let (out, up) = (normal.cross(axis).normalize_or_zero(), normal);
        let seen = |i: usize| {
            let way = self.points[i] - self.points[from];
            (-out.dot(way), -up.dot(way))
        };
        // Largest angle from the old face through the inside; of equal ones the farthest.
        let mut best: Option<(f64, f64)> = None;
        for (x, depth) in (0..self.points.len()).map(seen) {
            let far = libm::hypot(x, depth);
            if far <= self.eps || (depth <= self.eps && x > -self.eps) {
                continue;
            }
            let farther = |(bx, bd): (f64, f64)| {
                let side = bx * depth - x * bd;
                let level = self.eps * libm::hypot(bx, bd).max(far) * 1e-3;
                side > level || (side > -level && far > libm::hypot(bx, bd))
            };
            if best.is_none_or(farther) {
                best = Some((x, depth));
            }
        }
        let (x, depth) = best?;
        // Perpendicular to the way to that point, away from the inside.
        Some((out * depth - up * x).normalize_or_zero()).filter(|n| n.is_finite() && *n != DVec3::ZERO)
    }
}

fn has_side(face: &[usize], (from, to): (usize, usize)) -> bool {
    (0..face.len()).any(|k| face[k] == from && face[(k + 1) % face.len()] == to)
}

/// The right-turning half of the hull of points in order (Andrew 1979): from the first to the last, with all others to the left.
fn half(sorted: &[usize], flat: &impl Fn(usize) -> (f64, f64), eps: f64) -> Vec<usize> {
    let mut chain: Vec<usize> = Vec::new();
    for &i in sorted {
        while let [.., p, q] = chain[..] {
            let ((px, py), (qx, qy), (rx, ry)) = (flat(p), flat(q), flat(i));
            let turn = (qx - px) * (ry - py) - (qy - py) * (rx - px);
            if turn > eps * eps {
                break;
            }
            chain.pop();
        }
        chain.push(i);
    }
    chain
}
