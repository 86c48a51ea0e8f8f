//! The problem and the points that the command line names.

use std::io::Read;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use serde::Deserialize;

use super::output::{Failure, in_file};
use crate::io::{
    Problem, ProblemFile, ProblemFormat, ReadError, market, pairs_of_forces, read, read_file,
};
use lcp::{ContactForces, HorizontalLcp, Lcp, Residuals};

#[derive(Debug, Args)]
pub(super) struct InputArgs {
    /// The file with the problem; `-` is standard input.
    #[arg(required_unless_present_any = ["m", "a"], conflicts_with_all = ["m", "q", "a", "b", "c"])]
    file: Option<PathBuf>,
    /// The format of the file; by default the one that its content fits.
    #[arg(long, value_name = "F", value_parser = PossibleValuesParser::new(ProblemFormat::ALL.map(ProblemFormat::name)), requires = "file")]
    format: Option<String>,
    /// M of w = M z + q, in the Matrix Market format.
    #[arg(long, value_name = "FILE", requires = "q", conflicts_with_all = ["a", "b", "c"])]
    m: Option<PathBuf>,
    /// q of w = M z + q, in the Matrix Market format.
    #[arg(long, value_name = "FILE", requires = "m")]
    q: Option<PathBuf>,
    /// A of A t + B y = c, in the Matrix Market format.
    #[arg(long, value_name = "FILE", requires = "b", requires = "c")]
    a: Option<PathBuf>,
    /// B of A t + B y = c, in the Matrix Market format.
    #[arg(long, value_name = "FILE", requires = "a")]
    b: Option<PathBuf>,
    /// c of A t + B y = c, in the Matrix Market format.
    #[arg(long, value_name = "FILE", requires = "a")]
    c: Option<PathBuf>,
    /// Print one JSON object instead of the report.
    #[arg(long)]
    pub(super) json: bool,
}

/// A problem with the name of the format that it was read from.
#[derive(Debug)]
pub(super) struct Input {
    pub(super) problem: Problem,
    pub(super) format: &'static str,
}

impl InputArgs {
    /// Whether the problem comes from standard input.
    pub(super) fn is_stdin(&self) -> bool {
        self.file.as_deref().is_some_and(|file| file.as_os_str() == "-")
    }

    pub(super) fn read(&self, stdin: &mut dyn Read) -> Result<Input, Failure> {
        match (&self.file, &self.m, &self.q, &self.a, &self.b, &self.c) {
            (Some(file), ..) => {
                let ProblemFile { format, problem } = self.read_file(file, stdin)?;
                Ok(Input { problem, format: format.name() })
            }
            (_, Some(m), Some(q), ..) => {
                let q = vector(q)?;
                let problem =
                    Lcp::new(matrix(m, q.len())?, q).map_err(|error| in_file(m, &error))?;
                Ok(Input { problem: Problem::Lcp(problem), format: "matrix-market" })
            }
            (.., Some(a), Some(b), Some(c)) => {
                let c = vector(c)?;
                let problem = HorizontalLcp::new(matrix(a, c.len())?, matrix(b, c.len())?, c)?;
                Ok(Input { problem: Problem::Horizontal(problem), format: "matrix-market" })
            }
            _ => {
                Err("no problem is named: give a file, or --m and --q, or --a, --b and --c".into())
            }
        }
    }

    fn read_file(&self, file: &Path, stdin: &mut dyn Read) -> Result<ProblemFile, Failure> {
        let format = self.format.as_deref().map(str::parse).transpose()?;
        if file.as_os_str() != "-" {
            return read_file(file, format).map_err(|error| match error {
                ReadError::File { .. } => error.into(),
                _ => in_file(file, &error),
            });
        }
        read(&content(file, stdin)?, format).map_err(|error| in_file(file, &error))
    }
}

fn vector(path: &Path) -> Result<Vec<f64>, Failure> {
    let content = content(path, &mut std::io::empty())?;
    market::read_vector(&content).map_err(|error| in_file(path, &error))
}

fn matrix(path: &Path, order: usize) -> Result<lcp::Matrix, Failure> {
    let content = content(path, &mut std::io::empty())?;
    market::read_matrix(&content, order, order).map_err(|error| in_file(path, &error))
}

/// The content of a file; `-` is standard input.
fn content(path: &Path, stdin: &mut dyn Read) -> Result<Vec<u8>, Failure> {
    let content = if path.as_os_str() == "-" {
        let mut content = Vec::new();
        stdin.read_to_end(&mut content).map(|_| content)
    } else {
        std::fs::read(path)
    };
    let path = path.to_owned();
    content.map_err(|error| ReadError::File { path, reason: error.to_string() }.into())
}

/// A point in a file, as `lcp solve --json` writes it; other fields do not matter.
#[derive(Debug, Deserialize)]
struct PointFile {
    z: Option<Vec<f64>>,
    w: Option<Vec<f64>>,
    contacts: Option<ContactForces>,
    contact: Option<State>,
}

/// Displacements and forces of a contact problem.
#[derive(Debug, Deserialize)]
struct State {
    u: Vec<f64>,
    t_n: Vec<f64>,
    t_t: Vec<f64>,
}

/// A point of its problem.
#[derive(Debug)]
pub(super) struct Point {
    /// Residuals in the variables of the problem.
    pub(super) residuals: Residuals,
    /// `(t, y)` of the general problem.
    pub(super) pairs: (Vec<f64>, Vec<f64>),
}

impl Point {
    /// Reads the point from a file; `-` is standard input.
    pub(super) fn read(
        path: &Path,
        stdin: &mut dyn Read,
        problem: &Problem,
    ) -> Result<Self, Failure> {
        let content = content(path, stdin)?;
        let file = serde_json::from_slice(&content).map_err(|error| in_file(path, &error))?;
        Self::of(file, problem).map_err(|error| in_file(path, &error))
    }

    fn of(file: PointFile, problem: &Problem) -> Result<Self, String> {
        match (problem, file) {
            (Problem::Contact(problem), PointFile { contact: Some(State { u, t_n, t_t }), .. }) => {
                check("contact.u", &u, problem.displacements())?;
                check("contact.t_n", &t_n, problem.points())?;
                check("contact.t_t", &t_t, problem.points())?;
                let state = problem.state(u, t_n, t_t);
                Ok(Self { residuals: problem.residuals(&state), pairs: problem.to_pairs(&state) })
            }
            (Problem::Friction(problem), PointFile { contacts: Some(forces), .. }) => {
                check("contacts.normal", &forces.normal, problem.contacts())?;
                check("contacts.tangential", &forces.tangential, problem.contacts())?;
                let pairs = pairs_of_forces(problem, &forces);
                Ok(Self { residuals: problem.residuals(&forces), pairs })
            }
            (problem, PointFile { z, w, .. }) => {
                let z = z.ok_or("missing field `z`")?;
                check("z", &z, problem.order())?;
                let missing = "`w` is missing, which the general form and contact need";
                let w = w.or_else(|| problem.w_of(&z)).ok_or(missing)?;
                check("w", &w, problem.order())?;
                Ok(Self { residuals: problem.residuals(&z, &w), pairs: problem.to_pairs(&z, &w) })
            }
        }
    }
}

fn check(name: &str, v: &[f64], expected: usize) -> Result<(), String> {
    let len = v.len();
    if len == expected {
        return Ok(());
    }
    Err(format!("`{name}` has {len} entries, but must have {expected}"))
}
