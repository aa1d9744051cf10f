use super::*;
use crate::files::SparseMatrix;
use proptest::prelude::*;

/// A global problem with these entries, f and w all ones.
fn global(velocities: usize, size: usize, m: &[(usize, usize, f64)], h: &[(usize, usize, f64)]) -> ProblemFile {
    let matrix =
        |rows, columns, entries: &[(usize, usize, f64)]| SparseMatrix::from_entries(rows, columns, entries.iter().copied());
    let (m, h) = (matrix(velocities, velocities, m), matrix(velocities, size, h));
    let equations = Equations::Global { m, h, f: vec![1.0; velocities], w: vec![1.0; size], bilateral: None };
    ProblemFile::new(2, equations, vec![0.5; size / 2], None)
}

#[test]
fn masses_divide() {
    // Two bodies of masses 2 and 4, one contact between them.
    let problem = global(2, 2, &[(0, 0, 2.0), (1, 1, 4.0)], &[(0, 0, 1.0), (1, 0, -1.0), (1, 1, 8.0)]);
    let (w, q) = problem.local().expect("regular");
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
    assert!(close(&w.values, &[0.75, -2.0, -2.0, 16.0]) && close(&q, &[1.25, 3.0]), "{w:?} {q:?}");
    assert_eq!(w.asymmetry(), 0.0);
}

#[test]
fn a_matrix_that_is_not_definite_or_not_symmetric_is_factorised_too() {
    let h = [(0, 0, 1.0), (1, 1, 1.0)];
    let indefinite = global(2, 2, &[(0, 1, 2.0), (1, 0, 2.0)], &h).local().expect("regular").0;
    assert_eq!((indefinite.row(0).next(), indefinite.row(1).next()), (Some((1, 0.5)), Some((0, 0.5))));
    let general = global(2, 2, &[(0, 0, 1.0), (0, 1, 3.0), (1, 1, 2.0)], &h).local().expect("regular").0;
    assert_eq!(general.values, [1.0, -1.5, 0.5]);
}

#[test]
fn velocities_obey_the_equation_of_motion() {
    let mut problem = global(2, 2, &[(0, 0, 2.0), (1, 1, 4.0)], &[(0, 0, 1.0), (1, 0, -1.0), (1, 1, 8.0)]);
    // 2 v₀ = r_n + 1 and 4 v₁ = −r_n + 8 r_t + 1.
    let v = problem.velocities(&[3.0, 0.5]).expect("regular").expect("a global problem");
    assert!((v[0] - 2.0).abs() < 1e-14 && (v[1] - 0.5).abs() < 1e-14 && v.len() == 2, "{v:?}");
    assert!(problem.velocities(&[3.0]).expect_err("too short").to_string().starts_with("r: 1 numbers; 2 fit"));
    // Both held together by v₀ − v₁ + 1 = 0: 6 v₀ = 8 r_t + 2 − 4.
    if let Equations::Global { bilateral, .. } = &mut problem.equations {
        *bilateral =
            Some(Bilateral { g: SparseMatrix::from_entries(2, 1, [(0, 0, 1.0), (1, 0, -1.0)].into_iter()), b: vec![1.0] });
    }
    let v = problem.velocities(&[3.0, 0.5]).expect("regular").expect("a global problem");
    assert!((v[0] - 1.0 / 3.0).abs() < 1e-14 && (v[1] - 4.0 / 3.0).abs() < 1e-14 && v.len() == 2, "{v:?}");
    let (_, q) = problem.local().expect("regular");
    assert_eq!(q.len(), 2);
}

#[test]
fn a_singular_matrix_is_named() {
    let h = [(0, 0, 1.0), (1, 1, 1.0)];
    let third = 1.0 / 3.0;
    for m in [
        vec![(0, 0, 1.0)],
        vec![(0, 0, 1.0), (1, 0, 1.0)],
        vec![(0, 0, 1.0), (0, 1, 2.0), (1, 0, 2.0), (1, 1, 4.0)],
        vec![(0, 0, 0.1), (0, 1, third), (1, 0, 0.3), (1, 1, 3.0 * third)],
    ] {
        let message = global(2, 2, &m, &h).local().expect_err("singular").to_string();
        assert!(message.starts_with("M: is singular"), "{message}");
    }
}

#[test]
fn badly_scaled_masses_are_regular() {
    let (w, _) = global(2, 2, &[(0, 0, 1e-12), (1, 1, 1e12)], &[(0, 0, 1.0), (1, 1, 1.0)]).local().expect("regular");
    assert_eq!(w.values, [1e12, 1e-12]);
}

#[test]
fn held_velocities_do_not_answer() {
    // Two unit masses, the second held at v = 3: only the first answers to impulses.
    let mut problem = global(2, 2, &[(0, 0, 1.0), (1, 1, 1.0)], &[(0, 0, 1.0), (1, 1, 1.0)]);
    let Equations::Global { bilateral, .. } = &mut problem.equations else { panic!("global") };
    *bilateral = Some(Bilateral { g: SparseMatrix::from_entries(2, 1, [(1, 0, 1.0)].into_iter()), b: vec![-3.0] });
    let (w, q) = problem.local().expect("regular");
    assert!((w.row(0).next().expect("an entry").1 - 1.0).abs() < 1e-15 && w.values[1..].iter().all(|x| x.abs() < 1e-15), "{w:?}");
    assert!((q[0] - 2.0).abs() < 1e-14 && (q[1] - 4.0).abs() < 1e-14, "{q:?}");
}

#[test]
fn columns_that_share_no_part_are_solved_for_together() {
    // A chain: body k is in contacts k and k + 1.
    let touched: Vec<Vec<usize>> = (0..50).map(|k| vec![k, k + 1]).collect();
    let sides = share(&touched, 51);
    assert_eq!(sides.len(), 2);
    assert_eq!(sides.iter().map(Vec::len).sum::<usize>(), 50);
}

proptest! {
    /// Sharing right-hand sides changes nothing: W is what solving for each column alone by elimination gives.
    #[test]
    fn the_reduced_matrix_is_the_product(
        links in prop::collection::vec((0usize..6, 0usize..6, -1.0..1.0f64), 0..6),
        h in prop::collection::vec((0usize..6, 0usize..6, -1.0..1.0f64), 0..12),
    ) {
        // Strictly dominant, hence regular.
        let mut m: Vec<_> = (0..6).map(|i| (i, i, 8.0)).collect();
        m.extend(&links);
        let (w, _) = global(6, 6, &m, &h).local().expect("regular");
        let dense = |entries: &[(usize, usize, f64)]| {
            let mut a = [[0.0; 6]; 6];
            entries.iter().for_each(|&(i, j, x)| a[i][j] += x);
            a
        };
        let (m, h) = (dense(&m), dense(&h));
        for j in 0..6 {
            let x = crate::block::solve(&m, &std::array::from_fn(|i| h[i][j])).expect("regular");
            for i in 0..6 {
                let right: f64 = (0..6).map(|k| h[k][i] * x[k]).sum();
                let found = w.row(i).find(|entry| entry.0 == j).map_or(0.0, |entry| entry.1);
                prop_assert!((found - right).abs() < 1e-12, "W[{}][{}] = {} and {}", i, j, found, right);
            }
        }
    }
}
