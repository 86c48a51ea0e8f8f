//! Membranes over obstacles, on grids that can be refined.

use std::f64::consts::PI;

use crate::sparse;
use lcp::{Basis, Error, Lcp, Side, WarmStart};

/// The ground under the membrane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Ground {
    /// Flat ground, onto which a uniform load presses the membrane. The frame is held such that the contact region is
    /// a disc of this radius, between 0 and 1, and the gap is known: `r^2 - a^2 - 2 a^2 ln(r / a)` at the distance
    /// `r > a` from the middle.
    Disc {
        /// Radius `a` of the contact region.
        radius: f64,
    },
    /// Hills below a level frame, this number in each direction; the load presses the membrane onto some parts of
    /// them.
    Hills {
        /// Number in each direction.
        count: u32,
    },
}

/// A membrane over an obstacle: on the square between -1 and 1, by five-point differences at
/// `columns` by `rows` points inside of the frame, numbered row by row.
///
/// `z` is the gap between membrane and ground, `w` the force between them in a cell of the grid, in units
/// of the tension. `M` is an M-matrix, symmetric and positive definite: there is exactly one solution.
///
/// ```
/// use lcp_problems::families::{Ground, Obstacle};
/// use lcp::{SemismoothNewton, SemismoothNewtonSettings, Solver};
///
/// let coarse = Obstacle::new(20, 20, Ground::Disc { radius: 0.5 });
/// let solution = SemismoothNewton::default().solve(&coarse.problem())?;
/// let fine = Obstacle::new(40, 40, Ground::Disc { radius: 0.5 });
/// let start = fine.refined_start(&coarse, &solution.t)?;
/// let settings = SemismoothNewtonSettings { start, ..Default::default() };
/// let solution = SemismoothNewton::new(settings).solve(&fine.problem())?;
/// assert!(solution.is_solved());
/// assert!(solution.info.iterations < 5);
/// # Ok::<(), lcp::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Obstacle {
    columns: usize,
    rows: usize,
    ground: Ground,
}

impl Obstacle {
    /// A membrane with these numbers of points, at least one in either direction.
    pub fn new(columns: usize, rows: usize, ground: Ground) -> Self {
        Self { columns: columns.max(1), rows: rows.max(1), ground }
    }

    /// Points inside of the frame in the first direction.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Points inside of the frame in the second direction.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of pairs.
    pub fn order(&self) -> usize {
        self.columns * self.rows
    }

    /// Place of a point, between -1 and 1.
    pub fn place(&self, point: usize) -> (f64, f64) {
        self.grid_place(1 + point % self.columns, 1 + point / self.columns)
    }

    /// The complementarity problem.
    pub fn problem(&self) -> Lcp {
        let (hx, hy) = self.steps();
        let (across, along) = (hy / hx, hx / hy);
        let neighbours = |point: usize| {
            let (i, j) = (1 + point % self.columns, 1 + point / self.columns);
            [(i - 1, j, across), (i + 1, j, across), (i, j - 1, along), (i, j + 1, along)]
        };
        let mut q = Vec::with_capacity(self.order());
        for point in 0..self.order() {
            let (x, y) = self.place(point);
            let level = self.ground(x, y);
            let mut sum = self.load() * hx * hy;
            for (i, j, stiffness) in neighbours(point) {
                let (x, y) = self.grid_place(i, j);
                // The gap is given outside of the grid.
                let gap = if self.is_inside(i, j) { 0.0 } else { self.frame(x, y) };
                sum += stiffness * (level - self.ground(x, y) - gap);
            }
            q.push(sum);
        }
        let entries = (0..self.order()).flat_map(|point| {
            let coupled = neighbours(point).into_iter().filter(|(i, j, _)| self.is_inside(*i, *j));
            let coupled = coupled.map(move |(i, j, v)| (self.number(i, j), point, -v));
            coupled.chain([(point, point, 2.0 * (across + along))])
        });
        let m = sparse(self.order(), self.order(), entries);
        super::standard(m, q)
    }

    /// The gap of the membrane itself at every point, known for [`Ground::Disc`]; the gap of the grid differs from it
    /// by `O(h^2)`, up to a logarithm.
    pub fn exact_gap(&self) -> Option<Vec<f64>> {
        let Ground::Disc { .. } = self.ground else { return None };
        let places = (0..self.order()).map(|point| self.place(point));
        Some(places.map(|(x, y)| self.frame(x, y)).collect())
    }

