//! Forces of least size.

use faer::sparse::SparseColMat;

use super::InteriorPoint;
use super::homogeneous::Accuracy;
use super::outcome::Outcome;
use super::program::{Program, against};
use crate::active::unplanned;
use crate::certify::is_proof_of;
use crate::matrix::Column;
use crate::solve::Monitor;
use crate::vector::{check_length, check_vector};
use crate::{Error, Info, Matrix, Method, Observer, Status};

/// Forces of the least size that balance loads, or a proof that no forces do.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LeastForces {
    /// [`Status::Solved`], [`Status::Infeasible`] with a checked proof, or the reason for which there is neither.
    pub status: Status,
    /// The forces `t`.
    pub t: Vec<f64>,
    /// The multipliers `u` of the balance; a proof if the status is `Infeasible`, with a largest component of one.
    pub u: Vec<f64>,
    /// The residual of the forces and multipliers, measured as described in [`InteriorPoint::least_forces`], which
    /// decides the status unless there is a proof.
    pub residual: f64,
    /// The cost.
    pub info: Info,
}

impl InteriorPoint {
    /// `min |t|^2 / 2` with `A t + f = 0` and `t >= 0`, or `u` with `A^T u >= 0` and `f.u > 0`, which proves that there is no
    /// such `t` (Farkas 1902). Newton's method on the dual function of `u` comes first (Mangasarian 2004); if its steps become
    /// short, the homogeneous problem of Andersen and Ye (1999) follows. Uses the tolerance and the limits of the settings.
    ///
    /// The iteration ends if the balance holds to the tolerance, relative to the largest force, and to a hundred times
    /// the tolerance relative to the largest load, or to rounding errors of the forces (64 eps of the largest) if
    /// forces are so much larger than the loads. The remaining residual is distributed, so that every row is balanced
    /// to its last digits, as far as rounding errors of the forces allow. Multipliers hold to the tolerance, relative
    /// to the largest `t + A^T u`, or to rounding errors of the largest of them. A force and its multiplier `t + A^T u`
    /// may both be zero, and approach zero together: the smaller one, relative to the largest, has to be below a tenth
    /// of the root of the tolerance.
    ///
    /// # Errors
    /// [`Error::Length`] if `f` is not as long as a column of `A`, [`Error::NotFinite`] for a NaN or an infinity,
    /// [`Error::Setting`] for a setting out of range, and [`Error::NotTreated`] if memory does not suffice.
    ///
    /// ```
    /// use faer::sparse::{SparseColMat, Triplet};
    /// use lcp::{InteriorPoint, Status};
    /// // Two supports side by side share a load; neither of them can pull.
    /// let entries = [Triplet::new(0, 0, 1.0), Triplet::new(0, 1, 1.0)];
    /// let supports = SparseColMat::try_new_from_triplets(1, 2, &entries).unwrap();
    /// let observer = &mut |_: &lcp::Iteration| std::ops::ControlFlow::Continue(());
    /// let stands = InteriorPoint::default().least_forces(&supports, &[-3.0], observer)?;
    /// assert!(stands.t.iter().all(|t| (t - 1.5).abs() < 1e-9));
    /// let lifted = InteriorPoint::default().least_forces(&supports, &[3.0], observer)?;
    /// assert_eq!((lifted.status, lifted.u), (Status::Infeasible, vec![1.0]));
    /// # Ok::<(), lcp::Error>(())
    /// ```
    pub fn least_forces(
        &self,
        a: &SparseColMat<usize, f64>,
        f: &[f64],
        observer: &mut Observer<'_>,
    ) -> Result<LeastForces, Error> {
        let settings = self.settings();
        let (n, m) = (a.nrows(), a.ncols());
        settings.validate(m)?;
        check_length("f", f.len(), n)?;
        check_vector("f", f)?;
        check_vector("A", a.val())?;
        let observer = &mut |at: &_| observer(at);
        let mut monitor =
            Monitor::new(Method::Interior, settings.max_iterations, settings.time_limit, observer);
        let no_stiffness = Matrix::from_entries(n, n, std::iter::empty()).into_sparse();
        let program = Program::of_least_forces(no_stiffness, f.to_vec(), a.clone());
        let loads: Vec<f64> = f.iter().map(|f| -f).collect();
        let found = program.solve(
            Accuracy::OfForces(settings.tolerance),
            |residual| monitor.stop(residual),
            |u, _| is_proof_of(columns(a), &loads, &against(u.to_vec())),
        );
        let Outcome { status, mut u, t, residual, factorisations, .. } =
            found.map_err(|error| unplanned(Method::Interior, error))?;
        if status == Status::Infeasible {
            u = against(u).into_iter().map(|u| -u).collect();
        }
        let mut info = monitor.info();
        info.factorisations = factorisations;
        Ok(LeastForces { status, t, u, residual, info })
    }
}

fn columns(a: &SparseColMat<usize, f64>) -> impl Iterator<Item = Column<'_>> {
    let a = a.as_ref();
    (0..a.ncols())
        .map(move |j| Column::Sparse { rows: a.row_idx_of_col_raw(j), values: a.val_of_col(j) })
}
