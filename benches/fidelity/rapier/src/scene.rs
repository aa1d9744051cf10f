//! A scene as `scene.py` writes it.

use serde::Deserialize;

#[derive(Deserialize)]
pub struct Scene {
    pub gravity: [f64; 3],
    pub step: f64,
    pub steps: usize,
    pub every: usize,
    pub friction: f64,
    /// False where bodies pass through each other.
    pub collide: bool,
    pub bodies: Vec<Body>,
    pub joints: Vec<Joint>,
    pub settings: Settings,
}

#[derive(Deserialize)]
pub struct Body {
    pub shape: Shape,
    pub density: f64,
    pub fixed: bool,
    pub position: [f64; 3],
    /// w, x, y, z.
    pub quaternion: [f64; 4],
    pub velocity: [f64; 3],
    /// In the world.
    pub spin: [f64; 3],
    pub force: [f64; 3],
}

/// Edges, radius, radius and length, normal. Axes are z.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    Box([f64; 3]),
    Ball(f64),
    Capsule([f64; 2]),
    Cylinder([f64; 2]),
    HalfSpace([f64; 3]),
}

/// A ball joint, or a slider where there is an axis. Without `a` it joins to the world.
#[derive(Deserialize)]
pub struct Joint {
    pub a: Option<usize>,
    pub b: usize,
    pub anchor: [f64; 3],
    pub axis: Option<[f64; 3]>,
}

/// What is not Rapier's own.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    pub sleep: bool,
    pub iterations: Option<usize>,
    pub pgs_iterations: Option<usize>,
    pub stabilization: Option<usize>,
    pub length_unit: Option<f64>,
    pub contact_recycling: Option<bool>,
    pub warmstart_joints: Option<bool>,
    /// Natural frequency in Hz, damping ratio.
    pub contact: Option<[f64; 2]>,
    pub coulomb: bool,
    /// Thickness of the skin of colliders, m.
    pub contact_skin: f64,
    /// Joints in reduced coordinates.
    pub multibody: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            sleep: true,
            iterations: None,
            pgs_iterations: None,
            stabilization: None,
            length_unit: None,
            contact_recycling: None,
            warmstart_joints: None,
            contact: None,
            coulomb: false,
            contact_skin: 0.0,
            multibody: false,
        }
    }
}
