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
    /// A notch.
    #[error("the boundary turns inwards at vertex {vertex}; leave it out, or cut the polygon into convex ones")]
    NotConvex {
        /// Where.
        vertex: usize,
    },
    /// Too few points for a body in space.
    #[error("{count} points; a polyhedron needs at least 4")]
    TooFewPoints {
        /// How many were given.
        count: usize,
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
    /// No parts, or more than contacts can number.
    #[error("a compound of {count} parts; expected 1 to {most}")]
    Parts {
        /// How many there are.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// A part that is unbounded, concave or of parts itself.
    #[error("part {index} is a {name}; parts are bounded, convex, and not of parts themselves")]
    Part {
        /// Which part, from 0.
        index: usize,
        /// The name of its shape.
        name: &'static str,
    },
    /// More corners than contacts can number.
    #[error("{count} corners; a convex polyhedron may have {most}")]
    TooManyVertices {
        /// How many there are.
        count: usize,
        /// How many there may be.
        most: usize,
    },
}

/// The length, if it is one.
pub(super) fn length(what: &'static str, value: f64) -> Result<f64, ShapeError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(ShapeError::Length { what, value }) }
}
