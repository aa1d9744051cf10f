//! What scenes call shapes.

use super::values::{Numbers, Orientation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The form of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ShapeSpec {
    /// A ball; in space.
    Ball {
        /// Its radius, m.
        radius: f64,
    },
    /// A box, in the plane a rectangle.
    Box {
        /// The lengths of its edges along its own axes, m: two in the plane, three in space.
        #[schemars(length(min = 2, max = 3))]
        size: Vec<f64>,
    },
    /// A convex polyhedron; in space. The body is the convex hull of its points.
    Polyhedron {
        /// Its corners in any order, m.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        points: Vec<Numbers<3>>,
        /// In place of `points` a mesh that has them, .stl, .obj, .ply, .gltf or .glb, beside the scene.
        file: Option<String>,
        /// By what the coordinates of the file are multiplied, such as 0.001 for a file in mm; default 1.
        scale: Option<f64>,
        /// By which part of the size points may miss a face and lie on it; default 1e-9, for files, which have few digits, 1e-6.
        flat: Option<f64>,
    },
    /// A circular cylinder, its axis along its own z axis; in space.
    Cylinder {
        /// Its radius, m.
        radius: f64,
        /// Its length from cap to cap, m.
        length: f64,
    },
    /// Everything below a plane; in space.
    HalfSpace {
        /// The direction out of it, of any length.
        normal: Numbers<3>,
    },
    /// Triangles; in space. They are a surface with the solid behind their fronts, fixed or driven; or, with `decompose`, the boundary of a body
    /// that is held together from convex pieces.
    Mesh {
        /// The points, m.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        points: Vec<Numbers<3>>,
        /// Three of the points for each triangle, by number from 0, counter-clockwise seen from the front.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        triangles: Vec<[u32; 3]>,
        /// In place of `points` and `triangles` a file that has them, .stl, .obj, .ply, .gltf or .glb, beside the scene. All its objects are
        /// one mesh; to make a body of each, see `import`.
        file: Option<String>,
        /// By what the coordinates of the file are multiplied, such as 0.001 for a file in mm; default 1.
        scale: Option<f64>,
        /// Whether it bounds a body: closed, it is cut into convex pieces, with the mass of what it bounds.
        #[serde(default, skip_serializing_if = "is_false")]
        decompose: bool,
        /// With `decompose`: by which part of the whole volume a piece may fail to be convex; default 0.01.
        concavity: Option<f64>,
    },
    /// A surface over a rectangular grid, with the solid below; in space, fixed or driven. Each cell is two triangles, cut from its corner of
    /// lowest x and y to that of highest.
    HeightField {
        /// The distance of neighbours along x and along y, m.
        spacing: Numbers<2>,
        /// Heights, m, rows of one length: along a row x grows, from row to row y.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        heights: Vec<Vec<f64>>,
        /// In place of `heights` a table of them, beside the scene: a row a line, with commas or blanks between; `#` begins a comment.
        file: Option<String>,
        /// Where the first height stands; default the body's position.
        origin: Option<Numbers<3>>,
    },
    /// A disk; in the plane.
    Disk {
        /// Its radius, m.
        radius: f64,
    },
    /// All points within a radius of a segment around the centre, which in the plane is of the x axis and in space of the z axis.
    Capsule {
        /// The radius, m.
        radius: f64,
        /// The length of the segment, m; the whole is longer by twice the radius.
        length: f64,
    },
    /// A polygon; in the plane. It must be convex, or else cut into convex pieces.
    Polygon {
        /// Its vertices in order around it, m.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        vertices: Vec<Numbers<2>>,
        /// In place of `vertices` a table of them, CSV, beside the scene: a row `x,y` a vertex, in m; `#` begins a comment. For a file of
        /// several polygons see `import`.
        file: Option<String>,
        /// Whether it may be concave: it is then a compound of convex pieces, with the mass of the whole.
        #[serde(default, skip_serializing_if = "is_false")]
        decompose: bool,
    },
    /// A chain of segments, fixed or driven; in the plane. It is solid to the right of the way along it: a ground by points from left to
    /// right has its solid below.
    Polyline {
        /// Its points in order, m.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        points: Vec<Numbers<2>>,
        /// In place of `points` a table of them, CSV, beside the scene: a row `x,y` a point, in m; `#` begins a comment.
        file: Option<String>,
        /// Whether a last segment goes back to the first point. Clockwise it is an island, counter-clockwise a vessel.
        #[serde(default, skip_serializing_if = "is_false")]
        closed: bool,
    },
    /// Several convex shapes held together. Mass, centre and moments of inertia are the sums of the parts', so that where
    /// parts overlap their mass counts as often as they do.
    Compound {
        /// The parts, at most 1024.
        parts: Vec<PartSpec>,
    },
    /// Everything below a line; in the plane.
    HalfPlane {
        /// The direction out of it, of any length.
        normal: Numbers<2>,
    },
}

impl ShapeSpec {
    /// The convex hull of these points.
    pub(super) fn polyhedron(points: impl IntoIterator<Item = [f64; 3]>) -> Self {
        ShapeSpec::Polyhedron { points: points.into_iter().map(Numbers).collect(), file: None, scale: None, flat: None }
    }

    /// By which part of the size points may miss a face of a polyhedron if a scene does not say.
    pub(super) const FLAT: f64 = 1e-9;

    /// The same for points from a file.
    pub(super) const FLAT_IN_FILES: f64 = 1e-6;

    /// Its name in scene files.
    pub fn name(&self) -> &'static str {
        match self {
            ShapeSpec::Ball { .. } => "ball",
            ShapeSpec::Box { .. } => "box",
            ShapeSpec::Polyhedron { .. } => "polyhedron",
            ShapeSpec::Cylinder { .. } => "cylinder",
            ShapeSpec::HalfSpace { .. } => "half_space",
            ShapeSpec::Mesh { .. } => "mesh",
            ShapeSpec::HeightField { .. } => "height_field",
            ShapeSpec::Disk { .. } => "disk",
            ShapeSpec::Capsule { .. } => "capsule",
            ShapeSpec::Polygon { .. } => "polygon",
            ShapeSpec::Polyline { .. } => "polyline",
            ShapeSpec::Compound { .. } => "compound",
            ShapeSpec::HalfPlane { .. } => "half_plane",
        }
    }

    /// The numbers of coordinates that it can live in.
    pub fn dimensions(&self) -> &'static [usize] {
        match self {
            ShapeSpec::Box { .. } | ShapeSpec::Capsule { .. } | ShapeSpec::Compound { .. } => &[2, 3],
            ShapeSpec::Disk { .. } | ShapeSpec::Polygon { .. } | ShapeSpec::HalfPlane { .. } | ShapeSpec::Polyline { .. } => &[2],
            _ => &[3],
        }
    }

    /// Whether it has a mass; what has no end or no inside has none, and can only be fixed or driven.
    pub fn has_mass(&self) -> bool {
        !match self {
            ShapeSpec::Mesh { decompose, .. } => !decompose,
            ShapeSpec::Polyline { .. } | ShapeSpec::HeightField { .. } => true,
            _ => self.has_normal(),
        }
    }

    /// True if it is a concave mesh that is cut into convex pieces.
    pub(super) fn is_cut(&self) -> bool {
        matches!(self, ShapeSpec::Mesh { decompose: true, .. })
    }

    /// Whether a normal says how it is turned.
    pub fn has_normal(&self) -> bool {
        matches!(self, ShapeSpec::HalfSpace { .. } | ShapeSpec::HalfPlane { .. })
    }
}

/// A part of a compound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartSpec {
    /// Its form, one that could be a free body's.
    pub shape: ShapeSpec,
    /// Where it is in the compound's coordinates, m; default their origin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub position: Vec<f64>,
    /// How it is turned there.
    pub orientation: Option<Orientation>,
}

/// Whether a value is left out when a scene is written.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks by reference")]
pub(super) fn is_false(value: &bool) -> bool {
    !value
}
