//! One column of a matrix, dense or sparse.

use faer::sparse::SparseColMat;

/// One column of a matrix.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Column<'a> {
    Dense(&'a [f64]),
    Sparse { rows: &'a [usize], values: &'a [f64] },
}

impl<'a> Column<'a> {
    /// The entries with their rows.
    pub(crate) fn entries(self) -> impl Iterator<Item = (usize, f64)> + 'a {
        let (dense, sparse) = match self {
            Self::Dense(values) => (Some(values.iter().copied().enumerate()), None),
            Self::Sparse { rows, values } => {
                (None, Some(rows.iter().copied().zip(values.iter().copied())))
            }
        };
        dense.into_iter().flatten().chain(sparse.into_iter().flatten())
    }

    /// `out += factor * column`.
    pub(crate) fn add_to(self, factor: f64, out: &mut [f64]) {
        match self {
            Self::Dense(values) => {
                out.iter_mut().zip(values).for_each(|(out, v)| *out += factor * v);
            }
            Self::Sparse { rows, values } => {
                rows.iter().zip(values).for_each(|(&i, v)| out[i] += factor * v);
            }
        }
    }

    /// `out += factor * column`, and `sizes` with absolute terms.
    pub(crate) fn add_with_sizes(self, factor: f64, out: &mut [f64], sizes: &mut [f64]) {
        self.for_each(|i, v| {
            let term = factor * v;
            out[i] += term;
            sizes[i] += term.abs();
        });
    }

    pub(crate) fn dot(self, x: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.for_each(|i, v| sum += v * x[i]);
        sum
    }

    pub(crate) fn for_each(self, mut f: impl FnMut(usize, f64)) {
        match self {
            Self::Dense(values) => values.iter().enumerate().for_each(|(i, &v)| f(i, v)),
            Self::Sparse { rows, values } => rows.iter().zip(values).for_each(|(&i, &v)| f(i, v)),
        }
    }

    pub(crate) fn single(self) -> Option<(usize, f64)> {
        let mut nonzero = self.entries().filter(|(_, v)| *v != 0.0);
        let first = nonzero.next()?;
        nonzero.next().is_none().then_some(first)
    }
}

/// The entries of a column.
#[inline]
pub(crate) fn column_of(
    matrix: &SparseColMat<usize, f64>,
    j: usize,
) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
    let pattern = matrix.symbolic();
    let range = pattern.col_range(j);
    pattern.row_idx()[range.clone()].iter().copied().zip(matrix.val()[range].iter().copied())
}

pub(crate) fn diagonal(matrix: &SparseColMat<usize, f64>) -> Vec<f64> {
    (0..matrix.ncols()).map(|j| matrix.get(j, j).copied().unwrap_or(0.0)).collect()
}

/// `out += factor * matrix * x`.
pub(crate) fn add_image(
    matrix: &SparseColMat<usize, f64>,
    factor: f64,
    x: &[f64],
    out: &mut [f64],
) {
    for (j, x) in x.iter().enumerate().filter(|(_, x)| **x != 0.0) {
        column_of(matrix, j).for_each(|(i, v)| out[i] += v * (factor * x));
    }
}
