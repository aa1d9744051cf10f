//! The text format of Siconos.
//!
//! Tokens between white space; line breaks mean nothing but after a header of CSparse.
//!
//! ```text
//! local    d N  W  q[d·N]  mu[N]  (mu_r[N])
//! global   d N  M  H  f[n]  w[d·N]  mu[N]  (mu_r[N])
//! ```
//!
//! Nothing in the file says which one it is. A first matrix that is not d·N × d·N is M; else the number of tokens after it
//! decides, which is smaller for every local file than for any global one: a global one that is cut short can pass for a local one. With d = 5 there is μ_r. With d = 3 there is μ_r (rolling
//! in the plane) if the file has N more tokens than it needs, and N ≥ 2: a single contact's μ_r could as well be the token that some
//! writers leave at the end, and is taken for it, unless yet another token follows. [`write_text`] adds that other token.

mod matrix;
mod tokens;
mod write;

pub use write::write_text;

use super::{Equations, FileError, ProblemFile, SparseMatrix};
use tokens::Tokens;

/// Reads a problem from text.
///
/// # Errors
///
/// Where the text does not hold a problem: names line, column and token.
pub fn read_text(bytes: &[u8]) -> Result<ProblemFile, FileError> {
    let mut tokens = Tokens::new(bytes);
    let dimension = tokens.integer("the dimension")?;
    if !matches!(dimension, 2 | 3 | 5) {
        return Err(tokens.error(format!("the dimension is {dimension}; 2, 3 or, with rolling friction, 5 is right")));
    }
    let contacts = tokens.count("the number of contacts")?;
    let size = dimension * contacts;
    let first = matrix::read(&mut tokens, "the first matrix")?;
    // The shortest H has five tokens; f, w and mu follow it.
    let local = first.rows == size && first.columns == size && tokens.remaining() < 5 + 2 * size + contacts;
    let equations =
        if local { Equations::Local { w: first, q: tokens.reals(size, "q")? } } else { read_global(&mut tokens, first, size)? };
    let mu = tokens.reals(contacts, "mu")?;
    let (rolling, extra) = after_mu(dimension, contacts, tokens.remaining());
    let mu_r = if rolling { Some(tokens.reals(contacts, "mu_r")?) } else { None };
    let mut problem = ProblemFile::new(dimension, equations, mu, mu_r);
    if tokens.at_end() {
        problem.notes.push("the file ends with its last number, without a line break: it may have been cut short".to_owned());
    }
    if extra {
        let token = tokens.next("the token at the end")?;
        problem.notes.push(format!("the token `{}` at the end is ignored", token.chars().take(40).collect::<String>()));
    }
    tokens.end()?;
    problem.check()?;
    Ok(problem)
}

fn read_global(tokens: &mut Tokens<'_>, m: SparseMatrix, size: usize) -> Result<Equations, FileError> {
    if m.rows != m.columns {
        return Err(tokens.error(format!("M is {} × {}, and not square", m.rows, m.columns)));
    }
    let h = matrix::read(tokens, "H")?;
    if (h.rows, h.columns) != (m.rows, size) {
        return Err(tokens.error(format!("H is {} × {}; {} × {size} fits M and the contacts", h.rows, h.columns, m.rows)));
    }
    let f = tokens.reals(m.rows, "f")?;
    let w = tokens.reals(size, "w")?;
    Ok(Equations::Global { m, h, f, w, bilateral: None })
}

/// Whether the `left` tokens after mu begin with mu_r, and whether one more follows.
fn after_mu(dimension: usize, contacts: usize, left: usize) -> (bool, bool) {
    match dimension {
        5 => (true, left > contacts),
        3 if contacts >= 2 && left == contacts => (true, false),
        3 if contacts >= 1 && left == contacts + 1 => (true, true),
        _ => (false, left > 0),
    }
}

#[cfg(test)]
mod tests;
