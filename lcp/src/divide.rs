//! The independent parts of a problem: sets of rows and variables that no entry connects.
//!
//! Each part can be solved by itself, with units and limits of its own, and a part without a solution proves that the
//! whole has none. Answers and starts have the pairs of the general form, so that a part needs only its pairs and rows
//! among those of the whole.

use faer::Mat;
use faer::sparse::SparseColMat;

use crate::certify::Residuals;
use crate::conversion::General;
use crate::matrix::{Column, Storage};
use crate::parts::Parts;
use crate::problem::column_of;
use crate::{
    BoxedLcp, Certificate, Contact2d, ContactState, Error, Friction2d, HorizontalLcp, Lcp, Leaf,
    Matrix, MixedLcp, Ray, Side, Solution, WarmStart,
};

/// An independent part.
#[derive(Debug, Clone)]
pub struct Part<P> {
    pub(crate) problem: P,
    /// The places of the pairs of its general form in that of the whole.
    pub(crate) pairs: Vec<usize>,
    /// The places of its rows.
    pub(crate) rows: Vec<usize>,
}

/// A problem that may have independent parts, implemented by the problems of the library only.
pub trait Divide: General + Sized {
    /// The parts; `None` if there is only one. The entries of a connected problem are visited only until they connect
    /// all of it.
    fn parts(&self) -> Option<Vec<Part<Self>>>;

    /// The point of the whole with these pairs, joined from those of its parts.
    fn join(&self, t: &[f64], y: &[f64], _answers: &[(Part<Self>, Solution)]) -> Joined {
        let residuals = self.residuals_of_pairs(t, y);
        Joined { residuals, contact: None, boxed: None }
    }
}

/// A point of the whole: its variables with all their digits, as in a [`Solution`].
pub struct Joined {
    pub(crate) residuals: Residuals,
    pub(crate) contact: Option<ContactState>,
    pub(crate) boxed: Option<(Vec<f64>, Vec<f64>)>,
}

impl<P> Part<P> {
    /// A part with the same numbers of rows and pairs.
    fn new(problem: P, pairs: Vec<usize>) -> Self {
        Self { problem, rows: pairs.clone(), pairs }
    }

    /// The start of this part in a start of the whole.
    pub(crate) fn start(&self, start: &WarmStart) -> WarmStart {
        start.of_pairs(self.pairs.iter().map(|&pair| (pair, false)))
    }

    /// The certificate of a whole of `pairs` pairs from the certificate of this part: a proof is extended by zeros in
    /// all other rows, and other parts stay at rest in a ray.
    pub(crate) fn certificate(&self, certificate: &Certificate, pairs: usize) -> Certificate {
        let rows = |part: &[f64]| spread(&self.rows, part, pairs, 0.0);
        match certificate {
            Certificate::Farkas { pi } => Certificate::Farkas { pi: rows(pi) },
            Certificate::Choices { leaves } => {
                let sides = |leaf: &Leaf| spread(&self.pairs, &leaf.sides, pairs, None);
                let leaf = |leaf: &Leaf| Leaf { sides: sides(leaf), pi: rows(&leaf.pi) };
                Certificate::Choices { leaves: leaves.iter().map(leaf).collect() }
            }
            Certificate::Ray(Ray { dt, dy, dz0, covering }) => Certificate::Ray(Ray {
                dt: spread(&self.pairs, dt, pairs, 0.0),
                dy: spread(&self.pairs, dy, pairs, 0.0),
                dz0: *dz0,
                covering: rows(covering),
            }),
        }
    }
}

impl Divide for HorizontalLcp {
    /// The parts. Parts with unequal numbers of rows and pairs, such as a row of zeros and a pair of zeros, are joined
    /// to one part.
    fn parts(&self) -> Option<Vec<Part<Self>>> {
        let n = self.order();
        let mut parts = Parts::new(2 * n);
        for j in 0..n {
            for side in [Side::T, Side::Y] {
                connect(&mut parts, self.column(j, side), |i| i, n + j);
            }
        }
        if parts.is_one() {
            return None;
        }
        let mut odd = None;
        for group in parts.groups() {
            if 2 * group.iter().filter(|&&it| it < n).count() != group.len() {
                parts.join(*odd.get_or_insert(group[0]), group[0]);
            }
        }
        groups_of_parts(parts)?
            .into_iter()
            .map(|group| {
                let (rows, pairs) = split(&group, n);
                let (a, b) = (block(self.a(), &rows, &pairs), block(self.b(), &rows, &pairs));
                let problem = Self::new(a, b, picked(self.c(), &rows)).ok()?;
                Some(Part { problem, pairs, rows })
            })
            .collect()
    }
}

