//! The text of a scene: overrides, and the place of each value.

use super::error::{Fault, Place, SceneError, excerpt, line_column};
use super::path::{KeyPath, Segment};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// The text that a scene was read from.
///
/// Overrides (`key.path=value`) follow the file, a line each, so that one offset tells where anything stands.
#[derive(Clone, Debug, Default)]
pub(super) struct Source {
    name: String,
    text: String,
    file_length: usize,
    sets: Vec<Set>,
}

/// Where a scene was read from is no part of what it says: scenes compare without it.
impl PartialEq for Source {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// One override, with its key and its value each as a document of its own. Blanks before them make their spans those of the text.
#[derive(Clone, Debug)]
struct Set {
    start: usize,
    end: usize,
    /// `key.path = 0`; none where the override has no `=`.
    key: Option<String>,
    /// `v=value`.
    value: String,
}

impl Set {
    fn new(set: &str, start: usize) -> Self {
        let end = start + set.len();
        let Some(equals) = set.find('=') else {
            return Self { start, end, key: None, value: String::new() };
        };
        let (key, value) = (&set[..equals], set[equals + 1..].trim());
        let at = end - set[equals + 1..].trim_start().len();
        let document = |value: &str| format!("{}v={value}", " ".repeat(at.saturating_sub(2)));
        let plain = document(value);
        // A bare word is a string; what opens like a string, an array or a table is meant to be one and keeps its error.
        let bare = DeTable::parse(&plain).is_err() && !value.starts_with(['[', '{', '"', '\'']);
        let value = if bare { document(&toml::Value::from(value).to_string()) } else { plain };
        Self { start, end, key: Some(format!("{}{key} = 0", " ".repeat(start))), value }
    }
}

impl Source {
    pub(super) fn new(name: &str, file: &str, overrides: &[String]) -> Self {
        let mut source = Self { name: name.to_owned(), text: file.to_owned(), file_length: file.len(), sets: Vec::new() };
        for set in overrides {
            if !source.text.ends_with('\n') {
                source.text.push('\n');
            }
            // An override is one line: a line break could otherwise bring other keys with it.
            let set = set.replace(['\n', '\r'], " ");
            source.sets.push(Set::new(&set, source.text.len()));
            source.text.push_str(&set);
        }
        source
    }

    /// The document with its overrides.
    pub(super) fn document(&self) -> Result<Spanned<DeTable<'_>>, SceneError> {
        let document = DeTable::parse(&self.text[..self.file_length]).map_err(|e| self.syntax(&e))?;
        let span = document.span();
        let mut top = Spanned::new(span.clone(), DeValue::Table(document.into_inner()));
        for set in &self.sets {
            let hint = "write it as key.path=value, for instance solver.tolerance=1e-9";
            let Some(key) = &set.key else {
                return Err(self.at(set.start..set.end, &KeyPath::default(), "an override without `=`", hint));
            };
            let key = DeTable::parse(key).map_err(|e| self.syntax(&e))?.into_inner();
            let value = DeTable::parse(&set.value).map_err(|e| self.syntax(&e))?.into_inner();
            let mut keys = Vec::new();
            flatten(key, &mut keys);
            if let Some((_, value)) = value.into_iter().next() {
                insert(&mut top, &keys, KeyPath::default(), value)
                    .map_err(|f| self.at(set.start..set.end, &f.path, &f.message, &f.hint))?;
            }
        }
        let DeValue::Table(table) = top.into_inner() else { return Ok(Spanned::new(span, DeTable::new())) };
        Ok(Spanned::new(span, table))
    }

    /// The error of text that is not TOML.
    pub(super) fn syntax(&self, error: &toml::de::Error) -> SceneError {
        let hint = "values are numbers, \"strings\", [arrays] and { tables = \"…\" }; see https://toml.io";
        self.at(error.span().unwrap_or(0..0), &KeyPath::default(), &format!("not valid TOML: {}", error.message()), hint)
    }

    /// An error at a span of the text.
    pub(super) fn at(&self, span: Range<usize>, key: &KeyPath, message: &str, hint: &str) -> SceneError {
        let mut place = Place { file: self.name.clone(), key: key.to_string(), ..Place::default() };
        if !self.text.is_empty() {
            let mut at = line_column(&self.text, span.start);
            if let Some(set) = self.sets.iter().rposition(|set| set.start <= span.start) {
                place.file = "--set".to_owned();
                at.line = set + 1;
            }
            place.at = Some(at);
            place.excerpt = excerpt(&self.text, &span, at.line);
        }
        SceneError { place: Box::new(place), message: message.to_owned(), hint: hint.to_owned() }
    }

