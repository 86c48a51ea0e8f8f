//! Limit analysis: the factor of a group of loads at which a structure fails.
//!
//! Loads that are not of the group act in full, and the stages of the scene are not looked at. Blocks are rigid, which
//! changes no limit load of associated flow, and gaps are taken for closed.
//!
//! ```
//! use masonry::analysis::limit::{Answer, limit};
//! use masonry::scene::{Block, Joint, Load, Material, Scene, Support};
//! use masonry::units::Units;
//!
//! // It tips over at a fifth of gravity, its breadth over its height.
//! let scene = Scene::new("A block that is pushed", Units::SI)
//!     .thickness(1.0)
//!     .gravity([0.0, -10.0])
//!     .material("stone", Material::rigid().density(1000.0))
//!     .joint("floor", Joint::mu(0.7))
//!     .block(Block::new("block", "stone", [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]))
//!     .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "floor"))
//!     .load(Load::acceleration("quake", [10.0, 0.0]));
//! let limit = limit(&scene)?;
//! assert_eq!(limit.associative.answer, Answer::Fails);
//! assert!((limit.associative.load_factor.unwrap() - 0.2).abs() < 1e-6);
//! # Ok::<(), masonry::analysis::limit::LimitError>(())
//! ```

mod associative;
mod error;
mod path;
mod range;
mod sentence;
mod thickness;

use std::time::Instant;

pub use associative::{Answer, Associative};
pub use error::LimitError;
pub use path::{Change, Event, Path, Stand};
pub use range::{Extremes, Range, ranges};
pub use thickness::{Thickness, least_thickness};

use crate::history::Actions;
use crate::method::info::PhaseTime;
use crate::model::Model;
use crate::scene::{Load, Scene};
use crate::system::{self, System};

/// What is known of the limit load of a scene.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Limit {
    /// Title of the scene.
    pub title: String,
    /// The structure with rigid blocks, under the load factor; without one, under all loads in full.
    pub model: Model,
    /// The load or the group of loads that grows.
    pub group: String,
    /// The limit load of associated flow.
    pub associative: Associative,
    /// The answer in the words of an engineer.
    pub sentence: String,
    /// What limits the meaning of the answer.
    pub warnings: Vec<String>,
    /// Time of every phase.
    pub times: Vec<PhaseTime>,
}

/// The limit load of the group that the scene names, or of its only one.
///
/// # Errors
/// [`LimitError`] when the scene is wrong or has no such group.
pub fn limit(scene: &Scene) -> Result<Limit, LimitError> {
    let began = Instant::now();
    let group = group(scene)?;
    let model = rigid(Model::from_scene(scene)?);
    let loads: Vec<bool> = scene.loads.iter().map(|load| load.is_called(&group)).collect();
    let structure = Structure { model: &model, grows: &loads };
    let growth = structure.growth();
    if growth.iter().all(|force| force.abs() <= 0.0) {
        return Err(LimitError::NoForce { group });
    }
    let modelled = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let associative = associative::of(&structure, &growth)?;
    let times = [("model", modelled), ("associative", began.elapsed().as_secs_f64())];
    let times = times.map(|(phase, seconds)| PhaseTime { phase: phase.to_owned(), seconds });
    Ok(Limit {
        title: scene.title.clone(),
        sentence: sentence::of(&group, &associative),
        warnings: warnings(&model),
        model: structure.under(1.0, associative.load_factor.unwrap_or(1.0)),
        group,
        associative,
        times: times.into(),
    })
}

/// The group that grows: that which the scene names, else its only one, else the only one with a factor.
fn group(scene: &Scene) -> Result<String, LimitError> {
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
        ([], _) => Err(LimitError::NoLoads),
        ([only], _) => Ok(only.clone()),
        (_, [only]) => Ok((*only).clone()),
        _ => Err(LimitError::WhichGroup { groups }),
    }
}

/// A structure of rigid blocks and the loads that grow.
struct Structure<'a> {
    model: &'a Model,
    /// In the order of the scene.
    grows: &'a [bool],
}

impl Structure<'_> {
    /// The structure with these factors of gravity and of loads that do not grow, and of loads that do.
    fn under(&self, stays: f64, grows: f64) -> Model {
        let actions = Actions {
            gravity: stays,
            loads: self.grows.iter().map(|it| if *it { grows } else { stays }).collect(),
            movements: self.model.supports.iter().map(|support| support.movement).collect(),
        };
        self.model.under(&actions, &[])
    }

    /// The resultants of the loads that grow, `N^T f` of all blocks \[N\].
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

fn warnings(model: &Model) -> Vec<String> {
    let mut list = model.unusual();
    let gaps = model.contacts.iter().filter(|contact| contact.gap > 0.0).count();
    if gaps > 0 {
        list.push(format!(
            "{gaps} of {} contact points are apart and were taken for closed: the structure may fail earlier, but not \
             carry more.",
            model.contacts.len()
        ));
    }
    list
}
