//! The matrix `C K^-1 C^T` of contacts between elastic bodies, by its rows.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatMut, Side as Triangle};

use super::{ProjectedGaussSeidel, Rows};
use crate::Error;
use crate::linear::inverse_norm;
use crate::problem::column_of;
use crate::sparse::Columns;

/// Most numbers of `K^-1 C^T`.
const LARGEST: usize = 1 << 25;

/// `K^-1 C^T`. Bodies that `K` does not couple are factorised one by one, so that a column has entries for
/// the bodies at its contact only.
#[derive(Debug)]
pub(super) struct Compliance {
    bodies: Vec<Body>,
    /// The rows of `C`.
    c: Columns,
    /// The rows of `C` that have an entry for a displacement.
    contacts: Columns,
    columns: Columns,
}

/// The rows of `C K^-1 C^T`, with the displacements `K^-1 C^T z` as the state.
#[derive(Debug)]
pub(super) struct Delassus<'a> {
    compliance: &'a Compliance,
    u: Vec<f64>,
}

/// Displacements that `K` couples, with the Cholesky factor of their block of `K`, equilibrated.
#[derive(Debug)]
struct Body {
    displacements: Vec<usize>,
    scale: Vec<f64>,
    factor: Llt<usize, f64>,
}

impl Compliance {
    /// From `K` and the rows of `C`, none of which is empty.
    pub(super) fn new(k: &SparseColMat<usize, f64>, c: Columns) -> Result<Self, Error> {
        let n = k.ncols();
        let members = components(k);
        let mut body_of = vec![0; n];
        for (body, displacements) in members.iter().enumerate() {
            for &j in displacements {
                body_of[j] = body;
            }
        }
        let touched: Vec<Vec<usize>> = (0..c.len())
            .map(|row| {
                let mut bodies: Vec<usize> = c.entries(row).map(|(j, _)| body_of[j]).collect();
                bodies.sort_unstable();
                bodies.dedup();
                bodies
            })
            .collect();
        let size: usize = touched.iter().flatten().map(|&body| members[body].len()).sum();
        if size > LARGEST {
            return Err(ProjectedGaussSeidel::not_treated(format!(
                "the {} rows of its contacts act on bodies of so many displacements that K^-1 C^T has \
                 {size} numbers, above the limit of {LARGEST}: take Lemke's method",
                c.len()
            )));
        }
        let bodies: Vec<Body> =
            members.into_iter().map(|members| Body::new(k, members)).collect::<Result<_, _>>()?;
        let (mut columns, mut column) = (Columns::default(), vec![0.0; n]);
        for (row, touched) in touched.iter().enumerate() {
            c.entries(row).for_each(|(j, v)| column[j] = v);
            for &body in touched {
                bodies[body].solve(&mut column);
                for &j in &bodies[body].displacements {
                    columns.push(j, column[j]);
                    column[j] = 0.0;
                }
            }
            columns.close();
        }
        Ok(Self { bodies, contacts: c.transposed(n), c, columns })
    }

    /// Number of factorisations.
    pub(super) fn factorisations(&self) -> usize {
        self.bodies.len()
    }

    /// The displacements `K^-1 (f + C^T z)`.
    pub(super) fn displacements(&self, f: &[f64], z: &[f64]) -> Vec<f64> {
        let mut u = f.to_vec();
        z.iter().enumerate().for_each(|(row, z)| self.c.add_to(row, *z, &mut u));
        self.bodies.iter().for_each(|body| body.solve(&mut u));
        u
    }

    /// The displacements `u` that belong to `free` ones without contact and to the forces `z`, those put to
    /// zero that cancel to `tolerance` of their parts.
    pub(super) fn cleared(&self, u: &[f64], free: &[f64], z: &[f64], tolerance: f64) -> Vec<f64> {
        let mut sizes: Vec<f64> = free.iter().map(|u| u.abs()).collect();
        for (row, z) in z.iter().enumerate().filter(|(_, z)| **z != 0.0) {
            self.columns.entries(row).for_each(|(j, v)| sizes[j] += (v * z).abs());
        }
        let places = u.iter().zip(sizes);
        places.map(|(&u, size)| if u.abs() <= tolerance * size { 0.0 } else { u }).collect()
    }
}

impl<'a> Delassus<'a> {
    pub(super) fn new(compliance: &'a Compliance) -> Self {
        Self { compliance, u: vec![0.0; compliance.contacts.len()] }
    }
}

