//! Contact with friction in the plane.

use crate::vector::{check_length, check_vector};
use crate::{Error, Lcp, Matrix, Vector};

/// Plane contact with Coulomb friction, reduced to the contacts: the relative velocities are `W r + q` for forces
/// `r`. Every contact has a normal and a tangential component, in this order.
///
/// The normal force and the normal velocity of every contact are complementary, and the tangential force is at most
/// `mu` times the normal one, against the sliding.
///
/// The standard problem has the three variables `r_N`, `l = r_T + mu r_N` and the sliding `s >= 0` for every contact,
/// with
/// ```text
/// w1 = (W_NN - W_NT mu) r_N + W_NT l     + q_N
/// w2 = (W_TN - W_TT mu) r_N + W_TT l + s + q_T
/// w3 = 2 mu r_N - l.
/// ```
///
/// ```
/// use faer::mat;
/// use lcp::{Friction2d, Lemke, Solver};
/// // A point of mass 1 hits a floor (mu = 0.5) with 2, and slides along it with 3.
/// let friction = Friction2d::new(mat![[1.0, 0.0], [0.0, 1.0]], vec![-2.0, -3.0], vec![0.5])?;
/// let solution = Lemke::default().solve(&friction)?;
/// let forces = friction.variables(&solution);
/// assert_eq!((forces.normal[0], forces.tangential[0]), (2.0, 1.0));
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Friction2d {
    w: Matrix,
    q: Vec<f64>,
    mu: Vec<f64>,
    standard: Lcp,
}

/// The forces at the contacts.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactForces {
    /// The normal force at every contact.
    pub normal: Vec<f64>,
    /// The tangential force at every contact.
    pub tangential: Vec<f64>,
}

impl Friction2d {
    /// A problem of `nc` contacts from `W` (2 nc x 2 nc), `q` (2 nc) and the coefficients of friction
    /// (nc), which are not negative.
    ///
    /// # Errors
    /// [`Error::Shape`] or [`Error::Length`] if the sizes do not agree, [`Error::NotFinite`] for a NaN or an infinity,
    /// [`Error::Setting`] for a coefficient of friction that is negative or above 1e6.
    pub fn new(
        w: impl Into<Matrix>,
        q: impl Into<Vector>,
        mu: impl Into<Vector>,
    ) -> Result<Self, Error> {
        let (w, q, mu) = (w.into(), q.into().into_entries(), mu.into().into_entries());
        check_length("q", q.len(), 2 * mu.len())?;
        w.check("W", q.len(), q.len())?;
        check_vector("q", &q)?;
        check_vector("mu", &mu)?;
        if let Some(&value) = mu.iter().find(|mu| !(0.0..=LARGEST_MU).contains(*mu)) {
            let range = "from 0 to 1e6: with more, forces of this form cannot be told from those of \
                         contacts that never slide";
            return Err(Error::Setting { name: "mu", value, range });
        }
        let standard = standard_form(&w, &q, &mu)?;
        Ok(Self { w, q, mu, standard })
    }

    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.mu.len()
    }

    /// Number of variables of the standard problem: three for every contact.
    pub fn order(&self) -> usize {
        3 * self.contacts()
    }

    /// The matrix.
    pub fn w(&self) -> &Matrix {
        &self.w
    }

    /// The relative velocities without forces.
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// The coefficients of friction.
    pub fn mu(&self) -> &[f64] {
        &self.mu
    }

    /// The standard problem, with the variables `r_N`, `l`, `s` of the first contact, then those of
    /// the second, and so on.
    pub fn standard(&self) -> &Lcp {
        &self.standard
    }

    /// The forces at the contacts, from the variables of the standard problem.
    ///
    /// # Panics
    /// If `z` does not have three entries for every contact.
    pub fn forces(&self, z: &[f64]) -> ContactForces {
        assert_eq!(z.len(), self.order(), "three entries for every contact");
        let normal: Vec<f64> = z.chunks_exact(3).map(|z| z[0]).collect();
        let tangential = z.chunks_exact(3).zip(&self.mu).map(|(z, mu)| z[1] - mu * z[0]).collect();
        ContactForces { normal, tangential }
    }

    /// The point of the standard problem that belongs to forces within the cones and the velocities that they allow,
    /// two for every contact: the sliding is the velocity at the border of the cone.
    pub fn to_pairs(&self, r: &[f64], v: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let contacts = r.chunks_exact(2).zip(v.chunks_exact(2)).zip(&self.mu);
        let pairs = contacts.flat_map(|((r, v), mu)| {
            let bound = mu * r[0];
            let (shifted, rest) = (r[1] + bound, bound - r[1]);
            [(r[0], v[0]), (shifted, v[1].max(0.0)), ((-v[1]).max(0.0), rest)]
        });
        pairs.unzip()
    }
}

/// Largest coefficient of friction: a larger one leaves fewer than ten digits of `r_T = l - mu r_N`.
const LARGEST_MU: f64 = 1e6;

fn standard_form(w: &Matrix, q: &[f64], mu: &[f64]) -> Result<Lcp, Error> {
    let order = 3 * mu.len();
    let mut entries = Vec::with_capacity(2 * w.stored() + order);
    for (contact, &mu) in mu.iter().enumerate() {
        let [normal, shifted, sliding] = [0, 1, 2].map(|k| 3 * contact + k);
        let place = |row: usize| 3 * (row / 2) + row % 2;
        entries.extend(w.column(2 * contact).map(|(row, v)| (place(row), normal, v)));
        for (row, v) in w.column(2 * contact + 1) {
            entries.push((place(row), normal, -v * mu));
            entries.push((place(row), shifted, v));
        }
        entries.push((shifted, sliding, 1.0));
        entries.push((sliding, normal, 2.0 * mu));
        entries.push((sliding, shifted, -1.0));
    }
    let matrix = Matrix::assembled(order, w.is_sparse(), entries.into_iter());
    let vector: Vec<f64> = q.chunks_exact(2).flat_map(|q| [q[0], q[1], 0.0]).collect();
    Lcp::new(matrix, vector)
}
