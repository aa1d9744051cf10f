//! Files.

pub mod vtk;
pub mod whole;
