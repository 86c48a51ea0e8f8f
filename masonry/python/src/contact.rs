//! Bodies in contact; the contact states are kept from one solve to the next.
#![expect(clippy::needless_pass_by_value, reason = "functions own what they take from Python")]

use std::sync::{Mutex, MutexGuard, PoisonError};

use lcp::refine::ContactStatus;
use lcp::{Contact2d, Error, Matrix, Method, WarmStart};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::answer::Answer;
use crate::arrays::{GivenMatrix, GivenVector, vector};
use crate::options::{Options, by_method};
use crate::watch::{refused, solve};

/// The data of all contact points that Python passes.
#[derive(FromPyObject)]
pub(crate) struct Points<'py> {
    #[pyo3(item)]
    c_n: GivenMatrix<'py>,
    #[pyo3(item)]
    c_t: GivenMatrix<'py>,
    #[pyo3(item)]
    gap: GivenVector<'py>,
    #[pyo3(item)]
    slip: GivenVector<'py>,
    #[pyo3(item)]
    mu: GivenVector<'py>,
    #[pyo3(item)]
    compliance: PyReadonlyArray2<'py, f64>,
}

impl Points<'_> {
    /// Creates the contact problem of bodies with stiffness `k`, loads `f`, and these contact points.
    fn of(&self, k: Matrix, f: Vec<f64>) -> PyResult<Contact2d> {
        let Self { c_n, c_t, gap, slip, mu, compliance } = self;
        let compliance = compliance.as_array().outer_iter().map(|row| [row[0], row[1]]).collect();
        let [gap, slip, mu] = [gap, slip, mu].map(vector);
        Contact2d::new(k, f, c_n.matrix()?, c_t.matrix()?, gap, slip, mu)
            .and_then(|problem| problem.with_compliance(compliance))
            .map_err(|error| refused(&error))
    }
}

/// A contact problem, and the contact states of its points in the last solution.
#[pyclass(frozen)]
pub(crate) struct Contact {
    held: Mutex<Held>,
}

struct Held {
    problem: Contact2d,
    /// Contact statuses in the last solution; `None` before the first. Points that were added since have no status, and
    /// count as open.
    statuses: Option<Vec<ContactStatus>>,
}

impl Held {
    /// Returns the problem with the loads `f`, and a start from the known statuses.
    fn under(&self, f: Vec<f64>) -> Result<(Contact2d, WarmStart), Error> {
        let problem = self.problem.with_loads(f)?;
        let start = self.statuses.as_ref().map_or(WarmStart::None, |known| {
            let mut statuses = known.clone();
            statuses.resize(problem.points(), ContactStatus::Open);
            problem.start_of(&statuses)
        });
        Ok((problem, start))
    }
}

impl Contact {
    /// Locks the problem and its statuses. No solve runs under the lock, so that other threads do not wait for long.
    fn held(&self) -> MutexGuard<'_, Held> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Contact {
    #[new]
    fn new(k: GivenMatrix<'_>, f: GivenVector<'_>, points: Points<'_>) -> PyResult<Self> {
        let problem = points.of(k.matrix()?, vector(&f))?;
        Ok(Self { held: Mutex::new(Held { problem, statuses: None }) })
    }

    /// Replaces the contact points; the new points begin with the previous ones, in the same order.
    fn renew(&self, points: Points<'_>) -> PyResult<()> {
        let mut held = self.held();
        let Held { problem, .. } = &*held;
        held.problem = points.of(problem.stiffness().clone().into(), problem.loads().to_vec())?;
        Ok(())
    }

    /// Forgets the statuses of the last solution, so that the next solve starts without them.
    fn forget(&self) {
        self.held().statuses = None;
    }

    /// Solves the problem with the loads `f`. The arrays are `u`, `t_n`, `t_t`, and the gaps and slips.
    fn solve(&self, py: Python<'_>, f: GivenVector<'_>, options: Options) -> PyResult<Answer> {
        let posed = self.held().under(vector(&f));
        let (problem, start) = posed.map_err(|error| refused(&error))?;
        let solution = by_method!(
            py, options, start, &problem,
            Interior => interior, QuadraticProgram => program, GaussSeidel => sweeps
        )?;
        let state = problem.variables(&solution);
        if solution.is_solved() {
            self.held().statuses = Some(problem.statuses(&state));
        }
        Ok(Answer::new(py, solution, vec![state.u, state.t_n, state.t_t, state.gap, state.slip]))
    }
}
