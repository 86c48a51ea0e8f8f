//! One complementary basis in rational arithmetic.

use dashu_int::ops::Abs;
use dashu_ratio::RBig;

use super::ExactPoint;
use super::integers::{Integers, number};
use super::tableau::{Tableau, eliminate};
use lcp::{Basis, HorizontalLcp, Side};

/// The properties of a complementary basis in exact arithmetic.
#[derive(Debug, Clone, PartialEq)]
pub enum ExactVerdict {
    /// The columns of the basis are linearly dependent.
    Singular {
        /// Number of columns that are independent.
        rank: usize,
    },
    /// The basis has one point, and some of its values are negative.
    Infeasible {
        /// The pair with the most negative value, measured as in
        /// [`Residuals::feasibility`](lcp::Residuals::feasibility).
        pair: usize,
        /// The side of the pair that is negative.
        side: Side,
        /// The value, negative, in units of the largest magnitude of `t` or of `y`.
        relative: f64,
    },
    /// The basis has one point, and it solves the problem.
    Solution {
        /// The first variable of every pair, correctly rounded.
        t: Vec<f64>,
        /// The second variable of every pair, correctly rounded.
        y: Vec<f64>,
    },
}

/// Solves a complementary basis in rational arithmetic.
///
/// The cost is `n^3` operations on integers of up to `n` times the digits of the data: some seconds
/// for 100 pairs that use all digits, far less for small integers.
///
/// ```
/// use faer::mat;
/// use lcp_problems::exact::{ExactVerdict, verify_basis};
/// use lcp::{Basis, HorizontalLcp, Lcp, Side};
///
/// let lcp = Lcp::new(mat![[2.0, 1.0], [1.0, 2.0]], vec![-5.0, -6.0])?;
/// let problem = HorizontalLcp::from(lcp);
/// let verdict = verify_basis(&problem, &Basis::all(Side::T, 2));
/// assert_eq!(verdict, ExactVerdict::Solution { t: vec![4.0 / 3.0, 7.0 / 3.0], y: vec![0.0; 2] });
/// let verdict = verify_basis(&problem, &Basis::all(Side::Y, 2));
/// assert_eq!(verdict, ExactVerdict::Infeasible { pair: 1, side: Side::Y, relative: -1.0 });
/// # Ok::<(), lcp::Error>(())
/// ```
///
/// # Panics
/// If the basis does not have one side for every pair.
pub fn verify_basis(problem: &HorizontalLcp, basis: &Basis) -> ExactVerdict {
    let n = problem.order();
    assert!(basis.len() == n, "a basis has one side for every pair");
    let integers = Integers::new(problem);
    let sides = basis.sides().iter().enumerate();
    let variables: Vec<usize> = sides.map(|(pair, &side)| number(pair, side)).collect();
    let mut tableau = Tableau::new(integers.system(&variables));
    let rows: Vec<usize> = eliminate(&mut tableau, n).into_iter().flatten().collect();
    if rows.len() < n {
        return ExactVerdict::Singular { rank: rows.len() };
    }
    let value = |(&variable, &row): (&usize, &usize)| (variable, tableau.rows[row][n].clone());
    let values = variables.iter().zip(&rows).map(value);
    let point = ExactPoint::new(n, values, &tableau.determinant);
    let both = [(Side::T, &point.t), (Side::Y, &point.y)].into_iter();
    let relative = both.filter_map(|(side, values)| {
        let largest = values.iter().cloned().map(Abs::abs).max()?;
        let (pair, least) = values.iter().enumerate().min_by(|(_, a), (_, b)| a.cmp(b))?;
        (*least < RBig::ZERO).then(|| (least / largest, pair, side))
    });
    if let Some((relative, pair, side)) = relative.min_by(|a, b| a.0.cmp(&b.0)) {
        return ExactVerdict::Infeasible { pair, side, relative: relative.to_f64().value() };
    }
    let (t, y) = point.rounded();
    ExactVerdict::Solution { t, y }
}
