//! Seams: contacts with a side of one piece of ground that another piece hides; theory section 4.
//!
//! A body that has sunk into one of two adjoining pieces reaches, below their common surface, the side or the rim of the other. That
//! side cannot be touched from outside. Such a contact is found by a question: is it still there when the body is lifted out of the piece
//! that it has sunk into and slid up to the contact (`lifted`)? If not, it is removed, and what the lifted body touches instead takes its
//! place, theory (14b). Pieces are bodies, or the parts of a compound.
//!
//! Only contacts that lie no higher than the surface of another piece are asked about. Few scenes have any; a scene of round bodies and
//! half-spaces is not looked at.

mod lifted;

use super::Scene;
use super::bound::Bound;
use super::narrow::{parts_of, vector};
use crate::contacts::{Contact, ContactKey};
use crate::shape::Shape;
use crate::space::Space;
use lifted::{Lifted, Piece};
use vector::{along, dot};

/// One minus the cosine of the angle below which two normals are the same.
const SAME: f64 = 1e-9;

/// Height below which a step between two pieces is ignored, and clearance of a lifted body, as a part of the size of the smaller piece.
const MARGIN: f64 = 2e-5;

/// Number of patches above which only pieces of one body are compared: a body on which many others lie, such as the ground, is not what slides.
const MANY: usize = 64;

/// Contacts of one part of a body with one piece of another that share a normal, as the body sees them.
#[derive(Clone, Copy, Debug)]
struct Patch<const D: usize> {
    /// The body and its part, 0 for a body of one part.
    of: (u32, usize),
    /// The other body and its part.
    on: (u32, usize),
    /// Index of the first contact, and one past that of the last.
    contacts: [usize; 2],
    /// Unit normal from the other body.
    normal: [f64; D],
    /// Least gap, m.
    gap: f64,
    /// Height along the normal of the highest of these contacts on the other body, m.
    top: f64,
    /// The smaller bounding radius of both pieces, m.
    size: f64,
}

impl<const D: usize> Patch<D> {
    /// Height below which a step of the ground is ignored, m.
    fn margin(&self) -> f64 {
        MARGIN * self.size
    }

    /// Height along a direction of the highest of these contacts on the surface of the other body, m.
    fn highest(&self, direction: [f64; D], contacts: &[Contact<D>]) -> f64 {
        let height = |c: &Contact<D>| dot(direction, self.on_other(c));
        contacts.iter().map(height).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The point of a contact on the surface of the other body.
    fn on_other(&self, contact: &Contact<D>) -> [f64; D] {
        along(contact.point, -0.5 * contact.gap, self.normal)
    }
}

/// Scratch, kept from call to call.
#[derive(Clone, Debug, Default)]
pub(super) struct Seams<const D: usize> {
    /// True for bodies with edges.
    edged: Vec<bool>,
    /// True for bodies that touch one of these.
    beside_edges: Vec<bool>,
    patches: Vec<Patch<D>>,
    /// True for contacts to remove.
    hidden: Vec<bool>,
    /// Contacts of lifted bodies.
    lifted: Vec<Contact<D>>,
    /// Contacts that replace removed ones.
    instead: Vec<Contact<D>>,
}

impl<const D: usize> Seams<D> {
    /// Removes from `contacts`, which are sorted by key, those with hidden sides, and adds what replaces them.
    pub(super) fn mend<S: Space<D, N>, const N: usize>(
        &mut self,
        scene: &Scene<'_, S, D, N>,
        bounds: &[Bound<D>],
        driven: &impl Fn(usize) -> bool,
        contacts: &mut Vec<Contact<D>>,
    ) {
        self.edged.clear();
        self.edged.extend(bounds.iter().enumerate().map(|(i, bound)| bound.has_edges(scene, i)));
        if !self.edged.contains(&true) {
            return;
        }
        self.collect(scene, driven, contacts);
        self.hidden.clear();
        self.hidden.resize(contacts.len(), false);
        self.instead.clear();
        let patches = std::mem::take(&mut self.patches);
        for of_body in patches.chunk_by(|p, q| p.of.0 == q.of.0) {
            let within_body = of_body.len() > MANY || driven(of_body[0].of.0 as usize);
            for pieces in of_body.chunk_by(|p, q| !within_body || p.on.0 == q.on.0) {
                for patch in pieces {
                    if self.edged[patch.on.0 as usize] {
                        self.ask((scene, driven), contacts, patch, pieces);
                    }
                }
            }
        }
        self.patches = patches;
        self.replace(contacts);
    }

