//! Plane contact with friction, sparse, with the displacements as free variables.

mod bedding;
mod builder;
mod mixed;
mod status;
mod units;

pub use bedding::Bedding;
#[cfg(feature = "clarabel")]
pub(crate) use bedding::{check_epsilon, ratio};
pub use builder::{Contact2dBuilder, ContactPoint};
pub use status::ContactStatus;
pub(crate) use units::{column_factors, median};

use faer::sparse::SparseColMat;

use super::{ContactForces, HorizontalLcp};
use crate::definite::indefiniteness;
use crate::matrix::{DATA_ROUNDING, add_image, column_of};
use crate::vector::{check_length, check_sizes, check_vector};
use crate::{Error, Matrix, Vector};

/// Unilateral contact with Coulomb's friction between elastic or rigid bodies in the plane:
///
/// ```text
/// K u = f + C_n^T t_n + C_t^T t_t,
/// g = C_n u + x_0 + a_n t_n,    s = C_t u + s_0 + a_t t_t,
/// 0 <= t_n  _|_  g >= 0,
/// 0 <= mu t_n + t_t  _|_  s+ >= 0,    0 <= mu t_n - t_t  _|_  s- >= 0,    s = s+ - s-,
/// ```
///
/// with `n` displacements `u`, or velocities, and `m` contact points: normal forces `t_n`, tangential forces `t_t`,
/// gaps `g`, slips `s`. `K` is symmetric positive semidefinite and may have zero modes, as for floating bodies. The
/// entries of `u` for a rigid body are the amplitudes of its motions, and `K` is zero (in statics) or its mass. A point
/// with `mu = 0` has no tangential force, whatever its row of `C_t`.
///
/// The compliances `a_n` and `a_t` are those of springs in series with the contact, such as a film between the bodies:
/// lengths per force, zero unless [`Contact2d::with_compliance`] or a [`ContactPoint`] gives them. The gap `g` is the
/// remaining opening beside the spring.
///
/// [`Contact2d::builder`] takes the points one by one, [`Contact2d::new`] takes matrices, and [`Contact2d::variables`]
/// returns the state of a solution.
#[derive(Debug, Clone)]
pub struct Contact2d {
    k: SparseColMat<usize, f64>,
    f: Vec<f64>,
    c_n: SparseColMat<usize, f64>,
    c_t: SparseColMat<usize, f64>,
    x_0: Vec<f64>,
    s_0: Vec<f64>,
    mu: Vec<f64>,
    /// `a_n` and `a_t` of every point.
    compliance: Vec<[f64; 2]>,
    /// The points with friction.
    friction: Vec<usize>,
}

/// Displacements and contact forces with the gaps and slips that belong to them.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactState {
    /// The displacements.
    pub u: Vec<f64>,
    /// The normal force at every point, compression positive.
    pub t_n: Vec<f64>,
    /// The tangential force at every point; zero without friction.
    pub t_t: Vec<f64>,
    /// The gap at every point.
    pub gap: Vec<f64>,
    /// The slip at every point, also without friction.
    pub slip: Vec<f64>,
}

impl ContactState {
    /// The forces alone.
    pub fn forces(&self) -> ContactForces {
        ContactForces { normal: self.t_n.clone(), tangential: self.t_t.clone() }
    }
}