    /// A start from the solution on a coarser grid, of about half as many points in both directions: the basis of the
    /// points that are in contact, or not, by that solution.
    ///
    /// The gap at a distance `d` from the contact region is `load d^2 / 2`, so that the gap at a point of the coarse
    /// grid gives its distance from the contact region: all points within that distance are not in contact.
    ///
    /// # Errors
    /// [`Error::Length`] if the length of `z` is not that of the coarse grid, [`Error::NotFinite`] for a NaN or an
    /// infinity.
    pub fn refined_start(&self, coarse: &Self, z: &[f64]) -> Result<WarmStart, Error> {
        if z.len() != coarse.order() {
            return Err(Error::Length { name: "z", len: z.len(), expected: coarse.order() });
        }
        if let Some(row) = z.iter().position(|gap| !gap.is_finite()) {
            return Err(Error::NotFinite { what: "z", row, col: 0, value: z[row] });
        }
        // The cell of the coarse grid in which a point lies.
        let cell = |i: usize, fine: usize, coarse: usize| i * (coarse + 1) / (fine + 1);
        let side = |point: usize| {
            let i = cell(1 + point % self.columns, self.columns, coarse.columns);
            let j = cell(1 + point / self.columns, self.rows, coarse.rows);
            let is_apart = coarse.is_apart(z, [i, j], self.place(point).into());
            if is_apart { Side::T } else { Side::Y }
        };
        Ok(WarmStart::Basis(Basis::new((0..self.order()).map(side).collect())))
    }

    /// Whether a point of the plane, in this cell, is not in contact, judged by the gaps around it.
    fn is_apart(&self, z: &[f64], [i, j]: [usize; 2], [x, y]: [f64; 2]) -> bool {
        let corners = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)];
        corners.into_iter().any(|(i, j)| {
            let corner = self.grid_place(i, j);
            let is_inside = self.is_inside(i, j);
            let gap = if is_inside { z[self.number(i, j)] } else { self.frame(corner.0, corner.1) };
            let distance_squared = (x - corner.0).powi(2) + (y - corner.1).powi(2);
            gap > 0.5 * self.pressure(corner.0, corner.1) * distance_squared
        })
    }

    fn steps(&self) -> (f64, f64) {
        (2.0 / (self.columns as f64 + 1.0), 2.0 / (self.rows as f64 + 1.0))
    }

    /// Place of a point, counted from the frame, which has the number zero.
    fn grid_place(&self, i: usize, j: usize) -> (f64, f64) {
        let (hx, hy) = self.steps();
        (i as f64 * hx - 1.0, j as f64 * hy - 1.0)
    }

    fn is_inside(&self, i: usize, j: usize) -> bool {
        (1..=self.columns).contains(&i) && (1..=self.rows).contains(&j)
    }

    fn number(&self, i: usize, j: usize) -> usize {
        (j - 1) * self.columns + i - 1
    }

    /// The load on the membrane, divided by its tension.
    fn load(&self) -> f64 {
        match self.ground {
            Ground::Disc { .. } => 4.0,
            Ground::Hills { .. } => 8.0,
        }
    }

    fn ground(&self, x: f64, y: f64) -> f64 {
        match self.ground {
            Ground::Disc { .. } => 0.0,
            Ground::Hills { count } => {
                let wave = |x: f64| (0.5 * PI * f64::from(count) * (x + 1.0)).sin().powi(2);
                HILL * wave(x) * wave(y) - DEPTH
            }
        }
    }

    /// The pressure of the membrane on the ground in the contact region: the load, and the tension over the curvature
    /// of the ground.
    fn pressure(&self, x: f64, y: f64) -> f64 {
        match self.ground {
            Ground::Disc { .. } => self.load(),
            Ground::Hills { count } => {
                let k = PI * f64::from(count);
                let wave = |x: f64| (0.5 * k * (x + 1.0)).sin().powi(2);
                let curvature = |x: f64| 0.5 * k * k * (k * (x + 1.0)).cos();
                let laplacian = curvature(x) * wave(y) + wave(x) * curvature(y);
                self.load() - HILL * laplacian
            }
        }
    }

    /// The gap at a point of the frame; for discs also at every other point.
    fn frame(&self, x: f64, y: f64) -> f64 {
        match self.ground {
            Ground::Disc { radius } => {
                let ratio = x.hypot(y) / radius;
                let beyond = |ratio: f64| ratio * ratio - 1.0 - 2.0 * ratio.ln();
                if ratio > 1.0 { radius * radius * beyond(ratio) } else { 0.0 }
            }
            Ground::Hills { .. } => -self.ground(x, y),
        }
    }
}

/// Depth of the ground below the frame, and height of the hills on it.
const DEPTH: f64 = 0.5;
const HILL: f64 = 0.2;
