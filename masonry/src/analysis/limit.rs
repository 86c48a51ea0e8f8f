//! Limit analysis: the factor of a group of loads at which a structure fails (limit-load factor).
//!
//! Loads outside the group act in full, and the stages of the scene are ignored. There are two laws of friction.
//! Associated flow treats blocks as rigid, which changes no limit load, and gaps as closed; its answer is proved, and
//! is an upper bound for Coulomb's friction. Coulomb's friction follows a path of states at rest ([`Path`]), with
//! blocks and gaps as they are. If the group consists of accelerations, there is a [seismic check](SeismicCheck).
//!
//! ```
//! use masonry::analysis::limit::{Answer, limit};
//! use masonry::scene::{Block, Joint, Load, Material, Scene, Support};
//! use masonry::units::Units;
//!
//! // The block tips over at a fifth of gravity, its breadth divided by its height.
//! let scene = Scene::new("A block that is pushed", Units::SI)
//!     .thickness(1.0)
//!     .gravity([0.0, -10.0])
//!     .material("stone", Material::rigid().density(1000.0))
//!     .joint("floor", Joint::mu(0.7))
//!     .block(Block::new("block", "stone", [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]))
//!     .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "floor"))
//!     .load(Load::acceleration("quake", [10.0, 0.0]));
//! let limit = limit(&scene)?;
//! let associative = limit.associative.unwrap();
//! assert_eq!(associative.answer, Answer::Fails);
//! assert!((associative.load_factor.unwrap() - 0.2).abs() < 1e-6);
//! assert!((limit.path.unwrap().load_factor.unwrap() - 0.2).abs() < 1e-4);
//! # Ok::<(), masonry::analysis::limit::LimitError>(())
//! ```

mod associative;
mod directions;
mod error;
mod path;
mod range;
mod seismic;
mod sentence;
mod thickness;
mod train;
mod watch;

use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use web_time::Instant;

pub use associative::{Answer, Associative, Rest};
pub use directions::{Directions, Governs};
pub use error::LimitError;
pub use path::{JointChange, JointEvent, Path, Stand};
pub use range::{Extremes, Range, ranges, ranges_observed};
pub use seismic::SeismicCheck;
pub use thickness::{Thickness, least_thickness, least_thickness_observed};
pub use train::{CrossingTrain, TrainPosition, train, train_observed};
pub use watch::{Bracket, LimitObserver};

use crate::analysis::clock::Clock;
use crate::data::info::PhaseTime;
use crate::geometry::SAME_PLACE;
use crate::history::Actions;
use crate::model::Model;
use crate::plan::Plan;
use crate::scene::groups::WEIGHT;
use crate::scene::{Load, Route, Scene};
use crate::system::{self, System};
use watch::Watch;

/// Load factors count as zero below this part of the scale of load factors (the factor at which the growing loads are
/// as large as the others). Chosen: between the gap of the bounds of associated flow and a factor that matters.
const NOTHING: f64 = 1e-6;

/// The laws of friction by which a limit load is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Laws {
    /// Associated flow, in which joints open by `mu` times their slip: one linear program, with a proof.
    Associative,
    /// Coulomb's friction, in which joints slide without opening: a path of states at rest is followed.
    Path,
    /// Both laws of friction, one after the other.
    #[default]
    Both,
}

/// The result of a limit analysis.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Limit {
    /// Title of the scene.
    pub title: String,
    /// The structure with rigid blocks under the largest load factor that associated flow carries, or under all loads
    /// in full if no such factor is known.
    pub model: Model,
    /// The load or the group of loads that grows.
    pub group: String,
    /// The limit load of associated flow; `None` if this law was not chosen.
    pub associative: Option<Associative>,
    /// The limit load of Coulomb's friction along a path; `None` if this law was not chosen.
    pub path: Option<Path>,
    /// The seismic check; `None` unless accelerations grow, and the limit and its mechanism are known.
    pub seismic: Option<SeismicCheck>,
    /// Whether the weight is the growing load and is proved not to be carried at all by forces within friction.
    pub falls_by_weight: bool,
    /// The answer in sentences for engineers.
    pub sentence: String,
    /// Warnings that limit the meaning of the answer.
    pub warnings: Vec<String>,
    /// Whether the observer ended the search early, so that less is known than could be.
    pub is_interrupted: bool,
    /// Wall-clock time of every phase of the analysis.
    pub times: Vec<PhaseTime>,
}

