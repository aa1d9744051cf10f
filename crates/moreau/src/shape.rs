//! Shapes: concrete in each dimension, because a disk is not a ball.
//!
//! A shape is one file (its type, a [`Figure`]) and one row in the table of its dimension ([`plane::SHAPES`],
//! [`solid::SHAPES`]). What it can touch is said by the tables of pairs in `detect/narrow/`.

use crate::space::{Pose, Space};

/// Writes a dimension's enum of shapes, its table of rows and its dispatch. A pair is looked up in the module that the caller
/// knows as `pairs`.
macro_rules! shapes {
    ($(#[$doc:meta])* $Enum:ident in $Space:ident<$D:literal, $N:literal>: $($Row:ident, $name:literal, $about:literal;)+) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub enum $Enum {
            $(#[doc = $about] $Row($Row),)+
        }

        /// The shapes of this dimension, one row each.
        pub const SHAPES: &[Row] = &[$(Row { name: $name, about: $about }),+];

        $(impl From<$Row> for $Enum {
            fn from(shape: $Row) -> Self {
                Self::$Row(shape)
            }
        })+

        impl Shape<$Space, $D, $N> for $Enum {
            #[inline]
            fn bounding_radius(&self) -> Option<f64> {
                match self { $(Self::$Row(shape) => Figure::<$Space, $D, $N>::bounding_radius(shape),)+ }
            }

            fn bounding_normal(&self, rotation: <$Space as Space<$D, $N>>::Rotation) -> Option<[f64; $D]> {
                match self { $(Self::$Row(shape) => Figure::<$Space, $D, $N>::bounding_normal(shape, rotation),)+ }
            }

            #[inline]
            fn is_round(&self) -> bool {
                match self { $(Self::$Row(shape) => Figure::<$Space, $D, $N>::is_round(shape),)+ }
            }

            fn is_convex(&self) -> bool {
                match self { $(Self::$Row(shape) => Figure::<$Space, $D, $N>::is_convex(shape),)+ }
            }

            fn parts(&self) -> &[crate::shape::Part<Self, <$Space as Space<$D, $N>>::Rotation, $D>] {
                match self { $(Self::$Row(shape) => Figure::<$Space, $D, $N>::parts(shape),)+ }
            }

            fn contour(&self, at: [f64; $D], outward: [f64; $D], piece: usize) -> Contour<$D> {
                match self { $(Self::$Row(shape) => Figure::<$Space, $D, $N>::contour(shape, at, outward, piece),)+ }
            }

            fn polygons(&self) -> Polygons<$D> {
                match self { $(Self::$Row(shape) => Figure::<$Space, $D, $N>::polygons(shape),)+ }
            }

            fn mass(&self, density: f64) -> [f64; $N] {
                match self { $(Self::$Row(shape) => Figure::<$Space, $D, $N>::mass(shape, density),)+ }
            }

            fn name(&self) -> &'static str {
                match self { $(Self::$Row(_) => $name,)+ }
            }

            fn has_pair(&self, other: &Self) -> bool {
                pairs::has(self, other)
            }

            #[inline]
            fn collide(
                a: Placed<'_, Self, <$Space as Space<$D, $N>>::Rotation, $D>,
                b: Placed<'_, Self, <$Space as Space<$D, $N>>::Rotation, $D>,
                reach: f64,
                emit: &mut impl FnMut(u64, [f64; $D], [f64; $D], f64),
            ) {
                pairs::collide(a, b, reach, emit);
            }
        }
    };
}

mod contour;
mod error;
pub mod plane;
mod polygons;
pub mod solid;

pub use contour::Contour;
pub(crate) use contour::{SAME, is_same};
pub use error::ShapeError;
pub use plane::PlaneShape;
pub use polygons::Polygons;
pub use solid::SolidShape;

/// Something and where it is.
pub type Placed<'a, T, R, const D: usize> = (&'a T, &'a Pose<R, D>);

