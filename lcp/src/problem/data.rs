//! Problems as data: serialised as what they were made from, and checked again when they are read.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{BoxedLcp, Contact2d, Friction2d, HorizontalLcp, Lcp, MixedLcp, Qp};
use crate::Matrix;

/// The entries of a matrix, of a dense one all but zeros.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stored {
    rows: usize,
    columns: usize,
    is_sparse: bool,
    entries: Vec<(usize, usize, f64)>,
}

impl Serialize for Matrix {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (rows, columns, is_sparse) = (self.nrows(), self.ncols(), self.is_sparse());
        let column = |j| self.column(j).map(move |(i, v)| (i, j, v));
        let entries = (0..columns).flat_map(column).filter(|(_, _, v)| is_sparse || *v != 0.0);
        Stored { rows, columns, is_sparse, entries: entries.collect() }.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Matrix {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let Stored { rows, columns, is_sparse, entries } = Stored::deserialize(from)?;
        let sparse = Self::from_triplets(rows, columns, &entries).map_err(D::Error::custom)?;
        Ok(if is_sparse { sparse } else { sparse.to_dense().into() })
    }
}

/// A bound that does not exist is `None`.
type Bounds = Vec<Option<f64>>;

fn finite(bounds: &[f64]) -> Bounds {
    bounds.iter().map(|bound| Some(*bound).filter(|bound| bound.is_finite())).collect()
}

fn or(none: f64, bounds: Bounds) -> Vec<f64> {
    bounds.into_iter().map(|bound| bound.unwrap_or(none)).collect()
}

const LOWER: f64 = f64::NEG_INFINITY;
const UPPER: f64 = f64::INFINITY;

/// Serialises a problem as these fields, and makes it from them.
macro_rules! serialised {
    ($problem:ident { $($field:ident: $type:ty = $get:expr),+ $(,)? } by $new:expr) => {
        const _: () = {
            #[derive(Serialize, Deserialize)]
            #[serde(deny_unknown_fields)]
            struct Data {
                $($field: $type),+
            }

            impl Serialize for $problem {
                fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                    fn part<P, T>(problem: &P, get: impl Fn(&P) -> T) -> T {
                        get(problem)
                    }
                    Data { $($field: part(self, $get)),+ }.serialize(to)
                }
            }

            impl<'de> Deserialize<'de> for $problem {
                fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                    let Data { $($field),+ } = Data::deserialize(from)?;
                    $new.map_err(D::Error::custom)
                }
            }
        };
    };
}

serialised!(Lcp {
    m: Matrix = |it| it.m().clone(),
    q: Vec<f64> = |it| it.q().to_vec(),
} by Lcp::new(m, q));

serialised!(HorizontalLcp {
    a: Matrix = |it| it.a().clone(),
    b: Matrix = |it| it.b().clone(),
    c: Vec<f64> = |it| it.c().to_vec(),
} by HorizontalLcp::new(a, b, c));

serialised!(MixedLcp {
    m: Matrix = |it| it.m().clone(),
    q: Vec<f64> = |it| it.q().to_vec(),
    free: Vec<bool> = |it| it.free().to_vec(),
} by MixedLcp::new(m, q, free));

serialised!(BoxedLcp {
    m: Matrix = |it| it.m().clone(),
    q: Vec<f64> = |it| it.q().to_vec(),
    lower: Bounds = |it| finite(it.lower()),
    upper: Bounds = |it| finite(it.upper()),
} by BoxedLcp::new(m, q, or(LOWER, lower), or(UPPER, upper)));

serialised!(Friction2d {
    w: Matrix = |it| it.w().clone(),
    q: Vec<f64> = |it| it.q().to_vec(),
    mu: Vec<f64> = |it| it.mu().to_vec(),
} by Friction2d::new(w, q, mu));

serialised!(Contact2d {
    k: Matrix = |it| it.stiffness().clone().into(),
    f: Vec<f64> = |it| it.loads().to_vec(),
    c_n: Matrix = |it| it.normal().clone().into(),
    c_t: Matrix = |it| it.tangent().clone().into(),
    x_0: Vec<f64> = |it| it.initial_gaps().to_vec(),
    s_0: Vec<f64> = |it| it.initial_slips().to_vec(),
    mu: Vec<f64> = |it| it.mu().to_vec(),
    compliance: Vec<[f64; 2]> = |it| it.compliance().to_vec(),
} by Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu).and_then(|it| it.with_compliance(compliance)));

serialised!(Qp {
    p: Matrix = |it| it.p().clone(),
    q: Vec<f64> = |it| it.q().to_vec(),
    a: Matrix = |it| it.a().clone(),
    l: Bounds = |it| finite(it.row_bounds()[0]),
    u: Bounds = |it| finite(it.row_bounds()[1]),
    lower: Bounds = |it| finite(it.bounds()[0]),
    upper: Bounds = |it| finite(it.bounds()[1]),
    constant: f64 = Qp::constant,
} by Qp::new(p, q, a, or(LOWER, l), or(UPPER, u))
    .and_then(|it| it.with_bounds(or(LOWER, lower), or(UPPER, upper)))
    .map(|it| it.with_constant(constant)));
