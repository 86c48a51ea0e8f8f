//! A complete method for small problems: branch over the pairs, with a proof for every leaf.
//!
//! A node sets one variable to zero in some pairs and drops complementarity in the others: the remaining linear
//! conditions are a nonnegative least squares problem, whose solution either meets the conditions or proves that they
//! cannot be met. If the conditions are met and one variable of every pair is zero, the problem is solved. If some pair
//! has both positive, one of its variables has to be zero: two nodes more. So the search finds a solution, or the
//! leaves together prove that none exists.
//!
//! A proof may hold with fewer choices than its node has made: it needs only the choices whose excluded columns it does
//! not separate. If a proof does not need the last choice, it proves the parent, and the other node is not visited
//! (backjumping). Proofs are kept, and each proves every node that has made the choices it needs. A node that lacks a
//! single one of these choices has one side left in that pair (unit propagation, as in the search of Davis, Logemann
//! and Loveland 1962).
//!
//! There are at most `2^(k+1)` nodes for `k` pairs that are not free, mostly far fewer. The arithmetic has twice the
//! digits; questions beyond these digits stay open.

use web_time::Instant;

use crate::certify::{GeneralJudge, Leaf, MILLIONTH, ROUNDING, is_proof_of};
use crate::extended::{Extended, extended};
use crate::nonnegative::{LeastSquares, Minimum};
use crate::scaling::equilibrate;
use crate::solve::is_over;
use crate::vector::max_abs;
use crate::{Basis, HorizontalLcp, Side};

/// Largest number of pairs, including free variables, of a problem that is enumerated. Measured: a node of 100 takes 10
/// ms.
pub(crate) const MOST_PAIRS: usize = 100;

/// The result of an enumeration.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Enumerated {
    /// A solution, up to rounding.
    Found { t: Vec<f64>, y: Vec<f64>, basis: Basis },
    /// The linear conditions cannot be met, by this Farkas vector.
    Infeasible(Vec<f64>),
    /// The linear conditions can be met, but not with complementarity: the leaves cover all choices.
    NoSolution(Vec<Leaf>),
    /// A limit was reached.
    Limit,
    /// Undecided because of rounding errors.
    Open,
}

/// A solution, or a proof that there is none, unless the limit on exchanges of columns in the least squares of all
/// nodes or the time limit is reached first; and the number of exchanges.
pub(crate) fn enumerate(
    problem: &HorizontalLcp,
    most: usize,
    deadline: Option<Instant>,
) -> (Enumerated, usize) {
    let n = problem.order();
    let tree = Tree::new(problem, deadline);
    let mut search = Branching { tree, most, deadline, proofs: Vec::new() };
    let found = match search.visit(&vec![None; n], &vec![Extended::ZERO; 2 * n]) {
        Err(end) => end,
        Ok(None) => Enumerated::Open,
        Ok(Some(mut leaves)) => match leaves.pop() {
            Some(root) if leaves.is_empty() => Enumerated::Infeasible(root.pi),
            last => Enumerated::NoSolution(leaves.into_iter().chain(last).collect()),
        },
    };
    (found, search.tree.linear.exchanges.get())
}

/// A checked Farkas vector of the linear conditions, by the first node alone.
pub(crate) fn farkas_vector(problem: &HorizontalLcp) -> Option<Vec<f64>> {
    let n = problem.order();
    let tree = Tree::new(problem, None);
    let minimum = tree.linear.solve(&vec![true; 2 * n], &vec![Extended::ZERO; 2 * n])?;
    tree.proof(&vec![None; n], &minimum).map(|proof| proof.pi)
}

/// The sides chosen.
type Sides = [Option<Side>];

/// The leaves that share all choices with a node, as far as they need them; `None` if a leaf stays undecided.
type Closed = Option<Vec<Leaf>>;

/// A Farkas vector with the columns that it does not separate, first those of `t`.
struct Proof {
    pi: Vec<f64>,
    needed: Vec<usize>,
}

impl Proof {
    /// The leaf of a node that excludes all columns needed.
    fn leaf(&self, sides: &Sides) -> Leaf {
        let n = sides.len();
        let mut needed = vec![None; n];
        self.needed.iter().for_each(|column| needed[column % n] = sides[column % n]);
        Leaf { sides: needed, pi: self.pi.clone() }
    }
}

/// A depth-first search with the proofs found so far.
struct Branching<'a> {
    tree: Tree<'a>,
    /// Largest number of exchanges.
    most: usize,
    deadline: Option<Instant>,
    proofs: Vec<Proof>,
}

