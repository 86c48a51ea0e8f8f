//! Limit loads in both directions of the growing load, since an earthquake acts in both.

use serde::Serialize;

use super::{Laws, Limit, LimitError, LimitObserver, limit_observed};
use crate::scene::Scene;

/// The direction of the growing load under which the structure fails first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Governs {
    /// The direction that the load has in the scene.
    Given,
    /// The direction opposite to that of the load in the scene.
    Opposite,
    /// Neither direction: both limit loads are equal, as far as they are known.
    Both,
    /// Not known: the limit load of one direction was not decided.
    Unknown,
}

/// The limit loads in both directions of the growing load.
#[derive(Debug, Clone)]
pub struct Directions {
    /// The limit load in the direction that the growing load has in the scene.
    pub given: Limit,
    /// The limit load in the direction opposite to that of the growing load in the scene.
    pub opposite: Limit,
    /// The direction with the smaller limit load.
    pub governs: Governs,
}

impl Directions {
    /// Computes the limit load in the direction opposite to that of the growing load in the scene.
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

    /// Compares the limit loads of both directions, and adds a warning if the direction that does not govern has a
    /// worse seismic check.
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

    /// Returns the limit load of the direction that governs, or of the direction of the scene if none does.
    pub fn governing(&self) -> &Limit {
        if self.governs == Governs::Opposite { &self.opposite } else { &self.given }
    }
}
