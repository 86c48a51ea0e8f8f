//! Contact problems as convex quadratic programs, for given bounds of the friction forces.

use super::form::{Bounds, Form, Point};
use super::interior::{Effort, Found, Interior};
use super::scale::Scaled;
use crate::problem::column_of;
use crate::{Contact2d, ContactState, Matrix};

/// The form of a contact problem: `x = u`, a row for every gap, then one for every slip with friction.
pub(super) fn contact_form(contact: &Contact2d) -> Form {
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

/// The state that a point of the form is.
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
    pub(super) scaled: Scaled,
    interior: Interior,
}

impl ContactProgram {
    /// None where the interior-point method refuses the program.
    pub(super) fn new(form: &Form, effort: Effort) -> Option<Self> {
        let scaled = Scaled::new(form);
        let interior = Interior::new(&scaled.form, effort)?;
        Some(Self { scaled, interior })
    }

    /// The program with these bounds of the friction forces; bounds and the point are in the units of the scaled form.
    pub(super) fn solve(&mut self, limits: &[f64], effort: Effort) -> Found {
        self.interior.solve(&self.scaled.form, limits, effort.time)
    }
}
