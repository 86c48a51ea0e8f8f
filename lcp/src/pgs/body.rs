//! Bodies: displacements that the stiffness couples.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatMut, Side as Triangle};

use super::ProjectedGaussSeidel;
use crate::Error;
use crate::linear::inverse_norm;
use crate::problem::column_of;

/// Displacements that `K` couples, with what solves for them.
#[derive(Debug)]
pub(super) enum Body {
    /// One displacement alone, as of a mass.
    Single { displacement: usize, stiffness: f64 },
    /// The Cholesky factor of their block of `K`, equilibrated by `scale` on both sides.
    Coupled { displacements: Vec<usize>, scale: Vec<f64>, factor: Llt<usize, f64> },
}

impl Body {
    /// From the displacements, in ascending order, that belong to one component of `K`.
    pub(super) fn new(
        k: &SparseColMat<usize, f64>,
        displacements: Vec<usize>,
    ) -> Result<Self, Error> {
        let diagonals: Vec<f64> =
            displacements.iter().map(|&j| diagonal(k, j)).collect::<Result<_, _>>()?;
        if let ([displacement], [stiffness]) = (&*displacements, &*diagonals) {
            return Ok(Self::Single { displacement: *displacement, stiffness: *stiffness });
        }
        let n = displacements.len();
        let scale: Vec<f64> =
            diagonals.iter().map(|diagonal| (-0.5 * diagonal.log2()).round().exp2()).collect();
        let (block, norm) = equilibrated(k, &displacements, &scale);
        let first = displacements.first().copied().unwrap_or(0);
        let place = format!("in the block of displacement {first}, of order {n}");
        let factor = block
            .sp_cholesky(Triangle::Lower)
            .map_err(|_| singular(&format!("Cholesky's method finds {place}")))?;
        let inverse_norm = inverse_norm(n, |x, _| {
            factor.solve_in_place(MatMut::from_column_major_slice_mut(x, n, 1));
        });
        let condition = norm * inverse_norm;
        // Not if it is not a number.
        if condition * (n as f64) * f64::EPSILON < 1.0 {
            Ok(Self::Coupled { displacements, scale, factor })
        } else {
            Err(singular(&format!("its condition number is {condition:.0e} {place}")))
        }
    }

    pub(super) fn displacements(&self) -> &[usize] {
        match self {
            Self::Single { displacement, .. } => std::slice::from_ref(displacement),
            Self::Coupled { displacements, .. } => displacements,
        }
    }

    /// Overwrites the loads on the body, among those on all bodies, with its displacements.
    pub(super) fn solve(&self, loads: &mut [f64]) {
        match self {
            Self::Single { displacement, stiffness } => loads[*displacement] /= stiffness,
            Self::Coupled { displacements, scale, factor } => {
                let places = displacements.iter().zip(scale);
                let mut x: Vec<f64> = places.clone().map(|(&j, scale)| scale * loads[j]).collect();
                let n = x.len();
                factor.solve_in_place(MatMut::from_column_major_slice_mut(&mut x, n, 1));
                places.zip(x).for_each(|((&j, scale), x)| loads[j] = scale * x);
            }
        }
    }
}

fn singular(why: &str) -> Error {
    ProjectedGaussSeidel::not_treated(format!(
        "K is not positive definite, {why}: take Lemke's method, which lets bodies float"
    ))
}

fn diagonal(k: &SparseColMat<usize, f64>, j: usize) -> Result<f64, Error> {
    let diagonal = column_of(k, j).find(|(i, _)| *i == j).map_or(0.0, |(_, v)| v);
    if diagonal > 0.0 { Ok(diagonal) } else { Err(singular(&format!("K[{j}, {j}] is {diagonal}"))) }
}

/// A diagonal block of `K`, scaled from both sides, and its 1-norm.
fn equilibrated(
    k: &SparseColMat<usize, f64>,
    displacements: &[usize],
    scale: &[f64],
) -> (SparseColMat<usize, f64>, f64) {
    let (mut triplets, mut norm) = (Vec::new(), 0.0_f64);
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
        norm = norm.max(sum);
    }
    let n = displacements.len();
    let block = SparseColMat::try_new_from_triplets(n, n, &triplets);
    (block.unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}")), norm)
}

/// The displacements of every body, which are those that `K`, being symmetric, couples, in ascending order.
pub(super) fn coupled_displacements(k: &SparseColMat<usize, f64>) -> Vec<Vec<usize>> {
    let mut is_seen = vec![false; k.ncols()];
    let mut bodies = Vec::new();
    for first in 0..k.ncols() {
        if is_seen[first] {
            continue;
        }
        is_seen[first] = true;
        let (mut members, mut next) = (vec![first], 0);
        while let Some(&j) = members.get(next) {
            next += 1;
            for (i, _) in column_of(k, j).filter(|(_, v)| *v != 0.0) {
                if !is_seen[i] {
                    is_seen[i] = true;
                    members.push(i);
                }
            }
        }
        members.sort_unstable();
        bodies.push(members);
    }
    bodies
}