impl Limit {
    /// Whether the limit-load factor by every chosen law is known, and the structure stands under some load factor.
    pub fn is_solved(&self) -> bool {
        let is_known = |it: &Associative| matches!(it.answer, Answer::Fails | Answer::Unlimited);
        let by_path = |path: &Path| path.decided && path.load_factor.is_some();
        self.associative.as_ref().is_none_or(is_known)
            && self.path.as_ref().is_none_or(by_path)
            && !self.is_interrupted
            && !self.falls_by_weight
    }

    /// Returns the load factor \[-\] that the structure carries: by Coulomb's friction if the path was followed, else
    /// by forces within friction. The factor is infinite if there is no limit, and zero if none is known.
    pub fn carried(&self) -> f64 {
        let by_path = self.path.as_ref().map(|it| it.load_factor);
        let by_flow = self.associative.as_ref().map(|it| match it.answer {
            Answer::Unlimited => Some(f64::INFINITY),
            _ => it.load_factor,
        });
        by_path.or(by_flow).flatten().unwrap_or(0.0)
    }

    /// Returns the least load factor \[-\] that is known not to be carried, by the same law as
    /// [`carried`](Self::carried); infinite if none is known.
    pub fn not_carried(&self) -> f64 {
        let by_path = self.path.as_ref().map(|it| it.falls);
        let by_flow = self.associative.as_ref().map(|it| it.bound);
        by_path.or(by_flow).flatten().unwrap_or(f64::INFINITY)
    }
}

/// Computes the limit load of the group that the scene names, or of its only group, by both laws of friction.
///
/// # Errors
/// [`LimitError`] if the scene is wrong or has no group of loads that can grow.
pub fn limit(scene: &Scene) -> Result<Limit, LimitError> {
    limit_by(scene, Laws::Both)
}

/// Computes the limit load by the chosen laws of friction.
///
/// # Errors
/// As [`limit`].
pub fn limit_by(scene: &Scene, laws: Laws) -> Result<Limit, LimitError> {
    limit_observed(scene, laws, &mut |_| ControlFlow::Continue(()))
}

/// Computes the limit load by the chosen laws of friction, with an observer that may end the search by `Break`.
///
/// # Errors
/// As [`limit`].
pub fn limit_observed<'a>(
    scene: &Scene,
    laws: Laws,
    observer: &'a mut LimitObserver<'a>,
) -> Result<Limit, LimitError> {
    let mut watch = Watch::new(observer);
    let mut clock = Clock::default();
    let began = Instant::now();
    scene.check_single()?;
    let group = growing(scene)?;
    let given = Model::from_scene(scene)?;
    // Both laws solve sparse problems, whatever route the scene names.
    Plan::of(&scene.clone().route(Route::Interior), &given).fits()?;
    let model = rigid(given.clone());
    let loads: Vec<bool> = scene.loads.iter().map(|load| load.is_called(&group)).collect();
    let weight = scene.is_weight(&group);
    let structure = LoadedStructure { model: &model, grows: &loads, weight };
    let growth = structure.growth();
    if growth.iter().all(|force| force.abs() <= 0.0) {
        return Err(if weight { LimitError::NoWeight } else { LimitError::NoForce { group } });
    }
    clock.add("model", began);
    let began = Instant::now();
    // The path ends at the bound of associated flow.
    let associative = associative::of(&structure, &growth, &mut watch)?;
    clock.add("associative", began);
    let mut path = None;
    if laws != Laws::Associative {
        let began = Instant::now();
        let given = LoadedStructure { model: &given, ..structure };
        path = Some(path::of(&given, &associative, &mut watch)?);
        clock.add("path", began);
    }
    let mut warnings = warnings(&model, laws);
    warnings.extend(path.as_ref().map(Path::warning));
    let carried = associative.load_factor.unwrap_or(1.0);
    let falls_by_weight = weight && associative.carries_nothing();
    let associative = (laws != Laws::Path).then_some(associative);
    let (by_flow, by_path) = (associative.as_ref(), path.as_ref());
    let seismic = seismic::of(scene, &structure, by_flow, by_path);
    if let (Some(_), Err(because)) = (scene.limit.seismic, &seismic) {
        warnings.push(format!("The seismic check is left out: {because}."));
    }
    let sentence = if falls_by_weight {
        "The structure falls by its own weight: forces within friction carry no part of it (proved)."
            .to_owned()
    } else if watch.is_ended {
        sentence::of_interrupted(&group, associative.as_ref(), path.as_ref())
    } else {
        sentence::of(&group, associative.as_ref(), path.as_ref())
    };
    Ok(Limit {
        title: scene.title.clone(),
        seismic: seismic.ok(),
        falls_by_weight,
        sentence,
        warnings,
        is_interrupted: watch.is_ended,
        model: structure.under(1.0, carried),
        group,
        associative,
        path,
        times: clock.times,
    })
}

