//! What a body touches when it is lifted out of the piece that it has sunk into.

use super::{Patch, SAME};
use crate::contacts::{Contact, ContactKey};
use crate::detect::Scene;
use crate::detect::narrow::part_bits;
use crate::detect::narrow::vector::{along, dot};
use crate::shape::Shape;
use crate::space::{Pose, Space, placed};

/// One minus the cosine of the angle by which the normal of a contact may turn when the body is lifted.
const TURNED: f64 = 1e-3;

/// Cosine of the angle between two normals beyond which two pieces may be far apart.
const STEEP: f64 = 0.7;

/// Radius of the ball that measures how far apart two pieces are, of the size of the smaller piece.
const PROBE: f64 = 1.0 / 64.0;

/// A part of a body, or a body of one part.
pub(super) struct Piece<'a, S: Space<D, N>, const D: usize, const N: usize> {
    shape: &'a S::Shape,
    pose: Pose<S::Rotation, D>,
    /// Bounding radius, m; infinite for an unbounded piece.
    pub(super) radius: f64,
}

impl<'a, S: Space<D, N>, const D: usize, const N: usize> Piece<'a, S, D, N> {
    pub(super) fn new(scene: &Scene<'a, S, D, N>, (body, part): (u32, usize)) -> Self {
        let (shape, pose) = (&scene.shapes[body as usize], &scene.poses[body as usize]);
        match shape.parts().get(part) {
            Some(part) => Self { shape: &part.shape, pose: placed::<S, D, N>(pose, &part.pose), radius: part.radius },
            None => Self { shape, pose: *pose, radius: shape.bounding_radius().unwrap_or(f64::INFINITY) },
        }
    }
}

/// A body lifted out of one piece and slid up to another.
pub(super) struct Lifted<'a, S: Space<D, N>, const D: usize, const N: usize> {
    /// The body's piece, the one that it is slid up to, and the one that it is lifted out of.
    body: Piece<'a, S, D, N>,
    other: Piece<'a, S, D, N>,
    over: Piece<'a, S, D, N>,
    over_normal: [f64; D],
    /// How deep the body is in the piece that it is lifted out of, m.
    depth: f64,
    /// How far the lifted body is moved, m.
    shift: [f64; D],
    /// The greatest gap of a contact of the lifted body, m.
    closed: f64,
    /// The greatest gap of a contact of the body, m.
    reach: f64,
    has_parts: [bool; 2],
}

impl<'a, S: Space<D, N>, const D: usize, const N: usize> Lifted<'a, S, D, N> {
    pub(super) fn new(scene: &Scene<'a, S, D, N>, patch: &Patch<D>, over: &Patch<D>) -> Self {
        let [body, other, over_piece] = [patch.of, patch.on, over.on].map(|piece| Piece::new(scene, piece));
        let margin = patch.margin();
        // Slid along the normal until it is as deep in the other piece as the margin, then lifted until it is clear by the margin.
        let slide = (patch.gap + margin).max(0.0);
        let lift = (slide * dot(patch.normal, over.normal) - over.gap).max(0.0) + margin;
        let shift = along(over.normal.map(|x| lift * x), -slide, patch.normal);
        let far = body.pose.position.iter().fold(0.0_f64, |far, x| far.max(x.abs()));
        let closed = margin + 1e-9 * patch.size + 16.0 * f64::EPSILON * far;
        let [of, on] = [patch.of.0.min(patch.on.0), patch.of.0.max(patch.on.0)].map(|body| body as usize);
        Self {
            body,
            other,
            over: over_piece,
            over_normal: over.normal,
            depth: (-over.gap).max(0.0),
            shift,
            closed,
            reach: scene.reach[of] + scene.reach[on],
            has_parts: [of, on].map(|body| !scene.shapes[body].parts().is_empty()),
        }
    }

    /// True if the piece that hides a contact is beside it: closer than the body is deep, or else steeply inclined to it.
    pub(super) fn is_beside(&self, patch: &Patch<D>, contacts: &[Contact<D>]) -> bool {
        if dot(patch.normal, self.over_normal) < STEEP {
            return true;
        }
        // A ball of which the lowest point is as high over the contact as the body is deep.
        let radius = PROBE * patch.size;
        let (ball, reach) = (S::ball(radius), 2.0 * self.depth + patch.margin());
        contacts.iter().all(|contact| {
            let centre = along(patch.on_other(contact), self.depth + radius, self.over_normal);
            let pose = Pose { position: centre, rotation: S::IDENTITY };
            let mut near = false;
            S::Shape::collide((self.over.shape, &self.over.pose), (&ball, &pose), reach, &mut |_, _, _, _| near = true);
            near
        })
    }

    /// True if the lifted body still has one of the contacts of the patch, or another one with the same normal. If not, `found` has what it touches,
    /// put back to where the body is.
    ///
    /// A contact on a curved body may turn a little when it is lifted, and is known by its feature. Another contact with nearly the same normal is no
    /// proof: a capsule that lies over a cylinder still touches it in the middle when its round end does not.
    pub(super) fn still_touches(&self, patch: &Patch<D>, contacts: &[Contact<D>], found: &mut Vec<Contact<D>>) -> bool {
        found.clear();
        let key = contacts[0].key;
        let parts = part_bits(key.feature, self.has_parts);
        let pose = Pose { position: along(self.body.pose.position, 1.0, self.shift), rotation: self.body.pose.rotation };
        let is_first = patch.of.0 == key.a;
        let sign = if is_first { -1.0 } else { 1.0 };
        let mut still = false;
        let mut emit = |feature, point, normal: [f64; D], gap: f64| {
            if gap > self.closed {
                return;
            }
            let is_known = contacts.iter().any(|contact| contact.key.feature == parts | feature);
            still |= sign * dot(normal, patch.normal) > 1.0 - if is_known { TURNED } else { SAME };
            // The body's point moves back by the shift, the point half-way by half of it.
            let gap = gap - sign * dot(normal, self.shift);
            if gap <= self.reach {
                let key = ContactKey { feature: parts | feature, ..key };
                found.push(Contact { key, point: along(point, -0.5, self.shift), normal, gap });
            }
        };
        let (body, other) = ((self.body.shape, &pose), (self.other.shape, &self.other.pose));
        if is_first {
            S::Shape::collide(body, other, self.closed, &mut emit);
        } else {
            S::Shape::collide(other, body, self.closed, &mut emit);
        }
        if still {
            found.clear();
        }
        still
    }
}
