//! Solutions for a given status of every contact point, in two independent ways.
//!
//! [`by_displacements`] assembles the displacement method with Lagrange multipliers: global stiffness from
//! single elements, contact rows found by searching the boundary for the contact points' places.
//! [`by_reduction`] uses equilibrium and compatibility in the contact forces.

use masonry::data::state::RowState;
use masonry::element::quad4;
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind};
use masonry::geometry;
use masonry::material::constitutive;
use masonry::model::{Model, PlacedBlock};
use masonry::system::System;
use masonry::system::rigid::Modes;
use nalgebra::{DMatrix, DVector, Point2, Vector2};

/// What a contact point is told to do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Told {
    /// No force.
    Open,
    /// No relative displacement.
    Stick,
    /// No gap, and `t_t = factor * t_n`.
    Slide(f64),
}

/// Displacements of the nodes (corners of rigid blocks) of every block.
pub type Displacements = Vec<Vec<Vector2<f64>>>;

/// Least-squares solution of smallest norm of a consistent system.
pub fn pseudo_solve(matrix: DMatrix<f64>, rhs: &DVector<f64>) -> DVector<f64> {
    let (copy, svd) = (matrix.clone(), matrix.svd(true, true));
    let least = 1e-12 * svd.singular_values.max();
    let x = svd.solve(rhs, least).unwrap();
    let residual = (copy * &x - rhs).norm();
    assert!(residual <= 1e-9 * rhs.norm(), "inconsistent: {residual:e} of {:e}", rhs.norm());
    x
}

/// The unknowns of one block in the global system.
struct Unknowns {
    first: usize,
    count: usize,
}

pub fn by_displacements(model: &Model, told: &[Told]) -> (Displacements, RowState) {
    let mut unknowns = Vec::new();
    let mut size = 0;
    for block in &model.blocks {
        let count = block.mesh.as_ref().map_or(3, |mesh| 2 * mesh.nodes.len());
        unknowns.push(Unknowns { first: size, count });
        size += count;
    }
    let rows = 2 * model.contacts.len();
    let young = model.blocks.iter().filter_map(|b| b.elasticity).map(|e| e.young);
    let force = young.fold(1.0, f64::max) * model.thickness;
    // Unknowns u and t / force; equations K u / force - C^T t / force = f / force, then two per point.
    let mut matrix = DMatrix::zeros(size + rows, size + rows);
    let mut rhs = DVector::zeros(size + rows);
    for (block, at) in model.blocks.iter().zip(&unknowns) {
        stiffness_and_loads(model, block, at.first, force, &mut matrix, &mut rhs);
    }
    for (k, contact) in model.contacts.iter().enumerate() {
        let joint = &model.joints[contact.joint.index()];
        let mut gap_rows = [vec![0.0; size], vec![0.0; size]];
        let sides = [(Some(contact.b), 1.0), (contact.a, -1.0)];
        for (block, sign) in sides.iter().filter_map(|(a, s)| a.map(|a| (a.block.index(), s))) {
            for (dof, n) in motion_at(&model.blocks[block], contact.position) {
                let at = unknowns[block].first + dof;
                gap_rows[0][at] += sign * n.dot(&joint.normal);
                gap_rows[1][at] += sign * n.dot(&joint.tangent());
            }
        }
        let (n, t) = (size + 2 * k, size + 2 * k + 1);
        for (row, at) in gap_rows.iter().zip([n, t]) {
            row.iter().enumerate().for_each(|(dof, c)| matrix[(dof, at)] -= c);
        }
        let bind = |row: usize, values: &[f64], matrix: &mut DMatrix<f64>| {
            values.iter().enumerate().for_each(|(dof, c)| matrix[(row, dof)] = *c);
        };
        match told[k] {
            Told::Open => {
                matrix[(n, n)] = 1.0;
                matrix[(t, t)] = 1.0;
            }
            Told::Stick => {
                bind(n, &gap_rows[0], &mut matrix);
                bind(t, &gap_rows[1], &mut matrix);
                rhs[n] = -contact.gap;
            }
            Told::Slide(factor) => {
                bind(n, &gap_rows[0], &mut matrix);
                rhs[n] = -contact.gap;
                matrix[(t, t)] = 1.0;
                matrix[(t, n)] = -factor;
            }
        }
    }
    let x = pseudo_solve(matrix, &rhs);
    let t = (0..rows).map(|k| force * x[size + 2 * (k % (rows / 2)) + k / (rows / 2)]).collect();
    let displacements = model
        .blocks
        .iter()
        .zip(&unknowns)
        .map(|(block, at)| unpack(block, &x.as_slice()[at.first..at.first + at.count]))
        .collect();
    (displacements, RowState { t, y: Vec::new() })
}

