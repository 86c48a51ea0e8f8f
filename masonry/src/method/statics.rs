//! Statically admissible forces: contact forces inside their friction cones that balance the loads of every
//! block, whatever the blocks are made of and wherever they are.
//!
//! With one nonnegative force `p` along each edge of each cone, and the sparse matrix `E` of the resultants of
//! these on the blocks, they are the solutions of `E p + r = 0`, `p >= 0`, with the resultants `r` of the loads. Two
//! convex programs decide whether there are any:
//!
//! * the forces of least size, `min |p|^2 / 2`: joints as springs that are sheared and opened by the same law
//!   (associated flow). It has one solution if there are any;
//! * the least that is left over, `min |v|^2 / 2` with `v = r + E p`. If there are none, `v` is not zero and proves it:
//!   `E^T v >= 0` and `r.v = |v|^2 > 0`, a motion of rigid blocks on which every contact force does work that is not
//!   negative, and the loads do work too (Farkas 1902, Moreau 1962). The [`proof`] checks it in the geometry.
//!
//! Rigid blocks without gaps stand on such forces: at rest every gap and every slip is zero. For all other walls
//! they are necessary and not sufficient.

use lcp::{
    InteriorPoint, InteriorPointSettings, Iteration, MixedLcp, Observer, QuadraticProgram,
    QuadraticProgramSettings, Solution, Solver,
};

use crate::model::Model;
use crate::system::{BodySystem, System};

pub mod proof;
mod sharpen;

pub use proof::Proof;

/// What is left of the balance of a block, relative to the largest load, in forces that are called admissible.
const BALANCED: f64 = 1e-9;
/// Residual of the programs that decide.
const TOLERANCE: f64 = 1e-12;
/// Steps of each: forces take ten to forty where there are any, proofs near the limit more.
const MAX_STEPS: [usize; 2] = [60, 150];

/// What is known of forces that balance the loads.
#[derive(Debug, Clone, PartialEq)]
pub enum Statics {
    /// These do: of all rows of the [`System`] \[N\].
    Admissible(Vec<f64>),
    /// There are none.
    Impossible(Proof),
    /// Neither came out.
    Open,
}

/// A decision and what it cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// What was found.
    pub statics: Statics,
    /// Steps of the interior points, each of which factorises one matrix of three unknowns a block.
    pub steps: usize,
}

/// Decides whether there are statically admissible forces.
///
/// # Errors
/// [`lcp::Error::NotFinite`] when the data of the scene overflow.
pub fn decide(
    (model, system): (&Model, &System),
    observer: &mut Observer<'_>,
) -> Result<Decision, lcp::Error> {
    let program = Program::of(system);
    let mut steps = 0;
    if program.unit <= 0.0 {
        let statics = Statics::Admissible(vec![0.0; system.rows.len()]);
        return Ok(Decision { statics, steps });
    }
    let mut search = Search { model, program: &program, steps: &mut steps, observer };
    let statics = search.run()?;
    Ok(Decision { statics, steps })
}

/// The programs of a decision, one after the other until one of them decides.
struct Search<'a, 'b> {
    model: &'a Model,
    program: &'a Program<'a>,
    steps: &'a mut usize,
    observer: &'a mut Observer<'b>,
}

impl Search<'_, '_> {
    fn run(&mut self) -> Result<Statics, lcp::Error> {
        let least = self.program.least_forces()?;
        let nearest = self.program.least_rest()?;
        // The first of them takes a quarter of the time, and most walls stand. What interior points leave open the
        // convex programs of another library decide.
        for by_clarabel in [false, true] {
            let solution = self.solved(&least, MAX_STEPS[0], by_clarabel)?;
            let (z, _) = least.recover(&solution.t, &solution.y);
            if let Some(forces) = self.program.admissible(&z) {
                return Ok(Statics::Admissible(forces));
            }
            // Where there are none, its multipliers grow along a proof.
            if let Some(proof) = self.proof(&z) {
                return Ok(Statics::Impossible(proof));
            }
            let solution = self.solved(&nearest, MAX_STEPS[1], by_clarabel)?;
            let (z, _) = nearest.recover(&solution.t, &solution.y);
            if let Some(proof) = self.proof(&z) {
                return Ok(Statics::Impossible(proof));
            }
            if let Some(forces) = self.program.admissible(&z) {
                return Ok(Statics::Admissible(forces));
            }
        }
        Ok(Statics::Open)
    }

    /// The proof that the motion at the beginning of `z` leads to.
    fn proof(&self, z: &[f64]) -> Option<Proof> {
        let Program { entries, .. } = self.program;
        let motion = &z[..self.program.unknowns()];
        sharpen::candidates(motion, entries, self.program.edges())
            .find_map(|motion| Proof::of(self.model, &motion))
    }

    fn solved(
        &mut self,
        program: &MixedLcp,
        max_iterations: usize,
        by_clarabel: bool,
    ) -> Result<Solution, lcp::Error> {
        let observer = &mut |at: &Iteration| (self.observer)(at);
        let solution = if by_clarabel {
            let settings = QuadraticProgramSettings {
                tolerance: TOLERANCE,
                max_iterations,
                ..Default::default()
            };
            QuadraticProgram::new(settings).solve_observed(program, observer)?
        } else {
            let settings = InteriorPointSettings {
                tolerance: TOLERANCE,
                max_iterations,
                continuation: false,
                ..Default::default()
            };
            InteriorPoint::new(settings).solve_observed(program, observer)?
        };
        *self.steps += solution.info.factorisations;
        Ok(solution)
    }
}

