//! The largest tilt for which any forces inside friction balance the loads, by a linear program.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT,
};
use masonry::model::{Anchor, Model, PlacedBlock};
use nalgebra::{Point2, Vector2};

use super::walls::GRAVITY;

/// What the program says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Limit {
    /// Not even upright.
    None,
    /// Up to this horizontal acceleration, in units of gravity.
    Tilt(f64),
    /// At all.
    Unlimited,
}

/// Tilts beyond this count as any.
const ANY: f64 = 10.0;

/// `max a` subject to the balance of every block under its weight, its loads, and `a` times its weight to the side; with the
/// normal force and the two distances to the edges of the friction cone as variables, which are nonnegative.
pub(crate) fn largest_tilt(model: &Model) -> Limit {
    let points = model.contacts.len();
    let blocks = model.blocks.len();
    // Variables: a, then t_n and t_t of every point.
    let (columns, equations) = (1 + 2 * points, 3 * blocks);
    let unit: f64 = model.blocks.iter().map(|block| mass(model, block) * GRAVITY).sum();
    let mut rows = vec![vec![0.0; columns]; equations + 3 * points + 1];
    let mut rhs = vec![0.0; rows.len()];
    let mut add = |block: usize, column: Option<usize>, place: Point2<f64>, force: Vector2<f64>| {
        let moment = place.x * force.y - place.y * force.x;
        for (k, part) in [force.x, force.y, moment].into_iter().enumerate() {
            match column {
                Some(column) => rows[3 * block + k][column] += part,
                None => rhs[3 * block + k] -= part / unit,
            }
        }
    };
    for (b, block) in model.blocks.iter().enumerate() {
        let weight = mass(model, block) * GRAVITY;
        add(b, None, centroid(block), Vector2::new(0.0, -weight));
        add(b, Some(0), centroid(block), Vector2::new(weight / unit, 0.0));
        for load in block.edge_loads() {
            let [start, end] = [load.from, load.to].map(|at| on_edge(block, load.edge, at));
            let force = load.traction[0] * ((end - start).norm() * model.thickness);
            add(b, None, nalgebra::center(&start, &end), force);
        }
    }
    for (c, contact) in model.contacts.iter().enumerate() {
        let normal = model.joints[contact.joint.index()].normal;
        for (column, direction) in
            [(1 + 2 * c, normal), (2 + 2 * c, Vector2::new(normal.y, -normal.x))]
        {
            for (anchor, force) in [(Some(contact.b), direction), (contact.a, -direction)] {
                let Some(Anchor { block, edge, at }) = anchor else { continue };
                let place = on_edge(&model.blocks[block.index()], edge, at);
                add(block.index(), Some(column), place, force);
            }
        }
    }
    for (c, contact) in model.contacts.iter().enumerate() {
        let first = equations + 3 * c;
        rows[first][1 + 2 * c] = -1.0;
        for (row, sign) in [(first + 1, 1.0), (first + 2, -1.0)] {
            rows[row][1 + 2 * c] = -contact.law.mu;
            rows[row][2 + 2 * c] = sign;
        }
    }
    let last = rows.len() - 1;
    (rows[last][0], rhs[last]) = (1.0, ANY);
    let mut cost = vec![0.0; columns];
    cost[0] = -1.0;
    let a = CscMatrix::from(&rows);
    let p = CscMatrix::zeros((columns, columns));
    let cones = [ZeroConeT(equations), NonnegativeConeT(3 * points + 1)];
    let settings = DefaultSettings {
        verbose: false,
        tol_gap_abs: 1e-9,
        tol_gap_rel: 1e-9,
        tol_feas: 1e-9,
        ..DefaultSettings::default()
    };
    let mut solver = DefaultSolver::new(&p, &cost, &a, &rhs, &cones, settings).unwrap();
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {
            let tilt = solver.solution.x[0];
            // Upright is a tilt of zero.
            match tilt {
                tilt if tilt < -1e-6 => Limit::None,
                tilt if tilt > ANY - 1e-3 => Limit::Unlimited,
                tilt => Limit::Tilt(tilt),
            }
        }
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => Limit::None,
        status => panic!("the linear program ends with {status:?}"),
    }
}

fn mass(model: &Model, block: &PlacedBlock) -> f64 {
    let area: f64 = triangles(block).map(|(area, _)| area).sum();
    block.density.unwrap_or(0.0) * model.thickness * area
}

/// The mean of the centroids of triangles, by their areas.
fn centroid(block: &PlacedBlock) -> Point2<f64> {
    let (mut moment, mut whole) = (Vector2::zeros(), 0.0);
    for (area, centroid) in triangles(block) {
        moment += (centroid - block.corners[0]) * area;
        whole += area;
    }
    block.corners[0] + moment / whole
}

/// Areas and centroids of the triangles into which the diagonals from the first corner cut a block.
fn triangles(block: &PlacedBlock) -> impl Iterator<Item = (f64, Point2<f64>)> {
    let p = block.corners[0];
    block.corners[1..].windows(2).map(move |pair| {
        let (a, b) = (pair[0] - p, pair[1] - p);
        (0.5 * (a.x * b.y - a.y * b.x), p + (a + b) / 3.0)
    })
}

fn on_edge(block: &PlacedBlock, edge: usize, at: f64) -> Point2<f64> {
    let (from, to) = (block.corners[edge], block.corners[(edge + 1) % block.corners.len()]);
    from + (to - from) * at
}
