//! Blocks, stacks and wedges of rigid and elastic stone, against answers in closed form.

use crate::common;

use common::routes::{answer_by, rounding, routes_for, solved_by, stands_by};
use common::{
    GRAVITY, M_KN, assert_admissible, assert_close, critical, joint_resultant, rectangle, solved,
    stands,
};
use lcp::Status;
use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::data::verdict::Verdict;
use masonry::ids::{BlockId, SupportId};
use masonry::model::joints::PointRule;
use masonry::model::{Body, Plane};
use masonry::scene::{Block, Joint, Load, Material, Route, Scene, Support};
use nalgebra::{Point2, Vector2};

/// Weight of the stone, kN/m3.
const WEIGHT: f64 = 2.0 * GRAVITY;

fn materials() -> [Material; 2] {
    [Material::rigid(), Material::elastic(1e7, 0.2)].map(|material| material.density(2000.0))
}

fn scene(title: &str, material: Material) -> Scene {
    Scene::new(title, M_KN).plane(Plane::Stress).thickness(1.0).material("stone", material)
}

fn block(name: &str, x: [f64; 2], y: [f64; 2]) -> Block {
    rectangle(name, "stone", x, y).mesh([2, 2])
}

/// `count` equal blocks on top of each other on a floor.
fn stack(count: u32, [width, height]: [f64; 2], mu: f64, material: Material) -> Scene {
    let on_floor = scene("Stack", material).joint("bed", Joint::mu(mu)).support(Support::new(
        "floor",
        [-1.0, 0.0],
        [2.0, 0.0],
        "bed",
    ));
    (0..count).map(f64::from).fold(on_floor, |scene, k| {
        let course = [k * height, (k + 1.0) * height];
        scene.block(block(&format!("block {k}"), [0.0, width], course))
    })
}

/// A horizontal force of `alpha` times its weight on every block.
fn pushed(scene: Scene, alpha: f64) -> Scene {
    scene.gravity([alpha * GRAVITY, -GRAVITY])
}

/// The mechanism on which pivots end for a scene that falls; that it does is proved by another one, on which joints
/// that slide open as well.
fn mechanism(scene: &Scene) -> (Vec<Vec<Vector2<f64>>>, Outcome) {
    let proved = solve(scene).unwrap();
    assert_eq!(proved.judgement.verdict, Verdict::Falls, "{:#?}", proved.solve.attempts);
    assert_admissible(&proved);
    let outcome = solve(&scene.clone().route(Route::Lemke)).unwrap();
    assert_eq!(outcome.judgement.verdict, Verdict::Falls);
    assert_ne!(outcome.solve.status, Status::Solved);
    assert!(outcome.state.is_none() && outcome.checks.is_none());
    assert_admissible(&outcome);
    (outcome.mechanism.clone().unwrap(), outcome)
}

/// All blocks turn together about `toe`, to the right, the largest rate one.
fn assert_tips(scene: &Scene, toe: Point2<f64>) {
    let (rates, outcome) = mechanism(scene);
    let corners = outcome.model.blocks.iter().flat_map(|block| &block.corners);
    let turned = corners.map(|corner| corner - toe).map(|arm| Vector2::new(arm.y, -arm.x));
    let turned: Vec<Vector2<f64>> = turned.collect();
    let largest = turned.iter().fold(0.0, |m: f64, v| m.max(v.amax()));
    for (rate, expected) in rates.iter().flatten().zip(turned) {
        assert!((rate - expected / largest).amax() < 1e-9, "{rates:?}");
    }
}

/// Every block moves to the right without turning, those above at least as fast as those below.
fn assert_slides(scene: &Scene) {
    let (rates, _) = mechanism(scene);
    let mut below = 0.0;
    for corners in &rates {
        for rate in corners {
            assert!((rate - corners[0]).amax() < 1e-9 && rate.y.abs() < 1e-9, "{rates:?}");
        }
        assert!(corners[0].x > below - 1e-9, "{rates:?}");
        below = corners[0].x;
    }
    assert_close(below, 1.0, 1e-9);
}

