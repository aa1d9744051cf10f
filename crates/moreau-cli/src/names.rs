//! Names and numbers on the command line.

use moreau::solve::{Criterion, GlobalMethod, LocalMethod};

/// The global solver of problem files where none is named.
pub(crate) fn default_global() -> &'static str {
    GlobalMethod::Auto.name()
}

pub(crate) fn local(name: &str) -> Result<LocalMethod, String> {
    LocalMethod::from_name(name).ok_or_else(|| "no such local solver; see `moreau list local`".to_owned())
}

pub(crate) fn global(name: &str) -> Result<GlobalMethod, String> {
    GlobalMethod::from_name(name).ok_or_else(|| "no such global solver; see `moreau list global`".to_owned())
}

pub(crate) fn criterion(name: &str) -> Result<Criterion, String> {
    Criterion::from_name(name).ok_or_else(|| "no such criterion; see `moreau list criteria`".to_owned())
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("a positive number is wanted".to_owned()),
    }
}
