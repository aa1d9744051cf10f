//! Joints in a scene, and as joints of the world.

use super::Scene;
use super::dimension::{SceneSpace, unit};
use crate::bodies::Bodies;
use crate::joints::{Joint, JointKind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A joint between two bodies, or between a body and the world. It is closed in the first configuration: all that it says of points and
/// directions is where they are then, in the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointSpec {
    /// A name for messages; no two joints may share one.
    pub name: Option<String>,
    /// What it holds.
    pub kind: JointKindSpec,
    /// The names of its two bodies, of which at least one must be free; or of one that is joined to the world. The joint ends when one of them
    /// is removed.
    #[schemars(length(min = 1, max = 2))]
    pub between: Vec<String>,
    /// Whether its two bodies may touch each other; default no.
    #[serde(default)]
    pub collide: bool,
}

/// What a joint holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum JointKindSpec {
    /// All: the two move as one.
    Fixed {},
    /// All but the rotation about an axis.
    Hinge {
        /// A point of the axis, m.
        anchor: Vec<f64>,
        /// The direction of the axis, of any length; in the plane it is left out.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        axis: Vec<f64>,
    },
    /// All but the translation along an axis, which is the first body's: it turns with it.
    Slider {
        /// The direction of the axis, of any length.
        axis: Vec<f64>,
    },
    /// A point: all translations and no rotation; in space.
    Ball {
        /// The point, m.
        anchor: Vec<f64>,
    },
    /// The distance of a point of the first body (of the world, where there is only one) from a point of the other, like a rod without
    /// mass.
    Distance {
        /// The point of the first body, m.
        from: Vec<f64>,
        /// The point of the other, m.
        to: Vec<f64>,
    },
}

impl JointKindSpec {
    /// Its name in scene files.
    pub fn name(&self) -> &'static str {
        match self {
            JointKindSpec::Fixed {} => "fixed",
            JointKindSpec::Hinge { .. } => "hinge",
            JointKindSpec::Slider { .. } => "slider",
            JointKindSpec::Ball { .. } => "ball",
            JointKindSpec::Distance { .. } => "distance",
        }
    }
}

/// The joints of a scene that passed the checks, with its bodies in place.
pub(super) fn joints<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    bodies: &Bodies<S, D, N>,
) -> Vec<Joint<D>> {
    scene.joints.iter().filter_map(|spec| joint::<S, D, N>(scene, bodies, spec)).collect()
}

fn joint<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    bodies: &Bodies<S, D, N>,
    spec: &JointSpec,
) -> Option<Joint<D>> {
    let mut sides = spec.between.iter().map(|name| scene.body_named(name));
    let sides = match (sides.next()?, sides.next()) {
        (a, Some(b)) => [Some(a?), Some(b?)],
        (b, None) => [None, Some(b?)],
    };
    let vector = |numbers: &[f64]| -> [f64; D] { std::array::from_fn(|k| numbers.get(k).copied().unwrap_or(0.0)) };
    // Where nothing else is said, at the centre of the second body: there its impulse does not turn it.
    let centre = bodies.pose[sides[1]?].position;
    let any = vector(&[1.0]);
    let (kind, points, axis) = match &spec.kind {
        JointKindSpec::Fixed {} => (JointKind::Fixed, [centre; 2], any),
        JointKindSpec::Hinge { anchor, axis } if axis.is_empty() => (JointKind::Hinge, [vector(anchor); 2], any),
        JointKindSpec::Hinge { anchor, axis } => (JointKind::Hinge, [vector(anchor); 2], unit(vector(axis))),
        JointKindSpec::Slider { axis } => (JointKind::Slider, [centre; 2], unit(vector(axis))),
        JointKindSpec::Ball { anchor } => (JointKind::Ball, [vector(anchor); 2], any),
        JointKindSpec::Distance { from, to } => (JointKind::Distance, [vector(from), vector(to)], any),
    };
    Some(Joint { collide: spec.collide, ..Joint::new::<S, N>(kind, bodies, sides, points, axis) })
}
