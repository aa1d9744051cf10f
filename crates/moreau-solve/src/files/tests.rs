use super::*;
use proptest::prelude::*;

/// The matrix of these entries in one of the five storages; blocks are single entries.
pub(super) fn stored(kind: usize, rows: usize, columns: usize, entries: &[(usize, usize, f64)]) -> SparseMatrix {
    let csr = || Csr::from_entries(rows, columns, entries.iter().copied());
    let storage = match kind {
        0 => {
            let mut values = vec![0.0; rows * columns];
            for (i, j, x) in csr().entries() {
                values[i + j * rows] = x;
            }
            Storage::Dense(values)
        }
        1 => {
            let Csr { starts, indices, values, .. } = csr();
            Storage::Blocks(Blocks {
                row_ends: (1..=rows).collect(),
                column_ends: (1..=columns).collect(),
                starts,
                columns: indices,
                values,
            })
        }
        2 => {
            let Csr { starts, indices, values, .. } = csr().transposed();
            Storage::Columns { starts, rows: indices, values }
        }
        3 => return csr().into(),
        _ => return SparseMatrix::from_entries(rows, columns, entries.iter().copied()),
    };
    SparseMatrix { rows, columns, storage }
}

/// Numbers of all magnitudes that two additions do not carry beyond the largest.
fn numbers() -> impl Strategy<Value = Vec<f64>> {
    let kinds = prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO | prop::num::f64::NEGATIVE;
    prop::collection::vec(kinds.prop_map(|x| if x.abs() < 1e300 { x } else { x * 1e-20 }), 97)
}

/// Problems of every kind, form and storage.
pub(super) fn problems() -> impl Strategy<Value = ProblemFile> {
    let shape = (0usize..4, 0usize..4, any::<bool>(), 0usize..6, any::<bool>());
    let places = prop::collection::vec((0usize..30, 0usize..30), 0..40);
    (shape, [0usize..5, 0usize..5], numbers(), places, "[ -~]{0,12}").prop_map(|(shape, kinds, numbers, places, title)| {
        let (kind, contacts, global, velocities, extras) = shape;
        let (dimension, rolling) = [(2, false), (3, false), (3, true), (5, true)][kind];
        let contacts = if (dimension, rolling) == (3, true) { contacts + 1 } else { contacts };
        let mut next = numbers.iter().copied().cycle();
        let mut vector = |length: usize| (&mut next).take(length).collect::<Vec<f64>>();
        let matrix = |kind: usize, rows: usize, columns: usize| {
            let inside = places.iter().zip(&numbers).filter(|((i, j), _)| *i < rows && *j < columns);
            stored(kind, rows, columns, &inside.map(|(&(i, j), &x)| (i, j, x)).collect::<Vec<_>>())
        };
        let size = dimension * contacts;
        let equations = if global {
            let (m, h) = (matrix(kinds[0], velocities, velocities), matrix(kinds[1], velocities, size));
            Equations::Global { m, h, f: vector(velocities), w: vector(size), bilateral: None }
        } else {
            Equations::Local { w: matrix(kinds[0], size, size), q: vector(size) }
        };
        let mut positive = || vector(contacts).into_iter().map(f64::abs).collect::<Vec<_>>();
        let (mu, mu_r) = (positive(), rolling.then(&mut positive));
        let mut problem = ProblemFile::new(dimension, equations, mu, mu_r);
        if extras {
            problem.info = Info { title: Some(title), description: Some(String::new()), math_info: None };
            let v = global.then(|| vector(velocities));
            problem.guesses =
                vec![Iterate { r: vector(size), u: vector(size), v }, Iterate { r: vector(size), u: vector(size), v: None }];
            problem.solution = Some(Iterate { r: vector(size), u: vector(size), v: None });
        }
        problem
    })
}

