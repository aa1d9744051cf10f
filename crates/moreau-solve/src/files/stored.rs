//! Problems of files as problems to solve, and back.

use super::{Blocks, Csr, Equations, FileError, ProblemFile, SparseMatrix, Storage};
use crate::block::Vector;
use crate::{Cone, Delassus, Problem, Report, Scratch, Settings, solve};

/// A problem whose parts are its own.
#[derive(Clone, Debug, Default)]
pub struct StoredProblem<const D: usize> {
    /// W.
    pub operator: Delassus<D>,
    /// q.
    pub q: Vec<Vector<D>>,
    /// The law of each contact.
    pub cones: Vec<Cone>,
}

/// A problem of one of the kinds that files hold.
#[derive(Clone, Debug)]
pub enum AnyProblem {
    /// Contacts in the plane: [n, t].
    Plane(StoredProblem<2>),
    /// Contacts in space: [n, t₁, t₂].
    Solid(StoredProblem<3>),
    /// Contacts in the plane that resist rolling: [n, t, m].
    PlaneRolling(StoredProblem<3>),
    /// Contacts in space that resist rolling: [n, t₁, t₂, m₁, m₂].
    SolidRolling(StoredProblem<5>),
}

impl<const D: usize> StoredProblem<D> {
    /// The problem, to be solved.
    pub fn problem(&self) -> Problem<'_, Delassus<D>, D> {
        Problem { operator: &self.operator, q: &self.q, cones: &self.cones }
    }

    /// From W in rows, q and the laws; what is beyond the contacts of `cones` is left out.
    fn new(w: &Csr, q: &[f64], cones: Vec<Cone>) -> Self {
        let q = q.chunks_exact(D).map(|part| std::array::from_fn(|i| part[i])).collect();
        Self { operator: Delassus::from_entries(cones.len(), w.entries()), q, cones }
    }
}

/// The answer to a problem of whatever dimension, flat: component by component, contact by contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Impulses.
    pub r: Vec<f64>,
    /// Velocities, u = W r + q.
    pub u: Vec<f64>,
    /// How the solve ended, with its certificate.
    pub report: Report,
}

impl AnyProblem {
    /// Solves it from zero.
    pub fn solve(&self, settings: &Settings) -> Answer {
        match self {
            AnyProblem::Plane(stored) => stored.solve(settings),
            AnyProblem::Solid(stored) | AnyProblem::PlaneRolling(stored) => stored.solve(settings),
            AnyProblem::SolidRolling(stored) => stored.solve(settings),
        }
    }
}

impl<const D: usize> StoredProblem<D> {
    fn solve(&self, settings: &Settings) -> Answer {
        let (problem, mut scratch) = (self.problem(), Scratch::default());
        let mut r = vec![[0.0; D]; problem.len()];
        let report = solve(&problem, settings, &mut r, &mut scratch);
        let u = (0..problem.len()).flat_map(|c| problem.velocity(scratch.state(), c)).collect();
        Answer { r: r.into_flattened(), u, report }
    }
}

impl ProblemFile {
    /// The problem to solve, global ones reduced by [`ProblemFile::local`]. Contacts with μ = 0 are [`Cone::Signorini`].
    ///
    /// # Errors
    ///
    /// Where the problem fails [`ProblemFile::check`], or M is singular.
    pub fn any_problem(&self) -> Result<AnyProblem, FileError> {
        let (w, q) = self.local()?;
        let cones = self.cones();
        Ok(match (self.dimension, &self.mu_r) {
            (2, None) => AnyProblem::Plane(StoredProblem::new(&w, &q, cones)),
            (3, None) => AnyProblem::Solid(StoredProblem::new(&w, &q, cones)),
            (3, Some(_)) => AnyProblem::PlaneRolling(StoredProblem::new(&w, &q, cones)),
            _ => AnyProblem::SolidRolling(StoredProblem::new(&w, &q, cones)),
        })
    }

    /// The law of each contact.
    fn cones(&self) -> Vec<Cone> {
        match &self.mu_r {
            Some(mu_r) => self.mu.iter().zip(mu_r).map(|(&mu, &mu_r)| Cone::Rolling { mu, mu_r }).collect(),
            None => self.mu.iter().map(|&mu| if mu == 0.0 { Cone::Signorini } else { Cone::Coulomb(mu) }).collect(),
        }
    }

    /// A local problem for a file, W by blocks. With D = 3 it rolls in the plane if any of its contacts does.
    ///
    /// # Errors
    ///
    /// Where files have no place for the problem: D is not 2, 3 or 5, a law is neither friction nor rolling friction, or some
    /// contacts have the one and some the other; and where it fails [`ProblemFile::check`].
    pub fn from_stored<const D: usize>(stored: &StoredProblem<D>) -> Result<Self, FileError> {
        let rolling = D == 5 || stored.cones.iter().any(|cone| matches!(cone, Cone::Rolling { .. }));
        let coefficients = |(c, cone): (usize, &Cone)| match (*cone, rolling) {
            (Cone::Signorini, _) => Ok((0.0, 0.0)),
            (Cone::Coulomb(mu), false) => Ok((mu, 0.0)),
            (Cone::Rolling { mu, mu_r }, true) => Ok((mu, mu_r)),
            (other, _) => {
                let right = if rolling { "rolling friction" } else { "friction" };
                Err(FileError::part("mu", format!("contact {c} has {other:?}; the file has place for {right} alone")))
            }
        };
        let coefficients = stored.cones.iter().enumerate().map(coefficients).collect::<Result<Vec<_>, _>>()?;
        let (mu, mu_r): (Vec<f64>, Vec<f64>) = coefficients.into_iter().unzip();
        let equations = Equations::Local { w: by_blocks(&stored.operator, mu.len()), q: stored.q.as_flattened().to_vec() };
        let problem = Self::new(D, equations, mu, rolling.then_some(mu_r));
        problem.check()?;
        Ok(problem)
    }
}

/// W as files store blocks.
fn by_blocks<const D: usize>(operator: &Delassus<D>, contacts: usize) -> SparseMatrix {
    let ends: Vec<usize> = (1..=contacts).map(|c| c * D).collect();
    let mut blocks = Blocks {
        row_ends: ends.clone(),
        column_ends: ends,
        starts: vec![0; contacts + 1],
        columns: Vec::new(),
        values: Vec::new(),
    };
    for (c, d, block) in operator.blocks().filter(|&(c, d, _)| c < contacts && d < contacts) {
        blocks.columns.push(d);
        blocks.values.extend((0..D * D).map(|k| block[k % D][k / D]));
        blocks.starts[c + 1] = blocks.columns.len();
    }
    for c in 0..contacts {
        blocks.starts[c + 1] = blocks.starts[c + 1].max(blocks.starts[c]);
    }
    SparseMatrix { rows: contacts * D, columns: contacts * D, storage: Storage::Blocks(blocks) }
}

#[cfg(test)]
mod tests;