/// A block stands up to `alpha = min(mu, b / h)`.
#[test]
fn a_block_slides_or_tips() {
    for material in materials() {
        let slender = |alpha| pushed(stack(1, [0.2, 1.0], 0.7, material), alpha);
        assert_close(critical([0.0, 1.0], |alpha| stands(&slender(alpha))), 0.2, 1e-6);
        assert_tips(&slender(0.2 * 1.001), Point2::new(0.2, 0.0));

        let broad = |alpha| pushed(stack(1, [0.6, 1.0], 0.5, material), alpha);
        assert_close(critical([0.0, 1.0], |alpha| stands(&broad(alpha))), 0.5, 1e-6);
        assert_slides(&broad(0.5 * 1.001));
    }
}

/// Gauss points lie inside the joint, so that a block tips about the outermost of them and not about
/// its corner: two on the whole foot of a rigid block, two on each of the two elements of the other.
#[test]
fn a_block_on_gauss_points_tips_early() {
    let inner = 1.0 / 3_f64.sqrt();
    for (material, arm) in materials().into_iter().zip([inner, 0.5 + 0.5 * inner]) {
        let block = stack(1, [0.2, 1.0], 0.7, material).contact_points(PointRule::Gauss);
        let found = critical([0.0, 1.0], |alpha| stands(&pushed(block.clone(), alpha)));
        assert_close(found, 0.2 * arm, 1e-6);
    }
}

/// On a floor that is tilted slowly a block slides at `tan(angle) = mu` or tips at `b / h`.
#[test]
fn a_block_on_a_tilted_floor() {
    let tilted = |width, angle: f64| {
        let (sin, cos) = angle.to_radians().sin_cos();
        stack(1, [width, 1.0], 0.7, Material::rigid().density(2000.0))
            .gravity([GRAVITY * sin, -GRAVITY * cos])
    };
    let slides = critical([0.0, 60.0], |angle| stands(&tilted(2.0, angle)));
    assert_close(slides, 34.992_020_198_558_7, 1e-6);
    let tips = critical([0.0, 60.0], |angle| stands(&tilted(0.5, angle)));
    assert_close(tips, 26.565_051_177_078, 1e-6);
}

/// A stack of `n` blocks stands up to `alpha = min(mu, b / (n h))`.
#[test]
fn a_stack_slides_or_tips() {
    for material in materials() {
        for (count, expected) in [(2, 0.6), (3, 0.6), (5, 0.4), (10, 0.2)] {
            let stack = |alpha| pushed(stack(count, [1.0, 0.5], 0.6, material), alpha);
            assert_close(critical([0.0, 1.0], |alpha| stands(&stack(alpha))), expected, 1e-6);
            if count < 5 {
                assert_slides(&stack(1.01 * expected));
            } else {
                assert_tips(&stack(1.01 * expected), Point2::new(1.0, 0.0));
            }
        }
    }
}

/// A keystone between smooth faces inclined by an angle, the top 1 wide, 1 high, of unit weight.
fn keystone(degrees: f64, material: Material) -> Scene {
    let foot = degrees.to_radians().tan();
    let (left, right) = ([foot, 0.0], [1.0 - foot, 0.0]);
    scene("Keystone", material.density(1000.0))
        .gravity([0.0, -1.0])
        .joint("smooth", Joint::mu(0.0))
        .block(Block::new("key", "stone", [left, right, [1.0, 1.0], [0.0, 1.0]]).mesh([2, 3]))
        .support(Support::new("left", left, [0.0, 1.0], "smooth"))
        .support(Support::new("right", right, [1.0, 1.0], "smooth"))
}

/// Each face carries `W / (2 sin)` of its angle: at 20 degrees 0.92981.
#[test]
fn a_smooth_wedge() {
    for degrees in [5.0, 20.0, 26.0] {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        for material in [Material::rigid(), Material::elastic(1e5, 0.3)] {
            let scene = keystone(degrees, material);
            for route in routes_for(&scene) {
                let outcome = solved_by(&scene, route);
                let near = rounding(route);
                assert_eq!(outcome.plan.frictional_points, 0);
                for (face, inwards) in [(0, Vector2::new(cos, sin)), (1, Vector2::new(-cos, sin))] {
                    let force =
                        joint_resultant(&outcome, Body::Support(SupportId(face)), BlockId(0));
                    let expected = inwards * (1e3 * (1.0 - sin / cos) / (2.0 * sin));
                    assert!((force - expected).norm() < near * expected.norm(), "{route:?}");
                    if (degrees - 20.0).abs() < 1e-9 {
                        assert_close(force.norm(), 1e3 * 0.92981, 1e-5);
                    }
                }
            }
        }
    }
}

