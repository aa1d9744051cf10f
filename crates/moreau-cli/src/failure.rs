//! How the program ends when something is wrong: one message on the standard error, one exit code of the table below.
//!
//! | code | meaning |
//! |---|---|
//! | 0 | done |
//! | 1 | something could not be read or written |
//! | 2 | wrong words on the command line (from the parser) |
//! | 3 | the scene or the problem in a file is wrong |
//! | 4 | the computation failed: a solve of `moreau solve` or under the policy `stop` did not converge, a step broke a limit under that policy, or a number ceased to be finite |
//! | 5 | solvers that should agree do not |
//! | 6 | the run is not to be relied on, and `--strict` was given |
//! | 130 | interrupted by Ctrl-C, SIGTERM or SIGHUP; what was computed is kept. By a second signal: ended at once; the last checkpoint is kept |

use moreau::io::whole;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;

/// An exit code with its message.
#[derive(Debug)]
pub(crate) struct Failure {
    code: u8,
    message: String,
}

impl Failure {
    /// A file.
    pub(crate) fn file(message: impl Display) -> Self {
        Self { code: 1, message: message.to_string() }
    }

    /// Wrong words on the command line that the parser lets through.
    pub(crate) fn usage(message: impl Display) -> Self {
        Self { code: 2, message: message.to_string() }
    }

    /// A scene, or the problem that a file holds.
    pub(crate) fn scene(message: impl Display) -> Self {
        Self { code: 3, message: message.to_string() }
    }

    /// A computation.
    pub(crate) fn computation(message: impl Display) -> Self {
        Self { code: 4, message: message.to_string() }
    }

    /// Disagreement.
    pub(crate) fn disagreement(message: impl Display) -> Self {
        Self { code: 5, message: message.to_string() }
    }

    /// A run that is not to be relied on.
    pub(crate) fn unreliable(message: impl Display) -> Self {
        Self { code: 6, message: message.to_string() }
    }

    /// True if the run was done and is not to be relied on.
    pub(crate) fn is_unreliable(&self) -> bool {
        self.code == 6
    }

    /// Ctrl-C.
    pub(crate) fn interrupted(message: impl Display) -> Self {
        Self { code: 130, message: message.to_string() }
    }

    /// Says it on the standard error as something that does no harm: what was done about it, and why.
    pub(crate) fn note(&self, done: &str) {
        remark(&format!("{done}: {}", self.message));
    }

    /// A last word with the code of this failure, whose own message was printed before.
    pub(crate) fn again(self, message: String) -> Self {
        Self { message, ..self }
    }

    /// Prints the message and gives the code.
    pub(crate) fn report(&self) -> ExitCode {
        let word = if self.code == 130 { "interrupted" } else { "error" };
        // Nobody may be there to read it; the code still tells.
        let _ = writeln!(std::io::stderr(), "{word}: {}", self.message);
        ExitCode::from(self.code)
    }
}

/// Prints something that does no harm on the standard error.
pub(crate) fn remark(text: &str) {
    let _ = writeln!(std::io::stderr(), "note: {text}");
}

/// Writes to the standard output; a closed pipe ends the program quietly, as `head` expects.
pub(crate) fn say(text: &str) -> Result<(), Failure> {
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::file(format!("standard output: {error}"))),
        _ => Ok(()),
    }
}

/// What went wrong with `path`, without the temporary names that an error may carry.
fn cannot_write(path: &Path, error: &std::io::Error) -> Failure {
    let reason = std::io::Error::from(error.kind());
    let advice = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "make room there, or write to another disk",
        ErrorKind::FileTooLarge => "raise the limit of file sizes (ulimit -f)",
        _ => "give a place in a folder that exists and can be written",
    };
    Failure::file(format!("cannot write {}: {reason}; {advice}", path.display()))
}

/// Makes sure, before long work, that a file can be written at its end.
pub(crate) fn writable(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(Failure::file(format!("cannot write {}: it is a folder; give the name of a file", path.display())));
    }
    if path.exists() && !path.is_file() {
        return Err(Failure::file(format!("cannot write {}: it is not a plain file; give the name of one", path.display())));
    }
    whole::beside(path).map(drop).map_err(|error| cannot_write(path, &error))
}

/// Writes a whole file beside its place and renames it, so that nobody sees half of it.
pub(crate) fn write_whole(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
    whole::write(path, &[bytes.as_ref()]).map_err(|error| cannot_write(path, &error))
}
