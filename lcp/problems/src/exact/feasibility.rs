//! Whether the linear conditions alone can be met: the first phase of the simplex method.

use dashu_int::IBig;
use dashu_ratio::RBig;

use super::ExactPoint;
use super::integers::Integers;
use super::tableau::Tableau;
use lcp::HorizontalLcp;

/// Whether `A t + B y = c`, `t >= 0`, `y >= 0` can be met, complementarity aside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Feasibility {
    /// The conditions can be met, by this point.
    Feasible(ExactPoint),
    /// The conditions cannot be met.
    Infeasible {
        /// The proof (Farkas): a vector with `A^T farkas <= 0`, `B^T farkas <= 0` and `c . farkas > 0`.
        farkas: Vec<RBig>,
    },
}

/// Decides whether the linear conditions of a problem can be met: a necessary condition for a
/// solution, and a sufficient one for monotone problems.
///
/// Phase 1 of the simplex method in integers, with the rule of Bland (1977), which cannot cycle.
///
/// ```
/// use faer::mat;
/// use lcp_problems::exact::{Feasibility, feasibility};
/// use lcp::{HorizontalLcp, Lcp};
///
/// // w = -z - 1 has no nonnegative z and w.
/// let problem = HorizontalLcp::from(Lcp::new(mat![[-1.0]], vec![-1.0])?);
/// assert!(matches!(feasibility(&problem), Feasibility::Infeasible { .. }));
/// # Ok::<(), lcp::Error>(())
/// ```
pub fn feasibility(problem: &HorizontalLcp) -> Feasibility {
    let n = problem.order();
    let Integers { rows, factors } = Integers::new(problem);
    let signs: Vec<IBig> = rows.iter().map(|row| sign(&row[2 * n])).collect();
    // `A B | 1 | c` with `c >= 0`, and below them the reduced costs of the sum of the artificial
    // variables.
    let mut costs = vec![IBig::ZERO; 3 * n + 1];
    let mut signed = Vec::with_capacity(n + 1);
    for (i, (row, sign)) in rows.iter().zip(&signs).enumerate() {
        let mut row: Vec<IBig> = row.iter().map(|v| v * sign).collect();
        row.splice(2 * n..2 * n, (0..n).map(|_| IBig::ZERO));
        costs.iter_mut().zip(&row).for_each(|(sum, v)| *sum += v);
        row[2 * n + i] = IBig::ONE;
        signed.push(row);
    }
    signed.push(costs);
    let mut tableau = Tableau::new(signed);
    let mut basic: Vec<usize> = (2 * n..3 * n).collect();
    while let Some(entering) = (0..2 * n).find(|&j| tableau.rows[n][j] > IBig::ZERO) {
        let rows = &tableau.rows;
        let blocking = (0..n).filter(|&i| rows[i][entering] > IBig::ZERO);
        let row = blocking.min_by(|&i, &k| {
            let left = &rows[i][3 * n] * &rows[k][entering];
            let right = &rows[k][3 * n] * &rows[i][entering];
            left.cmp(&right).then(basic[i].cmp(&basic[k]))
        });
        // The sum of the artificial variables is not negative, so that some row blocks.
        let Some(row) = row else { break };
        tableau.pivot(row, entering);
        basic[row] = entering;
    }
    let Tableau { rows, determinant } = &tableau;
    if rows[n][3 * n].is_zero() {
        let original = basic.iter().zip(rows).filter(|(column, _)| **column < 2 * n);
        let values = original.map(|(&column, row)| (column, row[3 * n].clone()));
        return Feasibility::Feasible(ExactPoint::new(n, values, determinant));
    }
    // The simplex multiplier of a row: its artificial variable costs one more than its reduced cost.
    let multiplier = |i: usize| {
        let value = (&rows[n][2 * n + i] + determinant) * &signs[i];
        RBig::from_parts_signed(value, determinant.clone()) * &factors[i]
    };
    Feasibility::Infeasible { farkas: (0..n).map(multiplier).collect() }
}

/// Minus one for negative numbers, else one.
fn sign(value: &IBig) -> IBig {
    if *value < IBig::ZERO { -IBig::ONE } else { IBig::ONE }
}
