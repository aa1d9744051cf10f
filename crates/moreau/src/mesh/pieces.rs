//! Convex pieces of a concave mesh.
//!
//! A mesh of few faces is cut along their planes, exactly (`exact`). Otherwise the volume is filled with cubes, and cut along planes of these until each part is convex but for a tolerance (V-HACD, Mamou 2016, as
//! parry has it). A piece is the hull of the surface within its part, so that pieces keep to the surface and not to the cubes. They cover
//! the volume but for what the tolerance lets a hull bridge. The mass is the mesh's, not theirs.

mod exact;

use super::{Closed, MeshError, moments_of};
use glam::DVec3;
use parry3d_f64::transformation::try_convex_hull;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

/// How finely a mesh is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutting {
    /// How many cubes lie along the longest side, 2 to 512.
    pub resolution: u32,
    /// By how much of the whole volume a piece may fail to be convex, 0 to 1.
    pub concavity: f64,
    /// The most pieces, 1 to 4096.
    pub most: u32,
}

impl Default for Cutting {
    fn default() -> Self {
        Self { resolution: 64, concavity: 0.01, most: 64 }
    }
}

/// A convex piece: the corners of its hull, and the triangles of that, facing outward.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// m.
    pub points: Vec<[f64; 3]>,
    /// Indices of points, from 0.
    pub triangles: Vec<[u32; 3]>,
}

impl Closed {
    /// Cuts the mesh into convex pieces; a mesh that fails to be convex by less than the tolerance is left whole. Parts so thin that they have no
    /// hull are left out.
    ///
    /// # Errors
    /// A setting out of its range, or a mesh all of whose parts are that thin.
    pub fn pieces(&self, cutting: Cutting) -> Result<Vec<Piece>, MeshError> {
        check(cutting)?;
        let mesh = self.mesh();
        let points: Vec<DVec3> = mesh.points.iter().map(|&p| p.into()).collect();
        let whole: Vec<DVec3> = mesh.triangles.iter().flatten().map(|&i| points[i as usize]).collect();
        if let Some(whole) = hull(&whole)
            && moments_of(&whole.points, &whole.triangles).volume <= (1.0 + cutting.concavity) * self.mass().volume
        {
            return Ok(vec![whole]);
        }
        if let Some(pieces) = exact::pieces(mesh, self.mass().volume, cutting.most as usize) {
            return Ok(pieces);
        }
        let parameters = VHACDParameters {
            resolution: cutting.resolution,
            concavity: cutting.concavity,
            max_convex_hulls: cutting.most,
            // The tolerance is measured on hulls of all cubes; those of a part of them fall short of it, and a box would be cut.
            convex_hull_downsampling: 1,
            ..VHACDParameters::default()
        };
        let cut = VHACD::decompose(&parameters, &points, &mesh.triangles, true);
        let parts = cut.voxel_parts().iter().map(|part| part.compute_primitive_intersections(&points, &mesh.triangles));
        let pieces: Vec<Piece> = parts.filter_map(|part| hull(&part)).collect();
        if pieces.is_empty() { Err(MeshError::NoPieces { resolution: cutting.resolution }) } else { Ok(pieces) }
    }
}

fn hull(points: &[DVec3]) -> Option<Piece> {
    let (points, triangles) = try_convex_hull(points).ok()?;
    Some(Piece { points: points.iter().map(DVec3::to_array).collect(), triangles })
}

fn check(cutting: Cutting) -> Result<(), MeshError> {
    let Cutting { resolution, concavity, most } = cutting;
    let wrong = |what, value, range| Err(MeshError::Setting { what, value, range });
    match cutting {
        _ if !(2..=512).contains(&resolution) => wrong("resolution", f64::from(resolution), "a whole number from 2 to 512"),
        _ if !(0.0..=1.0).contains(&concavity) => wrong("concavity", concavity, "a number from 0 to 1"),
        _ if !(1..=4096).contains(&most) => wrong("most", f64::from(most), "a whole number from 1 to 4096"),
        _ => Ok(()),
    }
}