/// The edges of the cones and the balance of the blocks.
struct Program<'a> {
    system: &'a System,
    /// Of every contact point the first of its edges, and one past the last.
    first: Vec<usize>,
    /// `E` as rows, columns and values.
    entries: Vec<(usize, usize, f64)>,
    /// `r`, in units of the largest load.
    loads: Vec<f64>,
    /// The largest load \[N\].
    unit: f64,
}

impl<'a> Program<'a> {
    fn of(system: &'a System) -> Self {
        let points = system.points();
        let mut mu = vec![0.0; points];
        for (contact, value) in &system.friction {
            mu[contact.index()] = *value;
        }
        let mut first = vec![0];
        first.extend(mu.iter().scan(0, |edges, mu| {
            *edges += if *mu > 0.0 { 2 } else { 1 };
            Some(*edges)
        }));
        let resultants = system.resultants();
        let unit = resultants.iter().fold(0.0, |unit: f64, f| unit.max(f.abs()));
        let loads = resultants.iter().map(|f| f / if unit > 0.0 { unit } else { 1.0 }).collect();
        let mut program = Self { system, first, entries: Vec::new(), loads, unit };
        for (b, body) in system.bodies.iter().enumerate() {
            program.add(b, body);
        }
        program
    }

    fn add(&mut self, b: usize, body: &BodySystem) {
        let points = self.system.points();
        for row in &body.rows {
            // The normal force of one along both edges, the friction along each in its own direction.
            let (point, factors) = match row.row.checked_sub(points) {
                None => (row.row, self.normal_parts(row.row)),
                Some(k) => {
                    let point = self.system.friction[k].0.index();
                    let [_, friction] = self.parts(self.system.friction[k].1);
                    (point, [friction, -friction])
                }
            };
            for (edge, factor) in (self.first[point]..self.first[point + 1]).zip(factors) {
                let modes = row.modes.iter().enumerate().filter(|(_, value)| **value != 0.0);
                self.entries.extend(modes.map(|(j, value)| (3 * b + j, edge, factor * value)));
            }
        }
    }

    fn normal_parts(&self, point: usize) -> [f64; 2] {
        let friction = self.system.friction.binary_search_by_key(&point, |(id, _)| id.index());
        let mu = friction.map_or(0.0, |k| self.system.friction[k].1);
        [self.parts(mu)[0]; 2]
    }

    /// The normal and the tangential part of a force of one along an edge.
    #[allow(clippy::unused_self, reason = "reads as one of the parts of the program")]
    fn parts(&self, mu: f64) -> [f64; 2] {
        let length = mu.hypot(1.0);
        [1.0 / length, mu / length]
    }

    /// Rigid amplitudes of all blocks.
    fn unknowns(&self) -> usize {
        self.loads.len()
    }

    fn edges(&self) -> usize {
        self.first[self.first.len() - 1]
    }

    /// `E p + r = 0` and `0 <= p _|_ p + E^T x >= 0`.
    fn least_forces(&self) -> Result<MixedLcp, lcp::Error> {
        let n = self.unknowns();
        let diagonal = (0..self.edges()).map(|k| (n + k, n + k, 1.0));
        self.mixed(diagonal)
    }

    /// `v = r + E p` and `0 <= p _|_ E^T v >= 0`.
    fn least_rest(&self) -> Result<MixedLcp, lcp::Error> {
        self.mixed((0..self.unknowns()).map(|j| (j, j, 1.0)))
    }

    fn mixed(
        &self,
        diagonal: impl Iterator<Item = (usize, usize, f64)>,
    ) -> Result<MixedLcp, lcp::Error> {
        let (n, order) = (self.unknowns(), self.unknowns() + self.edges());
        let skew = self.entries.iter().flat_map(|&(i, k, v)| [(i, n + k, -v), (n + k, i, v)]);
        let triplets: Vec<_> =
            skew.chain(diagonal).map(|(i, j, v)| faer::sparse::Triplet::new(i, j, v)).collect();
        let m = faer::sparse::SparseColMat::try_new_from_triplets(order, order, &triplets)
            .unwrap_or_else(|e| unreachable!("entries lie inside the matrix: {e:?}"));
        let mut q: Vec<f64> = self.loads.iter().map(|r| -r).collect();
        q.resize(order, 0.0);
        MixedLcp::new(m, q, (0..order).map(|j| j < n).collect())
    }

    /// The forces of all rows \[N\], if those along the edges at the end of `z` balance the loads.
    fn admissible(&self, z: &[f64]) -> Option<Vec<f64>> {
        let p: Vec<f64> = z[self.unknowns()..].iter().map(|p| p.max(0.0)).collect();
        let mut rest = self.loads.clone();
        self.entries.iter().for_each(|&(i, k, v)| rest[i] += v * p[k]);
        let is_balanced = rest.iter().all(|rest| rest.abs() <= BALANCED);
        is_balanced.then(|| self.forces(&p))
    }

    fn forces(&self, p: &[f64]) -> Vec<f64> {
        let points = self.system.points();
        let mut forces = vec![0.0; self.system.rows.len()];
        for point in 0..points {
            let along: f64 = p[self.first[point]..self.first[point + 1]].iter().sum();
            forces[point] = self.unit * along * self.normal_parts(point)[0];
        }
        for (k, (contact, mu)) in self.system.friction.iter().enumerate() {
            let edge = self.first[contact.index()];
            forces[points + k] = self.unit * self.parts(*mu)[1] * (p[edge] - p[edge + 1]);
        }
        forces
    }
}
