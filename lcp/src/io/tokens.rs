//! Words of a text file, with their places.

use super::{Position, ReadError};

const END: &str = "the end of the file";

/// A word and its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Token<'a> {
    pub(super) text: &'a str,
    pub(super) at: Position,
}

impl Token<'_> {
    pub(super) fn unexpected(&self, expected: String, remedy: &'static str) -> ReadError {
        ReadError::Unexpected { at: self.at, expected, found: quoted(self.text), remedy }
    }

    /// The word as a finite number.
    pub(super) fn number(&self, expected: impl FnOnce() -> String) -> Result<f64, ReadError> {
        match self.text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.unexpected(expected(), "every value is a finite decimal number")),
        }
    }

    /// The word as a count or an index.
    pub(super) fn count(&self, what: &str) -> Result<usize, ReadError> {
        let remedy = "counts and indices are whole numbers without sign";
        self.text.parse().map_err(|_| self.unexpected(what.to_owned(), remedy))
    }
}

/// The words of a text, separated by white space; `#`, or another sign, begins a comment up to the end of the
/// line.
///
/// The number of words is counted in advance, so that sizes in a header are compared with it before
/// anything is allocated.
#[derive(Debug, Clone)]
pub(super) struct Tokens<'a> {
    rest: &'a str,
    comment: char,
    next: Position,
    left: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self::with_comments(text, '#')
    }

    pub(super) fn with_comments(text: &'a str, comment: char) -> Self {
        let words = |line: &'a str| line.split(comment).next().unwrap_or_default();
        let left = text.lines().map(|line| words(line).split_whitespace().count()).sum();
        Self { rest: text, comment, next: Position { line: 1, column: 1 }, left }
    }

    /// The next word, if there is one.
    pub(super) fn next(&mut self) -> Option<Token<'a>> {
        loop {
            let begin = self.rest.find(|c: char| c == '\n' || !c.is_whitespace())?;
            self.skip(begin);
            match self.rest.chars().next()? {
                '\n' => {
                    self.rest = &self.rest[1..];
                    self.next = Position { line: self.next.line + 1, column: 1 };
                }
                c if c == self.comment => {
                    self.skip(self.rest.find('\n').unwrap_or(self.rest.len()));
                }
                _ => {
                    let ends = |c: char| c == self.comment || c.is_whitespace();
                    let end = self.rest.find(ends).unwrap_or(self.rest.len());
                    let token = Token { text: &self.rest[..end], at: self.next };
                    self.skip(end);
                    self.left = self.left.saturating_sub(1);
                    return Some(token);
                }
            }
        }
    }

    /// The next word, which the format calls for.
    pub(super) fn expect(
        &mut self,
        expected: impl FnOnce() -> String,
    ) -> Result<Token<'a>, ReadError> {
        self.next().ok_or_else(|| ReadError::Unexpected {
            at: self.next,
            expected: expected(),
            found: END.to_owned(),
            remedy: "complete the file",
        })
    }

    /// The next word as a count or an index.
    pub(super) fn count(&mut self, what: &'static str) -> Result<usize, ReadError> {
        self.expect(|| what.to_owned())?.count(what)
    }

    /// A count that the format fixes.
    pub(super) fn fixed(&mut self, what: &str, value: usize) -> Result<(), ReadError> {
        let token = self.expect(|| format!("{what} = {value}"))?;
        if token.count(what)? == value {
            return Ok(());
        }
        Err(token.unexpected(format!("{what} = {value}"), "sizes must agree with each other"))
    }

    /// An index below a bound.
    pub(super) fn index(&mut self, bound: usize, what: &'static str) -> Result<usize, ReadError> {
        let token = self.expect(|| what.to_owned())?;
        match token.count(what)? {
            index if index < bound => Ok(index),
            _ => Err(token.unexpected(format!("{what}, below {bound}"), "indices begin at 0")),
        }
    }

    /// That word.
    pub(super) fn word(&mut self, word: &'static str) -> Result<(), ReadError> {
        let token = self.expect(|| format!("`{word}`"))?;
        if token.text == word {
            return Ok(());
        }
        Err(token.unexpected(format!("`{word}`"), "the words between the numbers are fixed"))
    }

    /// One number.
    pub(super) fn number(&mut self, what: &'static str) -> Result<f64, ReadError> {
        self.expect(|| what.to_owned())?.number(|| what.to_owned())
    }

    /// That many numbers.
    pub(super) fn numbers(
        &mut self,
        count: usize,
        what: &'static str,
    ) -> Result<Vec<f64>, ReadError> {
        self.room_for(Some(count), what)?;
        let mut values = Vec::with_capacity(count);
        for index in 1..=count {
            let expected = || format!("number {index} of {count} of {what}");
            values.push(self.expect(expected)?.number(expected)?);
        }
        Ok(values)
    }

    /// Refuses numbers where the format has none left. Words may follow, which are for people, and before them
    /// up to `known` numbers of an answer that is known.
    pub(super) fn end_of_numbers(&mut self, known: usize) -> Result<(), ReadError> {
        for _ in 0..known {
            match self.next() {
                Some(token) if token.text.parse::<f64>().is_ok() => {}
                _ => return Ok(()),
            }
        }
        match self.next().filter(|token| token.text.parse::<f64>().is_ok()) {
            Some(token) => {
                Err(token.unexpected(END.to_owned(), "correct the sizes, or take it out"))
            }
            None => Ok(()),
        }
    }

    /// Passes over 0 or 1, if that comes next.
    pub(super) fn flag(&mut self) {
        let mut ahead = self.clone();
        if ahead.next().is_some_and(|token| matches!(token.text, "0" | "1")) {
            *self = ahead;
        }
    }

    /// Refuses whatever is left.
    pub(super) fn end(&mut self, remedy: &'static str) -> Result<(), ReadError> {
        match self.next() {
            Some(token) => Err(token.unexpected(END.to_owned(), remedy)),
            None => Ok(()),
        }
    }

    /// Where the next word is looked for.
    pub(super) fn position(&self) -> Position {
        self.next
    }

    /// Refuses a header that announces more words than are left; `None` is a product that
    /// overflows.
    pub(super) fn room_for(
        &self,
        needed: Option<usize>,
        what: &'static str,
    ) -> Result<(), ReadError> {
        let needed = needed.unwrap_or(usize::MAX);
        if needed <= self.left {
            return Ok(());
        }
        Err(ReadError::TooShort { at: self.next, what, needed, left: self.left })
    }

    fn skip(&mut self, bytes: usize) {
        self.rest = &self.rest[bytes..];
        self.next.column += bytes;
    }
}

/// A word as it stands in a message; a long one is cut.
fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("`{}...`", &text[..end]),
        None => format!("`{text}`"),
    }
}
