//! Stages 7 to 10 in one kind of coordinates: the problem over K components a contact.
//!
//! A step without friction needs the normals alone (K = 1), and contacts of round bodies need no rows (`Balls`). The
//! equations are the same; only less is stored and read.

mod joints;
mod kind;
mod operators;

pub(super) use kind::Kind;

use super::failed::with_guesses;
use super::workspace::Localised;
use crate::bodies::Bodies;
use crate::space::curve::Curve;
use crate::space::{Pose, Space};
use moreau_solve::files::{FileError, ProblemFile, StoredProblem};
use moreau_solve::{Balls, Cone, Delassus, MatrixFree, Problem, Report, Scratch, Settings, tasks};
use operators::Assembled;
use std::sync::atomic::AtomicBool;

/// One contact problem with its memory.
pub(super) struct System<O: Assembled<S, D, N, K>, S: Space<D, N>, const D: usize, const N: usize, const K: usize> {
    operator: O,
    q: Vec<[f64; K]>,
    cones: Vec<Cone>,
    /// Impulses, first those to start from, then the answer.
    r: Vec<[f64; K]>,
    scratch: Scratch<O::State, K>,
    space: std::marker::PhantomData<S>,
}

impl<O: Assembled<S, D, N, K>, S: Space<D, N>, const D: usize, const N: usize, const K: usize> Default for System<O, S, D, N, K> {
    fn default() -> Self {
        let (operator, scratch) = (O::default(), Scratch::default());
        Self { operator, q: Vec::new(), cones: Vec::new(), r: Vec::new(), scratch, space: std::marker::PhantomData }
    }
}

/// A system for each kind.
pub(super) struct Systems<S: Space<D, N>, const D: usize, const N: usize> {
    /// The one that has room for joints.
    pub(super) full: System<MatrixFree<D, N>, S, D, N, D>,
    normal: System<MatrixFree<1, N>, S, D, N, 1>,
    round: System<Balls<D>, S, D, N, D>,
    central: System<Balls<1>, S, D, N, 1>,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Default for Systems<S, D, N> {
    fn default() -> Self {
        Self { full: System::default(), normal: System::default(), round: System::default(), central: System::default() }
    }
}

impl<S: Space<D, N>, const D: usize, const N: usize> Systems<S, D, N> {
    /// The system of this kind; called a few times a step, never inside a sweep.
    pub(super) fn get(&mut self, kind: Kind) -> &mut dyn ContactSystem<S, D, N> {
        match kind {
            Kind::Full => &mut self.full,
            Kind::Normal => &mut self.normal,
            Kind::Round => &mut self.round,
            Kind::Central => &mut self.central,
        }
    }
}

/// What the step asks of a system, whatever its coordinates.
pub(super) trait ContactSystem<S: Space<D, N>, const D: usize, const N: usize> {
    /// Takes these contacts of these bodies, of which it keeps the components and degrees of freedom that it needs, in the place of
    /// those that it had.
    fn fill(&mut self, bodies: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], contacts: &[Localised<D>], curve: &mut Curve);

    /// Finds the impulses, if nobody sets `stop`.
    fn solve(&mut self, settings: &Settings, stop: &AtomicBool) -> Report;

    /// The impulses of now, D of each contact.
    fn impulses(&self, all: &mut Vec<f64>);

    /// The problem, with the impulses from which a solve began and those of now as guesses.
    ///
    /// It has D components a contact also where the system keeps the normal alone, since files know no other. The others are zeros
    /// in W and q then: what the step solved has no tangent, nothing in the answer depends on it, and μ = 0 tells so.
    fn problem(&self, start: &[f64]) -> Result<ProblemFile, FileError>;

    /// Gives each contact its impulse and its velocity (without the shift of the law); zeros in the components that the system leaves out.
    fn answer(&self, contacts: &mut [Localised<D>]);

    /// v⁺ = v_free + M⁻¹ H r, in place of v_free (eq. 14).
    fn deposit(&self, bodies: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], velocity: &mut [[f64; N]]);
}

/// K components as D, zeros in those that the system leaves out.
fn widened<const K: usize, const D: usize>(part: &[f64; K]) -> [f64; D] {
    std::array::from_fn(|i| if i < K { part[i] } else { 0.0 })
}

impl<O: Assembled<S, D, N, K>, S: Space<D, N>, const D: usize, const N: usize, const K: usize> ContactSystem<S, D, N>
    for System<O, S, D, N, K>
{
    fn fill(&mut self, bodies: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], contacts: &[Localised<D>], curve: &mut Curve) {
        self.operator.fill(bodies, middle, contacts, curve);
        let n = contacts.len();
        tasks::fill(&mut self.q, n, |c| std::array::from_fn(|i| contacts[c].after[i] + contacts[c].form.shift[i]));
        tasks::fill(&mut self.cones, n, |c| if K == 1 { Cone::Signorini } else { contacts[c].form.cone });
        tasks::fill(&mut self.r, n, |c| std::array::from_fn(|i| contacts[c].impulse[i]));
    }

    fn solve(&mut self, settings: &Settings, stop: &AtomicBool) -> Report {
        let problem = Problem { operator: &self.operator, q: &self.q, cones: &self.cones };
        moreau_solve::solve_until(&problem, settings, stop, &mut self.r, &mut self.scratch)
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
        self.impulses(&mut end);
        with_guesses(&StoredProblem { operator, q, cones: self.cones.clone() }, [start, &end])
    }

    fn answer(&self, contacts: &mut [Localised<D>]) {
        let problem = Problem { operator: &self.operator, q: &self.q, cones: &self.cones };
        tasks::each(contacts, |c, contact| {
            let u = problem.velocity(self.scratch.state(), c);
            contact.impulse = widened(&self.r[c]);
            contact.after = widened::<K, D>(&std::array::from_fn(|i| u[i] - contact.form.shift[i]));
        });
    }

    fn deposit(&self, bodies: &Bodies<S, D, N>, middle: &[Pose<S::Rotation, D>], velocity: &mut [[f64; N]]) {
        self.operator.give(self.scratch.state(), bodies, middle, velocity);
    }
}
