//! Units of the displacements of a contact problem.

use super::Contact2d;
use crate::matrix::{column_of, diagonal};
use crate::scaling::power_of_two;

/// Factors that bring the largest coefficient of every displacement in a gap or a slip near one;
/// displacements without contacts have factors that bring their stiffness to that of the others.
pub(crate) fn column_factors(problem: &Contact2d) -> Vec<f64> {
    let n = problem.displacements();
    let diagonal = diagonal(problem.stiffness());
    let mut largest = vec![0.0_f64; n];
    for (j, largest) in largest.iter_mut().enumerate() {
        column_of(problem.normal(), j).for_each(|(_, v)| *largest = largest.max(v.abs()));
        let tangent = column_of(problem.tangent(), j).filter(|(i, _)| problem.mu()[*i] > 0.0);
        tangent.for_each(|(_, v)| *largest = largest.max(v.abs()));
    }
    let seen = (0..n).filter(|&j| largest[j] > 0.0 && diagonal[j] > 0.0);
    let stiffness =
        median(&mut seen.map(|j| diagonal[j] / (largest[j] * largest[j])).collect::<Vec<_>>());
    let stiffness = stiffness
        .or_else(|| median(&mut diagonal.iter().copied().filter(|k| *k > 0.0).collect::<Vec<_>>()));
    let factor = |(largest, diagonal): (&f64, &f64)| {
        if *largest > 0.0 {
            power_of_two(1.0 / largest)
        } else if let Some(stiffness) = stiffness.filter(|_| *diagonal > 0.0) {
            power_of_two((stiffness / diagonal).sqrt())
        } else {
            1.0
        }
    };
    largest.iter().zip(&diagonal).map(factor).collect()
}

impl Contact2d {
    /// The stiffnesses of the springs in series with the contacts, as far as they carry forces.
    pub(crate) fn springs(&self) -> impl Iterator<Item = f64> {
        (0..self.points()).flat_map(|i| self.springs_of(i))
    }

    /// The springs of one point.
    pub(crate) fn springs_of(&self, i: usize) -> impl Iterator<Item = f64> + use<> {
        let carries = [true, self.mu[i] > 0.0];
        let both = self.compliance[i].into_iter().zip(carries);
        both.filter(|(a, carries)| *carries && *a > 0.0).map(|(a, _)| (1.0 / a).min(f64::MAX))
    }
}

/// The median, if there are any values.
pub(crate) fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}
