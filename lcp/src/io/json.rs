//! Our JSON.

mod fields;
mod kind;
mod write;

use fields::Fields;
use kind::Kind;
use serde::Deserialize;
use serde_json::value::RawValue;

use super::{Problem, ReadError};
use crate::Contact2d;

pub use write::to_json;

/// The fields of all kinds, as they stand in the text, so that every error has its place.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document<'a> {
    kind: Kind,
    #[serde(borrow)]
    m: Option<&'a RawValue>,
    #[serde(borrow)]
    q: Option<&'a RawValue>,
    #[serde(borrow)]
    a: Option<&'a RawValue>,
    #[serde(borrow)]
    b: Option<&'a RawValue>,
    #[serde(borrow)]
    c: Option<&'a RawValue>,
    #[serde(borrow)]
    free: Option<&'a RawValue>,
    #[serde(borrow)]
    lower: Option<&'a RawValue>,
    #[serde(borrow)]
    upper: Option<&'a RawValue>,
    #[serde(borrow)]
    w: Option<&'a RawValue>,
    #[serde(borrow)]
    mu: Option<&'a RawValue>,
    #[serde(borrow)]
    k: Option<&'a RawValue>,
    #[serde(borrow)]
    f: Option<&'a RawValue>,
    #[serde(borrow)]
    c_n: Option<&'a RawValue>,
    #[serde(borrow)]
    c_t: Option<&'a RawValue>,
    #[serde(borrow)]
    x_0: Option<&'a RawValue>,
    #[serde(borrow)]
    s_0: Option<&'a RawValue>,
    #[serde(borrow)]
    compliance: Option<&'a RawValue>,
}

pub(super) fn read(text: &str) -> Result<Problem, ReadError> {
    let document: Document<'_> =
        serde_json::from_str(text).map_err(|error| fields::whole(&error))?;
    let mut fields = Fields::new(
        text,
        document.kind,
        [
            ("m", document.m),
            ("q", document.q),
            ("a", document.a),
            ("b", document.b),
            ("c", document.c),
            ("free", document.free),
            ("lower", document.lower),
            ("upper", document.upper),
            ("w", document.w),
            ("mu", document.mu),
            ("k", document.k),
            ("f", document.f),
            ("c_n", document.c_n),
            ("c_t", document.c_t),
            ("x_0", document.x_0),
            ("s_0", document.s_0),
            ("compliance", document.compliance),
        ],
    );
    let problem = match document.kind {
        Kind::Lcp => {
            let q = fields.vector("q")?;
            let m = fields.matrix("m", q.len())?;
            Problem::lcp(m, q, fields.begin())
        }
        Kind::Horizontal => {
            let c = fields.vector("c")?;
            let a = fields.matrix("a", c.len())?;
            let b = fields.matrix("b", c.len())?;
            Problem::horizontal(a, b, c, fields.begin())
        }
        Kind::Mixed => {
            let q = fields.vector("q")?;
            let m = fields.matrix("m", q.len())?;
            let free = fields.list("free", q.len())?;
            Problem::mixed(m, q, free, fields.begin())
        }
        Kind::Boxed => {
            let q = fields.vector("q")?;
            let m = fields.matrix("m", q.len())?;
            let lower = fields.bounds("lower", q.len(), f64::NEG_INFINITY)?;
            let upper = fields.bounds("upper", q.len(), f64::INFINITY)?;
            Problem::boxed(m, q, lower, upper, fields.begin())
        }
        Kind::Friction => {
            let mu = fields.frictions("mu")?;
            let q = fields.list("q", 2 * mu.len())?;
            let w = fields.matrix("w", q.len())?;
            Problem::friction(w, q, mu, fields.begin())
        }
        Kind::Contact => {
            let f = fields.vector("f")?;
            let mu = fields.frictions("mu")?;
            let k = fields.matrix("k", f.len())?;
            let [c_n, c_t] = ["c_n", "c_t"].map(|name| fields.matrix_of(name, mu.len(), f.len()));
            let [x_0, s_0] = ["x_0", "s_0"].map(|name| fields.list(name, mu.len()));
            let compliance = fields.list_if_any("compliance", mu.len())?;
            let problem = Contact2d::new(k, f, c_n?, c_t?, x_0?, s_0?, mu);
            Problem::contact(problem, compliance, fields.begin())
        }
    }?;
    fields.none_left()?;
    Ok(problem)
}
