//! A continuation for problems on which pivots end on a ray: mixed, indefinite, of any class.
//!
//! `phi(t, y) = t + y - sqrt(t^2 + y^2 + 2 mu)` vanishes exactly where `t` and `y` are positive with `t y = mu`
//! (Kanzow 1996, after Fischer and Burmeister). Newton's method on these equations, one for every pair, and on
//! `A t + B y = c` follows their solutions as `mu` goes to zero. Every step moves the pairs to the
//! linearised `phi = 0` and along it, with one unknown each, so that it costs one factorisation of
//! order `n`. Nothing guarantees that it arrives; where it does not, another start may. What comes out is
//! no answer yet but the sides on which to look for one.

use std::time::Instant;

use faer::Mat;

use crate::linear::Lu;
use crate::matrix::Column;
use crate::random::SplitMix;
use crate::scaling::equilibrate;
use crate::sparse::{Columns, SparseLu};
use crate::vector::max_abs;
use crate::{Basis, HorizontalLcp, Side};

/// `mu` at the end, for a right-hand side of size one. Theory: `t y` of rounding errors.
const LAST: f64 = 1e-18;
/// By how much `mu` falls. Chosen.
const FALL: f64 = 0.1;
/// By how much where one step was enough. Chosen.
const FAST: f64 = 1e-3;
/// How near a point has to be before `mu` falls, in units of `sqrt(mu)`. Chosen.
const NEAR: f64 = 0.3;
/// Least share of the decrease that the linear model promises. Theory: the usual value of Armijo.
const DECREASE: f64 = 1e-4;
/// Halvings of a step. Chosen.
const HALVINGS: usize = 25;

/// When to give up.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    /// Steps, each with a factorisation.
    pub(crate) steps: usize,
    pub(crate) deadline: Option<Instant>,
}

/// Where a continuation ended.
#[derive(Debug, Clone)]
pub(crate) struct Suggestion {
    /// The point, with the smaller variable of every pair set to zero.
    pub(crate) t: Vec<f64>,
    pub(crate) y: Vec<f64>,
    /// The sides of the larger ones.
    pub(crate) basis: Basis,
}

/// Follows the solutions from the start of that number: 0 has equal variables, the others are random.
/// `None` where it did not come to the end.
pub(crate) fn follow(problem: &HorizontalLcp, start: u64, limits: Limits) -> Option<Suggestion> {
    let data = Data::new(problem);
    let (mut at, mut mu) = (data.start(start), 1.0);
    let mut count = 0;
    while mu > LAST {
        let near = NEAR * (mu * data.order() as f64).sqrt();
        let before = count;
        let mut merit = data.merit(&at, mu);
        while merit > near {
            if count >= limits.steps || limits.deadline.is_some_and(|it| Instant::now() >= it) {
                return None;
            }
            count += 1;
            let step = data.step(&at, mu)?;
            (at, merit) = data.along(&at, &step, (mu, merit))?;
        }
        mu *= if count <= before + 1 { FAST } else { FALL };
    }
    // Near the end a step gives twice the digits.
    let merit = data.merit(&at, mu);
    if let Some((last, _)) = data.step(&at, mu).and_then(|it| data.along(&at, &it, (mu, merit))) {
        at = last;
    }
    Some(data.suggestion(&at))
}

/// A value of `t` and of `y` for every pair; for a free variable `t` is its value, of either sign.
type Pairs = Vec<(f64, f64)>;

/// The equilibrated problem, with a right-hand side of size one.
struct Data {
    entries: Entries,
    right: Vec<f64>,
    /// For a free pair the `r` with `B_j = -r A_j`.
    opposite: Vec<Option<f64>>,
    /// Values in the problem's units of a unit of `t` and of `y`.
    units: Pairs,
}

/// The columns of `t`, then those of `y`.
enum Entries {
    Dense(Mat<f64>),
    Sparse(Columns),
}

enum Factors {
    Dense(Lu),
    Sparse(SparseLu),
}

