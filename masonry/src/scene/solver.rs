//! Settings of the solver in a scene: route, form and limits.

use serde::{Deserialize, Deserializer, Serialize};

use crate::data::route::Route;

/// Settings of the solver of the complementarity problem.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct SolverSettings {
    /// Largest residual of a solution \[-\].
    pub tolerance: f64,
    /// The route to the solution: a form of the problem with a method that solves it.
    pub route: RouteSetting,
    /// The form of the reduced complementarity problem; used only by [`Route::Lemke`].
    pub form: Form,
    /// Largest number of pivots of one attempt; by default it depends on the order of the problem. Used only by
    /// [`Route::Lemke`].
    pub max_pivots: Option<u32>,
    /// Largest number of steps of one attempt of the interior-point method; 300 by default. Used only by
    /// [`Route::Interior`].
    pub max_steps: Option<u32>,
    /// Stiffness of springs on all displacements, relative to the stiffness of the blocks \[-\]. The springs are
    /// re-centred until they carry nothing. Used by [`Route::Qp`], and by [`Route::Pgs`], which always has springs.
    pub soft: Option<f64>,
}

impl Default for SolverSettings {
    fn default() -> Self {
        let (route, form) = (RouteSetting::default(), Form::default());
        Self { tolerance: 1e-10, route, form, max_pivots: None, max_steps: None, soft: None }
    }
}

/// The setting of the route: automatic, or a single one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum RouteSetting {
    /// The fastest route for the scene, and other routes if it fails.
    #[default]
    Auto,
    /// Only this route.
    #[serde(untagged)]
    Only(Route),
}

/// The names of all settings in scenes.
const NAMES: &[&str] = &["auto", "forces", "lemke", "interior", "qp", "pgs", "alm"];

impl RouteSetting {
    /// Returns the name of the setting in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Only(route) => route.name(),
        }
    }

    /// Returns whether the setting allows a route to be tried.
    pub fn allows(self, route: Route) -> bool {
        matches!(self, Self::Auto) || self == Self::Only(route)
    }
}

impl From<Route> for RouteSetting {
    fn from(route: Route) -> Self {
        Self::Only(route)
    }
}

impl<'de> Deserialize<'de> for RouteSetting {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let name = String::deserialize(from)?;
        if name == Self::Auto.name() {
            return Ok(Self::Auto);
        }
        let route = Route::ALL.into_iter().find(|it| it.name() == name);
        route.map(Self::Only).ok_or_else(|| serde::de::Error::unknown_variant(&name, NAMES))
    }
}

/// The form in which friction enters the complementarity problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// The Coulomb form first; the mixed form if the Coulomb form ends on rays.
    #[default]
    Auto,
    /// Distances of the force to the two edges of the friction cone (3.27): three unknowns per point.
    Coulomb,
    /// Two friction forces and a slip bound: four unknowns per point.
    StewartTrinkle,
    /// The Stewart-Trinkle form in which the rigid amplitudes remain as unknowns.
    Mixed,
}
