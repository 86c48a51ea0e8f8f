//! The load history: the steps of a scene, the actions in each, and their energy.
//!
//! The solution depends on the load path if there is friction. The law of friction holds in a step for the slip of this
//! step: the slip at the end of the previous step is subtracted,
//!
//! ```text
//! 0 <= p+ _|_ y+ >= 0,   0 <= p- _|_ y- >= 0,   y+ - y- = y_t^k - y_t^(k-1)
//! ```
//!
//! and everything else is as in one step. The previous slip enters `s_0`; the movement of a support enters `x_0` and
//! `s_0` of the joints at this support. So every step has its own [`Model`], the model of the scene
//! [under](Model::under) the actions of the step.
//!
//! | module | content |
//! |---|---|
//! | `energy` | work of loads and supports, dissipation |
//! | [`checkpoint`](crate::analysis::checkpoint) | everything that the next step needs, as a file |

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::data::info::Way;
use crate::data::state::Reaction;
use crate::model::{Body, Model};
use crate::scene::{Movement, Route, Scene, Stage, factor_in};

pub(crate) mod energy;
pub(crate) mod spread;

pub use spread::{SecondLoading, Spread};

/// The actions on a model: gravity, loads and movements of supports.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Actions {
    /// The factor of gravity \[-\].
    pub gravity: f64,
    /// The factors of the loads \[-\], in the order of the scene; each multiplies the factor that the load has in the
    /// scene.
    pub loads: Vec<f64>,
    /// The movements of the supports, in the order of the scene; lengths in metres.
    pub movements: Vec<Movement>,
}

impl Actions {
    /// Returns the actions with all loads of a scene in full and all supports in their original places.
    pub fn full(scene: &Scene) -> Self {
        Self {
            gravity: 1.0,
            loads: vec![1.0; scene.loads.len()],
            movements: vec![Movement::default(); scene.all_supports().len()],
        }
    }

    /// Returns the actions before the first stage: those that no stage names are in full, all others are zero.
    fn before(scene: &Scene) -> Self {
        let mut actions = Self::full(scene);
        let named = |is_named: &dyn Fn(&Stage) -> bool| scene.stages.iter().any(is_named);
        if named(&|stage| stage.gravity.is_some()) {
            actions.gravity = 0.0;
        }
        for (load, factor) in scene.loads.iter().zip(&mut actions.loads) {
            if named(&|stage| factor_in(&stage.loads, load).is_some()) {
                *factor = 0.0;
            }
        }
        actions
    }

    /// Returns the actions at the end of a stage that starts from the actions `self`.
    fn after(&self, stage: &Stage, scene: &Scene) -> Self {
        let mut actions = self.clone();
        actions.gravity = stage.gravity.unwrap_or(self.gravity);
        for (load, factor) in scene.loads.iter().zip(&mut actions.loads) {
            *factor = factor_in(&stage.loads, load).unwrap_or(*factor);
        }
        for (support, place) in scene.all_supports().iter().zip(&mut actions.movements) {
            let end = stage.moves.get(&support.name);
            *place = end.map_or(*place, |end| end.in_lengths(scene.units.length_to_si()));
        }
        actions
    }

    fn towards(&self, end: &Self, fraction: f64) -> Self {
        let between = |(from, to): (&f64, &f64)| from + (to - from) * fraction;
        let moves = self.movements.iter().zip(&end.movements);
        Self {
            gravity: between((&self.gravity, &end.gravity)),
            loads: self.loads.iter().zip(&end.loads).map(between).collect(),
            movements: moves.map(|(from, to)| from.towards(*to, fraction)).collect(),
        }
    }
}

/// One step of the load history.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HistoryStep {
    /// Name of the stage; empty for a scene without stages.
    pub stage: String,
    /// Number of the step in the stage, from 1.
    pub number: usize,
    /// Number of steps in the stage.
    pub of: usize,
    /// The actions at the end of the step.
    pub actions: Actions,
}

/// Lists the steps of all stages of a scene; a scene without stages has one step with all actions in full.
///
/// ```
/// use masonry::history;
/// use masonry::scene::{Load, Scene, Stage};
/// use masonry::units::Units;
/// let scene = Scene::new("A push after the weight", Units::SI)
///     .load(Load::traction("push", [0.0, 0.0], [0.0, 1.0], [1e3, 0.0]))
///     .stage(Stage::new("weight"))
///     .stage(Stage::new("push").steps(2).load("push", 1.0));
/// let factors: Vec<f64> = history::steps(&scene).iter().map(|step| step.actions.loads[0]).collect();
/// assert_eq!(factors, [0.0, 0.5, 1.0]);
/// ```
pub fn steps(scene: &Scene) -> Vec<HistoryStep> {
    let mut steps = Vec::new();
    let mut actions = Actions::before(scene);
    for stage in &scene.stages {
        let end = actions.after(stage, scene);
        let of = stage.steps as usize;
        steps.extend((1..=of).map(|number| {
            // The factors at the end of a stage are exactly those of the scene.
            let fraction = number as f64 / of as f64;
            let within = || actions.towards(&end, fraction);
            let actions = if number == of { end.clone() } else { within() };
            HistoryStep { stage: stage.name.clone(), number, of, actions }
        }));
        actions = end;
    }
    if steps.is_empty() {
        steps.push(HistoryStep { stage: String::new(), number: 1, of: 1, actions });
    }
    steps
}

