//! Which triangle lies beyond each edge of each triangle.

use super::vector::{cross, dot, length, sub, twice_area};
use super::{Mesh, MeshError};

/// In place of a triangle where there is none.
pub(crate) const NONE: u32 = u32::MAX;

/// How many edges or pairs an error lists.
pub(super) const LISTED: usize = 3;

/// In place of a triangle beyond an edge at which two triangles face each other without anything between: nothing can touch them there.
pub(crate) const HIDDEN: u32 = u32::MAX - 1;

/// The angle (rad) below which two triangles at an edge lie on each other.
const SAME_ANGLE: f64 = 1e-7;

/// The neighbours of each triangle: beyond edge `k`, which runs from corner `k` to the next, or [`NONE`], or [`HIDDEN`].
///
/// Where an edge has four triangles or more, parts of the solid touch each other there. The neighbour of a triangle is then the one that its
/// front sees, with nothing but air between.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Edges {
    pub(crate) beyond: Vec<[u32; 3]>,
    /// Edges of one triangle alone, as (triangle, edge).
    pub(super) open: Vec<(u32, usize)>,
    /// Edges of four triangles or more, as (triangle, edge) of one of them.
    pub(super) shared: Vec<(u32, usize)>,
}

/// One side of an edge: its ends by number, the lower first, whether the triangle runs from the lower to the higher, and the triangle.
type Side = ([u32; 2], bool, u32, usize);

impl Edges {
    /// Finds the neighbours of a mesh whose corners exist.
    ///
    /// # Errors
    /// Edges with an odd number of triangles above one, then those around which triangles do not face each other.
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
        let mut edges = Self { beyond: vec![[NONE; 3]; mesh.triangles.len()], open: Vec::new(), shared: Vec::new() };
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            match group {
                [one] => edges.open.push((one.2, one.3)),
                [one, other] if one.1 == other.1 => inconsistent.push(one),
                [one, other] => edges.join(one, other, false),
                _ if group.len() % 2 == 1 => crowded.push(&group[0]),
                _ => match around(mesh, group) {
                    Some(pairs) => {
                        pairs.iter().for_each(|(one, other, hidden)| edges.join(one, other, *hidden));
                        edges.shared.push((group[0].2, group[0].3));
                    }
                    None => inconsistent.push(&group[0]),
                },
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
        edges.shared.sort_unstable();
        Ok(edges)
    }

    /// True for each triangle of a plane region that another region faces without anything between: the faces in which two parts of a solid touch.
    /// All edges around such a region are [`HIDDEN`].
    pub(crate) fn covered(&self, mesh: &Mesh) -> Vec<bool> {
        let mut covered = vec![false; self.beyond.len()];
        let mut seen = covered.clone();
        let is_one = |beyond: &u32| *beyond != HIDDEN && *beyond != NONE;
        for first in 0..self.beyond.len() {
            if seen[first] || !self.beyond[first].contains(&HIDDEN) {
                continue;
            }
            seen[first] = true;
            let (mut region, mut next) = (vec![first], 0);
            while let Some(&triangle) = region.get(next) {
                next += 1;
                for &other in self.beyond[triangle].iter().filter(|beyond| is_one(beyond)) {
                    if !std::mem::replace(&mut seen[other as usize], true) {
                        region.push(other as usize);
                    }
                }
            }
            let normal = |triangle: usize| twice_area(mesh.corners(triangle));
            let own = normal(first);
            let is_plane = |&triangle: &usize| {
                let other = normal(triangle);
                dot(own, other) > 0.0 && length(cross(own, other)) <= SAME_ANGLE * length(own) * length(other)
            };
            let is_open = region.iter().any(|&triangle| self.beyond[triangle].contains(&NONE));
            if !is_open && region.iter().all(is_plane) {
                region.iter().for_each(|&triangle| covered[triangle] = true);
            }
        }
        covered
    }

    fn join(&mut self, one: &Side, other: &Side, hidden: bool) {
        self.beyond[one.2 as usize][one.3] = if hidden { HIDDEN } else { other.2 };
        self.beyond[other.2 as usize][other.3] = if hidden { HIDDEN } else { one.2 };
    }
}

/// Pairs the triangles around an edge that see each other across air, and says of each pair whether its triangles lie on each other.
/// Returns nothing if fronts and backs do not alternate around the edge.
///
/// Triangles are sorted by the angle around the edge, seen along it from its lower point. A triangle that runs along the edge has its front
/// towards larger angles: air begins there. Between triangles at the same angle the order is free, and the one that alternates counts.
fn around<'a>(mesh: &Mesh, group: &'a [Side]) -> Option<Vec<(&'a Side, &'a Side, bool)>> {
    let [from, to] = group[0].0.map(|point| mesh.points[point as usize]);
    let axis = sub(to, from);
    let across = |side: &Side| {
        let tip = sub(mesh.points[mesh.triangles[side.2 as usize][(side.3 + 2) % 3] as usize], from);
        let along = dot(tip, axis) / dot(axis, axis);
        [0, 1, 2].map(|k| tip[k] - along * axis[k])
    };
    let first = across(&group[0]);
    let second = cross(axis, first);
    let turn = length(axis);
    let angle = |side: &Side| {
        let way = across(side);
        let angle = libm::atan2(dot(way, second) / turn, dot(way, first));
        // Rounding puts what lies on the first one on either side of it.
        if angle < -SAME_ANGLE { angle + std::f64::consts::TAU } else { angle }
    };
    let mut sorted: Vec<(f64, &Side)> = group.iter().map(|side| (angle(side), side)).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(b.1)));
    let mut levels: Vec<Vec<(f64, &Side)>> = sorted.chunk_by(|a, b| b.0 - a.0 <= SAME_ANGLE).map(<[_]>::to_vec).collect();
    let opens = |side: &Side| side.1;
    let excess = |level: &[(f64, &Side)]| level.iter().map(|(_, side)| if opens(side) { 1 } else { -1_i32 }).sum::<i32>();
    // A level with one more of a kind begins with that kind.
    let begin = levels.iter().position(|level| excess(level) != 0).unwrap_or(0);
    levels.rotate_left(begin);
    let mut air_begins = excess(&levels[0]) >= 0;
    let mut order: Vec<(usize, &Side)> = Vec::with_capacity(group.len());
    for (number, level) in levels.iter_mut().enumerate() {
        while !level.is_empty() {
            let next = level.iter().position(|(_, side)| opens(side) == air_begins)?;
            order.push((number, level.remove(next).1));
            air_begins = !air_begins;
        }
    }
    if opens(order[0].1) == opens(order[order.len() - 1].1) {
        return None;
    }
    if !opens(order[0].1) {
        order.rotate_left(1);
    }
    Some(order.chunks_exact(2).map(|pair| (pair[0].1, pair[1].1, pair[0].0 == pair[1].0)).collect())
}
