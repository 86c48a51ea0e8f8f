//! Matrices in JSON: an array of rows, or triplets.

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::wrong::{Step, Wrong};
use crate::Matrix;

/// A matrix as it stands in the text, whose sizes are not compared with anything yet.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Array {
    Rows(Vec<Vec<f64>>),
    Sparse(Sparse),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sparse {
    rows: usize,
    cols: usize,
    triplets: Vec<(usize, usize, f64)>,
}

/// By its first sign, so that errors keep their places.
impl<'de> Deserialize<'de> for Array {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Form;
        impl<'de> Visitor<'de> for Form {
            type Value = Array;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("an array of rows, or an object with `rows`, `cols` and `triplets`")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, rows: A) -> Result<Array, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(rows)).map(Array::Rows)
            }

            fn visit_map<A: MapAccess<'de>>(self, fields: A) -> Result<Array, A::Error> {
                Deserialize::deserialize(MapAccessDeserializer::new(fields)).map(Array::Sparse)
            }
        }
        from.deserialize_any(Form)
    }
}

impl From<&Matrix> for Array {
    fn from(matrix: &Matrix) -> Self {
        let (rows, cols) = (matrix.nrows(), matrix.ncols());
        if matrix.is_sparse() {
            let of_column = |j| matrix.column(j).map(move |(i, v)| (i, j, v));
            return Self::Sparse(Sparse {
                rows,
                cols,
                triplets: (0..cols).flat_map(of_column).collect(),
            });
        }
        let row = |i| (0..cols).map(|j| matrix[(i, j)]).collect();
        Self::Rows((0..rows).map(row).collect())
    }
}

impl Array {
    pub(super) fn square(self, name: &'static str, order: usize) -> Result<Matrix, Wrong> {
        self.sized(name, order, order)
    }

    /// The matrix of that size; nothing is allocated for another one.
    pub(super) fn sized(
        self,
        name: &'static str,
        height: usize,
        width: usize,
    ) -> Result<Matrix, Wrong> {
        let fits = |path: &[Step], what: &str, length: usize, expected: usize| {
            if length == expected {
                return Ok(());
            }
            let message = format!(
                "`{name}` has {length} {what}, but must have {expected}, to fit the vectors"
            );
            Err(Wrong::at(path, message))
        };
        let whole = [Step::Field(name)];
        match self {
            Self::Rows(rows) => {
                fits(&whole, "rows", rows.len(), height)?;
                for (i, row) in rows.iter().enumerate() {
                    let what = format!("entries in row {i}");
                    fits(&[Step::Field(name), Step::Item(i)], &what, row.len(), width)?;
                }
                Ok(faer::Mat::from_fn(height, width, |i, j| rows[i][j]).into())
            }
            Self::Sparse(Sparse { rows, cols, triplets }) => {
                fits(&whole, "rows", rows, height)?;
                fits(&whole, "columns", cols, width)?;
                let outside = triplets.iter().position(|(i, j, _)| *i >= height || *j >= width);
                if let Some(k) = outside {
                    let (row, col, _) = triplets[k];
                    let message =
                        format!("entry [{row}, {col}] of `{name}` is outside {height} x {width}");
                    let path = [Step::Field(name), Step::Field("triplets"), Step::Item(k)];
                    return Err(Wrong::at(&path, message));
                }
                Ok(Matrix::from_entries(height, width, triplets.into_iter()))
            }
        }
    }
}