impl Divide for Lcp {
    fn parts(&self) -> Option<Vec<Part<Self>>> {
        parts_of(self.m(), |m, group| Self::new(m, picked(self.q(), group)))
    }
}

impl Divide for MixedLcp {
    fn parts(&self) -> Option<Vec<Part<Self>>> {
        parts_of(self.m(), |m, group| {
            Self::new(m, picked(self.q(), group), picked(self.free(), group))
        })
    }
}

impl Divide for BoxedLcp {
    fn parts(&self) -> Option<Vec<Part<Self>>> {
        let mut parts = parts_of(self.m(), |m, group| {
            let [q, lower, upper] =
                [self.q(), self.lower(), self.upper()].map(|v| picked(v, group));
            Self::new(m, q, lower, upper)
        })?;
        let upper_pairs = self.upper_pairs();
        for part in &mut parts {
            part.pairs.extend(part.rows.iter().filter_map(|&i| upper_pairs[i]));
            part.rows.clone_from(&part.pairs);
        }
        Some(parts)
    }

    fn join(&self, t: &[f64], y: &[f64], answers: &[(Part<Self>, Solution)]) -> Joined {
        let (mut z, mut w) = self.recover(t, y);
        for (part, answer) in answers {
            let variables = &part.pairs[..part.problem.order()];
            let recovered = || part.problem.recover(&answer.t, &answer.y);
            let (of_z, of_w) = answer.boxed.clone().unwrap_or_else(recovered);
            put(variables, &of_z, &mut z);
            put(variables, &of_w, &mut w);
        }
        Joined { residuals: self.residuals(&z, &w), contact: None, boxed: Some((z, w)) }
    }
}

impl Divide for Friction2d {
    fn parts(&self) -> Option<Vec<Part<Self>>> {
        let mut parts = Parts::new(self.contacts());
        for j in 0..self.q().len() {
            connect(&mut parts, self.w().slice(j), |i| i / 2, j / 2);
        }
        let part = |group: Vec<usize>| {
            let rows: Vec<usize> = group.iter().flat_map(|&k| [2 * k, 2 * k + 1]).collect();
            let w = block(self.w(), &rows, &rows);
            let problem = Self::new(w, picked(self.q(), &rows), picked(self.mu(), &group)).ok()?;
            let pairs = group.iter().flat_map(|&k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
            Some(Part::new(problem, pairs))
        };
        groups_of_parts(parts)?.into_iter().map(part).collect()
    }
}

impl Divide for Contact2d {
    fn parts(&self) -> Option<Vec<Part<Self>>> {
        let (n, m) = (self.displacements(), self.points());
        let mut parts = Parts::new(n + m);
        for j in 0..n {
            let displacements = column_of(self.stiffness(), j);
            let normal = column_of(self.normal(), j).map(|(i, v)| (n + i, v));
            let tangent = column_of(self.tangent(), j).map(|(i, v)| (n + i, v));
            let entries = displacements.chain(normal).chain(tangent).filter(|(_, v)| *v != 0.0);
            parts.join_all(entries.map(|(i, _)| i).chain([j]));
        }
        let mut place = vec![None; m];
        self.frictional().iter().enumerate().for_each(|(k, &point)| place[point] = Some(k));
        let part = |group: Vec<usize>| {
            let (u, points) = split(&group, n);
            let sparse = |c: &SparseColMat<usize, f64>, rows: &[usize]| sparse_block(c, rows, &u);
            let problem = Self::new(
                sparse(self.stiffness(), &u),
                picked(self.loads(), &u),
                sparse(self.normal(), &points),
                sparse(self.tangent(), &points),
                picked(self.initial_gaps(), &points),
                picked(self.initial_slips(), &points),
                picked(self.mu(), &points),
            );
            let problem =
                problem.and_then(|it| it.with_compliance(picked(self.compliance(), &points)));
            let frictional: Vec<usize> = points.iter().filter_map(|&point| place[point]).collect();
            let count = self.frictional().len();
            let pairs = group.iter().copied();
            let pairs = pairs.chain(frictional.iter().map(|k| n + m + k));
            let pairs = pairs.chain(frictional.iter().map(|k| n + m + count + k)).collect();
            Some(Part::new(problem.ok()?, pairs))
        };
        groups_of_parts(parts)?.into_iter().map(part).collect()
    }

