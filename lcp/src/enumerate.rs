//! A complete method for small problems: branch over the pairs, with a proof for every leaf.
//!
//! A node sets one variable to zero in some pairs and leaves the others without complementarity: what
//! remains are linear conditions, whose nonnegative least squares problem either meets them or proves
//! that they cannot be met. Where they are met, and one variable of every pair is zero, the problem is
//! solved. Where some pair has both positive, one of its variables has to be zero: two nodes more.
//! So there is a solution, or the leaves prove together that there is none.
//!
//! There are at most `2^(k+1)` nodes for `k` pairs that are not free, mostly far fewer. The arithmetic
//! has twice the digits; what it cannot decide stays open.

use std::time::Instant;

use crate::certify::{Leaf, ROUNDING, is_proof_of};
use crate::extended::{Extended, extended};
use crate::matrix::Column;
use crate::nonnegative::{LeastSquares, Minimum};
use crate::scaling::equilibrate;
use crate::vector::max_abs;
use crate::{Basis, HorizontalLcp, Side};

/// What may be left of the right-hand side, relative to its largest entry. Chosen.
const NEAR: f64 = 1e-6;

/// When to give up.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// Nodes of the tree.
    pub(crate) nodes: usize,
    pub(crate) deadline: Option<Instant>,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Enumerated {
    /// A solution, up to rounding.
    Found { t: Vec<f64>, y: Vec<f64>, basis: Basis },
    /// The linear conditions cannot be met, by this Farkas vector.
    Infeasible(Vec<f64>),
    /// They can, but not with complementarity: the leaves cover all choices.
    NoSolution(Vec<Leaf>),
    /// A limit was reached, or rounding leaves it undecided.
    Open,
}

/// A solution, or a proof that there is none.
pub(crate) fn enumerate(problem: &HorizontalLcp, limits: Limits) -> Enumerated {
    let n = problem.order();
    let tree = Tree::new(problem);
    let mut open = vec![Node { sides: vec![None; n], start: vec![Extended::ZERO; 2 * n] }];
    let (mut leaves, mut count, mut is_proved) = (Vec::new(), 0, true);
    while let Some(node) = open.pop() {
        count += 1;
        if count > limits.nodes || limits.deadline.is_some_and(|it| Instant::now() >= it) {
            return Enumerated::Open;
        }
        match tree.visit(&node) {
            Visit::Solved { t, y, basis } => return Enumerated::Found { t, y, basis },
            Visit::Proved(pi) => leaves.push(Leaf { sides: node.sides, pi }),
            Visit::Branch { pair, larger, values } => {
                for side in [larger.complement(), larger] {
                    open.push(node.child(pair, side, &values));
                }
            }
            Visit::Open => is_proved = false,
        }
    }
    match leaves.pop() {
        Some(root) if is_proved && leaves.is_empty() => Enumerated::Infeasible(root.pi),
        Some(last) if is_proved => {
            leaves.push(last);
            Enumerated::NoSolution(leaves)
        }
        _ => Enumerated::Open,
    }
}

/// A checked Farkas vector of the linear conditions, by the first node alone.
pub(crate) fn farkas_vector(problem: &HorizontalLcp) -> Option<Vec<f64>> {
    let n = problem.order();
    let tree = Tree::new(problem);
    let minimum = tree.linear.solve(&vec![true; 2 * n], &vec![Extended::ZERO; 2 * n])?;
    tree.proof(&vec![None; n], &minimum)
}

/// Sides chosen, and nonnegative values to start from, zero for what the sides exclude.
struct Node {
    sides: Vec<Option<Side>>,
    start: Vec<Extended>,
}

impl Node {
    fn child(&self, pair: usize, side: Side, values: &[Extended]) -> Self {
        let mut child = Self { sides: self.sides.clone(), start: values.to_vec() };
        child.sides[pair] = Some(side);
        child.start[position(pair, side.complement(), self.sides.len())] = Extended::ZERO;
        child
    }
}

enum Visit {
    Solved { t: Vec<f64>, y: Vec<f64>, basis: Basis },
    Proved(Vec<f64>),
    Branch { pair: usize, larger: Side, values: Vec<Extended> },
    Open,
}

/// The problem with equilibrated rows and columns, first those of `t`.
struct Tree<'a> {
    problem: &'a HorizontalLcp,
    rows: Vec<f64>,
    /// Value in the problem's units of one unit of a scaled variable.
    factors: Vec<f64>,
    is_free: Vec<bool>,
    linear: LeastSquares,
}

impl<'a> Tree<'a> {
    fn new(problem: &'a HorizontalLcp) -> Self {
        let n = problem.order();
        let columns: Vec<Column<'_>> = columns(problem, &vec![None; n]).collect();
        let (rows, mut factors) = equilibrate(n, &columns);
        let scaled = columns.iter().zip(&factors).map(|(column, factor)| {
            let mut scaled = vec![0.0; n];
            column.for_each(|i, v| scaled[i] += factor * (v * rows[i]));
            scaled
        });
        let mut columns: Vec<Vec<f64>> = scaled.collect();
        let ratios: Vec<Option<f64>> = (0..n).map(|pair| problem.opposite(pair)).collect();
        for (pair, ratio) in ratios.iter().enumerate() {
            // Opposite up to rounding, so that in twice the digits they would be independent.
            if let Some(ratio) = ratio {
                columns[n + pair] = columns[pair].iter().map(|v| -v).collect();
                factors[n + pair] = factors[pair] / ratio;
            }
        }
        let mut right: Vec<f64> = problem.c().iter().zip(&rows).map(|(c, row)| c * row).collect();
        let size = max_abs(&right);
        if size > 0.0 {
            let unit = size.log2().floor().clamp(-1000.0, 1000.0).exp2();
            right = right.into_iter().map(|c| c / unit).collect();
            factors = factors.into_iter().map(|factor| factor * unit).collect();
        }
        let is_free = ratios.iter().map(Option::is_some).collect();
        Self { problem, rows, factors, is_free, linear: LeastSquares { columns, right } }
    }

