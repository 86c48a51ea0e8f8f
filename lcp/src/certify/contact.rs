//! Displacements, forces, gaps and slips of contact.

use super::Residuals;
use super::ledger::{Digits, Entry, Ledger, Precision, Rows};
use super::weights::reciprocal;
use crate::extended::Extended;
use crate::parts::Parts;
use crate::problem::{column_factors, column_of, diagonal, median};
use crate::{Contact2d, ContactState};

impl Contact2d {
    /// Residuals of a state, dimensionless, from the data as given; [`Residuals::worst`] decides.
    ///
    /// * rows are equilibrium, `K u - f - C_n^T t_n - C_t^T t_t`, gaps, `C_n u + x_0 - g`, and slips,
    ///   `C_t u + s_0 - s`, each measured by its own terms;
    /// * pairs are normal force and gap, and the two distances `mu t_n + t_t` and `mu t_n - t_t` to the borders of
    ///   the friction cone with the slip forwards and backwards: a force counts by what it is of the terms
    ///   of its rows of equilibrium, a gap or slip by what it is of its own terms;
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
        ContactJudge::new(self).residuals(state, Precision::Exact)
    }
}

/// A contact problem with the weights of its rows: equilibrium, gaps and slips.
pub(crate) struct ContactJudge<'a> {
    problem: &'a Contact2d,
    /// The displacements that every point acts on.
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
        let [normal, tangent] = [problem.normal(), problem.tangent()].map(ByRows::of);
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
        let ledger = self.ledger(StateOf { u, t_n, t_t, openings: Some((gap, slip)) });
        if precision == Precision::Exact && ledger.is_hidden(self.length) {
            let [u, t_n, t_t, gap, slip] =
                all.map(|v| v.iter().copied().map(Extended::from).collect::<Vec<_>>());
            let openings = Some((&gap[..], &slip[..]));
            return self.residuals_of(StateOf { u: &u, t_n: &t_n, t_t: &t_t, openings });
        }
        ledger.finish(self.length, precision)
    }

    /// The same of a state of twice the digits.
    pub(crate) fn residuals_of(&self, state: StateOf<'_, Extended>) -> Residuals {
        self.ledger(state).finish(self.length, Precision::Exact)
    }

    fn ledger<X: Digits>(&self, state: StateOf<'_, X>) -> Ledger<'_> {
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
        for (j, &u) in u.iter().enumerate() {
            column_of(problem.stiffness(), j).for_each(|(i, v)| rows.add(i, v, u));
            for (i, v) in column_of(problem.normal(), j) {
                rows.add(n + i, v, u);
                rows.add(j, -v, t_n[i]);
            }
            for (i, v) in column_of(problem.tangent(), j) {
                rows.add(n + m + i, v, u);
                rows.add(j, -v, t_t[i]);
            }
        }
        let openings = match openings {
            Some((gap, slip)) => {
                assert!(gap.len() == m && slip.len() == m, "a state has the problem's lengths");
                let given: Vec<f64> = gap.iter().chain(slip).map(|v| v.rounded()).collect();
                gap.iter().chain(slip).enumerate().for_each(|(i, v)| rows.add(n + i, -1.0, *v));
                given
            }
            None => {
                let found = rows.rest[n..].iter().map(|v| v.rounded()).collect();
                rows.rest[n..].fill(X::of(0.0));
                found
            }
        };
        let mut ledger = Ledger::new(rows, &self.weights);
        for i in 0..m {
            let forces = (t_n[i].rounded(), t_t[i].rounded());
            self.conditions(i, forces, (openings[i], openings[m + i]), &mut ledger);
        }
        ledger
    }

    fn conditions(
        &self,
        i: usize,
        (t_n, t_t): (f64, f64),
        (gap, slip): (f64, f64),
        ledger: &mut Ledger<'_>,
    ) {
        let (n, m) = (self.problem.displacements(), self.problem.points());
        let [of_n, of_t] = [&self.normal, &self.tangent].map(|rows| {
            move |visit: &mut dyn FnMut(usize, f64)| {
                rows.row(i).iter().for_each(|(j, v)| visit(*j, *v));
            }
        });
        let [of_gap, of_slip] =
            [n + i, n + m + i].map(|row| move |visit: &mut dyn FnMut(usize, f64)| visit(row, 1.0));
        ledger.pair(&Entry { value: t_n, column: &of_n }, &Entry { value: gap, column: &of_gap });
        let mu = self.problem.mu()[i];
        if mu == 0.0 {
            ledger.zero(&Entry { value: t_t, column: &of_t });
            return;
        }
        let bound = mu * t_n.max(0.0);
        for (force, slip) in [(bound + t_t, slip), (bound - t_t, -slip)] {
            ledger.pair(
                &Entry { value: force, column: &of_t },
                &Entry { value: slip.max(0.0), column: &of_slip },
            );
        }
    }
}

