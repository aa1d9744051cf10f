//! Pairs of shapes in space.

mod ball_ball;
mod ball_half_space;
mod box_ball;
mod box_box;
mod box_half_space;
mod compound;
mod facets;
mod polyhedron_box;
mod polyhedron_half_space;
mod polyhedron_polyhedron;

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
    Polyhedron, HalfSpace => polyhedron_half_space;
    Polyhedron, Cuboid => polyhedron_box;
    Polyhedron, Polyhedron => polyhedron_polyhedron;
    (parts of Compound) => compound;
}

#[cfg(test)]
mod tests;
