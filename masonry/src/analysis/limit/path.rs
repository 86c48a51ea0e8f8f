//! The limit load of Coulomb's friction along a path: the load factor grows step by step, and in each step the blocks
//! rest or flow.

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

/// Number of steps from zero to the bound of associated flow. Measured on the walls of Ferris and Tin-Loi, whose
/// published limits are met to 2e-3.
const STEPS: f64 = 16.0;
/// Relative difference, between the load factors at which blocks rest and at which they flow, at which the search ends.
const NEAR: f64 = 5e-5;
/// Relative difference of load factors at which the search ends if blocks take long to fall, and to which events are
/// located. Chosen: three digits.
const NEAR_ENOUGH: f64 = 1e-3;
/// Number of steps of the solver above which a fall counts as long. Measured: walls of a few blocks fall within 100,
/// walls of a hundred within some hundred.
const LONG: usize = 200;
/// Relative difference up to which the load factors of rest and of flow count as one number. Chosen: far below the
/// change by another path.
const ONE_NUMBER: f64 = 5e-3;
/// Number of steps, each twice as long as the one before, after which a structure counts as one that never falls.
/// Chosen.
const DOUBLED: usize = 10;

/// The limit load of Coulomb's friction along a path. Joints do not open when they slide.
///
/// The factor grows from zero in steps, in each of which the blocks come to rest or flow; the limit is found by
/// bisection. Other paths may end elsewhere if there is friction. Joints between rigid blocks have the [stiffness of
/// dry joints](crate::model::DRY_JOINT), unless their class has another.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Path {
    /// The largest load factor \[-\] at which the blocks rest; `None` if they do not rest without the group.
    pub load_factor: Option<f64>,
    /// The smallest load factor \[-\] at which the blocks flow, or at which it is proved that no forces balance the
    /// loads; `None` if no such factor was found.
    pub falls: Option<f64>,
    /// Whether the limit is decided: `load_factor` and `falls` are close to each other, or the structure stands at
    /// every factor that was tried. If `false`, there is a factor at which the blocks were found
    /// neither to come to rest nor to keep moving.
    pub decided: bool,
    /// The structure under [`load_factor`](Self::load_factor), including the stiffness of its dry joints.
    pub model: Model,
    /// The contact points in the last state at rest; slips are those of its step.
    pub contacts: Option<Vec<PointState>>,
    /// The reactions of the supports in the last state at rest.
    pub reactions: Vec<Reaction>,
    /// The motion of the blocks under a factor above `load_factor`: displacement rates of the corners of every block,
    /// scaled to a largest component of one.
    pub mechanism: Option<Vec<Vec<Vector2<f64>>>>,
    /// The events along the path: joints that open or slide for the first time.
    pub events: Vec<JointEvent>,
    /// The states at rest along the path, by growing load factor.
    pub curve: Vec<Stand>,
}

impl Path {
    /// Returns the outcome of the analysis along the path.
    pub fn answer(&self) -> Answer {
        match (self.decided, self.load_factor, self.falls) {
            (false, ..) => Answer::Undecided,
            (true, None, _) => Answer::Falls,
            (true, Some(_), Some(_)) => Answer::Fails,
            (true, Some(_), None) => Answer::Unlimited,
        }
    }

    /// Returns a warning that limits the meaning of the answer.
    pub(super) fn warning(&self) -> String {
        let way = "Other paths may end at other factors because of friction.";
        let sentences = [self.model.of_dry_joints(), mass::of_unit_density(&self.model)];
        sentences.into_iter().flatten().fold(way.to_owned(), |text, more| text + " " + &more)
    }
}

/// A state of rest on the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stand {
    /// The load factor of this state \[-\].
    pub load_factor: f64,
    /// The largest displacement \[m\] since the load factor was zero. Rigid blocks move only by the springs of their
    /// joints, so that their displacements have no meaning by themselves.
    pub displacement: f64,
    /// The numbers of open, sticking and sliding contact points, in this order.
    pub contacts: [usize; 3],
}

/// Follows the path for the blocks of `structure` as they are, elastic or rigid.
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
    // The default tolerance, whatever the scene has.
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
    // The mechanism of associated flow is used if its bound ended the path.
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

/// Whether the least factor at which the structure falls is hardly larger than the largest at which it stands, or it
/// falls at no factor.
fn is_near(falls: Option<f64>, stands: Option<f64>, size: f64) -> bool {
    match (falls, stands) {
        (Some(falls), Some(stands)) => falls - stands <= (ONE_NUMBER * falls).max(NOTHING * size),
        (Some(falls), None) => falls <= 0.0,
        (None, stands) => stands.is_some(),
    }
}

/// The search for the limit along growing load factors.
struct Climb<'a, 'b> {
    steps: Steps<'a>,
    watch: &'a mut Watch<'b>,
    /// The load factor at which the growing loads are as large as the others.
    size: f64,
    rests: Vec<(f64, AtRest)>,
    /// The least load factor at which no rest was found (`end`), and the least at which it is known that there is no
    /// rest (`falls`).
    end: Option<f64>,
    falls: Option<f64>,
    /// The search ends when the last factor at rest and the least factor without rest differ by at most this fraction.
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
        // The smallest step: the search must end for a structure that is at rest under no positive factor.
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

    /// Tries a load factor, and returns whether the blocks rest under it.
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
