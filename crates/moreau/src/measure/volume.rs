//! Volumes of bodies, whole and inside boxes, and the solid fraction; theory (68).

use super::facets::facets_in;
use super::{Cell, Grid, ball_in};
use crate::bodies::Bodies;
use crate::shape::{Polygons, Shape};
use crate::space::{Pose, Space};
use crate::world::World;
use moreau_solve::block::axpy;

/// A part of a body, in the world.
enum Piece<const D: usize> {
    Ball([f64; D], f64),
    Facets(Polygons<D>),
}

impl<const D: usize> Piece<D> {
    fn volume_in(&self, cell: &Cell<D>) -> f64 {
        match self {
            Self::Ball(centre, radius) => ball_in(centre, *radius, cell),
            Self::Facets(facets) => facets_in(facets, cell),
        }
    }

    /// The smallest box around it.
    fn extent(&self) -> Option<Cell<D>> {
        match self {
            Self::Ball(centre, radius) => Some(Cell::around(centre, *radius)),
            Self::Facets(facets) => facets.vertices.iter().map(|v| Cell::around(v, 0.0)).reduce(|all, v| all.with(&v)),
        }
    }
}

/// A body in its pieces.
struct Pieces<const D: usize> {
    pieces: Vec<Piece<D>>,
    /// The volume of the body over that of its pieces.
    scale: f64,
}

impl<const D: usize> Pieces<D> {
    /// Of body `i`, which is bounded: balls as they are, and the rest by the polygons of its boundary.
    fn of<S: Space<D, N>, const N: usize>(bodies: &Bodies<S, D, N>, i: usize) -> Self {
        let (shape, pose) = (&bodies.shape[i], &bodies.pose[i]);
        let to_world = |p: [f64; D]| axpy(&pose.position, 1.0, &S::rotate(pose.rotation, p));
        let piece = |part: &S::Shape, place: &Pose<S::Rotation, D>| match part.bounding_radius() {
            Some(radius) if part.is_round() => Piece::Ball(to_world(place.position), radius),
            _ => {
                let mut facets = Polygons::default();
                facets.add::<S, N>(&part.polygons(), place);
                facets.vertices.iter_mut().for_each(|vertex| *vertex = to_world(*vertex));
                Piece::Facets(facets)
            }
        };
        let mut pieces: Vec<_> = shape.parts().iter().map(|part| piece(&part.shape, &part.pose)).collect();
        if pieces.is_empty() {
            pieces.push(piece(shape, &Pose { position: [0.0; D], rotation: S::IDENTITY }));
        }
        let whole = |piece: &Piece<D>| piece.extent().map(|extent| piece.volume_in(&extent));
        let of_pieces: f64 = pieces.iter().filter_map(whole).sum();
        let scale = if of_pieces > 0.0 { volume(bodies, i) / of_pieces } else { 0.0 };
        Self { pieces, scale }
    }

    fn volume_in(&self, cell: &Cell<D>) -> f64 {
        self.scale * self.pieces.iter().map(|piece| piece.volume_in(cell)).sum::<f64>()
    }

    fn extent(&self) -> Option<Cell<D>> {
        self.pieces.iter().filter_map(Piece::extent).reduce(|all, piece| all.with(&piece))
    }
}

/// The ball around body `i` that holds it, as a box; none for a body that is unbounded.
fn bound<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, i: usize) -> Option<Cell<D>> {
    bodies.shape[i].bounding_radius().map(|radius| Cell::around(&bodies.pose[i].position, radius))
}

/// The volume of body `i`, m³ (its area in the plane, m²): that of its mass, so what parts of a compound share counts as often as they do.
/// Infinite for a body that is unbounded.
pub fn volume<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, i: usize) -> f64 {
    bodies.shape[i].mass(1.0)[0]
}

/// What body `i` has inside the cell, m³ (m² in the plane): exact for balls, disks, polygons, polyhedra, boxes and compounds of
/// these. A capsule or cylinder is that of its polygons, as it is drawn (24 sides around), times what its volume is of theirs, so that cells
/// together hold all of it. Zero for a body that is unbounded.
pub fn volume_in<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, i: usize, cell: &Cell<D>) -> f64 {
    match bound(bodies, i) {
        Some(bound) if cell.holds(&bound) => volume(bodies, i),
        Some(bound) if !cell.misses(&bound) => Pieces::of(bodies, i).volume_in(cell),
        _ => 0.0,
    }
}

/// The smallest box around all free bodies, capsules and cylinders as they are drawn; none where no body is free.
pub fn extent<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>) -> Option<Cell<D>> {
    let free = (0..bodies.len()).filter(|&i| bodies.is_free(i));
    let of_body = |i: usize| match bound(bodies, i) {
        // Of a ball the bound is exact, and quick.
        Some(bound) if bodies.shape[i].is_round() => Some(bound),
        _ => Pieces::of(bodies, i).extent(),
    };
    free.filter_map(of_body).reduce(|all, body| all.with(&body))
}

/// The solid fraction of the cell: the part of its volume that free bodies fill, theory (68).
pub fn solid_fraction<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, cell: &Cell<D>) -> f64 {
    let bodies = &world.bodies;
    let free = (0..bodies.len()).filter(|&i| bodies.is_free(i));
    free.map(|i| volume_in(bodies, i, cell)).sum::<f64>() / cell.volume()
}

/// The solid fraction of each cell of a grid.
pub fn solid_fractions<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, grid: &Grid<D>) -> Vec<f64> {
    let bodies = &world.bodies;
    let mut filled = vec![0.0; grid.len()];
    for i in (0..bodies.len()).filter(|&i| bodies.is_free(i)) {
        let Some(bound) = bound(bodies, i) else { continue };
        let mut pieces = None;
        for index in grid.near(&bound) {
            let cell = grid.cell(index);
            if cell.holds(&bound) {
                filled[index] += volume(bodies, i);
            } else if !cell.misses(&bound) {
                filled[index] += pieces.get_or_insert_with(|| Pieces::of(bodies, i)).volume_in(&cell);
            }
        }
    }
    filled.iter().enumerate().map(|(index, volume)| volume / grid.cell(index).volume()).collect()
}
