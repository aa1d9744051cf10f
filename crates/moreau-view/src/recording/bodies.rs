//! Bodies and their shapes.

use moreau::scene::Scene;
use moreau::shape::{Polygons, Shape};
use moreau::space::Space;
use moreau::world::World;
use serde_json::{Value, json};
use std::collections::HashMap;

/// What pages are told of the bodies, and the list of shapes, each once.
pub(super) fn of<S: Space<D, N>, const D: usize, const N: usize>(scene: &Scene, world: &World<S, D, N>) -> (Value, Vec<Value>) {
    let bodies = &world.bodies;
    let (mut shapes, mut known) = (Vec::new(), HashMap::new());
    let mut number = |shape: &S::Shape| {
        let shape = Drawn::of::<S, N>(shape).json();
        *known.entry(shape.to_string()).or_insert_with(|| {
            shapes.push(shape);
            shapes.len() - 1
        })
    };
    let shape: Vec<usize> = bodies.shape.iter().map(&mut number).collect();
    let all = 0..bodies.len();
    let value = json!({
        "name": all.clone().map(|i| scene.bodies.get(i).and_then(|body| body.name.as_deref())).collect::<Vec<_>>(),
        "material": bodies.material,
        "free": world.ever_free().into_iter().map(u8::from).collect::<Vec<_>>(),
        "radius": bodies.shape.iter().map(|shape| shape.bounding_radius().unwrap_or(0.0)).collect::<Vec<_>>(),
        // What is infinite is null.
        "mass": bodies.mass.iter().map(|mass| mass[0]).collect::<Vec<_>>(),
        "shape": shape,
    });
    (value, shapes)
}

/// A shape as it is drawn.
pub(crate) enum Drawn<const D: usize> {
    /// A ball or disk of this radius, m.
    Ball(f64),
    /// What lies below a plane or line with this normal.
    Plane([f64; D]),
    /// Its boundary, or nearly.
    Polygons(Polygons<D>),
}

impl<const D: usize> Drawn<D> {
    pub(crate) fn of<S: Space<D, N>, const N: usize>(shape: &S::Shape) -> Self {
        match (shape.bounding_radius(), shape.bounding_normal(S::IDENTITY)) {
            (Some(radius), _) if shape.is_round() => Self::Ball(radius),
            (None, Some(normal)) => Self::Plane(normal),
            _ => Self::Polygons(shape.polygons()),
        }
    }

    fn json(&self) -> Value {
        match self {
            Self::Ball(radius) => json!({ "ball": radius }),
            Self::Plane(normal) => json!({ "plane": normal.as_slice() }),
            Self::Polygons(polygons) => {
                let vertices: Vec<&[f64]> = polygons.vertices.iter().map(<[f64; D]>::as_slice).collect();
                json!({ "vertices": vertices, "polygons": polygons.iter().collect::<Vec<_>>() })
            }
        }
    }
}
