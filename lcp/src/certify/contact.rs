//! Displacements, forces, gaps and slips of contact.

use std::borrow::Cow;

use super::Residuals;
use super::constants::{FULL, ROUNDS, STRONG};
use super::rows::{self, Digits, Entry, InRow, Measure, Point, Precision, RowResiduals, Rows};
use super::significance::{Term, Terms};
use super::weights::{or_largest, per_load};
use crate::extended::{Extended, extended};
use crate::parts::Parts;
use crate::problem::{column_factors, column_of, diagonal, median};
use crate::sparse::ByRows;
use crate::{Contact2d, ContactState};

impl Contact2d {
    /// Residuals of a state, dimensionless, from the data as given; [`Residuals::worst`] decides.
    ///
    /// * rows are equilibrium, `K u - f - C_n^T t_n - C_t^T t_t`, gaps, `C_n u + x_0 + a_n t_n - g`, and slips,
    ///   `C_t u + s_0 + a_t t_t - s`, each measured by its own terms;
    /// * pairs are normal force and gap, and the two distances `mu t_n + t_t` and `mu t_n - t_t` to the borders of
    ///   the friction cone with the slip forwards and backwards: a force counts by what it is of the terms
    ///   of its rows of equilibrium and, with compliance, of gap or slip, a gap or slip by what it is of its own terms;
    /// * loads compare equilibrium with the largest load on the connected part of the structure, gaps and slips with
    ///   its largest initial one or what the loads would deform it by. Forces are not compared with
    ///   displacements, nor one part with another.
    ///
    /// Units do not matter, not even those of single displacements: a moment is not compared with a force. See
    /// [`HorizontalLcp::residuals`](crate::HorizontalLcp::residuals).
    ///
    /// # Panics
    /// If the lengths are not those of the problem.
    pub fn residuals(&self, state: &ContactState) -> Residuals {
        ContactJudge::new(self).residuals(state, Precision::Rounded)
    }
}

/// A contact problem with the weights of its rows: equilibrium, gaps and slips.
pub(crate) struct ContactJudge<'a> {
    problem: &'a Contact2d,
    /// The rows that the forces of every point act on: of displacements, and where it is compliant of its gap or slip.
    normal: ByRows,
    tangent: ByRows,
    weights: Vec<f64>,
    /// Terms of a row at most.
    length: f64,
}

/// A state in numbers of any kind.
#[derive(Clone, Copy)]
pub(crate) struct StateOf<'a, X> {
    pub(crate) u: &'a [X],
    pub(crate) t_n: &'a [X],
    pub(crate) t_t: &'a [X],
    /// Those of the state, or those that follow from the displacements.
    pub(crate) openings: Option<(&'a [X], &'a [X])>,
}

impl<'a> ContactJudge<'a> {
    pub(crate) fn new(problem: &'a Contact2d) -> Self {
        let matrices = [problem.stiffness(), problem.normal(), problem.tangent()];
        let terms = |j: usize| matrices.iter().map(|it| column_of(it, j).count()).sum::<usize>();
        let longest = (0..problem.displacements()).map(terms).max().unwrap_or(0);
        let (n, m) = (problem.displacements(), problem.points());
        let compliance = problem.compliance();
        let own = |k: usize, first: usize| {
            move |i: usize| Some((first + i, compliance[i][k])).filter(|(_, a)| *a > 0.0)
        };
        let normal = ByRows::with(problem.normal(), own(0, n));
        let tangent = ByRows::with(problem.tangent(), own(1, n + m));
        let length = (longest + 2) as f64;
        Self { problem, normal, tangent, weights: weights(problem), length }
    }

