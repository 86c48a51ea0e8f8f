//! How a scene is solved: route, form, limits.

use serde::de::value::StrDeserializer;
use serde::{Deserialize, Deserializer, Serialize};

use crate::data::route::Route;

/// How the complementarity problem is solved.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// Tolerance: the largest residual of a solution \[-\].
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// The route to the solution.
    #[serde(default)]
    pub route: RouteSetting,
    /// The form of the reduced problem; belongs to [`Route::Lemke`].
    #[serde(default)]
    pub form: Form,
    /// Largest number of pivots of one attempt; without it the solver sets a limit by the order.
    /// Belongs to [`Route::Lemke`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_pivots: Option<u32>,
    /// Largest number of steps of one attempt of the interior-point method; 300 by default. Belongs to
    /// [`Route::Interior`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_steps: Option<u32>,
    /// Stiffness of springs on all displacements, relative to that of the blocks \[-\], which are re-centred until
    /// they carry nothing; belongs to [`Route::Qp`], and to [`Route::Pgs`], which always has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub soft: Option<f64>,
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            tolerance: default_tolerance(),
            route: RouteSetting::default(),
            form: Form::default(),
            max_pivots: None,
            max_steps: None,
            soft: None,
        }
    }
}

/// The route that a scene asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum RouteSetting {
    /// The fastest route for the scene, and further ones if it fails.
    #[default]
    Auto,
    /// This one and no other.
    #[serde(untagged)]
    Only(Route),
}

impl RouteSetting {
    /// The name in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Only(route) => route.name(),
        }
    }

    /// Whether this route may be among those that are tried.
    pub fn allows(self, route: Route) -> bool {
        matches!(self, Self::Auto) || self == Self::Only(route)
    }
}

impl From<Route> for RouteSetting {
    fn from(route: Route) -> Self {
        Self::Only(route)
    }
}

/// The error of a name that is no route, in the place of which the names of settings are told.
type Unnamed = serde::de::value::Error;

/// The names of all settings.
const NAMES: &[&str] = &["auto", "forces", "lemke", "interior", "qp", "pgs", "alm"];

impl<'de> Deserialize<'de> for RouteSetting {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let name = String::deserialize(from)?;
        if name == Self::Auto.name() {
            return Ok(Self::Auto);
        }
        let route = Route::deserialize(StrDeserializer::<Unnamed>::new(&name));
        route.map(Self::Only).map_err(|_| serde::de::Error::unknown_variant(&name, NAMES))
    }
}

fn default_tolerance() -> f64 {
    1e-10
}

/// The form in which friction enters the complementarity problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// The Coulomb form first; the mixed form if that ends on rays.
    #[default]
    Auto,
    /// Distances to the two edges of the friction cone (3.27): three unknowns a point.
    Coulomb,
    /// Two friction forces and a slip bound: four unknowns a point.
    StewartTrinkle,
    /// As Stewart-Trinkle, with the rigid amplitudes kept as unknowns.
    Mixed,
}
