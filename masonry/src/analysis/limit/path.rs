//! The limit load of Coulomb's friction along a path: the factor grows step by step, and the blocks rest or flow.

mod events;
mod steps;

use nalgebra::Vector2;

use events::EventSearch;
pub use events::{JointChange, JointEvent};
use steps::{AtRest, StepEnd, Steps};

use super::watch::{Bracket, Watch};
use super::{Answer, Associative, LimitError, LoadedStructure, NOTHING};
use crate::data::state::{PointState, Reaction};
use crate::forms::Sparse;
use crate::method::loading;
use crate::model::Model;
use crate::recover;
use crate::scene::SolverSettings;
use crate::system::{System, mass};

/// Steps up to the bound of associated flow. Measured on the walls of Ferris and Tin-Loi, whose published limits are met to
/// 2e-3.
const STEPS: f64 = 16.0;
/// The search ends at this relative difference between the factors at which blocks rest and at which they flow.
const NEAR: f64 = 5e-5;
/// The difference at which the search ends if blocks take long to fall, and to which events are located. Chosen: three
/// digits.
const NEAR_ENOUGH: f64 = 1e-3;
/// Steps of the solver in a long fall. Measured: walls of a few blocks fall within 100, walls of a hundred within some
/// hundred.
const LONG: usize = 200;
/// Relative difference up to which these factors count as one number. Chosen: far below the change by another path.
const ONE_NUMBER: f64 = 5e-3;
/// Steps of a structure that never falls; each is twice as long as the one before. Chosen.
const DOUBLED: usize = 10;

/// The limit load of Coulomb's friction, in which joints do not open when they slide.
///
/// The factor grows from zero in steps, in each of which the blocks come to rest or flow; the limit is found by
/// bisection. Other paths may end elsewhere if there is friction. Joints between rigid blocks have the [stiffness of
/// dry joints](crate::model::DRY_JOINT), unless their class has another.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Path {
    /// The largest factor \[-\] at which the blocks rest; `None` if they do not rest without the group.
    pub load_factor: Option<f64>,
    /// The smallest factor \[-\] at which the blocks flow, or for which it is proved that no forces balance the loads.
    pub falls: Option<f64>,
    /// Whether the two factors are close to each other, or the structure stands at every factor that was tried.
    /// Otherwise neither rest nor flow was found between them.
    pub decided: bool,
    /// The structure under [`load_factor`](Self::load_factor), with the springs.
    pub model: Model,
    /// The last state at rest, point by point; slips are those of its step.
    pub contacts: Option<Vec<PointState>>,
    /// The reactions of the last state at rest.
    pub reactions: Vec<Reaction>,
    /// The motion of the blocks above `load_factor`: displacement rates of their corners, scaled to a largest component
    /// of one.
    pub mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// Joints that opened or slid for the first time along the path.
    pub events: Vec<JointEvent>,
    /// The states at rest, by growing factor.
    pub curve: Vec<Stand>,
}

impl Path {
    /// The outcome.
    pub fn answer(&self) -> Answer {
        match (self.decided, self.load_factor, self.falls) {
            (false, ..) => Answer::Undecided,
            (true, None, _) => Answer::Falls,
            (true, Some(_), Some(_)) => Answer::Fails,
            (true, Some(_), None) => Answer::Unlimited,
        }
    }

    /// A warning that limits the meaning of the answer.
    pub(super) fn warning(&self) -> String {
        let way = "Other paths may end at other factors because of friction.";
        let sentences = [self.model.of_dry_joints(), mass::of_unit_density(&self.model)];
        sentences.into_iter().flatten().fold(way.to_owned(), |text, more| text + " " + &more)
    }
}

/// A state at rest on the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stand {
    /// The load factor \[-\].
    pub load_factor: f64,
    /// The largest displacement \[m\] since the factor was zero; the displacement of rigid blocks comes from the
    /// springs and has no meaning by itself.
    pub displacement: f64,
    /// The numbers of open, sticking and sliding contact points, in this order.
    pub contacts: [usize; 3],
}

