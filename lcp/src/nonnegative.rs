//! Nonnegative least squares in twice the digits, for problems of some dozen rows.
//!
//! `min |sum x_j a_j - c|` over `x >= 0` by the active set method of Lawson and Hanson (*Solving Least
//! Squares Problems*, 1974, chapter 23). The columns with `x_j > 0` are independent throughout, whatever
//! the rank of all, and every step lowers the residual, so that the method ends. The residual
//! `r = c - sum x_j a_j` at the minimum has `r . a_j <= 0` for all columns and `r . c = |r|^2`: a nonzero
//! `r` proves that `c` is not a nonnegative combination of the columns.

use std::cell::Cell;

use web_time::Instant;

use crate::extended::{Extended, extended};
use crate::solve::is_over;

/// Rounding of sums in [`Extended`], relative to the sizes of their terms.
const ROUNDING: f64 = f64::EPSILON * f64::EPSILON * 256.0;
/// Largest number of steps, for each column.
const STEPS: usize = 10;

/// Columns and right-hand side, near one in size.
pub(crate) struct LeastSquares {
    pub(crate) columns: Vec<Vec<f64>>,
    pub(crate) right: Vec<f64>,
    /// Number of columns made orthogonal to others so far, a measure of the work.
    pub(crate) exchanges: Cell<usize>,
    deadline: Option<Instant>,
}

#[derive(Debug, Clone)]
pub(crate) struct Minimum {
    /// The value of every column, at least zero.
    pub(crate) x: Vec<Extended>,
    /// `c - sum x_j a_j`, without its rounding errors.
    pub(crate) residual: Vec<Extended>,
}

impl LeastSquares {
    pub(crate) fn new(columns: Vec<Vec<f64>>, right: Vec<f64>, deadline: Option<Instant>) -> Self {
        Self { columns, right, exchanges: Cell::new(0), deadline }
    }

    /// The minimum over the allowed columns, from nonnegative values that are zero for the others. `None`
    /// if rounding errors prevent its end, or the time limit is reached first.
    pub(crate) fn solve(&self, is_allowed: &[bool], start: &[Extended]) -> Option<Minimum> {
        let mut x = start.to_vec();
        let mut passive = Passive::default();
        self.take(&mut passive, &mut x);
        for _ in 0..STEPS * x.len() + STEPS {
            let residual = self.descend(&mut passive, &mut x);
            let Some(entering) = self.entering(is_allowed, &passive, &x, &residual) else {
                return Some(Minimum { x, residual });
            };
            if is_over(self.deadline) || !self.add(&mut passive, entering) {
                return None;
            }
        }
        None
    }

    fn add(&self, passive: &mut Passive, j: usize) -> bool {
        self.exchanges.set(self.exchanges.get() + 1);
        passive.add(j, &self.columns[j])
    }

    /// Moves to the minimum over the passive columns without a bound, or as far as all values stay
    /// nonnegative; columns whose values reach zero leave the passive set. Returns the residual.
    fn descend(&self, passive: &mut Passive, x: &mut [Extended]) -> Vec<Extended> {
        loop {
            let target = self.minimum_of(passive);
            let steps = passive.columns.iter().zip(&target).map(|(&j, &target)| {
                if target > Extended::ZERO { None } else { Some((j, x[j] / (x[j] - target))) }
            });
            let shortest = steps.flatten().reduce(|a, b| if b.1 < a.1 { b } else { a });
            let Some((leaving, step)) = shortest.map(|(j, step)| (j, finite(step))) else {
                passive.columns.iter().zip(target).for_each(|(&j, target)| x[j] = target);
                return self.residual(x);
            };
            for (&j, &target) in passive.columns.iter().zip(&target) {
                x[j] = x[j] + (target - x[j]) * step;
                if j == leaving || x[j] <= Extended::ZERO {
                    x[j] = Extended::ZERO;
                }
            }
            self.take(passive, x);
        }
    }