/// A part of a body of several.
#[derive(Clone, Debug, PartialEq)]
pub struct Part<T, R, const D: usize> {
    /// Its form: bounded, and of one piece.
    pub shape: T,
    /// Where it is in the frame of the body.
    pub pose: Pose<R, D>,
    /// Radius of the ball (in the plane: the disk) around its own centre of mass that holds it, m.
    pub radius: f64,
}

/// What one shape says of itself: all that a new one writes down, besides its row and its pairs.
pub trait Figure<S: Space<D, N>, const D: usize, const N: usize> {
    /// See [`Shape::bounding_radius`].
    fn bounding_radius(&self) -> Option<f64>;

    /// See [`Shape::bounding_normal`].
    fn bounding_normal(&self, _: S::Rotation) -> Option<[f64; D]> {
        None
    }

    /// See [`Shape::is_round`].
    fn is_round(&self) -> bool {
        false
    }

    /// See [`Shape::is_convex`].
    fn is_convex(&self) -> bool {
        true
    }

    /// See [`Shape::parts`].
    fn parts(&self) -> &[Part<S::Shape, S::Rotation, D>] {
        &[]
    }

    /// See [`Shape::contour`].
    fn contour(&self, at: [f64; D], outward: [f64; D], piece: usize) -> Contour<D>;

    /// See [`Shape::polygons`].
    fn polygons(&self) -> Polygons<D> {
        Polygons::default()
    }

    /// See [`Shape::mass`].
    fn mass(&self, density: f64) -> [f64; N];
}

/// What the engine asks of a shape; its frame is the body's principal frame, its origin the centre of mass.
pub trait Shape<S, const D: usize, const N: usize>: Clone + std::fmt::Debug + Send + Sync + 'static
where
    S: Space<D, N>,
{
    /// Radius of the ball around the centre of mass that holds the shape, m; `None` for an unbounded shape.
    fn bounding_radius(&self) -> Option<f64>;

    /// Outward unit normal (world) of a half-space that holds an unbounded shape so turned and has the body's position on its
    /// boundary; `None` where there is no such half-space. Detection uses it to pass over bodies far outside.
    fn bounding_normal(&self, rotation: S::Rotation) -> Option<[f64; D]>;

    /// Whether the normal of every contact passes through the centre of mass, as for a disk or a ball.
    fn is_round(&self) -> bool;

    /// Whether the straight way between any two of its points lies inside; of a compound it is not asked.
    fn is_convex(&self) -> bool;

    /// The shapes that it is made of; none where it is of one piece.
    fn parts(&self) -> &[Part<Self, S::Rotation, D>];

    /// What its surface is like near the point `at` of it, where a contact has the normal `outward` (both in the body's frame); `piece` is the
    /// number of the triangle or segment, of a shape of many. A shape of several parts is not asked, its part is.
    fn contour(&self, at: [f64; D], outward: [f64; D], piece: usize) -> Contour<D>;

    /// Its boundary as polygons, to be drawn: those of a bounded shape enclose it, or nearly where it is curved; an unbounded one may have
    /// none.
    fn polygons(&self) -> Polygons<D>;

    /// Diagonal of the mass matrix at this density: the mass `D` times, then the principal moments; infinite for an unbounded
    /// one.
    fn mass(&self, density: f64) -> [f64; N];

    /// The name of its row in the table of shapes.
    fn name(&self) -> &'static str;

    /// Whether a contact between two shapes can be computed: whether the table of pairs has their row.
    fn has_pair(&self, other: &Self) -> bool;

    /// Finds the contact points of body `a` against body `b` whose gap is at most `reach` (m) and hands each to
    /// `emit(feature, point, normal from a to b, gap)`. Features ascend. They are the same whichever comes first, but of two shapes of a
    /// kind they may say which body a point belongs to.
    fn collide(
        a: Placed<'_, Self, S::Rotation, D>,
        b: Placed<'_, Self, S::Rotation, D>,
        reach: f64,
        emit: &mut impl FnMut(u64, [f64; D], [f64; D], f64),
    );
}
