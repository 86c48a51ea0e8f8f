//! The outcome of a loading: rest, or a fall. Solves, histories and limit loads call this one function.

use std::ops::ControlFlow;

use lcp::{
    Contact2d, ContactState, Ending, Evolution, EvolutionSettings, InteriorPoint,
    InteriorPointSettings, Iteration, WarmStart,
};

use crate::geometry;
use crate::model::Model;
use crate::rounding;

/// The part of the loads that the drag may carry while blocks move: the smaller, the slower they move. Measured on
/// settlements of 100 to 1000 bricks: the drag takes about a hundredth of the work of friction.
pub(crate) const SLOWNESS: f64 = 1e-2;
/// The first drag of blocks that start unloaded, relative to the stiffness of their supports; blocks without stiffness
/// move by this part of their reach. Chosen: drag decreases by itself.
const FIRST_DRAG: f64 = 1e-2;
/// Displacements above this part of the median size of blocks, plus twice the movement of supports, invalidate the
/// contacts of the scene. Theory: a brick in running bond has then lost half of its bed.
const REACH: f64 = 0.25;
/// Steps of the path before blocks move. Measured on walls of 1000 bricks: walls that its first start solves take up to
/// 60.
const STEPS_BEFORE_MOTION: usize = 60;
/// The largest tolerance of steps: forces are judged against the largest of all forces in steps, and at the end, to
/// 1e-9, against those on each block. Measured on walls of 100 to 1000 bricks: the latter are up to some hundred times
/// smaller. Finer steps cost 5 % more, so that they are taken only if blocks need them.
pub(crate) const STEP_TOLERANCE: f64 = 1e-11;
/// Factorisations of one loading. Measured on walls of 1000 bricks: slow falls take up to 14 351, settlements in a
/// single step up to 15 917.
const FACTORISATIONS: usize = 20_000;

/// The loading of blocks from one state to the next.
#[derive(Clone, Copy)]
pub(crate) struct Loading<'a> {
    /// Loads, gaps and supports before, with the state in which the blocks rest under them. `None` if nothing has acted
    /// yet.
    pub(crate) before: Option<(&'a Contact2d, &'a ContactState)>,
    /// Loads, gaps and supports at the end; slips are measured from the state before.
    pub(crate) problem: &'a Contact2d,
    /// The mass of every displacement \[kg\].
    pub(crate) mass: &'a [f64],
    /// The distance that blocks may have moved from their places in the scene \[m\].
    pub(crate) reach: f64,
    /// The part of the loads that the drag may carry.
    pub(crate) slowness: f64,
    pub(crate) tolerance: f64,
}

/// The end of a loading.
pub(crate) struct Led {
    pub(crate) ending: Ending,
    /// The blocks after the last step.
    pub(crate) evolution: Evolution,
    /// Iterations of all steps.
    pub(crate) iterations: usize,
}

/// The method before blocks move, if nothing has acted on them yet: from these contact states, or along the path of
/// interior points from its first start, in at most `max_steps`.
pub(crate) fn path(tolerance: f64, max_steps: Option<usize>, start: &WarmStart) -> InteriorPoint {
    let start = start.clone();
    let mut settings =
        InteriorPointSettings { tolerance, prove_infeasible: false, start, ..Default::default() };
    settings.max_iterations =
        max_steps.map_or(STEPS_BEFORE_MOTION, |most| most.min(STEPS_BEFORE_MOTION));
    settings.openings.truncate(1);
    InteriorPoint::new(settings)
}

/// The distance that blocks of a model may have moved from their places in the scene \[m\].
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
            // The gaps are those under the previous loads and supports.
            let state = before.state(state.u.clone(), state.t_n.clone(), state.t_t.clone());
            Evolution::new(before, matrix, settings)?.at(state, vec![0.0; problem.points()])?
        } else {
            // Loads that grow from zero.
            Evolution::new(&problem.with_loads(vec![0.0; n])?, matrix, settings)?
        };
        let ending = evolution.lead_observed(problem, h, observer)?;
        Ok(Led { ending, evolution, iterations })
    }

    /// The time of the way, for a drag of one: so long that the drag is a small part of the loads.
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

    /// An estimate of how far blocks will move \[m\]: the movement of supports, or the previous displacement times the
    /// relative change of the loads.
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

    /// The loads over the mass \[m/s^2\].
    fn gravity(&self) -> f64 {
        let load: f64 = self.problem.loads().iter().map(|f| f.abs()).sum();
        load / self.mass.iter().sum::<f64>()
    }

    /// The stiffness of blocks and of the joints below them over their mass \[1/s^2\]: the median over all
    /// displacements with both.
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
