//! Why a shape was refused.

/// A shape that cannot be: says where, and what would be right. Vertices and edges are counted from 0, in the order given; edge
/// `i` runs from vertex `i` to the next.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// A length that is not one.
    #[error("{what} is {value} m; it must be positive and finite")]
    Length {
        /// Which length.
        what: &'static str,
        /// What was given, m.
        value: f64,
    },
    /// A polygon without an inside.
    #[error("a polygon of {count} vertices; it needs at least 3")]
    TooFewVertices {
        /// How many were given.
        count: usize,
    },
    /// A vertex that is nowhere, or so far that moments of inertia overflow.
    #[error("vertex {vertex} is at ({x}, {y}); coordinates must be finite, and below 1e70 m")]
    NotFinite {
        /// Which vertex.
        vertex: usize,
        /// What was given, m.
        x: f64,
        /// What was given, m.
        y: f64,
    },
    /// Two vertices in one place.
    #[error("vertices {first} and {second} are the same point; name each vertex once, and do not repeat the first at the end")]
    RepeatedVertex {
        /// The earlier.
        first: usize,
        /// The later.
        second: usize,
    },
    /// All vertices on a line.
    #[error(
        "the polygon has no area: vertex {vertex} is the farthest from vertex 0, and all others lie on the line between them"
    )]
    NoArea {
        /// The vertex farthest from the first.
        vertex: usize,
    },
    /// Edges that cross or touch.
    #[error("edges {first} and {second} meet; list the vertices in order around the boundary")]
    SelfIntersecting {
        /// The earlier edge.
        first: usize,
        /// The later edge.
        second: usize,
    },
    /// A way that goes back along itself.
    #[error("the way turns back on itself at vertex {vertex}; leave out what is gone along twice")]
    TurnsBack {
        /// Where.
        vertex: usize,
    },
    /// A chain without a segment, or a polyhedron without an inside.
    #[error("a {what} of {count} points; it needs at least {least}")]
    TooFewPoints {
        /// Of what.
        what: &'static str,
        /// How many were given.
        count: usize,
        /// How many it needs.
        least: usize,
    },
    /// More parts or segments than a contact can name.
    #[error("{count} {what}; there can be at most {most}")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many were given.
        count: usize,
        /// The most that there can be.
        most: usize,
    },
    /// A compound of nothing.
    #[error("a compound without parts; it needs at least 1")]
    NoParts,
    /// A part that is no single convex figure.
    #[error("part {part} is a {name}; parts are single, bounded, convex shapes")]
    NotAPart {
        /// Which part.
        part: usize,
        /// Its shape.
        name: &'static str,
    },
    /// A concave polygon that rounding leaves no place to cut.
    #[error("the polygon cannot be cut into convex ones at vertex {vertex}: edges are nearer there than rounding can tell")]
    NotCut {
        /// Where.
        vertex: usize,
    },
    /// A notch.
    #[error(
        "the boundary turns inwards at vertex {vertex}; leave it out, or cut the polygon into convex ones with decompose = true"
    )]
    NotConvex {
        /// Where.
        vertex: usize,
    },
    /// A point of space that is nowhere, or so far that moments of inertia overflow.
    #[error("point {vertex} is at ({x}, {y}, {z}); coordinates must be finite, and below 1e50 m")]
    NotFinitePoint {
        /// Which point.
        vertex: usize,
        /// What was given, m.
        x: f64,
        /// What was given, m.
        y: f64,
        /// What was given, m.
        z: f64,
    },
    /// All points in one plane, or so near to one that they are no body.
    #[error("the points lie in one plane to within rounding; a polyhedron needs a volume")]
    NoVolume,
    /// Points of which a hull cannot be told from rounding.
    #[error(
        "no convex polyhedron can be told from these points: some are nearer to each other, or to a common plane, than a millionth of the size"
    )]
    NoHull,
}

impl ShapeError {
    /// The vertex at which it is wrong; of an edge or of two vertices the later.
    pub fn vertex(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { vertex, .. }
            | Self::NotFinitePoint { vertex, .. }
            | Self::NoArea { vertex }
            | Self::NotConvex { vertex }
            | Self::TurnsBack { vertex }
            | Self::NotCut { vertex } => Some(vertex),
            Self::RepeatedVertex { first, second } | Self::SelfIntersecting { first, second } => Some(first.max(second)),
            Self::NoVolume
            | Self::NoHull
            | Self::Length { .. }
            | Self::TooFewVertices { .. }
            | Self::TooFewPoints { .. }
            | Self::TooMany { .. }
            | Self::NoParts
            | Self::NotAPart { .. } => None,
        }
    }
}

/// The length, if it is one.
pub(super) fn length(what: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(ShapeError::Length { what, value }) }
}
