//! The bodies: what the world is made of, in arrays by role.

use crate::shape::Shape;
use crate::space::{Pose, Space};
use moreau_solve::block::dot;

/// How a body moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// By forces and contacts.
    Free,
    /// With its velocity as given, whatever touches it; a fixed body is driven at velocity zero.
    Driven,
    /// Not at all, for it is not there: nowhere (its position is not a number), at rest, and touching nothing. Its place in the arrays
    /// is kept, because indices are what others know bodies by.
    Absent,
}

/// One body to be added.
#[derive(Clone, Debug)]
pub struct Body<S: Space<D, N>, const D: usize, const N: usize> {
    /// Its form.
    pub shape: S::Shape,
    /// Where it is.
    pub pose: Pose<S::Rotation, D>,
    /// Generalised velocity; see [`crate::space`].
    pub velocity: [f64; N],
    /// Density, kg/m³ (kg/m² in the plane); unused by a driven body.
    pub density: f64,
    /// Index of its material.
    pub material: u16,
    /// Whether it is driven.
    pub motion: Motion,
    /// Constant force (N) and torque (N·m) in the world.
    pub load: [f64; N],
}

/// All bodies, in arrays by role; index `i` is the body in the order of the scene.
#[derive(Clone, Debug)]
pub struct Bodies<S: Space<D, N>, const D: usize, const N: usize> {
    /// Positions and orientations.
    pub pose: Vec<Pose<S::Rotation, D>>,
    /// Generalised velocities; see [`crate::space`].
    pub velocity: Vec<[f64; N]>,
    /// Diagonal of the mass matrix M: mass (kg) `D` times, then the principal moments of inertia.
    pub mass: Vec<[f64; N]>,
    /// Diagonal of M⁻¹; zero for bodies that are not free.
    pub inverse_mass: Vec<[f64; N]>,
    /// Diagonal of M^{-1/2}; zero for bodies that are not free.
    pub root_inverse_mass: Vec<[f64; N]>,
    /// Force and torque in the world, constant during a step.
    pub load: Vec<[f64; N]>,
    /// Forms.
    pub shape: Vec<S::Shape>,
    /// Indices of materials.
    pub material: Vec<u16>,
    /// Who is free, driven or absent; changed by [`Bodies::set_motion`] and its like, which keep the inverse masses in step.
    pub motion: Vec<Motion>,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Default for Bodies<S, D, N> {
    fn default() -> Self {
        Self {
            pose: Vec::new(),
            velocity: Vec::new(),
            mass: Vec::new(),
            inverse_mass: Vec::new(),
            root_inverse_mass: Vec::new(),
            load: Vec::new(),
            shape: Vec::new(),
            material: Vec::new(),
            motion: Vec::new(),
        }
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Bodies<S, D, N> {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.pose.len()
    }

    /// Whether forces and contacts move body `i`.
    #[inline]
    pub fn is_free(&self, i: usize) -> bool {
        self.motion[i] == Motion::Free
    }

    /// The load on body `i` in its generalised coordinates.
    #[inline]
    pub fn load_in_body(&self, i: usize) -> [f64; N] {
        let load = &self.load[i];
        // Most bodies have none, and turning nothing takes as long as turning something.
        if *load == [0.0; N] { *load } else { S::load_in_body(self.pose[i].rotation, load) }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.pose.is_empty()
    }

    /// Adds a body and returns its index. Mass and inertia follow from shape and density; an unbounded shape has none and must
    /// be driven.
    pub fn push(&mut self, body: Body<S, D, N>) -> usize {
        self.pose.push(body.pose);
        self.velocity.push(body.velocity);
        self.mass.push(body.shape.mass(body.density));
        self.inverse_mass.push([0.0; N]);
        self.root_inverse_mass.push([0.0; N]);
        self.load.push(body.load);
        self.shape.push(body.shape);
        self.material.push(body.material);
        self.motion.push(body.motion);
        let i = self.len() - 1;
        self.set_motion(i, body.motion);
        i
    }

    /// How body `i` moves from now on. One that is no longer absent still has no place; [`Bodies::insert`] gives it one.
    pub fn set_motion(&mut self, i: usize, motion: Motion) {
        self.motion[i] = motion;
        self.inverse_mass[i] = match motion {
            Motion::Free => self.mass[i].map(|m| 1.0 / m),
            Motion::Driven | Motion::Absent => [0.0; N],
        };
        self.root_inverse_mass[i] = self.inverse_mass[i].map(f64::sqrt);
        if motion == Motion::Absent {
            self.pose[i].position = [f64::NAN; D];
            self.velocity[i] = [0.0; N];
        }
    }

    /// Puts the absent body `i` into the world, free.
    pub fn insert(&mut self, i: usize, pose: Pose<S::Rotation, D>, velocity: [f64; N]) {
        (self.pose[i], self.velocity[i]) = (pose, velocity);
        self.set_motion(i, Motion::Free);
    }

    /// Whether body `i` is there.
    #[inline]
    pub fn is_present(&self, i: usize) -> bool {
        self.motion[i] != Motion::Absent
    }

    /// How many are there.
    pub fn present(&self) -> usize {
        self.motion.iter().filter(|&&motion| motion != Motion::Absent).count()
    }

    /// Kinetic and potential energy of body `i`, theory (39): zero if it is not free.
    #[inline]
    pub fn energy(&self, i: usize, gravity: &[f64; D]) -> [f64; 2] {
        if !self.is_free(i) {
            return [0.0; 2];
        }
        let (v, mass) = (&self.velocity[i], &self.mass[i]);
        let kinetic = 0.5 * (0..N).map(|k| mass[k] * v[k] * v[k]).sum::<f64>();
        [kinetic, -mass[0] * dot(gravity, &self.pose[i].position)]
    }
}
