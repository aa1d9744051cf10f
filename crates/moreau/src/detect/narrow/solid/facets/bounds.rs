//! What is known of axes before they are tried: two bodies are no farther apart along a direction than any two of their points, or two balls
//! inside them. For bodies that touch that leaves few faces and edges of many.

use super::Seen;
use crate::detect::narrow::vector::{dot, sub};
use crate::shape::solid::Faceted;

/// The most that two bodies can be apart along a direction.
pub(super) struct Most {
    /// From the middle of the first body to that of the second.
    way: [f64; 3],
    /// The radii, together, of balls around them and inside, m.
    inner: f64,
}

impl Most {
    pub(super) fn new<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>) -> Self {
        Self { way: sub(b.middle, a.middle), inner: a.body.inner() + b.body.inner() }
    }

    /// Along this unit vector, m.
    pub(super) fn along(&self, normal: [f64; 3]) -> f64 {
        dot(normal, self.way) - self.inner
    }
}

/// The edges, by their numbers, that may separate two bodies.
#[derive(Default)]
pub(super) struct Bounds {
    pub(super) first: Vec<u16>,
    pub(super) second: Vec<u16>,
    /// Of those of the second body, the ones that matter to one of the first.
    pub(super) crossing: Vec<u16>,
    /// How far each normal of a body goes along the way.
    ways: Vec<f64>,
}

impl Bounds {
    /// Finds those along whose normals, which lie on the arc between those of their faces, the bodies can be so far apart.
    pub(super) fn find<A: Faceted, B: Faceted>(&mut self, a: &Seen<'_, A>, b: &Seen<'_, B>, apart: f64) {
        let Most { way, inner } = Most::new(a, b);
        let Self { first, second, ways, .. } = self;
        likely(a, way, apart + inner, ways, first);
        likely(b, way.map(|x| -x), apart + inner, ways, second);
    }
}

/// The edges of a body between the normals of whose faces some unit vector has at least so much along the way.
fn likely<F: Faceted>(body: &Seen<'_, F>, way: [f64; 3], least: f64, ways: &mut Vec<f64>, found: &mut Vec<u16>) {
    ways.clear();
    ways.extend(body.normals.iter().map(|&normal| dot(normal, way)));
    let edges = body.body.edges();
    // Between n and m, of which the larger has w along the way, no unit vector has more than w / cos(α/2) if w is positive, and none more
    // than w if not; cos² (α/2) = (1 + n·m) / 2.
    let may = |i: u16| {
        let [n, m] = edges[usize::from(i)].faces.map(usize::from);
        let most = ways[n].max(ways[m]);
        least <= 0.0 || (most > 0.0 && 2.0 * most * most >= least * least * (1.0 + dot(body.normals[n], body.normals[m])))
    };
    keep(0..edges.len() as u16, may, found);
}

/// Those of `all` for which something holds. Each is written before it is known and counted after: what is hard to foresee is no branch.
pub(super) fn keep(all: impl ExactSizeIterator<Item = u16>, holds: impl Fn(u16) -> bool, kept: &mut Vec<u16>) {
    kept.resize(all.len(), 0);
    let mut count = 0;
    for one in all {
        kept[count] = one;
        count += usize::from(holds(one));
    }
    kept.truncate(count);
}
