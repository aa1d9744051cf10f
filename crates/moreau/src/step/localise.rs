//! Stages 6 and 7: from bodies to contacts. Each contact gets its frame, its velocities H* v (eqs. 15, 19, 20) and its law.

use super::workspace::Localised;
use crate::contacts::Contact;
use crate::shape::Shape;
use crate::space::{Pose, Space};
use crate::world::World;
use moreau_solve::block::dot;
use moreau_solve::law::Approach;
use rayon::prelude::*;

/// The two blocks of a contact's row of H*, of body `a` and of body `b`.
pub(super) type Rows<const D: usize, const N: usize> = [[[f64; N]; D]; 2];

/// The two blocks of a contact's row of H*: minus for body `a`, plus for body `b`, so that H* v is the velocity of b relative to a.
pub(super) fn rows<S: Space<D, N>, const D: usize, const N: usize>(
    shapes: &[S::Shape],
    middle: &[Pose<S::Rotation, D>],
    contact: &Contact<D>,
    frame: &[[f64; D]; D],
) -> Rows<D, N> {
    let side = |body: u32, sign: f64| {
        let (shape, pose) = (&shapes[body as usize], &middle[body as usize]);
        let arm = std::array::from_fn(|k| contact.point[k] - pose.position[k]);
        std::array::from_fn(|i| {
            let mut row = S::row(pose.rotation, arm, frame[i]).map(|x| sign * x);
            if i == 0 && shape.is_round() {
                // The normal of a round body passes through its centre; rounding must not make it spin.
                row[D..].fill(0.0);
            }
            row
        })
    };
    [side(contact.key.a, -1.0), side(contact.key.b, 1.0)]
}

/// A contact before the solve, its velocity without impulses, and its rows; `None` if its law does not act in this step.
pub(super) type Prepared<const D: usize, const N: usize> = Option<(Localised<D>, [f64; D], Rows<D, N>)>;

/// Localises all of `contacts`, in order; by several threads where there are enough of them to pay.
pub(super) fn localise_all<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    middle: &[Pose<S::Rotation, D>],
    free: &[[f64; N]],
    contacts: &[Contact<D>],
    h: f64,
    prepared: &mut Vec<Prepared<D, N>>,
) {
    if contacts.len() < 1024 || rayon::current_num_threads() == 1 {
        prepared.clear();
        prepared.extend(contacts.iter().map(|contact| localise(world, middle, free, contact, h)));
    } else {
        contacts.par_iter().map(|contact| localise(world, middle, free, contact, h)).collect_into_vec(prepared);
    }
}

fn localise<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    middle: &[Pose<S::Rotation, D>],
    free: &[[f64; N]],
    contact: &Contact<D>,
    h: f64,
) -> Prepared<D, N> {
    let bodies = &world.bodies;
    let pair = [contact.key.a as usize, contact.key.b as usize];
    let frame = S::frame(contact.normal);
    let rows = rows::<S, D, N>(&bodies.shape, middle, contact, &frame);
    let relative = |v: &[[f64; N]], count: &dyn Fn(usize) -> bool| -> [f64; D] {
        std::array::from_fn(|i| (0..2).filter(|&s| count(pair[s])).map(|s| dot(&rows[s][i], &v[pair[s]])).sum())
    };
    let before = relative(&bodies.velocity, &|_| true);
    let driven = relative(&bodies.velocity, &|body| !bodies.is_free(body));
    let approach = Approach { gap: contact.gap, closed_below: closed_below(bodies, pair), before, step: h };
    let form = world.laws.get(bodies.material[pair[0]], bodies.material[pair[1]]).normal_form(&approach)?;
    let u_free = relative(free, &|_| true);
    let localised = Localised { contact: *contact, frame, form, before, after: [0.0; D], driven, impulse: [0.0; D] };
    Some((localised, std::array::from_fn(|i| u_free[i] + form.shift[i]), rows))
}

/// A gap below this part of the smaller body counts as closed: the rounding of positions must not open a contact for a step, in
/// which a body at rest would fall or slip by g h². Positions are rounded relative to their distance from the origin.
fn closed_below<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &crate::bodies::Bodies<S, D, N>,
    pair: [usize; 2],
) -> f64 {
    let size = pair.iter().filter_map(|&i| bodies.shape[i].bounding_radius()).fold(f64::INFINITY, f64::min);
    let far = pair.iter().flat_map(|&i| bodies.pose[i].position).map(f64::abs).fold(0.0, f64::max);
    if size.is_finite() { rounding(size, far) } else { 0.0 }
}

/// How wrong a gap may be, for bodies of this size this far from the origin.
pub(super) fn rounding(size: f64, far: f64) -> f64 {
    1e-9 * size + 16.0 * f64::EPSILON * far
}
