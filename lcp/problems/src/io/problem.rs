//! The problems that files hold.

use std::borrow::Cow;

use super::{Position, ReadError};
use lcp::{
    BoxedLcp, Contact2d, ContactForces, Friction2d, HorizontalLcp, Lcp, Matrix, MixedLcp, Qp,
    Residuals,
};

/// Evaluates the same expression for a problem of any kind.
macro_rules! each {
    ($of:expr, $problem:ident => $what:expr) => {
        match $of {
            $crate::io::Problem::Lcp($problem) => $what,
            $crate::io::Problem::Horizontal($problem) => $what,
            $crate::io::Problem::Mixed($problem) => $what,
            $crate::io::Problem::Boxed($problem) => $what,
            $crate::io::Problem::Friction($problem) => $what,
            $crate::io::Problem::Contact($problem) => $what,
            $crate::io::Problem::Qp(program) => {
                let $problem = program.mixed();
                $what
            }
        }
    };
}
#[cfg(feature = "cli")]
pub(crate) use each;

/// A problem of any kind that files hold.
///
/// All kinds have the vectors `z` and `w`: `z = t` and `w = y` in the general form; for [`Friction2d`] the vectors
/// of its standard form, for [`Contact2d`] the pairs of its general form, and for [`Qp`] the vectors of its
/// conditions.
#[derive(Debug, Clone, serde::Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
#[non_exhaustive]
pub enum Problem {
    /// The standard form.
    Lcp(Lcp),
    /// The general form.
    Horizontal(HorizontalLcp),
    /// Complementary pairs together with free variables.
    Mixed(MixedLcp),
    /// Variables between bounds.
    Boxed(BoxedLcp),
    /// Contact with friction in the plane, reduced to the contacts.
    Friction(Friction2d),
    /// Contact with friction in the plane, with the displacements as unknowns.
    Contact(Contact2d),
    /// A convex quadratic program.
    Qp(Qp),
}