impl Data {
    fn new(problem: &HorizontalLcp) -> Self {
        let n = problem.order();
        let columns = problem.columns();
        let (rows, cols) = equilibrate(n, &columns);
        let right: Vec<f64> = problem.c().iter().zip(&rows).map(|(c, row)| c * row).collect();
        let size = if max_abs(&right) > 0.0 { max_abs(&right) } else { 1.0 };
        let scaled = columns.iter().zip(&cols);
        let entries = if problem.is_sparse() {
            let mut sparse = Columns::default();
            for (column, col) in scaled {
                column.for_each(|i, v| sparse.push(i, col * (v * rows[i])));
                sparse.close();
            }
            Entries::Sparse(sparse)
        } else {
            let mut dense = Mat::zeros(n, 2 * n);
            for (j, (column, col)) in scaled.enumerate() {
                let out = dense.col_as_slice_mut(j);
                column.for_each(|i, v| out[i] += col * (v * rows[i]));
            }
            Entries::Dense(dense)
        };
        Self {
            entries,
            right: right.into_iter().map(|c| c / size).collect(),
            opposite: (0..n).map(|pair| problem.opposite(pair)).collect(),
            units: (0..n).map(|j| (size * cols[j], size * cols[n + j])).collect(),
        }
    }

    fn order(&self) -> usize {
        self.right.len()
    }

    /// Pairs with `t y = 1`.
    fn start(&self, number: u64) -> Pairs {
        let mut random = SplitMix::new(number);
        let value = |free: &Option<f64>| {
            let t = if number == 0 { 1.0 } else { (6.0 * random.next_f64() - 3.0).exp2() };
            if free.is_some() { (t.log2(), 0.0) } else { (t, 1.0 / t) }
        };
        self.opposite.iter().map(value).collect()
    }

    /// `c - A t - B y`.
    fn rest(&self, at: &Pairs) -> Vec<f64> {
        let mut rest = self.right.clone();
        for (j, &(t, y)) in at.iter().enumerate() {
            self.entries.add(j, -t, &mut rest);
            self.entries.add(self.order() + j, -y, &mut rest);
        }
        rest
    }

    /// The norm of all equations.
    fn merit(&self, at: &Pairs, mu: f64) -> f64 {
        let rest = self.rest(at).into_iter();
        let pairs = at.iter().zip(&self.opposite).filter(|(_, free)| free.is_none());
        let phi = pairs.map(|(&pair, _)| Phi::new(pair, mu).value);
        rest.chain(phi).map(|v| v * v).sum::<f64>().sqrt()
    }

    /// Newton's step: to the linearised `phi = 0` of every pair by the shortest way, and along it as the
    /// rows ask for.
    fn step(&self, at: &Pairs, mu: f64) -> Option<Pairs> {
        let linear = at.iter().zip(&self.opposite).map(|(&pair, free)| match free {
            Some(_) => Line { base: (0.0, 0.0), along: (1.0, 0.0) },
            None => Phi::new(pair, mu).line(),
        });
        let lines: Vec<Line> = linear.collect();
        let base: Pairs = at.iter().zip(&lines).map(|(at, line)| sum(*at, line.base)).collect();
        let mut x = self.rest(&base);
        self.entries.factorised(&lines)?.solve(&mut x);
        let moved = |(line, x): (&Line, &f64)| sum(line.base, (x * line.along.0, x * line.along.1));
        x.iter().all(|x| x.is_finite()).then(|| lines.iter().zip(&x).map(moved).collect())
    }

    /// The first point along a step, halved again and again, that is better enough.
    fn along(&self, at: &Pairs, step: &Pairs, (mu, merit): (f64, f64)) -> Option<(Pairs, f64)> {
        let tried = (0..HALVINGS).map(|halvings| {
            let share = 0.5_f64.powi(i32::try_from(halvings).unwrap_or(i32::MAX));
            let moved =
                |(at, step): (&(f64, f64), &(f64, f64))| sum(*at, (share * step.0, share * step.1));
            let next: Pairs = at.iter().zip(step).map(moved).collect();
            let reached = self.merit(&next, mu);
            (reached <= (1.0 - DECREASE * share) * merit).then_some((next, reached))
        });
        tried.flatten().next()
    }

