//! The shapes of space. Lengths in m, volumes in m³.

mod ball;
mod capsule;
mod compound;
mod cuboid;
mod cylinder;
mod faceted;
mod half_space;
mod inertia;
mod polyhedron;
pub(crate) mod revolved;
mod surface;

pub use ball::Ball;
pub use capsule::Capsule;
pub use compound::{Compound, Part};
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use faceted::{Edge, Faceted};
pub use half_space::HalfSpace;
pub use inertia::Moments;
pub use polyhedron::Polyhedron;
pub use surface::Surface;
pub(crate) use surface::{On, is_one};

use super::{Contour, Figure, Placed, Polygons, Shape};
use crate::detect::narrow::solid as pairs;
use crate::space::{Solid, Space};
use moreau_solve::Row;

shapes! {
    /// Any shape of space.
    SolidShape in Solid<3, 6>:
    Ball, "ball", "a ball of given radius";
    Cuboid, "box", "a rectangular box, by its edge lengths";
    Polyhedron, "polyhedron", "a convex polyhedron, by its corners";
    Compound, "compound", "several shapes as one rigid body";
    Capsule, "capsule", "all within a radius of a segment, by radius and length";
    Cylinder, "cylinder", "a circular cylinder, by radius and length";
    HalfSpace, "half_space", "all that lies below a plane: ground or wall, fixed or driven";
    Surface, "mesh", "a surface of triangles, from a file, in place or over a grid of heights; fixed or driven";
}

// Bodies are read by the million, most of them balls: what is larger than a box stands behind an `Arc`.
const _: () = assert!(size_of::<SolidShape>() <= 32);
