//! A train that crosses a bridge: the limit load at every position, and at the one that governs.

use std::ops::ControlFlow;

use super::{Answer, Laws, Limit, LimitError, LimitObserver, limit_observed};
use crate::scene::Scene;

/// The limit load of a train at one position, by associated flow.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TrainPosition {
    /// The position \[m\].
    pub at: f64,
    /// The outcome; `None` if no axle stands on the bridge.
    pub answer: Option<Answer>,
    /// The largest factor \[-\] for which forces were found.
    pub load_factor: Option<f64>,
    /// The smallest factor \[-\] for which it is proved that there are none.
    pub bound: Option<f64>,
}

/// A train that crosses a bridge.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CrossingTrain {
    /// Its positions, in their order; after an interruption those that were reached.
    pub positions: Vec<TrainPosition>,
    /// The position with the smallest factor; if there is no limit, the first with an axle on the bridge.
    pub critical: usize,
    /// The limit load there, by the chosen laws.
    pub limit: Limit,
}

/// The limit loads of the train of the scene by associated flow, and by both laws at the position that governs.
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
/// // A quarter of the span governs, from either side.
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

/// The limit loads of the train with an observer that may end the search by `Break`: by associated flow at every position, and by
/// the chosen laws at the one that governs.
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
    let mut positions = Vec::new();
    let mut least: Option<(usize, f64)> = None;
    for place in train.places() {
        let position =
            TrainPosition { at: place * unit, answer: None, load_factor: None, bound: None };
        let there = scene.with_train(train, place);
        let limit = match limit_observed(&there, Laws::Associative, &mut |at| observer(at)) {
            // No axle is on the bridge.
            Err(LimitError::NoForce { .. }) => {
                positions.push(position);
                continue;
            }
            limit => limit?,
        };
        if least.is_none_or(|(_, carried)| limit.carried() < carried) {
            least = Some((positions.len(), limit.carried()));
        }
        positions.push(limit.associative.as_ref().map_or(position, |found| TrainPosition {
            answer: Some(found.answer),
            load_factor: found.load_factor,
            bound: found.bound,
            ..position
        }));
        if limit.is_interrupted {
            break;
        }
    }
    let (critical, _) = least.ok_or_else(|| LimitError::NoAxle { over: train.over.clone() })?;
    let there = scene.with_train(train, positions[critical].at / unit);
    let limit = limit_observed(&there, laws, &mut |at| observer(at))?;
    Ok(CrossingTrain { positions, critical, limit })
}
