//! From global problems to local ones: W = Hᵀ M⁻¹ H and q = Hᵀ M⁻¹ f + w.
//!
//! M is factorised once, by a sparse LLᵀ if it is symmetric and positive definite, else by a sparse LU. Equality constraints border it:
//!
//! ```text
//! [ M   G ] [  v ]   [ H r + f ]
//! [ Gᵀ  0 ] [ −λ ] = [   −b    ]
//! ```
//!
//! Where M falls apart into bodies, a column of H is solved for in those alone that it touches: columns that share no part of M are
//! put into one right-hand side, so that there are as many of them as columns meet at one body, and not as many as contacts.

use super::{Bilateral, Csr, Equations, FileError, ProblemFile, SparseMatrix};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, Lu};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};

/// The greatest asymmetry of M, relative to its greatest entry, that is taken for rounding.
const ROUNDING: f64 = 1e-12;

/// How far |M| |x| may outgrow b = M x before M counts as singular.
const GROWTH: f64 = 1e14;

/// How many right-hand sides are solved for at once: enough to be fast, few enough to be small.
const AT_ONCE: usize = 32;

impl ProblemFile {
    /// W in canonical form and q; a global problem is reduced. Where M is symmetric, W is, exactly.
    ///
    /// # Errors
    ///
    /// Where the problem fails [`ProblemFile::check`], or M (bordered by G) is singular.
    pub fn local(&self) -> Result<(Csr, Vec<f64>), FileError> {
        self.check()?;
        let (w, q) = match &self.equations {
            Equations::Local { w, q } => (w.csr(), q.clone()),
            Equations::Global { m, h, f, w, bilateral } => reduce(&Motion::new(m, h, f, bilateral.as_ref()), w)?,
        };
        // Entries at one place that are added, and products of huge ones, can overflow.
        match w.values.iter().chain(&q).all(|x| x.is_finite()) {
            true => Ok((w, q)),
            false => Err(FileError::part("W and q", "have numbers that are not finite, once entries are added")),
        }
    }
}

impl ProblemFile {
    /// v of M v = H r + f for the impulses `r`, with the constraints kept where there are some; `None` for a local problem.
    ///
    /// # Errors
    ///
    /// Where the problem fails [`ProblemFile::check`], `r` has not a number for each component, or M (bordered by G) is singular.
    pub fn velocities(&self, r: &[f64]) -> Result<Option<Vec<f64>>, FileError> {
        self.check()?;
        if r.len() != self.unknowns() {
            return Err(FileError::part("r", format!("{} numbers; {} fit the other parts", r.len(), self.unknowns())));
        }
        let Equations::Global { m, h, f, bilateral, .. } = &self.equations else { return Ok(None) };
        let motion = Motion::new(m, h, f, bilateral.as_ref());
        let mut side = motion.f;
        for (i, j, x) in motion.h.entries() {
            side[i] += x * r[j];
        }
        let solver = Solver::new(&motion.m, motion.m.asymmetry() <= ROUNDING, motion.name)?;
        let v = solver.solve(&[side])?;
        Ok(Some((0..f.len()).map(|i| v[(i, 0)]).collect()))
    }
}

/// M v = H r + f, bordered by the constraints where there are some, with the name of M in messages.
struct Motion {
    m: Csr,
    h: Csr,
    f: Vec<f64>,
    name: &'static str,
}

impl Motion {
    fn new(m: &SparseMatrix, h: &SparseMatrix, f: &[f64], bilateral: Option<&Bilateral>) -> Self {
        let Some(Bilateral { g, b }) = bilateral else {
            return Self { m: m.csr(), h: h.csr(), f: f.to_vec(), name: "M" };
        };
        let n = f.len();
        let size = n + b.len();
        let border: Vec<_> = g.entries().flat_map(|(i, k, x)| [(i, n + k, x), (n + k, i, x)]).collect();
        Self {
            m: Csr::from_entries(size, size, m.entries().chain(border)),
            h: Csr::from_entries(size, h.columns, h.entries()),
            f: f.iter().copied().chain(b.iter().map(|b| -b)).collect(),
            name: "M, bordered by G,",
        }
    }
}

