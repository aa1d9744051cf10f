//! Pairs of shapes in the plane.

mod disk_disk;
mod disk_half_plane;
mod polygon_disk;
mod polygon_half_plane;
mod polygon_polygon;

use crate::shape::{Placed, PlaneShape};
use crate::space::{Plane, Space};

/// Where a body of the plane is.
type Pose = crate::space::Pose<<Plane as Space<2, 3>>::Rotation, 2>;

pairs! {
    PlaneShape in Plane<2, 3>:
    Disk, Disk => disk_disk;
    Disk, HalfPlane => disk_half_plane;
    Polygon, HalfPlane => polygon_half_plane;
    Polygon, Disk => polygon_disk;
    Polygon, Polygon => polygon_polygon;
}

#[cfg(test)]
mod tests;
