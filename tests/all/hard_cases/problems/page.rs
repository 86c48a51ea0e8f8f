//! The catalogue as a page: `docs/hard_problems.md`.

use std::fmt::{self, Write};

use super::super::page::power;
use super::case::{End, Theme, Tried};
use super::problem::Method;

const HEAD: &str = "\
# Hard problems

Problems that are hard on purpose, what is known about their solutions, and the results of every method of `lcp`. Scenes of `masonry` have
[their own page](hard_cases.md). The cases are in `tests/all/hard_cases/problems/`, which also writes this page:

```text
HARD_CASES=write cargo test --features long-tests --test all hard_cases
```

A planted solution is exact: data and solution are numbers without rounding errors. Small problems are enumerated in rational arithmetic. The tolerance is
1e-10. The test recomputes the residual of every solved case in double-double arithmetic, compares solutions with the known ones, checks every proof that there
is no solution, and rejects proofs against problems that have one.

In the tables a power of ten without a status is the residual of a solution, rounded up. Otherwise the method found no solution: the cell has its status and the
residual at which it ended. A dash means that the method does not treat the problem. In brackets is the number of pivots, sweeps, steps or programs. Lemke's
method runs with dense and with sparse matrices, on contact problems always with sparse ones. The test does not compare powers of ten, costs, and the status of
a failure.

Only `Infeasible` and `NoSolution` are proofs that there is no solution. All other
[statuses](lcp/solving.md#solving-and-reading-a-solution), such as `AlmostSolved`, `Stalled`, `RayTermination`, `IterationLimit` and `NumericalTrouble`, prove
nothing: another method may find a solution. Solved means solved to the residual: with a condition number of 1e18 (Hilbert, order 14) no digit of `z` has to be
right.

Each case has its parameters in brackets: the data, or the function of `lcp` that makes them (its last argument is a seed). Standard problems are `w = M z + q`,
`z, w >= 0`, `z.w = 0`. With indices from zero, `s_ij` is the entry `(i^2 + 3 i j + 5 j) mod 7` of (0, 1, -1, 1, 0, -1, -1): signs without a pattern. A *planted
solution* is, unless stated otherwise, `z_i = 1 + i mod 3` at even `i`, `w_i = 1 + i mod 3` at odd ones, and zero elsewhere; then `q = w - M z`.
";

/// The page.
pub fn page(themes: &[Theme]) -> String {
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
            if case.parameters.is_empty() {
                writeln!(text, "* **{}**: {}", case.name, case.expected)?;
            } else {
                writeln!(text, "* **{}** ({}): {}", case.name, case.parameters, case.expected)?;
            }
        }
    }
    write!(text, "\n| case |")?;
    for method in Method::ALL {
        write!(text, " {} |", method.name())?;
    }
    writeln!(text, "\n|---|{}", "---|".repeat(Method::ALL.len()))?;
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
    let End::Ended { solution, measure } = end else { return "-".to_owned() };
    let cost = solution.info.pivots + solution.info.iterations;
    if solution.is_solved() {
        format!("{} ({cost})", power(measure.residual))
    } else {
        format!("{} {} ({cost})", solution.status, power(solution.residuals.worst()))
    }
}