    /// # Panics
    /// If the lengths are not those of the problem.
    pub(crate) fn residuals(&self, state: &ContactState, precision: Precision) -> Residuals {
        let ContactState { u, t_n, t_t, gap, slip } = state;
        let all = [u, t_n, t_t, gap, slip];
        if all.iter().any(|v| v.iter().any(|v| !v.is_finite())) {
            return Residuals::infinite();
        }
        let measure = self.measure();
        let at = self.at(StateOf { u, t_n, t_t, openings: Some((gap, slip)) });
        rows::residuals_or_refined(&at, measure, precision, || {
            let [u, t_n, t_t, gap, slip] = &all.map(|v| extended(v));
            let at = self.at(StateOf { u, t_n, t_t, openings: Some((gap, slip)) });
            rows::residuals(&at, measure, precision)
        })
    }

    /// The same of a state of twice the digits.
    pub(crate) fn residuals_of(&self, state: StateOf<'_, Extended>) -> Residuals {
        rows::residuals(&self.at(state), self.measure(), Precision::Exact)
    }

    fn measure(&self) -> Measure<'_> {
        Measure { weights: &self.weights, length: self.length }
    }

    fn at<'b, X: Digits>(&'b self, state: StateOf<'b, X>) -> JudgedPoint<'b, X> {
        let problem = self.problem;
        let (n, m) = (problem.displacements(), problem.points());
        let StateOf { u, t_n, t_t, openings } = state;
        assert!(
            u.len() == n && t_n.len() == m && t_t.len() == m,
            "a state has the problem's lengths"
        );
        let first = problem.loads().iter().map(|f| (-f, f.abs()));
        let first = first.chain(problem.initial_gaps().iter().map(|x| (*x, x.abs())));
        let first = first.chain(problem.initial_slips().iter().map(|s| (*s, s.abs())));
        let mut rows = Rows::<X>::new(first);
        terms_of(problem, state, &mut |i, v, x| rows.add(i, v, x));
        let openings = if let Some((gap, slip)) = openings {
            assert!(gap.len() == m && slip.len() == m, "a state has the problem's lengths");
            gap.iter().chain(slip).enumerate().for_each(|(i, v)| rows.add(n + i, -1.0, *v));
            gap.iter().chain(slip).map(|v| v.rounded()).collect()
        } else {
            let found = rows.rest[n..].iter().map(|v| v.rounded()).collect();
            rows.rest[n..].fill(X::of(0.0));
            found
        };
        JudgedPoint { judge: self, state, openings, rows: rows.rounded() }
    }

    fn conditions_of(
        &self,
        i: usize,
        [t_n, t_t]: [f64; 2],
        [gap, slip]: [f64; 2],
        out: &mut RowResiduals<'_>,
    ) {
        let (n, m) = (self.problem.displacements(), self.problem.points());
        let [of_n, of_t] = [&self.normal, &self.tangent].map(|rows| rows.row(i));
        let [of_gap, of_slip] = [n + i, n + m + i].map(InRow);
        out.pair(Entry { value: t_n, column: of_n }, Entry { value: gap, column: of_gap });
        let mu = self.problem.mu()[i];
        if mu == 0.0 {
            out.zero(Entry { value: t_t, column: of_t });
            return;
        }
        let bound = mu * t_n.max(0.0);
        for (force, slip) in [(bound + t_t, slip), (bound - t_t, -slip)] {
            out.pair(
                Entry { value: force, column: of_t },
                Entry { value: slip.max(0.0), column: of_slip },
            );
        }
    }
}

/// A state with the sums of its rows.
struct JudgedPoint<'a, X> {
    judge: &'a ContactJudge<'a>,
    state: StateOf<'a, X>,
    /// Gaps, then slips.
    openings: Vec<f64>,
    rows: (Vec<f64>, Vec<f64>),
}

