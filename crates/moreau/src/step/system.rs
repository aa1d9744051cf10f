//! Stages 7 to 10 in one kind of coordinates: the problem over K components a contact and L degrees of freedom a body.
//!
//! A step without friction needs the normals alone (K = 1), and without friction between round bodies no spin either (L = 4 for two or three). The
//! equations are the same; only less is stored and read.

use super::failed::with_guesses;
use super::localise::Rows;
use crate::bodies::Bodies;
use crate::space::Space;
use moreau_solve::files::{FileError, ProblemFile, StoredProblem};
use moreau_solve::{Cone, Delassus, MatrixFree, Operator, Problem, Report, Scratch, Settings, operator::NONE};

/// One contact problem with its memory.
pub(super) struct System<const K: usize, const L: usize> {
    operator: MatrixFree<K, L>,
    q: Vec<[f64; K]>,
    cones: Vec<Cone>,
    /// Impulses, first those to start from, then the answer.
    r: Vec<[f64; K]>,
    scratch: Scratch<Vec<[f64; L]>, K>,
}

impl<const K: usize, const L: usize> Default for System<K, L> {
    fn default() -> Self {
        Self { operator: MatrixFree::default(), q: Vec::new(), cones: Vec::new(), r: Vec::new(), scratch: Scratch::default() }
    }
}

/// Which coordinates a step needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Some contact has friction.
    Full,
    /// None has: normals only.
    Normal,
    /// And all bodies are round: normals only, which never turn a body.
    Central,
}

/// Degrees of freedom that a central system keeps of a body: those of its centre, and blanks up to two pairs. Visits hand velocities to
/// each other through memory, and a processor does that quickly only for pieces that are written as they are read.
const CENTRAL: usize = 4;

/// A system for each kind.
pub(super) struct Systems<const D: usize, const N: usize> {
    full: System<D, N>,
    normal: System<1, N>,
    central: System<1, CENTRAL>,
}

impl<const D: usize, const N: usize> Default for Systems<D, N> {
    fn default() -> Self {
        Self { full: System::default(), normal: System::default(), central: System::default() }
    }
}

impl<const D: usize, const N: usize> Systems<D, N> {
    /// The system of this kind; called a few times a step, never inside a sweep.
    pub(super) fn get<S: Space<D, N>>(&mut self, kind: Kind) -> &mut dyn ContactSystem<S, D, N> {
        match kind {
            Kind::Full => &mut self.full,
            Kind::Normal => &mut self.normal,
            Kind::Central => &mut self.central,
        }
    }
}

/// What the step asks of a system, whatever its coordinates.
pub(super) trait ContactSystem<S: Space<D, N>, const D: usize, const N: usize> {
    /// Empties it for `bodies` bodies.
    fn clear(&mut self, bodies: usize);

    /// Adds a contact, of which the system keeps the components and degrees of freedom that it needs.
    fn push(&mut self, bodies: &Bodies<S, D, N>, pair: [u32; 2], rows: &Rows<D, N>, q: &[f64; D], cone: Cone, start: &[f64; D]);

    /// Finds the impulses.
    fn solve(&mut self, settings: &Settings) -> Report;

    /// The impulses of now, D of each contact.
    fn impulses(&self, all: &mut Vec<f64>);

    /// The problem, with the impulses from which a solve began and those of now as guesses.
    ///
    /// It has D components a contact also where the system keeps the normal alone, since files know no other. The others are zeros
    /// in W and q then: what the step solved has no tangent, nothing in the answer depends on it, and μ = 0 tells so.
    fn problem(&self, start: &[f64]) -> Result<ProblemFile, FileError>;

    /// Impulse and velocity (without the `shift` of the law) of contact `c`; zeros in the components that the system leaves out.
    fn answer(&self, c: usize, shift: &[f64; D]) -> ([f64; D], [f64; D]);

    /// v⁺ = v_free + M⁻¹ H r, in place of v_free: the state of the operator is y = M^{-1/2} H r (eq. 14).
    fn deposit(&self, bodies: &Bodies<S, D, N>, velocity: &mut [[f64; N]]);
}

/// K components as D, zeros in those that the system leaves out.
fn widened<const K: usize, const D: usize>(part: &[f64; K]) -> [f64; D] {
    std::array::from_fn(|i| if i < K { part[i] } else { 0.0 })
}

impl<S: Space<D, N>, const D: usize, const N: usize, const K: usize, const L: usize> ContactSystem<S, D, N> for System<K, L> {
    fn clear(&mut self, bodies: usize) {
        self.operator.clear(bodies);
        self.q.clear();
        self.cones.clear();
        self.r.clear();
    }

    fn push(&mut self, bodies: &Bodies<S, D, N>, pair: [u32; 2], rows: &Rows<D, N>, q: &[f64; D], cone: Cone, start: &[f64; D]) {
        let weighed = std::array::from_fn(|side| {
            let root = &bodies.root_inverse_mass[pair[side] as usize];
            std::array::from_fn(|i| std::array::from_fn(|k| if k < N { rows[side][i][k] * root[k] } else { 0.0 }))
        });
        self.operator.push(pair.map(|body| if bodies.is_free(body as usize) { body } else { NONE }), weighed);
        self.q.push(std::array::from_fn(|i| q[i]));
        self.cones.push(if K == 1 { Cone::Signorini } else { cone });
        self.r.push(std::array::from_fn(|i| start[i]));
    }

    fn solve(&mut self, settings: &Settings) -> Report {
        let problem = Problem { operator: &self.operator, q: &self.q, cones: &self.cones };
        moreau_solve::solve(&problem, settings, &mut self.r, &mut self.scratch)
    }

    fn impulses(&self, all: &mut Vec<f64>) {
        all.clear();
        all.extend(self.r.iter().flat_map(widened::<K, D>));
    }

    fn problem(&self, start: &[f64]) -> Result<ProblemFile, FileError> {
        let stored = self.operator.stored();
        let entries = stored
            .blocks()
            .flat_map(|(c, d, block)| (0..K * K).map(move |k| (c * D + k / K, d * D + k % K, block[k / K][k % K])));
        let operator = Delassus::from_entries(self.q.len(), entries);
        let q: Vec<[f64; D]> = self.q.iter().map(widened).collect();
        let mut end = Vec::new();
        ContactSystem::<S, D, N>::impulses(self, &mut end);
        with_guesses(&StoredProblem { operator, q, cones: self.cones.clone() }, [start, &end])
    }

    fn answer(&self, c: usize, shift: &[f64; D]) -> ([f64; D], [f64; D]) {
        let problem = Problem { operator: &self.operator, q: &self.q, cones: &self.cones };
        let u = problem.velocity(self.scratch.state(), c);
        (widened(&self.r[c]), widened::<K, D>(&std::array::from_fn(|i| u[i] - shift[i])))
    }

    fn deposit(&self, bodies: &Bodies<S, D, N>, velocity: &mut [[f64; N]]) {
        for (i, y) in self.scratch.state().iter().enumerate() {
            for k in 0..L.min(N) {
                velocity[i][k] += bodies.root_inverse_mass[i][k] * y[k];
            }
        }
    }
}
