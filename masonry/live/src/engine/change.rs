//! Values of a number at which the verdict changes. The search first tries some values of a range, and then halves the
//! interval between two neighbouring values with different verdicts, until no multiple of the last digit lies between
//! them.
//!
//! The verdict at values that were not tried remains unknown: a wall that stands at two values may fall between them.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;

use super::controls::Edit;
use super::fault::Fault;
use super::solved::{Seen, Show, Solved};
use super::watch::Watch;
use super::work::Found;

/// The number of parts into which the range is divided; the scene is first solved at the ends of all parts. Chosen: eight
/// parts are few enough if each solve takes seconds.
const PARTS: i64 = 8;
/// The factor by which the upper end of the range grows if the verdict does not change in the range. Chosen: applied
/// twice, it gives 16 times the end.
const WIDER: i64 = 4;
/// The largest number of times that the range grows by [`WIDER`].
const WIDENINGS: usize = 2;
/// Values are multiples of a power of ten: the largest one below this part of the range. Chosen: three digits, more
/// than the known digits of μ.
const LAST_DIGIT: f64 = 1e-3;
/// An end of the range counts as a multiple of the last digit if it differs from one by less than this part of the last
/// digit. Chosen: far above rounding errors, and far below the digits in texts.
const SAME: f64 = 1e-6;

/// The number whose values are tried, and its range.
#[derive(Debug, Deserialize)]
pub(super) struct Tried {
    /// The name of the number, as the page shows it.
    label: String,
    /// The places in the text at which the number is written.
    edits: Vec<Edit>,
    value: f64,
    range: [f64; 2],
    /// Whether the number is a count, so that its values are whole numbers.
    whole: bool,
}

/// The result of a solve with one value of the number.
#[derive(Debug, Clone, PartialEq)]
enum Answer {
    Stands,
    Falls,
    Undecided,
    /// The reason for which there is no verdict: the text does not describe a scene, or the solve failed.
    Mistake(String),
}

impl Answer {
    fn of(solved: Result<&Solved, &Fault>) -> Self {
        match solved.map(Solved::verdict) {
            Ok("stands") => Self::Stands,
            Ok("falls") => Self::Falls,
            Ok(_) => Self::Undecided,
            Err(fault) => Self::Mistake(fault.message.clone()),
        }
    }

    /// Whether two answers are of the same kind: both stand, both fall, both are undecided, or both have a mistake.
    fn is_like(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Stands => "stands",
            Self::Falls => "falls",
            Self::Undecided => "is undecided",
            Self::Mistake(_) => "has a mistake",
        })
    }
}

/// The values that can be tried: multiples of the last digit from `first` to `last`.
#[derive(Debug, Clone, Copy)]
struct Digits {
    /// The exponent of the last digit, a power of ten.
    power: i32,
    first: i64,
    last: i64,
}

impl Digits {
    /// # Errors
    /// The range has no interior, or its numbers have no last digit.
    fn of(tried: &Tried) -> Result<Self, Fault> {
        let [low, high] = tried.range;
        let last_digit = (LAST_DIGIT * (high - low)).log10().floor();
        if !(high > low && last_digit.abs() < 300.0) {
            return Err(Fault::new(&format!(
                "there are no values between {low} and {high} to try"
            )));
        }
        let power =
            if tried.whole { 0 } else { multiple(last_digit).try_into().unwrap_or_default() };
        let ends = [low, high].map(|it| it / 10_f64.powi(power));
        if ends.iter().any(|it| it.abs() >= 2_f64.powi(53)) {
            return Err(Fault::new(&format!(
                "{low} to {high} is too short a range for its numbers"
            )));
        }
        let (first, last) = ((ends[0] - SAME).ceil(), (ends[1] + SAME).floor());
        let (first, last) = (multiple(first), multiple(last));
        Ok(Self { power, first, last })
    }

    fn value(self, multiple: i64) -> f64 {
        // The quotient of two whole numbers is the nearest number to the decimal number; a product need not be.
        let digit = 10_f64.powi(self.power.abs());
        if self.power < 0 { multiple as f64 / digit } else { multiple as f64 * digit }
    }

    /// Returns the multiples that are tried first, those nearest to the value of the text first: the ends of all parts
    /// of the range, and the value of the text.
    fn scan(self, value: f64) -> Vec<i64> {
        let length = self.last - self.first;
        let mut list: Vec<i64> =
            (0..=PARTS).map(|part| self.first + length * part / PARTS).collect();
        let own = multiple((value / self.value(1)).round());
        list.extend((self.first..=self.last).contains(&own).then_some(own));
        list.sort_by_key(|it| it.abs_diff(own));
        list.dedup();
        list
    }
}

/// A function that solves the scene of a text.
pub(super) type Solve<'a> = dyn Fn(&str, &mut Watch<'_>) -> Result<Solved, Fault> + 'a;

/// Tries values of a number, and finds neighbouring values between which the verdict changes.
///
/// # Errors
/// The range has no values to try, or an edit has places that are outside the text.
pub(super) fn change(
    text: &str,
    tried: &Tried,
    solve: &Solve<'_>,
    watch: &mut Watch<'_>,
) -> Result<Found, Fault> {
    let digits = Digits::of(tried)?;
    let mut search = Search { text, tried, digits, answers: BTreeMap::new() };
    let is_stopped = !search.run(solve, watch)?;
    let mut pictures = Vec::new();
    if let Some([a, b]) = search.changes().first().copied().filter(|_| !is_stopped) {
        for multiple in [a, b] {
            let name =
                format!("{} at {}", capital(&search.answers[&multiple]), digits.value(multiple));
            let solved = solve(&search.text_with(multiple)?, watch);
            pictures.push((
                name,
                solved.ok().and_then(|it| it.picture(Seen { show: Show::Answer, step: None })),
            ));
        }
    }
    Ok(Found::new(&search.sentence(is_stopped), pictures, search.table()))
}

