//! A sliding shoe (`Code_Aster`, test SSNV503): a block of 40 x 20 mm hangs 2 mm above a rigid plane, is
//! pressed on it by `N` = 300 N/mm2 and pushed to the side, with friction of 0.3. A push of `0.99 mu N` moves
//! it not at all; one of `1.01 mu N` pushes it 9 mm against a spring of 4 N/mm.

use crate::common;

use common::routes::{answer_by, rounding, routes_for, solved_by};
use common::{assert_close, displacements, rectangle, state};
use lcp::Status;
use masonry::analysis::outcome::{Outcome, PointState, PointStatus};
use masonry::analysis::solve::solve;
use masonry::model::{Body, Plane};
use masonry::scene::{Joint, Load, Material, Route, Scene, Support};
use masonry::units::{ForceUnit, LengthUnit, Units};

const MM_N: Units = Units { length: LengthUnit::Mm, force: ForceUnit::N };

const GAP: f64 = 2.0;
const MU: f64 = 0.3;
/// N per mm of thickness.
const NORMAL_FORCE: f64 = 12_000.0;
/// N/mm.
const SPRING: f64 = 4.0;

/// The shoe, and an elastic block of the spring's stiffness between it and a wall, held between smooth
/// guides. All other joints but that of shoe and plane are smooth too.
fn shoe(material: Material, push: f64) -> Scene {
    let (low, high) = (GAP, GAP + 20.0);
    // As long as high, so that E is the stiffness for each mm of thickness.
    Scene::new("Sliding shoe", MM_N)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("shoe", material)
        .material("spring", Material::elastic(SPRING, 0.0))
        .joint("plane", Joint::mu(MU))
        .joint("head", Joint::mu(0.0))
        .block(rectangle("shoe", "shoe", [0.0, 40.0], [low, high]).mesh([4, 2]))
        .block(rectangle("spring", "spring", [40.0, 60.0], [low, high]).mesh([2, 2]))
        .support(Support::new("plane", [0.0, 0.0], [40.0, 0.0], "plane"))
        .support(Support::new("wall", [60.0, low], [60.0, high], "head"))
        .support(Support::new("lower guide", [40.0, low], [60.0, low], "head"))
        .support(Support::new("upper guide", [40.0, high], [60.0, high], "head"))
        .load(Load::pressure("normal", [0.0, high], [40.0, high], NORMAL_FORCE / 40.0))
        .load(Load::pressure("push", [0.0, low], [0.0, high], push))
        .gap_limit(1.01 * GAP)
}

/// The points between shoe and plane.
fn on_plane(outcome: &Outcome) -> Vec<PointState> {
    let is_on_plane = |joint: usize| match outcome.model.joints[joint].a {
        Body::Support(id) => outcome.model.supports[id.index()].name == "plane",
        Body::Block(_) => false,
    };
    let points = outcome.model.contacts.iter().zip(&state(outcome).contacts);
    points.filter(|(point, _)| is_on_plane(point.joint.index())).map(|(_, it)| *it).collect()
}

#[test]
fn a_push_below_friction_does_not_move_it() {
    let scene = shoe(Material::rigid(), 178.2);
    for route in routes_for(&scene) {
        let outcome = answer_by(&scene, route);
        let Some(outcome) = outcome else { continue };
        let near = rounding(route);
        for u in displacements(&outcome, "shoe") {
            assert!(u.x.abs() < near * 1e-3 * GAP && (u.y * 1e3 + GAP).abs() < near * GAP, "{u}");
        }
        let points = on_plane(&outcome);
        assert!(points.iter().all(|it| it.status == PointStatus::Stick), "{points:?}");
        let [normal, tangent] = sums(&points);
        assert_close(normal, NORMAL_FORCE, near);
        assert_close(tangent.abs(), 0.99 * MU * NORMAL_FORCE, near);
    }
}

#[test]
fn a_push_above_friction_loads_the_spring() {
    let scene = shoe(Material::rigid(), 181.8);
    for route in routes_for(&scene) {
        let outcome = answer_by(&scene, route);
        let Some(outcome) = outcome else { continue };
        let near = rounding(route);
        for u in displacements(&outcome, "shoe") {
            // 0.01 mu N / k.
            assert_close(u.x * 1e3, 9.0, 100.0 * near);
            assert_close(u.y * 1e3, -GAP, near);
        }
        let points = on_plane(&outcome);
        assert!(points.iter().all(|it| it.status == PointStatus::Slip), "{points:?}");
        let [normal, tangent] = sums(&points);
        assert_close(normal, NORMAL_FORCE, near);
        assert_close(tangent.abs(), MU * NORMAL_FORCE, near);
        for it in &state(&outcome).stresses {
            // N/mm2 are MPa.
            assert_close(it.sigma[0] / 1e6, -9.0 * SPRING / 20.0, 100.0 * near);
        }
        let wall = outcome.reactions.iter().find(|it| it.support == "wall").unwrap();
        assert_close(wall.fx, -36.0, 100.0 * near);
    }
}

/// An elastic shoe slides like the rigid one, but for its own strain, which falls with its stiffness. Routes
/// without the equations of the answer stall: one body is 1e4 to 1e7 times as stiff as the other.
#[test]
fn a_stiff_shoe_slides_like_a_rigid_one() {
    for route in [Route::Lemke, Route::Interior, Route::Qp] {
        let error = |young: f64| {
            let outcome = solved_by(&shoe(Material::elastic(young, 0.0), 181.8), route);
            let points = on_plane(&outcome);
            assert!(points.iter().all(|it| it.status == PointStatus::Slip));
            let slips = points.iter().map(|it| it.y_t.abs() * 1e3);
            slips.map(|slip| (slip - 9.0).abs()).fold(0.0, f64::max)
        };
        let errors = [1e5, 1e6, 1e7].map(error);
        assert!(errors[0] < 0.1, "{errors:?}");
        for pair in errors.windows(2) {
            let rate = (pair[0] / pair[1]).log10();
            assert!((rate - 1.0).abs() < 0.01, "{route:?}: {errors:?}");
        }
    }
}

/// The residual does not grow with the ratio of the stiffnesses, and a soft spring is not taken for none.
#[test]
fn a_shoe_far_stiffer_than_the_spring_is_held() {
    for young in [1e6, 1e7, 2.5e7] {
        let outcome = solved_by(&shoe(Material::elastic(young, 0.0), 181.8), Route::Interior);
        assert!(outcome.solve.residuals.worst() < 1e-14, "{young}: {:?}", outcome.solve);
        for it in on_plane(&outcome) {
            assert_close(it.y_t.abs() * 1e3, 9.0, 0.01);
        }
    }
    let scene = shoe(Material::elastic(1e9, 0.0), 181.8).route(Route::Interior);
    assert_ne!(solve(&scene).unwrap().solve.status, Status::NoEquilibrium);
}

fn sums(points: &[PointState]) -> [f64; 2] {
    points.iter().fold([0.0; 2], |[n, t], it| [n + it.t_n, t + it.t_t])
}
