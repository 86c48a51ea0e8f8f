//! One line of the table.

use std::fmt;

use lcp::{Info, Method, Solution, Status};

/// What a case came to.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    /// Its group and its own name, with a slash between them.
    pub(crate) case: String,
    /// A status or a verdict.
    pub(crate) end: String,
    /// The largest residual; NaN if there is none.
    pub(crate) residual: f64,
    /// The method that found the answer, and the kind of its last attempt.
    pub(crate) method: String,
    /// Of all methods that were tried.
    pub(crate) pivots: usize,
    pub(crate) factorisations: usize,
}

impl Line {
    pub(crate) fn of_solution<P>(case: String, solution: &Solution<P>) -> Self {
        // A proof makes its verdict another one.
        let proof = if solution.certificate.is_some() { ", proved" } else { "" };
        let is_proved = solution.status != Status::Solved && !proof.is_empty();
        let runs = &solution.info.runs;
        Self {
            case,
            end: format!("{}{}", solution.status, if is_proved { proof } else { "" }),
            residual: solution.residuals.worst(),
            method: method(&solution.info),
            pivots: runs.iter().map(|route| route.pivots).sum(),
            factorisations: runs.iter().map(|route| route.factorisations).sum(),
        }
    }

    pub(crate) fn read(text: &str) -> Option<Self> {
        let fields: Vec<&str> = text.split('|').map(str::trim).collect();
        let [case, end, residual, method, pivots, factorisations] = fields[..] else {
            return None;
        };
        Some(Self {
            case: case.to_owned(),
            end: end.to_owned(),
            residual: residual.parse().ok()?,
            method: method.to_owned(),
            pivots: pivots.parse().ok()?,
            factorisations: factorisations.parse().ok()?,
        })
    }

    pub(crate) fn group(&self) -> &str {
        self.case.split('/').next().unwrap_or_default()
    }

    pub(crate) fn is_decided(&self) -> bool {
        let decided = ["Solved", "Infeasible", "NoEquilibrium", "Stands", "Falls"];
        decided.iter().any(|end| self.end.starts_with(end))
    }

    /// Whether a case that was decided is not any more, or otherwise.
    pub(crate) fn loses(&self, before: &Self) -> bool {
        before.is_decided() && self.end != before.end
    }

    /// What is worth a line.
    pub(crate) fn change_from(&self, before: &Self) -> Option<String> {
        let kind = if self.end == before.end {
            return None;
        } else if self.loses(before) {
            if self.is_decided() { "turned" } else { "lost" }
        } else if self.is_decided() {
            "gained"
        } else {
            "other end"
        };
        Some(format!("{kind}: {} was {}, is {}", self.case, before.end, self.end))
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { case, end, residual, method, pivots, factorisations } = self;
        write!(f, "{case} | {end} | {residual:.0e} | {method} | {pivots} | {factorisations}")
    }
}

/// The method, and of Lemke's method the kind of the last attempt, without seeds and pairs.
fn method(info: &Info) -> String {
    let method = format!("{:?}", info.method);
    let Some(attempt) = info.attempts.last().filter(|_| info.method == Method::Lemke) else {
        return method;
    };
    let kind = |text: String| text.split([',', ' ']).next().unwrap_or_default().to_owned();
    let kinds = [format!("{:?}", attempt.start), format!("{:?}", attempt.covering)];
    format!("{method} {}", kinds.map(kind).join(" "))
}
