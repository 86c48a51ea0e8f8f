//! Words of a text file, with their places.

use std::fmt::Display;

use super::{Position, ReadError};

const END: &str = "the end of the file";
/// A bound of at least this size is infinite, by the convention of MPS.
const NO_BOUND: f64 = 1e20;
/// The remedy for sizes that do not agree.
pub(super) const SIZES: &str = "sizes must agree with each other";

#[derive(Debug, Clone, Copy)]
pub(super) struct Token<'a> {
    pub(super) text: &'a str,
    pub(super) at: Position,
}

impl Token<'_> {
    pub(super) fn unexpected(&self, expected: impl Display, remedy: &'static str) -> ReadError {
        ReadError::unexpected(self.at, expected, quoted(self.text), remedy)
    }

    /// The word as a finite number.
    pub(super) fn number(&self, what: impl Display) -> Result<f64, ReadError> {
        let value = self.text.parse().ok().filter(|value: &f64| value.is_finite());
        value.ok_or_else(|| self.unexpected(what, "every value is a finite decimal number"))
    }

    /// The word as a bound: a number, or infinity if it is written so or has a size from 1e20 on, the convention of
    /// files with programs.
    pub(super) fn bound(&self, what: impl Display) -> Result<f64, ReadError> {
        match self.text.to_ascii_lowercase().trim_start_matches('+') {
            "inf" | "infinity" => Ok(f64::INFINITY),
            "-inf" | "-infinity" => Ok(f64::NEG_INFINITY),
            _ => match self.number(what)? {
                value if value.abs() >= NO_BOUND => Ok(value.signum() * f64::INFINITY),
                value => Ok(value),
            },
        }
    }

    /// The word as a count or an index that satisfies a condition.
    pub(super) fn count_if(
        &self,
        what: impl Display,
        remedy: &'static str,
        is_allowed: impl FnOnce(usize) -> bool,
    ) -> Result<usize, ReadError> {
        match self.text.parse() {
            Ok(count) if is_allowed(count) => Ok(count),
            Ok(_) => Err(self.unexpected(what, remedy)),
            Err(_) => {
                Err(self.unexpected(what, "counts and indices are whole numbers without sign"))
            }
        }
    }
}

/// The words of a text, separated by white space; `#`, or another sign, begins a comment up to the end of the line.
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

    /// The next word, which the format requires.
    pub(super) fn expect(&mut self, what: impl Display) -> Result<Token<'a>, ReadError> {
        self.next().ok_or_else(|| ReadError::unexpected(self.next, what, END, "complete the file"))
    }

    pub(super) fn count(&mut self, what: impl Display) -> Result<usize, ReadError> {
        self.count_if(what, "", |_| true)
    }

    /// The next word as a count or an index that satisfies a condition.
    pub(super) fn count_if(
        &mut self,
        what: impl Display,
        remedy: &'static str,
        is_allowed: impl FnOnce(usize) -> bool,
    ) -> Result<usize, ReadError> {
        self.expect(&what)?.count_if(what, remedy, is_allowed)
    }

    /// A count that the format fixes.
    pub(super) fn fixed(&mut self, what: &str, value: usize) -> Result<(), ReadError> {
        self.count_if(format_args!("{what} = {value}"), SIZES, |count| count == value).map(drop)
    }

    /// An index below a bound.
    pub(super) fn index(&mut self, bound: usize, what: &str) -> Result<usize, ReadError> {
        let expected = format_args!("{what}, below {bound}");
        self.count_if(expected, "indices begin at 0", |index| index < bound)
    }

    /// One of these words, by its number.
    pub(super) fn one_of(&mut self, words: &[&str], what: &str) -> Result<usize, ReadError> {
        let token = self.expect(what)?;
        let found = words.iter().position(|word| *word == token.text);
        found.ok_or_else(|| token.unexpected(what, "nothing else exists"))
    }

    pub(super) fn words(&mut self, words: &str) -> Result<(), ReadError> {
        words.split(' ').try_for_each(|word| {
            let token = self.expect(format_args!("`{word}`"))?;
            if token.text == word {
                return Ok(());
            }
            Err(token.unexpected(format_args!("`{word}`"), "the words between numbers are fixed"))
        })
    }

    pub(super) fn number(&mut self, what: impl Display) -> Result<f64, ReadError> {
        self.expect(&what)?.number(what)
    }

    pub(super) fn numbers(
        &mut self,
        count: usize,
        what: &'static str,
    ) -> Result<Vec<f64>, ReadError> {
        self.room_for(Some(count), what)?;
        (1..=count)
            .map(|k| self.number(format_args!("number {k} in {what}, which has {count}")))
            .collect()
    }

    /// Refuses numbers after those of the format. Text for readers may follow, preceded by up to `known` numbers of a
    /// known answer.
    pub(super) fn end_of_numbers(&mut self, known: usize) -> Result<(), ReadError> {
        let number = |token: &Token<'_>| token.text.parse::<f64>().is_ok();
        for _ in 0..known {
            if !self.next().is_some_and(|token| number(&token)) {
                return Ok(());
            }
        }
        match self.next().filter(number) {
            Some(token) => Err(token.unexpected(END, "correct the sizes, or remove the rest")),
            None => Ok(()),
        }
    }

    /// Refuses whatever is left.
    pub(super) fn end(&mut self, remedy: &'static str) -> Result<(), ReadError> {
        self.next().map_or(Ok(()), |token| Err(token.unexpected(END, remedy)))
    }

    /// The place from which the next word is searched.
    pub(super) fn position(&self) -> Position {
        self.next
    }

    /// Refuses a header that announces more words than are left; `None` is a product that overflows.
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