/// The terms of all rows with displacements and forces: row, coefficient and variable, with its number.
fn terms_of<X: Digits>(
    problem: &Contact2d,
    StateOf { u, t_n, t_t, .. }: StateOf<'_, X>,
    visit: &mut impl FnMut(usize, f64, X),
) {
    let (n, m) = (problem.displacements(), problem.points());
    for (j, &u) in u.iter().enumerate() {
        column_of(problem.stiffness(), j).for_each(|(i, v)| visit(i, v, u));
        for (i, v) in column_of(problem.normal(), j) {
            visit(n + i, v, u);
            visit(j, -v, t_n[i]);
        }
        for (i, v) in column_of(problem.tangent(), j) {
            visit(n + m + i, v, u);
            visit(j, -v, t_t[i]);
        }
    }
    for (i, [normal, tangential]) in problem.compliance().iter().enumerate() {
        for (row, a, t) in [(n + i, *normal, t_n[i]), (n + m + i, *tangential, t_t[i])] {
            if a > 0.0 {
                visit(row, a, t);
            }
        }
    }
}

impl<X: Digits> Point for JudgedPoint<'_, X> {
    fn rows(&self) -> (Cow<'_, [f64]>, Cow<'_, [f64]>) {
        let (rest, terms) = &self.rows;
        (rest[..].into(), terms[..].into())
    }

    /// Loads down to a millionth of those around them count in full, smaller ones by their size: of a body that
    /// comes to rest nothing is left but rounding errors. Gaps and slips are differences of positions and have
    /// their rounding errors: they count by what they are of the lengths around them.
    fn sources(&self) -> Vec<f64> {
        let problem = self.judge.problem;
        let loads = problem.loads().iter().map(|f| f / FULL);
        let openings = problem.initial_gaps().iter().chain(problem.initial_slips()).copied();
        let all = loads.chain(openings).zip(&self.judge.weights);
        all.map(|(v, weight)| (v.abs() * weight).min(1.0)).collect()
    }

    fn conditions(&self, out: &mut RowResiduals<'_>) {
        let StateOf { t_n, t_t, .. } = self.state;
        let m = t_n.len();
        for i in 0..m {
            let forces = [t_n[i].rounded(), t_t[i].rounded()];
            let openings = [self.openings[i], self.openings[m + i]];
            self.judge.conditions_of(i, forces, openings, out);
        }
    }
}

impl<X: Digits> Terms for JudgedPoint<'_, X> {
    fn for_each_term(&self, mut visit: impl FnMut(Term)) {
        let problem = self.judge.problem;
        let (n, m) = (problem.displacements(), problem.points());
        let mut add = |row: usize, variable: usize, value: f64| {
            if value != 0.0 {
                visit(Term { row, variable, value });
            }
        };
        let StateOf { u, t_n, t_t, .. } = self.state;
        for (j, u) in u.iter().enumerate() {
            column_of(problem.stiffness(), j).for_each(|(i, v)| add(i, j, v * u.rounded()));
            for (i, v) in column_of(problem.normal(), j) {
                add(n + i, j, v * u.rounded());
                add(j, n + i, v * t_n[i].rounded());
            }
            for (i, v) in column_of(problem.tangent(), j) {
                add(n + m + i, j, v * u.rounded());
                add(j, n + m + i, v * t_t[i].rounded());
            }
        }
        for (i, [normal, tangential]) in problem.compliance().iter().enumerate() {
            add(n + i, n + i, normal * t_n[i].rounded());
            add(n + m + i, n + m + i, tangential * t_t[i].rounded());
        }
        let openings = self.openings.iter().enumerate();
        openings.for_each(|(i, v)| add(n + i, n + 2 * m + i, *v));
    }
}

/// Sizes of the loads of a connected part, with displacements by their [factors](column_factors).
#[derive(Default, Clone)]
struct Loads {
    force: f64,
    /// The largest initial gap or slip.
    opening: f64,
    stiffness: Vec<f64>,
}

/// Displacements and points, with how strongly they are coupled, at most by one.
struct Couplings<'a> {
    problem: &'a Contact2d,
    factors: Vec<f64>,
    diagonal: Vec<f64>,
    /// The largest coefficient of every point, of gap or slip.
    largest: Vec<f64>,
}

