//! The problems of the library.

use super::delassus::{Compliance, Delassus};
use super::{Constraint, MatrixRows, ProjectedGaussSeidel, Sweepable, Sweeps};
use crate::certify::{BoxedJudge, ContactJudge, GeneralJudge, Precision};
use crate::{
    BoxedLcp, Contact2d, ContactForces, Error, Friction2d, HorizontalLcp, Lcp, Observer, Solution,
};

impl Sweepable for Lcp {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let (lower, upper) = (vec![0.0; self.order()], vec![f64::INFINITY; self.order()]);
        let boxed = BoxedLcp::new(self.m().clone(), self.q().to_vec(), lower, upper)?;
        Ok(Solution { boxed: None, ..boxed.solve_by(solver, observer)? })
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
        let mut monitor = solver.monitor(observer);
        let start = solver.start(self.order(), |t, y| standard.from_pairs(t, y).0)?;
        let mut rows = MatrixRows::new(standard.lcp().m());
        let constraints = vec![Constraint::NONNEGATIVE; self.order()];
        let q = standard.lcp().q();
        let sweeps = Sweeps::new(&solver.settings, &mut rows, q, &constraints, start)?;
        let judge = GeneralJudge::new(self);
        let (best, status) = sweeps.run(&mut monitor, &mut |point| {
            let (t, y) = standard.to_pairs(&point.z, &point.allowed);
            judge.residuals(&[&t, &y], Precision::Exact)
        });
        let (t, y) = standard.to_pairs(&best.z, &best.allowed);
        Ok(solver.solution(t, y, best.residuals, status, monitor))
    }
}

/// In the pairs of [`BoxedLcp::to_general`].
impl Sweepable for BoxedLcp {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let mut monitor = solver.monitor(observer);
        let start = solver.start(self.pairs(), |t, y| self.recover(t, y).0)?;
        let bounds = self.lower().iter().zip(self.upper());
        let constraints: Vec<Constraint> =
            bounds.map(|(&lower, &upper)| Constraint::Bounds { lower, upper }).collect();
        let mut rows = MatrixRows::new(self.m());
        let sweeps = Sweeps::new(&solver.settings, &mut rows, self.q(), &constraints, start)?;
        let judge = BoxedJudge::of_boxed(self);
        let (best, status) = sweeps.run(&mut monitor, &mut |point| {
            judge.residuals(&[&point.z, &point.allowed], Precision::Exact)
        });
        let (t, y) = self.to_pairs(&best.z, &best.allowed);
        let solution = solver.solution(t, y, best.residuals, status, monitor);
        Ok(Solution { boxed: Some((best.z, best.allowed)), ..solution })
    }
}

/// In the pairs of [`Friction2d::standard`].
impl Sweepable for Friction2d {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let mut monitor = solver.monitor(observer);
        let start = solver.start(self.order(), |t, _| {
            let ContactForces { normal, tangential } = self.forces(t);
            interleaved(&normal, &tangential)
        })?;
        let mut rows = MatrixRows::new(self.w());
        let constraints = cones(self.mu());
        let sweeps = Sweeps::new(&solver.settings, &mut rows, self.q(), &constraints, start)?;
        let (best, status) = sweeps.run(&mut monitor, &mut |point| {
            let [normal, tangential] = parted(&point.z);
            self.residuals(&ContactForces { normal, tangential })
        });
        let (t, y) = self.to_pairs(&best.z, &best.allowed);
        Ok(solver.solution(t, y, best.residuals, status, monitor))
    }
}

/// On the forces, in the pairs of [`Contact2d::to_general`]: the displacements follow from them if `K`
/// is positive definite, and the compliances of the contacts are on the diagonal. Bodies that `K` does not couple are
/// eliminated one by one.
impl Sweepable for Contact2d {
    fn solve_by(
        &self,
        solver: &ProjectedGaussSeidel,
        observer: &mut Observer<'_>,
    ) -> Result<Solution, Error> {
        let mut monitor = solver.monitor(observer);
        let start = solver.start(self.order(), |t, y| {
            let state = self.recover(t, y);
            interleaved(&state.t_n, &state.t_t)
        })?;
        let compliance = Compliance::new(self)?;
        let state = |forces: &[f64]| {
            let [t_n, t_t] = parted(forces);
            self.state(compliance.displacements(forces), t_n, t_t)
        };
        let free = state(&vec![0.0; 2 * self.points()]);
        let q = interleaved(&free.gap, &free.slip);
        let mut rows = Delassus::new(&compliance);
        let constraints = cones(self.mu());
        let sweeps = Sweeps::new(&solver.settings, &mut rows, &q, &constraints, start)?;
        let judge = ContactJudge::new(self);
        let (best, status) = sweeps.run(&mut monitor, &mut |point| {
            judge.residuals(&state(&point.z).parts(), Precision::Exact)
        });
        let state = state(&best.z);
        let (t, y) = self.to_pairs(&state);
        let mut solution = solver.solution(t, y, best.residuals, status, monitor);
        solution.info.factorisations = compliance.factorisations();
        Ok(Solution { contact: Some(state), ..solution })
    }
}

fn cones(mu: &[f64]) -> Vec<Constraint> {
    mu.iter().map(|&mu| Constraint::Friction { mu }).collect()
}

/// The normal and the tangential row of one contact after the other.
fn interleaved(normal: &[f64], tangential: &[f64]) -> Vec<f64> {
    normal.iter().zip(tangential).flat_map(|(n, t)| [*n, *t]).collect()
}

fn parted(rows: &[f64]) -> [Vec<f64>; 2] {
    [0, 1].map(|k| rows.iter().skip(k).step_by(2).copied().collect())
}
