//! Stiffness matrices of single blocks, and generalised inverses of these matrices.

use faer::linalg::solvers::{Llt, Solve};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use nalgebra::{SMatrix, Vector2};

use super::error::SystemError;
use crate::element::quad4;
use crate::material::constitutive;
use crate::model::mesh::BlockMesh;
use crate::model::{Elasticity, Model, PlacedBlock};
use crate::rounding::cleared;
use crate::system::rigid::Modes;

/// Tolerance \[-\] of equal shapes: blocks are equal if their corners, relative to the size of the block, differ by
/// less. Theory: the rounding of the places of equal bricks in a wall.
const SAME_SHAPE: f64 = 1e-12;

/// The stiffness matrix of a block without supports, with its three zero modes.
#[derive(Debug, Clone)]
pub struct Stiffness {
    /// `K` \[N/m\], two rows per node of the mesh.
    pub matrix: SparseColMat<usize, f64>,
    /// Dense factor of `K` with its rigid motions held by springs; `None` unless a system is to be reduced.
    factor: Option<Llt<f64>>,
}

/// The parts of a stiffness that are built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Built {
    /// The sparse matrix.
    Matrix,
    /// The sparse matrix and its dense factor.
    MatrixAndFactor,
}

impl Stiffness {
    fn new(
        block: &PlacedBlock,
        mesh: &BlockMesh,
        e: Elasticity,
        model: &Model,
        parts: Built,
    ) -> Result<Self, SystemError> {
        let n = 2 * mesh.nodes.len();
        let elements = element_stiffnesses(block, mesh, e, model)?;
        let entries: Vec<_> = elements.iter().flat_map(Element::entries).collect();
        let matrix = assembled(n, &entries);
        let size = |i: usize| matrix.get(i, i).copied().unwrap_or(0.0).sqrt();
        let sizes: Vec<f64> = (0..n).map(size).collect();
        let couplings = matrix.triplet_iter().map(|entry| {
            let (i, j) = (entry.row, entry.col);
            Triplet::new(i, j, cleared(*entry.val, sizes[i] * sizes[j]))
        });
        let couplings: Vec<_> = couplings.filter(|entry| entry.val != 0.0).collect();
        let matrix = assembled(n, &couplings);
        let factor = match parts {
            Built::Matrix => None,
            Built::MatrixAndFactor => Some(factor(block, mesh, e, &couplings)?),
        };
        Ok(Self { matrix, factor })
    }

    /// Applies a generalised inverse of `K` \[m/N\] to columns of nodal forces \[N\].
    ///
    /// # Panics
    /// If the system was built [without factors](super::System::without_factors).
    pub fn solve(&self, rhs: &Mat<f64>) -> Mat<f64> {
        let factor = self.factor.as_ref();
        factor.expect("only a system with factors can be reduced").solve(rhs)
    }

    /// Returns the strain energy `u.K u / 2` \[J\] of displacements `u` \[m\].
    pub fn energy(&self, u: &[f64]) -> f64 {
        let entries = self.matrix.triplet_iter();
        entries.map(|entry| 0.5 * u[entry.row] * entry.val * u[entry.col]).sum()
    }
}

fn assembled(n: usize, entries: &[Triplet<usize, usize, f64>]) -> SparseColMat<usize, f64> {
    SparseColMat::try_new_from_triplets(n, n, entries)
        .unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"))
}

/// The stiffness matrix of one element and its nodes.
struct Element {
    nodes: [usize; 4],
    matrix: SMatrix<f64, 8, 8>,
}

impl Element {
    fn entries(&self) -> impl Iterator<Item = Triplet<usize, usize, f64>> + '_ {
        let dof = |i: usize| 2 * self.nodes[i / 2] + i % 2;
        let symmetric = |i, j| 0.5 * (self.matrix[(i, j)] + self.matrix[(j, i)]);
        (0..8).flat_map(move |i| (0..8).map(move |j| Triplet::new(dof(i), dof(j), symmetric(i, j))))
    }
}