fn stiffness_and_loads(
    model: &Model,
    block: &PlacedBlock,
    first: usize,
    force: f64,
    matrix: &mut DMatrix<f64>,
    rhs: &mut DVector<f64>,
) {
    let mut add_force = |place: Point2<f64>, f: Vector2<f64>| {
        for (dof, n) in motion_at(block, place) {
            rhs[first + dof] += n.dot(&f) / force;
        }
    };
    // Uniform loads on whole edges.
    for load in block.edge_loads() {
        let pieces = block.mesh.as_ref().map_or(1, |m| m.edge_elements(load.edge));
        // Gauss points of every element edge: exact for the linear shape functions.
        for piece in 0..pieces {
            for s in [-0.5, 0.5].map(|s| 0.5 + s / 3.0_f64.sqrt()) {
                let at = (piece as f64 + s) / pieces as f64;
                let [p, q] = geometry::edge(&block.corners, load.edge);
                let area = 0.5 * (q - p).norm() / pieces as f64 * model.thickness;
                add_force(p + (q - p) * at, load.traction[0] * area);
            }
        }
    }
    assert!(block.density.is_none(), "the reference knows edge loads only");
    let (Some(mesh), Some(elasticity)) = (&block.mesh, block.elasticity) else { return };
    let d = constitutive(elasticity, model.plane);
    for element in &mesh.elements {
        let k = quad4::stiffness(&element.map(|n| mesh.nodes[n]), &d, model.thickness).unwrap();
        let dof = |i: usize| first + 2 * element[i / 2] + i % 2;
        for i in 0..8 {
            for j in 0..8 {
                matrix[(dof(i), dof(j))] += k[(i, j)] / force;
            }
        }
    }
}

/// The displacement at a place on the boundary in terms of the block's unknowns.
fn motion_at(block: &PlacedBlock, place: Point2<f64>) -> Vec<(usize, Vector2<f64>)> {
    let Some(mesh) = &block.mesh else {
        return Modes::of(&block.corners).at(place).into_iter().enumerate().collect();
    };
    let sides = mesh.elements.iter().flat_map(|e| (0..4).map(|k| [e[k], e[(k + 1) % 4]]));
    let detour = |[i, j]: [usize; 2]| {
        let (p, q) = (mesh.nodes[i], mesh.nodes[j]);
        ((place - p).norm() + (place - q).norm()) / (q - p).norm() - 1.0
    };
    let [i, j] = sides.min_by(|s, r| detour(*s).total_cmp(&detour(*r))).unwrap();
    let share = (place - mesh.nodes[i]).norm() / (mesh.nodes[j] - mesh.nodes[i]).norm();
    [(i, 1.0 - share), (j, share)]
        .into_iter()
        .flat_map(|(n, w)| [(2 * n, Vector2::x() * w), (2 * n + 1, Vector2::y() * w)])
        .collect()
}

fn unpack(block: &PlacedBlock, x: &[f64]) -> Vec<Vector2<f64>> {
    if block.mesh.is_some() {
        return x.chunks(2).map(|u| Vector2::new(u[0], u[1])).collect();
    }
    let modes = Modes::of(&block.corners);
    block.corners.iter().map(|p| modes.displacement(*p, x)).collect()
}

/// Solves (3.18) and (3.23) with the conditions of the points; every point must have friction, or
/// none.
pub fn by_reduction(system: &System, reduction: &Reduction, told: &[Told]) -> RowState {
    let rows = system.rows.len();
    let points = system.points();
    let DenseForm { scale, .. } = DenseForm::new(FormKind::Coulomb, system, reduction).unwrap();
    let (force, length) = (scale.force, scale.length);
    let Reduction { isostatic, others, .. } = reduction;
    let mut matrix = DMatrix::zeros(2 * rows, 2 * rows);
    let mut rhs = DVector::zeros(2 * rows);
    for (j, row) in others.iter().enumerate() {
        matrix[(*row, rows + row)] = 1.0;
        for (k, other) in others.iter().enumerate() {
            matrix[(*row, *other)] = -reduction.a[(j, k)] * force / length;
        }
        for (k, held) in isostatic.iter().enumerate() {
            matrix[(*row, rows + held)] = reduction.r[(k, j)];
        }
        rhs[*row] = reduction.c[j] / length;
    }
    for (i, row) in isostatic.iter().enumerate() {
        matrix[(*row, *row)] = 1.0;
        for (k, other) in others.iter().enumerate() {
            matrix[(*row, *other)] = -reduction.r[(i, k)];
        }
        rhs[*row] = reduction.t0[i] / force;
    }
    for row in 0..rows {
        let (point, normal) = (row % points, row < points);
        let at = rows + row;
        match told[point] {
            Told::Open => matrix[(at, row)] = 1.0,
            Told::Slide(factor) if !normal => {
                matrix[(at, row)] = 1.0;
                matrix[(at, point)] = -factor;
            }
            Told::Stick | Told::Slide(_) => matrix[(at, rows + row)] = 1.0,
        }
    }
    let x = pseudo_solve(matrix, &rhs);
    RowState {
        t: x.rows(0, rows).iter().map(|t| t * force).collect(),
        y: x.rows(rows, rows).iter().map(|y| y * length).collect(),
    }
}

/// Largest difference of displacements relative to the largest displacement.
pub fn difference(a: &Displacements, b: &Displacements) -> f64 {
    let largest = a.iter().flatten().map(Vector2::norm).fold(0.0, f64::max);
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(u, v)| (u - v).norm()).fold(0.0, f64::max) / largest
}
