//! Stages 6 and 7: from bodies to contacts. Each contact gets its frame, its velocities H* v (eqs. 15, 19, 20) and its law.

use super::workspace::Localised;
use crate::bodies::Bodies;
use crate::contacts::{Contact, ContactKey};
use crate::shape::Shape;
use crate::space::{Pose, Space, swept};
use crate::world::World;
use moreau_solve::block::{dot, norm, tangent_norm};
use moreau_solve::law::Approach;
use moreau_solve::tasks;

/// Spins in the world of all bodies, at the beginning of the step and without contacts.
#[derive(Default)]
pub(super) struct Spins {
    pub(super) before: Vec<[f64; 3]>,
    free: Vec<[f64; 3]>,
}

impl Spins {
    /// Turns them into the world, at the predicted configuration.
    pub(super) fn fill<S: Space<D, N>, const D: usize, const N: usize>(
        &mut self,
        middle: &[Pose<S::Rotation, D>],
        [before, free]: [&[[f64; N]]; 2],
    ) {
        let spin = |i: usize, v: &[[f64; N]]| S::spin_in_world(middle[i].rotation, &v[i]);
        tasks::fill(&mut self.before, middle.len(), |i| spin(i, before));
        // Where no torque acts they are the same.
        let same = |i: usize| before[i][D..] == free[i][D..];
        tasks::fill(&mut self.free, middle.len(), |i| if same(i) { self.before[i] } else { spin(i, free) });
    }
}

/// A contact that slides by less than this part of the smaller body's radius in a step is not asked how its velocity changes.
const SLIDES: f64 = 1e-7;

/// A contact slides steadily if its velocity is so many times half of what it changed by in the last step: the next steps do not end it.
const STEADY: f64 = 8.0;

/// How many times wider a gap may be where a contact carried something in the step before, to count as closed: a millionth of a body's size.
const LASTING: f64 = 1e3;

/// A contact that goes no farther in a step than so many times what rounding may make of a gap is at rest: a ten-millionth of a body's size.
const AT_REST: f64 = 1e2;

/// How deep a contact that acts when closed may be going to get in a step, as a part of the smaller body's bounding radius.
pub(super) const DEEPEST: f64 = 0.1;

