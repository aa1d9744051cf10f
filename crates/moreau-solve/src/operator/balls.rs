//! W of bodies that are round: three numbers of a contact say what general rows need twelve or more for.
//!
//! The normal n of a round body passes through its centre, at the arms l_a and l_b from the contact. So
//!
//! ```text
//! u = (v_b − v_a) − (l_b ω_b + l_a ω_a) × n
//! v_b += p/m_b,   ω_b −= l_b/J_b n × p,      v_a −= p/m_a,   ω_a −= l_a/J_a n × p
//! W_cc = w_n n⊗n + w_t (I − n⊗n),   w_n = 1/m_a + 1/m_b,   w_t = w_n + l_a²/J_a + l_b²/J_b
//! ```
//!
//! in the axes of the world, where a ball's inertia is the same number J in all directions. Disks are balls that stay in a plane: their
//! velocities have no third component, their spins no others. One component a contact (K = 1) leaves the spins out.

use super::{Add, Delassus, MatrixFree, NONE, Operator, Root, Visit, colouring};
use crate::block::{Matrix, Vector};
use crate::tasks;
use std::borrow::Cow;

/// Velocity and spin of a body in space, each filled up to four numbers: a processor reads them at once.
pub type RoundState = [[f64; 4]; 2];

/// Contacts of round bodies with each other and with bodies that impulses do not move, of any shape.
#[derive(Clone, Debug, Default)]
pub struct Balls<const K: usize> {
    pub(crate) bodies: Vec<RoundBody>,
    pub(crate) contacts: Vec<RoundContact<K>>,
    /// The place of each body in an order in which neighbours are near each other; empty where none is known.
    pub(crate) places: Vec<u32>,
}

/// What impulses do to a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RoundBody {
    /// 1/m, 1/kg; zero for a body that impulses do not move.
    pub inverse_mass: f64,
    /// 1/J, 1/(kg m²).
    pub inverse_inertia: f64,
}

/// One contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundContact<const K: usize> {
    /// The bodies a and b; the index of a body, or [`NONE`].
    pub pair: [u32; 2],
    /// The frame n, t₁, t₂, as far as the problem has components. In the plane third components are zero.
    pub frame: [[f64; 3]; K],
    /// From the centre of a to the contact along n, and from the contact to the centre of b, m.
    pub arms: [f64; 2],
    /// w_n and w_t, 1/kg.
    pub(crate) mobility: [f64; 2],
}

impl<const K: usize> Balls<K> {
    /// Empties it, for these bodies, keeping the memory.
    pub fn clear(&mut self, bodies: impl Iterator<Item = RoundBody>) {
        self.bodies.clear();
        self.bodies.extend(bodies);
        self.contacts.clear();
        self.places.clear();
    }

    /// Says where each body is in an order in which neighbours are near each other. The answer of a solve does not depend on it but
    /// for rounding; how far it can be shared among threads, and kept in caches, does.
    pub fn order(&mut self, places: &[u32]) {
        self.places.clear();
        self.places.extend_from_slice(places);
    }

    /// Adds a contact of the bodies `pair` (indices, or [`NONE`]) with its frame and arms as in [`RoundContact`].
    pub fn push(&mut self, pair: [u32; 2], frame: [[f64; 3]; K], arms: [f64; 2]) {
        self.contacts.push(contact(&self.bodies, (pair, frame, arms)));
    }

    /// Takes these `n` contacts in the place of those that it had: the same as a [`push`](Self::push) of each, by several threads.
    pub fn fill(&mut self, n: usize, of: impl Fn(usize) -> ([u32; 2], [[f64; 3]; K], [f64; 2]) + Sync + Send) {
        let bodies = &self.bodies;
        tasks::fill(&mut self.contacts, n, |c| contact(bodies, of(c)));
    }

    /// How many contacts it has.
    pub fn len(&self) -> usize {
        self.contacts.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.contacts.is_empty()
    }

    /// What impulses do to a body.
    #[inline(always)]
    fn body(&self, body: u32) -> RoundBody {
        read_body(&self.bodies, body)
    }

    /// The same W with general rows.
    fn rows(&self) -> MatrixFree<K, 6> {
        let mut general = MatrixFree::default();
        general.clear(self.bodies.len());
        for contact in &self.contacts {
            let row = |side: usize, direction: &[f64; 3]| {
                let body = self.body(contact.pair[side]);
                let ([m, j], sign) = ([body.inverse_mass.sqrt(), body.inverse_inertia.sqrt()], [-1.0, 1.0][side]);
                let turn = cross(&contact.frame[0], direction).map(|x| -contact.arms[side] * j * x);
                let [x, y, z] = direction.map(|x| sign * m * x);
                [x, y, z, turn[0], turn[1], turn[2]]
            };
            general.push(contact.pair, [0, 1].map(|side| contact.frame.map(|direction| row(side, &direction))));
        }
        general
    }
}