/// The rows of a sparse matrix, one after the other.
struct ByRows {
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
}

impl ByRows {
    fn of(matrix: &faer::sparse::SparseColMat<usize, f64>) -> Self {
        let mut starts = vec![0; matrix.nrows() + 1];
        for j in 0..matrix.ncols() {
            column_of(matrix, j).for_each(|(i, _)| starts[i + 1] += 1);
        }
        for i in 0..matrix.nrows() {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut entries = vec![(0, 0.0); starts[matrix.nrows()]];
        for j in 0..matrix.ncols() {
            for (i, v) in column_of(matrix, j) {
                entries[next[i]] = (j, v);
                next[i] += 1;
            }
        }
        Self { starts, entries }
    }

    fn row(&self, i: usize) -> &[(usize, f64)] {
        &self.entries[self.starts[i]..self.starts[i + 1]]
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

fn weights(problem: &Contact2d) -> Vec<f64> {
    let (n, m) = (problem.displacements(), problem.points());
    let factors = column_factors(problem);
    let mut parts = Parts::new(n + m);
    for j in 0..n {
        let coupled = column_of(problem.stiffness(), j).map(|(i, _)| i);
        let normal = column_of(problem.normal(), j).map(|(i, _)| n + i);
        let tangent = column_of(problem.tangent(), j).filter(|(i, _)| problem.mu()[*i] > 0.0);
        let tangent = tangent.map(|(i, _)| n + i);
        parts.join_all([j].into_iter().chain(coupled).chain(normal).chain(tangent));
    }
    let of_stiffness = diagonal(problem.stiffness());
    let mut loads = vec![Loads::default(); n + m];
    for j in 0..n {
        let part = &mut loads[parts.of(j)];
        part.force = part.force.max((problem.loads()[j] * factors[j]).abs());
        part.stiffness.extend(Some(of_stiffness[j] * factors[j] * factors[j]).filter(|k| *k > 0.0));
    }
    for i in 0..m {
        let part = &mut loads[parts.of(n + i)];
        let slip = if problem.mu()[i] > 0.0 { problem.initial_slips()[i].abs() } else { 0.0 };
        part.opening = part.opening.max(problem.initial_gaps()[i].abs()).max(slip);
    }
    // One over force and length.
    let units: Vec<(f64, f64)> = loads.iter_mut().map(Loads::reciprocals).collect();
    let mut weights: Vec<f64> = (0..n).map(|j| factors[j] * units[parts.of(j)].0).collect();
    weights.extend((0..m).map(|i| units[parts.of(n + i)].1));
    let slips = (0..m).map(|i| if problem.mu()[i] > 0.0 { units[parts.of(n + i)].1 } else { 0.0 });
    weights.extend(slips);
    weights
}

impl Loads {
    fn reciprocals(&mut self) -> (f64, f64) {
        let stiffness = median(&mut self.stiffness).unwrap_or(0.0);
        let deformation = if stiffness > 0.0 { self.force / stiffness } else { 0.0 };
        let force = self.force.max(stiffness * self.opening);
        (reciprocal(force), reciprocal(self.opening.max(deformation)))
    }
}
