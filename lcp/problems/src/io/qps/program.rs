//! A program while its file is read.

use std::collections::{BTreeMap, BTreeSet};

use crate::io::ReadError;
use crate::io::tokens::Token;
use crate::sparse;
use lcp::{Error, Qp};

/// The kind of a line of data, by the header before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Section {
    Sense,
    Rows,
    Columns,
    Right,
    Ranges,
    Bounds,
    /// One triangle of `P`.
    Triangle,
    /// All entries of `P`.
    Quadratic,
}

/// The meaning of a name of the section ROWS.
#[derive(Debug, Clone, Copy)]
enum Row {
    Objective,
    /// A further row without bounds.
    Unused,
    Constraint(usize),
}

/// The comparison of a row with its right-hand side.
#[derive(Debug, Clone, Copy)]
enum Comparison {
    Equal,
    AtLeast,
    AtMost,
}

/// A row that is compared with something.
#[derive(Debug, Clone, Copy)]
struct Constraint {
    comparison: Comparison,
    right: f64,
    range: Option<f64>,
}

/// The bounds of a variable.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    lower: f64,
    upper: f64,
    /// Whether a line gives the lower bound.
    has_lower: bool,
}

/// The data of the lines so far.
#[derive(Debug, Default)]
pub(super) struct Program<'a> {
    rows: BTreeMap<&'a str, Row>,
    objective: Option<&'a str>,
    constraints: Vec<Constraint>,
    columns: BTreeMap<&'a str, usize>,
    bounds: Vec<Bounds>,
    p: Vec<(usize, usize, f64)>,
    /// Places of one triangle.
    known: BTreeSet<[usize; 2]>,
    q: Vec<f64>,
    a: Vec<(usize, usize, f64)>,
    constant: f64,
    /// The names of right-hand sides, ranges and bounds.
    sets: BTreeMap<Section, &'a str>,
}

const INTEGERS: &str = "there are no integer variables in a convex program";

