//! Combinations of loads: sets of factors, each of which makes a scene of its own.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::load::factor_in;
use super::rules::unwanted;
use super::setters::setters;
use super::{KeyPath, Load, Scene, SceneError};

/// A combination of loads: the factors of loads, and the factor of the weight.
///
/// A load that is named only in other combinations is zero. A load that no combination names acts in full.
///
/// ```
/// use masonry::scene::Combination;
/// let storm = Combination::new("storm").gravity(0.9).load("wind", 1.5);
/// assert_eq!((storm.gravity, storm.loads["wind"]), (0.9, 1.5));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Combination {
    /// Name of the combination, in reports.
    pub name: String,
    /// Factor of the weight of all blocks, and of their masses \[-\]; 1 by default.
    #[serde(default = "super::load::one", skip_serializing_if = "super::load::is_one")]
    pub gravity: f64,
    /// Factors of loads \[-\], by the name of the load or of its group. They multiply the factor of the load itself,
    /// and also its `mass`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub loads: BTreeMap<String, f64>,
}

impl Combination {
    /// Makes a combination in which only the weight acts.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), gravity: 1.0, loads: BTreeMap::new() }
    }

    setters! {
        /// Sets the factor of the weight \[-\].
        pub fn gravity(mut self, factor: f64) { self.gravity = factor }
        /// Sets the factor of a load, or of all loads of a group \[-\].
        pub fn load(mut self, name: &str, factor: f64) {
            self.loads.insert(name.to_owned(), factor);
        }
    }
}

/// A scene or a result of one combination, with the name of the combination.
#[derive(Debug, Clone, PartialEq)]
pub struct Combined<T> {
    /// The name of the combination, followed by ", opposite" if the earthquake acts in the opposite direction.
    pub name: String,
    /// The scene or the result of the combination.
    pub of: T,
}

/// The end of the name of a combination whose earthquake acts in the opposite direction.
pub const OPPOSITE: &str = ", opposite";

impl Scene {
    /// Returns a scene for every combination, in their order; empty without combinations. A combination in which
    /// accelerations act perpendicular to gravity gives two scenes, since an earthquake may act in both directions. In
    /// the second scene all loads of the groups with such accelerations are reversed, except weights with `mass`.
    ///
    /// ```
    /// use masonry::scene::{Combination, Load, Scene};
    /// use masonry::units::Units;
    /// let scene = Scene::new("Wall", Units::SI)
    ///     .load(Load::traction("wind", [0.0, 0.0], [0.0, 3.0], [400.0, 0.0]))
    ///     .load(Load::acceleration("quake", [1.0, 0.0]))
    ///     .combination(Combination::new("storm").load("wind", 1.5))
    ///     .combination(Combination::new("earthquake").load("quake", 1.0));
    /// let scenes = scene.combined();
    /// let names: Vec<&str> = scenes.iter().map(|it| it.name.as_str()).collect();
    /// assert_eq!(names, ["storm", "earthquake", "earthquake, opposite"]);
    /// let factors: Vec<_> = scenes.iter().map(|it| [0, 1].map(|k| it.of.loads[k].factor)).collect();
    /// assert_eq!(factors, [[1.5, 0.0], [0.0, 1.0], [0.0, -1.0]]);
    /// ```
    pub fn combined(&self) -> Vec<Combined<Self>> {
        let given: Vec<Self> = self.combinations.iter().map(|it| self.under(it)).collect();
        let mut list = Vec::new();
        for (combination, scene) in self.combinations.iter().zip(&given) {
            // The scene may already have the opposite direction as a combination of its own.
            let opposite = scene.with_earthquake_opposite().filter(|it| !given.contains(it));
            let opposite = opposite.map(|it| (format!("{}{OPPOSITE}", combination.name), it));
            for (name, mut scene) in
                [(combination.name.clone(), scene.clone())].into_iter().chain(opposite)
            {
                scene.title = format!("{}, {name}", scene.title);
                list.push(Combined { name, of: scene });
            }
        }
        list
    }

    /// Refuses a scene with combinations if one set of loads is required.
    ///
    /// # Errors
    /// [`SceneError`] if the scene has combinations.
    pub(crate) fn check_single(&self) -> Result<(), SceneError> {
        let because = "are several sets of loads; only `masonry solve` and `masonry limit` take all, the latter without \
                       `--range`, `--thickness` and `--train`";
        let otherwise = ", or take one scene of `Scene::combined`";
        let at = KeyPath::default();
        unwanted(!self.combinations.is_empty(), &at, "combinations", because, otherwise)
            .map_err(|fault| fault.locate(self))
    }

    fn under(&self, combination: &Combination) -> Self {
        let mut scene = self.clone();
        scene.combinations.clear();
        let is_named =
            |load| self.combinations.iter().any(|it| factor_in(&it.loads, load).is_some());
        for (load, given) in scene.loads.iter_mut().zip(&self.loads) {
            let otherwise = if is_named(given) { 0.0 } else { 1.0 };
            load.factor *= factor_in(&combination.loads, given).unwrap_or(otherwise);
        }
        // Masses are multiplied like weights, as for loads with `mass`; without masses there is no weight.
        for material in scene.materials.values_mut() {
            let density = material.density.map(|density| density * combination.gravity);
            material.density = density.filter(|density| *density > 0.0);
        }
        scene
    }

    /// Returns the scene with its earthquake in the opposite direction; `None` if no earthquake acts.
    fn with_earthquake_opposite(&self) -> Option<Self> {
        let acts = self.loads.iter().filter(|load| self.acts_across(load) && load.factor != 0.0);
        let groups: BTreeSet<&str> = acts.map(Load::group_name).collect();
        let of_them = |load: &Load| groups.contains(load.group_name());
        (!groups.is_empty()).then(|| self.with_opposite(of_them))
    }
}
