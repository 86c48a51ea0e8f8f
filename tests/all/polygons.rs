//! Blocks with corners that point inwards: one rigid body each, by hand.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::ids::BlockId;
use masonry::model::{Model, Plane, PointRule};
use masonry::scene::{Block, Joint, Load, Material, Scene, SceneErrorKind, Support};

use crate::common::{GRAVITY, M_KN, assert_close, rectangle, solved};

/// Weight of the stone per area of a wall one metre thick \[kN/m2\].
const WEIGHT: f64 = 2.0 * GRAVITY;

/// A stem on the left, and an arm to the right at its top.
const HOOK: [[f64; 2]; 6] =
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [3.0, 1.0], [3.0, 2.0], [0.0, 2.0]];

fn scene(blocks: impl IntoIterator<Item = Block>) -> Scene {
    let scene = Scene::new("Polygons", M_KN)
        .thickness(1.0)
        .gravity([0.0, -GRAVITY])
        .material("stone", Material::rigid().density(2000.0))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .joint("glue", Joint::mu(0.6).cohesion(1e4).tension(1e4));
    blocks.into_iter().fold(scene, Scene::block)
}

/// Ground below the stem, and a step whose side and top the hook touches, the top over half a metre.
fn over_a_step(blocks: impl IntoIterator<Item = Block>) -> Scene {
    scene(blocks)
        .support(Support::new("ground", [0.0, 0.0], [1.0, 0.0], "smooth"))
        // On rough ones the hook would be wedged between its foot or its side and the end of the step.
        .joint("smooth", Joint::mu(0.0))
        .support(Support::new("side", [1.0, 0.0], [1.0, 1.0], "smooth"))
        .support(Support::new("top", [1.0, 1.0], [1.5, 1.0], "bed"))
}

fn hook() -> Block {
    Block::new("hook", "stone", HOOK)
}

/// The factor by both laws.
#[track_caller]
fn assert_limit(scene: &Scene, expected: f64) {
    let limit = limit_by(scene, Laws::Both).unwrap();
    let flow = limit.associative.unwrap();
    assert!(flow.proved, "{flow:?}");
    assert_close(flow.load_factor.unwrap(), expected, 1e-6);
    // The search along the path ends within 1e-3 below the limit.
    assert_close(limit.path.unwrap().load_factor.unwrap(), expected, 1e-3);
}

/// Two squares of 1 m side by side below two above one another: the ground carries the weight of four.
#[test]
fn the_weight_of_a_hook_is_that_of_its_area() {
    let on_floor = scene([hook()]).support(Support::new("ground", [0.0, 0.0], [1.0, 0.0], "glue"));
    let outcome = solved(&on_floor);
    let state = outcome.state.as_ref().unwrap();
    let up: f64 = state.contacts.iter().map(|it| it.t_n).sum();
    assert_close(up / 1e3, 4.0 * WEIGHT, 1e-9);
    // The centroid is 1.25 m from the left, so the joint of one metre pulls on its left: moments about its left end.
    let moment = outcome.model.contacts.iter().zip(&state.contacts);
    let moment: f64 = moment.map(|(at, force)| at.position.x * force.t_n).sum();
    assert_close(moment / 1e3, 4.0 * WEIGHT * 1.25, 1e-9);
}

/// The hook, its centroid 0.25 m on the near side of the end of the step, turns about that end when a force 1.5 m beyond it
/// is a sixth of the weight. Its convex hull would overlap the step.
#[test]
fn a_hook_tips_over_a_step() {
    let pull = |block: &str| Load::force("pull", block, [3.0, 2.0], [0.0, -1.0]);
    let expected = 4.0 * WEIGHT * 0.25 / 1.5;
    assert_limit(&over_a_step([hook()]).load(pull("hook")), expected);
    let glued = [
        rectangle("stem", "stone", [0.0, 1.0], [0.0, 2.0]),
        rectangle("arm", "stone", [1.0, 3.0], [1.0, 2.0]),
    ];
    let glued = over_a_step(glued).between("stem", "arm", "glue").load(pull("arm"));
    assert_limit(&glued, expected);
}

/// A quoin keeps the brick in its corner: pushed to the left by a part of gravity, the pair turns about the left end of the
/// quoin as one body does. A 2 m by 2 m square on a floor tips at a factor of 1.
#[test]
fn a_quoin_and_the_brick_in_its_corner_tip_as_a_square() {
    let quoin = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let quoin = Block::new("quoin", "stone", quoin);
    let brick = rectangle("brick", "stone", [1.0, 2.0], [1.0, 2.0]);
    let pair = scene([quoin, brick])
        .joint("rough", Joint::mu(2.0))
        .between("quoin", "brick", "rough")
        .support(Support::new("ground", [-1.0, 0.0], [3.0, 0.0], "rough"))
        .load(Load::acceleration("quake", [-GRAVITY, 0.0]));
    assert_limit(&pair, 1.0);
}