/// Follows the path; `model` has blocks as they are, elastic or rigid.
pub(super) fn of(
    structure: &LoadedStructure<'_>,
    associative: &Associative,
    watch: &mut Watch<'_>,
) -> Result<Path, LimitError> {
    let stiff = |growth: f64| {
        let mut model = structure.under(1.0, growth);
        model.give_stiffness_to_dry_joints();
        model
    };
    let (stays, grown) = (stiff(0.0), stiff(1.0));
    let [system, with_growth] = [&stays, &grown].map(System::without_factors);
    let (system, with_growth) = (system?, with_growth?);
    let sparse = Sparse::new(&system)?;
    let with_growth = Sparse::new(&with_growth)?;
    let loads = with_growth.problem.loads().iter().zip(sparse.problem.loads());
    let growth: Vec<f64> = loads.map(|(grown, stays)| grown - stays).collect();
    let mass = mass::lumped(&stays, &system);
    // The tolerance of scenes that set none.
    let SolverSettings { tolerance, .. } = SolverSettings::default();
    let steps = Steps {
        sparse: &sparse,
        growth: &growth,
        mass: &mass,
        reach: loading::reach(&stays),
        tolerance,
    };
    let falls = if associative.answer == Answer::Falls { Some(0.0) } else { associative.bound };
    watch.known = Bracket { stands: None, falls };
    let size = associative.size;
    let mut climb = Climb {
        steps,
        watch,
        size,
        rests: Vec::new(),
        end: falls,
        falls,
        near: NEAR,
        motion: None,
    };
    climb.run()?;
    let Climb { steps, watch, rests, falls, motion, .. } = climb;
    let flows = motion.and_then(|motion| recover::flow(&stays, &system, &sparse, &motion));
    // Nothing stops the motion of associated flow at the bound.
    let is_bound = falls.is_some() && falls == associative.bound;
    let proved = associative.mechanism.as_ref().filter(|_| is_bound);
    let mechanism = flows.or_else(|| proved.cloned());
    let load_factor = rests.last().map(|(factor, _)| *factor);
    let model = stiff(load_factor.unwrap_or(0.0));
    let contacts = rests.last().map(|(_, rest)| {
        let rows = sparse.rows(&rest.state);
        recover::from_displacements(&model, &system, &sparse, &rows, &rest.u, tolerance, false)
            .contacts
    });
    let reactions = contacts.as_ref().map_or_else(Vec::new, |it| recover::reactions(&model, it));
    let near = NEAR_ENOUGH * falls.or(load_factor).unwrap_or(1.0);
    let way = EventSearch { model: &model, system: &system, steps: &steps, near };
    let (events, curve) = way.follow(rests, watch)?;
    Ok(Path {
        load_factor,
        falls,
        decided: !watch.is_ended && is_near(falls, load_factor, size),
        model,
        contacts,
        reactions,
        mechanism,
        events,
        curve,
    })
}

/// Whether the factor that falls is hardly larger than the one that stands, or there is no factor that falls.
fn is_near(falls: Option<f64>, stands: Option<f64>, size: f64) -> bool {
    match (falls, stands) {
        (Some(falls), Some(stands)) => falls - stands <= (ONE_NUMBER * falls).max(NOTHING * size),
        (Some(falls), None) => falls <= 0.0,
        (None, stands) => stands.is_some(),
    }
}

/// The search along growing factors.
struct Climb<'a, 'b> {
    steps: Steps<'a>,
    watch: &'a mut Watch<'b>,
    /// The factor at which the growing loads are as large as the others.
    size: f64,
    rests: Vec<(f64, AtRest)>,
    /// The least factor at which no rest was found, and the least at which it is known that there is no rest.
    end: Option<f64>,
    falls: Option<f64>,
    /// The relative difference that the two factors may have.
    near: f64,
    motion: Option<Vec<f64>>,
}

impl Climb<'_, '_> {
    fn run(&mut self) -> Result<(), LimitError> {
        let is_below = self.end.is_some_and(|end| end <= 0.0);
        if is_below || self.rests.is_empty() && !self.tried(0.0)? {
            return Ok(());
        }
        let mut step = self.end.map_or(1.0, |end| end / STEPS);
        // The search also ends for a structure that is at rest under no factor.
        let least = (NEAR * NEAR * self.end.unwrap_or(1.0)).max(NOTHING * self.size);
        let mut doubled = 0;
        loop {
            let at = self.rests.last().map_or(0.0, |(factor, _)| *factor);
            let next = at + step;
            let next = match self.end {
                Some(end) if end - at <= least.max(self.near * end) => return Ok(()),
                Some(end) if end - next <= self.near * end => 0.5 * (at + end),
                _ => next,
            };
            let rests = self.tried(next)?;
            if self.watch.is_ended {
                return Ok(());
            }
            if self.end.is_none() {
                doubled += 1;
                step *= 2.0;
                if doubled == DOUBLED {
                    return Ok(());
                }
            } else if !rests {
                step = step.min(0.5 * (next - at));
            }
        }
    }

    /// Whether the blocks rest at a factor.
    fn tried(&mut self, factor: f64) -> Result<bool, LimitError> {
        if self.watch.ask().is_break() {
            return Ok(false);
        }
        let from = self.rests.last().map(|(_, rest)| rest);
        let mut taken = 0;
        let end = self.steps.advance(from, factor, &mut |_| {
            taken += 1;
            self.watch.ask()
        })?;
        if taken > LONG && !matches!(end, StepEnd::Rests(_)) {
            self.near = NEAR_ENOUGH;
        }
        match end {
            StepEnd::Rests(rest) => {
                self.rests.push((factor, *rest));
                self.watch.known.stands = Some(factor);
                return Ok(true);
            }
            StepEnd::Flows(motion) => {
                self.falls = Some(factor);
                self.watch.known.falls = Some(factor);
                self.motion = Some(motion);
            }
            StepEnd::Open => {}
        }
        self.end = Some(factor);
        Ok(false)
    }
}
