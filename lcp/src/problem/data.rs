//! Problems as data: serialised as the data from which they were made, and checked again when read. In JSON the data
//! have the form of the files of the crate `lcp-problems`, which have a `kind` as well.

use std::fmt;

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{DeserializeOwned, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{BoxedLcp, Contact2d, Friction2d, HorizontalLcp, Lcp, MixedLcp, Qp};
use crate::{Error, Matrix};

/// A problem that is made from data.
pub trait Stored: Sized {
    /// Its fields, and a `kind` that is ignored.
    type Data: DeserializeOwned;

    /// Makes the problem from such data.
    ///
    /// # Errors
    /// The errors of its constructor.
    fn from_data(data: Self::Data) -> Result<Self, Error>;
}

/// A matrix by its rows if it is dense, or by its entries.
#[derive(Serialize)]
#[serde(untagged)]
enum Entries {
    Rows(Vec<Vec<f64>>),
    Sparse(SparseEntries),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SparseEntries {
    rows: usize,
    cols: usize,
    triplets: Vec<(usize, usize, f64)>,
}

impl Entries {
    fn of(matrix: &Matrix) -> Self {
        let (rows, cols) = (matrix.nrows(), matrix.ncols());
        if matrix.is_sparse() {
            let column = |j| matrix.column(j).map(move |(i, v)| (i, j, v));
            let triplets = (0..cols).flat_map(column).collect();
            return Self::Sparse(SparseEntries { rows, cols, triplets });
        }
        let row = |i| (0..cols).map(|j| matrix[(i, j)]).collect();
        Self::Rows((0..rows).map(row).collect())
    }

    /// The matrix, which must have this size; nothing is allocated for a matrix of another size.
    fn sized(self, what: &'static str, height: usize, width: usize) -> Result<Matrix, Error> {
        let (rows, cols) = match &self {
            Self::Rows(rows) => (rows.len(), rows.first().map_or(width, Vec::len)),
            Self::Sparse(SparseEntries { rows, cols, .. }) => (*rows, *cols),
        };
        if (rows, cols) != (height, width) {
            let (expected_rows, expected_cols) = (height, width);
            return Err(Error::Shape { what, rows, cols, expected_rows, expected_cols });
        }
        match self {
            Self::Rows(rows) if rows.is_empty() => Ok(faer::Mat::zeros(0, width).into()),
            Self::Rows(rows) => Matrix::from_rows(&rows),
            Self::Sparse(it) => Matrix::from_triplets(height, width, &it.triplets),
        }
    }
}

/// Reads rows or entries, distinguished by the first character, so that errors have their places.
impl<'de> Deserialize<'de> for Entries {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Either;

        impl<'de> Visitor<'de> for Either {
            type Value = Entries;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("rows of numbers, or an object with `rows`, `cols` and `triplets`")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, rows: A) -> Result<Entries, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(rows)).map(Entries::Rows)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Entries, A::Error> {
                SparseEntries::deserialize(MapAccessDeserializer::new(map)).map(Entries::Sparse)
            }
        }

        from.deserialize_any(Either)
    }
}

/// A bound that does not exist is `None`.
type OptionalBounds = Vec<Option<f64>>;

fn finite(bounds: &[f64]) -> OptionalBounds {
    bounds.iter().map(|bound| Some(*bound).filter(|bound| bound.is_finite())).collect()
}

fn without_lower(bounds: OptionalBounds) -> Vec<f64> {
    bounds.into_iter().map(|bound| bound.unwrap_or(f64::NEG_INFINITY)).collect()
}

fn without_upper(bounds: OptionalBounds) -> Vec<f64> {
    bounds.into_iter().map(|bound| bound.unwrap_or(f64::INFINITY)).collect()
}

