//! Problem files with flipped bits and cut ends. Numbers in FCLIB's format have checksums: refused, or read as they were. The text
//! format has none: a flipped digit is another number, but what is read is always a sound problem, and a cut end is refused or remarked.
#![cfg(feature = "files")]

use moreau_solve::files::{self, Equations, Info, Iterate, ProblemFile, SparseMatrix, Storage};
use rand::{Rng, SeedableRng};

/// Two rolling contacts of a body, with all that a file can hold.
fn rolling() -> ProblemFile {
    let numbers = |n: usize, shift: f64| (0..n).map(|i| ((i as f64 + shift) * 0.7).sin()).collect::<Vec<_>>();
    let m = SparseMatrix::from_entries(6, 6, (0..6).map(|i| (i, i, 2.0 + i as f64)));
    let h = SparseMatrix { rows: 6, columns: 10, storage: Storage::Dense(numbers(60, 1.0)) };
    let equations = Equations::Global { m, h, f: numbers(6, 2.0), w: numbers(10, 3.0), bilateral: None };
    let mut problem = ProblemFile::new(5, equations, vec![0.5, 0.25], Some(vec![0.125, 0.0625]));
    problem.info = Info { title: Some("two wheels".to_owned()), description: Some("of a cart".to_owned()), math_info: None };
    problem.guesses = vec![Iterate { r: numbers(10, 4.0), u: numbers(10, 5.0), v: Some(numbers(6, 6.0)) }];
    problem.solution = Some(Iterate { r: numbers(10, 7.0), u: numbers(10, 8.0), v: None });
    problem
}

/// Hands `read` the bytes 200 times with a bit flipped, then 200 times cut off at some place.
fn damaged(whole: &[u8], mut read: impl FnMut(usize, bool, &[u8])) {
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(7);
    for case in 0..400 {
        let mut bytes = whole.to_vec();
        let at = (random.next_u64() % bytes.len() as u64) as usize;
        let cut = case >= 200;
        if cut {
            bytes.truncate(at);
        } else {
            bytes[at] ^= 1 << (random.next_u64() % 8);
        }
        read(at, cut, &bytes);
    }
}

/// Whether two problems are the same in all their numbers. Titles and descriptions are single texts in FCLIB's format, which have no place
/// for a checksum.
fn same(a: &ProblemFile, b: &ProblemFile) -> bool {
    a.same_as(b).is_ok() && (&a.guesses, &a.solution) == (&b.guesses, &b.solution)
}

#[test]
fn a_damaged_file_of_fclib_is_refused_or_read_as_it_was() {
    let bytes = files::write_fclib(&rolling()).expect("a file");
    let right = files::read_fclib(&bytes).expect("a problem");
    assert!(same(&right, &rolling()));
    let mut refused = 0;
    damaged(&bytes, |at, cut, bytes| match files::read_fclib(bytes) {
        Ok(problem) => assert!(same(&problem, &right), "byte {at}, cut {cut}: read as something else"),
        Err(error) => {
            assert!(!error.to_string().is_empty());
            refused += 1;
        }
    });
    assert!(refused > 250, "{refused}");
}

#[test]
fn a_damaged_text_is_refused_or_a_sound_problem_and_cuts_are_seen() {
    let text = files::write_text(&rolling()).expect("a text");
    let right = files::read_text(text.as_bytes()).expect("a problem");
    damaged(text.as_bytes(), |at, cut, bytes| match files::read_text(bytes) {
        Ok(problem) => {
            problem.check().expect("sound");
            if let Err(error) = problem.any_problem() {
                assert!(!error.to_string().is_empty());
            }
            let remarked = problem.notes.iter().any(|note| note.contains("cut short"));
            assert!(!cut || remarked || problem.same_as(&right).is_ok(), "byte {at}: cut, and nothing is said of it");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    });
}
