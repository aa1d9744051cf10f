//! Surfaces of triangles: ground, terrain, machines.

use crate::detect::narrow::vector::{along, cross, dot, sub};
use crate::mesh::{Aabb, Edges, HIDDEN, Mesh, MeshError, NONE, Tree};
use crate::shape::{Contour, Figure, Polygons, SAME};
use crate::space::Solid;
use std::fmt;
use std::sync::Arc;

/// By how much (sine) directions may differ and count as one: rounding of normals must not decide.
const ALONG: f64 = 1e-7;

/// How far (sine) the normal of a contact on an edge may be from square to it: a face that lies nearly along the edge touches it.
const SQUARE: f64 = 0.1;

/// A surface of triangles, for fixed and driven bodies: it has no mass. The solid lies behind the triangles' fronts, from which their corners
/// are counter-clockwise; the surface need not be closed. The body's frame is that of the points. Copies share their triangles.
#[derive(Clone, PartialEq)]
pub struct Surface(Arc<Parts>);

#[derive(PartialEq)]
struct Parts {
    mesh: Mesh,
    /// Unit normals of the triangles.
    normals: Vec<[f64; 3]>,
    /// Which triangle lies beyond each edge.
    beyond: Vec<[u32; 3]>,
    /// The other ends of all edges at each point: those of point `i` stand from `starts[i]` to `starts[i + 1]`.
    starts: Vec<u32>,
    ends: Vec<u32>,
    /// Normals of the triangles at each point, weighted by their angles there, of no particular length: whatever is nearest to that point is
    /// in front of the surface where it is on this side of it (Baerentzen & Aanaes 2005).
    sides: Vec<[f64; 3]>,
    tree: Tree,
    radius: f64,
}

/// Where on a triangle a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum On {
    /// Inside.
    Face,
    /// On the edge from this corner to the next.
    Edge(usize),
    /// At this corner.
    Corner(usize),
    /// Not on it.
    Off,
}

impl Surface {
    /// The surface of a mesh. Faces in which two parts of the solid touch are no part of it: nothing reaches them.
    ///
    /// # Errors
    /// Corners that do not exist or are nowhere, triangles without an area, edges with an odd number of triangles above one, neighbours that
    /// face different sides.
    pub fn new(mut mesh: Mesh) -> Result<Self, MeshError> {
        mesh.check()?;
        let mut edges = Edges::of(&mesh)?;
        let covered = edges.covered(&mesh);
        if covered.contains(&true) && covered.contains(&false) {
            let mut number = 0;
            mesh.triangles.retain(|_| {
                number += 1;
                !covered[number - 1]
            });
            edges = Edges::of(&mesh)?;
        }
        let beyond = edges.beyond;
        let count = mesh.triangles.len();
        let normals: Vec<[f64; 3]> = (0..count).map(|i| normal(mesh.corners(i))).collect();
        let (starts, ends) = spokes(&mesh);
        let mut sides = vec![[0.0; 3]; mesh.points.len()];
        for (i, triangle) in mesh.triangles.iter().enumerate() {
            let corners = mesh.corners(i);
            for k in 0..3 {
                let side = &mut sides[triangle[k] as usize];
                *side = along(*side, angle(corners, k), normals[i]);
            }
        }
        let tree = Tree::new((0..count).map(|i| Aabb::around(mesh.corners(i))));
        let square = mesh.triangles.iter().flatten().map(|&p| mesh.points[p as usize]).map(|p| dot(p, p)).fold(0.0, f64::max);
        Ok(Self(Arc::new(Parts { mesh, normals, beyond, starts, ends, sides, tree, radius: square.sqrt() })))
    }

    /// Its points and triangles.
    pub fn mesh(&self) -> &Mesh {
        &self.0.mesh
    }