impl Rows for Delassus<'_> {
    fn order(&self) -> usize {
        self.compliance.c.len()
    }

    fn product(&self, i: usize, _z: &[f64]) -> f64 {
        self.compliance.c.dot(i, &self.u)
    }

    fn moved(&mut self, i: usize, change: f64) {
        self.compliance.columns.add_to(i, change, &mut self.u);
    }

    fn clear(&mut self) {
        self.u.fill(0.0);
    }

    fn size(&self, i: usize, _z: &[f64]) -> f64 {
        self.compliance.c.entries(i).map(|(j, v)| (v * self.u[j]).abs()).sum()
    }

    fn neighbours(&self, i: usize) -> Option<Vec<usize>> {
        let displacements = self.compliance.columns.rows(i).iter();
        let rows = displacements.flat_map(|&j| self.compliance.contacts.rows(j as usize));
        let mut rows: Vec<usize> = rows.map(|&row| row as usize).collect();
        rows.sort_unstable();
        rows.dedup();
        Some(rows)
    }
}

impl Body {
    fn new(k: &SparseColMat<usize, f64>, displacements: Vec<usize>) -> Result<Self, Error> {
        let n = displacements.len();
        let singular = |why: String| {
            ProjectedGaussSeidel::not_treated(format!(
                "K is not positive definite, {why}: take Lemke's method, which lets bodies float"
            ))
        };
        let scale = displacements
            .iter()
            .map(|&j| {
                let diagonal = column_of(k, j).find(|(i, _)| *i == j).map_or(0.0, |(_, v)| v);
                let factor = (-0.5 * diagonal.log2()).round().exp2();
                if diagonal > 0.0 && factor.is_finite() {
                    Ok(factor)
                } else {
                    Err(singular(format!("K[{j}, {j}] is {diagonal}")))
                }
            })
            .collect::<Result<Vec<f64>, Error>>()?;
        let (mut triplets, mut largest) = (Vec::new(), 0.0_f64);
        for (col, &j) in displacements.iter().enumerate() {
            let mut sum = 0.0;
            for (i, v) in column_of(k, j).filter(|(_, v)| *v != 0.0) {
                let row = displacements
                    .binary_search(&i)
                    .unwrap_or_else(|_| unreachable!("{i} is coupled with {j}"));
                let v = scale[row] * v * scale[col];
                sum += v.abs();
                triplets.push(Triplet::new(row, col, v));
            }
            largest = largest.max(sum);
        }
        let block = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &triplets)
            .unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"));
        let first = displacements.first().copied().unwrap_or(0);
        let place = format!("in the block of displacement {first}, of order {n}");
        let factor = block
            .sp_cholesky(Triangle::Lower)
            .map_err(|_| singular(format!("Cholesky's method finds {place}")))?;
        let condition = largest
            * inverse_norm(n, |x, _| {
                factor.solve_in_place(MatMut::from_column_major_slice_mut(x, n, 1));
            });
        // Not if it is not a number.
        if condition * (n as f64) * f64::EPSILON < 1.0 {
            Ok(Self { displacements, scale, factor })
        } else {
            Err(singular(format!("its condition number is {condition:.0e} {place}")))
        }
    }

    /// Overwrites the loads on the body with its displacements.
    fn solve(&self, loads: &mut [f64]) {
        let places = self.displacements.iter().zip(&self.scale);
        let mut x: Vec<f64> = places.clone().map(|(&j, scale)| scale * loads[j]).collect();
        let n = x.len();
        self.factor.solve_in_place(MatMut::from_column_major_slice_mut(&mut x, n, 1));
        places.zip(x).for_each(|((&j, scale), x)| loads[j] = scale * x);
    }
}

/// The displacements that `K`, which is symmetric, couples, each in ascending order.
fn components(k: &SparseColMat<usize, f64>) -> Vec<Vec<usize>> {
    let mut is_seen = vec![false; k.ncols()];
    let mut components = Vec::new();
    for first in 0..k.ncols() {
        if is_seen[first] {
            continue;
        }
        is_seen[first] = true;
        let (mut members, mut next) = (vec![first], 0);
        while let Some(&j) = members.get(next) {
            next += 1;
            for (i, v) in column_of(k, j) {
                if v != 0.0 && !is_seen[i] {
                    is_seen[i] = true;
                    members.push(i);
                }
            }
        }
        members.sort_unstable();
        components.push(members);
    }
    components
}
