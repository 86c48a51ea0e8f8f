//! Contact with the displacements eliminated.

use super::delassus::{Compliance, Delassus};
use super::{Constraint, Point, ProjectedGaussSeidel, Sweepable, Sweeps};
use crate::certify::{ContactJudge, Precision};
use crate::problem::column_of;
use crate::sparse::Columns;
use crate::{Contact2d, ContactState, Error, Observer, Solution};

/// On the forces, in the pairs of [`Contact2d::to_general`]: the displacements follow from them where `K`
/// is positive definite, and the compliances of the contacts are on the diagonal. Bodies that `K` does not couple are
/// eliminated one by one.
impl Sweepable for Contact2d {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        solver.settings.validate(self.order())?;
        let mut monitor = solver.monitor(observer);
        let layout = Layout::new(self);
        let start = solver.start(|t, y| layout.forces(&self.recover(t, y)))?;
        let compliance = Compliance::new(self.stiffness(), layout.rows()?, layout.own())?;
        let free = compliance.displacements(self.loads(), &vec![0.0; layout.order]);
        let q = layout.velocities(&free);
        let state =
            |forces: &[f64]| layout.state(compliance.displacements(self.loads(), forces), forces);
        let constraint = |&mu: &f64| {
            if mu > 0.0 { Constraint::Friction { mu } } else { Constraint::NONNEGATIVE }
        };
        let constraints: Vec<Constraint> = self.mu().iter().map(constraint).collect();
        let mut rows = Delassus::new(&compliance);
        let sweeps = Sweeps::new(&solver.settings, &mut rows, &q, &constraints, start)?;
        let judge = ContactJudge::new(self);
        let (best, status) = sweeps.run(&mut monitor, &mut |point: &Point<'_>| {
            judge.residuals(&state(point.z), Precision::Exact)
        });
        let state = state(&best.z);
        let (t, y) = self.to_pairs(&state);
        let mut solution = solver.solution(t, y, best.residuals, status, monitor);
        solution.contact = Some(state);
        solution.info.factorisations = compliance.factorisations();
        Ok(solution)
    }
}

/// The rows of the forces: the normal one of every point, and after it the tangential one where there is
/// friction.
struct Layout<'a> {
    problem: &'a Contact2d,
    /// Number of rows.
    order: usize,
}

impl<'a> Layout<'a> {
    fn new(problem: &'a Contact2d) -> Self {
        Self { problem, order: problem.points() + problem.frictional().len() }
    }

    /// The normal row of every point, and its tangential one.
    fn places(&self) -> impl Iterator<Item = (usize, Option<usize>)> + '_ {
        let mut next = 0;
        self.problem.mu().iter().map(move |&mu| {
            let normal = next;
            let tangential = (mu > 0.0).then_some(normal + 1);
            next = normal + 1 + usize::from(mu > 0.0);
            (normal, tangential)
        })
    }

    /// `C`, of which no row may be empty.
    fn rows(&self) -> Result<Columns, Error> {
        let mut entries = vec![Vec::new(); self.order];
        let places: Vec<_> = self.places().collect();
        for j in 0..self.problem.displacements() {
            for (point, v) in column_of(self.problem.normal(), j) {
                entries[places[point].0].push((j, v));
            }
            for (point, v) in column_of(self.problem.tangent(), j) {
                if let Some(tangential) = places[point].1 {
                    entries[tangential].push((j, v));
                }
            }
        }
        for (point, (normal, tangential)) in places.into_iter().enumerate() {
            let rows = [("gap", Some(normal)), ("slip", tangential)];
            let is_empty = |row: usize| entries[row].iter().all(|(_, v)| *v == 0.0);
            if let Some((what, _)) = rows.into_iter().find(|(_, row)| row.is_some_and(is_empty)) {
                return Err(ProjectedGaussSeidel::not_treated(format!(
                    "the {what} of contact point {point} does not depend on the displacements: leave the \
                     point out, or take Lemke's method"
                )));
            }
        }
        let mut rows = Columns::default();
        for entries in entries {
            entries.into_iter().filter(|(_, v)| *v != 0.0).for_each(|(j, v)| rows.push(j, v));
            rows.close();
        }
        Ok(rows)
    }

    /// How far the force of every row opens its contact by itself.
    fn own(&self) -> Vec<f64> {
        let [normal, tangential] = [0, 1].map(|k| {
            let of_points = self.problem.compliance().iter().map(|it| it[k]);
            of_points.collect::<Vec<f64>>()
        });
        self.by_rows(&normal, &tangential)
    }

    fn forces(&self, state: &ContactState) -> Vec<f64> {
        self.by_rows(&state.t_n, &state.t_t)
    }

    /// Gaps and slips.
    fn velocities(&self, u: &[f64]) -> Vec<f64> {
        let none = vec![0.0; self.problem.points()];
        let state = self.problem.state(u.to_vec(), none.clone(), none);
        self.by_rows(&state.gap, &state.slip)
    }

    fn by_rows(&self, normal: &[f64], tangential: &[f64]) -> Vec<f64> {
        let points = self.places().zip(normal).zip(tangential);
        points
            .flat_map(|(((_, row), normal), tangential)| {
                std::iter::once(*normal).chain(row.map(|_| *tangential))
            })
            .collect()
    }

    fn state(&self, u: Vec<f64>, forces: &[f64]) -> ContactState {
        let by_points = self.places().map(|(normal, tangential)| {
            (forces[normal], tangential.map_or(0.0, |tangential| forces[tangential]))
        });
        let (t_n, t_t) = by_points.unzip();
        self.problem.state(u, t_n, t_t)
    }
}
