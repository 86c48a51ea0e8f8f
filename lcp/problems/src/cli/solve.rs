//! `lcp solve`.

use std::io::{Read, Write};

use cpu_time::ProcessTime;
use serde::Serialize;

use super::args::SolveArgs;
use super::method;
use super::output::{Failure, NOT_SOLVED, SOLVED, in_file, show};
use crate::io::Problem;
use lcp::lemke::Attempt;
use lcp::{
    Certificate, ContactForces, ContactState, Info, Method, MethodRun, QpPoint, Residuals,
    Solution, Status,
};

/// The object that `--json` prints.
#[derive(Debug, Serialize)]
pub(super) struct Answer<'a> {
    pub(super) status: Status,
    pub(super) kind: &'static str,
    pub(super) solver: Method,
    pub(super) n: usize,
    /// Wall-clock time.
    pub(super) time_s: f64,
    /// Processor time, if the system provides it.
    pub(super) cpu_s: Option<f64>,
    #[serde(flatten)]
    pub(super) work: Work,
    pub(super) residuals: Residuals,
    pub(super) z: Vec<f64>,
    pub(super) w: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) contacts: Option<ContactForces>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contact: Option<ContactState>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) program: Option<QpPoint>,
    certificate: Option<&'a Certificate>,
    pub(super) attempts: &'a [Attempt],
    #[serde(skip_serializing_if = "<[MethodRun]>::is_empty")]
    pub(super) runs: &'a [MethodRun],
}

/// The work of the method, in its own unit.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(untagged)]
pub(super) enum Work {
    Pivots { pivots: usize },
    Iterations { iterations: usize, factorisations: usize },
}

pub(super) fn run(
    args: &SolveArgs,
    input: &mut dyn Read,
    out: &mut dyn Write,
) -> Result<u8, Failure> {
    let stdin = input;
    let input = args.input.read(stdin)?;
    let began = ProcessTime::try_now();
    let solution = method::solve(args, stdin, &input.problem)?;
    let cpu_s = began.and_then(|began| began.try_elapsed()).map(|time| time.as_secs_f64());
    if let Some(path) = &args.trace {
        let trace = serde_json::to_string(&solution.trace)? + "\n";
        std::fs::write(path, trace).map_err(|error| in_file(path, &error))?;
    }
    let answer = answer(&input.problem, &solution, cpu_s.ok());
    show(out, args.input.json, &answer, || answer.report(input.format))?;
    Ok(if solution.is_solved() { SOLVED } else { NOT_SOLVED })
}

fn answer<'a>(problem: &Problem, solution: &'a Solution, cpu_s: Option<f64>) -> Answer<'a> {
    let recovered = || problem.recover(&solution.t, &solution.y);
    let (z, w) = solution.boxed.clone().unwrap_or_else(recovered);
    let (contacts, contact, program) = match problem {
        Problem::Friction(friction) => (Some(friction.forces(&z)), None, None),
        Problem::Contact(contact) => {
            let recovered = || contact.recover(&solution.t, &solution.y);
            let state = solution.contact.clone().unwrap_or_else(recovered);
            (Some(state.forces()), Some(state), None)
        }
        Problem::Qp(program) => (None, None, Some(program.point(z.clone(), w.clone()))),
        _ => (None, None, None),
    };
    let info = &solution.info;
    let Info { pivots, iterations, factorisations, .. } = *info;
    let work = match info.method {
        Method::Lemke => Work::Pivots { pivots },
        _ => Work::Iterations { iterations, factorisations },
    };
    Answer {
        status: solution.status,
        kind: problem.kind(),
        solver: info.method,
        n: problem.order(),
        time_s: info.seconds,
        cpu_s,
        work,
        residuals: solution.residuals,
        z,
        w,
        contacts,
        contact,
        program,
        certificate: solution.certificate.as_ref(),
        attempts: &info.attempts,
        runs: &info.runs,
    }
}
