use super::*;
use crate::Operator;
use crate::files::tests::problems;
use proptest::prelude::*;

fn product<const D: usize>(w: &Delassus<D>, r: &[Vector<D>]) -> Vec<f64> {
    let mut state = Default::default();
    w.start(r, &mut state);
    (0..r.len()).flat_map(|c| w.apply(&state, c)).collect()
}

/// Three contacts, the second without a diagonal block.
fn example<const D: usize>() -> (Csr, StoredProblem<D>) {
    let entries =
        (0..D).flat_map(|i| [(i, i, 1.0 + i as f64), (i, 2 * D, 0.25), (D + i, 2 * D + i, 3.0), (2 * D + i, 2 * D, -0.5)]);
    let w = Csr::from_entries(3 * D, 3 * D, entries);
    let q: Vec<f64> = (0..3 * D).map(|k| k as f64).collect();
    let cones = vec![if D == 5 { Cone::Rolling { mu: 0.5, mu_r: 0.25 } } else { Cone::Coulomb(0.5) }; 3];
    let stored = StoredProblem::new(&w, &q, cones);
    (w, stored)
}

fn entries_become_blocks<const D: usize>() {
    let (w, stored) = example::<D>();
    let r: Vec<Vector<D>> = (0..3).map(|c| std::array::from_fn(|i| (1 + c * D + i) as f64)).collect();
    let flat = r.as_flattened();
    let right: Vec<f64> = (0..3 * D).map(|i| w.row(i).map(|(j, x)| x * flat[j]).sum()).collect();
    assert_eq!(product(&stored.operator, &r), right);
    assert_eq!(stored.operator.diagonal(1), [[0.0; D]; D]);
    assert_eq!(stored.operator.diagonal(0)[1][1], 2.0);
    let places: Vec<_> = stored.operator.blocks().map(|(c, d, _)| (c, d)).collect();
    assert_eq!(places, [(0, 0), (0, 2), (1, 2), (2, 2)]);
}

#[test]
fn entries_become_blocks_in_all_dimensions() {
    entries_become_blocks::<2>();
    entries_become_blocks::<3>();
    entries_become_blocks::<5>();
}

fn returns<const D: usize>() {
    let (w, stored) = example::<D>();
    let file = ProblemFile::from_stored(&stored).expect("has a place in files");
    let (back, q) = file.local().expect("local");
    assert_eq!((back, &q[..]), (w, stored.q.as_flattened()));
    let cones = match file.any_problem().expect("local") {
        AnyProblem::Plane(problem) => problem.cones,
        AnyProblem::Solid(problem) | AnyProblem::PlaneRolling(problem) => problem.cones,
        AnyProblem::SolidRolling(problem) => problem.cones,
    };
    assert_eq!(cones, stored.cones);
}

#[test]
fn stored_problems_return_from_files() {
    returns::<2>();
    returns::<3>();
    returns::<5>();
}

#[test]
fn laws_without_a_place_in_files_are_refused() {
    let with = |cones: &[Cone]| {
        let q = vec![[0.0; 3]; cones.len()];
        let operator = Delassus::from_entries(cones.len(), std::iter::empty());
        ProblemFile::from_stored(&StoredProblem { operator, q, cones: cones.to_vec() })
    };
    let rolling = Cone::Rolling { mu: 0.5, mu_r: 0.1 };
    assert!(with(&[Cone::Sticking]).expect_err("no place").to_string().contains("contact 0 has Sticking"));
    let bilateral = [Cone::Signorini, Cone::Bilateral { held: 3 }];
    assert!(with(&bilateral).expect_err("no place").to_string().contains("contact 1 has Bilateral"));
    assert!(with(&[rolling, Cone::Coulomb(0.5)]).expect_err("mixed").to_string().contains("contact 1 has Coulomb"));
    assert_eq!(with(&[rolling, Cone::Signorini]).expect("both roll").mu_r, Some(vec![0.1, 0.0]));
    assert_eq!(with(&[Cone::Coulomb(0.5), Cone::Signorini]).expect("no rolling").mu, [0.5, 0.0]);
    assert!(ProblemFile::from_stored(&StoredProblem::<1>::default()).is_err());
}

proptest! {
    /// W as blocks is W as rows.
    #[test]
    fn blocks_keep_all_entries(problem in problems()) {
        let Ok((w, _)) = problem.local() else { return Ok(()) };
        let Ok(AnyProblem::Solid(stored)) = problem.any_problem() else { return Ok(()) };
        let entries = stored.operator.blocks().flat_map(|(c, d, block)| {
            (0..9).map(move |k| (3 * c + k / 3, 3 * d + k % 3, block[k / 3][k % 3]))
        });
        prop_assert_eq!(Csr::from_entries(w.rows, w.columns, entries), w);
    }
}