/// Serialises a problem as these fields, and makes the problem from them.
macro_rules! serialised {
    ($problem:ident {
        $($(#[$attribute:meta])* $field:ident: $type:ty = $get:expr),+ $(,)?
    } by $new:expr) => {
        const _: () = {
            #[derive(Serialize, Deserialize)]
            #[serde(deny_unknown_fields)]
            pub struct Data {
                #[serde(rename = "kind", default, skip_serializing)]
                _kind: IgnoredAny,
                $($(#[$attribute])* $field: $type),+
            }

            impl Stored for $problem {
                type Data = Data;

                fn from_data(data: Data) -> Result<Self, Error> {
                    let Data { _kind, $($field),+ } = data;
                    $new
                }
            }

            impl Serialize for $problem {
                fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                    fn part<P, T>(problem: &P, get: impl Fn(&P) -> T) -> T {
                        get(problem)
                    }
                    Data { _kind: IgnoredAny, $($field: part(self, $get)),+ }.serialize(to)
                }
            }

            impl<'de> Deserialize<'de> for $problem {
                fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                    Self::from_data(Data::deserialize(from)?).map_err(D::Error::custom)
                }
            }
        };
    };
}

serialised!(Lcp {
    m: Entries = |it| Entries::of(it.m()),
    q: Vec<f64> = |it| it.q().to_vec(),
} by Lcp::new(m.sized("M", q.len(), q.len())?, q));

serialised!(HorizontalLcp {
    a: Entries = |it| Entries::of(it.a()),
    b: Entries = |it| Entries::of(it.b()),
    c: Vec<f64> = |it| it.c().to_vec(),
} by HorizontalLcp::new(a.sized("A", c.len(), c.len())?, b.sized("B", c.len(), c.len())?, c));

serialised!(MixedLcp {
    m: Entries = |it| Entries::of(it.m()),
    q: Vec<f64> = |it| it.q().to_vec(),
    free: Vec<bool> = |it| it.free().to_vec(),
} by MixedLcp::new(m.sized("M", q.len(), q.len())?, q, free));

serialised!(BoxedLcp {
    m: Entries = |it| Entries::of(it.m()),
    q: Vec<f64> = |it| it.q().to_vec(),
    lower: OptionalBounds = |it| finite(it.lower()),
    upper: OptionalBounds = |it| finite(it.upper()),
} by BoxedLcp::new(m.sized("M", q.len(), q.len())?, q, without_lower(lower), without_upper(upper)));

serialised!(Friction2d {
    w: Entries = |it| Entries::of(it.w()),
    q: Vec<f64> = |it| it.q().to_vec(),
    mu: Vec<f64> = |it| it.mu().to_vec(),
} by Friction2d::new(w.sized("W", q.len(), q.len())?, q, mu));

serialised!(Contact2d {
    k: Entries = |it| Entries::of(&it.stiffness().clone().into()),
    c_n: Entries = |it| Entries::of(&it.normal().clone().into()),
    c_t: Entries = |it| Entries::of(&it.tangent().clone().into()),
    f: Vec<f64> = |it| it.loads().to_vec(),
    x_0: Vec<f64> = |it| it.initial_gaps().to_vec(),
    s_0: Vec<f64> = |it| it.initial_slips().to_vec(),
    mu: Vec<f64> = |it| it.mu().to_vec(),
    #[serde(default, skip_serializing_if = "Option::is_none")]
    compliance: Option<Vec<[f64; 2]>> = |it| {
        let is_compliant = it.compliance().iter().flatten().any(|a| *a > 0.0);
        is_compliant.then(|| it.compliance().to_vec())
    },
} by {
    let (n, points) = (f.len(), mu.len());
    let [c_n, c_t] = [c_n.sized("C_n", points, n)?, c_t.sized("C_t", points, n)?];
    let hard = Contact2d::new(k.sized("K", n, n)?, f, c_n, c_t, x_0, s_0, mu)?;
    match compliance {
        Some(compliance) => hard.with_compliance(compliance),
        None => Ok(hard),
    }
});

serialised!(Qp {
    p: Entries = |it| Entries::of(it.p()),
    a: Entries = |it| Entries::of(it.a()),
    q: Vec<f64> = |it| it.q().to_vec(),
    l: OptionalBounds = |it| finite(it.row_bounds()[0]),
    u: OptionalBounds = |it| finite(it.row_bounds()[1]),
    #[serde(default)]
    lower: Option<OptionalBounds> = |it| Some(finite(it.bounds()[0])),
    #[serde(default)]
    upper: Option<OptionalBounds> = |it| Some(finite(it.bounds()[1])),
    #[serde(default)]
    constant: f64 = Qp::constant,
} by {
    let (n, rows) = (q.len(), l.len());
    let (p, a) = (p.sized("P", n, n)?, a.sized("A", rows, n)?);
    let program = Qp::new(p, q, a, without_lower(l), without_upper(u))?;
    let [lower, upper] = [lower, upper].map(|bounds| bounds.unwrap_or(vec![None; n]));
    let program = program.with_bounds(without_lower(lower), without_upper(upper))?;
    program.with_constant(constant)
});