fn reduce(motion: &Motion, w: &[f64]) -> Result<(Csr, Vec<f64>), FileError> {
    let Motion { m, h, f, name } = motion;
    let symmetric = m.asymmetry() <= ROUNDING;
    let solver = Solver::new(m, symmetric, name)?;
    let mut q = w.to_vec();
    let free = solver.solve(std::slice::from_ref(f))?;
    for (i, j, x) in h.entries() {
        q[j] += x * free[(i, 0)];
    }
    let mut entries = delassus(&solver, &parts(m), h)?;
    if symmetric {
        let mirrored: Vec<_> = entries.iter().map(|&(i, j, x)| (j, i, 0.5 * x)).collect();
        entries.iter_mut().for_each(|entry| entry.2 *= 0.5);
        entries.extend(mirrored);
    }
    Ok((Csr::from_entries(h.columns, h.columns, entries.into_iter()), q))
}

/// The entries of Hᵀ M⁻¹ H, by columns.
fn delassus(solver: &Solver<'_>, parts: &[Vec<usize>], h: &Csr) -> Result<Vec<(usize, usize, f64)>, FileError> {
    let columns = h.transposed();
    let part_of = part_of(parts, h.rows);
    let touched: Vec<Vec<usize>> = (0..columns.rows)
        .map(|j| {
            let mut touched: Vec<usize> = columns.row(j).map(|(i, _)| part_of[i]).collect();
            touched.sort_unstable();
            touched.dedup();
            touched
        })
        .collect();
    let mut entries = Vec::new();
    let mut sums = vec![0.0; h.columns];
    for together in share(&touched, parts.len()).chunks(AT_ONCE) {
        let mut sides = vec![vec![0.0; h.rows]; together.len()];
        for (side, members) in sides.iter_mut().zip(together) {
            for (i, x) in members.iter().flat_map(|&j| columns.row(j)) {
                side[i] = x;
            }
        }
        let solved = solver.solve(&sides)?;
        for (k, members) in together.iter().enumerate() {
            for &j in members {
                let mut places = Vec::new();
                for &i in touched[j].iter().flat_map(|&part| &parts[part]) {
                    let x = solved[(i, k)];
                    for (c, y) in h.row(i) {
                        sums[c] += x * y;
                        places.push(c);
                    }
                }
                for c in places {
                    // The second time a place is met its sum is taken already.
                    entries.push((c, j, std::mem::take(&mut sums[c])));
                }
            }
        }
        entries.retain(|entry| entry.2 != 0.0);
    }
    Ok(entries)
}

/// The rows of each part into which M falls apart.
fn parts(m: &Csr) -> Vec<Vec<usize>> {
    let mut root: Vec<usize> = (0..m.rows).collect();
    let find = |root: &mut Vec<usize>, mut i: usize| {
        while root[i] != i {
            root[i] = root[root[i]];
            i = root[i];
        }
        i
    };
    for (i, j, _) in m.entries() {
        let (a, b) = (find(&mut root, i), find(&mut root, j));
        // The smaller is the root, so that parts are in the order of rows.
        root[a.max(b)] = a.min(b);
    }
    let mut number = vec![usize::MAX; m.rows];
    let mut parts: Vec<Vec<usize>> = Vec::new();
    for i in 0..m.rows {
        let a = find(&mut root, i);
        if number[a] == usize::MAX {
            number[a] = parts.len();
            parts.push(Vec::new());
        }
        parts[number[a]].push(i);
    }
    parts
}

fn part_of(parts: &[Vec<usize>], rows: usize) -> Vec<usize> {
    let mut part_of = vec![0; rows];
    for (k, part) in parts.iter().enumerate() {
        for &i in part {
            part_of[i] = k;
        }
    }
    part_of
}