proptest! {
    #[test]
    fn text_is_read_back_as_it_was(problem in problems()) {
        let text = write_text(&problem).expect("a problem that passes its check");
        let back = read_text(text.as_bytes()).expect("text that was written");
        prop_assert_eq!(&back.equations, &problem.equations);
        prop_assert_eq!(back.same_as(&problem), Ok(()));
    }

    #[test]
    fn fclib_is_read_back_as_it_was(problem in problems()) {
        let back = read_fclib(&write_fclib(&problem).expect("a problem that passes its check")).expect("a file that was written");
        prop_assert_eq!(back.same_as(&problem), Ok(()));
        prop_assert_eq!((&back.info, &back.guesses, &back.solution), (&problem.info, &problem.guesses, &problem.solution));
    }

    /// Files cut short and with wrong bytes are refused or read, and never more than that.
    #[test]
    fn damaged_files_are_no_danger(
        problem in problems(),
        cut in 0.0..1.2f64,
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
    ) {
        for mut bytes in [write_text(&problem).expect("text").into_bytes(), write_fclib(&problem).expect("FCLIB")] {
            bytes.truncate((cut * bytes.len() as f64) as usize);
            for (place, byte) in &damage {
                let place = place.index(bytes.len().max(1));
                bytes.iter_mut().skip(place).take(1).for_each(|b| *b = *byte);
            }
            for read in [read_bytes(&bytes), read_text(&bytes), read_fclib(&bytes)].into_iter().flatten() {
                prop_assert_eq!(read.check(), Ok(()));
                let _ = read.any_problem();
            }
        }
    }
}

fn one_contact() -> ProblemFile {
    let w = SparseMatrix::from_entries(2, 2, [(0, 0, 2.0), (1, 1, 4.0)].into_iter());
    ProblemFile::new(2, Equations::Local { w, q: vec![-1.0, 3.0] }, vec![0.5], None)
}

#[test]
fn the_ending_decides_on_the_format_and_the_content_when_reading() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut problem = one_contact();
    problem.solution = Some(Iterate { r: vec![0.5, 0.0], u: vec![0.0, 3.0], v: None });
    for (name, hdf5) in [("a.hdf5", true), ("a.H5", true), ("a.dat", false), ("a.txt", false)] {
        let path = folder.path().join(name);
        let lost = write(&path, &problem).expect("written");
        assert_eq!(lost.is_empty(), hdf5, "{lost:?}");
        assert_eq!(std::fs::read(&path).expect("there").starts_with(b"\x89HDF"), hdf5);
        // The name says nothing to the reader.
        let renamed = folder.path().join("problem");
        std::fs::rename(&path, &renamed).expect("renamed");
        assert_eq!(read(&renamed).expect("read").same_as(&problem), Ok(()));
    }
    let message = write(&folder.path().join("a.json"), &problem).expect_err("no format").to_string();
    assert!(message.contains("a.json: ") && message.contains(".hdf5"), "{message}");
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 1, "nothing is left beside");
}

#[test]
fn a_missing_file_is_named() {
    let message = read(Path::new("/no/such/problem.dat")).expect_err("missing").to_string();
    assert!(message.starts_with("/no/such/problem.dat: cannot be read"), "{message}");
}

#[test]
fn checks_name_the_part() {
    let change = |change: &dyn Fn(&mut ProblemFile)| {
        let mut problem = one_contact();
        change(&mut problem);
        problem.check().expect_err("wrong").to_string()
    };
    for (message, start) in [
        (change(&|p| p.dimension = 5), "dimension: "),
        (change(&|p| p.mu = vec![0.5, 0.5]), "W: 2 × 2; 4 × 4"),
        (change(&|p| p.mu = vec![-0.5]), "mu: -0.5 at contact 0"),
        (change(&|p| p.mu = vec![f64::NAN]), "mu: number 0 is NaN"),
        (change(&|p| p.solution = Some(Iterate::default())), "r of solution: 0 numbers; 2 fit"),
        (
            change(&|p| {
                if let Equations::Local { q, .. } = &mut p.equations {
                    q.pop();
                }
            }),
            "q: 1 numbers; 2 fit",
        ),
    ] {
        assert!(message.starts_with(start), "{message}");
    }
}