#[inline(always)]
fn read_body(bodies: &[RoundBody], body: u32) -> RoundBody {
    bodies.get(body as usize).copied().unwrap_or_default()
}

/// A contact with its mobility.
fn contact<const K: usize>(bodies: &[RoundBody], (pair, frame, arms): ([u32; 2], [[f64; 3]; K], [f64; 2])) -> RoundContact<K> {
    debug_assert!(pair.iter().all(|&b| b == NONE || (b as usize) < bodies.len()));
    let [a, b] = pair.map(|body| read_body(bodies, body));
    let normal = a.inverse_mass + b.inverse_mass;
    let turned = arms[0] * arms[0] * a.inverse_inertia + arms[1] * arms[1] * b.inverse_inertia;
    RoundContact { pair, frame, arms, mobility: [normal, normal + turned] }
}

/// a × b.
#[inline(always)]
fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn read(state: &[RoundState], body: u32) -> RoundState {
    state.get(body as usize).copied().unwrap_or_default()
}

impl<const K: usize> RoundContact<K> {
    /// u for the states of the two bodies.
    #[inline(always)]
    fn relative(&self, [a, b]: &[RoundState; 2]) -> Vector<K> {
        let n = &self.frame[0];
        let mut u: [f64; 3] = std::array::from_fn(|k| b[0][k] - a[0][k]);
        if K > 1 {
            let spin = std::array::from_fn(|k| self.arms[1] * b[1][k] + self.arms[0] * a[1][k]);
            let turn = cross(&spin, n);
            u = std::array::from_fn(|k| u[k] - turn[k]);
        }
        self.frame.map(|e| e[0] * u[0] + e[1] * u[1] + e[2] * u[2])
    }

    /// Gives one side, which was in the state `y`, the impulse p. Writes no more than changes: the next visit need not wait for the rest.
    #[inline(always)]
    fn give(&self, side: usize, body: RoundBody, y: &RoundState, p: &[f64; 3], state: &mut RoundState) {
        let along = [-1.0, 1.0][side] * body.inverse_mass;
        (0..3).for_each(|k| state[0][k] = y[0][k] + along * p[k]);
        if K > 1 {
            let (turn, by) = (cross(&self.frame[0], p), self.arms[side] * body.inverse_inertia);
            (0..3).for_each(|k| state[1][k] = y[1][k] - by * turn[k]);
        }
    }
}

impl<const K: usize> Operator<K> for Balls<K> {
    type State = Vec<RoundState>;

    fn start(&self, r: &[Vector<K>], state: &mut Self::State) {
        state.clear();
        state.resize(self.bodies.len(), RoundState::default());
        for (c, r) in r.iter().enumerate() {
            self.relax(state, c, Add(r));
        }
    }

    #[inline]
    fn diagonal(&self, c: usize) -> Matrix<K> {
        let [normal, tangent] = self.contacts[c].mobility;
        let entry = |i: usize| if i == 0 { normal } else { tangent };
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { entry(i) } else { 0.0 }))
    }

    #[inline]
    fn apply(&self, state: &Self::State, c: usize) -> Vector<K> {
        let contact = &self.contacts[c];
        contact.relative(&contact.pair.map(|body| read(state, body)))
    }

    fn extrapolate(&self, state: &mut Self::State, previous: &Self::State, beta: f64) {
        super::extrapolate(state.as_flattened_mut(), previous.as_flattened(), beta);
    }

    fn stored(&self) -> Cow<'_, Delassus<K>> {
        Cow::Owned(Delassus::assemble(&self.rows()))
    }

    fn root(&self) -> Option<Root> {
        self.rows().root()
    }

    fn colour(&self, order: &mut [u32]) {
        colouring::sort(self.bodies.len(), self.contacts.iter().map(|contact| contact.pair), order);
    }

    #[inline(always)]
    fn relax(&self, state: &mut Self::State, c: usize, visit: impl Visit<K>) {
        let contact = &self.contacts[c];
        let y = contact.pair.map(|body| read(state, body));
        let change = visit.change(&self.diagonal(c), contact.relative(&y));
        if change != [0.0; K] {
            let p = std::array::from_fn(|k| (0..K).map(|i| contact.frame[i][k] * change[i]).sum());
            for side in 0..2 {
                if let Some(place) = state.get_mut(contact.pair[side] as usize) {
                    contact.give(side, self.body(contact.pair[side]), &y[side], &p, place);
                }
            }
        }
    }

    fn balls(&self) -> Option<&Balls<K>> {
        Some(self)
    }
}