/// What localising reads.
pub(super) struct Localiser<'a, S: Space<D, N>, const D: usize, const N: usize> {
    pub(super) world: &'a World<S, D, N>,
    pub(super) middle: &'a [Pose<S::Rotation, D>],
    pub(super) free: &'a [[f64; N]],
    /// `None` where no contact turns a body; velocities are then those along the normal alone.
    pub(super) spins: Option<&'a Spins>,
    /// The remainders of the contacts that were found; none where rows stay those of the prediction.
    pub(super) remainders: &'a [[f64; D]],
    /// The velocities at the beginning of the step before; none where rows stay those of the prediction.
    pub(super) last: &'a [[f64; N]],
    /// The impulses of the step before, sorted by key.
    pub(super) previous: &'a [(ContactKey, [f64; D])],
    pub(super) h: f64,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Localiser<'_, S, D, N> {
    /// Localises those of `found` whose law acts in this step, in order. Until they are solved, `after` is their velocity without
    /// impulses.
    pub(super) fn each(&self, found: &[Contact<D>], contacts: &mut Vec<Localised<D>>) {
        let one = |c: usize| {
            let remainder = self.remainders.get(c).copied().unwrap_or([0.0; D]);
            if self.spins.is_some() { self.one::<true>(&found[c], remainder) } else { self.one::<false>(&found[c], remainder) }
        };
        tasks::fill(contacts, found.len(), one);
        contacts.retain(Localised::acts);
    }

    /// With TURNS the spins count.
    #[inline]
    fn one<const TURNS: bool>(&self, contact: &Contact<D>, remainder: [f64; D]) -> Localised<D> {
        let bodies = &self.world.bodies;
        let (a, b) = (contact.key.a as usize, contact.key.b as usize);
        let frame = S::frame(contact.normal);
        let spins = |of: fn(&Spins) -> &[[f64; 3]]| self.spins.map_or([].as_slice(), of);
        let before = |body: usize| self.at_point::<TURNS>(contact, body, &bodies.velocity, spins(|spins| &spins.before));
        let (before_a, before_b) = (before(a), before(b));
        let before = in_frame::<D, TURNS>(&frame, &before_a, &before_b);
        let mut remainder = in_frame::<D, TURNS>(&frame, &[0.0; D], &remainder);
        if TURNS && let Some(half) = self.half_change(contact, &frame, [a, b], &before) {
            (1..D).for_each(|i| remainder[i] = -half[i]);
        }
        let remainder = lasting(remainder, before[0], contact.gap / self.h);
        let size = smaller(bodies, [a, b]);
        let closed_below = self.closed_below(contact, size, self.h * (norm(&before) + norm(&remainder)));
        let deepest = DEEPEST * size;
        let approach = Approach { gap: contact.gap, closed_below, deepest, before, remainder, step: self.h };
        let form = self.world.laws.get(bodies.material[a], bodies.material[b]).normal_form(&approach);
        let free = |body: usize| self.at_point::<TURNS>(contact, body, self.free, spins(|spins| &spins.free));
        let (after_a, after_b) = (free(a), free(b));
        let after = in_frame::<D, TURNS>(&frame, &after_a, &after_b);
        // The mean over the step of what driven bodies give.
        let given = |body: usize, v: &[f64; D], w: &[f64; D]| {
            if bodies.is_free(body) { [0.0; D] } else { std::array::from_fn(|k| 0.5 * (v[k] + w[k])) }
        };
        let driven = match (bodies.is_free(a), bodies.is_free(b)) {
            (true, true) => [0.0; D],
            _ => in_frame::<D, TURNS>(&frame, &given(a, &before_a, &after_a), &given(b, &before_b, &after_b)),
        };
        Localised::new(*contact, frame, form, [before, after, driven])
    }

    /// Below which gap a contact that goes so far in the step (m) counts as closed, m: rounding, and where it is at rest and carried something in the step before a little more. What a solve's tolerance opens at some corners of a
    /// face must not leave the others to carry everything.
    fn closed_below(&self, contact: &Contact<D>, size: f64, goes: f64) -> f64 {
        let pair = [contact.key.a, contact.key.b].map(|body| body as usize);
        let rounding = closed_below(&self.world.bodies, pair, size);
        let lasting = LASTING * rounding;
        let carried = || {
            let before = self.previous.binary_search_by(|(key, _)| key.cmp(&contact.key));
            before.is_ok_and(|c| self.previous[c].1[0] > 0.0)
        };
        let rests = goes <= AT_REST * rounding;
        if rests && contact.gap > rounding && contact.gap <= lasting && carried() { lasting } else { rounding }
    }

    /// Of a contact that slides, half of what its velocity is going to change by, as it did in the step before: less that, the velocity at the end is the mean of the step's,
    /// to which friction is opposite (theory, section 23). `None` where it does not slide, or not for long.
    fn half_change(
        &self,
        contact: &Contact<D>,
        frame: &[[f64; D]; D],
        [a, b]: [usize; 2],
        before: &[f64; D],
    ) -> Option<[f64; D]> {
        let slip = tangent_norm(before);
        if a.max(b) >= self.last.len() || self.h * slip <= SLIDES * smaller(&self.world.bodies, [a, b]) {
            return None;
        }
        let velocity = |i: usize| {
            let (v, pose) = (&self.last[i], &self.middle[i]);
            let arm: [f64; D] = std::array::from_fn(|k| contact.point[k] - pose.position[k]);
            let swept = swept(&S::spin_in_world(pose.rotation, v), &arm);
            std::array::from_fn(|k| v[k] + swept[k])
        };
        let last = in_frame::<D, true>(frame, &velocity(a), &velocity(b));
        let half = std::array::from_fn(|i| 0.5 * (before[i] - last[i]));
        (slip >= STEADY * tangent_norm(&half)).then_some(half)
    }

    /// The velocity of a body at the contact, v + ω × arm, or that of its centre.
    #[inline]
    fn at_point<const TURNS: bool>(&self, contact: &Contact<D>, body: usize, v: &[[f64; N]], spins: &[[f64; 3]]) -> [f64; D] {
        let v = &v[body];
        if !TURNS {
            return std::array::from_fn(|k| v[k]);
        }
        let position = &self.middle[body].position;
        let arm: [f64; D] = std::array::from_fn(|k| contact.point[k] - position[k]);
        let swept = swept(&spins[body], &arm);
        std::array::from_fn(|k| v[k] + swept[k])
    }
}

