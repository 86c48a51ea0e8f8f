//! The catalogue as a page: `docs/hard_problems.md`.

use std::fmt::{self, Write};

use super::case::{End, Theme, Tried};
use super::problem::Method;
use crate::page::power;

const HEAD: &str = "\
# Hard problems

Problems that are hard on purpose, what is known about their answers, and what every method of `lcp` gives for them.
Scenes of `masonry` are on a [page of their own](hard_cases.md).
The list is `tests/hard_cases/problems/`, and so is what writes this page:

```text
HARD_CASES=write cargo test --test hard_cases
```

Where an answer is planted, data and answer are numbers without a rounding error, so that it is the answer for the data as they are.
Small problems are enumerated in rational arithmetic. Asked for are residuals of 1e-10. The test recomputes the
residual of what is called solved in numbers of twice the digits, holds answers against those that are known, checks every proof
that there is none, and refuses a proof, or evidence, against a problem that has one.

In the tables a power of ten without a status is that residual, rounded up, of an answer that is called solved. Otherwise the method says that it has no
answer, by its status and the residual at which it ended; a dash is a problem that it does not treat. In brackets are
pivots, or sweeps, steps or programs. Lemke's method runs on full matrices and on sparse ones, contact problems always on sparse ones.
The test lets powers of answers and costs differ, and does not compare how a method gives up.

Only `Infeasible` is a proof that there is no solution. `NoEquilibrium` is [evidence](methods.md#soft-springs-is-there-an-equilibrium-at-all), with
friction no proof. All other [statuses](lcp.md#solving-and-reading-a-solution), such as `AlmostSolved`, `Stalled`, `RayTermination`, `IterationLimit` and `NumericalTrouble`, prove nothing: the problem may have an answer, which the next method finds. What is solved is
solved to the residual: with a condition number of 1e18 (Hilbert, order 14) no digit of `z` has to be right.

After every case come its parameters: the data, or the function of `lcp` that makes them (its last argument is a seed). Standard problems are `w = M z + q`, `z, w >= 0`, `z.w = 0`.
Counted from zero, `s_ij` is the entry `(i^2 + 3 i j + 5 j) mod 7` of (0, 1, -1, 1, 0, -1, -1): signs without a pattern. A *planted answer* is, unless
said otherwise, `z_i = 1 + i mod 3` at even `i`, `w_i = 1 + i mod 3` at odd ones, and zero elsewhere; then `q = w - M z`.
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
