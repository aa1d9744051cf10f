//! `interfaces_*.vtp`: a point at the centre of pressure of each pair of bodies that touch and are not round, and the line of thrust
//! through these points.

use super::snapshot::{refill, space_vector};
use crate::io::vtk::{Array, Cells, PolyData};
use crate::observe::Frame;
use crate::observe::interfaces::{Interface, interfaces, thrust};
use crate::shape::Shape;
use crate::space::Space;

/// One frame, a row an interface.
#[derive(Clone, Debug, Default)]
pub(super) struct Interfaces {
    points: Vec<[f64; 3]>,
    centre: Vec<[f64; 3]>,
    normal: Vec<[f64; 3]>,
    force: Vec<[f64; 3]>,
    moment: Vec<[f64; 3]>,
    eccentricity: Vec<f64>,
    normal_force: Vec<f64>,
    shear_force: Vec<f64>,
    mobilised: Vec<f64>,
    contacts: Vec<i32>,
    pairs: Vec<[i64; 2]>,
    thrust: Cells,
}

impl Interfaces {
    /// Takes over what the contacts of a frame come down to.
    pub(super) fn take<S: Space<D, N>, const D: usize, const N: usize>(&mut self, frame: &Frame<'_, S, D, N>) {
        let bodies = &frame.world.bodies;
        let h = frame.record.map_or(frame.world.settings.h, |record| record.h);
        let is_round = |body: u32| bodies.shape[body as usize].is_round();
        let all: Vec<Interface<D>> =
            interfaces(frame.contacts, h).filter(|one| !one.bodies.iter().any(|&body| is_round(body))).collect();
        refill(&mut self.points, all.iter().map(|one| space_vector(&one.pressure)));
        refill(&mut self.centre, all.iter().map(|one| space_vector(&one.centre)));
        refill(&mut self.normal, all.iter().map(|one| space_vector(&one.normal)));
        refill(&mut self.force, all.iter().map(|one| space_vector(&one.force)));
        refill(&mut self.moment, all.iter().map(|one| one.moment));
        refill(&mut self.eccentricity, all.iter().map(Interface::eccentricity));
        refill(&mut self.normal_force, all.iter().map(|one| one.normal_force));
        refill(&mut self.shear_force, all.iter().map(|one| one.shear_force));
        refill(&mut self.mobilised, all.iter().map(|one| one.mobilised));
        refill(&mut self.contacts, all.iter().map(|one| one.points as i32));
        refill(&mut self.pairs, all.iter().map(|one| one.bodies.map(i64::from)));
        self.thrust.clear();
        thrust(&all, bodies, &frame.world.gravity).into_iter().for_each(|line| self.thrust.push(line));
    }

    /// The file.
    pub(super) fn data(&self, time: f64) -> PolyData<'_> {
        let Self { points, centre, normal, force, moment, eccentricity, normal_force, shear_force, mobilised, .. } = self;
        let point_data = vec![
            Array::vectors("centre", centre),
            Array::vectors("normal", normal),
            Array::vectors("force", force),
            Array::vectors("moment", moment),
            Array::scalars("eccentricity", eccentricity),
            Array::scalars("normal_force", normal_force),
            Array::scalars("shear_force", shear_force),
            Array::scalars("mobilised_friction", mobilised),
            Array::scalars("contacts", &self.contacts),
            Array { name: "bodies", components: 2, values: self.pairs.as_flattened().into() },
        ];
        PolyData { points, lines: &self.thrust, point_data, time, ..PolyData::default() }
    }
}
