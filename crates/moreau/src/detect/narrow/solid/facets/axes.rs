//! The axis that separates two bodies best.

use super::nearest::between_lines;
use super::{Point, Seen, feature};
use crate::detect::narrow::vector::{cross, dot, sub};
use crate::shape::solid::{Edge, Faceted};

/// Part of a gap that rounding may be, with room: what is skipped for it would not have been better.
const NEARLY: f64 = 1e-9;

/// Along which direction two bodies are farthest apart, or overlap least.
pub(super) enum Axis {
    /// The normal of this face of the first body.
    FaceOfFirst(usize),
    /// The normal of this face of the second body.
    FaceOfSecond(usize),
    /// The cross product of two edges, with the point between these, and whether it lies within both.
    Edges(Point, bool),
}

/// Whether two bodies are farther apart than `reach` along the line between their centres, as most are that do not touch. `between` leads
/// from the centre of the first to that of the second.
pub(super) fn are_beyond<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>, between: [f64; 3], reach: f64) -> bool {
    let (end, start) = (support(a.vertices, between), -support(b.vertices, between.map(|x| -x)));
    start - end > reach.max(0.0) * dot(between, between).sqrt()
}

/// The best axis and how far apart the bodies are along it; negative where they overlap. `None` where they are farther apart than `reach`,
/// or nowhere. Of axes that are as good as each other faces come before edges, and those of the first body before those of the second.
pub(super) fn best<A: Faceted, B: Faceted>(
    a: &Seen<'_, A>,
    b: &Seen<'_, B>,
    crossing: &mut Crossing,
    level: f64,
    reach: f64,
) -> Option<(Axis, f64)> {
    let (face_a, apart_a) = farthest(a, b, level, reach)?;
    let (face_b, apart_b) = farthest(b, a, level, reach)?;
    let (mut axis, mut apart) = (Axis::FaceOfFirst(face_a), apart_a);
    if apart_b > apart + level {
        (axis, apart) = (Axis::FaceOfSecond(face_b), apart_b);
    }
    if let Some((point, within)) = edges(a, b, apart, crossing)
        && point.gap > apart + level
    {
        (axis, apart) = (Axis::Edges(point, within), point.gap);
    }
    (apart <= reach).then_some((axis, apart))
}

/// How far points go in a direction, times its length.
fn support(vertices: &[[f64; 3]], direction: [f64; 3]) -> f64 {
    vertices.iter().map(|&vertex| dot(direction, vertex)).fold(f64::NEG_INFINITY, f64::max)
}

/// The face of `body` beyond which `other` is farthest, and how far; of those that are level the first, so that rounding does not choose the normal
/// of bodies that share an edge. `None` if that is beyond `reach`, or nowhere.
fn farthest<A: Faceted, B: Faceted>(body: &Seen<'_, A>, other: &Seen<'_, B>, level: f64, reach: f64) -> Option<(usize, f64)> {
    let mut best = (0, f64::NEG_INFINITY);
    for (face, &normal) in body.normals.iter().enumerate() {
        let corner = body.corner(face, 0);
        let height = |vertex: &[f64; 3]| dot(normal, sub(*vertex, corner));
        let nearest = other.vertices.iter().map(height).fold(f64::INFINITY, |least, x| if least < x { least } else { x });
        // What is nowhere touches nothing.
        if nearest.is_nan() || nearest > reach {
            return None;
        }
        if nearest > best.1 + level {
            best = (face, nearest);
        }
    }
    Some(best)
}

/// The edges of a body whose arcs, from the normal of one of their faces to that of the other, cross the plane across an edge of another one,
/// by their numbers: few of all.
#[derive(Default)]
pub(super) struct Crossing {
    /// How far on one side of that plane the normals are, times the length of the edge.
    sides: Vec<f64>,
    edges: Vec<u16>,
}

impl Crossing {
    fn find<F: Faceted>(&mut self, body: &Seen<'_, F>, along: [f64; 3]) {
        self.sides.clear();
        self.sides.extend(body.normals.iter().map(|&normal| dot(normal, along)));
        self.edges.clear();
        let across = |edge: &Edge| self.sides[usize::from(edge.faces[0])] * self.sides[usize::from(edge.faces[1])] < 0.0;
        self.edges.extend((0..).zip(body.body.edges()).filter(|(_, edge)| across(edge)).map(|(j, _)| j));
    }
}

/// The two edges that separate best and more than `floor`, with the point between them. Their normals are a face of the Minkowski difference only where the
/// arcs between the normals of their faces cross (Gregorius 2013).
fn edges<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>, floor: f64, crossing: &mut Crossing) -> Option<(Point, bool)> {
    let mut best: Option<(Point, bool)> = None;
    let mut least = floor;
    let mut line = None;
    for (i, edge_a) in a.body.edges().iter().enumerate() {
        let [p, q] = a.ends(edge_a);
        let [n, m] = edge_a.faces.map(|face| a.normals[usize::from(face)]);
        let along_a = sub(q, p);
        // Of two edges on one line, as a triangle has them, the same cross.
        if line != Some([edge_a.ends[1], edge_a.ends[0]]) {
            crossing.find(b, along_a);
        }
        line = Some(edge_a.ends);
        for &j in &crossing.edges {
            let j = usize::from(j);
            let edge_b = &b.body.edges()[j];
            let [left, right] = edge_b.faces.map(usize::from);
            let [r, s] = b.ends(edge_b);
            let along_b = sub(s, r);
            if dot(n, along_b) * dot(m, along_b) >= 0.0 {
                continue;
            }
            // Of the two points where the planes meet on the sphere both arcs must go through the same one.
            let across = cross(along_a, along_b);
            if dot(across, sum(n, m)) * dot(across, sum(b.normals[left], b.normals[right])) >= 0.0 {
                continue;
            }
            // Outward of the first body: the normals of both its faces are on that side. Most are not as far apart as the best, which takes
            // no more than a square root to see.
            let outward = 1.0_f64.copysign(dot(across, sum(n, m)));
            if outward * dot(across, sub(r, p)) < (least - NEARLY * least.abs()) * dot(across, across).sqrt() {
                continue;
            }
            let Some((normal, at, within)) = between_lines([p, along_a], [r, along_b], across) else { continue };
            let normal = normal.map(|x| outward * x);
            let point = Point { feature: feature(2, i, j), at, normal, gap: dot(normal, sub(r, p)) };
            if point.gap > least {
                (best, least) = (Some((point, within)), point.gap);
            }
        }
    }
    best
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + b[k])
}
