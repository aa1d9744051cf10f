//! What a scene makes differently in the plane and in space: shapes, orientations and velocities.

use super::shape::{PartSpec, ShapeSpec};
use super::triangles::{self, Shaped};
use super::values::{Angular, Numbers, Orientation, Turn};
use crate::shape::plane::{Disk, HalfPlane, Polygon, Polyline, decompose};
use crate::shape::solid::{Ball, Cuboid, Cylinder, HalfSpace, Polyhedron};
use crate::shape::{PlaneShape, ShapeError, plane, solid};
use crate::space::{Plane, Pose, Solid, Space};
use glam::{DQuat, DVec3};

/// Turns what a scene says into the terms of one dimension. Only scenes that passed the checks come here.
pub(super) trait SceneSpace<const D: usize, const N: usize>: Space<D, N> {
    /// A shape in its place: where its centre of mass is and how its principal frame is turned; `None` for one of the other
    /// dimension.
    fn place(spec: &ShapeSpec, position: [f64; D], rotation: Self::Rotation) -> Option<Placed<Self, D, N>>;

    /// A shape of triangles in its place, or what is wrong with it; nothing for other shapes.
    fn of_triangles(_: &ShapeSpec, _: [f64; D], _: Self::Rotation) -> Option<Result<Placed<Self, D, N>, String>> {
        None
    }

    /// A ball or a disk.
    fn round(radius: f64) -> Self::Shape;

    /// A half-space or half-plane with a normal of length 1 through `position`.
    fn wall(position: [f64; D], normal: [f64; D]) -> Placed<Self, D, N>;

    /// The orientation that a scene gives.
    fn rotation(orientation: Option<&Orientation>) -> Self::Rotation;

    /// A velocity of the centre of mass and a spin or a force and a torque, both in the world frame, as one vector.
    fn join(linear: [f64; D], angular: Option<&Angular>) -> [f64; N];
}

/// A shape and where it is.
pub(super) type Placed<S, const D: usize, const N: usize> = (<S as Space<D, N>>::Shape, Pose<<S as Space<D, N>>::Rotation, D>);

/// A velocity with its spin in the world frame, as the body with this orientation has it: spins live in the body's own frame.
pub(super) fn velocity_in_body<S: Space<D, N>, const D: usize, const N: usize>(
    rotation: S::Rotation,
    world: &[f64; N],
) -> [f64; N] {
    // Velocities and loads split alike: the first part in the world, the second in the body.
    S::load_in_body(rotation, world)
}

/// A vector of the scene; an empty one is zero.
pub(super) fn vector<const D: usize>(numbers: &[f64]) -> [f64; D] {
    std::array::from_fn(|k| numbers.get(k).copied().unwrap_or(0.0))
}

/// The vector of length 1 along `v`.
pub(super) fn unit<const D: usize>(v: [f64; D]) -> [f64; D] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

/// A shape of the plane whose coordinates' origin is at `position`, by its centre of mass in these coordinates.
fn around(shape: PlaneShape, centre: [f64; 2], position: [f64; 2], rotation: [f64; 2]) -> Placed<Plane, 2, 3> {
    let [x, y] = Plane::rotate(rotation, centre);
    (shape, Pose { position: [position[0] + x, position[1] + y], rotation })
}

/// The parts of a compound in its coordinates; nothing where a part has no shape of the dimension.
fn parts<S: SceneSpace<D, N>, const D: usize, const N: usize>(parts: &[PartSpec]) -> Option<Vec<Placed<S, D, N>>> {
    parts.iter().map(|part| S::place(&part.shape, vector(&part.position), S::rotation(part.orientation.as_ref()))).collect()
}

/// The compound of these parts and its centre of mass, or why there is none; nothing where a part has no shape of the plane.
pub(super) fn plane_compound(specs: &[PartSpec]) -> Option<Result<(plane::Compound, [f64; 2]), ShapeError>> {
    Some(plane::Compound::new(parts::<Plane, 2, 3>(specs)?))
}

/// The compound of these parts and its own frame, or why there is none; nothing where a part has no shape of space.
pub(super) fn solid_compound(specs: &[PartSpec]) -> Option<Result<(solid::Compound, Pose<DQuat, 3>), ShapeError>> {
    Some(solid::Compound::new(parts::<Solid, 3, 6>(specs)?))
}

/// Points of the scene as points.
pub(super) fn points(numbers: &[Numbers<2>]) -> Vec<[f64; 2]> {
    numbers.iter().map(|point| point.0).collect()
}

impl SceneSpace<2, 3> for Plane {
    fn place(spec: &ShapeSpec, position: [f64; 2], rotation: [f64; 2]) -> Option<Placed<Self, 2, 3>> {
        match spec {
            ShapeSpec::Disk { radius } => Some((Self::round(*radius), Pose { position, rotation })),
            ShapeSpec::HalfPlane { normal: Numbers(normal) } => Some(Self::wall(position, unit(*normal))),
            ShapeSpec::Box { size } => {
                let &[width, height] = size.as_slice() else { return None };
                Some((Polygon::rectangle(width, height).ok()?.into(), Pose { position, rotation }))
            }
            ShapeSpec::Capsule { radius, length } => {
                Some((plane::Capsule::new(*radius, *length).ok()?.into(), Pose { position, rotation }))
            }
            ShapeSpec::Polygon { vertices, decompose: concave, .. } => {
                let vertices = points(vertices);
                let polygon = || Polygon::new(vertices.clone()).map(|(polygon, centre)| (polygon.into(), centre));
                let (shape, centre) = if *concave { decompose(vertices.clone()) } else { polygon() }.ok()?;
                Some(around(shape, centre, position, rotation))
            }
            ShapeSpec::Polyline { points: chain, closed, .. } => {
                Some((Polyline::new(&points(chain), *closed).ok()?.into(), Pose { position, rotation }))
            }
            ShapeSpec::Compound { parts } => {
                let (shape, centre) = plane_compound(parts)?.ok()?;
                Some(around(shape.into(), centre, position, rotation))
            }
            _ => None,
        }
    }

