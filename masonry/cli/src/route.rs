//! Routes as values of command-line options.

use clap::ValueEnum;
use clap::builder::PossibleValue;
use masonry::scene::{Route, RouteSetting};

/// The value of the option `--route`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RouteValue(pub(crate) RouteSetting);

/// One value in the list of the option `--routes`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OneRoute(pub(crate) Route);

const AUTO: RouteValue = RouteValue(RouteSetting::Auto);
const ROUTES: [OneRoute; Route::ALL.len()] = {
    let mut routes = [OneRoute(Route::Forces); Route::ALL.len()];
    let mut at = 0;
    while at < routes.len() {
        routes[at] = OneRoute(Route::ALL[at]);
        at += 1;
    }
    routes
};
const SETTINGS: [RouteValue; Route::ALL.len() + 1] = {
    let mut settings = [AUTO; Route::ALL.len() + 1];
    let mut at = 0;
    while at < Route::ALL.len() {
        settings[at + 1] = RouteValue(RouteSetting::Only(Route::ALL[at]));
        at += 1;
    }
    settings
};

impl ValueEnum for RouteValue {
    fn value_variants<'a>() -> &'a [Self] {
        &SETTINGS
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(match self.0 {
            RouteSetting::Auto => PossibleValue::new("auto")
                .help("The fastest route for the scene, and further ones if it fails"),
            RouteSetting::Only(route) => possible(route),
        })
    }
}

impl ValueEnum for OneRoute {
    fn value_variants<'a>() -> &'a [Self] {
        &ROUTES
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(possible(self.0))
    }
}

fn possible(route: Route) -> PossibleValue {
    PossibleValue::new(route.name()).help(match route {
        Route::Forces => {
            "Forces within friction that balance the loads, by one convex program, or a proof that there are no such \
             forces; for rigid blocks without gaps"
        }
        Route::Lemke => {
            "Lemke's method on the problem reduced to contact forces, with dense matrices"
        }
        Route::Interior => {
            "The interior-point method on the sparse problem with all displacements"
        }
        Route::Qp => {
            "Convex quadratic programs on the sparse problem; a sequence of them for friction"
        }
        Route::Pgs => {
            "Projected Gauss-Seidel on the sparse problem; springs hold the blocks, and are re-centred until they \
             carry nothing"
        }
        Route::Alm => {
            "The augmented Lagrangian method on the sparse problem, for elastic blocks only"
        }
    })
}