impl Problem {
    /// The name of the kind.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Lcp(_) => "lcp",
            Self::Horizontal(_) => "horizontal",
            Self::Mixed(_) => "mixed",
            Self::Boxed(_) => "boxed",
            Self::Friction(_) => "friction",
            Self::Contact(_) => "contact",
            Self::Qp(_) => "qp",
        }
    }

    /// Number of entries of `z` and of `w`.
    pub fn order(&self) -> usize {
        each!(self, problem => problem.order())
    }

    /// The matrices, with their names.
    pub fn matrices(&self) -> Vec<(&'static str, Cow<'_, Matrix>)> {
        let borrowed = |name, matrix| (name, Cow::Borrowed(matrix));
        match self {
            Self::Lcp(problem) => vec![borrowed("M", problem.m())],
            Self::Horizontal(problem) => {
                vec![borrowed("A", problem.a()), borrowed("B", problem.b())]
            }
            Self::Mixed(problem) => vec![borrowed("M", problem.m())],
            Self::Boxed(problem) => vec![borrowed("M", problem.m())],
            Self::Friction(problem) => vec![borrowed("W", problem.w())],
            Self::Qp(problem) => vec![borrowed("P", problem.p()), borrowed("A", problem.a())],
            Self::Contact(problem) => {
                let named = [
                    ("K", problem.stiffness()),
                    ("C_n", problem.normal()),
                    ("C_t", problem.tangent()),
                ];
                named.map(|(name, m)| (name, Cow::Owned(m.clone().into()))).into()
            }
        }
    }

    /// The general problem, for a solver.
    pub fn to_general(&self) -> HorizontalLcp {
        match self {
            Self::Lcp(problem) => problem.clone().into(),
            Self::Horizontal(problem) => problem.clone(),
            Self::Mixed(problem) => problem.to_general(),
            Self::Boxed(problem) => problem.to_general(),
            Self::Friction(problem) => problem.standard().clone().into(),
            Self::Contact(problem) => problem.to_general(),
            Self::Qp(program) => program.mixed().to_general(),
        }
    }

    /// The problem with bounds that the kind contains or is a case of.
    pub(crate) fn boxed(&self) -> Option<&BoxedLcp> {
        match self {
            Self::Mixed(problem) => Some(problem.boxed()),
            Self::Boxed(problem) => Some(problem),
            Self::Qp(problem) => Some(problem.mixed().boxed()),
            _ => None,
        }
    }

    /// `(z, w)` from a point of the general problem.
    ///
    /// # Panics
    /// If `t` or `y` does not have one entry for every pair of the general problem.
    pub fn recover(&self, t: &[f64], y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.boxed().map_or_else(|| (t.to_vec(), y.to_vec()), |boxed| boxed.recover(t, y))
    }

    /// The point of the general problem that belongs to `(z, w)`.
    ///
    /// # Panics
    /// If `z` or `w` does not have one entry for every variable.
    pub fn to_pairs(&self, z: &[f64], w: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.boxed().map_or_else(|| (z.to_vec(), w.to_vec()), |boxed| boxed.to_pairs(z, w))
    }

    /// `w = M z + q`, for the kinds of this form: all except the general form and contact.
    ///
    /// # Panics
    /// If `z` does not have one entry for every variable.
    pub fn w_of(&self, z: &[f64]) -> Option<Vec<f64>> {
        let (m, q) = match (self, self.boxed()) {
            (_, Some(boxed)) => (boxed.m(), boxed.q()),
            (Self::Lcp(problem), _) => (problem.m(), problem.q()),
            (Self::Friction(problem), _) => (problem.standard().m(), problem.standard().q()),
            _ => return None,
        };
        Some(affine(m, z, q))
    }

    /// Residuals of a point in the variables of the problem.
    ///
    /// # Panics
    /// If `z` or `w` does not have one entry for every variable.
    pub fn residuals(&self, z: &[f64], w: &[f64]) -> Residuals {
        match self {
            Self::Lcp(problem) => problem.residuals(z, w),
            Self::Horizontal(problem) => problem.residuals(z, w),
            Self::Mixed(problem) => problem.residuals(z, w),
            Self::Boxed(problem) => problem.residuals(z, w),
            Self::Friction(problem) => problem.residuals(&problem.forces(z)),
            Self::Contact(problem) => problem.residuals(&problem.recover(z, w)),
            Self::Qp(program) => program.mixed().residuals(z, w),
        }
    }
}

/// The problem of data that end a file, or the error in them.
pub(super) fn posed<P>(
    problem: Result<P, lcp::Error>,
    kind: impl FnOnce(P) -> Problem,
    at: Position,
) -> Result<Problem, ReadError> {
    problem.map(kind).map_err(|source| ReadError::Refused { at, source })
}

/// The point of the general problem that belongs to forces at contacts.
#[cfg(feature = "cli")]
pub(crate) fn pairs_of_forces(
    problem: &Friction2d,
    forces: &ContactForces,
) -> (Vec<f64>, Vec<f64>) {
    let both = forces.normal.iter().zip(&forces.tangential);
    let r: Vec<f64> = both.flat_map(|(normal, tangential)| [*normal, *tangential]).collect();
    problem.to_pairs(&r, &affine(problem.w(), &r, problem.q()))
}

/// Rounding errors of a sum, relative to the largest of its terms.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// `M z + q`, with zero for terms that cancel up to rounding.
fn affine(m: &Matrix, z: &[f64], q: &[f64]) -> Vec<f64> {
    assert_eq!(z.len(), q.len(), "one entry for every variable");
    let (mut sums, mut sizes) = (q.to_vec(), q.iter().map(|q| q.abs()).collect::<Vec<f64>>());
    for (j, z) in z.iter().enumerate() {
        for (i, entry) in m.column(j) {
            sums[i] += entry * z;
            sizes[i] += (entry * z).abs();
        }
    }
    let kept = |(sum, size): (f64, f64)| if sum.abs() > ROUNDING * size { sum } else { 0.0 };
    sums.into_iter().zip(sizes).map(kept).collect()
}
