//! Our JSON: one object with a `kind` and the fields of that kind.

mod array;
mod wrong;

use faer::sparse::SparseColMat;
use serde::{Deserialize, Serialize};
use serde_json::from_str;

use super::{Problem, ReadError};
use crate::{BoxedLcp, Contact2d, Friction2d, HorizontalLcp, Lcp, MixedLcp, Qp};
use array::Array;
use wrong::Wrong;

/// The field `kind`.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
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

/// What says which of the following a document is.
#[derive(Deserialize)]
struct Tag {
    kind: Kind,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Standard {
    kind: Kind,
    m: Array,
    q: Vec<f64>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Horizontal {
    kind: Kind,
    a: Array,
    b: Array,
    c: Vec<f64>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Mixed {
    kind: Kind,
    m: Array,
    q: Vec<f64>,
    free: Vec<bool>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Boxed {
    kind: Kind,
    m: Array,
    q: Vec<f64>,
    lower: Bounds,
    upper: Bounds,
}

/// Where there is no bound, it is `null`.
type Bounds = Vec<Option<f64>>;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Friction {
    kind: Kind,
    w: Array,
    q: Vec<f64>,
    mu: Vec<f64>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Contact {
    kind: Kind,
    k: Array,
    f: Vec<f64>,
    c_n: Array,
    c_t: Array,
    x_0: Vec<f64>,
    s_0: Vec<f64>,
    mu: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compliance: Option<Vec<[f64; 2]>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Program {
    kind: Kind,
    p: Array,
    q: Vec<f64>,
    a: Array,
    l: Bounds,
    u: Bounds,
    lower: Option<Bounds>,
    upper: Option<Bounds>,
    #[serde(default)]
    constant: f64,
}

pub(super) fn read(text: &str) -> Result<Problem, ReadError> {
    problem(text).map_err(|wrong| wrong.in_text(text))
}

fn problem(text: &str) -> Result<Problem, Wrong> {
    let Tag { kind } = from_str(text)?;
    Ok(match kind {
        Kind::Lcp => {
            let Standard { m, q, .. } = from_str(text)?;
            Problem::Lcp(Lcp::new(m.square("m", q.len())?, q)?)
        }
        Kind::Horizontal => {
            let Horizontal { a, b, c, .. } = from_str(text)?;
            let (a, b) = (a.square("a", c.len())?, b.square("b", c.len())?);
            Problem::Horizontal(HorizontalLcp::new(a, b, c)?)
        }
        Kind::Mixed => {
            let Mixed { m, q, free, .. } = from_str(text)?;
            Problem::Mixed(MixedLcp::new(m.square("m", q.len())?, q, free)?)
        }
        Kind::Boxed => {
            let Boxed { m, q, lower, upper, .. } = from_str(text)?;
            let (lower, upper) = (or(lower, f64::NEG_INFINITY), or(upper, f64::INFINITY));
            Problem::Boxed(BoxedLcp::new(m.square("m", q.len())?, q, lower, upper)?)
        }
        Kind::Friction => {
            let Friction { w, q, mu, .. } = from_str(text)?;
            Problem::Friction(Friction2d::new(w.square("w", q.len())?, q, mu)?)
        }
        Kind::Contact => {
            let Contact { k, f, c_n, c_t, x_0, s_0, mu, compliance, .. } = from_str(text)?;
            let (n, points) = (f.len(), mu.len());
            let (c_n, c_t) = (c_n.sized("c_n", points, n)?, c_t.sized("c_t", points, n)?);
            let hard = Contact2d::new(k.square("k", n)?, f, c_n, c_t, x_0, s_0, mu)?;
            Problem::Contact(match compliance {
                Some(compliance) => hard.with_compliance(compliance)?,
                None => hard,
            })
        }
        Kind::Qp => {
            let Program { p, q, a, l, u, lower, upper, constant, .. } = from_str(text)?;
            let (p, a) = (p.square("p", q.len())?, a.sized("a", l.len(), q.len())?);
            let [lower, upper] = [lower, upper].map(|it| it.unwrap_or(vec![None; q.len()]));
            let program = Qp::new(p, q, a, or(l, f64::NEG_INFINITY), or(u, f64::INFINITY))?;
            let (lower, upper) = (or(lower, f64::NEG_INFINITY), or(upper, f64::INFINITY));
            Problem::Qp(program.with_bounds(lower, upper)?.with_constant(constant))
        }
    })
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

/// In the form of our JSON.
impl Serialize for Problem {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Lcp(it) => {
                Standard { kind: Kind::Lcp, m: it.m().into(), q: it.q().into() }.serialize(to)
            }
            Self::Horizontal(it) => {
                let (a, b) = (it.a().into(), it.b().into());
                Horizontal { kind: Kind::Horizontal, a, b, c: it.c().into() }.serialize(to)
            }
            Self::Mixed(it) => {
                let (m, q) = (it.m().into(), it.q().into());
                Mixed { kind: Kind::Mixed, m, q, free: it.free().into() }.serialize(to)
            }
            Self::Boxed(it) => {
                let [lower, upper] = [it.lower(), it.upper()].map(finite);
                Boxed { kind: Kind::Boxed, m: it.m().into(), q: it.q().into(), lower, upper }
                    .serialize(to)
            }
            Self::Friction(it) => {
                let (w, mu) = (it.w().into(), it.mu().into());
                Friction { kind: Kind::Friction, w, q: it.q().into(), mu }.serialize(to)
            }
            Self::Qp(it) => {
                let [l, u] = it.row_bounds().map(finite);
                let [lower, upper] = it.bounds().map(finite).map(Some);
                Program {
                    kind: Kind::Qp,
                    p: it.p().into(),
                    q: it.q().into(),
                    a: it.a().into(),
                    l,
                    u,
                    lower,
                    upper,
                    constant: it.constant(),
                }
                .serialize(to)
            }
            Self::Contact(it) => {
                let array = |m: &SparseColMat<usize, f64>| Array::from(&m.clone().into());
                let is_compliant = it.compliance().iter().flatten().any(|a| *a > 0.0);
                Contact {
                    kind: Kind::Contact,
                    k: array(it.stiffness()),
                    f: it.loads().into(),
                    c_n: array(it.normal()),
                    c_t: array(it.tangent()),
                    x_0: it.initial_gaps().into(),
                    s_0: it.initial_slips().into(),
                    mu: it.mu().into(),
                    compliance: is_compliant.then(|| it.compliance().into()),
                }
                .serialize(to)
            }
        }
    }
}

fn or(bounds: Bounds, none: f64) -> Vec<f64> {
    bounds.into_iter().map(|bound| bound.unwrap_or(none)).collect()
}

fn finite(bounds: &[f64]) -> Bounds {
    bounds.iter().map(|bound| Some(*bound).filter(|bound| bound.is_finite())).collect()
}