/// A tongue in a groove holds sidewards and against turning without friction: a pair of 3 m by 4 m tips as one rectangle.
#[test]
fn a_tongue_holds_in_a_groove() {
    let groove = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let tongue = [
        [1.0, 1.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [3.0, 2.0],
        [3.0, 4.0],
        [0.0, 4.0],
        [0.0, 2.0],
        [1.0, 2.0],
    ];
    let held = scene(
        [("lower", groove), ("upper", tongue)]
            .map(|(name, corners)| Block::new(name, "stone", corners)),
    )
    .joint("bed", Joint::mu(0.0))
    .joint("head", Joint::mu(0.0))
    .joint("rough", Joint::mu(2.0))
    .support(Support::new("ground", [0.0, 0.0], [3.0, 0.0], "rough"))
    .load(Load::acceleration("quake", [GRAVITY, 0.0]));
    assert_eq!(Model::from_scene(&held).unwrap().joints.len(), 6);
    assert_limit(&held, 0.75);
}

/// Corners on straight edges, and edges in parts, change nothing.
#[test]
fn corners_on_straight_edges_change_no_answer() {
    let plain = [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]].to_vec();
    let more = vec![
        [0.0, 0.0],
        [0.3, 0.0],
        [0.5, 0.0],
        [1.0, 0.0],
        [1.0, 0.5],
        [1.0, 2.0],
        [0.5, 2.0],
        [0.0, 2.0],
    ];
    let on_floor = |corners: Vec<[f64; 2]>| {
        scene([
            Block::new("below", "stone", corners),
            rectangle("above", "stone", [0.0, 1.0], [2.0, 3.0]),
        ])
        .support(Support::new("ground", [-1.0, 0.0], [2.0, 0.0], "bed"))
        .load(Load::acceleration("quake", [GRAVITY, 0.0]))
    };
    // Half of the breadth of 1 m by half of the height of 3 m.
    assert_limit(&on_floor(plain), 1.0 / 3.0);
    assert_limit(&on_floor(more), 1.0 / 3.0);
}

/// What lies in the convex hull of a hook, but not in the hook.
#[test]
fn the_hollow_of_a_hook_is_not_the_hook() {
    let brick = |x: [f64; 2], y: [f64; 2]| rectangle("brick", "stone", x, y);
    let ground =
        |scene: Scene| scene.support(Support::new("ground", [0.0, 0.0], [3.0, 0.0], "bed"));
    let inside = ground(scene([hook(), brick([1.0, 3.0], [0.0, 1.0])]));
    let model = Model::from_scene(&inside).unwrap();
    // Ground below both, a bed, and a head joint.
    assert_eq!(model.joints.len(), 4);
    assert_eq!(model.blocks[BlockId::new(0).index()].corners.len(), 6);
    let deeper = ground(scene([hook(), brick([0.5, 3.0], [0.0, 1.0])]));
    let error = Model::from_scene(&deeper).unwrap_err();
    let SceneErrorKind::Overlap { area, .. } = error.kind() else { panic!("{error}") };
    assert_close(*area, 0.5, 1e-9);

    let post = |to: [f64; 2]| {
        ground(scene([hook()])).support(Support::new("post", [2.0, -1.0], to, "bed"))
    };
    let error = Model::from_scene(&post([2.0, 1.0])).unwrap_err();
    assert!(matches!(error.kind(), SceneErrorKind::IdleSupport(_)), "{error}");
    let error = Model::from_scene(&post([2.0, 1.75])).unwrap_err();
    let SceneErrorKind::Pierced { length, .. } = error.kind() else { panic!("{error}") };
    assert_close(*length, 0.75, 1e-9);

    let load = |at| ground(scene([hook()])).load(Load::force("pull", "hook", at, [0.0, -1.0]));
    assert!(Model::from_scene(&load([2.0, 1.0])).is_ok());
    let error = Model::from_scene(&load([2.0, 0.75])).unwrap_err();
    assert!(error.to_string().contains("0.25 m"), "{error}");
}

