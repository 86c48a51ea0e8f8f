//! Panels that hang between two walls, without a floor.
//!
//! Only friction carries them, and only if the walls push: bricks that lie between them without
//! force have to spread under the load before friction can hold them.

use crate::common;

use common::{M_KN, applied_load, assert_admissible, assert_close, solved};
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::{SolveError, solve};
use masonry::data::state::RowState;
use masonry::data::verdict::{Evidence, Verdict};
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind};
use masonry::model::{Model, Plane};
use masonry::scene::{self, Block, Brick, Joint, Load, Material, Route, Scene, Support, Wall};
use masonry::system::{Direction, System};
use masonry::units::Units;
use masonry_report::{summary, table};

const BRICK: Brick = Brick { length: 0.1, height: 0.1 };

/// A square panel of `courses` bricks each way, with a pressure of 10 kN/m2 on top.
fn panel(courses: u32, mu: f64, material: Material) -> Scene {
    let side = f64::from(courses) * BRICK.length;
    Scene::new("Panel without a floor", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("brick", material)
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
        .wall(Wall::running_bond("panel", "brick", BRICK, side, courses).mesh([2, 2]))
        .support(Support::new("left wall", [0.0, 0.0], [0.0, side], "head"))
        .support(Support::new("right wall", [side, 0.0], [side, side], "head"))
        .load(Load::pressure("top", [0.0, side], [side, side], 10.0))
}

fn elastic() -> Material {
    Material::elastic(1e5, 0.15)
}

/// The panel spreads too little to stay: at a friction of 1 both forms end on rays, and what is
/// reported is a motion that opens no joint the wrong way and on which the load does work.
#[test]
fn a_panel_falls_between_smooth_walls() {
    for courses in [2, 3, 4] {
        let panel = panel(courses, 1.0, elastic());
        let outcome = solve(&panel.clone().route(Route::Lemke)).unwrap();
        assert_eq!(outcome.solve.status, Status::RayTermination);
        assert!(outcome.state.is_none() && outcome.checks.is_none());
        assert!(outcome.reactions.is_empty());
        for form in ["coulomb", "mixed"] {
            let mut attempts = outcome.solve.attempts.iter().map(ToString::to_string);
            assert!(attempts.any(|it| it.starts_with(form) && it.contains("ray")), "{form}");
        }
        assert_admissible(&outcome);
        assert_honest(&outcome);
        // Walls that were prestressed could hold it, so that nothing proves that it falls; it moves and does not stop.
        assert_eq!(outcome.judgement.verdict, Verdict::Undecided);
        assert_eq!(outcome.judgement.evidence, Evidence::AdmissibleForces);
        let moved = solve(&panel).unwrap();
        assert_eq!(moved.judgement.verdict, Verdict::Falls);
        assert_eq!(moved.judgement.evidence, Evidence::Motion);
    }
}

/// The report says that nothing was found, and that this is no proof.
fn assert_honest(outcome: &Outcome) {
    assert!(table::report(outcome).contains("No equilibrium found"));
    assert!(summary::reason(outcome).unwrap().contains("not a proof"));
}

/// Rougher walls hold it: then both carry half the load, and no more than friction allows.
#[test]
fn a_panel_hangs_between_rough_walls() {
    for courses in [3, 4] {
        let mu = 2.5;
        let outcome = solved(&panel(courses, mu, elastic()));
        let [left, right] = outcome.reactions.as_slice() else { panic!("two walls") };
        let load = applied_load(&outcome.model).y;
        assert_close(left.fy + right.fy, -load, 1e-9);
        assert_close(left.fx, -right.fx, 1e-9);
        for wall in [left, right] {
            assert!(wall.fy <= mu * wall.fx.abs() * (1.0 + 1e-9), "{wall:?}");
            // The panel is its own mirror image.
            assert_close(wall.fy, -0.5 * load, 1e-9);
        }
    }
}

/// Nothing resists without friction: this is proved, and pivots know it before they begin.
#[test]
fn a_panel_between_frictionless_walls_is_refused() {
    let panel = panel(3, 0.0, elastic());
    let outcome = solve(&panel).unwrap();
    assert_eq!((outcome.solve.status, outcome.solve.proved), (Status::Infeasible, true));
    assert_eq!(outcome.judgement.verdict, Verdict::Falls);
    let error = solve(&panel.route(Route::Lemke)).unwrap_err();
    let SolveError::Free { block, free, .. } = &error else { panic!("{error}") };
    assert!(block.starts_with("panel/") && *free > 0, "{error}");
}

/// A rigid block that just fits between two rigid walls may fall or be jammed: both satisfy the
/// friction law. So a ray with a mechanism is no proof that there is no equilibrium, and what is
/// said must not claim one.
#[test]
fn a_ray_is_no_proof() {
    let scene = panel(1, 1.0, Material::rigid());
    let model = Model::from_scene(&scene).unwrap();
    let system = System::new(&model).unwrap();
    let reduction = Reduction::new(&system, None).unwrap();
    // Four points, each with a thrust of 1 kN and a quarter of the load of 1 kN upwards.
    let jammed = RowState {
        t: system
            .rows
            .iter()
            .map(|row| {
                let contact = &model.contacts[row.contact.index()];
                let tangent = model.joints[contact.joint.index()].tangent();
                if row.direction == Direction::Normal { 1e3 } else { 250.0 * tangent.y }
            })
            .collect(),
        y: vec![0.0; system.rows.len()],
    };
    for kind in [FormKind::Coulomb, FormKind::StewartTrinkle, FormKind::Mixed] {
        let form = DenseForm::new(kind, &system, &reduction).unwrap();
        let (t, y) = form.pairs(&jammed, &[0.0; 3], &[]);
        let residuals = form.problem.residuals(&t, &y);
        assert!(residuals.worst() < 1e-14, "{kind:?}: {residuals:?}");
    }

    for form in [scene::Form::Auto, scene::Form::Coulomb, scene::Form::Mixed] {
        let outcome = solve(&scene.clone().form(form)).unwrap();
        if outcome.solve.status == Status::RayTermination {
            assert_honest(&outcome);
        } else {
            assert_eq!(outcome.solve.status, Status::Solved);
        }
    }
}

/// A stiff, light block falls far before it meets the floor, which it cannot stay on: compliance, load
/// and displacement differ by thirteen orders, and no form may take the fall for an answer.
#[test]
fn a_block_that_slides_away_after_a_fall_is_not_called_solved() {
    let falling = |lateral: f64| {
        let corners = [[0.0, 0.4], [1.0, 0.4], [1.0, 1.4], [0.0, 1.4]];
        let mut scene = Scene::new("fall", Units::SI)
            .thickness(1.0)
            .plane(Plane::Stress)
            .gravity([lateral, -10.0])
            .material("stone", Material::elastic(1e15, 0.2).density(1.0))
            .joint("floor", Joint::mu(0.5))
            .block(Block::new("block", "stone", corners).mesh([1, 1]))
            .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "floor"));
        scene.contact.gap_limit = 0.5;
        scene
    };
    for form in
        [scene::Form::Auto, scene::Form::Coulomb, scene::Form::StewartTrinkle, scene::Form::Mixed]
    {
        let outcome = solve(&falling(6.0).form(form)).unwrap();
        assert_ne!(outcome.solve.status, Status::Solved, "{form:?}");
        let outcome = solve(&falling(0.0).form(form)).unwrap();
        if outcome.solve.status == Status::Solved {
            let checks = outcome.checks.unwrap();
            assert!(checks.force_balance <= 1e-9 && checks.moment_balance <= 1e-9, "{form:?}");
        }
    }
}

