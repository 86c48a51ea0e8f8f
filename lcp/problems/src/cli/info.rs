//! `lcp info`.

use std::fmt::Write as _;
use std::io::{Read, Write};

use serde::Serialize;

use super::input::{Input, InputArgs};
use super::output::{Failure, SOLVED, show};
use crate::io::Problem;
use lcp::Matrix;

/// The object that `--json` prints.
#[derive(Debug, Serialize)]
struct Facts {
    format: &'static str,
    kind: &'static str,
    n: usize,
    /// Pairs of the general problem that is solved.
    pairs: usize,
    matrices: Vec<MatrixFacts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    free: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contacts: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compliant_contacts: Option<usize>,
}

#[derive(Debug, Serialize)]
struct MatrixFacts {
    name: &'static str,
    storage: &'static str,
    rows: usize,
    cols: usize,
    nonzeros: usize,
    /// Smallest entry in size, besides zeros.
    smallest: f64,
    largest: f64,
    #[serde(flatten)]
    square: Option<SquareFacts>,
}

/// Properties of square matrices.
#[derive(Debug, Serialize)]
struct SquareFacts {
    order: usize,
    /// Largest `|v_ij - v_ji|` relative to the largest entry.
    asymmetry: f64,
    zero_diagonal: usize,
    negative_diagonal: usize,
}

pub(super) fn run(
    args: &InputArgs,
    input: &mut dyn Read,
    out: &mut dyn Write,
) -> Result<u8, Failure> {
    let facts = Facts::of(&args.read(input)?);
    show(out, args.json, &facts, || facts.report())?;
    Ok(SOLVED)
}

impl Facts {
    fn of(input: &Input) -> Self {
        let problem = &input.problem;
        let free = problem.boxed().map(|boxed| {
            let bounds = boxed.lower().iter().zip(boxed.upper());
            bounds.filter(|(l, u)| l.is_infinite() && u.is_infinite()).count()
        });
        let (contacts, compliant_contacts) = match problem {
            Problem::Friction(friction) => (Some(friction.contacts()), None),
            Problem::Contact(contact) => {
                let all = contact.compliance().iter();
                let count = all.filter(|pair| pair.iter().any(|a| *a > 0.0)).count();
                (Some(contact.points()), Some(count).filter(|count| *count > 0))
            }
            _ => (None, None),
        };
        Self {
            format: input.format,
            kind: problem.kind(),
            n: problem.order(),
            pairs: problem.to_general().order(),
            matrices: problem.matrices().iter().map(|(name, m)| MatrixFacts::of(name, m)).collect(),
            free,
            contacts,
            compliant_contacts,
        }
    }

    fn report(&self) -> String {
        let mut text = format!("{} of order {}, read as {}\n", self.kind, self.n, self.format);
        let _ = writeln!(text, "pairs of the general form: {}", self.pairs);
        let counts = [
            ("free variables", self.free),
            ("contacts", self.contacts),
            ("compliant contacts", self.compliant_contacts),
        ];
        for (what, count) in counts {
            let _ = count.map(|count| writeln!(text, "{what}: {count}"));
        }
        self.matrices.iter().for_each(|matrix| text += &matrix.report());
        text
    }
}

impl MatrixFacts {
    fn of(name: &'static str, matrix: &Matrix) -> Self {
        let (rows, cols) = (matrix.nrows(), matrix.ncols());
        let entries = || (0..cols).flat_map(|j| matrix.column(j).map(move |(i, v)| (i, j, v)));
        let sizes = || entries().map(|(_, _, v)| v.abs()).filter(|&v| v > 0.0);
        let largest = sizes().fold(0.0, f64::max);
        let square = (rows == cols).then(|| {
            let unlike = |(i, j, v)| f64::abs(v / largest - matrix[(j, i)] / largest);
            let diagonal = || (0..rows).map(|i| matrix[(i, i)]);
            SquareFacts {
                order: rows,
                asymmetry: entries().map(unlike).fold(0.0, f64::max),
                zero_diagonal: diagonal().filter(|&v| v == 0.0).count(),
                negative_diagonal: diagonal().filter(|&v| v < 0.0).count(),
            }
        });
        Self {
            name,
            storage: if matrix.is_sparse() { "sparse" } else { "dense" },
            rows,
            cols,
            nonzeros: sizes().count(),
            smallest: sizes().reduce(f64::min).unwrap_or(0.0),
            largest,
            square,
        }
    }

    fn report(&self) -> String {
        let Self { name, storage, rows, cols, nonzeros, smallest, largest, square } = self;
        let mut text = format!(
            "{name}: {rows} x {cols}, {storage}, {nonzeros} nonzeros of size {smallest:.1e} to {largest:.1e}"
        );
        if let Some(SquareFacts { asymmetry, zero_diagonal, negative_diagonal, .. }) = square {
            let symmetry = match *asymmetry {
                a if a <= f64::EPSILON => "symmetric".to_owned(),
                a => format!("not symmetric, by {a:.1e} of its largest entry"),
            };
            let _ = write!(
                text,
                ", {symmetry}; on the diagonal {zero_diagonal} zeros and {negative_diagonal} negative entries"
            );
        }
        text + "\n"
    }
}
