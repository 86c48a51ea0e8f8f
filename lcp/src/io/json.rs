//! Our JSON: one object with a `kind` and the fields of that kind.

mod document;

use serde::Deserialize;

use super::{Problem, ReadError};
use crate::{BoxedLcp, Contact2d, Friction2d, HorizontalLcp, Lcp, MixedLcp, Qp};
use document::{Document, parsed};

/// What says which fields a document has.
#[derive(Deserialize)]
struct Tag {
    kind: Kind,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Lcp,
    Horizontal,
    Mixed,
    Boxed,
    Friction,
    Contact,
    Qp,
}

impl Kind {
    fn fields(self) -> &'static [&'static str] {
        match self {
            Self::Lcp => &["kind", "m", "q"],
            Self::Horizontal => &["kind", "a", "b", "c"],
            Self::Mixed => &["kind", "m", "q", "free"],
            Self::Boxed => &["kind", "m", "q", "lower", "upper"],
            Self::Friction => &["kind", "w", "q", "mu"],
            Self::Contact => &["kind", "k", "f", "c_n", "c_t", "x_0", "s_0", "mu", "compliance"],
            Self::Qp => &["kind", "p", "q", "a", "l", "u", "lower", "upper", "constant"],
        }
    }
}

/// Where there is no bound, it is `null`.
type Bounds = Vec<Option<f64>>;

pub(super) fn read(text: &str) -> Result<Problem, ReadError> {
    let Tag { kind } = parsed(text, text)?;
    let it = Document::of(text, kind.fields())?;
    let vector = |name| it.value::<Vec<f64>>(name);
    let or = |bounds: Bounds, none: f64| -> Vec<f64> {
        bounds.into_iter().map(|bound| bound.unwrap_or(none)).collect()
    };
    let lower = |bounds| or(bounds, f64::NEG_INFINITY);
    let upper = |bounds| or(bounds, f64::INFINITY);
    let problem = match kind {
        Kind::Lcp => {
            let q = vector("q")?;
            Lcp::new(it.square("m", q.len())?, q).map(Problem::Lcp)
        }
        Kind::Horizontal => {
            let c = vector("c")?;
            let (a, b) = (it.square("a", c.len())?, it.square("b", c.len())?);
            HorizontalLcp::new(a, b, c).map(Problem::Horizontal)
        }
        Kind::Mixed => {
            let q = vector("q")?;
            MixedLcp::new(it.square("m", q.len())?, q, it.value("free")?).map(Problem::Mixed)
        }
        Kind::Boxed => {
            let q = vector("q")?;
            let (l, u) = (lower(it.value("lower")?), upper(it.value("upper")?));
            BoxedLcp::new(it.square("m", q.len())?, q, l, u).map(Problem::Boxed)
        }
        Kind::Friction => {
            let q = vector("q")?;
            Friction2d::new(it.square("w", q.len())?, q, vector("mu")?).map(Problem::Friction)
        }
        Kind::Contact => {
            let (f, mu) = (vector("f")?, vector("mu")?);
            let (n, points) = (f.len(), mu.len());
            let (c_n, c_t) = (it.matrix("c_n", points, n)?, it.matrix("c_t", points, n)?);
            let (k, x_0, s_0) = (it.square("k", n)?, vector("x_0")?, vector("s_0")?);
            let compliance = it.optional("compliance")?.unwrap_or(vec![[0.0; 2]; points]);
            let hard = Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu);
            hard.and_then(|hard| hard.with_compliance(compliance)).map(Problem::Contact)
        }
        Kind::Qp => {
            let (q, l, u) = (vector("q")?, lower(it.value("l")?), upper(it.value("u")?));
            let (n, m) = (q.len(), l.len());
            let bounds = |name| Ok(it.optional(name)?.unwrap_or(vec![None; n]));
            let (least, most) = (lower(bounds("lower")?), upper(bounds("upper")?));
            let constant = it.optional("constant")?.unwrap_or(0.0);
            let program = Qp::new(it.square("p", n)?, q, it.matrix("a", m, n)?, l, u);
            let program = program.and_then(|program| program.with_bounds(least, most));
            program.and_then(|program| program.with_constant(constant)).map(Problem::Qp)
        }
    };
    problem.map_err(|source| it.refused(source))
}

/// A problem as JSON text that [`read`](crate::io::read) gives back, to the last digit.
///
/// ```
/// use lcp::io::{read, to_json};
/// let file = read(b"1  2  -1", None)?;
/// let json = to_json(&file.problem);
/// assert_eq!(json, r#"{"kind":"lcp","m":[[2.0]],"q":[-1.0]}"#);
/// assert_eq!(to_json(&read(json.as_bytes(), None)?.problem), json);
/// # Ok::<(), lcp::io::ReadError>(())
/// ```
pub fn to_json(problem: &Problem) -> String {
    serde_json::to_string(problem).unwrap_or_else(|e| unreachable!("numbers and lists: {e}"))
}
