//! A train that crosses a bridge: the limit load at every position, and at the worst position.

use std::ops::ControlFlow;

use super::{Answer, Laws, Limit, LimitError, LimitObserver, Path, limit_observed};
use crate::scene::Scene;

/// The warning if the path was followed only at the worst position.
const OF_ONE_POSITION: &str = "The position is the one at which associated flow carries least; Coulomb's friction may \
                               carry less at another. `--law path` follows the load at every position, which takes \
                               longer.";

/// The limit load of a train at one position, by the law of friction of [`CrossingTrain::by_path`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TrainPosition {
    /// The position of the train \[m\].
    pub at: f64,
    /// The outcome of the limit analysis at this position; `None` if no axle stands on the bridge.
    pub answer: Option<Answer>,
    /// The largest load factor \[-\] that is carried; `None` if none is known.
    pub load_factor: Option<f64>,
    /// The smallest load factor \[-\] that is known not to be carried; `None` if none is known.
    pub bound: Option<f64>,
}

impl TrainPosition {
    fn of(at: f64, limit: &Limit) -> Self {
        if let Some(path) = &limit.path {
            let Path { load_factor, falls, .. } = *path;
            return Self { at, answer: Some(path.answer()), load_factor, bound: falls };
        }
        let found = limit.associative.as_ref();
        Self {
            at,
            answer: found.map(|it| it.answer),
            load_factor: found.and_then(|it| it.load_factor),
            bound: found.and_then(|it| it.bound),
        }
    }
}

/// The limit loads of a train that crosses a bridge.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CrossingTrain {
    /// The positions of the train in their order, up to the last one that was computed.
    pub positions: Vec<TrainPosition>,
    /// Whether the limit loads at all positions are those of Coulomb's friction along paths, instead of those of
    /// associated flow.
    pub by_path: bool,
    /// The index of the worst position, with the smallest load factor; if there is no limit, the first position with an
    /// axle on the bridge.
    pub critical: usize,
    /// The limit load at the worst position, by the chosen laws of friction.
    pub limit: Limit,
}

/// Computes the limit loads of the train of the scene: by associated flow at all positions, and by both laws of
/// friction at the position with the smallest limit load.
///
/// ```
/// use masonry::analysis::limit::train;
/// use masonry::scene::{Arch, Joint, Material, Scene, Train};
/// use masonry::units::Units;
///
/// let scene = Scene::new("A bridge", Units::SI)
///     .thickness(1.0)
///     .gravity([0.0, -10.0])
///     .material("stone", Material::rigid().density(2000.0))
///     .joint("joint", Joint::mu(0.7))
///     .arch(Arch::segmental("arch", "stone", 4.0, 1.0, 0.4, 11).joint("joint").springing("joint"))
///     .train(Train::new("arch", [[0.0, 1e4]], [0.0, 4.0]).positions(5));
/// let crossing = train(&scene)?;
/// // The worst place is a quarter of the span, from either side.
/// let at = crossing.positions[crossing.critical].at;
/// assert!(at == 1.0 || at == 3.0);
/// # Ok::<(), masonry::analysis::limit::LimitError>(())
/// ```
///
/// # Errors
/// As [`train_observed`].
pub fn train(scene: &Scene) -> Result<CrossingTrain, LimitError> {
    train_observed(scene, Laws::Both, &mut |_| ControlFlow::Continue(()))
}

/// Computes the limit loads of the train of the scene, with an observer that may end the search by `Break`.
///
/// All positions are computed along paths if [`Laws::Path`] is chosen, and otherwise by associated flow, which is far
/// quicker. [`Laws::Both`] follows a path only at the worst position, and adds a warning.
///
/// # Errors
/// [`LimitError`] when the scene is wrong, has no train, or has a train that is never on the bridge.
pub fn train_observed(
    scene: &Scene,
    laws: Laws,
    observer: &mut LimitObserver<'_>,
) -> Result<CrossingTrain, LimitError> {
    scene.check()?;
    let train = scene.limit.train.as_ref().ok_or(LimitError::NoTrain)?;
    let unit = scene.units.length_to_si();
    let of_all = if laws == Laws::Both { Laws::Associative } else { laws };
    let mut positions = Vec::new();
    let mut least: Option<(usize, Limit)> = None;
    for place in train.places() {
        let at = place * unit;
        let limit = match limit_observed(&scene.with_train(train, place), of_all, &mut |it| {
            observer(it)
        }) {
            // No axle stands on the bridge.
            Err(LimitError::NoForce { .. }) => {
                positions.push(TrainPosition { at, answer: None, load_factor: None, bound: None });
                continue;
            }
            limit => limit?,
        };
        let number = positions.len();
        positions.push(TrainPosition::of(at, &limit));
        let is_interrupted = limit.is_interrupted;
        if least.as_ref().is_none_or(|(_, least)| limit.carried() < least.carried()) {
            least = Some((number, limit));
        }
        if is_interrupted {
            break;
        }
    }
    let (critical, mut limit) =
        least.ok_or_else(|| LimitError::NoAxle { over: train.over.clone() })?;
    if laws != of_all {
        let there = scene.with_train(train, positions[critical].at / unit);
        limit = limit_observed(&there, laws, &mut |at| observer(at))?;
        limit.warnings.push(OF_ONE_POSITION.to_owned());
    }
    let by_path = of_all == Laws::Path;
    Ok(CrossingTrain { positions, by_path, critical, limit })
}
