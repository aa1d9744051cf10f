//! The way between two bodies through their contact.

use crate::space::Space;
use crate::step::Localised;
use crate::world::World;

/// The ends of a contact's branch vector, from body `a` to body `b`, m: their centres, and where a body is not free the contact point in place
/// of its centre, which may be far away or nowhere in particular.
pub fn branch<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, c: &Localised<D>) -> [[f64; D]; 2] {
    let bodies = &world.bodies;
    [c.contact.key.a, c.contact.key.b].map(|body| {
        let i = body as usize;
        if bodies.is_free(i) { bodies.pose[i].position } else { c.contact.point }
    })
}
