//! The slow loading of blocks, which ends at rest or in a fall. Solves, histories and limit loads all use this loading.

use std::ops::ControlFlow;

use lcp::{
    Contact2d, ContactState, Ending, Evolution, EvolutionSettings, InteriorPoint,
    InteriorPointSettings, Iteration, WarmStart,
};

use crate::geometry;
use crate::model::Model;
use crate::rounding;

/// The part of the loads that the drag may carry while blocks move: the smaller it is, the more slowly blocks move.
/// Measured on settlements of 100 to 1000 bricks: the drag takes about a hundredth of the work of friction.
pub(crate) const SLOWNESS: f64 = 1e-2;
/// Drag of blocks that start unloaded, relative to the stiffness of the blocks and of their joints. Without stiffness,
/// the drag is such that blocks move by this part of their reach. Chosen: drag decreases by itself.
const FIRST_DRAG: f64 = 1e-2;
/// Part of the median size of blocks that bounds displacements, together with twice the movement of supports: larger
/// displacements invalidate the contacts of the scene. Theory: a brick in running bond has then lost half of its bed.
const REACH: f64 = 0.25;
/// Largest number of steps of the interior-point method before blocks move. Measured on walls of 1000 bricks: up to 60
/// steps if its first start gives a solution.
const STEPS_BEFORE_MOTION: usize = 60;
/// Largest tolerance of the steps of a motion. Forces are compared with the largest of all forces in a step, but with
/// those on each block, to 1e-9, at the end. Measured on walls of 100 to 1000 bricks: the forces on a block are up to
/// some hundred times smaller than the largest. Finer steps cost 5 % more, so that they are taken only if blocks need
/// them.
pub(crate) const STEP_TOLERANCE: f64 = 1e-11;
/// Largest number of factorisations in one loading. Measured on walls of 1000 bricks: slow falls take up to 14 351,
/// settlements in a single step up to 15 917.
const FACTORISATIONS: usize = 20_000;

/// A slow loading of blocks, from one state to the next.
#[derive(Clone, Copy)]
pub(crate) struct Loading<'a> {
    /// The problem before the loading, with its loads, gaps and supports, and the state in which the blocks rest under
    /// them. `None` if nothing has acted yet.
    pub(crate) before: Option<(&'a Contact2d, &'a ContactState)>,
    /// The problem with the loads, gaps and supports at the end of the loading; slips are measured from the state
    /// before.
    pub(crate) problem: &'a Contact2d,
    /// The mass of every displacement \[kg\].
    pub(crate) mass: &'a [f64],
    /// The largest distance that blocks may move from their places in the scene \[m\].
    pub(crate) reach: f64,
    /// The part of the loads that the drag may carry while blocks move.
    pub(crate) slowness: f64,
    pub(crate) tolerance: f64,
}

/// The result of a loading.
pub(crate) struct Led {
    pub(crate) ending: Ending,
    /// The state and velocities of the blocks after the last step.
    pub(crate) evolution: Evolution,
    /// Number of iterations in all steps.
    pub(crate) iterations: usize,
}

/// Returns the method that is tried before blocks move, if nothing has acted on them yet: the contact states `start`,
/// then the path of the interior-point method from its first start, in at most `max_steps` steps.
pub(crate) fn path(tolerance: f64, max_steps: Option<usize>, start: &WarmStart) -> InteriorPoint {
    let start = start.clone();
    let mut settings =
        InteriorPointSettings { tolerance, prove_infeasible: false, start, ..Default::default() };
    settings.max_iterations =
        max_steps.map_or(STEPS_BEFORE_MOTION, |most| most.min(STEPS_BEFORE_MOTION));
    settings.openings.truncate(1);
    InteriorPoint::new(settings)
}

/// Computes the largest distance \[m\] that blocks of a model may move from their places in the scene.
pub(crate) fn reach(model: &Model) -> f64 {
    let sizes = median(model.blocks.iter().map(|block| geometry::size(&block.corners)).collect());
    let ends = model
        .supports
        .iter()
        .flat_map(|it| [it.displacement_at(it.from), it.displacement_at(it.to)]);
    REACH * sizes.unwrap_or(0.0) + 2.0 * ends.map(|moved| moved.amax()).fold(0.0, f64::max)
}