    /// Fills in the patches of all bodies that touch one with edges, sorted by body.
    fn collect<S: Space<D, N>, const N: usize>(
        &mut self,
        scene: &Scene<'_, S, D, N>,
        driven: &impl Fn(usize) -> bool,
        contacts: &[Contact<D>],
    ) {
        let Self { edged, beside_edges, patches, .. } = self;
        beside_edges.clear();
        beside_edges.resize(edged.len(), false);
        for contact in contacts {
            let [a, b] = [contact.key.a as usize, contact.key.b as usize];
            beside_edges[a] |= edged[b];
            beside_edges[b] |= edged[a];
        }
        patches.clear();
        let asked = |contact: &Contact<D>| beside_edges[contact.key.a as usize] || beside_edges[contact.key.b as usize];
        let mut first = 0;
        for group in contacts.chunk_by(|c, d| is_one_patch(scene, c, d)) {
            let range = [first, first + group.len()];
            first = range[1];
            if !asked(&group[0]) {
                continue;
            }
            let (key, [part_a, part_b]) = (group[0].key, pieces(scene, group[0].key));
            for (of, on, sign) in [((key.a, part_a), (key.b, part_b), -1.0), ((key.b, part_b), (key.a, part_a), 1.0)] {
                // On a driven body only what has parts is asked about.
                let is_ground = driven(of.0 as usize) && scene.shapes[on.0 as usize].parts().is_empty();
                if beside_edges[of.0 as usize] && !is_ground {
                    let size = Piece::new(scene, of).radius.min(Piece::new(scene, on).radius);
                    let normal = group[0].normal.map(|x| sign * x);
                    let gap = group.iter().map(|c| c.gap).fold(f64::INFINITY, f64::min);
                    let mut patch = Patch { of, on, contacts: range, normal, gap, top: 0.0, size };
                    patch.top = patch.highest(normal, group);
                    patches.push(patch);
                }
            }
        }
        patches.sort_unstable_by_key(|patch| (patch.of.0, patch.contacts[0]));
    }

    /// Marks the contacts of a patch if another one of these patches of the same body is on a piece that hides them.
    fn ask<S: Space<D, N>, const N: usize>(
        &mut self,
        (scene, driven): (&Scene<'_, S, D, N>, &impl Fn(usize) -> bool),
        contacts: &[Contact<D>],
        patch: &Patch<D>,
        pieces: &[Patch<D>],
    ) {
        let range = patch.contacts[0]..patch.contacts[1];
        let own = &contacts[range.clone()];
        // Pieces of ground, or of one body: free bodies, such as the stones of an arch, part at their sides, and must bear on them.
        let is_ground = driven(patch.on.0 as usize);
        let may_hide = |over: &&Patch<D>| {
            over.on != patch.on
                && (over.on.0 == patch.on.0 || is_ground && driven(over.on.0 as usize))
                && dot(over.normal, patch.normal) < 1.0 - SAME
                && patch.highest(over.normal, own) <= over.top + patch.margin()
        };
        for over in pieces.iter().filter(may_hide) {
            let lifted = Lifted::new(scene, patch, over);
            if lifted.is_beside(patch, own) && !lifted.still_touches(patch, own, &mut self.lifted) {
                self.hidden[range].fill(true);
                for contact in self.lifted.drain(..) {
                    if !self.instead.iter().any(|known| known.key == contact.key) {
                        self.instead.push(contact);
                    }
                }
                return;
            }
        }
    }

    /// Removes the marked contacts and inserts what replaces them.
    fn replace(&mut self, contacts: &mut Vec<Contact<D>>) {
        let Self { hidden, instead, .. } = self;
        if !hidden.contains(&true) {
            return;
        }
        instead.retain(|new| contacts.binary_search_by_key(&new.key, |c| c.key).map_or(true, |known| hidden[known]));
        let mut marks = hidden.iter();
        contacts.retain(|_| marks.next() == Some(&false));
        contacts.append(instead);
        contacts.sort_unstable_by_key(|contact| contact.key);
    }
}

/// True if two consecutive contacts belong to the same pieces and share a normal.
fn is_one_patch<S: Space<D, N>, const D: usize, const N: usize>(
    scene: &Scene<'_, S, D, N>,
    first: &Contact<D>,
    second: &Contact<D>,
) -> bool {
    let (key, next) = (first.key, second.key);
    (key.a, key.b) == (next.a, next.b)
        && dot(first.normal, second.normal) >= 1.0 - SAME
        && pieces(scene, key) == pieces(scene, next)
}

/// The parts of both bodies that a contact is on.
fn pieces<S: Space<D, N>, const D: usize, const N: usize>(scene: &Scene<'_, S, D, N>, key: ContactKey) -> [usize; 2] {
    parts_of(key.feature, [key.a, key.b].map(|body| !scene.shapes[body as usize].parts().is_empty()))
}
