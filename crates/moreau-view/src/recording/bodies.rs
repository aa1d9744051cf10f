//! Bodies and their shapes.

use moreau::scene::Scene;
use moreau::shape::Shape;
use moreau::space::Space;
use moreau::world::World;
use serde_json::{Value, json};
use std::collections::HashMap;

/// What pages are told of the bodies, and the list of shapes, each once.
pub(super) fn of<S: Space<D, N>, const D: usize, const N: usize>(scene: &Scene, world: &World<S, D, N>) -> (Value, Vec<Value>) {
    let bodies = &world.bodies;
    let (mut shapes, mut known) = (Vec::new(), HashMap::new());
    let mut number = |shape: &S::Shape| {
        let shape = drawn::<S, D, N>(shape);
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
        "free": all.clone().map(|i| u8::from(bodies.is_free(i))).collect::<Vec<_>>(),
        "radius": bodies.shape.iter().map(|shape| shape.bounding_radius().unwrap_or(0.0)).collect::<Vec<_>>(),
        // What is infinite is null.
        "mass": bodies.mass.iter().map(|mass| mass[0]).collect::<Vec<_>>(),
        "shape": shape,
    });
    (value, shapes)
}

/// A shape as it is drawn: a ball, what lies below a plane, or polygons.
fn drawn<S: Space<D, N>, const D: usize, const N: usize>(shape: &S::Shape) -> Value {
    if shape.is_round()
        && let Some(radius) = shape.bounding_radius()
    {
        return json!({ "ball": radius });
    }
    if let Some(normal) = shape.bounding_normal(S::IDENTITY) {
        return json!({ "plane": normal.as_slice() });
    }
    let polygons = shape.polygons();
    let vertices: Vec<&[f64]> = polygons.vertices.iter().map(<[f64; D]>::as_slice).collect();
    json!({ "vertices": vertices, "polygons": polygons.iter().collect::<Vec<_>>() })
}
