//! The optimisation program of admissible forces.

use faer::sparse::{SparseColMat, SparseColMatRef};
use lcp::{InteriorPoint, InteriorPointSettings, LeastForces, Observer};

use super::engine::{MAX_STEPS, TOLERANCE};
use crate::columns::{ColumnMatrix, column, first_columns};
use crate::law::{Cone, Edge};
use crate::rounding;
use crate::system::System;

mod linear;

/// Largest residual of the balance of a block at which forces count as admissible, relative to the largest load.
const BALANCED: f64 = 1e-9;

/// The program of admissible forces: the forces that contacts can carry, and the balance of the blocks.
pub(super) struct Program<'a> {
    system: &'a System,
    /// The friction cone of every contact point.
    cones: Vec<Cone>,
    /// The index of the first edge of every contact point, and the number of all edges.
    first: Vec<usize>,
    /// The frictional points with a constant part of friction, by their index in the system, and `C_0` of each in units
    /// of the largest load.
    constant: Vec<(usize, f64)>,
    /// The matrix `E`. Its first columns are the forces along edges, followed by `q' = C_0 + q` and `q'' = C_0 - q` for
    /// every force `q` of constant friction; rows with `q' + q'' = 2 C_0` follow those of the balance of the blocks. If
    /// loads grow, the last column is their growth for a load factor of one.
    e: SparseColMat<usize, f64>,
    /// The resultants `r` of the loads, in units of the largest load, including `-C_0` along joints that have constant
    /// friction.
    loads: Vec<f64>,
    /// The largest load \[N\], which is the unit of force of the program.
    unit: f64,
}

impl<'a> Program<'a> {
    /// Sets up the program; `growth` is `N^T f` of all blocks \[N\] by the growing loads for a load factor of one, if
    /// loads grow.
    pub(super) fn new(system: &'a System, growth: Option<&[f64]>) -> Self {
        let mut cones = vec![Cone::default(); system.points()];
        for friction in &system.friction {
            cones[friction.contact.index()] = friction.cone;
        }
        let mut first = vec![0];
        first.extend(cones.iter().scan(0, |sum, cone| {
            *sum += cone.edges().count();
            Some(*sum)
        }));
        let resultants = system.resultants();
        let largest = rounding::largest(resultants.iter().chain(growth.into_iter().flatten()));
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let mut loads: Vec<f64> = resultants.iter().map(|f| f / unit).collect();
        let caps = system.friction.iter().enumerate();
        let caps = caps.filter_map(|(k, it)| Some((k, it.cone.cap()? / unit)));
        let constant: Vec<(usize, f64)> = caps.collect();
        let sides = sides(system);
        for (k, base) in &constant {
            for (b, modes) in &sides[system.points() + k] {
                (0..3).for_each(|j| loads[3 * b + j] -= base * modes[j]);
            }
        }
        loads.extend(constant.iter().map(|(_, base)| -2.0 * base));
        let mut columns = edges(system, &cones, &constant, &sides);
        if let Some(growth) = growth {
            columns.push(growth.iter().map(|g| g / unit).enumerate());
        }
        let e = columns.assembled(loads.len());
        Self { system, cones, first, constant, e, loads, unit }
    }

    /// Returns the program with some blocks held by forces of any size: the balance of the held blocks is left out.
    pub(super) fn holding(mut self, held: &[bool]) -> Self {
        let is_left = |row: usize| held.get(row / 3).is_none_or(|held| !held);
        let mut columns = ColumnMatrix::default();
        for k in 0..self.e.ncols() {
            columns.push(column(self.e.as_ref(), k).filter(|(row, _)| is_left(*row)));
        }
        self.e = columns.assembled(self.loads.len());
        let mut loads = self.loads.iter_mut().enumerate();
        loads.by_ref().filter(|(row, _)| !is_left(*row)).for_each(|(_, load)| *load = 0.0);
        self
    }

    /// Whether no load acts on any block.
    pub(super) fn is_unloaded(&self) -> bool {
        self.loads[..self.balances()].iter().all(|load| load.abs() <= 0.0)
    }

    /// Returns the largest load \[N\], which is the unit of force of the program.
    pub(super) fn unit(&self) -> f64 {
        self.unit
    }

    /// Returns the number of multipliers: the rigid amplitudes of all blocks, and one for every bound of constant
    /// friction.
    pub(super) fn unknowns(&self) -> usize {
        self.loads.len()
    }

    /// Returns the number of rigid amplitudes of all blocks.
    fn balances(&self) -> usize {
        3 * self.system.bodies.len()
    }

    /// Returns the number of columns of `E` for the forces along the edges of the friction cones.
    pub(super) fn edges(&self) -> usize {
        self.first[self.first.len() - 1]
    }

