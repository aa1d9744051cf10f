//! From nearby pairs to contacts.

use super::bound::Bound;
use super::narrow::two_round;
use super::{Scene, is_shared};
use crate::contacts::{Contact, ContactKey};
use crate::shape::Shape;
use crate::space::Space;
use rayon::prelude::*;

/// Scratch: one part for each chunk of pairs where threads share them, else one part alone.
#[derive(Clone, Debug, Default)]
pub(super) struct Sieve<const D: usize> {
    parts: Vec<Part<D>>,
}

#[derive(Clone, Debug, Default)]
struct Part<const D: usize> {
    /// Pairs that meet.
    meeting: Vec<(u32, u32)>,
    contacts: Vec<Contact<D>>,
}

impl<const D: usize> Sieve<D> {
    /// Clears `out` and fills it with the contacts of the pairs, in their order; threads take `chunk` of them at a time.
    pub(super) fn contacts<S: Space<D, N>, const N: usize>(
        &mut self,
        scene: &Scene<'_, S, D, N>,
        bounds: &[Bound<D>],
        pairs: &[(u32, u32)],
        chunk: usize,
        out: &mut Vec<Contact<D>>,
    ) {
        let chunks = if is_shared(pairs.len(), chunk) { pairs.len().div_ceil(chunk) } else { 1 };
        if self.parts.len() < chunks {
            self.parts.resize_with(chunks, Part::default);
        }
        if chunks == 1 {
            out.clear();
            let meeting = &mut self.parts[0].meeting;
            pairs.chunks(chunk).for_each(|chunk| narrow(scene, bounds, meet(bounds, chunk, meeting), out));
            return;
        }
        self.parts.par_iter_mut().zip(pairs.par_chunks(chunk)).for_each(|(part, chunk)| {
            part.contacts.clear();
            narrow(scene, bounds, meet(bounds, chunk, &mut part.meeting), &mut part.contacts);
        });
        let parts = &self.parts[..chunks];
        // What `out` held is written over: clearing it would have it filled twice.
        out.resize(count(parts), empty());
        gather(parts, out);
    }
}

/// Written over before it is read.
const fn empty<const D: usize>() -> Contact<D> {
    Contact { key: ContactKey { a: 0, b: 0, feature: 0 }, point: [0.0; D], normal: [0.0; D], gap: 0.0 }
}

/// How many contacts there are in all.
fn count<const D: usize>(parts: &[Part<D>]) -> usize {
    parts.iter().map(|part| part.contacts.len()).sum()
}

/// Copies all contacts, in order, into a slice of their number; threads share the halves.
fn gather<const D: usize>(parts: &[Part<D>], out: &mut [Contact<D>]) {
    if let [part] = parts {
        out.copy_from_slice(&part.contacts);
        return;
    }
    let (front, back) = parts.split_at(parts.len() / 2);
    let (front_out, back_out) = out.split_at_mut(count(front));
    rayon::join(|| gather(front, front_out), || gather(back, back_out));
}

/// The pairs whose bounding balls meet. A pair is written before it is known to meet and counted after: a branch on the test,
/// which is hard to foresee, would cost more.
fn meet<'a, const D: usize>(bounds: &[Bound<D>], pairs: &[(u32, u32)], meeting: &'a mut Vec<(u32, u32)>) -> &'a [(u32, u32)] {
    if meeting.len() < pairs.len() {
        meeting.resize(pairs.len(), (0, 0));
    }
    let mut count = 0;
    for &(a, b) in pairs {
        meeting[count] = (a, b);
        count += usize::from(bounds[a as usize].meets(&bounds[b as usize]));
    }
    &meeting[..count]
}

/// Adds the contacts of these pairs. Those of round bodies are found from their bounding balls, which are at hand; bodies and
/// poses would have to be fetched.
fn narrow<S: Space<D, N>, const D: usize, const N: usize>(
    scene: &Scene<'_, S, D, N>,
    bounds: &[Bound<D>],
    pairs: &[(u32, u32)],
    out: &mut Vec<Contact<D>>,
) {
    let Scene { shapes, poses, reach } = scene;
    for &(a, b) in pairs {
        let (i, j) = (a as usize, b as usize);
        let mut emit = |feature, point, normal, gap| {
            out.push(Contact { key: ContactKey { a, b, feature }, point, normal, gap });
        };
        if let (Some((ball_a, reach_a)), Some((ball_b, reach_b))) = (bounds[i].round(), bounds[j].round()) {
            two_round(ball_a, ball_b, reach_a + reach_b, &mut emit);
            continue;
        }
        S::Shape::collide((&shapes[i], &poses[i]), (&shapes[j], &poses[j]), reach[i] + reach[j], &mut emit);
    }
}