    fn join(&self, t: &[f64], y: &[f64], answers: &[(Part<Self>, Solution)]) -> Joined {
        let mut state = self.recover(t, y);
        for (part, answer) in answers {
            let recovered = || part.problem.recover(&answer.t, &answer.y);
            part.put_state(&answer.contact.clone().unwrap_or_else(recovered), &mut state);
        }
        Joined { residuals: self.residuals(&state), contact: Some(state), boxed: None }
    }
}

impl Part<Contact2d> {
    /// Writes a state of the part to the places of its displacements and points in the `whole`.
    fn put_state(&self, part: &ContactState, whole: &mut ContactState) {
        let n = whole.u.len();
        let count = self.problem.displacements() + self.problem.points();
        let (u, points) = split(&self.pairs[..count], n);
        put(&u, &part.u, &mut whole.u);
        put(&points, &part.t_n, &mut whole.t_n);
        put(&points, &part.t_t, &mut whole.t_t);
        put(&points, &part.gap, &mut whole.gap);
        put(&points, &part.slip, &mut whole.slip);
    }
}

/// The parts of a problem with this matrix, whose rows belong to its columns, from their blocks and variables.
fn parts_of<P>(
    m: &Matrix,
    problem: impl Fn(Matrix, &[usize]) -> Result<P, Error>,
) -> Option<Vec<Part<P>>> {
    let mut parts = Parts::new(m.ncols());
    for j in 0..m.ncols() {
        connect(&mut parts, m.slice(j), |i| i, j);
    }
    let part =
        |group: Vec<usize>| Some(Part::new(problem(block(m, &group, &group), &group).ok()?, group));
    groups_of_parts(parts)?.into_iter().map(part).collect()
}

fn groups_of_parts(mut parts: Parts) -> Option<Vec<Vec<usize>>> {
    (!parts.is_one()).then(|| parts.groups())
}

/// Joins the rows in which a column is not zero, numbered by `element`, with one more element.
fn connect(parts: &mut Parts, column: Column<'_>, element: impl Fn(usize) -> usize, with: usize) {
    if !parts.is_one() {
        column.for_each(|i, v| {
            if v != 0.0 {
                parts.join(element(i), with);
            }
        });
    }
}

/// The elements below `n`, and the others counted from `n`.
fn split(group: &[usize], n: usize) -> (Vec<usize>, Vec<usize>) {
    let (first, others): (Vec<usize>, Vec<usize>) = group.iter().partition(|&&it| it < n);
    (first, others.into_iter().map(|it| it - n).collect())
}

/// Rows and columns of a matrix, ascending, if these columns have no entries in other rows.
pub(crate) fn block(m: &Matrix, rows: &[usize], cols: &[usize]) -> Matrix {
    match m.storage() {
        Storage::Dense(m) => {
            Mat::from_fn(rows.len(), cols.len(), |i, j| m[(rows[i], cols[j])]).into()
        }
        Storage::Sparse(m) => sparse_block(m, rows, cols),
    }
}

pub(crate) fn sparse_block(m: &SparseColMat<usize, f64>, rows: &[usize], cols: &[usize]) -> Matrix {
    let entries = cols.iter().enumerate().flat_map(|(k, &j)| {
        let entries = column_of(m, j).filter(|(_, v)| *v != 0.0);
        entries.filter_map(move |(i, v)| rows.binary_search(&i).ok().map(|i| (i, k, v)))
    });
    Matrix::from_entries(rows.len(), cols.len(), entries)
}

fn picked<T: Copy>(whole: &[T], places: &[usize]) -> Vec<T> {
    places.iter().map(|&at| whole[at]).collect()
}

fn spread<T: Copy>(places: &[usize], part: &[T], count: usize, elsewhere: T) -> Vec<T> {
    let mut whole = vec![elsewhere; count];
    put(places, part, &mut whole);
    whole
}

/// Writes values of a part, such as those of `t`, of `y` or the sides of a basis, to their places in the whole.
pub(crate) fn put<T: Copy>(places: &[usize], part: &[T], whole: &mut [T]) {
    places.iter().zip(part).for_each(|(&at, &value)| whole[at] = value);
}

#[cfg(test)]
mod tests;
