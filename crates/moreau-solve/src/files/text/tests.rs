use super::*;
use crate::files::Storage;

/// W of a single contact in space, dense, and q.
const HEAD: &str = "3 1  0 3 3  3 3  2 -1 -2  -1 4 1  -2 1 6  -1 2 3  ";

fn read(text: &str) -> ProblemFile {
    read_text(text.as_bytes()).unwrap_or_else(|e| panic!("{text}: {e}"))
}

fn refused(text: &str) -> String {
    read_text(text.as_bytes()).expect_err(text).to_string()
}

#[test]
fn dense_matrices_are_column_by_column() {
    let problem = read("2 1  0 2 2  2 2\n 1 2\n 3 4\n  5 6  0.5\n");
    let Equations::Local { w, q } = &problem.equations else { panic!("local") };
    assert_eq!(w.csr().values, [1.0, 3.0, 2.0, 4.0]);
    assert_eq!((&q[..], &problem.mu[..], problem.notes.len()), (&[5.0, 6.0][..], &[0.5][..], 0));
}

#[test]
fn blocks_are_read_with_their_numbers() {
    let problem = read("2 2  1 4 4  3 2 2  2 4  2 4  3 3  0 2 3  0 1 1  0 1 2 3 4  1 5 6 7 8  2 9 0 0 9  1 2 3 4  0.5 0.5");
    let Equations::Local { w, .. } = &problem.equations else { panic!("local") };
    let row: Vec<_> = w.csr().row(0).collect();
    assert_eq!(row, [(0, 1.0), (1, 3.0), (2, 5.0), (3, 7.0)]);
}

#[test]
fn what_csparse_prints_is_read() {
    let tail = "\n 1 2  0.5";
    let columns = "    col 0 : locations 0 to 1\n      0 : 3\n      1 : -4e-05\n    col 1 : locations 2 to 1\n";
    let header = "CSparse Version 3.1.9, May 4, 2016.  Copyright (c) Somebody, 2006-2016\n";
    let column = read(&format!("2 1 2 2 2\n2\n{header}2-by-2, nzmax: 2 nnz: 2, 1-norm: 3.00004\n{columns}{tail}"));
    let triplet = read(&format!("2 1 2 2 2\n1\n{header}triplet: 2-by-2, nzmax: 8 nnz: 2\n    0 0 : 3\n    1 0 : -4e-05\n{tail}"));
    let rows = "    row 0 : locations 0 to 0\n  0 : 3\n  row 1 : locations 1 to 1\n  0 : -4e-05\n";
    let row = read(&format!("2 1 2 2 2\n3\n{header}csr: 2-by-2, nzmax: 2 nnz: 2\n{rows}{tail}"));
    assert_eq!(column.same_as(&triplet), Ok(()));
    assert_eq!(column.same_as(&row), Ok(()));
    let Equations::Local { w, .. } = &row.equations else { panic!("local") };
    assert!(matches!(w.storage, Storage::Rows { .. }));
    // A million, as a real.
    let far = refused(&format!("2 1 2 2 2\n1\n{header}triplet: 2-by-2, nzmax: 1 nnz: 1\n 1e+06 0 : 3{tail}"));
    assert!(far.contains("row 1000000"), "{far}");
}

#[test]
fn global_problems_are_told_by_what_follows_the_first_matrix() {
    let identity = "0 2 2 2 2 1 0 0 1";
    let problem = read(&format!("2 1 {identity} {identity} 1 2 3 4 0.5 1"));
    let Equations::Global { f, w, .. } = &problem.equations else { panic!("global") };
    assert_eq!((&f[..], &w[..]), (&[1.0, 2.0][..], &[3.0, 4.0][..]));
    assert_eq!(problem.notes, ["the token `1` at the end is ignored"]);
}

#[test]
fn a_last_number_that_may_be_cut_is_remarked() {
    let [whole, cut] = ["0.5\n", "0.5"].map(|tail| read(&format!("{HEAD} {tail}")).notes);
    assert!(whole.is_empty() && cut.len() == 1 && cut[0].contains("cut short"), "{whole:?} {cut:?}");
}

