//! The verdict: whether a wall stands, falls, or is undecided; with the evidence, a sentence for people, and warnings.
//! Nothing else in the crate decides the verdict.
//!
//! * **Stands**: an equilibrium was found and verified. Any forces within friction that balance the loads are an
//!   equilibrium of rigid blocks at rest; loading from a state without stresses has to lead to rest as well.
//! * **Falls**: no contact forces within friction balance the loads, with a [proof](crate::data::statics::Proof) that
//!   was checked in the geometry; or the blocks move and do not come to rest, which is evidence.
//! * **Undecided**: all other cases. Neither a secondary ray nor springs that keep their load prove that a wall falls.

mod sentence;
mod unique;

use nalgebra::Vector2;

use crate::data::info::Way;
use crate::data::state::State;
use crate::data::statics::Statics;
use crate::data::verdict::{Evidence, Judgement, Verdict};
use crate::geometry;
use crate::history::History;
use crate::ids::BlockId;
use crate::model::{Body, JointPoint, Model};
use crate::recover;
use crate::system::displaced_nodes;
use crate::system::mass;
use crate::system::rigid::Modes;
use crate::verify::step::{LoadingEnd, StepResult};

pub(crate) use unique::circulating;

/// The results of an analysis on which the verdict depends.
#[derive(Clone, Copy)]
pub(crate) struct Findings<'a> {
    /// The noun for the structure in sentences: `wall` or `arch`.
    pub(crate) structure: &'static str,
    pub(crate) model: &'a Model,
    pub(crate) step: &'a StepResult,
    /// The load history; `None` if there is only one step.
    pub(crate) history: Option<&'a History>,
    /// Sentences about unusual magnitudes of the scene.
    pub(crate) unusual: &'a [String],
    /// Whether the blocks are at rest whatever the contact forces.
    pub(crate) at_rest: bool,
    /// Number of contact points whose forces are not unique.
    pub(crate) circulating: usize,
}

impl Judgement {
    pub(crate) fn of(known: &Findings<'_>) -> Self {
        let movement = known.step.state.as_ref().map(|state| Drift::of(known.model, state));
        let StepResult { info, statics, loading, .. } = known.step;
        let is_solved = known.step.is_solved();
        let (verdict, evidence) = match statics {
            Some(Statics::Impossible(_)) => (Verdict::Falls, Evidence::NoAdmissibleForces),
            _ if *loading == Some(LoadingEnd::ToFall) => (Verdict::Falls, Evidence::Motion),
            _ if *loading == Some(LoadingEnd::Nowhere) => {
                (Verdict::Undecided, Evidence::AdmissibleForces)
            }
            _ if is_solved && !movement.is_some_and(|movement| is_too_far(known, movement)) => {
                let evidence =
                    if known.at_rest { Evidence::AdmissibleForces } else { Evidence::Equilibrium };
                (Verdict::Stands, evidence)
            }
            // Blocks at rest: admissible forces count more than a motion, even if they are too inexact for an answer.
            Some(Statics::Admissible(_)) if known.at_rest => {
                (Verdict::Undecided, Evidence::AdmissibleForces)
            }
            _ if info.status == lcp::Status::NoEquilibrium => (Verdict::Falls, Evidence::Motion),
            Some(Statics::Admissible(_)) => (Verdict::Undecided, Evidence::AdmissibleForces),
            Some(Statics::Open) | None => (Verdict::Undecided, Evidence::None),
        };
        let sentence = sentence::of(known, verdict, evidence, movement);
        Self { verdict, evidence, sentence, warnings: warnings(known, verdict, movement) }
    }
}

/// Returns whether displacements are too large for the state to have a meaning. The limit is lower for a state that
/// was reached only by a motion, since it may be the end of a fall.
fn is_too_far(known: &Findings<'_>, movement: Drift) -> bool {
    movement.is_too_large() || (known.step.info.way == Way::Motion && movement.is_large())
}

