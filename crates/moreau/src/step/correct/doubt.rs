//! Whether positions need be put right at all: at most steps they need not, and to see that must cost little.

use super::{allowed, pair_of, way_of};
use crate::bodies::Bodies;
use crate::contacts::Contact;
use crate::shape::Shape;
use crate::space::Space;
use crate::step::Workspace;
use crate::world::World;
use rayon::prelude::*;

/// How many pairs a thread looks at again at a time.
const PAIRS: usize = 64;

/// Whether some overlap is too deep where bodies are now, or one that nobody has seen may be. Contacts were found at the predicted
/// configuration, and each body has gone on since: along the normal of a contact no farther than its middle and its turning take it. Pairs of
/// which that does not say enough are looked at again.
pub(super) fn may_be_too_deep<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    part: f64,
) -> bool {
    let bodies = &world.bodies;
    let since = world.settings.h * world.settings.theta;
    let way = |i: usize| since * way_of(bodies, i, &bodies.velocity[i]);
    // What was out of reach may have come within.
    if (0..bodies.len()).any(|i| way(i) > work.reach[i]) {
        return true;
    }
    let nearer = |contact: &Contact<D>| {
        let [a, b] = [contact.key.a, contact.key.b].map(|body| body as usize);
        let along = |i: usize| since * (0..D).map(|k| contact.normal[k] * bodies.velocity[i][k]).sum::<f64>();
        along(a) - along(b) + turned(bodies, a, since) + turned(bodies, b, since) - contact.gap
    };
    let doubtful = work.found.iter().filter(|c| nearer(c) > allowed(bodies, pair_of(c), part)).map(pair_of);
    let pairs = &mut work.correction.doubtful;
    pairs.clear();
    pairs.extend(doubtful);
    pairs.dedup();
    pairs.par_iter().with_min_len(PAIRS).any(|&pair| is_too_deep(bodies, pair, part))
}

/// No point of body `i` goes farther than this by the turn that it makes meanwhile (s), m: an arc, and what it bends away from its beginning.
fn turned<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, i: usize, meanwhile: f64) -> f64 {
    if bodies.shape[i].is_round() {
        return 0.0;
    }
    let angle = meanwhile * bodies.velocity[i][D..].iter().map(|x| x * x).sum::<f64>().sqrt();
    bodies.shape[i].bounding_radius().unwrap_or(0.0) * angle * (1.0 + 0.5 * angle)
}

/// Whether two bodies overlap by more than is allowed.
fn is_too_deep<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, (a, b): (u32, u32), part: f64) -> bool {
    let [placed_a, placed_b] = [a, b].map(|body| (&bodies.shape[body as usize], &bodies.pose[body as usize]));
    let mut deepest = 0.0_f64;
    S::Shape::collide(placed_a, placed_b, 0.0, &mut |_, _, _, gap| deepest = deepest.max(-gap));
    deepest > allowed(bodies, (a, b), part)
}
