//! Springs on all displacements of a contact problem.

use super::Contact2d;
use crate::matrix::{column_of, diagonal};
use crate::vector::{max_abs, norm};
use crate::{Error, Matrix};

/// Soft springs that hold all displacements of a [`Contact2d`].
///
/// Every displacement has a spring of the stiffness `epsilon k_j`, with `k_j = K_jj` if that is not zero. If `K` has no
/// stiffness, as for rigid bodies, `k_j = k c_j^2`. Here `c_j` is the norm of the column `j` of `[C_n; C_t]`, and `k`
/// is the geometric mean of `K_jj / c_j^2` over the other displacements, and of the stiffnesses of compliant contacts.
/// If there are no such stiffnesses, `k` is the largest `|f_j| / c_j` divided by the largest initial gap or slip (by
/// one, if all are zero: the stiffness then only sets the unit of the displacements). So units do not matter.
///
/// ```
/// use faer::mat;
/// use lcp::{Bedding, Contact2d, ProjectedGaussSeidel, Solver};
/// // A block of weight 2 that nothing holds sideways: sweeps need a definite stiffness.
/// let contact = Contact2d::new(
///     mat![[0.0, 0.0], [0.0, 0.0]], vec![-2.0, 0.4],
///     mat![[1.0, 0.0]], mat![[0.0, 1.0]], vec![0.0], vec![0.0], vec![0.5],
/// )?;
/// let bedding = Bedding::new(&contact, 0.1)?;
/// let bedded = bedding.attached(&contact, &[0.0, 0.0])?;
/// let solution = ProjectedGaussSeidel::default().solve(&bedded)?;
/// let state = bedded.variables(&solution);
/// assert!(solution.is_solved() && (state.t_t[0] + 0.4).abs() < 1e-7);
/// assert!(bedding.share(&contact, &bedding.forces(&state.u, &[0.0, 0.0])) < 1e-7);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Bedding {
    /// `k_j`.
    unit: Vec<f64>,
    epsilon: f64,
}

impl Bedding {
    /// Springs of the stiffness `epsilon`, relative to that of the bodies.
    ///
    /// # Errors
    /// [`Error::Setting`] for an `epsilon` outside `(0, 1]`.
    pub fn new(contact: &Contact2d, epsilon: f64) -> Result<Self, Error> {
        check_epsilon(epsilon)?;
        Ok(Self { unit: units(contact), epsilon })
    }

    /// The problem with springs that are at rest at `centre`.
    ///
    /// # Errors
    /// [`Error::Length`] if `centre` does not have an entry for every displacement, [`Error::NotFinite`] if the forces
    /// of the springs overflow.
    pub fn attached(&self, contact: &Contact2d, centre: &[f64]) -> Result<Contact2d, Error> {
        let stiffness: Vec<f64> = self.unit.iter().map(|unit| self.epsilon * unit).collect();
        let springs = stiffness.iter().enumerate().map(|(j, k)| (j, j, *k));
        let n = stiffness.len();
        let bedded = contact.resisted(&Matrix::from_entries(n, n, springs).into_sparse(), 1.0);
        let f = contact.loads().iter().zip(centre).zip(stiffness);
        bedded.with_loads(f.map(|((f, u), k)| f + k * u).collect())
    }

    /// The forces of springs that are at rest at `centre`, for displacements `u`.
    pub fn forces(&self, u: &[f64], centre: &[f64]) -> Vec<f64> {
        let forces = u.iter().zip(centre).zip(&self.unit);
        forces.map(|((u, centre), k)| -self.epsilon * k * (u - centre)).collect()
    }

    /// The share of the load that forces of springs carry: `|forces| / |f|` in the norm
    /// `sqrt(sum f_j^2 / k_j)`, in which units do not matter.
    pub fn share(&self, contact: &Contact2d, forces: &[f64]) -> f64 {
        let size = |v: &[f64]| norm(v.iter().zip(&self.unit).map(|(v, k)| v / k.sqrt()));
        ratio(size(forces), size(contact.loads()))
    }

    /// The size of displacements, `sqrt(sum k_j u_j^2)`, in which units do not matter.
    pub fn size(&self, u: &[f64]) -> f64 {
        norm(u.iter().zip(&self.unit).map(|(u, k)| u * k.sqrt()))
    }
}

fn units(contact: &Contact2d) -> Vec<f64> {
    let n = contact.displacements();
    let diagonal = diagonal(contact.stiffness());
    let squared: Vec<f64> = (0..n)
        .map(|j| {
            let both = [contact.normal(), contact.tangent()];
            both.into_iter().flat_map(|c| column_of(c, j)).map(|(_, v)| v * v).sum()
        })
        .collect();
    let of_bodies = (0..n)
        .filter(|&j| diagonal[j] > 0.0 && squared[j] > 0.0)
        .map(|j| (diagonal[j] / squared[j]).ln());
    let logs: Vec<f64> = of_bodies.chain(contact.springs().map(f64::ln)).collect();
    let mean = if logs.is_empty() {
        let force = (0..n)
            .filter(|&j| squared[j] > 0.0)
            .map(|j| contact.loads()[j].abs() / squared[j].sqrt())
            .fold(0.0, f64::max);
        let length = max_abs(contact.initial_gaps()).max(max_abs(contact.initial_slips()));
        let length = if length > 0.0 { length } else { 1.0 };
        if force > 0.0 { force / length } else { 1.0 }
    } else {
        (logs.iter().sum::<f64>() / logs.len() as f64).exp()
    };
    let unit = |j: usize| {
        let from_contact = mean * squared[j];
        match diagonal[j] {
            stiffness if stiffness > 0.0 => stiffness,
            _ if from_contact > 0.0 => from_contact,
            _ => mean,
        }
    };
    (0..n).map(unit).collect()
}

pub(crate) fn ratio(a: f64, b: f64) -> f64 {
    if a <= 0.0 {
        0.0
    } else if b > 0.0 {
        a / b
    } else {
        f64::INFINITY
    }
}

pub(crate) fn check_epsilon(epsilon: f64) -> Result<(), Error> {
    if epsilon > 0.0 && epsilon <= 1.0 {
        return Ok(());
    }
    Err(Error::Setting { name: "epsilon", value: epsilon, range: "in (0, 1]" })
}
