//! Whether two files hold the same problem.

use super::{Bilateral, Equations, ProblemFile, SparseMatrix};

impl ProblemFile {
    /// Whether both hold the same problem to the last bit: sizes, coefficients, vectors, and matrices in canonical form, that is
    /// whatever their storage, with duplicates added and zeros dropped. Texts, guesses and solutions may differ.
    ///
    /// # Errors
    ///
    /// Names the first difference.
    pub fn same_as(&self, other: &Self) -> Result<(), String> {
        if self.dimension != other.dimension {
            return Err(format!("the dimension is {} and {}", self.dimension, other.dimension));
        }
        same_vector("mu", &self.mu, &other.mu)?;
        match (&self.mu_r, &other.mu_r) {
            (Some(mine), Some(others)) => same_vector("mu_r", mine, others)?,
            (None, None) => {}
            _ => return Err("only one has rolling friction".to_owned()),
        }
        match (&self.equations, &other.equations) {
            (Equations::Local { w, q }, Equations::Local { w: other_w, q: other_q }) => {
                same_matrix("W", w, other_w)?;
                same_vector("q", q, other_q)
            }
            (
                Equations::Global { m, h, f, w, bilateral },
                Equations::Global { m: other_m, h: other_h, f: other_f, w: other_w, bilateral: other_bilateral },
            ) => {
                same_matrix("M", m, other_m)?;
                same_matrix("H", h, other_h)?;
                same_vector("f", f, other_f)?;
                same_vector("w", w, other_w)?;
                match (bilateral, other_bilateral) {
                    (Some(mine), Some(others)) => same_bilateral(mine, others),
                    (None, None) => Ok(()),
                    _ => Err("only one has equality constraints".to_owned()),
                }
            }
            _ => Err("one is local, one is global".to_owned()),
        }
    }
}

fn same_bilateral(mine: &Bilateral, others: &Bilateral) -> Result<(), String> {
    same_matrix("G", &mine.g, &others.g)?;
    same_vector("b", &mine.b, &others.b)
}

fn same_vector(name: &str, mine: &[f64], others: &[f64]) -> Result<(), String> {
    if mine.len() != others.len() {
        return Err(format!("{name} has {} and {} numbers", mine.len(), others.len()));
    }
    let difference = mine.iter().zip(others).position(|(a, b)| a.to_bits() != b.to_bits());
    difference.map_or(Ok(()), |k| Err(format!("{name}[{k}] is {:e} and {:e}", mine[k], others[k])))
}

fn same_matrix(name: &str, mine: &SparseMatrix, others: &SparseMatrix) -> Result<(), String> {
    let (a, b) = (mine.csr(), others.csr());
    if (a.rows, a.columns) != (b.rows, b.columns) {
        return Err(format!("{name} is {} × {} and {} × {}", a.rows, a.columns, b.rows, b.columns));
    }
    if a.starts != b.starts || a.indices != b.indices {
        return Err(format!("{name} has entries at different places, {} and {} in all", a.values.len(), b.values.len()));
    }
    same_vector(&format!("the entries of {name}"), &a.values, &b.values)
}
