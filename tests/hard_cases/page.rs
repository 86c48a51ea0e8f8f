//! The catalogue as a page: `docs/hard_cases.md`.

use std::fmt::{self, Write};

use masonry::outcome::Outcome;

use super::case::{End, Theme, Tried};
use super::common::routes::ROUTES;

const HEAD: &str = "\
# Hard cases

Scenes that are hard on purpose, what is known about their answers, and what every route of `masonry` gives for them.
Problems of `lcp` itself are on a [page of their own](hard_problems.md).
The list is `tests/hard_cases/`, and so is what writes this page:

```text
HARD_CASES=write cargo test --test hard_cases
```

The same test holds what is called solved against checks that use nothing of the methods but elements: balance of every block in
numbers of twice the digits, friction cone, gaps and sliding from the displacements, forces at all nodes, and the energy
`f.u = 2 U + D + t.x` (loads, strain energy, dissipation, initial gaps). Forces are compared with those on the same block,
so that a light one is not excused by a heavy neighbour. Asked for are residuals of 1e-10, of `alm` 1e-8.

In the tables a power of ten alone is the worst of these checks, rounded up, of an answer that is called solved. Otherwise
the route says that it has no answer, by its status and the residual at which it ended (which may be small far out, where
displacements are huge: then other checks refused it); a dash is a scene that it does not treat. In brackets are pivots, of all
attempts, or sweeps, steps, programs or iterations. The test lets powers of answers and costs differ, and does not compare how a
route gives up: all may hang on the last digits.
After every case come its parameters and what is known about the answer.
";

/// The page.
pub fn page(themes: &[&Theme]) -> String {
    let mut text = HEAD.to_owned();
    for theme in themes {
        write_theme(&mut text, theme).unwrap();
    }
    text
}

fn write_theme(text: &mut String, theme: &Theme) -> fmt::Result {
    writeln!(text, "\n## {}", theme.title)?;
    for group in theme.cases.chunk_by(|a, b| a.case.why == b.case.why) {
        writeln!(text, "\n{}\n", group[0].case.why)?;
        for Tried { case, .. } in group {
            writeln!(text, "* **{}** ({}): {}", case.name, case.parameters, case.expected)?;
        }
    }
    write!(text, "\n| case |")?;
    for route in ROUTES {
        write!(text, " {} |", route.name())?;
    }
    writeln!(text, "\n|---|{}", "---|".repeat(ROUTES.len()))?;
    for tried in &theme.cases {
        write!(text, "| {} |", tried.case.name)?;
        for end in &tried.ends {
            write!(text, " {} |", cell(end))?;
        }
        writeln!(text)?;
    }
    Ok(())
}

fn cell(end: &End) -> String {
    let cost = |outcome: &Outcome| outcome.solve.pivots + outcome.solve.iterations;
    match end {
        End::Solved { errors, outcome } => {
            format!("{} ({})", power(errors.worst()), cost(outcome))
        }
        End::GaveUp { outcome } => {
            let info = &outcome.solve;
            format!("{} {} ({})", info.status, power(info.residuals.worst()), cost(outcome))
        }
        End::Refused => "-".to_owned(),
        End::Slow => "not tried".to_owned(),
    }
}

/// The next power of ten; nothing below 1e-15 is told apart.
pub fn power(error: f64) -> String {
    format!("1e{}", error.log10().ceil().max(-15.0) + 0.0)
}

/// The first line in which two pages differ by more than last digits.
pub fn difference(written: &str, found: &str) -> Option<String> {
    let mut lines = (written.lines(), found.lines());
    loop {
        match (lines.0.next(), lines.1.next()) {
            (None, None) => return None,
            (a, b) if !same(a.unwrap_or_default(), b.unwrap_or_default()) => {
                return Some(format!("the page says {a:?}, and the list gives {b:?}"));
            }
            _ => {}
        }
    }
}

fn same(a: &str, b: &str) -> bool {
    let (left, right) = (a.split('|'), b.split('|'));
    left.clone().count() == right.clone().count() && left.zip(right).all(|(a, b)| near(a, b))
}

/// Digits of an answer, and in which words a route gives up, may hang on the last bits of what it ran after.
fn near(a: &str, b: &str) -> bool {
    match (is_answer(a), is_answer(b)) {
        (Some(a), Some(b)) => a == b,
        _ => a == b,
    }
}

/// Whether a cell with a power of ten stands for an answer; `None` for other cells.
fn is_answer(cell: &str) -> Option<bool> {
    // What it cost, in brackets, is not compared.
    let words: Vec<&str> = cell.split_whitespace().filter(|it| !it.starts_with('(')).collect();
    words.last()?.strip_prefix("1e")?.parse::<i32>().ok()?;
    (words.len() <= 2).then_some(words.len() == 1)
}