    /// Makes the columns with positive values passive, or a largest independent set of them if they
    /// depend on each other.
    fn take(&self, passive: &mut Passive, x: &mut [Extended]) {
        *passive = Passive::default();
        for (j, x) in x.iter_mut().enumerate() {
            if *x > Extended::ZERO && !self.add(passive, j) {
                *x = Extended::ZERO;
            }
        }
    }

    /// The column that lowers the residual the most, by its angle with the residual.
    fn entering(
        &self,
        is_allowed: &[bool],
        passive: &Passive,
        x: &[Extended],
        residual: &[Extended],
    ) -> Option<usize> {
        let terms = self.terms(x);
        let mut best = (0.0, None);
        for (j, column) in self.columns.iter().enumerate() {
            if !is_allowed[j] || passive.columns.contains(&j) {
                continue;
            }
            let (mut product, mut size, mut square) = (Extended::ZERO, 0.0, 0.0);
            for ((&v, &r), terms) in column.iter().zip(residual).zip(&terms) {
                product += r * v;
                size += v.abs() * terms;
                square += v * v;
            }
            let product = product.rounded();
            let share = product / square.sqrt();
            if product > ROUNDING * size && share > best.0 {
                best = (share, Some(j));
            }
        }
        best.1
    }

    /// Values of the passive columns at the minimum, refined once.
    fn minimum_of(&self, passive: &Passive) -> Vec<Extended> {
        let mut values = passive.minimum(extended(&self.right));
        let mut x = vec![Extended::ZERO; self.columns.len()];
        passive.columns.iter().zip(&values).for_each(|(&j, &value)| x[j] = value);
        let correction = passive.minimum(self.difference(&x));
        values.iter_mut().zip(correction).for_each(|(value, step)| *value += step);
        values
    }

    /// `c - sum x_j a_j`, with zeros for rounding errors.
    fn residual(&self, x: &[Extended]) -> Vec<Extended> {
        let rows = self.difference(x).into_iter().zip(self.terms(x));
        let is_zero = |r: Extended, terms: f64| r.rounded().abs() <= ROUNDING * terms;
        rows.map(|(r, terms)| if is_zero(r, terms) { Extended::ZERO } else { r }).collect()
    }

    fn difference(&self, x: &[Extended]) -> Vec<Extended> {
        let mut rest = extended(&self.right);
        for (column, &x) in self.columns.iter().zip(x).filter(|(_, x)| **x != Extended::ZERO) {
            rest.iter_mut().zip(column).for_each(|(rest, &v)| *rest += -(x * v));
        }
        rest
    }

    /// `|c| + |x| sum |a_j|` over the columns with positive values, with the largest value: small values
    /// inherit the errors of large ones.
    fn terms(&self, x: &[Extended]) -> Vec<f64> {
        let mut terms: Vec<f64> = self.right.iter().map(|c| c.abs()).collect();
        let largest = largest(x).rounded();
        for (column, _) in self.columns.iter().zip(x).filter(|(_, x)| **x != Extended::ZERO) {
            terms.iter_mut().zip(column).for_each(|(terms, v)| *terms += v.abs() * largest);
        }
        terms
    }
}

impl Minimum {
    /// Sets to zero the values that are rounding errors of others.
    pub(crate) fn drop_rounding(&mut self) {
        let least = largest(&self.x).rounded() * ROUNDING;
        self.x.iter_mut().filter(|x| x.rounded() <= least).for_each(|x| *x = Extended::ZERO);
    }
}

fn largest(x: &[Extended]) -> Extended {
    x.iter().fold(Extended::ZERO, |max, &x| if x > max { x } else { max })
}

fn finite(step: Extended) -> Extended {
    if step.rounded().is_finite() { step } else { Extended::ZERO }
}

/// The columns with positive values: `a = sum r_k q_k` with orthogonal `q_k`, not normalised (Gram and
/// Schmidt, each column twice).
#[derive(Default)]
struct Passive {
    columns: Vec<usize>,
    orthogonal: Vec<Vec<Extended>>,
    squares: Vec<Extended>,
    /// The factors of every column for the `q_k` before its own.
    factors: Vec<Vec<Extended>>,
}

