//! The report of `lcp solve`.

use std::fmt::Write as _;

use super::output::residual_lines;
use super::solve::{Answer, Work};
use lcp::lemke::Attempt;
use lcp::{MethodRun, Status};

impl Answer<'_> {
    pub(super) fn report(&self, format: &str) -> String {
        let Answer { status, solver, n, work, time_s, cpu_s, .. } = self;
        let cpu = cpu_s.map_or_else(String::new, |cpu| format!(", {cpu:.3} s of processor time"));
        let mut text = format!("{} of order {n}, read as {format}\n", self.kind);
        let _ = writeln!(text, "{status}: {}, {work}, {time_s:.3} s{cpu}", solver.full_name());
        if let Some(meaning) = meaning(self) {
            let _ = writeln!(text, "{meaning}");
        }
        text += &route_lines(self);
        text.push('\n');
        text += &residual_lines(&self.residuals);
        if *status == Status::Solved {
            text += &point_lines(self);
        } else {
            text += &attempt_lines(self.attempts);
        }
        text
    }
}

impl std::fmt::Display for Work {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Self::Pivots { pivots } => f.write_str(&counted(pivots, "pivot")),
            Self::Iterations { iterations, factorisations } => {
                f.write_str(&counted(iterations, "iteration"))?;
                if factorisations > 0 {
                    write!(f, ", {}", counted(factorisations, "factorisation"))?;
                }
                Ok(())
            }
        }
    }
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// The meaning of a status for the user, if its name does not make it clear.
fn meaning(answer: &Answer<'_>) -> Option<&'static str> {
    let is_auto = !answer.runs.is_empty();
    Some(match answer.status {
        Status::AlmostSolved => {
            "The residuals are above the tolerance; the best point is printed with --json."
        }
        Status::Infeasible | Status::NoSolution => "There is no solution; --json prints the proof.",
        Status::RayTermination => {
            "No solution was found. This does not prove that there is none; --json prints the first ray."
        }
        Status::NoComplementaryBasis => {
            "No complementary basis is nonsingular, and with artificial columns no solution was found."
        }
        Status::PivotLimit => "The limit on pivots was reached; --max-pivots raises it.",
        Status::Cycling if !answer.attempts.is_empty() => {
            "An attempt cycled, and the others found no solution."
        }
        Status::Cycling | Status::Stalled | Status::IterationLimit if is_auto => {
            "No method of the chain found a solution."
        }
        Status::IterationLimit => {
            "The limit on iterations was reached; --max-iterations raises it."
        }
        Status::TimeLimit => "The time limit was reached; --time-limit raises it.",
        Status::Cycling => "The method cycled; another --solver may succeed.",
        Status::Stalled => "The method makes no more progress; another --solver may succeed.",
        Status::NumericalTrouble => "Rounding errors are too large.",
        _ => return None,
    })
}

/// The methods that were chosen, and how each ended if there were several.
fn route_lines(answer: &Answer<'_>) -> String {
    let mut lines = String::new();
    for (number, run) in answer.runs.iter().enumerate() {
        let verb = if number == 0 { "auto chose" } else { "then" };
        let MethodRun { method, reason, end, seconds, .. } = run;
        let _ = writeln!(lines, "{verb} {}: {reason}", method.full_name());
        if answer.runs.len() > 1 {
            let _ = writeln!(lines, "  {end}, {seconds:.3} s");
        }
    }
    lines
}

/// The first attempts and the last one.
fn attempt_lines(attempts: &[Attempt]) -> String {
    const MOST: usize = 12;
    let mut lines = String::new();
    let last = attempts.len().saturating_sub(1);
    for (number, attempt) in attempts.iter().enumerate() {
        if (MOST..last).contains(&number) {
            if number == MOST {
                let _ = writeln!(lines, "... {} more attempts", last - MOST);
            }
            continue;
        }
        let Attempt { start, covering, end, pivots, .. } = attempt;
        let number = number + 1;
        let _ = writeln!(
            lines,
            "attempt {number}: start {start}, covering vector {covering}: {end:?} after {pivots} pivots"
        );
    }
    lines
}

/// The first entries of the answer.
fn point_lines(answer: &Answer<'_>) -> String {
    const LONGEST: usize = 40;
    let mut lines = String::new();
    let (names, columns) = match (&answer.contacts, &answer.program) {
        (Some(forces), _) => (["normal", "tangential"], [&forces.normal, &forces.tangential]),
        (_, Some(program)) => {
            let _ = writeln!(lines, "\nobjective: {:.8e}", program.objective);
            (["x", "multiplier"], [&program.x, &program.bounds])
        }
        _ => (["z", "w"], [&answer.z, &answer.w]),
    };
    let _ = writeln!(lines, "\n{:>5} {:>16} {:>16}", "", names[0], names[1]);
    for (i, (first, second)) in columns[0].iter().zip(columns[1]).enumerate().take(LONGEST) {
        let _ = writeln!(lines, "{i:>5} {first:>16.8e} {second:>16.8e}");
    }
    let more = columns[0].len().saturating_sub(LONGEST);
    if more > 0 {
        let _ = writeln!(lines, "      and {more} more, all of them with --json");
    }
    lines
}
