//! Why a mesh was refused.

use std::fmt;

/// Where in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line, from 1.
    Line(usize),
    /// A byte, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::File => Ok(()),
            Place::Line(line) => write!(f, ":{line}"),
            Place::Byte(byte) => write!(f, ", byte {byte}"),
        }
    }
}

/// A mesh that cannot be read or used: says where, what is wrong, and what would be right. Points and triangles are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// Something in a file.
    #[error("{file}{place}: {message}; {hint}")]
    Read {
        /// The file as it was named.
        file: String,
        /// Where in it.
        place: Place,
        /// What is wrong.
        message: String,
        /// What would be right.
        hint: String,
    },
    /// Nothing to collide with or to weigh.
    #[error("the mesh has no triangles; expected at least one")]
    Empty,
    /// More than can be numbered.
    #[error("{count} {what}; expected at most {most}")]
    TooMany {
        /// How many there are.
        count: usize,
        /// Of what.
        what: &'static str,
        /// How many there may be.
        most: usize,
    },
    /// A corner that is not there.
    #[error("triangle {triangle} names point {point}, and there are {count}, from 0; expected a smaller index")]
    NoSuchPoint {
        /// Which triangle.
        triangle: usize,
        /// What it names.
        point: u32,
        /// How many points there are.
        count: usize,
    },
    /// A point that is nowhere, or so far that moments of inertia overflow.
    #[error("point {point} is at {at:?}; coordinates must be finite, and below 1e60 m")]
    Nowhere {
        /// Which.
        point: usize,
        /// What was given, m.
        at: [f64; 3],
    },
    /// A triangle without an area.
    #[error("triangle {triangle} has no area: its corners {corners:?} lie on a line; leave it out, or move a corner")]
    NoArea {
        /// Which.
        triangle: usize,
        /// Its corners, m.
        corners: [[f64; 3]; 3],
    },
    /// Two points of different names in one place.
    #[error("points {first} and {second} are both at {at:?}; merge them, so that the triangles around them share their edges")]
    SamePoint {
        /// The earlier.
        first: usize,
        /// The later.
        second: usize,
        /// Where, m.
        at: [f64; 3],
    },
    /// Edges of one triangle alone.
    #[error("the mesh is open: {count} edges have a triangle on one side only, the first {}; expected none", Listed(edges))]
    Open {
        /// How many.
        count: usize,
        /// The ends of the first few, m.
        edges: Vec<[[f64; 3]; 2]>,
    },
    /// Edges at which several parts of a body touch.
    #[error(
        "{count} edges have four triangles or more, the first {}; a body needs two at each edge: separate the parts that touch there, \
         or make a body of each",
        Listed(edges)
    )]
    Shared {
        /// How many.
        count: usize,
        /// The ends of the first few, m.
        edges: Vec<[[f64; 3]; 2]>,
    },
    /// Edges of an odd number of triangles above one.
    #[error(
        "{count} edges have three triangles or another odd number, the first {}; expected two, or an even number in a ground",
        Listed(edges)
    )]
    Crowded {
        /// How many.
        count: usize,
        /// The ends of the first few, m.
        edges: Vec<[[f64; 3]; 2]>,
    },
    /// Neighbours that face different sides.
    #[error(
        "{count} edges lie between triangles that face different sides, the first {}; list the corners of all triangles counter-clockwise \
         seen from outside",
        Listed(edges)
    )]
    Inconsistent {
        /// How many.
        count: usize,
        /// The ends of the first few, m.
        edges: Vec<[[f64; 3]; 2]>,
    },
    /// Triangles that go through each other.
    #[error("{count} pairs of triangles cross, the first {pairs:?}; expected a surface that does not cut itself")]
    Crossing {
        /// How many.
        count: usize,
        /// The first few.
        pairs: Vec<[u32; 2]>,
    },
    /// Nothing inside.
    #[error("the mesh bounds a volume of {volume:e} m³ where its surface is {area:e} m²; expected one that has an inside")]
    NoVolume {
        /// m³.
        volume: f64,
        /// m².
        area: f64,
    },
    /// A mesh too thin to be cut.
    #[error(
        "no part of the mesh has a convex hull at a resolution of {resolution}; expected thicker parts, or a finer resolution"
    )]
    NoPieces {
        /// How many cubes lie along the longest side.
        resolution: u32,
    },
    /// A setting out of its range.
    #[error("{what} is {value}; expected {range}")]
    Setting {
        /// Which.
        what: &'static str,
        /// What was given.
        value: f64,
        /// What may be given.
        range: &'static str,
    },
}

impl MeshError {
    pub(crate) fn read(file: &str, place: Place, message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::Read { file: file.to_owned(), place, message: message.into(), hint: hint.into() }
    }
}

/// Edges as they stand in a message.
struct Listed<'a>(&'a [[[f64; 3]; 2]]);

impl fmt::Display for Listed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, [p, q]) in self.0.iter().enumerate() {
            write!(f, "{}from {p:?} to {q:?}", if i == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}