impl Contact2d {
    /// A problem from `K` (n x n), `f` (n), `C_n` and `C_t` (m x n), `x_0`, `s_0` and `mu` (m);
    /// [`builder`](Self::builder) takes the points one by one.
    ///
    /// # Errors
    /// [`Error::Shape`] or [`Error::Length`] if the sizes do not agree, [`Error::NotFinite`] for a NaN or an infinity,
    /// [`Error::Setting`] for a coefficient of friction that is negative or above 1e12, [`Error::NotSymmetric`] for a
    /// `K` that is not symmetric up to rounding, and [`Error::Indefinite`] for a `K` that is not positive semidefinite.
    pub fn new(
        k: impl Into<Matrix>,
        f: impl Into<Vector>,
        c_n: impl Into<Matrix>,
        c_t: impl Into<Matrix>,
        x_0: impl Into<Vector>,
        s_0: impl Into<Vector>,
        mu: impl Into<Vector>,
    ) -> Result<Self, Error> {
        let [f, x_0, s_0, mu] =
            [f.into(), x_0.into(), s_0.into(), mu.into()].map(Vector::into_entries);
        let (k, c_n, c_t) = (k.into(), c_n.into(), c_t.into());
        let (n, m) = (f.len(), mu.len());
        for (what, matrix, rows) in [("K", &k, n), ("C_n", &c_n, m), ("C_t", &c_t, m)] {
            matrix.check(what, rows, n)?;
        }
        check_length("x_0", x_0.len(), m)?;
        check_length("s_0", s_0.len(), m)?;
        for (what, vector) in [("f", &f), ("x_0", &x_0), ("s_0", &s_0), ("mu", &mu)] {
            check_vector(what, vector)?;
        }
        // A tangential force of the size of the normal one cannot be distinguished from zero beside larger friction.
        if let Some(&value) = mu.iter().find(|mu| !(0.0..=1.0 / DATA_ROUNDING).contains(*mu)) {
            let range = "from 0 to 1e12: a contact with 1e12 never slides";
            return Err(Error::Setting { name: "mu", value, range });
        }
        k.check_symmetric("K")?;
        let friction = (0..m).filter(|&i| mu[i] > 0.0).collect();
        let [k, c_n, c_t] = [k, c_n, c_t].map(Matrix::into_sparse);
        if let Some(reason) = indefiniteness("K", &k) {
            return Err(Error::Indefinite { reason });
        }
        let compliance = vec![[0.0; 2]; m];
        Ok(Self { k, f, c_n, c_t, x_0, s_0, mu, compliance, friction })
    }

    /// Adds springs in series with the contacts: the normal and the tangential compliance of every point, in length per
    /// force. The tangential compliance of a point without friction does not matter, since the point has no tangential
    /// force.
    ///
    /// ```
    /// use faer::mat;
    /// use lcp::{Auto, Contact2d, Solver};
    /// // A body of weight 2 on a spring of the stiffness 4
    /// let block = Contact2d::new(
    ///     mat![[0.0]], vec![-2.0], mat![[1.0]], mat![[0.0]], vec![0.0], vec![0.0], vec![0.0],
    /// )?;
    /// let block = block.with_compliance(vec![[0.25, 0.0]])?;
    /// let state = block.variables(&Auto::default().solve(&block)?);
    /// assert!((state.u[0] + 0.5).abs() < 1e-14 && (state.t_n[0] - 2.0).abs() < 1e-14);
    /// # Ok::<(), lcp::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Length`] if the number of pairs is not that of the points, [`Error::PointValue`] for a compliance that
    /// is negative or not finite.
    pub fn with_compliance(self, compliance: Vec<[f64; 2]>) -> Result<Self, Error> {
        check_length("compliance", compliance.len(), self.points())?;
        check_sizes("normal compliance", compliance.iter().map(|it| it[0]))?;
        check_sizes("tangential compliance", compliance.iter().map(|it| it[1]))?;
        Ok(Self { compliance, ..self })
    }

