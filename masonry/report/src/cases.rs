//! Combinations of loads or positions of a train: a line for each, and the one that governs.

use super::figures::Digits::Significant;
use super::figures::{Columns, Table, Value, members, yes_or_no};
use super::format::InUnits;
use super::format::Quantity::{Length, Percent, Pure};
use super::text::{section, table};
use super::{joints, svg};
use masonry::Verdict;
use masonry::analysis::limit::{Answer, CrossingTrain, Limit, SeismicCheck, TrainPosition};
use masonry::analysis::outcome::Outcome;
use masonry::rounding::largest;
use masonry::scene::Combined;

/// The results of all load combinations, or of all positions of a train: one line for each.
#[derive(Debug, Clone)]
pub struct Cases {
    kind: Kind,
    governs: usize,
    /// The name of the case that governs.
    name: String,
    rows: Table,
    /// The diagram (SVG) of the load factor against the position of a train; `None` for combinations.
    curve: Option<String>,
}

/// Words and keys for one kind of cases: load combinations, or positions of a train.
#[derive(Debug, Clone, Copy)]
struct Kind {
    /// The key of the list of cases in JSON.
    key: &'static str,
    title: &'static str,
    /// The words that follow the name of the governing case in a sentence, such as `governs`.
    governs: &'static str,
}

const COMBINATIONS: Kind = Kind { key: "combinations", title: "Combinations", governs: "governs" };
const POSITIONS: Kind = Kind {
    key: "positions",
    title: "Positions of the train, associative flow",
    governs: "is the worst by associative flow",
};
const POSITIONS_BY_PATH: Kind =
    Kind { key: "positions", title: "Positions of the train, path", governs: "governs" };

/// Returns the answer at one position of a train in words; `None` stands for a position without an axle on the
/// structure.
fn answer(it: Option<Answer>) -> &'static str {
    match it {
        Some(Answer::Fails) => "fails",
        Some(Answer::Unlimited) => "does not fail",
        Some(Answer::Falls) => "falls without the train",
        Some(Answer::Undecided) => "undecided",
        None => "no axle on it",
    }
}

/// Finds the combination with the worst verdict; among equal verdicts, the combination whose outcome uses most of the
/// friction of a joint. `None` for an empty list.
fn worst(list: &[Combined<Outcome>]) -> Option<usize> {
    let rank = |it: &Outcome| match it.verdict() {
        Verdict::Falls => 2,
        Verdict::Undecided => 1,
        Verdict::Stands => 0,
    };
    let used = |it: &Outcome| friction_used(it).unwrap_or(0.0);
    let worse = |a: &Outcome, b: &Outcome| rank(a).cmp(&rank(b)).then(used(a).total_cmp(&used(b)));
    // The reversed order makes `max_by` return the first of several equal elements.
    (0..list.len()).rev().max_by(|a, b| worse(&list[*a].of, &list[*b].of))
}

/// Finds the combination with the smallest load factor that is carried; `None` for an empty list.
fn smallest(list: &[Combined<Limit>]) -> Option<usize> {
    let carried = |k: &usize| list[*k].of.carried();
    (0..list.len()).min_by(|a, b| carried(a).total_cmp(&carried(b)))
}

/// Adds a warning to the governing limit load if another combination has a worse seismic check.
fn compare_checks(list: &mut [Combined<Limit>], governs: usize) {
    let worse = |worst: usize, k: usize| {
        if list[k].of.has_worse_check(&list[worst].of) { k } else { worst }
    };
    let worst = (0..list.len()).fold(governs, worse);
    if worst != governs {
        let Combined { name, of } = list[worst].clone();
        list[governs].of.compare_check(&format!("\"{name}\""), &of);
    }
}

/// Returns the largest used part of the friction of a joint \[-\]; `None` if the outcome has no state.
fn friction_used(outcome: &Outcome) -> Option<f64> {
    let state = outcome.state.as_ref()?;
    let forces = joints::forces(&outcome.model, &state.contacts);
    Some(largest(forces.iter().filter_map(|it| it.utilisation)))
}

impl Cases {
    /// Lists the verdicts of all combinations. The combination with the worst verdict governs; among equal verdicts,
    /// the one whose outcome uses most of the friction of a joint. `None` for an empty list.
    pub fn of_outcomes(list: &[Combined<Outcome>]) -> Option<Self> {
        let governs = worst(list)?;
        let rows = Columns::<&Combined<Outcome>>::new()
            .words("combination", |it| &it.name)
            .words("verdict", |it| it.of.verdict().to_string().to_lowercase())
            .number("friction_used", Percent, Significant(3), |it| friction_used(&it.of))
            .named("friction used")
            .table(InUnits(list[governs].of.model.units), list);
        let name = list[governs].name.clone();
        Some(Self { kind: COMBINATIONS, governs, name, rows, curve: None })
    }