/// What of a remainder counts where the gap has the rate `before`, m/s, at the predicted configuration, and closes in this step at the rate `closing`: all in contact that
/// lasts, whose rate at the beginning is next to nothing; at an impact, which changes the velocity that the remainder was taken from, the part
/// that cannot make energy of first order (theory (84)). A gap that is wider than a contact that lasts has is not taken to open by itself: what
/// meets there may be going to turn otherwise.
#[inline]
fn lasting<const D: usize>(remainder: [f64; D], before: f64, closing: f64) -> [f64; D] {
    if remainder == [0.0; D] {
        return remainder;
    }
    if remainder[0] > 0.0 && closing > 2.0 * remainder[0] {
        return [0.0; D];
    }
    let (size, rate) = (norm(&remainder), (before - remainder[0]).abs());
    if rate <= size { remainder } else { remainder.map(|x| x * (size / rate)) }
}

/// The velocity of b relative to a in the contact's frame, or along its normal alone.
#[inline]
fn in_frame<const D: usize, const TURNS: bool>(frame: &[[f64; D]; D], a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    let relative = std::array::from_fn(|k| b[k] - a[k]);
    std::array::from_fn(|i| if TURNS || i == 0 { dot(&frame[i], &relative) } else { 0.0 })
}

/// The smallest bounding radius of some bodies, m; infinite if none is bounded.
#[inline]
pub(super) fn smaller<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    some: impl IntoIterator<Item = usize>,
) -> f64 {
    some.into_iter().filter_map(|i| bodies.shape[i].bounding_radius()).fold(f64::INFINITY, f64::min)
}

/// A gap below this part of the smaller body counts as closed: the rounding of positions must not open a contact for a step, in
/// which a body at rest would fall or slip by g h². Positions are rounded relative to their distance from the origin.
#[inline]
fn closed_below<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, pair: [usize; 2], size: f64) -> f64 {
    let far = pair.iter().flat_map(|&i| bodies.pose[i].position).map(f64::abs).fold(0.0, f64::max);
    if size.is_finite() { rounding(size, far) } else { 0.0 }
}

/// How far from body `i` contacts are looked for when nothing moves, m: a part of its size, and rounding. The size of a driven body, which may
/// be all the ground, says nothing of what comes near.
#[inline]
pub(super) fn margins<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, i: usize, part: f64) -> [f64; 2] {
    let radius = bodies.shape[i].bounding_radius().unwrap_or(0.0);
    let far = bodies.pose[i].position.iter().fold(0.0_f64, |far, x| far.max(x.abs()));
    [if bodies.is_free(i) { part * radius } else { 0.0 }, rounding(radius, far)]
}

/// No point of a body of this bounding radius (m) is faster than this at its velocity, m/s.
#[inline]
pub(super) fn speed<const D: usize, const N: usize>(radius: f64, v: &[f64; N]) -> f64 {
    let length = |part: &[f64]| part.iter().map(|x| x * x).sum::<f64>().sqrt();
    length(&v[..D]) + length(&v[D..]) * radius
}

/// How wrong a gap may be, for bodies of this size this far from the origin.
#[inline]
fn rounding(size: f64, far: f64) -> f64 {
    1e-9 * size + 16.0 * f64::EPSILON * far
}