impl Loading<'_> {
    /// Moves the blocks slowly to the loads at the end, and keeps these loads until the blocks rest or fall.
    pub(crate) fn lead(
        &self,
        observer: &mut dyn FnMut(&Iteration) -> ControlFlow<()>,
    ) -> Result<Led, lcp::Error> {
        let Self { before, problem, mass, reach, tolerance, .. } = *self;
        let settings = EvolutionSettings {
            tolerance,
            reach,
            max_iterations: FACTORISATIONS,
            ..EvolutionSettings::default()
        };
        let n = problem.displacements();
        let entries: Vec<_> = mass.iter().enumerate().map(|(j, m)| (j, j, *m)).collect();
        let matrix = lcp::Matrix::from_triplets(n, n, &entries)?;
        let mut iterations = 0;
        let observer = &mut |at: &Iteration| {
            iterations += 1;
            observer(at)
        };
        let h = self.pace();
        let mut evolution = if let Some((before, state)) = before {
            // The gaps of the state are computed for the previous loads and supports.
            let state = before.state(state.u.clone(), state.t_n.clone(), state.t_t.clone());
            Evolution::new(before, matrix, settings)?.at(state, vec![0.0; problem.points()])?
        } else {
            // The loads grow from zero.
            Evolution::new(&problem.with_loads(vec![0.0; n])?, matrix, settings)?
        };
        let ending = evolution.lead_observed(problem, h, observer)?;
        Ok(Led { ending, evolution, iterations })
    }

    /// Returns the duration of the loading for a drag of one: so long that the drag is a small part of the loads.
    fn pace(&self) -> f64 {
        let drag = match self.distance() {
            Some(distance) => self.slowness * self.gravity() / distance,
            None => match self.stiffness() {
                Some(stiffness) => FIRST_DRAG * stiffness,
                None => self.gravity() / (FIRST_DRAG * self.reach),
            },
        };
        if drag > 0.0 && drag.is_finite() { 1.0 / drag } else { 1.0 }
    }

    /// Estimates how far blocks will move \[m\]: by the movement of supports, or by the previous displacement times the
    /// relative change of the loads. `None` if nothing has acted yet, or nothing changes.
    fn distance(&self) -> Option<f64> {
        let (before, state) = self.before?;
        let largest = |a: &[f64], b: &[f64]| {
            a.iter().zip(b).fold(0.0_f64, |max, (a, b)| max.max((a - b).abs()))
        };
        let problem = self.problem;
        let moved = largest(problem.initial_gaps(), before.initial_gaps())
            .max(largest(problem.initial_slips(), before.initial_slips()));
        let load = rounding::largest(problem.loads());
        let grown = largest(problem.loads(), before.loads()) / load;
        let before = rounding::largest(&state.u);
        let distance = moved.max(if grown.is_finite() { grown * before } else { 0.0 });
        (distance > 0.0).then_some(distance)
    }

    /// Computes the sum of the loads divided by the sum of the masses \[m/s^2\].
    fn gravity(&self) -> f64 {
        let load: f64 = self.problem.loads().iter().map(|f| f.abs()).sum();
        load / self.mass.iter().sum::<f64>()
    }

    /// Computes the stiffness of blocks and joints divided by the mass \[1/s^2\], as the median of all displacements
    /// that have a stiffness and a mass; `None` if there are none.
    fn stiffness(&self) -> Option<f64> {
        let (problem, compliance) = (self.problem, self.problem.compliance());
        let k = problem.stiffness();
        let mut diagonal: Vec<f64> =
            (0..k.ncols()).map(|j| k.get(j, j).copied().unwrap_or(0.0)).collect();
        for (matrix, direction) in [(problem.normal(), 0), (problem.tangent(), 1)] {
            for entry in matrix.triplet_iter() {
                let gives = compliance[entry.row][direction];
                diagonal[entry.col] +=
                    if gives > 0.0 { entry.val * entry.val / gives } else { 0.0 };
            }
        }
        let both = self.mass.iter().zip(diagonal).filter(|(mass, k)| **mass > 0.0 && *k > 0.0);
        median(both.map(|(mass, k)| k / mass).collect())
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}