/// Without friction pivots see the contact points and nothing else.
#[test]
fn a_smooth_wedge_has_one_unknown_for_each_point() {
    let outcome = solved(&keystone(20.0, Material::rigid()).route(Route::Lemke));
    assert_eq!(outcome.plan.order, outcome.model.contacts.len());
    assert_eq!(outcome.solve.order, outcome.model.contacts.len());
}

/// A block on a floor, clamped by `N` from above and pushed to the side.
fn clamped(material: Material, mu: f64, clamp: f64, force: f64) -> Scene {
    scene("Clamped block", material)
        .gravity([0.0, -GRAVITY])
        .material("platen", Material::rigid())
        .joint("bed", Joint::mu(mu))
        .joint("guide", Joint::mu(0.0))
        .block(block("block", [0.0, 1.0], [0.0, 1.0]))
        .block(rectangle("platen", "platen", [0.0, 1.0], [1.0, 1.2]))
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "bed"))
        .support(Support::new("left guide", [0.0, 1.0], [0.0, 1.2], "guide"))
        .support(Support::new("right guide", [1.0, 1.0], [1.0, 1.2], "guide"))
        .load(Load::pressure("clamp", [0.0, 1.2], [1.0, 1.2], clamp))
        .load(Load::pressure("push", [0.0, 0.0], [0.0, 1.0], force))
}

/// It is pushed out by `mu (N + N + W)`.
#[test]
fn a_block_clamped_between_platens() {
    let (mu, clamp) = (0.4, 30.0);
    let capacity = mu * (2.0 * clamp + WEIGHT);
    for material in materials() {
        let pushed = |force| clamped(material, mu, clamp, force);
        let found = critical([0.0, 100.0], |force| stands(&pushed(force)));
        assert_close(found, capacity, 1e-6);
        assert_limit_of_all_routes(capacity, pushed);
    }
}

/// A block held between two walls by a thrust `H` and loaded on top.
fn held(material: Material, mu: f64, thrust: f64, force: f64) -> Scene {
    scene("Held block", material)
        .material("platen", Material::rigid())
        .joint("head", Joint::mu(mu))
        .joint("guide", Joint::mu(0.0))
        .block(block("block", [0.0, 1.0], [0.0, 1.0]))
        .block(rectangle("platen", "platen", [1.0, 1.2], [0.0, 1.0]))
        .support(Support::new("wall", [0.0, 0.0], [0.0, 1.0], "head"))
        .support(Support::new("lower guide", [1.0, 0.0], [1.2, 0.0], "guide"))
        .support(Support::new("upper guide", [1.0, 1.0], [1.2, 1.0], "guide"))
        .load(Load::pressure("thrust", [1.2, 0.0], [1.2, 1.0], thrust))
        .load(Load::pressure("top", [0.0, 1.0], [1.0, 1.0], force))
}

/// It carries `2 mu H`.
#[test]
fn a_block_held_by_thrust() {
    let (mu, thrust) = (0.3, 25.0);
    let capacity = 2.0 * mu * thrust;
    for material in materials() {
        let loaded = |force| held(material, mu, thrust, force);
        let found = critical([0.0, 100.0], |force| stands(&loaded(force)));
        assert_close(found, capacity, 1e-6);
        assert_limit_of_all_routes(capacity, loaded);
    }
}

/// Every route finds an equilibrium just below a limit, and none just above it.
#[track_caller]
fn assert_limit_of_all_routes(limit: f64, loaded: impl Fn(f64) -> Scene) {
    for route in routes_for(&loaded(limit)) {
        answer_by(&loaded(0.999 * limit), route);
        assert!(!stands_by(&loaded(1.001 * limit), route), "{route:?} above {limit}");
    }
}