/// Returns the name of the growing group: the group that the scene names, else its only group, else its only group with
/// a factor.
///
/// # Errors
/// [`LimitError`] if the scene is wrong, has no load that can grow, or has several groups of which none is named.
pub fn growing(scene: &Scene) -> Result<String, LimitError> {
    scene.check()?;
    if let Some(group) = &scene.limit.group {
        return Ok(group.clone());
    }
    let groups = scene.groups();
    let has_factor = |load: &Load| load.factor.to_bits() != 1_f64.to_bits();
    let scaled = |group: &&String| {
        scene.loads.iter().any(|load| load.group_name() == group.as_str() && has_factor(load))
    };
    let with_factor: Vec<&String> = groups.iter().filter(scaled).collect();
    match (groups.as_slice(), with_factor.as_slice()) {
        ([], _) if scene.gravity.is_some() => Ok(WEIGHT.to_owned()),
        ([], _) => Err(LimitError::NoLoads),
        ([only], _) => Ok(only.clone()),
        (_, [only]) => Ok((*only).clone()),
        _ => Err(LimitError::WhichGroup { groups }),
    }
}

/// A structure and the loads that grow.
#[derive(Clone, Copy)]
struct LoadedStructure<'a> {
    model: &'a Model,
    /// Whether each load of the scene grows.
    grows: &'a [bool],
    /// Whether the weight of the blocks grows, besides the loads.
    weight: bool,
}

impl LoadedStructure<'_> {
    /// Builds the model with all loads that stay multiplied by `stays`, and all loads that grow by `grows`, including
    /// gravity.
    fn under(&self, stays: f64, grows: f64) -> Model {
        let actions = Actions {
            gravity: if self.weight { grows } else { stays },
            loads: self.grows.iter().map(|it| if *it { grows } else { stays }).collect(),
            movements: self.model.supports.iter().map(|support| support.movement).collect(),
        };
        self.model.under(&actions, &[])
    }

    /// Computes the resultants of the growing loads for a load factor of one, `N^T f` of all blocks \[N\].
    fn growth(&self) -> Vec<f64> {
        let model = self.under(0.0, 1.0);
        model.blocks.iter().flat_map(|block| system::resultant(&model, block)).collect()
    }

    fn system(&self, stays: f64, grows: f64) -> Result<(Model, System), LimitError> {
        let model = self.under(stays, grows);
        let system = System::without_factors(&model)?;
        Ok((model, system))
    }
}

fn rigid(mut model: Model) -> Model {
    for block in &mut model.blocks {
        (block.elasticity, block.mesh) = (None, None);
    }
    model
}

fn warnings(model: &Model, laws: Laws) -> Vec<String> {
    let mut list = model.unusual();
    let gaps = model.contacts.iter().filter(|contact| contact.gap > 0.0).count();
    if gaps > 0 && laws != Laws::Path {
        list.push(format!(
            "{gaps} of {} contact points have gaps, which count as closed: the structure may fail at a lower load, but \
             cannot carry a higher one.",
            model.contacts.len()
        ));
    }
    let reached = reached(model);
    if reached < 1.0 - SAME_PLACE {
        list.push(format!(
            "Contact points are inside of joints, and span only {:.0} % of the length of some joint: joints open about these \
             points and not about their ends, so that the structure may carry more. The points reach the ends with \
             `contact.points = \"vertices\"`.",
            100.0 * reached
        ));
    }
    list
}

/// Returns the smallest fraction \[-\] of the length of a joint that the contact points of this joint span.
fn reached(model: &Model) -> f64 {
    let mut reached = vec![[f64::INFINITY, f64::NEG_INFINITY]; model.joints.len()];
    for point in &model.contacts {
        let joint = &model.joints[point.joint.index()];
        let along = joint.to - joint.from;
        let at = (point.position - joint.from).dot(&along) / along.norm_squared();
        let [low, high] = &mut reached[point.joint.index()];
        (*low, *high) = (low.min(at), high.max(at));
    }
    // A joint whose faces are too far apart has no contact points.
    let parts = reached.into_iter().map(|[low, high]| high - low).filter(|part| *part >= 0.0);
    parts.fold(f64::INFINITY, f64::min)
}