    /// The error of a check: its place is that of the value, or of what holds it where the value is a default.
    pub(super) fn fault(&self, fault: &Fault) -> SceneError {
        let span = self.document().ok().map_or(0..0, |document| span_of(document.get_ref(), &fault.path));
        self.at(span, &fault.path, &fault.message, &fault.hint)
    }
}

/// Takes apart a table of one value: the keys that lead to it.
fn flatten<'a>(table: DeTable<'a>, keys: &mut Vec<Spanned<DeString<'a>>>) {
    if let Some((key, value)) = table.into_iter().next() {
        keys.push(key);
        if let DeValue::Table(inner) = value.into_inner() {
            flatten(inner, keys);
        }
    }
}

/// Puts a value where `keys` lead, making the tables on the way.
fn insert<'a>(
    node: &mut Spanned<DeValue<'a>>,
    keys: &[Spanned<DeString<'a>>],
    mut path: KeyPath,
    value: Spanned<DeValue<'a>>,
) -> Result<(), Fault> {
    let Some((key, rest)) = keys.split_first() else {
        *node = value;
        return Ok(());
    };
    let name: &str = key.get_ref();
    match node.get_mut() {
        DeValue::Array(array) => {
            let index = name.parse::<usize>().ok().filter(|&i| i < array.len()).ok_or_else(|| {
                let hint = format!("`{path}` is an array of {}: an index from 0, as in {path}.0", array.len());
                Fault::new(path.clone(), format!("no element `{name}`"), hint)
            })?;
            path.0.push(Segment::from(index));
            array.get_mut(index).map_or(Ok(()), |element| insert(element, rest, path, value))
        }
        DeValue::Table(table) => {
            path.0.push(Segment::from(name));
            let empty = Spanned::new(key.span(), DeValue::Table(DeTable::new()));
            insert(table.entry(key.clone()).or_insert(empty), rest, path, value)
        }
        // A name in place of a table, such as rho = "auto", gives way to the table that the override speaks of.
        other => {
            *other = DeValue::Table(DeTable::new());
            insert(node, keys, path, value)
        }
    }
}

/// The span of the value at `path`, or of the last one on the way that the text has.
pub(super) fn span_of(document: &DeTable<'_>, path: &KeyPath) -> Range<usize> {
    let Some((Segment::Key(first), rest)) = path.0.split_first() else { return 0..0 };
    let Some(mut node) = document.get(first.as_str()) else { return 0..0 };
    for segment in rest {
        let next = match (segment, node.get_ref()) {
            (Segment::Key(key), DeValue::Table(table)) => table.get(key.as_str()),
            (Segment::Index(index), DeValue::Array(array)) => array.get(*index),
            _ => None,
        };
        let Some(next) = next else { break };
        node = next;
    }
    node.span()
}

/// The value or key whose span is `span`, or the smallest around it.
pub(super) fn path_of(document: &DeTable<'_>, span: &Range<usize>) -> KeyPath {
    let mut best = (usize::MAX, KeyPath::default());
    visit_table(document, &KeyPath::default(), &mut |path, at, _| {
        // The deeper of two with the same span: a table made by a dotted key has the span of that key.
        if at.start <= span.start && span.end <= at.end && at.len() <= best.0 {
            best = (at.len(), path.clone());
        }
    });
    best.1
}

/// What [`visit_table`] calls with each key and each value: the way there, its span, and the value where it is one.
pub(super) type Visitor<'v> = dyn FnMut(&KeyPath, Range<usize>, Option<&DeValue<'_>>) + 'v;

/// Walks over all keys and values of a document.
pub(super) fn visit_table(table: &DeTable<'_>, path: &KeyPath, visitor: &mut Visitor<'_>) {
    for (key, value) in table {
        let path = path.then(&**key.get_ref());
        visitor(&path, key.span(), None);
        visit_value(value, &path, visitor);
    }
}

fn visit_value(value: &Spanned<DeValue<'_>>, path: &KeyPath, visitor: &mut Visitor<'_>) {
    visitor(path, value.span(), Some(value.get_ref()));
    match value.get_ref() {
        DeValue::Table(table) => visit_table(table, path, visitor),
        DeValue::Array(array) => array.iter().enumerate().for_each(|(i, value)| visit_value(value, &path.then(i), visitor)),
        _ => {}
    }
}
