//! The shapes of the plane. Lengths in m, areas in m²; masses are kg per metre of depth where densities are kg/m³.

mod boundary;
mod capsule;
mod compound;
mod decompose;
mod disk;
mod half_plane;
mod polygon;
mod polyline;

pub use boundary::Side;
pub use capsule::Capsule;
pub use compound::{Compound, Part};
pub use decompose::decompose;
pub use disk::Disk;
pub use half_plane::HalfPlane;
pub use polygon::Polygon;
pub use polyline::{Bend, Joint, Polyline, Segment};

use super::{Contour, Figure, Placed, Polygons, Shape};
use crate::detect::narrow::plane as pairs;
use crate::space::{Plane, Space};
use moreau_solve::Row;

shapes! {
    /// Any shape of the plane.
    PlaneShape in Plane<2, 3>:
    Disk, "disk", "a disk of given radius";
    Polygon, "polygon", "a polygon by its vertices, of which a box is one";
    Capsule, "capsule", "all points within a radius of a segment of the x axis";
    Compound, "compound", "several convex shapes held together";
    HalfPlane, "half_plane", "all that lies below a line: ground or wall, fixed or driven";
    Polyline, "polyline", "a chain of segments, solid on its right-hand side: ground or wall, fixed or driven";
}
