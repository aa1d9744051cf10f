//! The bodies: what the world is made of, in arrays by role.

use crate::shape::Shape;
use crate::space::{Pose, Space};

/// How a body moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// By forces and contacts.
    Free,
    /// With its velocity as given, whatever touches it; a fixed body is driven at velocity zero.
    Driven,
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
    /// Diagonal of M⁻¹; zero for driven bodies.
    pub inverse_mass: Vec<[f64; N]>,
    /// Diagonal of M^{-1/2}; zero for driven bodies.
    pub root_inverse_mass: Vec<[f64; N]>,
    /// Constant force and torque in the world.
    pub load: Vec<[f64; N]>,
    /// Forms.
    pub shape: Vec<S::Shape>,
    /// Indices of materials.
    pub material: Vec<u16>,
    /// Who is driven.
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
        let mass = body.shape.mass(body.density);
        self.pose.push(body.pose);
        self.velocity.push(body.velocity);
        self.mass.push(mass);
        let inverse_mass = match body.motion {
            Motion::Free => mass.map(|m| 1.0 / m),
            Motion::Driven => [0.0; N],
        };
        self.inverse_mass.push(inverse_mass);
        self.root_inverse_mass.push(inverse_mass.map(f64::sqrt));
        self.load.push(body.load);
        self.shape.push(body.shape);
        self.material.push(body.material);
        self.motion.push(body.motion);
        self.len() - 1
    }
}
