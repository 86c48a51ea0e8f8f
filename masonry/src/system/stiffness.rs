//! Stiffness of single blocks, and a generalised inverse of it.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use nalgebra::Vector2;

use super::SystemError;
use crate::element::{constitutive, quad4};
use crate::mesh::BlockMesh;
use crate::model::{Block, Elasticity, Model};
use crate::rigid::Modes;

/// Corners, relative to the block's size, closer than this make blocks equal: rounding of the places
/// of equal bricks in a wall, and nothing that matters.
const SAME_SHAPE: f64 = 1e-12;

/// The stiffness of a block without supports, with its three zero modes.
#[derive(Debug, Clone)]
pub struct Stiffness {
    /// `K` \[N/m\], two rows per node of the mesh.
    pub matrix: Mat<f64>,
    factor: faer::linalg::solvers::Llt<f64>,
}

impl Stiffness {
    fn new(
        block: &Block,
        mesh: &BlockMesh,
        e: Elasticity,
        model: &Model,
    ) -> Result<Self, SystemError> {
        let n = 2 * mesh.nodes.len();
        let d = constitutive(e, model.plane);
        let mut matrix = Mat::zeros(n, n);
        for (k, element) in mesh.elements.iter().enumerate() {
            let nodes = element.map(|n| mesh.nodes[n]);
            let local = quad4::stiffness(&nodes, &d, model.thickness).ok_or_else(|| {
                SystemError::FoldedElement { block: block.name.clone(), element: k }
            })?;
            let dof = |i: usize| 2 * element[i / 2] + i % 2;
            for i in 0..8 {
                for j in 0..8 {
                    matrix[(dof(i), dof(j))] += 0.5 * (local[(i, j)] + local[(j, i)]);
                }
            }
        }
        // Springs of the block's own mean stiffness on the rigid motions only: the inverse of the
        // sum is a generalised inverse of K, because K and the springs act on different motions.
        let q = orthonormal_modes(block, mesh);
        let mean = (0..n).map(|i| matrix[(i, i)]).sum::<f64>() / n as f64;
        let held = &matrix + faer::Scale(mean) * &q * q.transpose();
        let factor = held.llt(Side::Lower).map_err(|_| SystemError::NotElastic {
            block: block.name.clone(),
            young: e.young,
            poisson: e.poisson,
        })?;
        Ok(Self { matrix, factor })
    }

    /// A generalised inverse of `K` \[m/N\] applied to columns of nodal forces \[N\].
    pub fn solve(&self, rhs: &Mat<f64>) -> Mat<f64> {
        self.factor.solve(rhs)
    }
}

/// The rigid motions of the nodes as orthonormal columns.
fn orthonormal_modes(block: &Block, mesh: &BlockMesh) -> Mat<f64> {
    let modes = Modes::of(&block.corners);
    let motions: Vec<[Vector2<f64>; 3]> = mesh.nodes.iter().map(|p| modes.at(*p)).collect();
    let raw = Mat::from_fn(2 * mesh.nodes.len(), 3, |i, k| motions[i / 2][k][i % 2]);
    raw.qr().compute_thin_Q()
}

/// Stiffnesses by shape, mesh and material.
#[derive(Default)]
pub(super) struct Shared {
    list: Vec<Stiffness>,
    keys: Vec<Key>,
}

struct Key {
    sides: [Vector2<f64>; 3],
    divisions: [usize; 2],
    elasticity: Elasticity,
}

impl Shared {
    /// The stiffness of a block that has a mesh and elastic constants; built when it is new.
    pub(super) fn index_of(
        &mut self,
        model: &Model,
        block: &Block,
        mesh: &BlockMesh,
        elasticity: Elasticity,
    ) -> Result<usize, SystemError> {
        let [origin, p, q, r] = block.corners;
        let sides = [p - origin, q - origin, r - origin];
        let key = Key { sides, divisions: [mesh.nx, mesh.ny], elasticity };
        if let Some(known) = self.keys.iter().position(|known| known.same(&key)) {
            return Ok(known);
        }
        self.list.push(Stiffness::new(block, mesh, elasticity, model)?);
        self.keys.push(key);
        Ok(self.list.len() - 1)
    }

    pub(super) fn into_list(self) -> Vec<Stiffness> {
        self.list
    }
}

impl Key {
    fn same(&self, other: &Self) -> bool {
        let near = SAME_SHAPE * self.sides[1].norm();
        let shape = self.sides.iter().zip(&other.sides).all(|(a, b)| (a - b).norm() <= near);
        shape && self.divisions == other.divisions && self.elasticity == other.elasticity
    }
}
