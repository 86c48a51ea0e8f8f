//! The dense or the sparse kernel, as the problem asks for.

use super::dense::Dense;
use super::kernel::{Kernel, Var};
use super::sparse::Sparse;

/// The kernel that fits the problem.
pub(super) enum AnyKernel<'a> {
    Dense(Box<Dense<'a>>),
    Sparse(Box<Sparse<'a>>),
}

/// A row of either kernel.
pub(super) enum AnyRow {
    Dense(<Dense<'static> as Kernel>::Row),
    Sparse(<Sparse<'static> as Kernel>::Row),
}

impl Kernel for AnyKernel<'_> {
    type Row = AnyRow;

    fn right_hand_side(&self) -> &[f64] {
        match self {
            Self::Dense(kernel) => kernel.right_hand_side(),
            Self::Sparse(kernel) => kernel.right_hand_side(),
        }
    }

    fn add_start_column(&self, var: Var, factor: f64, out: &mut [f64]) {
        match self {
            Self::Dense(kernel) => kernel.add_start_column(var, factor, out),
            Self::Sparse(kernel) => kernel.add_start_column(var, factor, out),
        }
    }

    fn column(&mut self, var: Var, out: &mut [f64]) {
        match self {
            Self::Dense(kernel) => kernel.column(var, out),
            Self::Sparse(kernel) => kernel.column(var, out),
        }
    }

    fn exchange(&mut self, row: usize, entering: Var, leaving: Var, column: &[f64]) {
        match self {
            Self::Dense(kernel) => kernel.exchange(row, entering, leaving, column),
            Self::Sparse(kernel) => kernel.exchange(row, entering, leaving, column),
        }
    }

    fn row(&self, row: usize) -> AnyRow {
        match self {
            Self::Dense(kernel) => AnyRow::Dense(kernel.row(row)),
            Self::Sparse(kernel) => AnyRow::Sparse(kernel.row(row)),
        }
    }

    fn entry(&self, row: &AnyRow, var: Var) -> f64 {
        match (self, row) {
            (Self::Dense(kernel), AnyRow::Dense(row)) => kernel.entry(row, var),
            (Self::Sparse(kernel), AnyRow::Sparse(row)) => kernel.entry(row, var),
            _ => unreachable!("a row belongs to the kernel that it came from"),
        }
    }

    fn parting(&self, ties: usize) -> Option<Vec<f64>> {
        match self {
            Self::Dense(kernel) => kernel.parting(ties),
            Self::Sparse(kernel) => kernel.parting(ties),
        }
    }

    fn is_due(&self) -> bool {
        match self {
            Self::Dense(kernel) => kernel.is_due(),
            Self::Sparse(kernel) => kernel.is_due(),
        }
    }

    fn apply(&mut self) -> bool {
        match self {
            Self::Dense(kernel) => kernel.apply(),
            Self::Sparse(kernel) => kernel.apply(),
        }
    }

    fn rebuild(&mut self, basic: &[Var], values: &mut [f64]) -> bool {
        match self {
            Self::Dense(kernel) => kernel.rebuild(basic, values),
            Self::Sparse(kernel) => kernel.rebuild(basic, values),
        }
    }
}
