//! Limit loads in both directions of the growing load, since an earthquake acts in both.

use serde::Serialize;

use super::{Laws, Limit, LimitError, LimitObserver, limit_observed};
use crate::scene::Scene;

/// The direction under which the structure fails first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Governs {
    /// The direction of the scene.
    Given,
    /// The opposite direction.
    Opposite,
    /// Both directions carry the same, as far as their limits are known.
    Both,
    /// The limit of one of the directions was not decided.
    Unknown,
}

/// The limit loads of both directions.
#[derive(Debug, Clone)]
pub struct Directions {
    /// The load in the direction that it has in the scene.
    pub given: Limit,
    /// The load in the opposite direction.
    pub opposite: Limit,
    /// The direction that carries less.
    pub governs: Governs,
}

impl Directions {
    /// The limit load of the direction opposite to that of the scene.
    ///
    /// # Errors
    /// As [`limit`](super::limit()).
    pub fn opposite<'a>(
        given: &Limit,
        scene: &Scene,
        laws: Laws,
        observer: &'a mut LimitObserver<'a>,
    ) -> Result<Limit, LimitError> {
        let group = &given.group;
        let mut opposite = limit_observed(&scene.reversed(group), laws, observer)?;
        opposite
            .warnings
            .push(format!("\"{group}\" acts here against its direction in the scene."));
        Ok(opposite)
    }

    /// The limit loads of both directions, with a warning if the one that does not govern has a worse seismic check.
    pub fn of(mut given: Limit, mut opposite: Limit) -> Self {
        let governs = if !(given.is_solved() && opposite.is_solved()) {
            Governs::Unknown
        } else if given.not_carried() <= opposite.carried() && given.carried().is_finite() {
            Governs::Given
        } else if opposite.not_carried() <= given.carried() && opposite.carried().is_finite() {
            Governs::Opposite
        } else {
            Governs::Both
        };
        if governs == Governs::Opposite {
            opposite.compare_check("the given direction", &given);
        } else {
            given.compare_check("the opposite direction", &opposite);
        }
        Self { given, opposite, governs }
    }

    /// The limit of the direction that governs, or of the direction of the scene if none does.
    pub fn governing(&self) -> &Limit {
        if self.governs == Governs::Opposite { &self.opposite } else { &self.given }
    }
}
