//! Problems as our JSON.

use std::fmt::{Display, Write};

use crate::io::Problem;
use crate::{Contact2d, Matrix};

/// A problem as JSON text that [`read`](crate::io::read) gives back, to the last digit.
///
/// ```
/// use lcp::io::{read, to_json};
/// let file = read(b"1  2  -1", None)?;
/// let json = to_json(&file.problem);
/// assert_eq!(json, "{\n  \"kind\": \"lcp\",\n  \"m\": [\n    [2.0]\n  ],\n  \"q\": [-1.0]\n}\n");
/// assert_eq!(to_json(&read(json.as_bytes(), None)?.problem), json);
/// # Ok::<(), lcp::io::ReadError>(())
/// ```
pub fn to_json(problem: &Problem) -> String {
    let fields = match problem {
        Problem::Lcp(problem) => {
            vec![("m", matrix(problem.m())), ("q", numbers(problem.q()))]
        }
        Problem::Horizontal(problem) => vec![
            ("a", matrix(problem.a())),
            ("b", matrix(problem.b())),
            ("c", numbers(problem.c())),
        ],
        Problem::Mixed(problem) => vec![
            ("m", matrix(problem.m())),
            ("q", numbers(problem.q())),
            ("free", list(problem.free().iter(), ", ")),
        ],
        Problem::Boxed(problem) => vec![
            ("m", matrix(problem.m())),
            ("q", numbers(problem.q())),
            ("lower", numbers(problem.lower())),
            ("upper", numbers(problem.upper())),
        ],
        Problem::Friction(problem) => vec![
            ("w", matrix(problem.w())),
            ("q", numbers(problem.q())),
            ("mu", numbers(problem.mu())),
        ],
        Problem::Contact(problem) => [
            ("k", matrix(&problem.stiffness().clone().into())),
            ("f", numbers(problem.loads())),
            ("c_n", matrix(&problem.normal().clone().into())),
            ("c_t", matrix(&problem.tangent().clone().into())),
            ("x_0", numbers(problem.initial_gaps())),
            ("s_0", numbers(problem.initial_slips())),
            ("mu", numbers(problem.mu())),
        ]
        .into_iter()
        .chain(compliance(problem).map(|pairs| ("compliance", pairs)))
        .collect(),
    };
    let mut out = format!("{{\n  \"kind\": \"{}\"", problem.kind());
    for (name, value) in fields {
        let _ = write!(out, ",\n  \"{name}\": {value}");
    }
    out + "\n}\n"
}

fn matrix(matrix: &Matrix) -> String {
    let (rows, cols) = (matrix.nrows(), matrix.ncols());
    if matrix.is_sparse() {
        let of_column =
            |j| matrix.column(j).map(move |(i, v)| format!("\n      [{i}, {j}, {v:?}]"));
        let triplets = list((0..cols).flat_map(of_column), ",");
        return format!("{{\"rows\": {rows}, \"cols\": {cols}, \"triplets\": {triplets}}}");
    }
    let row = |i| list((0..cols).map(|j| Number(matrix[(i, j)])), ", ");
    let rows: Vec<String> = (0..rows).map(|i| format!("\n    {}", row(i))).collect();
    if rows.is_empty() { "[]".to_owned() } else { format!("[{}\n  ]", rows.join(",")) }
}

/// The compliances, if any contact has one.
fn compliance(problem: &Contact2d) -> Option<String> {
    let all = problem.compliance();
    let is_compliant = all.iter().flatten().any(|a| *a > 0.0);
    is_compliant.then(|| list(all.iter().map(|pair| numbers(pair)), ", "))
}

fn numbers(values: &[f64]) -> String {
    list(values.iter().map(|&v| Number(v)), ", ")
}

fn list(items: impl Iterator<Item = impl Display>, separator: &str) -> String {
    let items: Vec<String> = items.map(|item| item.to_string()).collect();
    format!("[{}]", items.join(separator))
}

/// A number with all its digits; `null` where it is infinite.
struct Number(f64);

impl Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0.is_finite() { write!(f, "{:?}", self.0) } else { f.write_str("null") }
    }
}