    pub(crate) fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.0.mesh.corners(triangle)
    }

    pub(crate) fn normal(&self, triangle: usize) -> [f64; 3] {
        self.0.normals[triangle]
    }

    /// Hands over the triangles whose boxes meet this one.
    pub(crate) fn near(&self, around: &Aabb, found: impl FnMut(u32)) {
        self.0.tree.meeting(around, found);
    }

    /// Where on a triangle a point is, but for `level` (m).
    pub(crate) fn place(&self, triangle: usize, point: [f64; 3], level: f64) -> On {
        let (corners, normal) = (self.corners(triangle), self.normal(triangle));
        let near = |a: [f64; 3], b: [f64; 3]| dot(sub(a, b), sub(a, b)) <= level * level;
        if let Some(k) = (0..3).find(|&k| near(corners[k], point)) {
            return On::Corner(k);
        }
        let mut on = On::Face;
        for k in 0..3 {
            let way = sub(corners[(k + 1) % 3], corners[k]);
            let outside = dot(cross(way, normal), sub(point, corners[k])) / dot(way, way).sqrt();
            if outside > level {
                return On::Off;
            }
            if outside >= -level {
                on = On::Edge(k);
            }
        }
        on
    }

    /// Whether a direction is that of the triangle's front.
    pub(crate) fn is_front(&self, triangle: usize, direction: [f64; 3]) -> bool {
        is_one(self.normal(triangle), direction)
    }

    /// Whether the surface bends at this place of a triangle: inside it, and between triangles of one plane, it does not.
    pub(crate) fn is_flat(&self, triangle: usize, on: On) -> bool {
        let normal = self.normal(triangle);
        match on {
            On::Face => true,
            On::Edge(k) => self.other(triangle, k).is_some_and(|other| is_one(normal, other)),
            On::Corner(k) => {
                let side = self.0.sides[self.0.mesh.triangles[triangle][k] as usize];
                let length = dot(side, side).sqrt();
                is_one(normal, side.map(|x| x / length))
            }
            On::Off => false,
        }
    }

    /// Whether the surface can touch something at this place with this normal (unit, outward): whether it is in the cone of normals there.
    ///
    /// On an edge that is so where no way into either triangle has a part along the normal and the normal is on the front's side: between
    /// the triangles' normals where the edge is convex, nowhere where it is flat or concave. At a corner no edge may lead along the normal.
    pub(crate) fn admits(&self, triangle: usize, on: On, direction: [f64; 3]) -> bool {
        let normal = self.normal(triangle);
        match on {
            On::Face | On::Off => false,
            // Between triangles of one plane only their normal, which is that of the front.
            On::Edge(_) if self.is_flat(triangle, on) => false,
            On::Edge(k) if self.0.beyond[triangle][k] == HIDDEN => false,
            On::Edge(k) => {
                let corners = self.corners(triangle);
                let way = unit(sub(corners[(k + 1) % 3], corners[k]));
                let out = |normal: [f64; 3]| dot(direction, cross(way, normal));
                let (ours, theirs) = match self.other(triangle, k) {
                    Some(other) => (out(normal), -out(other)),
                    None => (out(normal), 0.0),
                };
                let front = along(normal, 1.0, self.other(triangle, k).unwrap_or([0.0; 3]));
                ours >= -ALONG && theirs >= -ALONG && dot(direction, front) >= -ALONG && dot(direction, way).abs() <= SQUARE
            }
            On::Corner(k) => {
                let point = self.0.mesh.triangles[triangle][k] as usize;
                let at = self.0.mesh.points[point];
                let ends = &self.0.ends[self.0.starts[point] as usize..self.0.starts[point + 1] as usize];
                ends.iter().all(|&end| dot(direction, unit(sub(self.0.mesh.points[end as usize], at))) <= ALONG)
                    && dot(direction, self.0.sides[point]) >= 0.0
            }
        }
    }

    /// The normal of the triangle beyond edge `k`.
    fn other(&self, triangle: usize, k: usize) -> Option<[f64; 3]> {
        let other = self.0.beyond[triangle][k];
        (other != NONE && other != HIDDEN).then(|| self.normal(other as usize))
    }
}

impl fmt::Debug for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Parts { mesh, radius, .. } = &*self.0;
        write!(f, "Surface of {} triangles within {radius} m", mesh.triangles.len())
    }
}

impl Figure<Solid, 3, 6> for Surface {
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.0.radius)
    }

    fn is_convex(&self) -> bool {
        false
    }

    fn contour(&self, at: [f64; 3], outward: [f64; 3], piece: usize) -> Contour<3> {
        if piece >= self.0.normals.len() || self.is_front(piece, outward) {
            return Contour::Flat { at, outward };
        }
        let corners = self.corners(piece);
        let size = (0..3).map(|k| dot(sub(corners[k], corners[0]), sub(corners[k], corners[0]))).fold(0.0, f64::max).sqrt();
        match self.place(piece, at, SAME * size) {
            On::Edge(k) => Contour::Line { at, way: unit(sub(corners[(k + 1) % 3], corners[k])), radius: 0.0 },
            On::Face | On::Corner(_) | On::Off => Contour::corner(at),
        }
    }

    fn polygons(&self) -> Polygons<3> {
        let Mesh { points, triangles } = &self.0.mesh;
        let mut all = Polygons::on(points.clone());
        triangles.iter().for_each(|corners| all.push(corners.map(|corner| corner as usize)));
        all
    }

    fn mass(&self, _: f64) -> [f64; 6] {
        [f64::INFINITY; 6]
    }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

fn normal([p, q, r]: [[f64; 3]; 3]) -> [f64; 3] {
    unit(cross(sub(q, p), sub(r, p)))
}

/// Whether two unit vectors are the same but for rounding.
pub(crate) fn is_one(a: [f64; 3], b: [f64; 3]) -> bool {
    let between = sub(a, b);
    dot(between, between) <= ALONG * ALONG
}

/// The angle of a triangle at corner `k`, rad.
fn angle(corners: [[f64; 3]; 3], k: usize) -> f64 {
    let (u, v) = (sub(corners[(k + 1) % 3], corners[k]), sub(corners[(k + 2) % 3], corners[k]));
    let across = cross(u, v);
    libm::atan2(dot(across, across).sqrt(), dot(u, v))
}

/// The other ends of the edges at each point, each once.
fn spokes(mesh: &Mesh) -> (Vec<u32>, Vec<u32>) {
    let mut spokes: Vec<[u32; 2]> = Vec::with_capacity(6 * mesh.triangles.len());
    for &[a, b, c] in &mesh.triangles {
        spokes.extend([[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]]);
    }
    spokes.sort_unstable();
    spokes.dedup();
    let mut starts = vec![0; mesh.points.len() + 1];
    spokes.iter().for_each(|spoke| starts[spoke[0] as usize + 1] += 1);
    for i in 1..starts.len() {
        starts[i] += starts[i - 1];
    }
    (starts, spokes.into_iter().map(|spoke| spoke[1]).collect())
}
