//! Contact problems as convex quadratic programs, for given bounds of the friction forces.

use faer::linalg::solvers::Solve;
use faer::sparse::SparseColMat;
use faer::sparse::linalg::solvers::Llt;
use faer::{Mat, MatMut, Side};

use super::constants::DUAL_ROWS;
use super::form::{Bounds, Form, Point, add_product};
use super::interior::{Effort, Found, Interior};
use super::scale::Scaled;
use super::settings::ContactForm;
use crate::definite::is_definite;
use crate::problem::column_of;
use crate::{Contact2d, ContactState, Matrix};

/// The primal form: `x = u`, a row for every gap, then one for every slip with friction.
pub(super) fn primal_form(contact: &Contact2d) -> Form {
    let (n, m, friction) = (contact.displacements(), contact.points(), contact.frictional());
    let rows = m + friction.len();
    let entries = (0..n).flat_map(|j| {
        let gaps = column_of(contact.normal(), j).map(move |(i, v)| (i, j, v));
        let slips = column_of(contact.tangent(), j)
            .filter_map(move |(i, v)| Some((m + friction.binary_search(&i).ok()?, j, v)));
        gaps.chain(slips)
    });
    let mut offset = contact.initial_gaps().to_vec();
    offset.extend(friction.iter().map(|&i| contact.initial_slips()[i]));
    let compliance = contact.compliance().iter().map(|it| it[0]);
    let compliance = compliance.chain(friction.iter().map(|&i| contact.compliance()[i][1]));
    let compliance = compliance.enumerate().filter(|(_, a)| *a > 0.0);
    let mut bounds = vec![Bounds::Nonnegative; m];
    bounds.extend(friction.iter().map(|&i| Bounds::Cone { normal: i, mu: contact.mu()[i] }));
    Form {
        p: contact.stiffness().clone(),
        d: Matrix::from_entries(rows, n, entries).into_sparse(),
        s: Matrix::from_entries(rows, rows, compliance.map(|(i, a)| (i, i, a))).into_sparse(),
        linear: contact.loads().iter().map(|f| -f).collect(),
        offset,
        bounds,
    }
}

/// The state that a point of the primal form is.
pub(super) fn state_of(contact: &Contact2d, point: &Point) -> ContactState {
    let (t_n, friction) = point.lambda.split_at(contact.points());
    let mut t_t = vec![0.0; contact.points()];
    for (&i, t) in contact.frictional().iter().zip(friction) {
        t_t[i] = *t;
    }
    contact.state(point.x.clone(), t_n.to_vec(), t_t)
}

/// A contact problem ready for the interior-point method.
pub(super) struct ContactProgram {
    /// The primal form, whose points are states of the contacts, whatever program they come from.
    pub(super) scaled: Scaled,
    dual: Option<Dual>,
    interior: Interior,
}

/// The program in the forces.
struct Dual {
    scaled: Scaled,
    stiffness: Llt<usize, f64>,
    form: Form,
}

impl ContactProgram {
    /// None where the interior-point method refuses the program, or where the dual one is chosen
    /// and `K` is singular.
    pub(super) fn new(form: Form, choice: ContactForm, effort: Effort) -> Option<Self> {
        let (n, rows) = (form.unknowns(), form.rows());
        let is_dual = match choice {
            ContactForm::Primal => false,
            ContactForm::Dual => true,
            ContactForm::Auto => rows <= DUAL_ROWS && 4 * rows <= n && is_definite(&form.p),
        };
        let scaled = Scaled::new(&form);
        let dual = if is_dual { Some(Dual::new(form)?) } else { None };
        let of = dual.as_ref().map_or(&scaled.form, |dual| &dual.scaled.form);
        let interior = Interior::new(of, effort)?;
        Some(Self { scaled, dual, interior })
    }

    /// The program with these bounds of the friction forces; bounds and the point are in the units of the
    /// scaled primal form.
    pub(super) fn solve(&mut self, limits: &[f64], effort: Effort) -> Found {
        let Some(dual) = &self.dual else {
            return self.interior.solve(&self.scaled.form, limits, effort.time);
        };
        let limits = dual.scaled.scaled_limits(&self.scaled.unscaled_limits(limits));
        let found = self.interior.solve(&dual.scaled.form, &limits, effort.time);
        let lambda = dual.scaled.unscaled(&found.point).lambda;
        let x = dual.displacements(&lambda);
        let point = self.scaled.scaled(&Point { x, lambda });
        Found { point, ..found }
    }
}

impl Dual {
    fn new(form: Form) -> Option<Self> {
        let stiffness = form.p.sp_cholesky(Side::Lower).ok()?;
        let (n, rows) = (form.unknowns(), form.rows());
        let mut flexible = Mat::zeros(n, rows);
        for j in 0..n {
            column_of(&form.d, j).for_each(|(i, v)| flexible[(j, i)] = v);
        }
        stiffness.solve_in_place(flexible.as_mut());
        let full = form.d.as_ref() * &flexible;
        let entries = (0..rows).flat_map(|j| {
            let full = &full;
            (0..rows).map(move |i| (i, j, 0.5 * (full[(i, j)] + full[(j, i)])))
        });
        let own = (0..rows).flat_map(|j| column_of(&form.s, j).map(move |(i, v)| (i, j, v)));
        let s = Matrix::from_entries(rows, rows, entries.chain(own)).into_sparse();
        let mut free: Vec<f64> = form.linear.iter().map(|v| -v).collect();
        solve_vector(&stiffness, &mut free);
        let mut offset = form.offset.clone();
        add_product(&form.d, &free, &mut offset);
        let dual = Form {
            p: empty(0, 0),
            d: empty(rows, 0),
            s,
            linear: Vec::new(),
            offset,
            bounds: form.bounds.clone(),
        };
        Some(Self { scaled: Scaled::new(&dual), stiffness, form })
    }

    fn displacements(&self, lambda: &[f64]) -> Vec<f64> {
        let mut u: Vec<f64> = self.form.linear.iter().map(|v| -v).collect();
        for (j, u) in u.iter_mut().enumerate() {
            column_of(&self.form.d, j).for_each(|(i, v)| *u += v * lambda[i]);
        }
        solve_vector(&self.stiffness, &mut u);
        u
    }
}

fn solve_vector(factor: &Llt<usize, f64>, rhs: &mut [f64]) {
    let n = rhs.len();
    factor.solve_in_place(MatMut::from_column_major_slice_mut(rhs, n, 1));
}

fn empty(rows: usize, cols: usize) -> SparseColMat<usize, f64> {
    Matrix::from_entries(rows, cols, std::iter::empty()).into_sparse()
}
