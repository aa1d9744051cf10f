//! What becomes of output that nobody reads to the end, or that does not fit.

mod common;

use common::{Place, TEN};
use std::process::Stdio;

/// Runs the program with a pipe that nobody reads as its standard output or error; gives its exit code and what the other got.
fn unread(place: &Place, words: &[&str], error_too: bool) -> (Option<i32>, String) {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let mut command = place.command(words);
    command.stdout(writer.try_clone().expect("a second end")).stderr(Stdio::piped());
    if error_too {
        command.stderr(writer);
    }
    let output = command.spawn().and_then(std::process::Child::wait_with_output).expect("the program runs");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn a_closed_pipe_ends_the_program_quietly() {
    let place = Place::with("ten.toml", TEN);
    let commands = [
        &["list", "local"][..],
        &["schema"],
        &["check", "ten.toml"],
        &["run", "ten.toml"],
        &["compare", "ten.toml", "--local", "pdas"],
        &["new", "heap"],
        &["--help"],
        &["--version"],
    ];
    for words in commands {
        assert_eq!(unread(&place, words, false), (Some(0), String::new()), "`moreau {}`", words.join(" "));
    }
}

#[test]
fn an_error_that_nobody_reads_keeps_its_code() {
    let place = Place::with("bad.toml", "dimension = 4");
    for (words, code) in [(&["check", "bad.toml"][..], 3), (&["run", "bad.toml"], 3), (&["list", "nonsense"], 2)] {
        assert_eq!(unread(&place, words, true).0, Some(code), "`moreau {}`", words.join(" "));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let place = Place::with("ten.toml", TEN);
    for words in [&["list", "local"][..], &["schema"], &["check", "ten.toml"]] {
        let full = std::fs::File::options().write(true).open("/dev/full").expect("/dev/full");
        let output = place.command(words).stdout(full).output().expect("the program runs");
        let err = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{err}");
        assert!(err.starts_with("error: standard output: "), "{err}");
    }
}
