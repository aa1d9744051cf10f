//! Contacts that read the same in both dimensions: round bodies, and corners, on each other and on flat boundaries.

use super::vector::{NO_DIRECTION, along, dot, sub};

/// Of the size of the bodies: what sides and faces that are level, and vertices that are opposite each other, may differ by. Rounding
/// must not decide between them.
pub(super) const LEVEL: f64 = 1e-9;

/// One minus the cosine of the angle between two normals below which the points of a face, if one of them is as near, are taken in place of the one of two edges. The plane of
/// a face goes on beyond it: a corner of a tilted body may be deeper under that plane, where the other body is not, than two edges are in each other. One
/// point instead of four would let the body tilt further.
pub(super) const SAME: f64 = 1e-8;

/// In parts of what is level: a hundredth of the size. Only so near, and so little deep, bodies have points of a face so.
pub(super) const CLOSE: f64 = 1e7;

/// The highest bits of a feature: the part of the second of two bodies of parts, or of the one such body.
const LAST_PART: u32 = 54;

/// The bits below: the part of the first of two bodies of parts.
const FIRST_PART: u32 = 44;

/// The bits above the pair's own: the piece of a body that is one surface in many pieces, such as the segment of a polyline.
const PIECE: u32 = 32;

/// The feature of a contact on a piece of a surface.
#[inline]
pub(super) fn on_piece(piece: usize, feature: u64) -> u64 {
    ((piece as u64) << PIECE) | feature
}

/// The feature of a contact on a part of the first of two bodies of parts.
#[inline]
pub(super) fn on_first_part(part: usize, feature: u64) -> u64 {
    ((part as u64) << FIRST_PART) | feature
}

/// The feature of a contact on a part of the second of two bodies of parts, or of the one such body.
#[inline]
pub(super) fn on_last_part(part: usize, feature: u64) -> u64 {
    ((part as u64) << LAST_PART) | feature
}

/// The parts of both bodies that a contact with this feature is on, 0 for a body that `has_parts` says is of one piece.
#[inline]
pub(crate) fn parts_of(feature: u64, has_parts: [bool; 2]) -> [usize; 2] {
    const PART: u64 = (1 << (LAST_PART - FIRST_PART)) - 1;
    let [first, last] = [FIRST_PART, LAST_PART].map(|bits| ((feature >> bits) & PART) as usize);
    match has_parts {
        [false, false] => [0, 0],
        [true, false] => [last, 0],
        [false, true] => [0, last],
        [true, true] => [first, last],
    }
}

/// The bits of a feature that say which parts it is on.
#[inline]
pub(in crate::detect) fn part_bits(feature: u64, has_parts: [bool; 2]) -> u64 {
    match has_parts {
        [false, false] => 0,
        [true, true] => feature >> FIRST_PART << FIRST_PART,
        _ => feature >> LAST_PART << LAST_PART,
    }
}

/// The piece of a surface that a contact with this feature is on.
#[inline]
pub(crate) fn piece_of(feature: u64, has_parts: [bool; 2]) -> usize {
    let bits = match has_parts {
        [true, true] => 0,
        [false, false] => u64::MAX,
        _ => (1 << (LAST_PART - PIECE)) - 1,
    };
    ((feature >> PIECE) & bits) as usize
}

/// Two round bodies (centre, radius). Where the centres coincide every direction is as good as another; the last axis is taken.
#[inline]
pub(in crate::detect) fn two_round<const D: usize>(
    (centre_a, radius_a): ([f64; D], f64),
    (centre_b, radius_b): ([f64; D], f64),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; D], [f64; D], f64),
) {
    let between = sub(centre_b, centre_a);
    let square = dot(between, between);
    let distance = square.sqrt();
    let gap = distance - (radius_a + radius_b);
    if gap <= reach {
        let normal = if square > NO_DIRECTION { between.map(|x| x / distance) } else { last_axis() };
        let (on_a, on_b) = (along(centre_a, radius_a, normal), along(centre_b, -radius_b, normal));
        emit(0, std::array::from_fn(|k| 0.5 * (on_a[k] + on_b[k])), normal, gap);
    }
}

/// A round body (first) over a flat boundary through `on_wall` with this outward normal.
#[inline]
pub(super) fn round_on_wall<const D: usize>(
    (centre, radius): ([f64; D], f64),
    (on_wall, outward): ([f64; D], [f64; D]),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; D], [f64; D], f64),
) {
    let gap = dot(outward, sub(centre, on_wall)) - radius;
    if gap <= reach {
        emit(0, along(centre, -(radius + 0.5 * gap), outward), outward.map(|x| -x), gap);
    }
}

/// One corner (world) of a body over a flat boundary.
#[inline]
pub(super) fn corner_on_wall<const D: usize>(
    feature: u64,
    corner: [f64; D],
    (on_wall, outward): ([f64; D], [f64; D]),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; D], [f64; D], f64),
) {
    let gap = dot(outward, sub(corner, on_wall));
    if gap <= reach {
        emit(feature, along(corner, -0.5 * gap, outward), outward.map(|x| -x), gap);
    }
}

fn last_axis<const D: usize>() -> [f64; D] {
    std::array::from_fn(|k| if k + 1 == D { 1.0 } else { 0.0 })
}
