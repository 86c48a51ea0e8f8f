//! The catalogue as a page: `docs/hard_cases.md`.

use std::fmt::{self, Write};

use masonry::analysis::outcome::Outcome;

use super::case::{End, Theme, Tried};
use super::common::routes::ROUTES;

const HEAD: &str = "\
# Hard cases

Scenes that are hard on purpose, what is known about their solutions, and the results of every route of `masonry`. Problems of `lcp` itself have
[their own page](hard_problems.md). The cases are in `tests/all/hard_cases/`, which also writes this page:

```text
HARD_CASES=write cargo test --features long-tests --test all hard_cases
```

A solved case has passed the [checks](theory/solutions.md#10-residuals-and-balances), which are independent of the methods: balance of every block, friction cone, gaps
and sliding from the displacements, forces at all nodes from the elements, and the energy `f.u + t.y = 2 U + t.x` (loads, forces on gaps and slips, strain
energy, initial gaps). Forces are relative to those on the same block, so a light block is not excused by a heavy neighbour; rounding errors of the neighbour
count as 1e-9 at most. The test repeats the checks, with the balances in double-double arithmetic, and compares the solution with what is known. The tolerance
is 1e-10, for `alm` 1e-8.

Each case has its parameters in brackets, and then what is known about its solution. Unless stated otherwise:

* plane stress, thickness 1 m, gravity of 9.81 m/s2 downwards, one `mu` for all joints, contact points at both ends of every part of a
  joint on which displacements are linear;
* blocks are elastic unless they are called rigid, with E = 1e6 kN/m2 and nu = 0.15, and all have a density of 2000 kg/m3;
* blocks on their own have 2 x 2 elements; walls are in running bond on a floor, of bricks 0.2 x 0.1 m of one element each;
* a weight inclined by 0.1, or a push of 0.1 of the weight, is gravity with that fraction of it to the right; no other loads act.

## How to read the tables

* `1e-14, 1e-15 (23)`, without a status, is a solved case: the worst of these checks, the residual of the complementarity problem (computed by the library from
  the data, the criterion for `Solved`), and the cost in brackets. The residual is relative to the largest forces, so the checks weight the same error more on a
  block with smaller ones. Powers of ten are rounded up; values below 1e-15 are shown as 1e-15.
* `Stalled 1e-5 (202)` means that no solution was found: the status, and the residual at which the route ended. This residual may be small at a distant point,
  where displacements are huge; then other checks refused the point.
* A dash means that the route does not treat the scene; `not tried` means that it would take too long for a test.
* The cost is the number of pivots of all attempts, or of sweeps, steps, programs or iterations.

Only `Infeasible` is a [proof](methods/convex_programs.md#is-there-an-equilibrium-at-all) that there is no equilibrium. `NoEquilibrium`, by `interior`, is
evidence: loaded slowly, the blocks [do not come to rest](methods/evolution.md). All other [statuses](lcp/solving.md#solving-and-reading-a-solution) prove
nothing.

The test does not compare powers of ten, costs, and the status of a failure, since these may depend on the last digits. At the limit itself, where rounding
decides, it does not compare whether there is a solution.
";

const NOT_TRIED: &str = "not tried";

/// The end of the names of cases for which either answer is right.
pub const ON_EDGE: &str = ", at it";

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
        End::Solved { checks, outcome } => {
            let residual = outcome.solve.residuals.worst();
            format!("{}, {} ({})", power(checks.worst()), power(residual), cost(outcome))
        }
        End::GaveUp { outcome } => {
            let info = &outcome.solve;
            format!("{} {} ({})", info.status, power(info.residuals.worst()), cost(outcome))
        }
        End::Refused => "-".to_owned(),
        End::Slow => NOT_TRIED.to_owned(),
    }
}

/// The next power of ten; nothing below 1e-15 is told apart.
pub fn power(error: f64) -> String {
    format!("1e{}", error.log10().ceil().max(-15.0) + 0.0)
}

/// A written page without the cells that were not tried now.
pub fn as_far_as_tried(written: &str, found: &str) -> String {
    let mut found = found.lines();
    let line = |line: &str| {
        let cells = found.next().unwrap_or_default().split('|').map(Some);
        let both = line.split('|').zip(cells.chain(std::iter::repeat(None)));
        let chosen =
            both.map(|(cell, now)| now.filter(|it| it.trim() == NOT_TRIED).unwrap_or(cell));
        chosen.collect::<Vec<_>>().join("|") + "\n"
    };
    written.lines().map(line).collect()
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
    let is_on_edge = a.contains(&format!("{ON_EDGE} |"));
    let either = |a, b| is_on_edge && is_answer(a).is_some() && is_answer(b).is_some();
    left.clone().count() == right.clone().count()
        && left.zip(right).all(|(a, b)| near(a, b) || either(a, b))
}

/// Digits of an answer, and in which words a route gives up, may hang on the last bits of what it ran after.
fn near(a: &str, b: &str) -> bool {
    match (is_answer(a), is_answer(b)) {
        (Some(a), Some(b)) => a == b,
        _ => a == b,
    }
}

/// Whether a cell that ends with a power of ten stands for an answer, without a status; `None` for other cells.
fn is_answer(cell: &str) -> Option<bool> {
    // What it cost, in brackets, is not compared.
    let words = cell.split([' ', ',']).filter(|it| !it.is_empty() && !it.starts_with('('));
    let words: Vec<&str> = words.collect();
    let is_power = |word: &str| word.strip_prefix("1e").is_some_and(|it| it.parse::<i32>().is_ok());
    let is_end = words.len() <= 2 && is_power(words.last()?);
    is_end.then(|| words.iter().all(|word| is_power(word)))
}

/// Powers and costs are not compared, what they stand for is.
#[test]
fn pages_differ_by_answers() {
    let page = |cell: &str| format!("| case | {cell} |");
    let same = |a: &str, b: &str| difference(&page(a), &page(b)).is_none();
    assert!(same("1e-14, 1e-15 (3)", "1e-9, 1e-12 (77)") && same("1e-14 (3)", "1e0 (2)"));
    assert!(same("Stalled 1e-5 (202)", "RayTermination 1e0 (3)"));
    for other in ["Stalled 1e-15 (3)", "-", "not tried"] {
        assert!(!same("1e-14, 1e-15 (3)", other) && !same("1e-14 (3)", other), "{other}");
    }
    let on_edge = |cell: &str| format!("| block{ON_EDGE} | {cell} |");
    assert!(difference(&on_edge("1e-14, 1e-15 (3)"), &on_edge("Stalled 1e-15 (3)")).is_none());
    assert!(difference(&on_edge("1e-14, 1e-15 (3)"), &on_edge("-")).is_some());
    assert!(!same("-", "not tried") && !same("-", "Stalled 1e-15 (3)"));
}

#[test]
fn what_is_not_tried_is_not_compared() {
    let [written, found] = ["| 1e-9 (2) | - |\ntext\n", "| not tried | - |\ntext\n"];
    assert_eq!(as_far_as_tried(written, found), found);
    assert_eq!(as_far_as_tried(found, written), found);
    assert_eq!(as_far_as_tried("| - | more |\n", "| not tried |\n"), "| not tried | more |\n");
}
