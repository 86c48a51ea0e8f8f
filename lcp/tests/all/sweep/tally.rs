//! How often which verdict was given, with the smallest problem of each kind of failure.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use lcp::Error;

use super::methods::AUTO;
use super::problems::{Case, Kind};
use super::truth::{Worth, truth, worth};

/// The failures of a kind: how many, and the smallest.
#[derive(Default)]
struct Failures {
    count: usize,
    size: usize,
    smallest: String,
}

impl Failures {
    fn add(&mut self, size: usize, text: impl FnOnce() -> String) {
        self.count += 1;
        if self.count == 1 || size < self.size {
            (self.size, self.smallest) = (size, text());
        }
    }
}

/// The answers of a method.
#[derive(Default)]
struct Row {
    asked: usize,
    refused: usize,
    right: usize,
    failures: BTreeMap<String, Failures>,
}

/// The answers of all methods by kind of problem.
#[derive(Default)]
pub(crate) struct Tally {
    rows: BTreeMap<(String, &'static str), Row>,
    /// Problems with a solution, without one though feasible, and infeasible ones.
    truths: BTreeMap<String, [usize; 3]>,
}

impl Tally {
    /// The problems of every kind that belong to these seeds.
    pub(crate) fn sweep(seeds: Range<u64>) -> Self {
        let mut tally = Self::default();
        for kind in Kind::ALL {
            for seed in seeds.clone() {
                tally.add(&format!("{kind:?}"), &Case::draw(kind, seed));
            }
        }
        tally
    }

    /// Asks all methods that treat a problem.
    pub(crate) fn add(&mut self, kind: &str, case: &Case) {
        let truth = truth(&case.integers);
        let place = if truth.is_solvable() { 0 } else { 2 - usize::from(truth.is_feasible()) };
        self.truths.entry(kind.to_owned()).or_default()[place] += 1;
        for (method, answer) in case.problem.answers() {
            let row = self.rows.entry((kind.to_owned(), method)).or_default();
            row.asked += 1;
            let (what, detail) = match answer {
                Err(Error::NotTreated { .. }) => {
                    row.refused += 1;
                    continue;
                }
                Err(error) => ("wrong".to_owned(), error.to_string()),
                Ok(solution) => match worth(case, &truth, &solution) {
                    Worth::Right => {
                        row.right += 1;
                        continue;
                    }
                    Worth::Unproved => ("unproved".to_owned(), String::new()),
                    Worth::Wrong(why) => ("wrong".to_owned(), why),
                    Worth::Open(status) => {
                        let of = ["solvable", "without a solution", "infeasible"][place];
                        (format!("open: {of}, {status}"), String::new())
                    }
                },
            };
            let text = || format!("{} {detail}", case.text());
            row.failures.entry(what).or_default().add(case.size(), text);
        }
    }

    /// How many verdicts of all methods are wrong.
    pub(crate) fn wrong(&self) -> usize {
        self.rows.values().map(|row| row.count("wrong")).sum()
    }

    /// How many problems `Auto` leaves open, or without the proof that there is.
    pub(crate) fn undecided_by_auto(&self) -> usize {
        let rows = self.rows.iter().filter(|((_, method), _)| *method == AUTO);
        rows.map(|(_, row)| row.count("open") + row.count("unproved")).sum()
    }
}

impl Row {
    fn count(&self, prefix: &str) -> usize {
        let failures = self.failures.iter().filter(|(what, _)| what.starts_with(prefix));
        failures.map(|(_, failures)| failures.count).sum()
    }
}

/// A table, and the smallest problem of every kind of failure.
impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "| problems | solvable | without a solution | infeasible |\n|---|---|---|---|"
        )?;
        for (kind, [solvable, without, infeasible]) in &self.truths {
            writeln!(f, "| {kind} | {solvable} | {without} | {infeasible} |")?;
        }
        writeln!(
            f,
            "\n| problems | method | asked | refused | right | wrong | open: solvable | open: without a \
             solution | open: infeasible | unproved |\n|---|---|---|---|---|---|---|---|---|---|"
        )?;
        for ((kind, method), row) in &self.rows {
            let Row { asked, refused, right, .. } = row;
            write!(f, "| {kind} | {method} | {asked} | {refused} | {right} |")?;
            for what in ["wrong", "open: s", "open: w", "open: i", "unproved"] {
                write!(f, " {} |", row.count(what))?;
            }
            writeln!(f)?;
        }
        for ((kind, method), row) in &self.rows {
            for (what, failures) in &row.failures {
                let Failures { count, smallest, .. } = failures;
                writeln!(
                    f,
                    "\n{kind}, {method}, {what} ({count} times), the smallest:\n{smallest}"
                )?;
            }
        }
        Ok(())
    }
}
