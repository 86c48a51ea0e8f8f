//! A hard case with its parameter varied: from harmless to hopeless.

use lcp::Status;

use masonry::scene::Route;

use super::case::{Case, End, Tried, Truth, promised};
use super::common::routes::ROUTES;

/// Scenes that differ in one number.
pub struct Sweep {
    /// What is varied, in words.
    pub title: String,
    /// The number, for an axis.
    pub parameter: &'static str,
    /// Its values, in their order.
    pub values: Vec<f64>,
    case: Box<dyn Fn(f64) -> Case + Send + Sync>,
}

/// What is known of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Expected {
    Answer,
    None,
    Open,
}

/// What every route gave at one value.
pub struct Point {
    pub value: f64,
    pub expected: Expected,
    /// The largest error that any answer may have, but those to a looser tolerance.
    pub promised: f64,
    pub ends: Vec<Reached>,
    /// What is wrong with what is called solved.
    pub wrong: Vec<String>,
}

/// What one route gave: two numbers, so that a long sweep keeps no answers.
#[derive(Debug, Clone, Copy)]
pub enum Reached {
    /// Called solved: the worst of the checks, and the backward error.
    Solved { error: f64, backward: f64 },
    /// It says that it found nothing, and how far it was.
    GaveUp { status: Status, residual: f64 },
    /// Not treated, or not tried.
    Nothing,
}

impl Sweep {
    pub fn new(
        title: &str,
        parameter: &'static str,
        values: impl IntoIterator<Item = f64>,
        case: impl Fn(f64) -> Case + Send + Sync + 'static,
    ) -> Self {
        let values = values.into_iter().collect();
        Self { title: title.to_owned(), parameter, values, case: Box::new(case) }
    }

    /// Some of its values, from the first to the last.
    pub fn coarse(&self) -> Vec<f64> {
        let last = self.values.len() - 1;
        [0, last / 2, last].map(|k| self.values[k]).into()
    }

    /// The case at a value, by every route.
    pub fn at(&self, value: f64) -> Point {
        let tried = (self.case)(value).tried();
        let wrong = tried
            .wrong(promised)
            .into_iter()
            .map(|line| format!("{}, {} = {value:e}: {line}", self.title, self.parameter));
        let reached = |end: &End| match end {
            End::Solved { checks, .. } => {
                Reached::Solved { error: checks.worst(), backward: checks.backward }
            }
            End::GaveUp { outcome } => {
                let info = &outcome.solve;
                Reached::GaveUp { status: info.status, residual: info.residuals.worst() }
            }
            End::Refused | End::Slow => Reached::Nothing,
        };
        assert_eq!(tried.ends.len(), ROUTES.len());
        Point {
            value,
            expected: expected(&tried.case.truth),
            promised: largest_promise(&tried),
            wrong: wrong.collect(),
            ends: tried.ends.iter().map(reached).collect(),
        }
    }
}

fn expected(truth: &Truth) -> Expected {
    match truth {
        Truth::Known(_) => Expected::Answer,
        Truth::Falls(_) => Expected::None,
        Truth::Open => Expected::Open,
    }
}

fn largest_promise(tried: &Tried) -> f64 {
    let of_end = |(route, end): (Route, &End)| match end {
        End::Solved { checks, .. } if route != Route::Alm => promised(route, checks),
        _ => 0.0,
    };
    let largest = ROUTES.into_iter().zip(&tried.ends).map(of_end).fold(0.0, f64::max);
    largest * tried.case.amplified
}

/// `10^first, ..., 10^last`, every `step` decades.
pub fn decades(first: i32, last: i32, step: usize) -> impl Iterator<Item = f64> {
    let reversed = first > last;
    let count = first.abs_diff(last) as usize;
    (0..=count).step_by(step).map(move |k| {
        let k = i32::try_from(k).unwrap();
        10_f64.powi(if reversed { first - k } else { first + k })
    })
}