impl<'a> Program<'a> {
    /// Reads a line of data, which has at least one word.
    pub(super) fn line(&mut self, section: Section, words: &[Token<'a>]) -> Result<(), ReadError> {
        match section {
            Section::Sense => match words[0].text {
                "MIN" | "MINIMIZE" => Ok(()),
                _ => Err(words[0]
                    .unexpected("MIN", "write a maximum as the minimum of the negative objective")),
            },
            Section::Rows => self.row(words),
            Section::Columns => self.column(words),
            Section::Right | Section::Ranges => self.right(section, words),
            Section::Bounds => self.bound(words),
            Section::Triangle | Section::Quadratic => self.quadratic(section, words),
        }
    }

    /// `KIND name`
    fn row(&mut self, words: &[Token<'a>]) -> Result<(), ReadError> {
        let [kind, name] = words else {
            return Err(words[0].unexpected("a kind of rows and one name", "every row has a line"));
        };
        let comparison = match kind.text {
            "N" => None,
            "E" => Some(Comparison::Equal),
            "G" => Some(Comparison::AtLeast),
            "L" => Some(Comparison::AtMost),
            _ => return Err(kind.unexpected("N, E, G or L", "there are no other kinds of rows")),
        };
        let row = match comparison {
            Some(comparison) => {
                self.constraints.push(Constraint { comparison, right: 0.0, range: None });
                Row::Constraint(self.constraints.len() - 1)
            }
            None if self.objective.is_none() => {
                self.objective = Some(name.text);
                Row::Objective
            }
            None => Row::Unused,
        };
        match self.rows.insert(name.text, row) {
            Some(_) => Err(name.unexpected("a new name", "rows have different names")),
            None => Ok(()),
        }
    }

    /// `column row value [row value]`
    fn column(&mut self, words: &[Token<'a>]) -> Result<(), ReadError> {
        if let Some(marker) = words[1..].iter().find(|word| word.text == "'MARKER'") {
            return Err(marker.unexpected("a row with its number", INTEGERS));
        }
        let next = self.q.len();
        let column = *self.columns.entry(words[0].text).or_insert(next);
        if column == next {
            self.q.push(0.0);
            self.bounds.push(Bounds { lower: 0.0, upper: f64::INFINITY, has_lower: false });
        }
        for (_, row, value) in pairs(words, 1, |row| self.row_of(row))? {
            match row {
                Row::Objective => self.q[column] += value,
                Row::Unused => {}
                Row::Constraint(row) => self.a.push((row, column, value)),
            }
        }
        Ok(())
    }

    /// `[set] row value [row value]`
    fn right(&mut self, section: Section, words: &[Token<'a>]) -> Result<(), ReadError> {
        let has_set = words.len() % 2 == 1;
        if has_set {
            self.one_set(section, words[0])?;
        }
        let first = usize::from(has_set);
        for (name, row, value) in pairs(words, first, |row| self.row_of(row))? {
            match (section, row) {
                (Section::Ranges, Row::Constraint(k)) => self.constraints[k].range = Some(value),
                (Section::Ranges, _) => {
                    return Err(name.unexpected("a constraint", "other rows have no range"));
                }
                (_, Row::Constraint(k)) => self.constraints[k].right = value,
                (_, Row::Objective) => self.constant = -value,
                (_, Row::Unused) => {}
            }
        }
        Ok(())
    }

    /// `KIND [set] column [value]`; some kinds need no value.
    fn bound(&mut self, words: &[Token<'a>]) -> Result<(), ReadError> {
        let (kind, rest) = (words[0], &words[1..]);
        let needs_value = match kind.text {
            "UP" | "LO" | "FX" => true,
            "FR" | "MI" | "PL" | "BV" => false,
            _ => return Err(kind.unexpected("UP, LO, FX, FR, MI, PL or BV", INTEGERS)),
        };
        let is_column = |word: &Token<'_>| self.columns.contains_key(word.text);
        let (set, column, value) = match *rest {
            [set, column, value] => (Some(set), column, Some(value)),
            [set, column] if !needs_value && is_column(&column) => (Some(set), column, None),
            [column, value] => (None, column, Some(value)),
            [column] if !needs_value => (None, column, None),
            _ => {
                let what = if needs_value { "a variable and its bound" } else { "a variable" };
                let expected = format_args!("`{}`, perhaps the name of the set, {what}", kind.text);
                return Err(kind.unexpected(expected, "every bound has a line"));
            }
        };
        if let Some(set) = set {
            self.one_set(Section::Bounds, set)?;
        }
        let value = value.map_or(Ok(0.0), |value| value.bound("a bound"))?;
        let column = self.column_of(&column)?;
        let Bounds { lower, upper, has_lower } = &mut self.bounds[column];
        match kind.text {
            "UP" => {
                *upper = value;
                // The lower bound zero is kept only if it is written.
                if value < 0.0 && !*has_lower {
                    *lower = f64::NEG_INFINITY;
                }
            }
            "LO" => (*lower, *has_lower) = (value, true),
            "FX" => (*lower, *upper, *has_lower) = (value, value, true),
            "MI" => *lower = f64::NEG_INFINITY,
            "PL" => *upper = f64::INFINITY,
            "BV" => (*lower, *upper, *has_lower) = (0.0, 1.0, true),
            _ => (*lower, *upper) = (f64::NEG_INFINITY, f64::INFINITY),
        }
        Ok(())
    }

    /// `column column value [column value]`
    fn quadratic(&mut self, section: Section, words: &[Token<'a>]) -> Result<(), ReadError> {
        let i = self.column_of(&words[0])?;
        for (name, j, value) in pairs(words, 1, |column| self.column_of(column))? {
            self.p.push((i, j, value));
            if section == Section::Quadratic {
                continue;
            }
            if !self.known.insert([i.min(j), i.max(j)]) {
                let remedy = "one triangle of the matrix stands here; a QMATRIX has all entries";
                return Err(name.unexpected("a pair of variables that is new", remedy));
            }
            if i != j {
                self.p.push((j, i, value));
            }
        }
        Ok(())
    }

    /// Refuses a quadratic form that does not belong to the objective.
    pub(super) fn check_objective(&self, row: Token<'a>) -> Result<(), ReadError> {
        if self.objective.is_none_or(|name| name == row.text) {
            return Ok(());
        }
        Err(row.unexpected("the name of the objective", "constraints are linear"))
    }

    fn one_set(&mut self, section: Section, name: Token<'a>) -> Result<(), ReadError> {
        let known = *self.sets.entry(section).or_insert(name.text);
        if known == name.text {
            return Ok(());
        }
        Err(name.unexpected(format!("`{known}`"), "take out all sets but one"))
    }

    fn row_of(&self, name: &Token<'_>) -> Result<Row, ReadError> {
        let row = self.rows.get(name.text).copied();
        row.ok_or_else(|| name.unexpected("the name of a row", "names stand in ROWS first"))
    }

    fn column_of(&self, name: &Token<'_>) -> Result<usize, ReadError> {
        let column = self.columns.get(name.text).copied();
        column.ok_or_else(|| name.unexpected("the name of a variable", "names go in COLUMNS first"))
    }

    /// The program of all lines.
    pub(super) fn finish(self) -> Result<Qp, Error> {
        let (n, m) = (self.q.len(), self.constraints.len());
        let p = sparse(n, n, self.p);
        let a = sparse(m, n, self.a);
        let (l, u): (Vec<f64>, Vec<f64>) = self.constraints.iter().map(Constraint::limits).unzip();
        let (lower, upper): (Vec<f64>, Vec<f64>) =
            self.bounds.iter().map(|it| (it.lower, it.upper)).unzip();
        Qp::new(p, self.q, a, l, u)?.with_bounds(lower, upper)?.with_constant(self.constant)
    }
}

impl Constraint {
    /// The bounds of the row.
    fn limits(&self) -> (f64, f64) {
        let Self { comparison, right, range } = *self;
        let range_size = range.map_or(f64::INFINITY, f64::abs);
        match comparison {
            Comparison::Equal => {
                let other = right + range.unwrap_or(0.0);
                (right.min(other), right.max(other))
            }
            Comparison::AtLeast => (right, right + range_size),
            Comparison::AtMost => (right - range_size, right),
        }
    }
}

/// Names, their meanings, and the number after each of them, from word number `first` on.
fn pairs<'a, T>(
    words: &[Token<'a>],
    first: usize,
    meant: impl Fn(&Token<'a>) -> Result<T, ReadError>,
) -> Result<Vec<(Token<'a>, T, f64)>, ReadError> {
    let pair =
        |words: &[Token<'a>]| match *words {
            [name, value] => Ok((name, meant(&name)?, value.number("a number")?)),
            _ => Err(words[0]
                .unexpected("a name with its number", "every name is followed by its number")),
        };
    // A line without pairs lacks one name.
    words[first.min(words.len() - 1)..].chunks(2).map(pair).collect()
}
