//! Polygons close, and hold the volume of the shape.

use super::*;
use crate::shape::plane::{Disk, Polygon};
use crate::shape::solid::{Ball, Compound, Cuboid, Polyhedron, revolved};
use crate::shape::{PlaneShape, Shape, SolidShape};
use glam::{DQuat, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Volume by the divergence theorem: a sixth of each triangle of the fans of all faces, with the origin. Every edge must be passed as often
/// one way as the other.
fn volume(polygons: &Polygons<3>) -> f64 {
    let mut edges = BTreeMap::new();
    let at = |i: usize| DVec3::from(polygons.vertices[i]);
    let mut six = 0.0;
    for face in polygons.iter() {
        for k in 0..face.len() {
            let (start, end) = (face[k], face[(k + 1) % face.len()]);
            *edges.entry((start.min(end), start.max(end))).or_insert(0) += if start < end { 1 } else { -1 };
        }
        six += (2..face.len()).map(|k| at(face[0]).dot(at(face[k - 1]).cross(at(face[k])))).sum::<f64>();
    }
    assert!(edges.values().all(|&passed| passed == 0), "an open edge");
    six / 6.0
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-13 * expected, "{found} is not {expected}");
}

#[test]
fn flat_shapes_are_enclosed_exactly() {
    let cuboid = SolidShape::from(Cuboid::new([1.0, 2.0, 3.0]).unwrap());
    close(volume(&cuboid.polygons()), 6.0);
    // Corners spread over a ball.
    let corner = |i: i32| {
        let (up, turn) = (1.0 - (2.0 * f64::from(i) + 1.0) / 800.0, 2.4 * f64::from(i));
        [(1.0 - up * up).sqrt() * turn.cos(), (1.0 - up * up).sqrt() * turn.sin(), up]
    };
    let points: Vec<[f64; 3]> = (0..800).map(corner).collect();
    let (polyhedron, own) = Polyhedron::hull(&points).unwrap();
    close(volume(&SolidShape::from(polyhedron.clone()).polygons()), polyhedron.volume());
    let parts = vec![
        (cuboid.clone(), Pose { position: [5.0, 0.0, 0.0], rotation: DQuat::from_rotation_x(1.0) }),
        (polyhedron.into(), own),
    ];
    let compound = SolidShape::from(Compound::new(parts).unwrap().0);
    close(volume(&compound.polygons()), compound.mass(1.0)[0]);
}

#[test]
fn round_shapes_are_enclosed_by_their_chords() {
    // A 24-gon in place of a circle, and frusta between thirteen heights.
    let of_circle = 24.0 * (PI / 12.0).sin() / (2.0 * PI);
    let [radius, height] = [0.7, 1.9];
    let cylinder = revolved::revolved([[radius, -0.5 * height], [radius, 0.5 * height]]);
    assert_eq!(cylinder.iter().len(), 24 + 2);
    close(volume(&cylinder), of_circle * PI * radius * radius * height);
    let slices: f64 = (0..12)
        .map(|i| {
            let at = |i: usize| (PI * i as f64 / 12.0).sin_cos();
            let ((r, z), (s, w)) = (at(i), at(i + 1));
            of_circle * PI / 3.0 * (z - w) * (r * r + r * s + s * s)
        })
        .sum();
    let ball = SolidShape::from(Ball::new(2.0).unwrap());
    close(volume(&ball.polygons()), 8.0 * slices);
    // What is drawn is smaller by less than three parts in a hundred.
    assert!((0.97..1.0).contains(&(8.0 * slices / ball.mass(1.0)[0])));
    // A capsule: half a ball, a cylinder, half a ball.
    let capsule = revolved::revolved(revolved::arc(1.0, -0.5, 0..=6).chain(revolved::arc(1.0, 0.5, 6..=12)));
    close(volume(&capsule), slices + of_circle * PI);
}

#[test]
fn shapes_of_the_plane_are_one_loop_counter_clockwise() {
    let area = |shape: PlaneShape| {
        let polygons = shape.polygons();
        assert_eq!(polygons.iter().len(), 1);
        let v = |i: usize| polygons.vertices[i % polygons.vertices.len()];
        assert!(polygons.iter().next().unwrap().iter().copied().eq(0..polygons.vertices.len()));
        (0..polygons.vertices.len()).map(|i| 0.5 * (v(i)[0] * v(i + 1)[1] - v(i)[1] * v(i + 1)[0])).sum::<f64>()
    };
    let (polygon, _) = Polygon::new(vec![[0.0, 0.0], [0.0, 2.0], [3.0, 2.0], [4.0, 0.0]]).unwrap();
    close(area(polygon.into()), 7.0);
    close(area(Disk::new(2.0).unwrap().into()), 4.0 * 12.0 * (PI / 12.0).sin());
}