impl Couplings<'_> {
    fn for_each(&self, mut visit: impl FnMut(usize, usize, f64)) {
        let n = self.factors.len();
        for j in 0..n {
            for (i, v) in column_of(self.problem.stiffness(), j).filter(|(i, _)| *i > j) {
                let size = (self.diagonal[i] * self.diagonal[j]).sqrt();
                visit(i, j, if size > 0.0 { (v.abs() / size).min(1.0) } else { 1.0 });
            }
            self.of_points(j, |i, v| visit(n + i, j, v / self.largest[i]));
        }
    }

    /// The sizes of the coefficients of a displacement at the points.
    fn of_points(&self, j: usize, mut visit: impl FnMut(usize, f64)) {
        let tangent = column_of(self.problem.tangent(), j);
        let tangent = tangent.filter(|(i, _)| self.problem.mu()[*i] > 0.0);
        let all = column_of(self.problem.normal(), j).chain(tangent).filter(|(_, v)| *v != 0.0);
        all.for_each(|(i, v)| visit(i, v.abs() * self.factors[j]));
    }
}

fn weights(problem: &Contact2d) -> Vec<f64> {
    let (n, m) = (problem.displacements(), problem.points());
    let factors = column_factors(problem);
    let diagonal = diagonal(problem.stiffness());
    let mut couplings = Couplings { problem, factors, diagonal, largest: vec![0.0; m] };
    let mut largest = vec![0.0_f64; m];
    (0..n).for_each(|j| couplings.of_points(j, |i, v| largest[i] = largest[i].max(v)));
    couplings.largest = largest;
    let mut parts = Parts::new(n + m);
    let mut weak = Vec::new();
    couplings.for_each(|a, b, coupling| {
        if coupling >= STRONG {
            parts.join(a, b);
        } else if coupling > 0.0 {
            weak.push((a, b, coupling));
        }
    });
    let mut loads = vec![Loads::default(); n + m];
    let Couplings { factors, diagonal, .. } = couplings;
    for j in 0..n {
        let part = &mut loads[parts.of(j)];
        part.force = part.force.max((problem.loads()[j] * factors[j]).abs());
        part.stiffness.extend(Some(diagonal[j] * factors[j] * factors[j]).filter(|k| *k > 0.0));
    }
    for i in 0..m {
        let part = &mut loads[parts.of(n + i)];
        let slip = if problem.mu()[i] > 0.0 { problem.initial_slips()[i].abs() } else { 0.0 };
        part.opening = part.opening.max(problem.initial_gaps()[i].abs()).max(slip);
        part.stiffness.extend(problem.springs_of(i));
    }
    let mut felt: Vec<(f64, f64)> = loads.iter_mut().map(Loads::felt).collect();
    for _ in 0..ROUNDS {
        for &(a, b, coupling) in &weak {
            for (from, to) in [(parts.of(a), parts.of(b)), (parts.of(b), parts.of(a))] {
                felt[to].0 = felt[to].0.max(coupling * felt[from].0);
                felt[to].1 = felt[to].1.max(coupling * felt[from].1);
            }
        }
    }
    let largest = felt.iter().fold((0.0_f64, 0.0_f64), |max, v| (max.0.max(v.0), max.1.max(v.1)));
    let force = |part: usize| per_load(1.0, or_largest(felt[part].0, largest.0));
    let length = |part: usize| per_load(1.0, or_largest(felt[part].1, largest.1));
    let mut weights: Vec<f64> = (0..n).map(|j| factors[j] * force(parts.of(j))).collect();
    let lengths: Vec<f64> = (0..m).map(|i| length(parts.of(n + i))).collect();
    let slips = lengths.iter().zip(problem.mu()).map(|(w, mu)| if *mu > 0.0 { *w } else { 0.0 });
    let slips: Vec<f64> = slips.collect();
    weights.extend(lengths);
    weights.extend(slips);
    weights
}

impl Loads {
    /// The force and the length that the part feels.
    fn felt(&mut self) -> (f64, f64) {
        let stiffness = median(&mut self.stiffness).unwrap_or(0.0);
        let deformation = if stiffness > 0.0 { self.force / stiffness } else { 0.0 };
        (self.force.max(stiffness * self.opening), self.opening.max(deformation))
    }
}
