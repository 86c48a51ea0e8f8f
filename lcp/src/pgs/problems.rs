//! Problems with a matrix.

use super::{Constraint, MatrixRows, Point, ProjectedGaussSeidel, Sweepable, Sweeps};
use crate::certify::{BoxedJudge, GeneralJudge, Precision};
use crate::{
    BoxedLcp, ContactForces, Error, Friction2d, HorizontalLcp, Lcp, Matrix, Observer, Residuals,
    Solution,
};

type Pairs = (Vec<f64>, Vec<f64>);
type Start<'a> = dyn Fn(&[f64], &[f64]) -> Vec<f64> + 'a;
type PairsOf<'a> = dyn Fn(&[f64], &[f64]) -> Pairs + 'a;

/// A matrix problem, and how its points are judged.
struct Task<'a> {
    /// Pairs of the general form.
    order: usize,
    /// Of `z` and the part of `w` that the constraints allow.
    residuals: &'a dyn Fn(&[f64], &[f64]) -> Residuals,
    /// Whether the point is that of a boxed problem.
    is_boxed: bool,
    matrix: &'a Matrix,
    q: &'a [f64],
    constraints: &'a [Constraint],
    /// `z` from a point of the general problem.
    start: &'a Start<'a>,
    /// The point of the general problem, from `z` and the part of `w` that the constraints allow.
    pairs: &'a PairsOf<'a>,
}

impl Sweepable for Lcp {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let judge = BoxedJudge::of_standard(self);
        let task = Task {
            is_boxed: false,
            order: self.order(),
            residuals: &|z, w| judge.residuals(z, w, Precision::Exact),
            matrix: self.m(),
            q: self.q(),
            constraints: &vec![Constraint::NONNEGATIVE; self.order()],
            start: &|t, _| t.to_vec(),
            pairs: &|z, w| (z.to_vec(), w.to_vec()),
        };
        solver.sweep_matrix(&task, observer)
    }
}

/// Judged on the problem as it stands.
impl Sweepable for HorizontalLcp {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let standard = self.to_standard().ok_or_else(|| {
            ProjectedGaussSeidel::not_treated(
                "it is not in the standard form, with a column of a single entry in every pair, each in \
                 another row: take Lemke's method",
            )
        })?;
        let judge = GeneralJudge::new(self);
        let residuals = |z: &[f64], w: &[f64]| {
            let (t, y) = standard.to_pairs(z, w);
            judge.residuals(&t, &y, Precision::Exact)
        };
        let task = Task {
            is_boxed: false,
            order: self.order(),
            residuals: &residuals,
            matrix: standard.lcp().m(),
            q: standard.lcp().q(),
            constraints: &vec![Constraint::NONNEGATIVE; self.order()],
            start: &|t, y| standard.from_pairs(t, y).0,
            pairs: &|z, w| standard.to_pairs(z, w),
        };
        solver.sweep_matrix(&task, observer)
    }
}

/// In the pairs of [`BoxedLcp::to_general`].
impl Sweepable for BoxedLcp {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let bounds = self.lower().iter().zip(self.upper());
        let constraints: Vec<Constraint> =
            bounds.map(|(&lower, &upper)| Constraint::Bounds { lower, upper }).collect();
        let judge = BoxedJudge::of_boxed(self);
        let task = Task {
            is_boxed: true,
            order: self.to_general().order(),
            residuals: &|z, w| judge.residuals(z, w, Precision::Exact),
            matrix: self.m(),
            q: self.q(),
            constraints: &constraints,
            start: &|t, y| self.recover(t, y).0,
            pairs: &|z, w| self.to_pairs(z, w),
        };
        solver.sweep_matrix(&task, observer)
    }
}

/// In the pairs of [`Friction2d::standard`].
impl Sweepable for Friction2d {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let constraints: Vec<Constraint> =
            self.mu().iter().map(|&mu| Constraint::Friction { mu }).collect();
        let residuals = |r: &[f64], _: &[f64]| {
            let [normal, tangential] =
                [0, 1].map(|k| r.iter().skip(k).step_by(2).copied().collect::<Vec<f64>>());
            self.residuals(&ContactForces { normal, tangential })
        };
        let task = Task {
            is_boxed: false,
            order: self.order(),
            residuals: &residuals,
            matrix: self.w(),
            q: self.q(),
            constraints: &constraints,
            start: &|t, _| {
                let forces = self.forces(t);
                let both = forces.normal.into_iter().zip(forces.tangential);
                both.flat_map(|(normal, tangential)| [normal, tangential]).collect()
            },
            pairs: &|r, v| standard_pairs(self.mu(), r, v),
        };
        solver.sweep_matrix(&task, observer)
    }
}

/// The variables of the standard problem, from forces within the cones and the velocities that they
/// allow: sliding is what the velocity is at the border of the cone.
fn standard_pairs(mu: &[f64], r: &[f64], v: &[f64]) -> Pairs {
    let contacts = r.chunks_exact(2).zip(v.chunks_exact(2)).zip(mu);
    let pairs = contacts.flat_map(|((r, v), mu)| {
        let bound = mu * r[0];
        let (shifted, rest) = (r[1] + bound, bound - r[1]);
        [(r[0], v[0]), (shifted, v[1].max(0.0)), ((-v[1]).max(0.0), rest)]
    });
    pairs.unzip()
}

impl ProjectedGaussSeidel {
    fn sweep_matrix(
        &self,
        task: &Task<'_>,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        self.settings.validate(task.order)?;
        let mut monitor = self.monitor(observer);
        let start = self.start(task.start)?;
        let mut rows = MatrixRows::new(task.matrix);
        let sweeps = Sweeps::new(&self.settings, &mut rows, task.q, task.constraints, start)?;
        let (best, status) = sweeps
            .run(&mut monitor, &mut |point: &Point<'_>| (task.residuals)(point.z, point.allowed));
        let pairs = (task.pairs)(&best.z, &best.allowed);
        let mut solution = self.solution(pairs.0, pairs.1, best.residuals, status, monitor);
        solution.boxed = task.is_boxed.then(|| (best.z.clone(), best.allowed.clone()));
        Ok(solution)
    }
}