/// Which columns share a right-hand side: no two of them touch one part. Greedy, each goes into the first that is free.
fn share(touched: &[Vec<usize>], parts: usize) -> Vec<Vec<usize>> {
    let mut sides: Vec<Vec<usize>> = Vec::new();
    let mut used: Vec<Vec<usize>> = vec![Vec::new(); parts];
    let mut taken_by = Vec::new();
    for (j, touched) in touched.iter().enumerate() {
        for &side in touched.iter().flat_map(|&part| &used[part]) {
            taken_by[side] = j;
        }
        // Numbers of columns rise, so that what an earlier one has marked is not taken for this one's mark.
        let free = taken_by.iter().position(|&by| by != j).unwrap_or(sides.len());
        if free == sides.len() {
            sides.push(Vec::new());
            taken_by.push(usize::MAX);
        }
        sides[free].push(j);
        for &part in touched {
            used[part].push(free);
        }
    }
    sides
}

/// M with its factors.
struct Solver<'a> {
    m: &'a Csr,
    /// The greatest absolute entry of each row.
    scale: Vec<f64>,
    factors: Factors,
    name: &'a str,
}

enum Factors {
    Definite(Llt<usize, f64>),
    Any(Box<Lu<usize, f64>>),
    /// There is nothing to solve for.
    Empty,
}

impl<'a> Solver<'a> {
    fn new(m: &'a Csr, symmetric: bool, name: &'a str) -> Result<Self, FileError> {
        let scale: Vec<f64> = (0..m.rows).map(|i| m.row(i).fold(0.0, |s: f64, (_, x)| s.max(x.abs()))).collect();
        let singular =
            |why: &str| FileError::part(name, format!("is singular{why}; a problem can be reduced with a regular one"));
        if let Some(i) = scale.iter().position(|&s| s == 0.0) {
            return Err(singular(&format!(", row {i} is zero")));
        }
        let triplets: Vec<_> = m.entries().map(|(i, j, x)| Triplet::new(i, j, x)).collect();
        let matrix = SparseColMat::try_new_from_triplets(m.rows, m.columns, &triplets)
            .map_err(|e| FileError::part(name, format!("cannot be factorised: {e:?}")))?;
        let definite = if symmetric && m.rows > 0 { matrix.sp_cholesky(Side::Lower).ok() } else { None };
        let factors = match definite {
            _ if m.rows == 0 => Factors::Empty,
            Some(factors) => Factors::Definite(factors),
            None => Factors::Any(Box::new(matrix.sp_lu().map_err(|_| singular(""))?)),
        };
        Ok(Self { m, scale, factors, name })
    }

    /// The solutions x of M x = b for these right-hand sides, as columns.
    fn solve(&self, sides: &[Vec<f64>]) -> Result<Mat<f64>, FileError> {
        let mut x = Mat::from_fn(self.m.rows, sides.len(), |i, k| sides[k][i]);
        match &self.factors {
            Factors::Definite(factors) => factors.solve_in_place(&mut x),
            Factors::Any(factors) => factors.solve_in_place(&mut x),
            Factors::Empty => {}
        }
        for (k, side) in sides.iter().enumerate() {
            // Of a matrix that is singular but for rounding, M x = b has a solution in which huge numbers cancel.
            let given = (0..self.m.rows).fold(0.0, |b: f64, i| b.max(side[i].abs() / self.scale[i]));
            let size = |i: usize| self.m.row(i).map(|(j, y)| (y * x[(j, k)]).abs()).sum::<f64>() / self.scale[i];
            let met = (0..self.m.rows).map(size).fold(0.0, |a: f64, b| if b.is_finite() { a.max(b) } else { f64::INFINITY });
            if met > GROWTH * given && met > 0.0 {
                return Err(FileError::part(self.name, "is singular to rounding; a problem can be reduced with a regular one"));
            }
        }
        Ok(x)
    }
}

#[cfg(test)]
mod tests;