    fn visit(&self, node: &Node) -> Visit {
        let n = self.problem.order();
        let sides = [Side::T, Side::Y].into_iter();
        let is_allowed: Vec<bool> = sides
            .flat_map(|side| node.sides.iter().map(move |it| it.is_none_or(|it| it == side)))
            .collect();
        let Some(mut minimum) = self.linear.solve(&is_allowed, &node.start) else {
            return Visit::Open;
        };
        minimum.drop_rounding();
        if let Some(pi) = self.proof(&node.sides, &minimum) {
            return Visit::Proved(pi);
        }
        if let Some((t, y, basis)) = self.solution(&node.sides, &minimum.x) {
            return Visit::Solved { t, y, basis };
        }
        let least = |pair: usize| minimum.x[pair].rounded().min(minimum.x[n + pair].rounded());
        // Where no pair has both positive, rounding is in the way, of which a narrower node may be free.
        let undecided = (0..n).filter(|&pair| node.sides[pair].is_none() && !self.is_free[pair]);
        let largest = undecided.reduce(|a, b| if least(b) > least(a) { b } else { a });
        let Some(pair) = largest else { return Visit::Open };
        let larger = if minimum.x[pair] > minimum.x[n + pair] { Side::T } else { Side::Y };
        Visit::Branch { pair, larger, values: minimum.x }
    }

    /// The residual as a Farkas vector, in the rows of the problem, with a largest entry of one.
    fn proof(&self, sides: &[Option<Side>], minimum: &Minimum) -> Option<Vec<f64>> {
        let rows = minimum.residual.iter().zip(&self.rows);
        let pi: Vec<Extended> = rows.map(|(r, &row)| r.scaled(row)).collect();
        let largest =
            pi.iter().fold(Extended::ZERO, |max, pi| if pi.abs() > max { pi.abs() } else { max });
        let pi: Vec<f64> = pi.into_iter().map(|pi| (pi / largest).rounded()).collect();
        is_proof_of(columns(self.problem, sides), self.problem.c(), &pi).then_some(pi)
    }

    /// The larger variable of every pair, if these solve the problem up to rounding.
    fn solution(
        &self,
        sides: &[Option<Side>],
        x: &[Extended],
    ) -> Option<(Vec<f64>, Vec<f64>, Basis)> {
        let n = sides.len();
        let (mut t, mut y) = (vec![0.0; n], vec![0.0; n]);
        let mut basis = Vec::with_capacity(n);
        for (pair, chosen) in sides.iter().enumerate() {
            let side = match chosen {
                Some(side) => *side,
                None if x[pair] > x[n + pair] => Side::T,
                None => Side::Y,
            };
            let at = position(pair, side, n);
            let value = x[at].rounded() * self.factors[at];
            match side {
                Side::T => t[pair] = value,
                Side::Y => y[pair] = value,
            }
            basis.push(side);
        }
        self.holds(&t, &y).then(|| (t, y, Basis::new(basis)))
    }

    /// Whether every row of the problem holds up to rounding, and up to a small part of the right-hand
    /// side: far enough out all rows hold compared with their terms.
    fn holds(&self, t: &[f64], y: &[f64]) -> bool {
        let mut rest = extended(self.problem.c());
        let mut terms: Vec<f64> = self.problem.c().iter().map(|c| c.abs()).collect();
        for (column, &x) in columns(self.problem, &vec![None; t.len()]).zip(t.iter().chain(y)) {
            column.for_each(|i, v| {
                rest[i] += -Extended::product(v, x);
                terms[i] += (v * x).abs();
            });
        }
        let rest: Vec<f64> = rest.into_iter().map(Extended::rounded).collect();
        let largest = |v: &[f64]| {
            v.iter().zip(&self.rows).fold(0.0_f64, |max, (v, row)| max.max((v * row).abs()))
        };
        largest(&rest) <= NEAR * largest(self.problem.c())
            && rest.iter().zip(terms).all(|(rest, terms)| rest.abs() <= ROUNDING * terms)
    }
}

/// The columns of the sides that may be positive, first those of `t`.
fn columns<'a>(
    problem: &'a HorizontalLcp,
    sides: &[Option<Side>],
) -> impl Iterator<Item = Column<'a>> {
    [Side::T, Side::Y].into_iter().flat_map(move |side| {
        let allowed =
            sides.iter().enumerate().filter(move |(_, it)| it.is_none_or(|it| it == side));
        allowed.map(move |(pair, _)| problem.column(pair, side))
    })
}

fn position(pair: usize, side: Side, n: usize) -> usize {
    match side {
        Side::T => pair,
        Side::Y => n + pair,
    }
}

#[cfg(all(test, feature = "exact"))]
mod tests;
