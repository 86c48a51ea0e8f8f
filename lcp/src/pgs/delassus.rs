//! The matrix `C K^-1 C^T + D` of contacts between elastic bodies, by its rows. `D` is diagonal: the compliances of the
//! contacts themselves.

use faer::sparse::SparseColMat;

use super::body::{Body, coupled_displacements};
use super::constants::LARGEST;
use super::{ProjectedGaussSeidel, Rows};
use crate::Error;
use crate::sparse::Columns;

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
    /// The diagonal of `D`.
    own: Vec<f64>,
}

/// The rows of `C K^-1 C^T + D`, with the displacements `K^-1 C^T z` as the state.
#[derive(Debug)]
pub(super) struct Delassus<'a> {
    compliance: &'a Compliance,
    u: Vec<f64>,
}

impl Compliance {
    /// From `K`, the rows of `C`, none of which is empty, and the diagonal of `D`.
    pub(super) fn new(
        k: &SparseColMat<usize, f64>,
        c: Columns,
        own: Vec<f64>,
    ) -> Result<Self, Error> {
        let n = k.ncols();
        let coupled = coupled_displacements(k);
        let mut body_of = vec![0; n];
        for (body, displacements) in coupled.iter().enumerate() {
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
        let size: usize = touched.iter().flatten().map(|&body| coupled[body].len()).sum();
        if size > LARGEST {
            return Err(ProjectedGaussSeidel::not_treated(format!(
                "the {} rows of its contacts act on bodies of so many displacements that K^-1 C^T has \
                 {size} numbers, above the limit of {LARGEST}: take Lemke's method",
                c.len()
            )));
        }
        let bodies = coupled.into_iter().map(|displacements| Body::new(k, displacements));
        let bodies: Vec<Body> = bodies.collect::<Result<_, _>>()?;
        let (mut columns, mut column) = (Columns::default(), vec![0.0; n]);
        for (row, touched) in touched.iter().enumerate() {
            c.entries(row).for_each(|(j, v)| column[j] = v);
            for &body in touched {
                bodies[body].solve(&mut column);
                for &j in bodies[body].displacements() {
                    columns.push(j, column[j]);
                    column[j] = 0.0;
                }
            }
            columns.close();
        }
        Ok(Self { bodies, contacts: c.transposed(n), c, columns, own })
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

    fn product(&self, i: usize, z: &[f64]) -> f64 {
        self.compliance.c.dot(i, &self.u) + self.compliance.own[i] * z[i]
    }

    fn moved(&mut self, i: usize, change: f64) {
        self.compliance.columns.add_to(i, change, &mut self.u);
    }

    fn clear(&mut self) {
        self.u.fill(0.0);
    }

    fn size(&self, i: usize, z: &[f64]) -> f64 {
        let of_bodies: f64 = self.compliance.c.entries(i).map(|(j, v)| (v * self.u[j]).abs()).sum();
        of_bodies + (self.compliance.own[i] * z[i]).abs()
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
