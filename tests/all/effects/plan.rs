//! What the plan says an effect adds is what the problem is larger by.

use super::common::routes::{ROUTES, routes_for};
use super::scenes::{boxed, elastic, in_mortar, piers, stack};
use super::{built, effect};
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind, Sparse};
use masonry::model::Model;
use masonry::plan::Plan;
use masonry::scene::{self, Films, Joint, Material, Route, Scene};
use masonry::system::System;

/// An effect, and a scene without it and with it; the points of contact are the same but for those that the
/// effect is about.
fn pairs() -> Vec<(&'static str, Scene, Scene)> {
    let rough = || Joint::mu(0.6);
    let dry = |material| stack(material, rough());
    let compliance = in_mortar(elastic(), Films::Compliance);
    let without_mortar = compliance.clone().joint("bed", rough()).gap_limit(0.011);
    let in_stiff_mortar =
        compliance.clone().joint("bed", rough().mortar(0.01, "mortar").stiffness([1e8, 5e7]));
    let rigid = |films| in_mortar(Material::rigid(), films);
    vec![
        ("friction", boxed(elastic(), Joint::mu(0.0)), boxed(elastic(), rough())),
        ("friction", boxed(Material::rigid(), Joint::mu(0.0)), boxed(Material::rigid(), rough())),
        // Faces that stay apart by the thickness of the mortar, as gaps.
        ("mortar films", without_mortar, compliance.clone()),
        ("joint stiffness", dry(elastic()), stack(elastic(), rough().stiffness([1e8, 5e7]))),
        (
            "joint stiffness",
            dry(Material::rigid()),
            stack(Material::rigid(), rough().stiffness([1e8, 5e7])),
        ),
        // In mortar the unknowns are there already.
        ("joint stiffness", compliance.clone(), in_stiff_mortar),
        ("longitudinal film terms", compliance, in_mortar(elastic(), Films::Strips)),
        ("longitudinal film terms", rigid(Films::Compliance), rigid(Films::Strips)),
        ("deformation", rigid(Films::Compliance), in_mortar(elastic(), Films::Compliance)),
        ("contact", piers(0.0), piers(0.011)),
        ("self weight", dry(elastic()), dry(elastic().density(1800.0))),
        ("stresses", dry(elastic()).stresses(false), dry(elastic())),
    ]
}

/// Unknowns as they are built, for a route and a form.
fn unknowns(scene: &Scene, route: Route) -> usize {
    let model = Model::from_scene(scene).unwrap();
    let system = System::new(&model).unwrap();
    if route == Route::Lemke {
        let kind = match scene.solver.form {
            scene::Form::Auto | scene::Form::Coulomb => FormKind::Coulomb,
            scene::Form::StewartTrinkle => FormKind::StewartTrinkle,
            scene::Form::Mixed => FormKind::Mixed,
        };
        let reduction = Reduction::new(&system, None).unwrap();
        return DenseForm::new(kind, &system, &reduction).unwrap().order();
    }
    let problem = Sparse::new(&system).unwrap().problem;
    let strips = model.contacts.iter().any(|it| it.film.is_some_and(|it| it.stretch.is_some()));
    match route {
        Route::Alm if strips => system.bodies.iter().map(|body| body.load.len()).sum(),
        Route::Alm => Sparse::with_free_faces(&system).unwrap().problem.displacements(),
        _ => problem.displacements() + problem.points() + 2 * problem.frictional().len(),
    }
}

/// In every form and on every route; what is off adds nothing and costs nothing.
#[test]
fn the_plan_knows_what_an_effect_adds() {
    let forms = [scene::Form::Coulomb, scene::Form::StewartTrinkle, scene::Form::Mixed];
    let by_pivots = forms.map(|form| (Route::Lemke, form));
    let sparse = ROUTES.into_iter().filter(|route| *route != Route::Lemke);
    let ways = by_pivots.into_iter().chain(sparse.map(|route| (route, scene::Form::Auto)));
    for (route, form) in ways {
        for (name, without, with) in pairs() {
            if !routes_for(&without).contains(&route) {
                continue;
            }
            let planned = |scene: &Scene| {
                let scene = scene.clone().route(route).form(form);
                let plan = built(&scene, route).0;
                assert_eq!(plan.order, unknowns(&scene, route), "{route:?} {form:?} {name}");
                plan
            };
            let (without, with) = (planned(&without), planned(&with));
            let [off, on] = [&without, &with].map(|plan| effect(plan, name));
            let what = format!("{route:?} {form:?}: {off:?} {on:?}");
            // Rigid blocks stretch no film, and of piers that are far apart the floor still is in contact.
            let stays = [is_the_same(&without, &with), name == "contact"];
            assert!(stays.iter().any(|it| *it) || (!off.on && on.on), "{what}");
            let all_friction = 2 * (with.frictional_points - without.frictional_points);
            let added = if name == "contact" && route != Route::Alm {
                // Points that are new have friction too.
                let friction =
                    effect(&with, "friction").unknowns - effect(&without, "friction").unknowns;
                assert!(friction >= all_friction, "{what}");
                on.unknowns - off.unknowns + friction
            } else {
                on.unknowns - off.unknowns
            };
            if route == Route::Alm && on.on && name == "longitudinal film terms" {
                // Whole strips find how far they give way by themselves.
                let gives = effect(&without, "mortar films").unknowns;
                assert_eq!((with.order + gives, on.unknowns), (without.order, 0), "{what}");
                continue;
            }
            assert_eq!(with.order, without.order + added, "{what}");
            for effect in without.effects.iter().chain(&with.effects) {
                assert!(!effect.because.is_empty());
                assert_eq!(effect.cost == "none", !effect.on, "{effect:?}");
                assert!(effect.on || effect.unknowns == 0, "{effect:?}");
            }
        }
    }
}

/// Whether two plans differ in nothing but words.
fn is_the_same(one: &Plan, other: &Plan) -> bool {
    let of = |plan: &Plan| -> Vec<(bool, usize)> {
        plan.effects.iter().map(|effect| (effect.on, effect.unknowns)).collect()
    };
    of(one) == of(other)
}

/// Dense matrices belong to the pivots.
#[test]
fn sparse_routes_plan_no_dense_matrices() {
    for route in ROUTES {
        let (plan, ..) = built(&stack(elastic(), Joint::mu(0.6)), route);
        assert_eq!(effect(&plan, "dense matrices").on, route == Route::Lemke);
        assert_eq!(plan.dense_numbers() > 0, route == Route::Lemke);
    }
}