#[test]
fn rolling_in_the_plane_is_told_by_the_number_of_tokens() {
    let plain = read(&format!("{HEAD} 0.5\n"));
    let extra = read(&format!("{HEAD} 0.5 1"));
    let rolling = read(&format!("{HEAD} 0.5 0.25 1"));
    assert_eq!((&plain.mu_r, &extra.mu_r, &rolling.mu_r), (&None, &None, &Some(vec![0.25])));
    assert_eq!((plain.notes.len(), extra.notes.len(), rolling.notes.len()), (0, 1, 1));
    assert_eq!(read(&write_text(&rolling).expect("text")).same_as(&rolling), Ok(()));
    let zeros = "0 ".repeat(36);
    let two = |tail: &str| read(&format!("3 2  0 6 6  6 6 {zeros}  1 2 3 4 5 6  0.5 0.5 {tail}"));
    assert_eq!([two(""), two("7"), two("1 2"), two("1 2 7")].map(|p| p.mu_r.is_some()), [false, false, true, true]);
}

#[test]
fn errors_say_where_and_what() {
    for (text, right) in [
        ("", "line 1, column 1 (token 1): the file ends before the dimension"),
        ("3\n x", "line 2, column 2 (token 2): the number of contacts is `x`; an integer is right"),
        ("4 1 0", "the dimension is 4; 2, 3 or"),
        ("2 -1", "the number of contacts is -1; it is not negative"),
        ("3 1000000000000", "1000000000000 tokens are needed"),
        ("3 1 7 3 3 1", "storage 7; 0 dense"),
        ("3 1 0 3 3 3 4 1", "4 columns after 3 before"),
        ("3 1 0 4000000000 4000000000 4000000000 4000000000 1", "tokens are needed"),
        ("3 1 0 9000000000000000000 9000000000000000000 9000000000000000000 9000000000000000000 1", "tokens are needed"),
        ("2 1 0 2 2 2 2 1 nan 0 1 0 0 0.5", "token 9): dense entries has `nan`; a finite number"),
        ("2 1 1 2 2 1 1 1 2 2 2 1 0 1 1 0 1 2 3 4  1 2 0.5", "in column of blocks 1"),
        ("2 1 1 2 2 1 1 1 2 2 2 1 1 1 0 0 1 2 3 4  1 2 0.5", "starts from 1 to 1"),
        ("2 1 1 2 2 1 1 1 2 2 2 1 0 1 0 5 1 2 3 4  1 2 0.5", "block 5 where block 0"),
        ("2 1 1 2 2 1 1 1 99999999999999 2 2 1 0 1 0 0 1 2 3 4  1 2 0.5", "tokens are needed"),
        ("2 1 2 2 2 1 CSparse\n2-by-3, nzmax: 1 nnz: 1\n", "`2-by-2, nzmax"),
        ("2 1 2 2 2 1 CSparse\n2-by-2, nzmax: 1\n 1", "are missing in this line"),
        ("2 1 2 2 2 2 CSparse\n2-by-2, nzmax: 1 nnz: 1\ncol 0 : locations 0 to -7 1 1 1", "before the first"),
        ("2 1 2 2 2 2 CSparse\n2-by-2, nzmax: 0 nnz: 0\ncol 1 : locations 0 to -1", "as the number of the col after 0"),
        ("2 1 0 2 2 2 2 1 0 0 1 5 6 -0.5", "mu: -0.5 at contact 0"),
        ("2 1 0 2 2 2 2 1 0 0 1 5 6", "mu: 1 tokens are needed, and the file has room for 0 more"),
        ("2 1 0 2 3 2 3 1 0 0 1 5 6 7", "M is 2 × 3, and not square"),
        (&format!("{HEAD} 0.5 1 2 3"), "(token 22): 2 tokens follow the end"),
    ] {
        let message = refused(text);
        assert!(message.contains(right), "{text}: {message}");
    }
    assert!(read_text(b"3 1 \xff").expect_err("no text").to_string().contains("is not text"));
}
