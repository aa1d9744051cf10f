//! The boundary of a shape as polygons: what is drawn of it. Contacts know nothing of it.

#[cfg(test)]
mod tests;

use crate::space::{Pose, Space};

/// How many sides stand for a circle.
pub(crate) const SIDES: usize = 24;

/// Polygons in a body's frame. They may share vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygons<const D: usize> {
    /// m.
    pub vertices: Vec<[f64; D]>,
    corners: Vec<usize>,
    ends: Vec<usize>,
}

impl<const D: usize> Polygons<D> {
    /// These vertices (m), and no polygons yet.
    pub fn on(vertices: Vec<[f64; D]>) -> Self {
        Self { vertices, ..Self::default() }
    }

    /// The closed polygon through these points, counter-clockwise.
    pub fn of_loop(vertices: impl IntoIterator<Item = [f64; D]>) -> Self {
        let vertices: Vec<_> = vertices.into_iter().collect();
        Self { corners: (0..vertices.len()).collect(), ends: vec![vertices.len()], vertices }
    }

    /// Adds the polygon with these vertices: in space counter-clockwise seen from outside, in the plane counter-clockwise. Two are a
    /// line.
    pub fn push(&mut self, corners: impl IntoIterator<Item = usize>) {
        self.corners.extend(corners);
        self.ends.push(self.corners.len());
    }

    /// Adds all of another in its place, as a part of a body.
    pub fn add<S: Space<D, N>, const N: usize>(&mut self, part: &Self, pose: &Pose<S::Rotation, D>) {
        let first = self.vertices.len();
        self.vertices.extend(part.vertices.iter().map(|&vertex| {
            let turned = S::rotate(pose.rotation, vertex);
            std::array::from_fn(|k| pose.position[k] + turned[k])
        }));
        part.iter().for_each(|polygon| self.push(polygon.iter().map(|&corner| first + corner)));
    }

    /// The polygons one by one, each as the indices of its vertices.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        (0..self.ends.len()).map(|i| &self.corners[if i == 0 { 0 } else { self.ends[i - 1] }..self.ends[i]])
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }
}
