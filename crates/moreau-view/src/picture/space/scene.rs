//! The picture checked, and its bodies as solids that a view sees.

use super::solid::Solid;
use super::view::View;
use super::{Body, Error, Mesh, Picture, Shape};
use glam::{DMat3, DQuat, DVec3};

/// Polygons that meet at less than this angle are one smooth surface: its cosine.
const SMOOTH: f64 = 0.883;

/// What is computed once for all views.
pub(super) struct Scene {
    /// For each mesh its triangles: three vertices and the normals there.
    meshes: Vec<Vec<[(DVec3, DVec3); 3]>>,
    /// For each mesh the radius of the ball about its origin.
    radii: Vec<f64>,
}

impl Scene {
    pub(super) fn new(picture: &Picture) -> Result<Self, Error> {
        check(picture)?;
        let radius = |m: &Mesh| m.vertices.iter().map(|&v| DVec3::from(v).length()).fold(0.0, f64::max);
        Ok(Self { meshes: picture.meshes.iter().map(triangles).collect(), radii: picture.meshes.iter().map(radius).collect() })
    }

    /// The solids of the bodies for which `wanted`, each with the index of its body.
    pub(super) fn bodies(&self, picture: &Picture, view: &View, wanted: impl Fn(&Body) -> bool) -> Vec<(Solid, u32)> {
        let mut solids = Vec::new();
        for (index, body) in picture.bodies.iter().enumerate().filter(|(_, b)| is_there(b) && wanted(b)) {
            let position = DVec3::from(body.position);
            match body.shape {
                Shape::Ball { radius } => {
                    let radius = (radius * view.scale) as f32;
                    solids.push((Solid::Ball { centre: view.point(position), radius }, index as u32));
                }
                Shape::Mesh(mesh) => {
                    let turn = rotation(body);
                    let seen = |(v, n): (DVec3, DVec3)| (view.point(position + turn * v), view.direction(turn * n));
                    let triangles = self.meshes[mesh].iter().map(|t| t.map(seen));
                    solids.extend(triangles.filter_map(Solid::facing).map(|t| (t, index as u32)));
                }
                Shape::Plane { .. } => {}
            }
        }
        solids
    }

    /// The radius of a ball about a body; none for planes.
    pub(super) fn radius(&self, body: &Body) -> Option<f64> {
        match body.shape {
            Shape::Ball { radius } => Some(radius),
            Shape::Mesh(mesh) => Some(self.radii[mesh]),
            Shape::Plane { .. } => None,
        }
    }
}

/// The solids of the force chains, each with its index.
pub(super) fn chains(picture: &Picture, view: &View) -> Vec<(Solid, u32)> {
    let rod = |(index, chain): (usize, &super::Segment)| {
        let (from, to) = (view.point(chain.from.into()), view.point(chain.to.into()));
        let radius = (chain.radius * view.scale) as f32;
        ((from + to).is_finite() && radius.is_finite()).then_some((Solid::Rod { from, to, radius }, index as u32))
    };
    picture.chains.iter().enumerate().filter_map(rod).collect()
}

/// Whether a body can be drawn at all.
pub(super) fn is_there(body: &Body) -> bool {
    let radius = if let Shape::Ball { radius } = body.shape { radius } else { 0.0 };
    body.position.iter().chain(&body.rotation).chain([&radius]).all(|x| x.is_finite()) && body.opacity > 0.0
}

pub(super) fn rotation(body: &Body) -> DMat3 {
    DMat3::from_quat(DQuat::from_array(body.rotation).normalize())
}

/// An error unless all meshes and vertices are there.
pub(super) fn check(picture: &Picture) -> Result<(), Error> {
    let meshes = picture.meshes.len();
    for (body, b) in picture.bodies.iter().enumerate() {
        if let Shape::Mesh(mesh) = b.shape
            && mesh >= meshes
        {
            return Err(Error::NoMesh { body, mesh, meshes });
        }
    }
    for (mesh, m) in picture.meshes.iter().enumerate() {
        let vertices = m.vertices.len();
        for (polygon, corners) in m.polygons.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v >= vertices) {
                return Err(Error::NoVertex { mesh, polygon, vertex, vertices });
            }
        }
    }
    Ok(())
}

/// The polygons as fans of triangles with normals.
fn triangles(mesh: &Mesh) -> Vec<[(DVec3, DVec3); 3]> {
    let vertex = |v: usize| DVec3::from(mesh.vertices[v]);
    // Twice the area of a polygon, as a vector along its normal.
    let area = |p: &Vec<usize>| -> DVec3 {
        let from = p.first().map_or(DVec3::ZERO, |&v| vertex(v));
        p.windows(2).map(|w| (vertex(w[0]) - from).cross(vertex(w[1]) - from)).sum()
    };
    let areas: Vec<DVec3> = mesh.polygons.iter().map(area).collect();
    let mut around = vec![Vec::new(); mesh.vertices.len()];
    for (polygon, corners) in mesh.polygons.iter().enumerate() {
        corners.iter().for_each(|&v| around[v].push(polygon));
    }
    let corner = |polygon: usize, v: usize| {
        let own = areas[polygon].normalize_or_zero();
        let near = around[v].iter().map(|&p| areas[p]).filter(|a| a.normalize_or_zero().dot(own) > SMOOTH);
        (vertex(v), near.sum::<DVec3>().normalize_or(own))
    };
    let fan = |(polygon, corners): (usize, &Vec<usize>)| {
        let corners: Vec<_> = corners.iter().map(|&v| corner(polygon, v)).collect();
        (2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]]).collect::<Vec<_>>()
    };
    mesh.polygons.iter().enumerate().flat_map(fan).collect()
}