impl Branching<'_> {
    /// Closes a node, from nonnegative values that are zero for variables excluded by its sides. A solution or a limit
    /// ends the search.
    fn visit(&mut self, sides: &Sides, start: &[Extended]) -> Result<Closed, Enumerated> {
        match self.known(sides) {
            None => {}
            Some(Known::Leaf(leaf)) => return Ok(Some(vec![leaf])),
            Some(Known::Left { pair, side, other }) => {
                let leaves = self.child(sides, pair, side, start)?;
                return Ok(leaves.map(|leaves| joined(sides, pair, vec![other], leaves)));
            }
        }
        let tree = &self.tree;
        if tree.linear.exchanges.get() > self.most || is_over(self.deadline) {
            return Err(Enumerated::Limit);
        }
        let Some(minimum) = tree.minimum(sides, start) else { return Ok(None) };
        if let Some(proof) = tree.proof(sides, &minimum) {
            let leaf = proof.leaf(sides);
            self.proofs.push(proof);
            return Ok(Some(vec![leaf]));
        }
        let x = minimum.x;
        if let Some(solution) = tree.solution(sides, &x) {
            return Err(solution);
        }
        let Some(pair) = tree.most_violated(sides, &x) else { return Ok(None) };
        let larger = if x[pair] > x[sides.len() + pair] { Side::T } else { Side::Y };
        let first = self.child(sides, pair, larger, &x)?;
        if first.as_ref().is_some_and(|leaves| !need(leaves, pair)) {
            return Ok(first);
        }
        let second = self.child(sides, pair, larger.complement(), &x)?;
        Ok(first.zip(second).map(|(first, second)| joined(sides, pair, first, second)))
    }

    /// Closes the child of the node with one more side.
    fn child(
        &mut self,
        sides: &Sides,
        pair: usize,
        side: Side,
        values: &[Extended],
    ) -> Result<Closed, Enumerated> {
        let (mut sides, mut start) = (sides.to_vec(), values.to_vec());
        sides[pair] = Some(side);
        start[side.of(sides.len() + pair, pair)] = Extended::ZERO;
        self.visit(&sides, &start)
    }

    /// The consequence of the proofs so far for a node.
    fn known(&self, sides: &Sides) -> Option<Known> {
        let n = sides.len();
        let side_of = |column: usize| if column < n { Side::T } else { Side::Y };
        let mut unit = None;
        for proof in &self.proofs {
            let is_allowed = |column: &&usize| {
                sides[**column % n].is_none_or(|chosen| chosen == side_of(**column))
            };
            let mut lacking = proof.needed.iter().filter(is_allowed);
            match (lacking.next(), lacking.next()) {
                (None, _) => return Some(Known::Leaf(proof.leaf(sides))),
                (Some(&column), None) if sides[column % n].is_none() => {
                    unit = Some((proof, column));
                }
                _ => {}
            }
        }
        let (proof, column) = unit?;
        let (pair, side) = (column % n, side_of(column));
        let mut others = sides.to_vec();
        others[pair] = Some(side.complement());
        Some(Known::Left { pair, side, other: proof.leaf(&others) })
    }
}

/// The consequence of the proof of another node.
enum Known {
    /// The other proof proves the node.
    Leaf(Leaf),
    /// The other proof proves the node with the other side of this pair.
    Left { pair: usize, side: Side, other: Leaf },
}

/// Whether leaves need a side of a pair.
fn need(leaves: &[Leaf], pair: usize) -> bool {
    leaves.iter().any(|leaf| leaf.sides[pair].is_some())
}

/// The leaves of a node from those of its two sides of a pair: the second ones alone if they do not need their side,
/// else all of them, each with all sides of the node that any of them needs.
fn joined(sides: &Sides, pair: usize, first: Vec<Leaf>, second: Vec<Leaf>) -> Vec<Leaf> {
    if !need(&second, pair) {
        return second;
    }
    let mut leaves = first;
    leaves.extend(second);
    for (k, side) in sides.iter().enumerate().filter(|(_, side)| side.is_some()) {
        if need(&leaves, k) {
            for leaf in &mut leaves {
                leaf.sides[k] = *side;
            }
        }
    }
    leaves
}

/// The problem with equilibrated rows and columns, first those of `t`.
struct Tree<'a> {
    problem: &'a HorizontalLcp,
    judge: GeneralJudge<'a>,
    rows: Vec<f64>,
    /// Value in the problem's units of one unit of a scaled variable.
    factors: Vec<f64>,
    is_free: Vec<bool>,
    linear: LeastSquares,
}