    /// Returns the number of columns of `E` for forces: along the edges, and in pairs for constant friction.
    pub(super) fn forces(&self) -> usize {
        self.edges() + 2 * self.constant.len()
    }

    /// Returns the columns of the matrix `E` that belong to forces: all but the last one, if there is one for growing
    /// loads.
    pub(super) fn columns(&self) -> SparseColMatRef<'_, usize, f64> {
        first_columns(&self.e, self.forces())
    }

    /// Solves `min |p|^2 / 2` subject to `E p + r = 0`, `p >= 0`, or finds a proof that there are no such forces.
    pub(super) fn least_forces(
        &self,
        observer: &mut Observer<'_>,
    ) -> Result<LeastForces, lcp::Error> {
        let settings = InteriorPointSettings {
            tolerance: TOLERANCE,
            max_iterations: MAX_STEPS,
            ..Default::default()
        };
        InteriorPoint::new(settings).least_forces(&self.e, &self.loads, observer)
    }

    /// Returns the forces of all rows \[N\] if the forces `p` of the columns of `E` balance the loads; otherwise
    /// `None`.
    pub(super) fn admissible(&self, p: &[f64]) -> Option<Vec<f64>> {
        let p: Vec<f64> = p.iter().map(|p| p.max(0.0)).collect();
        let mut rest = self.loads.clone();
        for (k, p) in p.iter().enumerate() {
            column(self.e.as_ref(), k).for_each(|(i, v)| rest[i] += v * p);
        }
        let is_balanced = rest.iter().all(|rest| rest.abs() <= BALANCED);
        is_balanced.then(|| self.of_rows(&p))
    }

    /// Converts the forces `p` of the columns of `E` to the forces of all rows \[N\].
    fn of_rows(&self, p: &[f64]) -> Vec<f64> {
        let points = self.system.points();
        let mut forces = vec![0.0; self.system.rows.len()];
        let of_point = |point: usize| {
            self.cones[point].force(&p[self.first[point]..self.first[point + 1]], self.unit)
        };
        for (point, force) in forces[..points].iter_mut().enumerate() {
            [*force, _] = of_point(point);
        }
        for (friction, force) in self.system.friction.iter().zip(&mut forces[points..]) {
            [_, *force] = of_point(friction.contact.index());
        }
        let pairs = p[self.edges()..self.forces()].chunks_exact(2);
        for ((k, base), q) in self.constant.iter().zip(pairs) {
            forces[points + k] += self.unit * (q[0] - base).clamp(-base, *base);
        }
        forces
    }
}

/// The blocks on which each row acts, in increasing order, with the work of a unit force of the row in their rigid
/// motions.
type Sides<'a> = Vec<Vec<(usize, &'a [f64; 3])>>;

fn sides(system: &System) -> Sides<'_> {
    let mut sides = vec![Vec::new(); system.rows.len()];
    for (b, body) in system.bodies.iter().enumerate() {
        body.rows.iter().for_each(|row| sides[row.row].push((b, &row.modes)));
    }
    sides
}

/// Assembles the columns of `E` for forces: along the edges, and in pairs for constant friction.
fn edges(
    system: &System,
    cones: &[Cone],
    constant: &[(usize, f64)],
    sides: &Sides<'_>,
) -> ColumnMatrix {
    let mut columns = ColumnMatrix::default();
    let points = system.points();
    let on_blocks = |(b, modes): (usize, [f64; 3])| {
        modes.into_iter().enumerate().map(move |(j, value)| (3 * b + j, value))
    };
    let mut friction = system.friction.iter().enumerate().peekable();
    for (point, cone) in cones.iter().enumerate() {
        let tangent = friction.next_if(|(_, it)| it.contact.index() == point);
        let normal = &sides[point];
        // A point that does not resist sliding has only one edge, along its normal.
        let tangent = tangent.map_or(normal, |(k, _)| &sides[points + k]);
        for Edge { normal: n, tangential: t } in cone.edges() {
            let both = normal.iter().zip(tangent);
            let edge = both.map(|((b, normal), (_, tangent))| {
                (*b, [0, 1, 2].map(|j| n * normal[j] + t * tangent[j]))
            });
            columns.push(edge.flat_map(on_blocks));
        }
    }
    for (place, (k, _)) in constant.iter().enumerate() {
        let bound = (3 * system.bodies.len() + place, 1.0);
        let along = sides[points + k].iter().map(|(b, tangent)| (*b, **tangent));
        columns.push(along.flat_map(on_blocks).chain([bound]));
        columns.push([bound]);
    }
    columns
}
