//! Whether the linear conditions alone can be met: the first phase of the simplex method.

use dashu_int::IBig;
use dashu_ratio::RBig;

use super::ExactPoint;
use super::integers::{Integers, Variable};
use super::tableau::Tableau;
use crate::HorizontalLcp;

/// Whether `A t + B y = c`, `t >= 0`, `y >= 0` can be met, complementarity aside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Feasibility {
    /// It can, by this point.
    Feasible(ExactPoint),
    /// It cannot.
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
/// use lcp::exact::{Feasibility, feasibility};
/// use lcp::{HorizontalLcp, Lcp};
///
/// // w = -z - 1 has no nonnegative z and w.
/// let problem = HorizontalLcp::from(Lcp::new(mat![[-1.0]], vec![-1.0])?);
/// assert!(matches!(feasibility(&problem), Feasibility::Infeasible { .. }));
/// # Ok::<(), lcp::Error>(())
/// ```
pub fn feasibility(problem: &HorizontalLcp) -> Feasibility {
    let n = problem.order();
    let integers = Integers::new(problem);
    let mut phase = PhaseOne::new(&integers);
    phase.minimise();
    if phase.objective().last().is_none_or(IBig::is_zero) {
        let variables: Vec<Variable> = Variable::all(n).collect();
        let basic = phase.basic.iter().enumerate().filter(|(_, column)| **column < 2 * n);
        let values = basic.map(|(row, &column)| {
            let numerator = phase.right_hand_side(row);
            let value = integers.value(variables[column], numerator, &phase.tableau.determinant);
            (variables[column], value)
        });
        return Feasibility::Feasible(integers.point(values));
    }
    let farkas = (0..n).map(|row| integers.multiplier(row, &phase.multiplier(row))).collect();
    Feasibility::Infeasible { farkas }
}

/// The tableau `A B | 1 | c`, rows negated where `c` is negative, with the sum of the rows below: the
/// reduced costs of the sum of the artificial variables.
struct PhaseOne {
    tableau: Tableau,
    /// Column of the basic variable of every row.
    basic: Vec<usize>,
    is_negated: Vec<bool>,
}

impl PhaseOne {
    fn new(integers: &Integers) -> Self {
        let n = integers.rows.len();
        let is_negative = |row: &Vec<IBig>| row.last().is_some_and(|c| *c < IBig::ZERO);
        let is_negated: Vec<bool> = integers.rows.iter().map(is_negative).collect();
        let mut rows: Vec<Vec<IBig>> = integers.rows.clone();
        for (row, _) in rows.iter_mut().zip(&is_negated).filter(|(_, negated)| **negated) {
            *row = row.iter().map(|v| -v).collect();
        }
        let sum = |j: usize| rows.iter().fold(IBig::ZERO, |sum, row| sum + &row[j]);
        let mut objective: Vec<IBig> = (0..=2 * n).map(sum).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            row.splice(2 * n..2 * n, (0..n).map(|k| IBig::from(u8::from(k == i))));
        }
        objective.splice(2 * n..2 * n, (0..n).map(|_| IBig::ZERO));
        rows.push(objective);
        Self { tableau: Tableau::new(rows), basic: (2 * n..3 * n).collect(), is_negated }
    }

    fn minimise(&mut self) {
        let n = self.basic.len();
        while let Some(entering) = (0..2 * n).find(|&j| self.objective()[j] > IBig::ZERO) {
            // The sum of the artificial variables is not negative, so that some row blocks.
            let Some(row) = self.blocking_row(entering) else { return };
            self.tableau.pivot(row, entering);
            self.basic[row] = entering;
        }
    }

    fn blocking_row(&self, entering: usize) -> Option<usize> {
        let entry = |row: usize| &self.tableau.rows[row][entering];
        let blocking = (0..self.basic.len()).filter(|&row| *entry(row) > IBig::ZERO);
        blocking.min_by(|&i, &k| {
            let left = self.right_hand_side(i) * entry(k);
            let right = self.right_hand_side(k) * entry(i);
            left.cmp(&right).then(self.basic[i].cmp(&self.basic[k]))
        })
    }

    fn right_hand_side(&self, row: usize) -> &IBig {
        &self.tableau.rows[row][3 * self.basic.len()]
    }

    fn objective(&self) -> &[IBig] {
        &self.tableau.rows[self.basic.len()]
    }

    /// The simplex multiplier of a row: its artificial variable costs one more than its reduced cost.
    fn multiplier(&self, row: usize) -> RBig {
        let reduced = self.objective()[2 * self.basic.len() + row].clone();
        let determinant = &self.tableau.determinant;
        let value = RBig::from_parts_signed(reduced + determinant, determinant.clone());
        if self.is_negated[row] { -value } else { value }
    }
}
