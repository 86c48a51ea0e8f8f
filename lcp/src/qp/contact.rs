//! Contact problems as convex quadratic programs, for given bounds of the friction forces.

use super::form::{Bounds, Form, ProgramPoint};
use crate::Matrix;
use crate::states::Scaled;

/// The form of a contact problem: `x = u`, a row for every gap, then one for every slip with friction.
pub(super) fn contact_form(scaled: &Scaled) -> Form {
    let (n, points) = (scaled.order(), &scaled.points);
    let m = points.len();
    let friction: Vec<usize> = (0..m).filter(|&i| points.mu[i] > 0.0).collect();
    let rows = m + friction.len();
    let mut entries = Vec::new();
    let mut compliance: Vec<f64> = points.compliance.iter().map(|it| it[0]).collect();
    let mut offset = points.x_0.clone();
    let mut bounds = vec![Bounds::Nonnegative; m];
    for (i, point) in points.iter().enumerate() {
        let both = || point.columns.iter().zip(point.coefficients);
        entries.extend(both().map(|(&j, [normal, _])| (i, j, *normal)));
        if point.mu > 0.0 {
            let row = offset.len();
            entries.extend(both().map(|(&j, [_, tangential])| (row, j, *tangential)));
            compliance.push(point.compliance[1]);
            offset.push(point.s_0);
            bounds.push(Bounds::Cone { normal: i, mu: point.mu });
        }
    }
    let soft = compliance.into_iter().enumerate().filter(|(_, a)| *a > 0.0);
    Form {
        p: scaled.k.clone(),
        d: Matrix::from_entries(rows, n, entries.into_iter()).into_sparse(),
        s: Matrix::from_entries(rows, rows, soft.map(|(i, a)| (i, i, a))).into_sparse(),
        linear: scaled.f.iter().map(|f| -f).collect(),
        offset,
        bounds,
    }
}

/// Normal and tangential forces of a point of the form.
pub(super) fn forces(scaled: &Scaled, point: &ProgramPoint) -> Vec<(f64, f64)> {
    let (normal, friction) = point.lambda.split_at(scaled.points.len());
    let mut friction = friction.iter();
    let mut tangential =
        |mu: f64| if mu > 0.0 { friction.next().copied().unwrap_or(0.0) } else { 0.0 };
    normal.iter().zip(&scaled.points.mu).map(|(t_n, mu)| (*t_n, tangential(*mu))).collect()
}