impl Passive {
    /// Adds a column; `false` if the column depends on the others.
    fn add(&mut self, j: usize, column: &[f64]) -> bool {
        let mut rest = extended(column);
        let whole = dot(&rest, &rest);
        let mut factors = vec![Extended::ZERO; self.columns.len()];
        for _ in 0..2 {
            for (factor, part) in factors.iter_mut().zip(self.project(&mut rest)) {
                *factor += part;
            }
        }
        let square = dot(&rest, &rest);
        if square.rounded() <= ROUNDING * ROUNDING * whole.rounded() {
            return false;
        }
        self.columns.push(j);
        self.orthogonal.push(rest);
        self.squares.push(square);
        self.factors.push(factors);
        true
    }

    /// Subtracts the parts along the `q_k`, and returns their factors.
    fn project(&self, rest: &mut [Extended]) -> Vec<Extended> {
        let basis = self.orthogonal.iter().zip(&self.squares);
        basis
            .map(|(q, &square)| {
                let part = dot(q, rest) / square;
                rest.iter_mut().zip(q).for_each(|(rest, &q)| *rest += -(q * part));
                part
            })
            .collect()
    }

    /// The values for which the residual is smallest.
    fn minimum(&self, mut right: Vec<Extended>) -> Vec<Extended> {
        let mut values = self.project(&mut right);
        for k in (1..values.len()).rev() {
            let value = values[k];
            let (before, factors) = (&mut values[..k], &self.factors[k]);
            before.iter_mut().zip(factors).for_each(|(v, &factor)| *v += -(factor * value));
        }
        values
    }
}

fn dot(a: &[Extended], b: &[Extended]) -> Extended {
    a.iter().zip(b).fold(Extended::ZERO, |sum, (&a, &b)| sum + a * b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn minimum(columns: &[&[f64]], right: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let columns_of = columns.iter().map(|column| column.to_vec()).collect();
        let problem = LeastSquares::new(columns_of, right.to_vec(), None);
        let count = columns.len();
        let found = problem.solve(&vec![true; count], &vec![Extended::ZERO; count]);
        let Minimum { x, residual } = found.expect("it ends");
        let rounded = |v: Vec<Extended>| v.into_iter().map(Extended::rounded).collect();
        (rounded(x), rounded(residual))
    }

    /// The nearest point of a quadrant, whichever side `c` lies on.
    #[test]
    fn the_nearest_point_of_a_quadrant() {
        let axes: [&[f64]; 2] = [&[1.0, 0.0], &[0.0, 1.0]];
        assert_eq!(minimum(&axes, &[2.0, 3.0]), (vec![2.0, 3.0], vec![0.0, 0.0]));
        assert_eq!(minimum(&axes, &[2.0, -3.0]), (vec![2.0, 0.0], vec![0.0, -3.0]));
        assert_eq!(minimum(&axes, &[-2.0, -3.0]), (vec![0.0, 0.0], vec![-2.0, -3.0]));
    }

    /// Equal, opposite and zero columns do not disturb the method.
    #[test]
    fn columns_may_depend_on_each_other() {
        let columns: [&[f64]; 5] =
            [&[0.0, 0.0], &[1.0, 1.0], &[1.0, 1.0], &[-1.0, -1.0], &[3.0, -1.0]];
        let (x, residual) = minimum(&columns, &[-2.0, -2.0]);
        assert_eq!((x, residual), (vec![0.0, 0.0, 0.0, 2.0, 0.0], vec![0.0, 0.0]));
    }

    /// Nearly parallel columns, whose difference is `c`, and a residual of 1e-9 of `c`.
    #[test]
    fn small_differences_are_seen() {
        let near = 1.0 + f64::EPSILON;
        let (x, residual) = minimum(&[&[1.0, 1.0], &[-1.0, -near]], &[0.0, -1.0]);
        assert_eq!((x, residual), (vec![f64::EPSILON.recip(); 2], vec![0.0, 0.0]));
        let (_, residual) = minimum(&[&[1.0, -1.0], &[-1.0, 1.0]], &[1.0, -1.0 + 1e-9]);
        assert!(residual.iter().all(|r| (r - 5e-10).abs() < 1e-16), "{residual:?}");
    }
}
