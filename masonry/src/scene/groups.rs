//! Groups of loads: their names, and the meaning of each name.

use std::collections::BTreeSet;

use nalgebra::Vector2;

use super::{Load, Scene};
use crate::geometry::SAME_PLACE;

/// The name that stands for the weight of the blocks as the growing load.
pub(crate) const WEIGHT: &str = "gravity";

impl Scene {
    /// Returns whether a name stands for the weight of the blocks: it is "gravity", and no load has this name.
    pub fn is_weight(&self, name: &str) -> bool {
        name == WEIGHT
            && self.gravity.is_some()
            && !self.loads.iter().any(|load| load.is_called(name))
    }

    /// Returns whether a group contains an earthquake, which may act in both directions.
    pub fn is_earthquake(&self, group: &str) -> bool {
        self.loads.iter().any(|load| load.is_called(group) && self.acts_across(load))
    }

    /// Returns whether a load is an acceleration with a component perpendicular to gravity; without gravity,
    /// perpendicular to the vertical axis.
    pub(super) fn acts_across(&self, load: &Load) -> bool {
        let Some(acceleration) = load.acceleration.map(Vector2::from) else { return false };
        let gravity = self.gravity.map(Vector2::from).and_then(|it| it.try_normalize(0.0));
        let across = acceleration.perp(&gravity.unwrap_or(-Vector2::y())).abs();
        across > SAME_PLACE * acceleration.norm()
    }

    /// Returns whether a load or a group has a factor other than zero; the weight always acts.
    pub fn acts(&self, name: &str) -> bool {
        let acts = |load: &Load| load.is_called(name) && load.factor != 0.0;
        self.is_weight(name) || self.loads.iter().any(acts)
    }

    /// Returns the scene with the loads of a name or group in the opposite direction. Loads with a `mass` are weights
    /// and keep their direction.
    #[must_use]
    pub fn reversed(&self, group: &str) -> Self {
        self.with_opposite(|load| load.is_called(group))
    }

    /// Returns the scene with the loads for which `is_of` is true, except weights, in the opposite direction.
    pub(super) fn with_opposite(&self, is_of: impl Fn(&Load) -> bool) -> Self {
        let mut scene = self.clone();
        let members = scene.loads.iter_mut().filter(|load| is_of(load) && !load.has_mass());
        members.for_each(|load| load.factor = -load.factor);
        scene
    }

    /// Returns the names of all groups, in the order of their first loads.
    pub(crate) fn groups(&self) -> Vec<String> {
        let mut met = BTreeSet::new();
        let names = self.loads.iter().map(Load::group_name);
        names.filter(|name| met.insert(*name)).map(str::to_owned).collect()
    }
}
