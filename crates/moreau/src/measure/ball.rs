//! What a ball and a box, or a disk and a rectangle, have in common; theory (69)-(71).

use super::Cell;
use moreau_solve::block::{dot, sub};
use std::f64::consts::PI;

/// The exact volume (m³; area in the plane, m²) of what a ball with this centre and radius (m) has inside the cell, to rounding of the
/// volume of the ball.
pub fn ball_in<const D: usize>(centre: &[f64; D], radius: f64, cell: &Cell<D>) -> f64 {
    let sides = [sub(&cell.min, centre), sub(&cell.max, centre)];
    // A corner of the cell for each number: bit k says on which side it is along axis k.
    let of_corner = |corner: usize| {
        let at: [f64; D] = std::array::from_fn(|k| sides[corner >> k & 1][k]);
        let sign: f64 = (0..D).map(|k| if corner >> k & 1 == 1 { at[k].signum() } else { -at[k].signum() }).product();
        sign * from_centre(radius, &at.map(|x| x.abs().min(radius)))
    };
    (0..1 << D).map(of_corner).sum::<f64>().max(0.0)
}

/// Of the box between the centre and a corner with coordinates from 0 to the radius.
fn from_centre<const D: usize>(r: f64, corner: &[f64; D]) -> f64 {
    if dot(corner, corner) <= r * r {
        return corner.iter().product();
    }
    match corner[..] {
        [a, b] => strip(r, a) + strip(r, b) - PI / 4.0 * r * r,
        [a, b, c] => {
            let slices = slice(r, a) + slice(r, b) + slice(r, c);
            PI / 6.0 * r * r * r - slices + wedge(r, a, b) + wedge(r, b, c) + wedge(r, c, a)
        }
        _ => 0.0,
    }
}

/// Of a quarter disk, all that is nearer than `a` to one of its sides.
fn strip(r: f64, a: f64) -> f64 {
    let w = (r * r - a * a).max(0.0).sqrt();
    0.5 * (a * w + r * r * libm::atan2(a, w))
}

/// Of an eighth of a ball, all that is nearer than `a` to one of its sides.
fn slice(r: f64, a: f64) -> f64 {
    PI / 4.0 * a * (r * r - a * a / 3.0)
}

/// Of an eighth of a ball, all that is nearer than `a` to one of its sides and nearer than `b` to another.
fn wedge(r: f64, a: f64, b: f64) -> f64 {
    let square = r * r - a * a - b * b;
    if square <= 0.0 {
        return slice(r, a) + slice(r, b) - PI / 6.0 * r * r * r;
    }
    // All angles by the same root: near the surface of the ball its rounding then cancels.
    let w = square.sqrt();
    let part = |x: f64| x * (r * r - x * x / 3.0);
    a * b * w / 3.0 + 0.5 * (part(a) * libm::atan2(b, w) + part(b) * libm::atan2(a, w))
        - r * r * r / 3.0 * libm::atan2(a * b, r * w)
}
