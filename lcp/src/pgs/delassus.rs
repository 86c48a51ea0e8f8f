//! The matrix `C K^-1 C^T + D` of contacts between elastic bodies, by its rows. `D` is diagonal: the compliances of the
//! contacts themselves. Every contact has a normal row followed by a tangential one, which is empty without friction.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::{MatMut, Side as Triangle};
use lcp_linalg::Columns;

use super::rows::parted;
use super::{ProjectedGaussSeidel, Rows};
use crate::definite::is_definite;
use crate::divide::sparse_block;
use crate::matrix::column_of;
use crate::parts::Parts;
use crate::{Contact2d, ContactState, Error};

/// Largest number of entries of `K^-1 C^T` that are kept. Chosen: a quarter of a GB.
const LARGEST: usize = 1 << 25;

/// The rows of `C K^-1 C^T + D`. Bodies that `K` does not couple are factorised one by one, so that a column of
/// `K^-1 C^T` has entries for the bodies at its contact only.
#[derive(Debug)]
pub(super) struct Delassus<'a> {
    problem: &'a Contact2d,
    bodies: Vec<Body>,
    c: Columns,
    /// `K^-1 C^T`.
    columns: Columns,
    /// The displacements `K^-1 C^T z`, which are the state of the iteration.
    u: Vec<f64>,
}

/// Displacements that `K` couples, with the Cholesky factor of their block.
#[derive(Debug)]
struct Body {
    displacements: Vec<usize>,
    factor: Llt<usize, f64>,
}

impl Body {
    /// Overwrites the loads on the body, among those on all bodies, with its displacements.
    fn solve(&self, loads: &mut [f64]) {
        let mut x: Vec<f64> = self.displacements.iter().map(|&j| loads[j]).collect();
        let n = x.len();
        self.factor.solve_in_place(MatMut::from_column_major_slice_mut(&mut x, n, 1));
        self.displacements.iter().zip(x).for_each(|(&j, x)| loads[j] = x);
    }
}

impl<'a> Delassus<'a> {
    pub(super) fn new(problem: &'a Contact2d) -> Result<Self, Error> {
        let (k, n) = (problem.stiffness(), problem.displacements());
        let indefinite = || {
            ProjectedGaussSeidel::not_treated(
                "K is not positive definite: take Lemke's method, which lets bodies float",
            )
        };
        if !is_definite(k) {
            return Err(indefinite());
        }
        let mut parts = Parts::new(n);
        for j in 0..n {
            let coupled = column_of(k, j).filter(|(_, v)| *v != 0.0);
            parts.join_all(coupled.map(|(i, _)| i).chain([j]));
        }
        let body = |displacements: Vec<usize>| {
            let block = sparse_block(k, &displacements, &displacements).into_sparse();
            let factor = block.sp_cholesky(Triangle::Lower).map_err(|_| indefinite())?;
            Ok(Body { displacements, factor })
        };
        let bodies: Vec<Body> =
            parts.groups().into_iter().map(body).collect::<Result<_, Error>>()?;
        let mut body_of = vec![0; n];
        for (number, body) in bodies.iter().enumerate() {
            body.displacements.iter().for_each(|&j| body_of[j] = number);
        }
        let c = rows_of_contacts(problem);
        let (mut columns, mut column, mut size) = (Columns::default(), vec![0.0; n], 0);
        for row in 0..c.len() {
            c.add_to(row, 1.0, &mut column);
            let mut touched: Vec<usize> = c.entries(row).map(|(j, _)| body_of[j]).collect();
            touched.sort_unstable();
            touched.dedup();
            for body in touched.into_iter().map(|number| &bodies[number]) {
                size += body.displacements.len();
                if size > LARGEST {
                    return Err(ProjectedGaussSeidel::not_treated(format!(
                        "contacts act on bodies of so many displacements that K^-1 C^T has more than \
                         {LARGEST} numbers: take Lemke's method"
                    )));
                }
                body.solve(&mut column);
                for &j in &body.displacements {
                    columns.push(j, column[j]);
                    column[j] = 0.0;
                }
            }
            columns.close();
        }
        Ok(Self { problem, bodies, c, columns, u: vec![0.0; n] })
    }

    pub(super) fn factorisations(&self) -> usize {
        self.bodies.len()
    }

    /// The state of these forces, with the displacements `K^-1 (f + C^T z)`.
    pub(super) fn state(&self, z: &[f64]) -> ContactState {
        let mut u = self.problem.loads().to_vec();
        z.iter().enumerate().for_each(|(row, z)| self.c.add_to(row, *z, &mut u));
        self.bodies.iter().for_each(|body| body.solve(&mut u));
        let [t_n, t_t] = parted(z);
        self.problem.state(u, t_n, t_t)
    }

    /// The displacement of a contact by the force in its own row.
    fn own(&self, row: usize, z: &[f64]) -> f64 {
        self.problem.compliance()[row / 2][row % 2] * z[row]
    }
}

/// `C`, with empty tangential rows without friction.
fn rows_of_contacts(problem: &Contact2d) -> Columns {
    let mut columns = Columns::default();
    for j in 0..problem.displacements() {
        let normal = column_of(problem.normal(), j).map(|(i, v)| (2 * i, v));
        let tangent = column_of(problem.tangent(), j).filter(|(i, _)| problem.mu()[*i] > 0.0);
        let both = normal.chain(tangent.map(|(i, v)| (2 * i + 1, v)));
        both.for_each(|(row, v)| columns.push(row, v));
        columns.close();
    }
    columns.transposed(2 * problem.points())
}

impl Rows for Delassus<'_> {
    fn order(&self) -> usize {
        self.c.len()
    }

    fn product(&self, i: usize, z: &[f64]) -> f64 {
        self.c.dot(i, &self.u) + self.own(i, z)
    }

    fn moved(&mut self, i: usize, change: f64) {
        self.columns.add_to(i, change, &mut self.u);
    }

    fn clear(&mut self) {
        self.u.fill(0.0);
    }

    fn size(&self, i: usize, z: &[f64]) -> f64 {
        let of_bodies: f64 = self.c.entries(i).map(|(j, v)| (v * self.u[j]).abs()).sum();
        of_bodies + self.own(i, z).abs()
    }
}
