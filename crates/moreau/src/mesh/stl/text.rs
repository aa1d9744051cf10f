//! STL as text.

use super::{HEAD, point, push, shown};
use crate::mesh::{MOST_TRIANGLES, Mesh, MeshError, MeshFile, Object, Place};

/// True if the file begins with `solid` and has words of text after the bytes that a binary file may fill with anything.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = bytes.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(0);
    let begins = bytes[start..].get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    let has = |word: &[u8]| bytes[HEAD..].windows(word.len()).any(|found| found.eq_ignore_ascii_case(word));
    begins && (bytes.len() <= HEAD || has(b"vertex") || has(b"facet") || has(b"endsolid"))
}

/// Where in the text a word may stand.
#[derive(Clone, Copy, PartialEq)]
enum Inside {
    Nothing,
    Solid,
    Facet,
    /// With so many corners so far.
    Loop(usize),
    Closed,
}

/// A word and its line, from 1.
type Word<'a> = (&'a str, usize);

/// The words of a text that are still to be read. A line ends with `\n`, `\r\n` or `\r`.
#[derive(Clone)]
struct Words<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Iterator for Words<'a> {
    type Item = Word<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        let word = self.rest.trim_start();
        let blanks = &self.rest.as_bytes()[..self.rest.len() - word.len()];
        let ends_line = |i: &usize| blanks[*i] == b'\n' || blanks[*i] == b'\r' && blanks.get(i + 1) != Some(&b'\n');
        self.line += (0..blanks.len()).filter(ends_line).count();
        let end = word.find(char::is_whitespace).unwrap_or(word.len());
        self.rest = &word[end..];
        (end > 0).then_some((&word[..end], self.line))
    }
}

impl<'a> Words<'a> {
    /// The next word in small letters, which stays to be read.
    fn peek(&self) -> Option<String> {
        self.clone().next().map(|(word, _)| word.to_ascii_lowercase())
    }

    /// Takes the next word if it is this one.
    fn take_word(&mut self, wanted: &str) -> bool {
        let found = self.peek().is_some_and(|word| word == wanted);
        if found {
            self.next();
        }
        found
    }

    /// Takes up to three words that are no words of the format.
    fn numbers(&mut self) -> Vec<&'a str> {
        let mut numbers = Vec::with_capacity(3);
        while numbers.len() < 3 && self.peek().is_some_and(|word| !WORDS.contains(&word.as_str())) {
            numbers.extend(self.next().map(|(word, _)| word));
        }
        numbers
    }

    /// Takes the rest of a line as a name. If the file goes on in the same line, the name ends before the word that goes on.
    fn name(&mut self, line: usize, goes_on: impl Fn(&str, Option<&str>) -> bool) -> Option<String> {
        let mut name = String::new();
        loop {
            let mut ahead = self.clone();
            let Some((word, at)) = ahead.next() else { break };
            if at != line || goes_on(&word.to_ascii_lowercase(), ahead.peek().as_deref()) {
                break;
            }
            name = if name.is_empty() { shown(word) } else { format!("{name} {}", shown(word)) };
            *self = ahead;
        }
        (!name.is_empty()).then(|| name.chars().take(200).collect())
    }

    /// True if the rest of a line has this word.
    fn line_has(&self, line: usize, wanted: &str) -> bool {
        self.clone().take_while(|&(_, at)| at == line).any(|(word, _)| word.eq_ignore_ascii_case(wanted))
    }
}

const WORDS: [&str; 7] = ["solid", "facet", "outer", "vertex", "endloop", "endfacet", "endsolid"];

pub(super) fn read(bytes: &[u8], file: &str) -> Result<MeshFile, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut words = Words { rest: text.trim_start_matches('\u{feff}'), line: 1 };
    let mut soup = Mesh::default();
    let (mut objects, mut remarks) = (Vec::<Object>::new(), Vec::new());
    let (mut inside, mut last) = (Inside::Nothing, 1);
    while let Some((word, line)) = words.next() {
        last = line;
        let lower = word.to_ascii_lowercase();
        let fault = |message: String, hint: &str| Err(MeshError::read(file, Place::Line(line), message, hint));
        inside = match (inside, lower.as_str()) {
            (Inside::Nothing, "solid") => {
                let facet = |word: &str, next: Option<&str>| word == "facet" && matches!(next, Some("normal" | "outer"));
                let name = words.name(line, |word, next| word == "endsolid" || facet(word, next));
                objects.push(Object { name, triangles: Vec::new() });
                Inside::Solid
            }
            (Inside::Solid, "facet") => {
                // The normal follows from the corners.
                if words.take_word("normal") {
                    words.numbers();
                }
                Inside::Facet
            }
            (Inside::Facet, "outer") if words.take_word("loop") => Inside::Loop(0),
            (Inside::Loop(corners @ 0..3), "vertex") => {
                push(&mut soup, point(words.numbers().into_iter(), file, line)?);
                Inside::Loop(corners + 1)
            }
            (Inside::Loop(3), "endloop") => Inside::Closed,
            (Inside::Closed, "endfacet") => {
                let count = soup.triangles.len();
                if count > MOST_TRIANGLES {
                    return fault("too many triangles".into(), &format!("expected at most {MOST_TRIANGLES}"));
                }
                objects.last_mut().into_iter().for_each(|object| object.triangles.push(count as u32 - 1));
                Inside::Solid
            }
            (Inside::Solid, "endsolid") => {
                // A name may be `solid`, too.
                let goes_on = words.line_has(line, "endsolid");
                words.name(line, |word, _| goes_on && word == "solid");
                Inside::Nothing
            }
            (Inside::Loop(3), "vertex") => return fault("a fourth corner".into(), "expected `endloop`: facets are triangles"),
            (Inside::Nothing, _) if !objects.is_empty() => {
                remarks.push(format!("{file}:{line}: the text after `endsolid` was left out"));
                break;
            }
            _ => return fault(format!("`{}`", shown(word)), next(inside)),
        };
    }
    if inside != Inside::Nothing {
        return Err(MeshError::read(file, Place::Line(last), "the text ends within the solid", next(inside)));
    }
    Ok(MeshFile { mesh: soup, objects, remarks }.merged(0.0))
}

/// What may come where the text is.
fn next(inside: Inside) -> &'static str {
    match inside {
        Inside::Nothing => "expected `solid`",
        Inside::Solid => "expected `facet` or `endsolid`",
        Inside::Facet => "expected `outer loop`",
        Inside::Loop(3) => "expected `endloop`",
        Inside::Loop(_) => "expected `vertex x y z`",
        Inside::Closed => "expected `endfacet`",
    }
}