impl<'a> Tree<'a> {
    fn new(problem: &'a HorizontalLcp, deadline: Option<Instant>) -> Self {
        let n = problem.order();
        let columns = problem.columns();
        let (rows, mut factors) = equilibrate(n, &columns);
        let judge = GeneralJudge::with_factors(problem, &rows, &factors);
        let scaled = columns.iter().zip(&factors).map(|(column, factor)| {
            let mut scaled = vec![0.0; n];
            column.for_each(|i, v| scaled[i] += factor * (v * rows[i]));
            scaled
        });
        let mut columns: Vec<Vec<f64>> = scaled.collect();
        let ratios: Vec<Option<f64>> = (0..n).map(|pair| problem.opposite(pair)).collect();
        for (pair, ratio) in ratios.iter().enumerate() {
            // The columns are opposite up to rounding, and would be independent in twice the digits.
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
        Self {
            problem,
            judge,
            rows,
            factors,
            is_free,
            linear: LeastSquares::new(columns, right, deadline),
        }
    }

    /// The least squares of the linear conditions of a node; `None` if rounding errors prevent a decision.
    fn minimum(&self, sides: &Sides, start: &[Extended]) -> Option<Minimum> {
        let both = [Side::T, Side::Y].into_iter();
        let is_allowed: Vec<bool> = both
            .flat_map(|side| sides.iter().map(move |it| it.is_none_or(|it| it == side)))
            .collect();
        let mut minimum = self.linear.solve(&is_allowed, start)?;
        minimum.drop_rounding();
        Some(minimum)
    }

    /// The pair without a side whose smaller variable is the largest. If no pair has both positive, rounding errors
    /// have prevented a decision, which a node with more sides may allow.
    fn most_violated(&self, sides: &Sides, x: &[Extended]) -> Option<usize> {
        let n = sides.len();
        let least = |pair: usize| x[pair].rounded().min(x[n + pair].rounded());
        let undecided = (0..n).filter(|&pair| sides[pair].is_none() && !self.is_free[pair]);
        undecided.reduce(|a, b| if least(b) > least(a) { b } else { a })
    }

    /// The residual as a Farkas vector, in the rows of the problem, with a largest entry of one.
    fn proof(&self, sides: &Sides, minimum: &Minimum) -> Option<Proof> {
        let rows = minimum.residual.iter().zip(&self.rows);
        let pi: Vec<Extended> = rows.map(|(r, &row)| r.scaled(row)).collect();
        let largest =
            pi.iter().fold(Extended::ZERO, |max, pi| if pi.abs() > max { pi.abs() } else { max });
        let pi: Vec<f64> = pi.into_iter().map(|pi| (pi / largest).rounded()).collect();
        let (problem, n) = (self.problem, sides.len());
        if !is_proof_of(problem.columns_of(sides), problem.c(), &pi) {
            return None;
        }
        let excluded =
            sides.iter().enumerate().filter_map(|(k, side)| Some((k, (*side)?.complement())));
        let needed = excluded
            .filter(|&(pair, side)| !is_proof_of([problem.column(pair, side)], problem.c(), &pi))
            .map(|(pair, side)| side.of(pair, n + pair))
            .collect();
        Some(Proof { pi, needed })
    }

    /// The larger variable of every pair, if these solve the problem up to rounding.
    fn solution(&self, sides: &Sides, x: &[Extended]) -> Option<Enumerated> {
        let n = sides.len();
        let (mut t, mut y) = (vec![0.0; n], vec![0.0; n]);
        let mut basis = Vec::with_capacity(n);
        for (pair, chosen) in sides.iter().enumerate() {
            let side = match chosen {
                Some(side) => *side,
                None if x[pair] > x[n + pair] => Side::T,
                None => Side::Y,
            };
            let at = side.of(pair, n + pair);
            let value = x[at].rounded() * self.factors[at];
            side.of(&mut t, &mut y)[pair] = value;
            basis.push(side);
        }
        // All rows of a point far enough out hold compared with their terms.
        let residuals = self.judge.residuals_of(&[&extended(&t), &extended(&y)]);
        let holds = residuals.equation <= ROUNDING && residuals.loads <= MILLIONTH;
        holds.then(|| Enumerated::Found { t, y, basis: Basis::new(basis) })
    }
}
