//! Contact problems point by point.

use super::Contact2d;
use crate::vector::{check_points, check_sizes};
use crate::{Error, Matrix, Vector};

/// A contact point with its gap and slip as functions of the displacements. A row is a list of pairs
/// `(displacement, coefficient)`; coefficients of the same displacement are added.
///
/// A point without `tangent`, `gap`, `slip`, `mu` and `compliance` is hard, closed and without friction:
///
/// ```
/// use lcp::ContactPoint;
/// let point = ContactPoint { normal: &[(0, 1.0)], ..Default::default() };
/// assert!(point.gap == 0.0 && point.mu == 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactPoint<'a> {
    /// The row of `C_n`: the change of the gap for unit displacements.
    pub normal: &'a [(usize, f64)],
    /// The row of `C_t`: the change of the slip for unit displacements.
    pub tangent: &'a [(usize, f64)],
    /// The gap without displacements; negative if the bodies overlap.
    pub gap: f64,
    /// The slip without displacements.
    pub slip: f64,
    /// The coefficient of friction, at least zero.
    pub mu: f64,
    /// The compliances of springs in series with the contact, normal and tangential, at least zero.
    pub compliance: [f64; 2],
}

/// Builds a [`Contact2d`] point by point: see [`Contact2d::builder`].
#[derive(Debug, Clone)]
pub struct Contact2dBuilder {
    k: Matrix,
    f: Vec<f64>,
    /// The entries of `C_n` and `C_t`.
    normal: Triplets,
    tangent: Triplets,
    /// The points without their rows.
    points: Vec<ContactPoint<'static>>,
}

type Triplets = Vec<(usize, usize, f64)>;

impl Contact2d {
    /// A problem with the stiffness or mass `K` (n x n) and the loads `f` (n), to which contact points are added.
    ///
    /// ```
    /// use lcp::{Contact2d, ContactPoint, Lemke, Solver};
    /// // A body of weight 2 on a plane, pushed by 0.4, with the stiffness 3 behind it
    /// let mut builder = Contact2d::builder([[3.0, 0.0], [0.0, 0.0]], vec![0.4, -2.0]);
    /// let (x, y) = (0, 1);
    /// let foot = builder.add_point(ContactPoint {
    ///     normal: &[(y, 1.0)],
    ///     tangent: &[(x, 1.0)],
    ///     mu: 0.5,
    ///     ..Default::default()
    /// });
    /// let contact = builder.build()?;
    /// let state = contact.variables(&Lemke::default().solve(&contact)?);
    /// assert!((state.t_n[foot] - 2.0).abs() < 1e-14 && (state.t_t[foot] + 0.4).abs() < 1e-14);
    /// # Ok::<(), lcp::Error>(())
    /// ```
    pub fn builder(k: impl Into<Matrix>, f: impl Into<Vector>) -> Contact2dBuilder {
        let (k, f) = (k.into(), f.into().into_entries());
        Contact2dBuilder { k, f, normal: Vec::new(), tangent: Vec::new(), points: Vec::new() }
    }
}

impl Contact2dBuilder {
    /// Adds a contact point and returns its number, which is its index in the solution.
    pub fn add_point(&mut self, point: ContactPoint<'_>) -> usize {
        let number = self.points.len();
        let ContactPoint { normal, tangent, gap, slip, mu, compliance } = point;
        self.normal.extend(normal.iter().map(|&(index, value)| (number, index, value)));
        self.tangent.extend(tangent.iter().map(|&(index, value)| (number, index, value)));
        self.points.push(ContactPoint { normal: &[], tangent: &[], gap, slip, mu, compliance });
        number
    }

    /// Builds the problem.
    ///
    /// # Errors
    /// [`Error::PointEntry`] or [`Error::PointValue`] with the number of a point whose data are wrong, and the
    /// errors of [`Contact2d::new`] for `K` and `f`.
    pub fn build(self) -> Result<Contact2d, Error> {
        let Self { k, f, normal, tangent, points } = self;
        let (n, m) = (f.len(), points.len());
        for (row, entries) in [("normal", &normal), ("tangent", &tangent)] {
            check_entries(row, entries, n)?;
        }
        let gaps: Vec<f64> = points.iter().map(|point| point.gap).collect();
        let slips: Vec<f64> = points.iter().map(|point| point.slip).collect();
        let mu: Vec<f64> = points.iter().map(|point| point.mu).collect();
        check_points("gap", gaps.iter().copied(), "finite", f64::is_finite)?;
        check_points("slip", slips.iter().copied(), "finite", f64::is_finite)?;
        check_sizes("mu", mu.iter().copied())?;
        let compliance = points.iter().map(|point| point.compliance).collect();
        let [c_n, c_t] = [normal, tangent].map(|rows| Matrix::from_entries(m, n, rows.into_iter()));
        Contact2d::new(k, f, c_n, c_t, gaps, slips, mu)?.with_compliance(compliance)
    }
}

fn check_entries(row: &'static str, entries: &Triplets, displacements: usize) -> Result<(), Error> {
    let wrong = entries.iter().find(|(_, index, v)| *index >= displacements || !v.is_finite());
    match wrong {
        Some(&(point, index, value)) => {
            Err(Error::PointEntry { point, row, index, value, displacements })
        }
        None => Ok(()),
    }
}