    /// The structure under other loads.
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`] as [`new`](Self::new).
    pub fn with_loads(&self, f: Vec<f64>) -> Result<Self, Error> {
        check_length("f", f.len(), self.f.len())?;
        check_vector("f", &f)?;
        Ok(Self { f, ..self.clone() })
    }

    /// The problem with slips measured from the displacements `u`, for bodies that have moved there: `s_0` becomes
    /// `-C_t u`. Slips of a state with compliant contacts are subtracted by [`slid`](Self::slid).
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`] as [`new`](Self::new).
    pub fn after(&self, u: &[f64]) -> Result<Self, Error> {
        check_length("u", u.len(), self.f.len())?;
        check_vector("u", u)?;
        let mut s_0 = vec![0.0; self.points()];
        add_image(&self.c_t, -1.0, u, &mut s_0);
        Ok(Self { s_0, ..self.clone() })
    }

    /// The problem with slips measured from the positions after `slips`, which are subtracted from `s_0`.
    ///
    /// # Errors
    /// [`Error::Length`] or [`Error::NotFinite`] as [`new`](Self::new).
    pub fn slid(&self, slips: &[f64]) -> Result<Self, Error> {
        check_length("slips", slips.len(), self.points())?;
        let s_0: Vec<f64> = self.s_0.iter().zip(slips).map(|(s_0, slip)| s_0 - slip).collect();
        check_vector("slips", &s_0)?;
        Ok(Self { s_0, ..self.clone() })
    }

    /// The same bodies with `resistance` times a mass in addition to `K`; the pattern does not depend on the numbers.
    pub(crate) fn resisted(&self, mass: &SparseColMat<usize, f64>, resistance: f64) -> Self {
        let sum = faer::sparse::ops::binary_op(self.k.as_ref(), mass.as_ref(), |k, m| {
            k.copied().unwrap_or(0.0) + resistance * m.copied().unwrap_or(0.0)
        });
        let k = sum.unwrap_or_else(|e| unreachable!("both were built before: {e:?}"));
        Self { k, ..self.clone() }
    }

    /// The same structure under other loads, gaps and slips, which are finite.
    pub(crate) fn under(self, f: Vec<f64>, x_0: Vec<f64>, s_0: Vec<f64>) -> Self {
        Self { f, x_0, s_0, ..self }
    }

    /// Number of displacements.
    pub fn displacements(&self) -> usize {
        self.f.len()
    }

    /// Number of contact points.
    pub fn points(&self) -> usize {
        self.mu.len()
    }

    /// The points with friction, `mu > 0`.
    pub fn frictional(&self) -> &[usize] {
        &self.friction
    }

    /// The stiffness `K`.
    pub fn stiffness(&self) -> &SparseColMat<usize, f64> {
        &self.k
    }

    /// The loads `f`.
    pub fn loads(&self) -> &[f64] {
        &self.f
    }

    /// `C_n`: the gaps for unit displacements.
    pub fn normal(&self) -> &SparseColMat<usize, f64> {
        &self.c_n
    }

    /// `C_t`: the slips for unit displacements.
    pub fn tangent(&self) -> &SparseColMat<usize, f64> {
        &self.c_t
    }

    /// The gaps without displacements, `x_0`.
    pub fn initial_gaps(&self) -> &[f64] {
        &self.x_0
    }

    /// The slips without displacements, `s_0`.
    pub fn initial_slips(&self) -> &[f64] {
        &self.s_0
    }

    /// The coefficients of friction.
    pub fn mu(&self) -> &[f64] {
        &self.mu
    }

    /// The normal and the tangential compliance of every point.
    pub fn compliance(&self) -> &[[f64; 2]] {
        &self.compliance
    }

    /// Number of pairs of the general problem: `n + m`, and two for every point with friction.
    pub fn order(&self) -> usize {
        self.displacements() + self.points() + 2 * self.friction.len()
    }

    /// The general problem. Its pairs are the displacements (free), then `(t_n, g)` of all points, then
    /// `(mu t_n + t_t, s+)` and then `(mu t_n - t_t, s-)` of the points with friction.
    pub fn to_general(&self) -> HorizontalLcp {
        let (n, m, order) = (self.displacements(), self.points(), self.order());
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for j in 0..n {
            let column = column_of(&self.k, j);
            let gaps = column_of(&self.c_n, j).map(|(i, v)| (n + i, -v));
            let slips = self.friction_rows(j).map(|(k, v)| (n + m + k, -v));
            for (i, v) in column.chain(gaps).chain(slips) {
                a.push((i, j, v));
                b.push((i, j, -v));
            }
            a.extend(column_of(&self.c_n, j).map(|(i, v)| (j, n + i, -v)));
            for (k, v) in self.friction_rows(j) {
                let [plus, minus] = self.tangential_pairs(k);
                a.push((j, plus, -0.5 * v));
                a.push((j, minus, 0.5 * v));
            }
        }
        b.extend((n..n + m).map(|i| (i, i, 1.0)));
        let springs = (0..m).filter(|&i| self.compliance[i][0] > 0.0);
        a.extend(springs.map(|i| (n + i, n + i, -self.compliance[i][0])));
        for (k, &point) in self.friction.iter().enumerate() {
            let [plus, minus] = self.tangential_pairs(k);
            b.extend([(plus, plus, 1.0), (plus, minus, -1.0)]);
            a.extend([(minus, n + point, -2.0 * self.mu[point])]);
            a.extend([(minus, plus, 1.0), (minus, minus, 1.0)]);
            let gives = 0.5 * self.compliance[point][1];
            if gives > 0.0 {
                a.extend([(plus, plus, -gives), (plus, minus, gives)]);
            }
        }
        let mut c = self.f.clone();
        c.extend(&self.x_0);
        c.extend(self.friction.iter().map(|&i| self.s_0[i]));
        c.resize(order, 0.0);
        let [a, b] = [a, b].map(|entries| Matrix::from_entries(order, order, entries.into_iter()));
        HorizontalLcp::from_parts(a, b, c)
    }

    /// Displacements and forces from a point of the general problem.
    ///
    /// The tangential force computed from `mu t_n + t_t` and `mu t_n - t_t` has no correct digit below `eps mu t_n`: if
    /// `mu` is 1e6 or more, use [`Solution::contact`](crate::Solution::contact) instead.
    ///
    /// # Panics
    /// If `t` or `y` does not have one entry for every pair.
    pub fn recover(&self, t: &[f64], y: &[f64]) -> ContactState {
        let (n, m, order) = (self.displacements(), self.points(), self.order());
        assert!(t.len() == order && y.len() == order, "a point has one entry for every pair");
        let u = (0..n).map(|j| t[j] - y[j]).collect();
        let mut t_t = vec![0.0; m];
        for (k, &point) in self.friction.iter().enumerate() {
            let [plus, minus] = self.tangential_pairs(k);
            t_t[point] = 0.5 * (t[plus] - t[minus]);
        }
        self.state(u, t[n..n + m].to_vec(), t_t)
    }

    /// The state with these displacements and forces; its gaps and slips are computed.
    ///
    /// # Panics
    /// If the lengths are not those of the problem.
    pub fn state(&self, u: Vec<f64>, t_n: Vec<f64>, t_t: Vec<f64>) -> ContactState {
        let m = self.points();
        assert!(u.len() == self.displacements() && t_n.len() == m && t_t.len() == m);
        let (mut gap, mut slip) = (self.x_0.clone(), self.s_0.clone());
        add_image(&self.c_n, 1.0, &u, &mut gap);
        add_image(&self.c_t, 1.0, &u, &mut slip);
        for (i, [normal, tangential]) in self.compliance.iter().enumerate() {
            gap[i] += normal * t_n[i];
            slip[i] += tangential * t_t[i];
        }
        ContactState { u, t_n, t_t, gap, slip }
    }

    /// The point of the general problem that belongs to a state.
    ///
    /// # Panics
    /// If the lengths are not those of the problem.
    pub fn to_pairs(&self, state: &ContactState) -> (Vec<f64>, Vec<f64>) {
        let order = self.order();
        let mut t: Vec<f64> = state.u.iter().map(|u| u.max(0.0)).collect();
        let mut y: Vec<f64> = state.u.iter().map(|u| (-u).max(0.0)).collect();
        t.extend(&state.t_n);
        y.extend(&state.gap);
        t.resize(order, 0.0);
        y.resize(order, 0.0);
        for (k, &i) in self.friction.iter().enumerate() {
            let [plus, minus] = self.tangential_pairs(k);
            let bound = self.mu[i] * state.t_n[i];
            (t[plus], t[minus]) = (bound + state.t_t[i], bound - state.t_t[i]);
            (y[plus], y[minus]) = (state.slip[i].max(0.0), (-state.slip[i]).max(0.0));
        }
        (t, y)
    }

    /// Pairs `(mu t_n + t_t, s+)` and `(mu t_n - t_t, s-)` of a point, given its position among the points with
    /// friction.
    fn tangential_pairs(&self, k: usize) -> [usize; 2] {
        let first = self.displacements() + self.points();
        [first + k, first + self.friction.len() + k]
    }

    /// Entries of a column of `C_t`, by positions among the points with friction.
    fn friction_rows(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        column_of(&self.c_t, j)
            .filter_map(|(i, v)| Some((self.friction.binary_search(&i).ok()?, v)))
    }
}