/// A block held by friction beside one on a smooth floor: the tangents see nothing of the motion that
/// is free, and rounding must not pass for seeing.
#[test]
fn a_free_block_is_named_beside_one_that_is_held() {
    let square = |x: f64| [[x, 0.7], [x + 1.0, 0.7], [x + 1.0, 1.7], [x, 1.7]];
    let scene = Scene::new("two blocks", Units::SI)
        .thickness(1.0)
        .gravity([0.0, -10.0])
        .material("stone", Material::rigid().density(1000.0))
        .joint("rough", Joint::mu(0.5))
        .joint("smooth", Joint::mu(0.0))
        .block(Block::new("held", "stone", square(0.3)))
        .block(Block::new("loose", "stone", square(3.3)))
        .support(Support::new("floor", [0.3, 0.7], [1.3, 0.7], "rough"))
        .support(Support::new("left", [0.3, 0.7], [0.3, 1.7], "rough"))
        .support(Support::new("right", [1.3, 0.7], [1.3, 1.7], "rough"))
        .support(Support::new("ice", [2.3, 0.7], [5.3, 0.7], "smooth"));
    let error = solve(&scene.clone().route(Route::Lemke)).unwrap_err();
    assert!(matches!(&error, SolveError::Free { block, .. } if block == "loose"), "{error}");
    // Nothing pushes it, so that it stands.
    assert_eq!(solve(&scene).unwrap().judgement.verdict, Verdict::Stands);
}

#[test]
fn what_fits_into_no_memory_is_refused() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let scene = Scene::new("too fine", Units::SI)
        .thickness(1.0)
        .plane(Plane::Stress)
        .material("stone", Material::elastic(1e10, 0.2))
        .joint("floor", Joint::mu(0.5))
        .block(Block::new("block", "stone", corners).mesh([1000, 1000]))
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "floor"));
    let error = solve(&scene.route(Route::Lemke)).unwrap_err();
    assert!(matches!(error, SolveError::TooLarge { .. }), "{error}");
}
