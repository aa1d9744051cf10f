//! Builders: structures of many bodies from a few lines.
//!
//! A builder is one file (its numbers, a `Builder`) and one row in the table [`BUILDERS`]. It is a pure function of what the scene says
//! of it: pieces in the builder's own coordinates, which the common part puts in place.
//!
//! Most are made of a profile, points (x, up): in the plane it is a polygon; in space, where up is z, a prism over it along y.

use super::Scene;
use super::dimension::{SceneSpace, vector};
use super::error::Fault;
use super::spec::{BodySpec, MotionKind};
use super::values::{Angular, Orientation};
use moreau_solve::Row;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Writes the enum of builders, its table of rows and its dispatch.
macro_rules! builders {
    ($($file:ident :: $Builder:ident, $name:literal, $dimensions:expr, $about:literal;)+) => {
        $(mod $file;)+
        $(pub use $file::$Builder;)+

        /// What is built.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case", deny_unknown_fields)]
        pub enum BuildKind {
            $(#[doc = $about] $Builder($Builder),)+
        }

        /// The builders, one row each, with the dimensions that they build in.
        pub const BUILDERS: &[(&[usize], Row)] = &[$((&$dimensions, Row { name: $name, about: $about })),+];

        impl BuildKind {
            /// Its name in scene files.
            pub fn name(&self) -> &'static str {
                match self { $(Self::$Builder(_) => $name,)+ }
            }

            /// The dimensions that it builds in.
            pub fn dimensions(&self) -> &'static [usize] {
                match self { $(Self::$Builder(_) => &$dimensions,)+ }
            }

            pub(super) fn builder(&self) -> &dyn Builder {
                match self { $(Self::$Builder(builder) => builder,)+ }
            }
        }
    };
}

builders! {
    arch::Arch, "arch", [2, 3], "an arch of voussoirs around a circle";
    arcade::Arcade, "arcade", [2, 3], "round arches side by side on piers, level on top, as of an aqueduct";
    wall::Wall, "wall", [2, 3], "a wall of bricks in courses";
    dry_stone::DryStone, "dry_stone", [2, 3], "a wall of irregular stones with flat beds";
    column::Column, "column", [2, 3], "a column of drums";
    dome::Dome, "dome", [3], "a hemispherical dome of voussoirs";
    dominoes::Dominoes, "dominoes", [2, 3], "a row of dominoes";
    card_house::CardHouse, "card_house", [2, 3], "a house of cards that lean on each other";
    drum::Drum, "drum", [2, 3], "a rotating drum of plates, one driven body";
    hopper::Hopper, "hopper", [2, 3], "a hopper of fixed plates";
    ballast::Ballast, "ballast", [2, 3], "random convex stones, apart from each other";
}

mod pieces;
mod site;

pub use arch::{Joints, Springers};
pub(super) use pieces::Piece;
pub(super) use site::Site;
pub use wall::Bond;

/// A structure of many bodies: an entry of `build`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Build {
    /// A name; the bodies are then called by it and their number from 0, as in "arch.3".
    pub name: Option<String>,
    /// What is built.
    pub kind: BuildKind,
    /// The name of its material.
    pub material: String,
    /// Where the origin of its coordinates is, m: on the ground in its middle, if its kind says nothing else. Its vertical is y in the
    /// plane and z in space.
    pub position: Vec<f64>,
    /// How it is turned about its origin, as of a body.
    pub orientation: Option<Orientation>,
    /// How its bodies move; default free, of a hopper fixed, of a drum driven.
    pub motion: Option<MotionKind>,
}

