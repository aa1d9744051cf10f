//! What a frame's files say, apart from the world that it was taken of.

use super::interfaces::Interfaces;
use super::shapes::{Drawing, Shapes};
use crate::io::vtk::{Array, PolyData};
use crate::observe::Frame;
use crate::observe::status::status;
use crate::shape::Shape;
use crate::space::Space;
use crate::step::Localised;
use std::sync::Arc;

/// The arrays of one frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Snapshot {
    /// The number of the step.
    pub(super) step: u64,
    /// Its time, s.
    pub(super) time: f64,
    bodies: Bodies,
    contacts: Contacts,
    shapes: Shapes,
    interfaces: Interfaces,
}

/// A row a body.
#[derive(Clone, Debug, Default)]
struct Bodies {
    points: Vec<[f64; 3]>,
    velocity: Vec<[f64; 3]>,
    spin: Vec<[f64; 3]>,
    orientation: Vec<[f64; 4]>,
    radius: Vec<f64>,
    mass: Vec<f64>,
    material: Vec<i32>,
    id: Vec<i64>,
}

/// A row a contact.
#[derive(Clone, Debug, Default)]
struct Contacts {
    points: Vec<[f64; 3]>,
    normal: Vec<[f64; 3]>,
    impulse: Vec<[f64; 3]>,
    gap: Vec<f64>,
    normal_impulse: Vec<f64>,
    status: Vec<i32>,
    pairs: Vec<[i64; 2]>,
}

impl Snapshot {
    /// Takes over what the files say of `frame`; `drawing` is that of the frame before.
    pub(super) fn take<S: Space<D, N>, const D: usize, const N: usize>(
        &mut self,
        frame: &Frame<'_, S, D, N>,
        drawing: &mut Arc<Drawing>,
    ) {
        (self.step, self.time) = (frame.world.steps, frame.world.time);
        self.take_bodies(frame);
        self.take_contacts(frame.contacts);
        self.shapes.take(&frame.world.bodies, drawing);
        if self.has_shapes() {
            self.interfaces.take(frame);
        } else {
            self.interfaces = Interfaces::default();
        }
    }

    fn take_bodies<S: Space<D, N>, const D: usize, const N: usize>(&mut self, frame: &Frame<'_, S, D, N>) {
        let (bodies, to) = (&frame.world.bodies, &mut self.bodies);
        // Those that are there; their id is the index in the world.
        let all = (0..bodies.len()).filter(|&i| bodies.is_present(i));
        refill(&mut to.points, all.clone().map(|i| space_vector(&bodies.pose[i].position)));
        refill(&mut to.velocity, all.clone().map(|i| space_vector(&bodies.velocity[i][..D])));
        refill(&mut to.spin, all.clone().map(|i| S::spin_in_world(bodies.pose[i].rotation, &bodies.velocity[i])));
        refill(&mut to.orientation, all.clone().map(|i| S::quaternion(bodies.pose[i].rotation)));
        // A half-space has no end: it is a point of its boundary with radius zero, which ParaView's glyphs leave out.
        refill(&mut to.radius, all.clone().map(|i| bodies.shape[i].bounding_radius().unwrap_or(0.0)));
        // A driven body yields to nothing.
        let weighed = |i: usize| if bodies.is_free(i) { bodies.mass[i][0] } else { f64::INFINITY };
        refill(&mut to.mass, all.clone().map(weighed));
        refill(&mut to.material, all.clone().map(|i| i32::from(bodies.material[i])));
        refill(&mut to.id, all.map(|i| i as i64));
    }

    fn take_contacts<const D: usize>(&mut self, contacts: &[Localised<D>]) {
        let to = &mut self.contacts;
        refill(&mut to.points, contacts.iter().map(|c| space_vector(&c.contact.point)));
        refill(&mut to.normal, contacts.iter().map(|c| space_vector(&c.contact.normal)));
        refill(&mut to.impulse, contacts.iter().map(|c| space_vector(&c.impulse_in_world())));
        refill(&mut to.gap, contacts.iter().map(|c| c.contact.gap));
        refill(&mut to.normal_impulse, contacts.iter().map(|c| c.impulse[0]));
        refill(&mut to.status, contacts.iter().map(|c| status(c) as i32));
        refill(&mut to.pairs, contacts.iter().map(|c| [i64::from(c.contact.key.a), i64::from(c.contact.key.b)]));
    }

    /// The file of bodies.
    pub(super) fn bodies(&self) -> PolyData<'_> {
        let Bodies { points, velocity, spin, orientation, radius, mass, material, id } = &self.bodies;
        let point_data = vec![
            Array::scalars("radius", radius),
            Array::vectors("velocity", velocity),
            Array::vectors("spin", spin),
            Array { name: "orientation", components: 4, values: orientation.as_flattened().into() },
            Array::scalars("mass", mass),
            Array::scalars("material", material),
            Array::scalars("id", id),
        ];
        PolyData { points, point_data, time: self.time, ..PolyData::default() }
    }

    /// The file of contacts.
    pub(super) fn contacts(&self) -> PolyData<'_> {
        let Contacts { points, normal, impulse, gap, normal_impulse, status, pairs } = &self.contacts;
        let point_data = vec![
            Array::vectors("normal", normal),
            Array::scalars("gap", gap),
            Array::vectors("impulse", impulse),
            Array::scalars("normal_impulse", normal_impulse),
            Array::scalars("status", status),
            Array { name: "bodies", components: 2, values: pairs.as_flattened().into() },
        ];
        PolyData { points, point_data, time: self.time, ..PolyData::default() }
    }

    /// Whether there is a body that is more than a point with a radius.
    pub(super) fn has_shapes(&self) -> bool {
        !self.shapes.is_empty()
    }

    /// The file of shapes.
    pub(super) fn shapes(&self) -> PolyData<'_> {
        self.shapes.data(self.time)
    }

    /// The file of interfaces.
    pub(super) fn interfaces(&self) -> PolyData<'_> {
        self.interfaces.data(self.time)
    }
}

/// Puts `values` in place of what is in `list`, in the same memory.
pub(super) fn refill<T>(list: &mut Vec<T>, values: impl Iterator<Item = T>) {
    list.clear();
    list.extend(values);
}

/// Two or three numbers as three.
pub(super) fn space_vector(v: &[f64]) -> [f64; 3] {
    std::array::from_fn(|k| v.get(k).copied().unwrap_or(0.0))
}
