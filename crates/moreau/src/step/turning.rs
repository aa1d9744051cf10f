//! Contacts that turn: how the rate of a gap, and the velocity along the surfaces, change from the predicted configuration to the end of the step
//! (theory, section 23).
//!
//! The law of a step speaks of v⁺, the velocity at its end, while the rows H* are those of q_m, half a step earlier. For a body that rolls on its rim
//! or turns about a corner the two differ by O(h). With v for v⁺ the difference is known before the solve and becomes a part of the shift:
//!
//! ```text
//! s_n = (gap(q_m + h v) − gap(q_m))/h − H_n* v          s_T = (H_T*(q_m + h/2 v) − H_T*(q_m)) v
//! ```
//!
//! Gaps and points are those of the simple contours that the surfaces have near the contact (`meet`). What turns by less than [`ANGLE`] in a step has none,
//! so contacts at rest are solved as if there were no remainder.

mod meet;
mod one_motion;

use super::integrate::moved;
use crate::bodies::Bodies;
use crate::contacts::{Contact, ContactKey};
use crate::detect::{parts_of, piece_of};
use crate::shape::{Contour, Shape};
use crate::space::{Pose, Space, placed, swept};
use meet::{Meeting, meet};
use moreau_solve::block::{axpy, dot, norm, sub};
use moreau_solve::tasks;
use one_motion::one_motion;

/// Angle (rad) by which a contact has to turn in a step for its remainder to count: below, the gap is off by less than 1e-14 of the body's size.
const ANGLE: f64 = 1e-7;

