//! What is wrong in a scene, where, and what would be right.

use super::path::KeyPath;
use std::fmt;
use std::ops::Range;

/// A line and a column of a file, both from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineColumn {
    /// The line.
    pub line: usize,
    /// The column, in characters.
    pub column: usize,
}

/// Where in a scene something is wrong.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file as it was named; `--set` for an override, whose "line" is its number in the list.
    pub file: String,
    /// The line and column; none where the scene was not read from text or the file could not be read.
    pub at: Option<LineColumn>,
    /// The way to the value, such as `bodies[3].shape.ball.radius`; empty for the scene as a whole.
    pub key: String,
    /// The line, with carets below what is wrong; empty where there is none.
    pub excerpt: String,
}

/// Why a scene cannot be used: the first thing that is wrong with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// Where.
    pub place: Box<Place>,
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub hint: String,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Place { file, at, key, excerpt } = &*self.place;
        write!(f, "{file}")?;
        if let Some(LineColumn { line, column }) = at {
            write!(f, ":{line}:{column}")?;
        }
        if !key.is_empty() {
            write!(f, ": {key}")?;
        }
        write!(f, ": {}", self.message)?;
        if !excerpt.is_empty() {
            write!(f, "\n{excerpt}")?;
        }
        if !self.hint.is_empty() {
            write!(f, "\n  = {}", self.hint)?;
        }
        Ok(())
    }
}

impl std::error::Error for SceneError {}

/// What a check finds wrong, before its place in the text is looked up.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    /// The value.
    pub(super) path: KeyPath,
    /// What is wrong.
    pub(super) message: String,
    /// What would be right.
    pub(super) hint: String,
}

impl Fault {
    pub(super) fn new(path: KeyPath, message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { path, message: message.into(), hint: hint.into() }
    }
}

/// Line and column of a byte of `text`.
pub(super) fn line_column(text: &str, offset: usize) -> LineColumn {
    let before = &text[..floor_char(text, offset)];
    let start = before.rfind('\n').map_or(0, |i| i + 1);
    LineColumn { line: before.matches('\n').count() + 1, column: before[start..].chars().count() + 1 }
}

/// The line in which `span` begins, numbered `line`, with carets below the part of the span that lies in it.
pub(super) fn excerpt(text: &str, span: &Range<usize>, line: usize) -> String {
    let start = floor_char(text, span.start);
    let begin = text[..start].rfind('\n').map_or(0, |i| i + 1);
    let end = text[start..].find('\n').map_or(text.len(), |i| start + i);
    let stop = floor_char(text, span.end).clamp(start, end);
    // A tab would shift the carets: one column for each character.
    let shown = text[begin..end].trim_end().replace('\t', " ");
    let (indent, carets) = (text[begin..start].chars().count(), text[start..stop].trim_end().chars().count().max(1));
    let margin = " ".repeat(line.to_string().len());
    format!("{margin} |\n{line} | {shown}\n{margin} | {}{}", " ".repeat(indent), "^".repeat(carets))
}

/// The last place at or before `offset` where a character begins.
fn floor_char(text: &str, offset: usize) -> usize {
    (0..=offset.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// "did you mean `x`? known …: `x`, `y`": the hint for a name that is not in a list.
pub(super) fn nearest<'a>(name: &str, what: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let likely = known
        .iter()
        .map(|candidate| (strsim::damerau_levenshtein(name, candidate), candidate))
        .min_by_key(|&(distance, _)| distance)
        .filter(|&(distance, candidate)| 3 * distance <= name.chars().count().max(candidate.chars().count()) + 1);
    let question = likely.map_or(String::new(), |(_, name)| format!("did you mean `{name}`? "));
    if known.is_empty() {
        return format!("there are no {what}");
    }
    let list: Vec<String> = known.iter().map(|name| format!("`{name}`")).collect();
    format!("{question}known {what}: {}", list.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn carets_stand_below_the_span() {
        let text = "a = 1\n\tμ = -1\n";
        let span = 12..14;
        assert_eq!(&text[span.clone()], "-1");
        let at = line_column(text, span.start);
        assert_eq!(at, LineColumn { line: 2, column: 6 });
        assert_eq!(excerpt(text, &span, at.line), "  |\n2 |  μ = -1\n  |      ^^");
    }

    #[test]
    fn a_misspelt_name_finds_its_neighbour() {
        assert!(nearest("tolernce", "keys", ["theta", "tolerance"]).starts_with("did you mean `tolerance`?"));
        assert_eq!(nearest("zzz", "keys", ["theta"]), "known keys: `theta`");
    }
}
