//! `shapes_*.vtp`: bodies as polygons, where they are. Balls and disks are points with a radius in `bodies_*.vtp` instead, and unbounded
//! shapes have no end to draw.

use super::snapshot::{refill, space_vector};
use crate::bodies::Bodies;
use crate::io::vtk::{Array, Cells, PolyData};
use crate::shape::Shape;
use crate::space::Space;
use moreau_solve::block::norm;
use moreau_solve::tasks;
use std::sync::Arc;

/// What is the same in each frame, as long as the same bodies are there.
#[derive(Debug, Default)]
pub(super) struct Drawing {
    /// The bodies that are drawn.
    bodies: Vec<usize>,
    /// The vertices of all, each in the frame of its body, m; in the plane the third coordinate is zero.
    vertices: Vec<[f64; 3]>,
    /// The body of each.
    of_vertex: Vec<u32>,
    lines: Cells,
    polygons: Cells,
    /// The body of each cell, lines first.
    of_cell: Vec<u32>,
}

impl Drawing {
    fn of<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, drawn: Vec<usize>) -> Self {
        let mut all = Self::default();
        let mut of_polygon = Vec::new();
        for &i in &drawn {
            let (polygons, first) = (bodies.shape[i].polygons(), all.vertices.len());
            all.vertices.extend(polygons.vertices.iter().map(|vertex| space_vector(vertex)));
            all.of_vertex.resize(all.vertices.len(), i as u32);
            for polygon in polygons.iter() {
                let (cells, owners) = match polygon.len() {
                    ..=2 => (&mut all.lines, &mut all.of_cell),
                    _ => (&mut all.polygons, &mut of_polygon),
                };
                cells.push(polygon.iter().map(|&corner| first + corner));
                owners.push(i as u32);
            }
        }
        all.of_cell.append(&mut of_polygon);
        all.bodies = drawn;
        all
    }
}

/// One frame of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Shapes {
    drawing: Arc<Drawing>,
    points: Vec<[f64; 3]>,
    id: Vec<i64>,
    material: Vec<i32>,
    free: Vec<u8>,
    speed: Vec<f64>,
    spin: Vec<f64>,
    kinetic: Vec<f64>,
}

impl Shapes {
    /// Takes over where the bodies are; `kept` is the drawing of the frame before.
    pub(super) fn take<S: Space<D, N>, const D: usize, const N: usize>(
        &mut self,
        bodies: &Bodies<S, D, N>,
        kept: &mut Arc<Drawing>,
    ) {
        let is_drawn = |&i: &usize| bodies.is_present(i) && !bodies.shape[i].is_round();
        let drawn = || (0..bodies.len()).filter(is_drawn);
        if !drawn().eq(kept.bodies.iter().copied()) {
            *kept = Arc::new(Drawing::of(bodies, drawn().collect()));
        }
        self.drawing = Arc::clone(kept);
        let Drawing { vertices, of_vertex, of_cell, .. } = &**kept;
        tasks::fill(&mut self.points, vertices.len(), |j| {
            let pose = &bodies.pose[of_vertex[j] as usize];
            let turned = S::rotate(pose.rotation, std::array::from_fn(|k| vertices[j][k]));
            space_vector(&std::array::from_fn::<_, D, _>(|k| pose.position[k] + turned[k]))
        });
        let of_cell = || of_cell.iter().map(|&i| i as usize);
        let speed = |i: usize| norm(&std::array::from_fn::<_, D, _>(|k| bodies.velocity[i][k]));
        let twice = |i: usize| (0..N).map(|k| bodies.mass[i][k] * bodies.velocity[i][k] * bodies.velocity[i][k]).sum::<f64>();
        refill(&mut self.id, of_cell().map(|i| i as i64));
        refill(&mut self.material, of_cell().map(|i| i32::from(bodies.material[i])));
        refill(&mut self.free, of_cell().map(|i| u8::from(bodies.is_free(i))));
        refill(&mut self.speed, of_cell().map(speed));
        refill(&mut self.spin, of_cell().map(|i| norm(&S::spin_in_world(bodies.pose[i].rotation, &bodies.velocity[i]))));
        // A driven body yields to nothing and has no energy in the books.
        refill(&mut self.kinetic, of_cell().map(|i| if bodies.is_free(i) { 0.5 * twice(i) } else { 0.0 }));
    }

    /// Whether there is nothing to draw.
    pub(super) fn is_empty(&self) -> bool {
        self.drawing.of_cell.is_empty()
    }

    /// The file.
    pub(super) fn data(&self, time: f64) -> PolyData<'_> {
        let Self { drawing, points, id, material, free, speed, spin, kinetic } = self;
        let cell_data = vec![
            Array::scalars("id", id),
            Array::scalars("material", material),
            Array::scalars("free", free),
            Array::scalars("speed", speed),
            Array::scalars("spin", spin),
            Array::scalars("kinetic_energy", kinetic),
        ];
        let (lines, polys) = (&drawing.lines, &drawing.polygons);
        PolyData { points, verts: false, lines, polys, cell_data, time, ..PolyData::default() }
    }
}