    fn round(radius: f64) -> Self::Shape {
        Disk { radius }.into()
    }

    fn wall(position: [f64; 2], [x, y]: [f64; 2]) -> Placed<Self, 2, 3> {
        // The rotation that takes (0, 1) to the normal.
        (HalfPlane.into(), Pose { position, rotation: [y, -x] })
    }

    fn rotation(orientation: Option<&Orientation>) -> [f64; 2] {
        match orientation {
            Some(Orientation::Angle(angle)) => [libm::cos(*angle), libm::sin(*angle)],
            Some(Orientation::Turn(turn)) => {
                let (sine, cosine) = sin_cos(turn, 1.0);
                [cosine, sine]
            }
            Some(Orientation::Quaternion(_)) | None => Self::IDENTITY,
        }
    }

    fn join([x, y]: [f64; 2], angular: Option<&Angular>) -> [f64; 3] {
        [x, y, if let Some(Angular::Plane(spin)) = angular { *spin } else { 0.0 }]
    }
}

/// Where a body is whose corners have their own coordinates, and in these its own frame.
fn placed(corners: Pose<DQuat, 3>, own: Pose<DQuat, 3>) -> Pose<DQuat, 3> {
    let position = DVec3::from(corners.position) + corners.rotation * DVec3::from(own.position);
    Pose { position: position.into(), rotation: (corners.rotation * own.rotation).normalize() }
}

impl SceneSpace<3, 6> for Solid {
    fn place(spec: &ShapeSpec, position: [f64; 3], rotation: DQuat) -> Option<Placed<Self, 3, 6>> {
        match spec {
            ShapeSpec::Ball { radius } => Some((Self::round(*radius), Pose { position, rotation })),
            ShapeSpec::Box { size } => {
                let &[x, y, z] = size.as_slice() else { return None };
                Some((Cuboid { half: [0.5 * x, 0.5 * y, 0.5 * z] }.into(), Pose { position, rotation }))
            }
            ShapeSpec::Polyhedron { points, flat, .. } => {
                let points: Vec<_> = points.iter().map(|point| point.0).collect();
                let (shape, own) = Polyhedron::hull_within(&points, flat.unwrap_or(ShapeSpec::FLAT)).ok()?;
                Some((shape.into(), placed(Pose { position, rotation }, own)))
            }
            ShapeSpec::Compound { parts } => {
                let (shape, own) = solid_compound(parts)?.ok()?;
                Some((shape.into(), placed(Pose { position, rotation }, own)))
            }
            ShapeSpec::Capsule { radius, length } => {
                Some((solid::Capsule { radius: *radius, half: 0.5 * length }.into(), Pose { position, rotation }))
            }
            ShapeSpec::Cylinder { radius, length } => {
                Some((Cylinder { radius: *radius, half: 0.5 * length }.into(), Pose { position, rotation }))
            }
            ShapeSpec::HalfSpace { normal: Numbers(normal) } => Some(Self::wall(position, unit(*normal))),
            _ => None,
        }
    }

    fn of_triangles(spec: &ShapeSpec, position: [f64; 3], rotation: DQuat) -> Option<Result<Placed<Self, 3, 6>, String>> {
        let shape = triangles::shape(spec)?;
        Some(shape.map(|(shape, own): Shaped| (shape, placed(Pose { position, rotation }, own))))
    }

    fn round(radius: f64) -> Self::Shape {
        Ball { radius }.into()
    }

    fn wall(position: [f64; 3], normal: [f64; 3]) -> Placed<Self, 3, 6> {
        (HalfSpace.into(), Pose { position, rotation: DQuat::from_rotation_arc(DVec3::Z, normal.into()) })
    }

    fn rotation(orientation: Option<&Orientation>) -> DQuat {
        match orientation {
            Some(Orientation::Quaternion(q)) => {
                q.as_slice().try_into().map_or(DQuat::IDENTITY, |q: [f64; 4]| DQuat::from_array(q).normalize())
            }
            Some(Orientation::Turn(turn)) => {
                let (sine, cosine) = sin_cos(turn, 0.5);
                let [x, y, z] = unit(turn.axis.map_or([0.0, 0.0, 1.0], |axis| axis.0)).map(|x| sine * x);
                DQuat::from_xyzw(x, y, z, cosine)
            }
            Some(Orientation::Angle(_)) | None => DQuat::IDENTITY,
        }
    }

    fn join([x, y, z]: [f64; 3], angular: Option<&Angular>) -> [f64; 6] {
        let [a, b, c] = match angular {
            Some(Angular::Solid(v)) => v.as_slice().try_into().unwrap_or([0.0; 3]),
            _ => [0.0; 3],
        };
        [x, y, z, a, b, c]
    }
}

/// Sine and cosine of a part of a turn's angle; whole quarter turns in degrees are exact.
fn sin_cos(turn: &Turn, part: f64) -> (f64, f64) {
    let Some(degrees) = turn.degrees else { return libm::sincos(part * turn.angle.unwrap_or(0.0)) };
    let degrees = (part * degrees) % 360.0;
    match degrees {
        0.0 => (0.0, 1.0),
        90.0 | -270.0 => (1.0, 0.0),
        180.0 | -180.0 => (0.0, -1.0),
        270.0 | -90.0 => (-1.0, 0.0),
        _ => libm::sincos(degrees.to_radians()),
    }
}