/// What one builder says of itself: all that a new one writes down, besides its row.
pub(super) trait Builder {
    /// Whether its numbers can be built.
    fn check(&self, site: &Site<'_>) -> Result<(), Fault>;

    /// How many bodies it makes in so many dimensions, without making them.
    fn count(&self, dimension: usize) -> u64;

    /// How many of them, the last ones, are fixed whatever the others do.
    fn held(&self) -> u64 {
        0
    }

    /// How the others move if the scene does not say.
    fn motion(&self) -> MotionKind {
        MotionKind::Free
    }

    /// A spin in the plane of the profile, from x towards up, rad/s.
    fn spin(&self) -> f64 {
        0.0
    }

    /// What its body of this number is called.
    fn piece(&self, number: u64) -> &'static str;

    /// Its bodies, as many as it counts.
    fn pieces(&self, site: &Site<'_>) -> Result<Vec<Piece>, Fault>;
}

impl Build {
    /// How many bodies it makes.
    pub(super) fn count(&self, dimension: usize) -> u64 {
        self.kind.builder().count(dimension)
    }

    /// How many of them are free.
    pub(super) fn free(&self, dimension: usize) -> u64 {
        let builder = self.kind.builder();
        if self.motion() == MotionKind::Free { builder.count(dimension).saturating_sub(builder.held()) } else { 0 }
    }

    /// How its bodies move that are not held.
    pub(super) fn motion(&self) -> MotionKind {
        self.motion.unwrap_or(self.kind.builder().motion())
    }

    /// How its body of this number moves.
    pub(super) fn motion_of(&self, number: u64, dimension: usize) -> MotionKind {
        let builder = self.kind.builder();
        let held = number >= builder.count(dimension).saturating_sub(builder.held());
        if held { MotionKind::Fixed } else { self.motion() }
    }

    /// Words for its body of this number: `voussoir 3 of build[0] "arch"`.
    pub(super) fn label_of(&self, index: usize, number: u64) -> String {
        let name = self.name.as_ref().map_or(String::new(), |name| format!(" {name:?}"));
        format!("{} {number} of build[{index}]{name}", self.kind.builder().piece(number))
    }

    /// The name of its body of this number.
    pub(super) fn name_of(&self, number: u64) -> Option<String> {
        self.name.as_ref().map(|name| format!("{name}.{number}"))
    }

    /// The number of its body of this name.
    pub(super) fn number_of(&self, name: &str, dimension: usize) -> Option<u64> {
        let number = name.strip_prefix(self.name.as_deref()?)?.strip_prefix('.')?.parse().ok()?;
        // One way to write a number: "arch.3" and not "arch.03".
        (number < self.count(dimension) && self.name_of(number).as_deref() == Some(name)).then_some(number)
    }
}

/// The bodies of builder `index` in the terms of a scene, in place.
pub(super) fn bodies<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    index: usize,
    build: &Build,
) -> Result<Vec<BodySpec>, Fault> {
    let builder = build.kind.builder();
    let (origin, rotation): ([f64; D], _) = (vector(&build.position), S::rotation(build.orientation.as_ref()));
    // From x to up is about the third axis in the plane; in space it is against y.
    let spin = (builder.spin() != 0.0).then(|| match D {
        2 => Angular::Plane(builder.spin()),
        _ => Angular::Solid(S::rotate(rotation, std::array::from_fn(|k| if k == 1 { -builder.spin() } else { 0.0 })).to_vec()),
    });
    let place = |(number, piece): (u64, Piece)| {
        let [x, y, z] = piece.position;
        let own = if D == 2 { [x, z, 0.0] } else { [x, y, z] };
        let at = S::rotate(rotation, vector(&own));
        BodySpec {
            name: build.name_of(number),
            shape: piece.shape,
            material: build.material.clone(),
            density: None,
            position: (0..D).map(|k| origin[k] + at[k]).collect(),
            orientation: build.orientation.clone(),
            velocity: Vec::new(),
            spin: spin.clone(),
            motion: Some(build.motion_of(number, D)),
            force: Vec::new(),
            torque: None,
            drive: Vec::new(),
            removed_at: None,
            max_overlap: None,
        }
    };
    Ok((0..).zip(builder.pieces(&Site::new(scene, index, build))?).map(place).collect())
}
