//! `vtk/`: bodies and contacts for ParaView, one pair of files a frame and two collections with times.

use super::{Frame, Observer, OutputError};
use crate::io::vtk::{Array, PolyData, Series, write};
use crate::shape::Shape;
use crate::space::Space;
use crate::step::Localised;
use moreau_solve::Cone;
use moreau_solve::block::tangent_norm;
use std::path::{Path, PathBuf};

/// Writes every n-th step.
#[derive(Debug)]
pub struct VtkOutput {
    folder: PathBuf,
    every: u64,
    bodies: Series,
    contacts: Series,
}

/// Status of a contact in the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ContactStatus {
    /// No impulse.
    Open = 0,
    /// Pressed, without slip, or without friction at all.
    Sticking = 1,
    /// Pressed, on the edge of Coulomb's cone.
    Sliding = 2,
}

impl VtkOutput {
    /// Writes into `folder` (made if need be) the start and every `every`-th step.
    ///
    /// # Errors
    /// Where the folder cannot be made.
    pub fn create(folder: &Path, every: u64) -> Result<Self, OutputError> {
        std::fs::create_dir_all(folder).map_err(OutputError::io(folder))?;
        Ok(Self {
            folder: folder.to_owned(),
            every: every.max(1),
            bodies: Series::new(folder.join("bodies.pvd")),
            contacts: Series::new(folder.join("contacts.pvd")),
        })
    }

    fn write_bodies<S: Space<D, N>, const D: usize, const N: usize>(
        &mut self,
        frame: &Frame<'_, S, D, N>,
    ) -> Result<(), OutputError> {
        let (bodies, time) = (&frame.world.bodies, frame.world.time);
        let all = 0..bodies.len();
        let points: Vec<[f64; 3]> = bodies.pose.iter().map(|pose| space_vector(&pose.position)).collect();
        let velocity: Vec<[f64; 3]> = bodies.velocity.iter().map(|v| space_vector(&v[..D])).collect();
        let spin: Vec<[f64; 3]> = all.clone().map(|i| S::spin_in_world(bodies.pose[i].rotation, &bodies.velocity[i])).collect();
        let orientation: Vec<[f64; 4]> = bodies.pose.iter().map(|pose| S::quaternion(pose.rotation)).collect();
        // A half-space has no end: it is a point of its boundary with radius zero, which ParaView's glyphs leave out.
        let radius: Vec<f64> = bodies.shape.iter().map(|shape| shape.bounding_radius().unwrap_or(0.0)).collect();
        // A driven body yields to nothing.
        let weighed = |i: usize| if bodies.is_free(i) { bodies.mass[i][0] } else { f64::INFINITY };
        let mass: Vec<f64> = all.clone().map(weighed).collect();
        let material: Vec<i32> = bodies.material.iter().map(|&material| i32::from(material)).collect();
        let id: Vec<i64> = all.map(|i| i as i64).collect();
        let data = PolyData {
            points: &points,
            point_data: vec![
                Array::scalars("radius", &radius),
                Array::vectors("velocity", &velocity),
                Array::vectors("spin", &spin),
                Array { name: "orientation", components: 4, values: orientation.as_flattened().into() },
                Array::scalars("mass", &mass),
                Array::scalars("material", &material),
                Array::scalars("id", &id),
            ],
            time,
            ..PolyData::default()
        };
        let name = format!("bodies_{:08}.vtp", frame.world.steps);
        write(&self.folder.join(&name), &data)?;
        self.bodies.push(time, &name)?;
        Ok(self.bodies.save()?)
    }

    fn write_contacts<S: Space<D, N>, const D: usize, const N: usize>(
        &mut self,
        frame: &Frame<'_, S, D, N>,
    ) -> Result<(), OutputError> {
        let (contacts, time) = (frame.contacts, frame.world.time);
        let points: Vec<[f64; 3]> = contacts.iter().map(|c| space_vector(&c.contact.point)).collect();
        let normal: Vec<[f64; 3]> = contacts.iter().map(|c| space_vector(&c.contact.normal)).collect();
        let impulse: Vec<[f64; 3]> = contacts.iter().map(|c| space_vector(&in_world(c))).collect();
        let gap: Vec<f64> = contacts.iter().map(|c| c.contact.gap).collect();
        let normal_impulse: Vec<f64> = contacts.iter().map(|c| c.impulse[0]).collect();
        let status: Vec<i32> = contacts.iter().map(|c| status(c) as i32).collect();
        let pairs: Vec<[i64; 2]> = contacts.iter().map(|c| [i64::from(c.contact.key.a), i64::from(c.contact.key.b)]).collect();
        let data = PolyData {
            points: &points,
            point_data: vec![
                Array::vectors("normal", &normal),
                Array::scalars("gap", &gap),
                Array::vectors("impulse", &impulse),
                Array::scalars("normal_impulse", &normal_impulse),
                Array::scalars("status", &status),
                Array { name: "bodies", components: 2, values: pairs.as_flattened().into() },
            ],
            time,
            ..PolyData::default()
        };
        let name = format!("contacts_{:08}.vtp", frame.world.steps);
        write(&self.folder.join(&name), &data)?;
        self.contacts.push(time, &name)?;
        Ok(self.contacts.save()?)
    }
}

/// Two or three numbers as three.
fn space_vector(v: &[f64]) -> [f64; 3] {
    std::array::from_fn(|k| v.get(k).copied().unwrap_or(0.0))
}

/// The impulse on body `b` in the world.
fn in_world<const D: usize>(c: &Localised<D>) -> [f64; D] {
    std::array::from_fn(|k| (0..D).map(|i| c.frame[i][k] * c.impulse[i]).sum())
}

fn status<const D: usize>(c: &Localised<D>) -> ContactStatus {
    if c.impulse == [0.0; D] {
        return ContactStatus::Open;
    }
    match c.form.cone {
        Cone::Coulomb(mu) if tangent_norm(&c.impulse) >= (1.0 - 1e-9) * mu * c.impulse[0] => ContactStatus::Sliding,
        _ => ContactStatus::Sticking,
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Observer<S, D, N> for VtkOutput {
    fn see(&mut self, frame: &Frame<'_, S, D, N>) -> Result<(), OutputError> {
        if !frame.world.steps.is_multiple_of(self.every) {
            return Ok(());
        }
        self.write_bodies(frame)?;
        self.write_contacts(frame)
    }
}