/// Rounding of a gap, as a part of the sizes that it is computed from.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// What the remainder of a contact is computed from.
pub(super) struct Turning<'a, S: Space<D, N>, const D: usize, const N: usize> {
    pub(super) bodies: &'a Bodies<S, D, N>,
    pub(super) middle: &'a [Pose<S::Rotation, D>],
    /// Spins in the world at the beginning of the step; `None` where no contact turns a body.
    pub(super) spins: Option<&'a [[f64; 3]]>,
    pub(super) h: f64,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Turning<'_, S, D, N> {
    /// Writes the remainder of each contact that was found, in the world, m/s. Contacts are in the order of their pairs.
    ///
    /// `previous` are the impulses of the step before, for [`one_motion`].
    pub(super) fn fill(&self, found: &[Contact<D>], previous: &[(ContactKey, [f64; D])], remainders: &mut Vec<[f64; D]>) {
        tasks::fill(remainders, found.len(), |c| self.remainder(&found[c]).unwrap_or([0.0; D]));
        if self.spins.is_some() {
            one_motion::<S, D, N>(found, previous, remainders);
        }
    }

    /// The remainder of a contact in the world; `None` where it has none.
    #[inline]
    fn remainder(&self, contact: &Contact<D>) -> Option<[f64; D]> {
        let pair = [contact.key.a, contact.key.b].map(|body| body as usize);
        let round = pair.map(|i| self.bodies.shape[i].is_round());
        match round {
            [true, true] => self.of_round(contact, pair),
            // A round body on what keeps still and is flat: each step is as the one before.
            [true, false] if self.keeps_normal(pair[1]) => None,
            [false, true] if self.keeps_normal(pair[0]) => None,
            _ => self.of_contours(contact, pair),
        }
    }

    /// The remainder of two balls: their normal turns as they pass each other.
    fn of_round(&self, contact: &Contact<D>, [a, b]: [usize; 2]) -> Option<[f64; D]> {
        let between = sub(&self.middle[b].position, &self.middle[a].position);
        let velocity = |i: usize| -> [f64; D] { std::array::from_fn(|k| self.bodies.velocity[i][k]) };
        let passing = sub(&velocity(b), &velocity(a));
        let distance = norm(&between);
        let along = dot(&contact.normal, &passing);
        let across = norm(&axpy(&passing, -along, &contact.normal));
        if self.h * across <= ANGLE * distance {
            return None;
        }
        let normal = (norm(&axpy(&between, self.h, &passing)) - distance) / self.h - along;
        let Some(spins) = self.spins else { return Some(contact.normal.map(|x| normal * x)) };
        let end = axpy(&between, 0.5 * self.h, &passing);
        let length = norm(&end);
        let turned: [f64; D] = std::array::from_fn(|k| end[k] / length - contact.normal[k]);
        // Radii are the way from each centre to the point, which is on the normal.
        let radius = |i: usize| norm(&sub(&contact.point, &self.middle[i].position));
        let spin = std::array::from_fn(|k| -radius(b) * spins[b][k] - radius(a) * spins[a][k]);
        Some(with_normal(swept(&spin, &turned), normal, &contact.normal))
    }

    /// Whether a contact with a body that is unbounded and flat keeps its normal: whether that does not turn.
    fn keeps_normal(&self, i: usize) -> bool {
        let shape = &self.bodies.shape[i];
        shape.bounding_normal(self.middle[i].rotation).is_some() && self.turn(i) <= ANGLE
    }

    /// By which angle body `i` turns in a step, rad.
    fn turn(&self, i: usize) -> f64 {
        self.h * self.bodies.velocity[i][D..].iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    /// The remainder where the contour of a body says how the contact moves over it.
    fn of_contours(&self, contact: &Contact<D>, pair: [usize; 2]) -> Option<[f64; D]> {
        // The spin of what is round leaves its contacts where they are.
        let turns = pair.into_iter().any(|i| !self.bodies.shape[i].is_round() && self.turn(i) > ANGLE);
        let passing: [f64; D] = std::array::from_fn(|k| self.bodies.velocity[pair[1]][k] - self.bodies.velocity[pair[0]][k]);
        let size = pair.iter().filter_map(|&i| self.bodies.shape[i].bounding_radius()).fold(f64::INFINITY, f64::min);
        if !turns && self.h * norm(&passing) <= ANGLE * size {
            return None;
        }
        let contours = self.contours(contact, pair);
        let flat = |contour: &Contour<D>| matches!(contour, Contour::Flat { .. });
        if !turns && contours.iter().any(flat) {
            return None;
        }
        let meeting = |time: f64| self.meeting(&contours, contact.normal, pair, time);
        let (now, end, next) = (meeting(0.0)?, meeting(0.5 * self.h)?, meeting(self.h)?);
        let frozen = sub(&self.point_velocity(pair[1], &contact.point, 0.0), &self.point_velocity(pair[0], &contact.point, 0.0));
        let normal = (next.gap - now.gap) / self.h - dot(&contact.normal, &frozen);
        let change = |i: usize| sub(&self.point_velocity(i, &end.point, 0.5 * self.h), &self.point_velocity(i, &now.point, 0.0));
        let slip = sub(&change(pair[1]), &change(pair[0]));
        // What is only rounding is none: contacts of one face would ask for velocities that no motion has, by so little that no solve ends it.
        let far = pair.iter().flat_map(|&i| self.middle[i].position).fold(0.0_f64, |far, x| far.max(x.abs()));
        let rounding = ROUNDING * (size + far) / self.h;
        let whole = |x: f64| if x.abs() <= rounding { 0.0 } else { x };
        let slip = axpy(&slip, -dot(&slip, &contact.normal), &contact.normal);
        let slip = if norm(&slip) <= rounding { [0.0; D] } else { slip };
        let remainder = with_normal(slip, whole(normal), &contact.normal);
        remainder.iter().all(|x| x.is_finite()).then_some(remainder)
    }

    /// The velocity of body `i` at a point of the world, after it has moved on for a time.
    fn point_velocity(&self, i: usize, point: &[f64; D], time: f64) -> [f64; D] {
        let v = &self.bodies.velocity[i];
        let arm: [f64; D] = std::array::from_fn(|k| point[k] - (self.middle[i].position[k] + time * v[k]));
        let spin = self.spins.map_or_else(|| S::spin_in_world(self.middle[i].rotation, v), |spins| spins[i]);
        let swept = swept(&spin, &arm);
        std::array::from_fn(|k| v[k] + swept[k])
    }

    /// How two bodies meet after both have moved on for a time.
    fn meeting(&self, contours: &[Contour<D>; 2], normal: [f64; D], pair: [usize; 2], time: f64) -> Option<Meeting<D>> {
        let placed = |k: usize| {
            let i = pair[k];
            contours[k].placed::<S, N>(&moved::<S, D, N>(&self.middle[i], &self.bodies.velocity[i], time))
        };
        meet(&[placed(0), placed(1)], normal)
    }

    /// The contours of the two bodies at a contact, in their frames. Of two flat ones the smaller body shows its point.
    fn contours(&self, contact: &Contact<D>, pair: [usize; 2]) -> [Contour<D>; 2] {
        let parts = pair.map(|i| self.bodies.shape[i].parts());
        let has_parts = parts.map(|parts| !parts.is_empty());
        let (numbers, piece) = (parts_of(contact.key.feature, has_parts), piece_of(contact.key.feature, has_parts));
        let sides = [-1.0, 1.0].map(|sign| axpy(&contact.point, sign * 0.5 * contact.gap, &contact.normal));
        let contour = |k: usize, sign: f64| {
            let pose = &self.middle[pair[k]];
            let part = parts[k].get(numbers[k]);
            let own = part.map_or(*pose, |part| placed::<S, D, N>(pose, &part.pose));
            let at = S::unrotate(own.rotation, sub(&sides[k], &own.position));
            let outward = S::unrotate(own.rotation, contact.normal.map(|x| sign * x));
            let shape = part.map_or(&self.bodies.shape[pair[k]], |part| &part.shape);
            let contour = shape.contour(at, outward, piece);
            part.map_or(contour, |part| contour.placed::<S, N>(&part.pose))
        };
        let mut contours = [contour(0, 1.0), contour(1, -1.0)];
        if let [Contour::Flat { at: a, .. }, Contour::Flat { at: b, .. }] = contours {
            let size = pair.map(|i| self.bodies.shape[i].bounding_radius().unwrap_or(f64::INFINITY));
            if size[0] < size[1] { contours[0] = Contour::corner(a) } else { contours[1] = Contour::corner(b) }
        }
        // A straight side over a flat one touches it at the point that the contact has, which goes with the body.
        for k in 0..2 {
            if let (Contour::Line { radius, .. }, Contour::Flat { .. }) = (contours[k], contours[1 - k]) {
                let pose = &self.middle[pair[k]];
                let way = if k == 0 { -radius } else { radius };
                let centre = S::unrotate(pose.rotation, sub(&axpy(&sides[k], way, &contact.normal), &pose.position));
                contours[k] = Contour::Ball { centre, radius };
            }
        }
        contours
    }
}

/// A vector with this part along a unit vector in place of its own.
fn with_normal<const D: usize>(v: [f64; D], part: f64, normal: &[f64; D]) -> [f64; D] {
    axpy(&v, part - dot(&v, normal), normal)
}
