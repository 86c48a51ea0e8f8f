//! The solver of a scene: route, form, limits.

use serde::{Deserialize, Deserializer, Serialize};

use crate::data::route::Route;

/// Settings of the solver of the complementarity problem.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct SolverSettings {
    /// Tolerance: the largest residual of a solution \[-\].
    pub tolerance: f64,
    /// The route to the solution.
    pub route: RouteSetting,
    /// The form of the reduced problem; belongs to [`Route::Lemke`].
    pub form: Form,
    /// Largest number of pivots of one attempt; by default the solver sets a limit by the order. Belongs to
    /// [`Route::Lemke`].
    pub max_pivots: Option<u32>,
    /// Largest number of steps of one attempt of the interior-point method; 300 by default. Belongs to [`Route::Interior`].
    pub max_steps: Option<u32>,
    /// Stiffness of springs on all displacements, relative to that of the blocks \[-\], which are re-centred until they
    /// carry nothing; belongs to [`Route::Qp`], and to [`Route::Pgs`], which always has springs.
    pub soft: Option<f64>,
}

impl Default for SolverSettings {
    fn default() -> Self {
        let (route, form) = (RouteSetting::default(), Form::default());
        Self { tolerance: 1e-10, route, form, max_pivots: None, max_steps: None, soft: None }
    }
}

/// The route that a scene requests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum RouteSetting {
    /// The fastest route for the scene, and further ones if it fails.
    #[default]
    Auto,
    /// This route and no other.
    #[serde(untagged)]
    Only(Route),
}

/// The names of all settings.
const NAMES: &[&str] = &["auto", "forces", "lemke", "interior", "qp", "pgs", "alm"];

impl RouteSetting {
    /// The name in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Only(route) => route.name(),
        }
    }

    /// Whether a route may be tried.
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
    /// Distances to the two edges of the friction cone (3.27): three unknowns a point.
    Coulomb,
    /// Two friction forces and a slip bound: four unknowns a point.
    StewartTrinkle,
    /// The Stewart-Trinkle form with the rigid amplitudes kept as unknowns.
    Mixed,
}
