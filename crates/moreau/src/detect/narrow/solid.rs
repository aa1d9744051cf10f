//! Pairs of shapes in space.

mod ball_ball;
#[cfg_attr(not(test), allow(dead_code, reason = "boxes have a shorter way of their own"))]
mod ball_facets;
mod ball_half_space;
mod box_ball;
mod box_box;
mod box_half_space;
mod capsule_ball;
mod capsule_capsule;
mod capsule_facets;
mod capsule_half_space;
mod curved;
mod cylinder_ball;
mod cylinder_capsule;
mod cylinder_cylinder;
mod cylinder_facets;
mod cylinder_half_space;
mod facets;
mod polyhedron_box;
mod polyhedron_half_space;
mod polyhedron_polyhedron;
mod spread;
mod surface;

use crate::shape::{Placed, SolidShape};
use crate::space::{Solid, Space};

/// Where a body of space is.
type Pose = crate::space::Pose<<Solid as Space<3, 6>>::Rotation, 3>;

pairs! {
    SolidShape in Solid<3, 6>:
    Ball, Ball => ball_ball;
    Ball, HalfSpace => ball_half_space;
    Cuboid, HalfSpace => box_half_space;
    Cuboid, Ball => box_ball;
    Cuboid, Cuboid => box_box;
    Capsule, Ball => capsule_ball;
    Capsule, HalfSpace => capsule_half_space;
    Capsule, Capsule => capsule_capsule;
    Capsule, Cuboid => capsule_facets;
    Cylinder, Ball => cylinder_ball;
    Cylinder, HalfSpace => cylinder_half_space;
    Cylinder, Capsule => cylinder_capsule;
    Cylinder, Cylinder => cylinder_cylinder;
    Cylinder, Cuboid => cylinder_facets;
    Ball, Polyhedron => ball_facets;
    Capsule, Polyhedron => capsule_facets;
    Cylinder, Polyhedron => cylinder_facets;
    Polyhedron, HalfSpace => polyhedron_half_space;
    Polyhedron, Cuboid => polyhedron_box;
    Polyhedron, Polyhedron => polyhedron_polyhedron;
    Surface, Ball => surface;
    Surface, Cuboid => surface;
    Surface, Polyhedron => surface;
    Surface, Capsule => surface;
    Surface, Cylinder => surface;
    (parts of Compound);
}

#[cfg(test)]
mod tests;