fn warnings(known: &Findings<'_>, verdict: Verdict, movement: Option<Drift>) -> Vec<String> {
    let mut list = known.unusual.to_vec();
    list.extend(known.model.of_dry_joints());
    let StepResult { info, state, loading, .. } = known.step;
    let may_move = known.history.is_some() || loading.is_some() || info.way == Way::Motion;
    let is_open = verdict == Verdict::Undecided && may_move;
    list.extend(is_open.then(|| known.model.of_hard_joints()).flatten());
    list.extend(may_move.then(|| mass::of_unit_density(known.model)).flatten());
    if let Some(movement) = movement.filter(|movement| movement.is_large()) {
        list.push(format!(
            "Displacements exceed what small-displacement theory allows: {}. Contacts and lever arms of the \
             forces are still those of the undeformed wall.",
            sentence::of_movement(movement)
        ));
    }
    if known.circulating > 0 && state.is_some() {
        let blocks = "Displacements, stresses and the resultants of joints that do not meet in a corner are \
                      not affected.";
        let rigid = format!(
            "One of many sets that balance the loads is shown. Joints that slide while the load grows may bring the {} \
             down below the load that these forces carry; `masonry limit` computes that load.",
            known.structure
        );
        list.push(format!(
            "Forces at {} of {} contact points are not unique. {}",
            known.circulating,
            known.model.contacts.len(),
            if known.at_rest { &rigid } else { blocks }
        ));
    }
    list
}

/// The largest movements of blocks against each other, relative to the sizes of the blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drift {
    /// The larger of two ratios \[-\]: the largest relative displacement of the two sides of a contact, divided by the
    /// size of the smaller block; and the largest deformation of a block, the distance of a node from the rigid motion
    /// of the block, divided by the size of that block.
    pub(crate) share: f64,
    /// The largest rotation of a block \[rad\].
    pub(crate) turned: f64,
}

/// Limit of [`Drift::share`] \[-\] and of [`Drift::turned`] \[rad\] above which the geometry has changed visibly.
const LARGE: f64 = 0.1;
/// Limits of [`Drift::share`] \[-\] and of [`Drift::turned`] \[rad\] above which the contacts of the scene are no
/// longer those of the deformed wall.
const TOO_LARGE: [f64; 2] = [1.0, 0.5];

impl Drift {
    pub(crate) fn of(model: &Model, state: &State) -> Self {
        let mut movement = Self { share: 0.0, turned: 0.0 };
        for contact in &model.contacts {
            let apart = apart(model, state, contact);
            let anchors = [Some(contact.b), contact.a].into_iter().flatten();
            let sizes = anchors.map(|it| geometry::size(&model.blocks[it.block.index()].corners));
            movement.share = movement.share.max(apart / sizes.fold(f64::INFINITY, f64::min));
        }
        for (b, (block, moved)) in model.blocks.iter().zip(&state.displacements).enumerate() {
            let modes = Modes::of(&block.corners);
            let places = displaced_nodes(model, BlockId::new(b));
            let ([.., turn], deformed) = modes.nearest(places, moved);
            movement.turned = movement.turned.max((turn / modes.length).abs());
            movement.share = movement.share.max(deformed / modes.length);
        }
        movement
    }

    /// Returns whether displacements are large enough to change the geometry visibly.
    pub(crate) fn is_large(self) -> bool {
        self.share > LARGE || self.turned > LARGE
    }

    /// Returns whether displacements are so large that the state has no meaning.
    pub(crate) fn is_too_large(self) -> bool {
        self.share > TOO_LARGE[0] || self.turned > TOO_LARGE[1]
    }
}

/// Returns the relative displacement of the two sides of a contact \[m\], without the movement of a support.
fn apart(model: &Model, state: &State, contact: &JointPoint) -> f64 {
    let moved = match model.joints[contact.joint.index()].a {
        Body::Support(id) => model.supports[id.index()].displacement_at(contact.position),
        Body::Block(_) => Vector2::zeros(),
    };
    (recover::relative_displacement(model, &state.displacements, contact) - moved).norm()
}