impl Model {
    /// Returns this model under the actions of a step, with the previous slip \[m\] of every contact point.
    ///
    /// Gravity and loads are multiplied by their factors. The movement `u_s` of a support reduces the gaps of its
    /// joints by `u_s.n`, and their slips by `u_s.t`. Previous slips are subtracted at points with friction.
    #[must_use]
    pub fn under(&self, actions: &Actions, slips: &[f64]) -> Self {
        let mut model = self.slid(slips);
        model.act(actions);
        model
    }

    /// Returns this model after previous slips \[m\], one for every contact point.
    #[must_use]
    pub fn slid(&self, slips: &[f64]) -> Self {
        let mut model = self.clone();
        for (contact, slip) in model.contacts.iter_mut().zip(slips) {
            if contact.law.resists_sliding() {
                contact.slip -= slip;
            }
        }
        model
    }

    /// Applies the actions of the only step to this model, which must not have any actions yet.
    pub(crate) fn act(&mut self, actions: &Actions) {
        self.gravity *= actions.gravity;
        for load in self.blocks.iter_mut().flat_map(|block| &mut block.loads) {
            load.scale(actions.loads[load.load().index()]);
        }
        for acceleration in &mut self.accelerations {
            acceleration.value *= actions.loads[acceleration.load.index()];
        }
        for (load, factor) in self.loads.iter_mut().zip(&actions.loads) {
            load.factor *= factor;
        }
        for (support, movement) in self.supports.iter_mut().zip(&actions.movements) {
            support.movement = *movement;
        }
        for contact in &mut self.contacts {
            let joint = &self.joints[contact.joint.index()];
            let Body::Support(support) = joint.a else { continue };
            let moved = self.supports[support.index()].displacement_at(contact.position);
            contact.gap -= moved.dot(&joint.normal);
            contact.slip -= moved.dot(&joint.tangent());
        }
    }
}

/// The record of a solved step, in SI units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct StepRecord {
    /// The step of the load history.
    pub step: HistoryStep,
    /// The route that solved the step.
    pub route: Route,
    /// The way in which the state was found: by one step with Coulomb's law, or by a motion of blocks.
    pub way: Way,
    /// Number of factorised matrices.
    pub factorisations: usize,
    /// The residuals of the solution of the step.
    pub residuals: lcp::Residuals,
    /// Work of loads and of moving supports in this step \[J\], by the trapezoidal rule.
    pub work: f64,
    /// Energy dissipated by sliding in this step \[J\], `-t_t . (increment of y_t)`, plus the energy that opens joints
    /// with tensile strength and is recovered when they close.
    pub dissipation: f64,
    /// Ratio of the work of friction to its largest possible value for the slips `ds` of the step: the sum of `-t_t ds`
    /// divided by the sum of `(mu t_n + C) |ds|`. Coulomb's law requires one. `None` if nothing slid.
    pub friction_power: Option<f64>,
    /// Energy that friction released in this step \[J\]; zero by Coulomb's law.
    pub energy_created: f64,
    /// Energy that the drag of slow motions takes in this step \[J\].
    pub dragged: f64,
    /// Strain energy of blocks and films after the step \[J\].
    pub strain_energy: f64,
    /// The largest component of a displacement after the step \[m\].
    pub largest_displacement: f64,
    /// The numbers of contact points that are open, stick and slip at the end of the step, in this order.
    pub contacts: [usize; 3],
    /// The reactions of all supports at the end of the step.
    pub reactions: Vec<Reaction>,
}

/// The load history of a scene, step by step.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct History {
    /// The records of the steps that were solved.
    pub records: Vec<StepRecord>,
    /// The step that could not be solved; `None` if all were solved. The state of the outcome is that of the step
    /// before.
    pub failed: Option<HistoryStep>,
    /// Number of all steps of the scene.
    pub steps: usize,
    /// Names of the loads, in the order of their factors in [`Actions::loads`].
    pub loads: Vec<String>,
    /// The outcome of the second loading; `None` unless [requested](crate::analysis::solve::Run::compare).
    pub second_loading: Option<SecondLoading>,
}

impl StepRecord {
    /// Whether the step keeps Coulomb's law: the work of friction is at least 0.99 of its largest possible value.
    pub fn keeps_law(&self) -> bool {
        self.friction_power.is_none_or(|power| power >= KEPT)
    }
}

/// Ratio of the work of friction to its largest possible value above which Coulomb's law counts as kept. Chosen: steps
/// by the law have a ratio of one, to many digits, and other steps mostly a much smaller one.
const KEPT: f64 = 0.99;

impl History {
    /// Returns the number of steps that do not [keep Coulomb's law](StepRecord::keeps_law).
    pub fn steps_against_law(&self) -> usize {
        self.records.iter().filter(|record| !record.keeps_law()).count()
    }

    /// Returns the work of loads and supports in all steps \[J\].
    pub fn work(&self) -> f64 {
        self.records.iter().map(|record| record.work).sum()
    }

    /// Returns the energy dissipated in all steps \[J\].
    pub fn dissipation(&self) -> f64 {
        self.records.iter().map(|record| record.dissipation).sum()
    }
}

/// Lists the names of the supports that any stage of a scene moves.
pub(crate) fn moving_supports(scene: &Scene) -> Vec<&str> {
    let moved: BTreeSet<&str> = scene
        .stages
        .iter()
        .flat_map(|stage| &stage.moves)
        .filter(|(_, to)| **to != Movement::default())
        .map(|(name, _)| name.as_str())
        .collect();
    moved.into_iter().collect()
}
