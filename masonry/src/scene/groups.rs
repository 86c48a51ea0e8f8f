//! Groups of loads: their names, and what each name means.

use std::collections::BTreeSet;

use super::{Load, Scene};

/// The name by which the weight of the blocks is the load that grows.
pub(crate) const WEIGHT: &str = "gravity";

impl Scene {
    /// Whether a name means the weight of the blocks, as "gravity" does if no load is called so.
    pub fn is_weight(&self, name: &str) -> bool {
        name == WEIGHT
            && self.gravity.is_some()
            && !self.loads.iter().any(|load| load.is_called(name))
    }

    /// Whether a group has an earthquake, which comes from both sides.
    pub fn is_earthquake(&self, group: &str) -> bool {
        self.loads.iter().any(|load| load.is_called(group) && load.is_earthquake())
    }

    /// Whether a load or a group has a factor other than zero; the weight always acts.
    pub fn acts(&self, name: &str) -> bool {
        let acts = |load: &Load| load.is_called(name) && load.factor != 0.0;
        self.is_weight(name) || self.loads.iter().any(acts)
    }

    /// The scene with the loads of a name or group in the opposite direction.
    #[must_use]
    pub fn reversed(&self, group: &str) -> Self {
        let mut scene = self.clone();
        let members = scene.loads.iter_mut().filter(|load| load.is_called(group));
        members.for_each(|load| load.factor = -load.factor);
        scene
    }

    /// The names of all groups, in the order of their first loads.
    pub(crate) fn groups(&self) -> Vec<String> {
        let mut met = BTreeSet::new();
        let names = self.loads.iter().map(Load::group_name);
        names.filter(|name| met.insert(*name)).map(str::to_owned).collect()
    }
}
