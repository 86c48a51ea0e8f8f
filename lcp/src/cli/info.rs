//! `lcp info`.

use std::fmt::Write as _;
use std::io::Write;

use serde::Serialize;

use super::{Failure, InfoArgs, SOLVED, print, print_json};
use crate::Matrix;
use crate::io::{Format, Problem, ProblemFile};

/// What `--json` prints.
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
}

#[derive(Debug, Serialize)]
struct MatrixFacts {
    name: &'static str,
    storage: &'static str,
    order: usize,
    nonzeros: usize,
    /// Largest `|v_ij - v_ji|` relative to the largest entry.
    asymmetry: f64,
    /// Smallest entry in size, besides zeros.
    smallest: f64,
    largest: f64,
    zero_diagonal: usize,
    negative_diagonal: usize,
}

pub(super) fn run(args: &InfoArgs, out: &mut dyn Write) -> Result<u8, Failure> {
    let facts = Facts::of(&args.input.read()?);
    if args.input.json {
        print_json(out, &facts)?;
    } else {
        print(out, &facts.report())?;
    }
    Ok(SOLVED)
}

impl Facts {
    fn of(file: &ProblemFile) -> Self {
        let problem = &file.problem;
        let free = match problem {
            Problem::Mixed(mixed) => Some(mixed.free().iter().filter(|free| **free).count()),
            Problem::Boxed(boxed) => {
                let bounds = boxed.lower().iter().zip(boxed.upper());
                Some(bounds.filter(|(l, u)| l.is_infinite() && u.is_infinite()).count())
            }
            _ => None,
        };
        let contacts = match problem {
            Problem::Friction(friction) => Some(friction.contacts()),
            _ => None,
        };
        Self {
            format: Format::name(file.format),
            kind: problem.kind(),
            n: problem.order(),
            pairs: problem.to_general().order(),
            matrices: problem.matrices().into_iter().map(MatrixFacts::of).collect(),
            free,
            contacts,
        }
    }

    fn report(&self) -> String {
        let mut text = format!("{} of order {}, read as {}\n", self.kind, self.n, self.format);
        let _ = writeln!(text, "pairs of the general form: {}", self.pairs);
        if let Some(free) = self.free {
            let _ = writeln!(text, "free variables: {free}");
        }
        if let Some(contacts) = self.contacts {
            let _ = writeln!(text, "contacts: {contacts}");
        }
        self.matrices.iter().for_each(|matrix| text += &matrix.report());
        text
    }
}

impl MatrixFacts {
    fn of((name, matrix): (&'static str, &Matrix)) -> Self {
        let order = matrix.ncols();
        let entries = || (0..order).flat_map(|j| matrix.column(j).map(move |(i, v)| (i, j, v)));
        let sizes = || entries().map(|(_, _, v)| v.abs()).filter(|&v| v > 0.0);
        let largest = sizes().fold(0.0, f64::max);
        let skew = entries()
            .map(|(i, j, v)| (v / largest - matrix[(j, i)] / largest).abs())
            .fold(0.0, f64::max);
        let diagonal = || (0..order).map(|i| matrix[(i, i)]);
        Self {
            name,
            storage: if matrix.is_sparse() { "sparse" } else { "dense" },
            order,
            nonzeros: sizes().count(),
            asymmetry: skew,
            smallest: sizes().reduce(f64::min).unwrap_or(0.0),
            largest,
            zero_diagonal: diagonal().filter(|&v| v == 0.0).count(),
            negative_diagonal: diagonal().filter(|&v| v < 0.0).count(),
        }
    }

    fn report(&self) -> String {
        let Self { name, storage, order, nonzeros, smallest, largest, .. } = self;
        let symmetry = match self.asymmetry {
            a if a <= f64::EPSILON => "symmetric".to_owned(),
            a => format!("not symmetric, by {a:.1e} of its largest entry"),
        };
        format!(
            "{name}: {order} x {order}, {storage}, {nonzeros} nonzeros of size {smallest:.1e} to \
             {largest:.1e}, {symmetry}; on the diagonal {} zeros and {} negative entries\n",
            self.zero_diagonal, self.negative_diagonal
        )
    }
}