struct Search<'a> {
    text: &'a str,
    tried: &'a Tried,
    digits: Digits,
    answers: BTreeMap<i64, Answer>,
}

impl Search<'_> {
    /// Tries all values of the search; `false` if the search was stopped.
    fn run(&mut self, solve: &Solve<'_>, watch: &mut Watch<'_>) -> Result<bool, Fault> {
        for multiple in self.digits.scan(self.tried.value) {
            if !self.solve(multiple, solve, watch)? {
                return Ok(false);
            }
        }
        // The range of a count does not grow, since a larger count would be another structure.
        let widenings = if self.tried.whole { 0 } else { WIDENINGS };
        for _ in 0..widenings {
            if !self.changes().is_empty() || self.digits.last <= 0 {
                break;
            }
            let wider = self.digits.last.saturating_mul(WIDER);
            if !self.solve(wider, solve, watch)? {
                return Ok(false);
            }
            if matches!(self.answers[&wider], Answer::Mistake(_)) {
                self.answers.remove(&wider);
                break;
            }
            self.digits.last = wider;
        }
        while let Some([a, b]) = self.changes().into_iter().find(|[a, b]| b - a > 1) {
            if !self.solve(a + (b - a) / 2, solve, watch)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn solve(
        &mut self,
        multiple: i64,
        solve: &Solve<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<bool, Fault> {
        let news = format!("{} values tried{}", self.answers.len(), self.told());
        let mut is_stopped = watch(&news).is_break();
        let mut inner = |_: &dyn fmt::Display| {
            let flow = watch(&news);
            is_stopped |= flow.is_break();
            flow
        };
        let solved = solve(&self.text_with(multiple)?, &mut inner);
        if !is_stopped {
            self.answers.insert(multiple, Answer::of(solved.as_ref()));
        }
        Ok(!is_stopped)
    }

    /// Returns neighbouring values whose verdicts differ, beginning with those nearest to the value of the text.
    fn changes(&self) -> Vec<[i64; 2]> {
        let own = self.tried.value / self.digits.value(1);
        let pairs = self.answers.iter().zip(self.answers.iter().skip(1));
        let mut list: Vec<[i64; 2]> = pairs
            .filter(|((_, a), (_, b))| !a.is_like(b))
            .map(|((a, _), (b, _))| [*a, *b])
            .collect();
        let distance = |[a, b]: &[i64; 2]| (0.5 * (*a as f64 + *b as f64) - own).abs();
        list.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        list
    }

    /// Returns the text with another value of the number.
    fn text_with(&self, multiple: i64) -> Result<String, Fault> {
        let mut units: Vec<u16> = self.text.encode_utf16().collect();
        let mut edits: Vec<&Edit> = self.tried.edits.iter().collect();
        edits.sort_by_key(|it| it.from);
        for Edit { from, to, before, part } in edits.into_iter().rev() {
            if from > to || *to > units.len() {
                return Err(Fault::new(&format!("the text has no places {from} to {to}")));
            }
            let number = format!("{before}{}", self.digits.value(multiple) * part);
            units.splice(from..to, number.encode_utf16());
        }
        Ok(String::from_utf16_lossy(&units))
    }

    /// Returns the changes of the verdict in words, in the order of the values.
    fn told(&self) -> String {
        let mut changes = self.changes();
        changes.sort_unstable();
        let side = |it: i64| format!("{} at {}", self.answers[&it], self.digits.value(it));
        let change = |[a, b]: [i64; 2]| format!("{}, {}", side(a), side(b));
        let list: Vec<String> = changes.into_iter().map(change).collect();
        if list.is_empty() { String::new() } else { format!(": {}", list.join("; ")) }
    }

    fn sentence(&self, is_stopped: bool) -> String {
        let (label, count) = (&self.tried.label, self.answers.len());
        let [low, high] = [self.digits.first, self.digits.last].map(|it| self.digits.value(it));
        let stopped = if is_stopped { "Stopped. " } else { "" };
        let (found, other) = match (self.changes().len(), self.answers.values().next()) {
            (_, None) => return format!("{stopped}No value of {label} was tried."),
            (0, Some(answer)) => {
                (format!("The scene {answer} at all values of {label} that were tried"), "")
            }
            (1, _) => (format!("The verdict changes with {label}{}", self.told()), "other "),
            (times, _) => {
                (format!("The verdict changes {times} times with {label}{}", self.told()), "other ")
            }
        };
        format!(
            "{stopped}{found}. {count} values from {low} to {high} were tried; {other}changes between them are possible."
        )
    }

    /// Returns a table of all values that were tried, with their verdicts.
    fn table(&self) -> String {
        let line = |(multiple, answer): (&i64, &Answer)| {
            let value = self.digits.value(*multiple);
            match answer {
                Answer::Mistake(message) => format!("{value:>12}  {answer}: {message}\n"),
                _ => format!("{value:>12}  {answer}\n"),
            }
        };
        let lines: String = self.answers.iter().map(line).collect();
        format!("{}\n{lines}", self.tried.label)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "larger numbers become the largest one")]
fn multiple(whole: f64) -> i64 {
    whole as i64
}

fn capital(text: &impl ToString) -> String {
    let text = text.to_string();
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |it| it.to_uppercase().chain(letters).collect())
}