    /// Lists the limit loads of all combinations. The combination with the smallest factor governs; its limit load gets
    /// a warning if another combination has a worse seismic check. `None` for an empty list.
    pub fn of_limits(list: &mut [Combined<Limit>]) -> Option<Self> {
        let governs = smallest(list)?;
        compare_checks(list, governs);
        let finite = |factor: f64| Some(factor).filter(|it| it.is_finite());
        let mut columns = Columns::<&Combined<Limit>>::new()
            .words("combination", |it| &it.name)
            .number("load_factor", Pure, Significant(5), move |it| finite(it.of.carried()))
            .named("carries")
            .number("falls", Pure, Significant(5), move |it| finite(it.of.not_carried()))
            .words("decided", |it| it.of.is_solved());
        if list.iter().any(|it| it.of.seismic.is_some()) {
            let of = |it: &Combined<Limit>, what: fn(&SeismicCheck) -> f64| {
                it.of.seismic.as_ref().map(what)
            };
            columns = columns
                .number("a_0", Pure, Significant(4), move |it| of(it, |it| it.capacity))
                .named("a_0* [m/s2]")
                .number("a_0_least", Pure, Significant(4), move |it| of(it, |it| it.least_capacity))
                .named("least a_0* [m/s2]")
                .words("satisfied", |it| {
                    it.of.seismic.as_ref().and_then(SeismicCheck::is_satisfied)
                });
        }
        let rows = columns.table(InUnits(list[governs].of.model.units), &*list);
        let name = list[governs].name.clone();
        Some(Self { kind: COMBINATIONS, governs, name, rows, curve: None })
    }

    /// Lists the limit loads of a train at all of its positions.
    pub fn of_train(crossing: &CrossingTrain) -> Self {
        let CrossingTrain { positions, by_path, critical, limit, .. } = crossing;
        let units = InUnits(limit.model.units);
        let rows = Columns::<&TrainPosition>::new()
            .number("position", Length, Significant(5), |it| it.at)
            .number("load_factor", Pure, Significant(5), |it| it.load_factor)
            .named("carries")
            .number("bound", Pure, Significant(5), |it| it.bound)
            .words("answer", |it| answer(it.answer))
            .table(units, positions);
        let name = format!("position {}", units.length_text(positions[*critical].at));
        let law = if *by_path { "path" } else { "associative flow" };
        let curve = svg::train(&limit.title, law, &rows, *critical);
        let kind = if *by_path { POSITIONS_BY_PATH } else { POSITIONS };
        Self { kind, governs: *critical, name, rows, curve }
    }

    /// Returns the diagram (SVG) of the load factor against the position of a train; `None` for combinations.
    pub fn curve(&self) -> Option<&str> {
        self.curve.as_deref()
    }

    /// Returns the index of the governing case in the list of cases, from zero.
    pub fn governs(&self) -> usize {
        self.governs
    }

    /// Returns the head of a report as text: the table of all cases, and the name of the case that the rest of the
    /// report is about.
    pub fn head(&self) -> String {
        section(self.title()).trim_start().to_owned()
            + &table(&self.shown())
            + &format!("\n{}:\n\n", self.governing())
    }

    /// Returns the object that `--json` prints for several cases, pretty-printed:
    ///
    /// * `governs`: the name of the governing case;
    /// * `combinations`: for `masonry solve` with `verdict` and `friction_used`; for `masonry limit` with the
    ///   `load_factor` that is carried, the load factor at which the structure `falls`, whether the limit is `decided`,
    ///   and `a_0`, `a_0_least` and `satisfied` of the seismic check;
    /// * or `positions`: the positions of a train with `load_factor`, `bound` and `answer`;
    /// * the `object` of the governing case, under the given `key`.
    ///
    /// # Errors
    /// No error occurs for this data; the `Result` is that of the serialiser.
    pub fn json(&self, key: &str, object: &str) -> Result<String, serde_json::Error> {
        let rows = self.rows.objects().into_iter().map(Value::Object).collect();
        let mut members = members! { "governs": &self.name };
        members.push((self.kind.key.to_owned(), Value::List(rows)));
        members.push((key.to_owned(), Value::Json(object.trim_end().to_owned())));
        Value::Object(members).file()
    }

    pub(super) fn title(&self) -> &'static str {
        self.kind.title
    }

    /// Returns the name of the governing case, in quotes if the case is a combination.
    fn quoted(&self) -> String {
        if self.kind.key == COMBINATIONS.key {
            format!("\"{}\"", self.name)
        } else {
            self.name.clone()
        }
    }

    /// Returns the name of the governing case, followed by the words that say that the case governs.
    pub fn governing(&self) -> String {
        format!("{} {}", self.quoted(), self.kind.governs)
    }

    /// Returns the note of a page on the table of cases.
    pub(super) fn note(&self) -> String {
        format!("{}; this page shows it.", self.governing())
    }

    /// Returns the table of all cases with `yes` and `no` for flags.
    pub(super) fn shown(&self) -> Table {
        let mut table = self.rows.clone();
        for cell in table.rows.iter_mut().flatten() {
            if let Value::Flag(it) = *cell {
                *cell = yes_or_no(it).into();
            }
        }
        table
    }
}
