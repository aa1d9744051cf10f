//! A text file as tokens, each with its place.

use crate::files::{FileError, Place};

/// The tokens of a file from some point on.
pub(super) struct Tokens<'a> {
    bytes: &'a [u8],
    /// Where the next token is looked for.
    position: usize,
    line: usize,
    line_start: usize,
    /// The last token: its place and number.
    last: (usize, usize, usize),
}

impl<'a> Tokens<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, position: 0, line: 1, line_start: 0, last: (1, 1, 0) }
    }

    /// An error at the last token.
    pub(super) fn error(&self, what: impl Into<String>) -> FileError {
        let (line, column, token) = self.last;
        FileError::new(Place::Token { line, column, token }, what)
    }

    /// The next token, which is `name`.
    pub(super) fn next(&mut self, name: &str) -> Result<&'a str, FileError> {
        self.skip_space();
        self.last = (self.line, self.position - self.line_start + 1, self.last.2 + 1);
        let rest = &self.bytes[self.position..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if length == 0 {
            return Err(self.error(format!("the file ends before {name}")));
        }
        self.position += length;
        std::str::from_utf8(&rest[..length]).map_err(|_| self.error(format!("{name} is not text")))
    }

    fn skip_space(&mut self) {
        while let Some(byte) = self.bytes.get(self.position).filter(|b| b.is_ascii_whitespace()) {
            self.position += 1;
            if *byte == b'\n' {
                self.line += 1;
                self.line_start = self.position;
            }
        }
    }

    /// The next line that is not blank, from its first token on.
    pub(super) fn line(&mut self, name: &str) -> Result<&'a str, FileError> {
        self.skip_space();
        let start = self.position;
        self.next(name)?;
        let rest = &self.bytes[start..];
        let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        self.position = start + length;
        std::str::from_utf8(&rest[..length]).map(str::trim_end).map_err(|_| self.error(format!("{name} is not text")))
    }

    /// The next token, which must be `word`.
    pub(super) fn word(&mut self, word: &str) -> Result<(), FileError> {
        match self.next(&format!("`{word}`"))? {
            found if found == word => Ok(()),
            found => Err(self.error(format!("`{}` where `{word}` is right", shortened(found)))),
        }
    }

    /// The next token as a number ≥ 0.
    pub(super) fn integer(&mut self, name: &str) -> Result<usize, FileError> {
        match self.signed(name)? {
            value if value >= 0 => Ok(value as usize),
            value => Err(self.error(format!("{name} is {value}; it is not negative"))),
        }
    }

    /// The next token as an integer.
    pub(super) fn signed(&mut self, name: &str) -> Result<i64, FileError> {
        let token = self.next(name)?;
        if let Ok(value) = token.parse::<i64>() {
            return Ok(value);
        }
        // CSparse prints integers as reals: a million is 1e+06.
        match token.parse::<f64>() {
            Ok(value) if value.fract() == 0.0 && value.abs() < 9e15 => Ok(value as i64),
            _ => Err(self.error(format!("{name} is `{}`; an integer is right", shortened(token)))),
        }
    }

    /// The next token as a number of things each of which takes at least a token of what is left of the file.
    pub(super) fn count(&mut self, name: &str) -> Result<usize, FileError> {
        let count = self.integer(name)?;
        self.fits(count, name)?;
        Ok(count)
    }

    /// That `count` tokens can be left. It is no more than a bound, but it keeps sizes from being believed.
    pub(super) fn fits(&self, count: usize, name: &str) -> Result<(), FileError> {
        let room = (self.bytes.len() - self.position).div_ceil(2);
        if count > room {
            return Err(self.error(format!("{name}: {count} tokens are needed, and the file has room for {room} more")));
        }
        Ok(())
    }

    /// The next token as a finite number.
    pub(super) fn real(&mut self, name: &str) -> Result<f64, FileError> {
        let token = self.next(name)?;
        match token.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.error(format!("{name} has `{}`; a finite number is right", shortened(token)))),
        }
    }

    /// The next `count` tokens as finite numbers.
    pub(super) fn reals(&mut self, count: usize, name: &str) -> Result<Vec<f64>, FileError> {
        self.fits(count, name)?;
        (0..count).map(|_| self.real(name)).collect()
    }

    /// The next `count` tokens as numbers ≥ 0.
    pub(super) fn integers(&mut self, count: usize, name: &str) -> Result<Vec<usize>, FileError> {
        self.fits(count, name)?;
        (0..count).map(|_| self.integer(name)).collect()
    }

    /// Whether the last token is the end of the file, with nothing behind it that says so.
    pub(super) fn at_end(&self) -> bool {
        self.position == self.bytes.len()
    }

    /// How many tokens are left; reads on to the end to find out.
    pub(super) fn remaining(&self) -> usize {
        self.bytes[self.position..].split(u8::is_ascii_whitespace).filter(|token| !token.is_empty()).count()
    }

    /// That nothing is left.
    pub(super) fn end(&mut self) -> Result<(), FileError> {
        match self.remaining() {
            0 => Ok(()),
            left => {
                self.next("the end")?;
                Err(self.error(format!("{left} tokens follow the end of the problem; at most one is ignored")))
            }
        }
    }
}

/// A token as an error shows it.
fn shortened(token: &str) -> String {
    let mut text: String = token.chars().take(40).collect();
    if text.len() < token.len() {
        text.push('…');
    }
    text
}
