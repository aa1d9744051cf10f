//! Problem files for tests of the program.
#![allow(dead_code, reason = "each test program takes what it needs")]

use super::Place;
use moreau::solve::files::{self, Equations, Info, Iterate, ProblemFile, SparseMatrix};

/// A chain of `contacts` contacts with friction in space, each coupled with the next; W is diagonally dominant.
pub(crate) fn chain(contacts: usize) -> ProblemFile {
    let size = 3 * contacts;
    let diagonal = (0..size).map(|i| (i, i, 2.0 + (i % 3) as f64));
    let coupled = (0..size.saturating_sub(3)).flat_map(|i| [(i, i + 3, -0.5), (i + 3, i, -0.5)]);
    let w = SparseMatrix::from_entries(size, size, diagonal.chain(coupled));
    let q = (0..size).map(|i| [-1.0, 0.5, -0.25][i % 3] * (1.0 + i as f64 / size as f64)).collect();
    ProblemFile::new(3, Equations::Local { w, q }, vec![0.4; contacts], None)
}

/// Two bodies of the plane, one on the ground and the other on it, by their equations of motion, with a guess and a title.
pub(crate) fn stacked() -> ProblemFile {
    let m = SparseMatrix::from_entries(4, 4, [2.0, 2.0, 1.0, 1.0].into_iter().enumerate().map(|(i, mass)| (i, i, mass)));
    // v = (n₁, t₁, n₂, t₂): the first contact is of body 1 with the ground, the second of body 2 with body 1.
    let h = [(0, 0, 1.0), (1, 1, 1.0), (0, 2, -1.0), (1, 3, -1.0), (2, 2, 1.0), (3, 3, 1.0)];
    let h = SparseMatrix::from_entries(4, 4, h.into_iter());
    let equations = Equations::Global { m, h, f: vec![-2.0, 0.5, -1.0, 2.0], w: vec![0.0; 4], bilateral: None };
    let mut problem = ProblemFile::new(2, equations, vec![0.3, 0.3], None);
    problem.info = Info { title: Some("stacked".to_owned()), ..Info::default() };
    problem.guesses = vec![Iterate { r: vec![1.0, 0.0, 1.0, 0.0], u: vec![0.0; 4], v: None }];
    problem
}

/// Writes a problem into the folder of the test.
#[track_caller]
pub(crate) fn put(place: &Place, name: &str, problem: &ProblemFile) {
    let path = place.path(name);
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("folders are made");
    files::write(&path, problem).unwrap_or_else(|error| panic!("{error}"));
}

/// Reads one.
#[track_caller]
pub(crate) fn get(place: &Place, name: &str) -> ProblemFile {
    files::read(&place.path(name)).unwrap_or_else(|error| panic!("{error}"))
}