    fn suggestion(&self, at: &Pairs) -> Suggestion {
        let (mut t, mut y, mut sides) = (Vec::new(), Vec::new(), Vec::new());
        for ((pair, free), unit) in at.iter().zip(&self.opposite).zip(&self.units) {
            let (t_value, y_value) = (pair.0 * unit.0, pair.1 * unit.1);
            let (t_value, y_value, side) = match free {
                Some(_) if t_value >= 0.0 => (t_value, 0.0, Side::T),
                Some(ratio) => (0.0, -t_value / ratio, Side::Y),
                None if pair.0 > pair.1 => (t_value, 0.0, Side::T),
                None => (0.0, y_value, Side::Y),
            };
            t.push(t_value.max(0.0));
            y.push(y_value.max(0.0));
            sides.push(side);
        }
        Suggestion { t, y, basis: Basis::new(sides) }
    }
}

/// `phi` at a pair, with its derivatives, which are between 0 and 2 and not both small.
struct Phi {
    value: f64,
    by_t: f64,
    by_y: f64,
}

impl Phi {
    fn new((t, y): (f64, f64), mu: f64) -> Self {
        let root = t.hypot(y).hypot((2.0 * mu).sqrt());
        // Without the cancellation of a sum with its root.
        let value = if t + y > 0.0 { 2.0 * (t * y - mu) / (t + y + root) } else { t + y - root };
        Self { value, by_t: 1.0 - t / root, by_y: 1.0 - y / root }
    }

    /// The pairs for which the linearised value is zero.
    fn line(&self) -> Line {
        let share = -self.value / (self.by_t * self.by_t + self.by_y * self.by_y);
        Line { base: (share * self.by_t, share * self.by_y), along: (-self.by_y, self.by_t) }
    }
}

struct Line {
    base: (f64, f64),
    along: (f64, f64),
}

impl Entries {
    fn add(&self, j: usize, factor: f64, out: &mut [f64]) {
        match self {
            Self::Dense(m) => Column::Dense(m.col_as_slice(j)).add_to(factor, out),
            Self::Sparse(columns) => columns.add_to(j, factor, out),
        }
    }

    /// The matrix of what every pair does to the rows along its line, `None` where it is singular.
    fn factorised(&self, lines: &[Line]) -> Option<Factors> {
        let n = lines.len();
        match self {
            Self::Dense(_) => {
                let mut m = Mat::zeros(n, n);
                for (j, line) in lines.iter().enumerate() {
                    self.add(j, line.along.0, m.col_as_slice_mut(j));
                    self.add(n + j, line.along.1, m.col_as_slice_mut(j));
                }
                Lu::new(m.as_ref()).map(Factors::Dense)
            }
            Self::Sparse(columns) => {
                let mut m = Columns::default();
                for (j, line) in lines.iter().enumerate() {
                    let of = |j: usize, factor: f64| {
                        columns.entries(j).map(move |(i, v)| (i, factor * v))
                    };
                    let mut entries: Vec<(usize, f64)> =
                        of(j, line.along.0).chain(of(n + j, line.along.1)).collect();
                    entries.sort_by_key(|(i, _)| *i);
                    for same in entries.chunk_by(|a, b| a.0 == b.0) {
                        m.push(same[0].0, same.iter().map(|(_, v)| v).sum());
                    }
                    m.close();
                }
                let (lu, replaced) = SparseLu::new(&m);
                replaced.is_empty().then_some(Factors::Sparse(lu))
            }
        }
    }
}

impl Factors {
    fn solve(&self, x: &mut [f64]) {
        match self {
            Self::Dense(lu) => lu.solve_vector(x),
            Self::Sparse(lu) => lu.solve(x, &mut Vec::new()),
        }
    }
}

fn sum(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0 + b.0, a.1 + b.1)
}

#[cfg(test)]
mod tests;
