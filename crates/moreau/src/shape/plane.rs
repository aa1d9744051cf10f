//! The shapes of the plane. Lengths in m, areas in m²; masses are kg per metre of depth where densities are kg/m³.

mod disk;
mod half_plane;
mod polygon;

pub use disk::Disk;
pub use half_plane::HalfPlane;
pub use polygon::{Polygon, Side};

use super::{Figure, Placed, Shape};
use crate::detect::narrow::plane as pairs;
use crate::space::{Plane, Space};
use moreau_solve::Row;

shapes! {
    /// Any shape of the plane.
    PlaneShape in Plane<2, 3>:
    Disk, "disk", "a disk of given radius";
    Polygon, "polygon", "a convex polygon, by its vertices";
    HalfPlane, "half_plane", "all that lies below a line: ground or wall, fixed or driven";
}
