//! The problem and the points that the command line names.

use std::io::Read;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use serde::Deserialize;

use super::output::{Failure, in_file};
use crate::io::{Format, Problem, ProblemFile, ReadError, market, read, read_file};
use crate::{Contact2d, ContactState, HorizontalLcp, Lcp, Residuals};

#[derive(Debug, Args)]
pub(super) struct InputArgs {
    /// The file with the problem; `-` is standard input.
    #[arg(required_unless_present_any = ["m", "a"], conflicts_with_all = ["m", "q", "a", "b", "c"])]
    file: Option<PathBuf>,
    /// The format of the file; by default the one that its content fits.
    #[arg(long, value_name = "F", value_parser = PossibleValuesParser::new(Format::ALL.map(Format::name)), requires = "file")]
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
        let mut content = Vec::new();
        let name = Path::new("standard input");
        stdin.read_to_end(&mut content).map_err(|error| in_file(name, &error))?;
        read(&content, format).map_err(|error| in_file(name, &error))
    }
}

fn vector(path: &Path) -> Result<Vec<f64>, Failure> {
    market::read_vector(&content(path)?).map_err(|error| in_file(path, &error))
}

fn matrix(path: &Path, order: usize) -> Result<crate::Matrix, Failure> {
    market::read_matrix(&content(path)?, order, order).map_err(|error| in_file(path, &error))
}

fn content(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| {
        ReadError::File { path: path.to_owned(), reason: error.to_string() }.into()
    })
}

/// A point in a file, as `lcp solve --json` writes it; other fields do not matter.
#[derive(Debug, Deserialize)]
struct PointFile {
    z: Option<Vec<f64>>,
    w: Option<Vec<f64>>,
    contact: Option<Forces>,
}

/// Displacements and forces of a contact problem.
#[derive(Debug, Deserialize)]
struct Forces {
    u: Vec<f64>,
    t_n: Vec<f64>,
    t_t: Vec<f64>,
}

/// A point in the variables of its problem.
#[derive(Debug)]
pub(super) enum Point {
    Variables { z: Vec<f64>, w: Vec<f64> },
    State(ContactState),
}

impl Point {
    pub(super) fn read(path: &Path, problem: &Problem) -> Result<Self, Failure> {
        let text = std::fs::read_to_string(path).map_err(|error| in_file(path, &error))?;
        Self::parse(&text, path, problem)
    }

    pub(super) fn read_stdin(stdin: &mut dyn Read, problem: &Problem) -> Result<Self, Failure> {
        let (mut text, name) = (String::new(), Path::new("standard input"));
        stdin.read_to_string(&mut text).map_err(|error| in_file(name, &error))?;
        Self::parse(&text, name, problem)
    }

    fn parse(text: &str, path: &Path, problem: &Problem) -> Result<Self, Failure> {
        let file: PointFile = serde_json::from_str(text).map_err(|error| in_file(path, &error))?;
        if let (Problem::Contact(problem), Some(forces)) = (problem, file.contact) {
            return forces.state(problem).map(Self::State).map_err(|error| in_file(path, &error));
        }
        let z = file.z.ok_or_else(|| in_file(path, &"missing field `z`"))?;
        let n = problem.order();
        check("z", &z, n).map_err(|error| in_file(path, &error))?;
        let w = match file.w {
            Some(w) => w,
            None => problem.w_of(&z).ok_or_else(|| {
                in_file(path, &"`w` is missing, which the general form and contact need")
            })?,
        };
        check("w", &w, n).map_err(|error| in_file(path, &error))?;
        Ok(Self::Variables { z, w })
    }

    /// Residuals in the variables of the problem.
    pub(super) fn residuals(&self, problem: &Problem) -> Residuals {
        match (self, problem) {
            (Self::State(state), Problem::Contact(problem)) => problem.residuals(state),
            (Self::Variables { z, w }, _) => problem.residuals(z, w),
            (Self::State(_), _) => unreachable!("only contact problems have states"),
        }
    }

    /// The pairs of the general problem.
    pub(super) fn to_pairs(&self, problem: &Problem) -> (Vec<f64>, Vec<f64>) {
        match (self, problem) {
            (Self::State(state), Problem::Contact(problem)) => problem.to_pairs(state),
            (Self::Variables { z, w }, _) => problem.to_pairs(z, w),
            (Self::State(_), _) => unreachable!("only contact problems have states"),
        }
    }
}

impl Forces {
    fn state(self, problem: &Contact2d) -> Result<ContactState, String> {
        let Self { u, t_n, t_t } = self;
        check("contact.u", &u, problem.displacements())?;
        check("contact.t_n", &t_n, problem.points())?;
        check("contact.t_t", &t_t, problem.points())?;
        Ok(problem.state(u, t_n, t_t))
    }
}

fn check(name: &str, v: &[f64], expected: usize) -> Result<(), String> {
    let len = v.len();
    if len == expected {
        return Ok(());
    }
    Err(format!("`{name}` has {len} entries, but must have {expected}"))
}
