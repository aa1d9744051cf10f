//! Exact contacts of two shapes: one file a pair, one row in its dimension's table.
//!
//! Everywhere the normal is a unit vector from the first body to the second, the gap is the distance along it, negative where
//! they overlap, and the point lies half-way between the two surfaces. Only sums, products, quotients and square roots are
//! used, in a fixed order, so that the same poses give the same bits on every machine.

/// Writes a dimension's table of pairs and its dispatch. A row `A, B => file;` stands for both orders: `file::collide` gets the
/// bodies in the order of the row. The last row, `(parts of C);`, stands for a body of several parts against any other
/// ([`compound::collide`]).
macro_rules! pairs {
    ($Shape:ident in $Space:ident<$D:literal, $N:literal>:
        $($A:ident, $B:ident => $file:ident;)+
        $((parts of $C:ident);)?
    ) => {
        /// Whether the table has a row for these two.
        #[allow(unreachable_patterns, reason = "a pair of two alike is its own reverse")]
        pub(crate) fn has(a: &$Shape, b: &$Shape) -> bool {
            match (a, b) {
                $(($Shape::$A(_), $Shape::$B(_)) => true,
                ($Shape::$B(_), $Shape::$A(_)) => true,)+
                $(($Shape::$C(compound), other) | (other, $Shape::$C(compound)) => {
                    compound.parts().iter().all(|part| has(&part.shape, other))
                })?
                _ => false,
            }
        }

        /// Finds the contacts of `a` and `b` with a gap of at most `reach`; nothing where the table has no row.
        #[inline]
        #[allow(unreachable_patterns, reason = "a pair of two alike is its own reverse")]
        pub(crate) fn collide(
            (a, pose_a): Placed<'_, $Shape, <$Space as Space<$D, $N>>::Rotation, $D>,
            (b, pose_b): Placed<'_, $Shape, <$Space as Space<$D, $N>>::Rotation, $D>,
            reach: f64,
            emit: &mut impl FnMut(u64, [f64; $D], [f64; $D], f64),
        ) {
            match (a, b) {
                $(($Shape::$A(a), $Shape::$B(b)) => $file::collide((a, pose_a), (b, pose_b), reach, emit),
                ($Shape::$B(b), $Shape::$A(a)) => {
                    let mut flipped = |feature, point, n: [f64; $D], gap| emit(feature, point, n.map(|x| -x), gap);
                    $file::collide((a, pose_b), (b, pose_a), reach, &mut flipped);
                })+
                $(($Shape::$C(_), _) | (_, $Shape::$C(_)) => {
                    crate::detect::narrow::compound::collide::<$Space, $D, $N>((a, pose_a), (b, pose_b), reach, emit);
                })?
                _ => {}
            }
        }
    };
}

mod common;
mod compound;
pub(crate) mod plane;
pub(crate) mod solid;
pub(crate) mod vector;

pub(super) use common::{part_bits, two_round};
pub(crate) use common::{parts_of, piece_of};