fn element_stiffnesses(
    block: &PlacedBlock,
    mesh: &BlockMesh,
    e: Elasticity,
    model: &Model,
) -> Result<Vec<Element>, SystemError> {
    let d = constitutive(e, model.plane);
    let of_element = |(k, element): (usize, &[usize; 4])| {
        let nodes = element.map(|n| mesh.nodes[n]);
        let matrix = quad4::stiffness(&nodes, &d, model.thickness)
            .ok_or_else(|| SystemError::FoldedElement { block: block.name.clone(), element: k })?;
        Ok(Element { nodes: *element, matrix })
    };
    mesh.elements.iter().enumerate().map(of_element).collect()
}

/// Factorises `K` plus springs on the rigid motions only, whose stiffness is the block's own mean stiffness. The
/// inverse of the sum is a generalised inverse of `K`, because `K` and the springs act on different motions.
fn factor(
    block: &PlacedBlock,
    mesh: &BlockMesh,
    e: Elasticity,
    entries: &[Triplet<usize, usize, f64>],
) -> Result<Llt<f64>, SystemError> {
    let n = 2 * mesh.nodes.len();
    let mut matrix: Mat<f64> = Mat::zeros(n, n);
    for entry in entries {
        matrix[(entry.row, entry.col)] += entry.val;
    }
    let q = orthonormal_modes(block, mesh);
    let mean = (0..n).map(|i| matrix[(i, i)]).sum::<f64>() / n as f64;
    let held = &matrix + faer::Scale(mean) * &q * q.transpose();
    held.llt(Side::Lower).map_err(|_| SystemError::NotElastic {
        block: block.name.clone(),
        young: e.young,
        poisson: e.poisson,
    })
}

/// Returns the rigid motions of the nodes as orthonormal columns.
fn orthonormal_modes(block: &PlacedBlock, mesh: &BlockMesh) -> Mat<f64> {
    let modes = Modes::of(&block.corners);
    let motions: Vec<[Vector2<f64>; 3]> = mesh.nodes.iter().map(|p| modes.at(*p)).collect();
    let raw = Mat::from_fn(2 * mesh.nodes.len(), 3, |i, k| motions[i / 2][k][i % 2]);
    raw.qr().compute_thin_Q()
}

/// The stiffnesses that were built so far, by shape, mesh and material.
pub(super) struct Shared {
    parts: Built,
    list: Vec<Stiffness>,
    keys: Vec<Key>,
}

struct Key {
    /// Vectors from the first corner of the block to the others.
    sides: Vec<Vector2<f64>>,
    divisions: [usize; 2],
    elasticity: Elasticity,
}

impl Shared {
    pub(super) fn new(parts: Built) -> Self {
        Self { parts, list: Vec::new(), keys: Vec::new() }
    }

    /// Returns the index of the stiffness of a block with a mesh and elastic constants; the stiffness is built if no
    /// equal block has one.
    pub(super) fn index_of(
        &mut self,
        model: &Model,
        block: &PlacedBlock,
        mesh: &BlockMesh,
        elasticity: Elasticity,
    ) -> Result<usize, SystemError> {
        let sides = block.corners[1..].iter().map(|corner| corner - block.corners[0]).collect();
        let key = Key { sides, divisions: mesh.divisions(), elasticity };
        if let Some(known) = self.keys.iter().position(|known| known.same(&key)) {
            return Ok(known);
        }
        self.list.push(Stiffness::new(block, mesh, elasticity, model, self.parts)?);
        self.keys.push(key);
        Ok(self.list.len() - 1)
    }

    pub(super) fn into_list(self) -> Vec<Stiffness> {
        self.list
    }
}

impl Key {
    fn same(&self, other: &Self) -> bool {
        if self.sides.len() != other.sides.len() {
            return false;
        }
        let near = SAME_SHAPE * self.sides[1].norm();
        let shape = self.sides.iter().zip(&other.sides).all(|(a, b)| (a - b).norm() <= near);
        shape && self.divisions == other.divisions && self.elasticity == other.elasticity
    }
}