/// A wall of columns of hexagons, every second column half a hexagon higher, on trapezia.
fn honeycomb(material: Material, points: PointRule) -> Scene {
    let hexagon = [[-0.1, 0.0], [0.1, 0.0], [0.2, 0.15], [0.1, 0.3], [-0.1, 0.3], [-0.2, 0.15]];
    let foot = [[-0.2, 0.0], [0.2, 0.0], [0.1, 0.15], [-0.1, 0.15]];
    let mut blocks = Vec::new();
    for column in 0..4 {
        let x = 0.3 * f64::from(column);
        let mut add = |corners: &[[f64; 2]], y: f64, mesh| {
            let corners: Vec<_> = corners.iter().map(|[u, v]| [x + u, y + v]).collect();
            blocks.push(Block::new(&blocks.len().to_string(), "stone", corners).mesh(mesh));
        };
        let y = if column % 2 == 0 { 0.0 } else { 0.15 };
        if column % 2 == 1 {
            add(&foot, 0.0, [2, 2]);
        }
        (0..3).for_each(|row| add(&hexagon, y + 0.3 * f64::from(row), [1, 1]));
    }
    scene(blocks)
        .plane(Plane::Stress)
        .material("stone", material.density(2000.0))
        .contact_points(points)
        .support(Support::new("ground", [-1.0, 0.0], [2.0, 0.0], "bed"))
        .load(Load::acceleration("quake", [GRAVITY, 0.0]))
}

/// Stiff hexagons carry what rigid ones carry, to 1 %, with all kinds of contact points.
#[test]
fn a_wall_of_hexagons_has_its_rigid_limit() {
    let path =
        |scene: &Scene| limit_by(scene, Laws::Path).unwrap().path.unwrap().load_factor.unwrap();
    let rigid = path(&honeycomb(Material::rigid(), PointRule::Vertices));
    for points in [PointRule::Vertices, PointRule::NodalPairs, PointRule::Gauss] {
        let elastic = honeycomb(Material::elastic(3e7, 0.2), points);
        let model = Model::from_scene(&elastic).unwrap();
        let elements: usize =
            model.blocks.iter().filter_map(|it| it.mesh.as_ref()).map(|it| it.elements.len()).sum();
        assert_eq!(elements, 12 * 6 + 2 * 4);
        let found = path(&elastic);
        if points == PointRule::Gauss {
            // The points nearest to the ends of a joint are not on them: blocks turn about them earlier.
            assert!(found < rigid && found > 0.7 * rigid, "{found} against {rigid}");
        } else {
            assert_close(found, rigid, 1e-2);
        }
    }
}

/// A block tips about the Gauss point of its bed, at `1/sqrt(3)` of half of its breadth from the middle; a warning says so.
#[test]
fn gauss_points_reach_a_part_of_a_joint() {
    let tipped = |points: PointRule| {
        let tower = scene([rectangle("tower", "stone", [0.0, 0.2], [0.0, 1.0])])
            .contact_points(points)
            .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "bed"))
            .load(Load::acceleration("push", [GRAVITY, 0.0]));
        let limit = limit_by(&tower, Laws::Associative).unwrap();
        let warned =
            limit.warnings.iter().find(|it| it.starts_with("Contact points are inside")).cloned();
        (limit.associative.unwrap().load_factor.unwrap(), warned)
    };
    let (at_ends, warned) = tipped(PointRule::Vertices);
    assert_close(at_ends, 0.2, 1e-6);
    assert_eq!(warned, None);
    let (inside, warned) = tipped(PointRule::Gauss);
    assert_close(inside, 0.2 / 3_f64.sqrt(), 1e-6);
    assert!(warned.unwrap().contains("span only 58 % of the length of some joint"));
}

/// Outlines that are no polygon.
#[test]
fn outlines_that_touch_themselves_are_refused() {
    let refused = |corners: &[[f64; 2]]| {
        let scene = scene([Block::new("it", "stone", corners)]);
        let ground = Support::new("ground", [0.0, 0.0], [3.0, 0.0], "bed");
        Model::from_scene(&scene.support(ground)).unwrap_err()
    };
    let bow = refused(&[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [2.0, 2.0], [2.0, 3.0], [0.0, 3.0]]);
    assert!(matches!(bow.kind(), SceneErrorKind::CrossingEdges(_)), "{bow}");
    // Two squares that touch at a corner, and a slit.
    let pinched = refused(&[
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [1.0, 1.0],
        [0.0, 1.0],
    ]);
    assert!(matches!(pinched.kind(), SceneErrorKind::CrossingEdges(_)), "{pinched}");
    let slit = refused(&[
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [2.0, 1.0],
        [2.0, 2.0],
        [0.0, 2.0],
    ]);
    let SceneErrorKind::NoWidth { corner, .. } = slit.kind() else { panic!("{slit}") };
    assert_eq!(*corner, 4);
    let again = refused(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert!(matches!(again.kind(), SceneErrorKind::NoWidth { .. }), "{again}");
}
