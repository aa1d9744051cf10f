//! Pairs of shapes in the plane.

mod capsule_disk;
mod capsule_half_plane;
mod core;
mod disk_disk;
mod disk_half_plane;
mod facing;
mod polygon_disk;
mod polygon_half_plane;
mod polyline;

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
    Polygon, Polygon => facing;
    Polygon, Capsule => facing;
    Capsule, Capsule => facing;
    Capsule, Disk => capsule_disk;
    Capsule, HalfPlane => capsule_half_plane;
    Polyline, Disk => polyline;
    Polyline, Polygon => polyline;
    Polyline, Capsule => polyline;
    (parts of Compound);
}

#[cfg(test)]
mod tests;
