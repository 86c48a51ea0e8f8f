//! Fill over arches, axles and trains, against closed forms and loads placed by hand.

use std::f64::consts::PI;

use masonry::analysis::limit::{Laws, LimitError, limit_by, train, train_observed};
use masonry::analysis::outcome::Outcome;
use masonry::model::{Model, PlacedBlock};
use masonry::scene::{
    Arch, Axle, Block, Brick, Joint, Load, Material, Opening, Plane, Scene, Support, Train, Wall,
};
use nalgebra::Point2;

use crate::common::{M_KN, assert_close, solved};

/// Blocks of 20 kN/m3 and 2 m thickness on the ground.
fn on_ground(blocks: impl IntoIterator<Item = Block>) -> Scene {
    let scene = Scene::new("Below fill", M_KN)
        .thickness(2.0)
        .gravity([0.0, -10.0])
        .material("stone", Material::rigid().density(2000.0))
        .joint("bed", Joint::mu(0.7))
        .joint("head", Joint::mu(0.0))
        .support(Support::new("ground", [-9.0, 0.0], [9.0, 0.0], "bed"));
    blocks.into_iter().fold(scene, Scene::block)
}

/// A block 2 m wide, whose top rises from 1 m on the left to 2 m on the right.
fn slope() -> Block {
    Block::new("slope", "stone", [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 1.0]])
}

/// The force \[kN\] of what presses down beside the weight, and the place of its resultant along x \[m\].
fn pressed(scene: &Scene) -> [f64; 2] {
    let model = Model::from_scene(scene).unwrap();
    let on_edges = model.blocks.iter().flat_map(PlacedBlock::edge_loads);
    assert!(on_edges.flat_map(|it| it.traction).all(|it| it.y <= 0.0), "a load lifts");
    let loads = model.blocks.iter().flat_map(|block| {
        block.loads.iter().map(|load| load.resultant(&block.corners, model.thickness))
    });
    let (force, moment) = loads.fold((0.0, 0.0), |(force, moment), it| {
        assert!(it.force.x == 0.0 && it.force.y < 0.0, "{it:?}");
        (force - it.force.y, moment - it.force.y * it.at.x - it.moment)
    });
    [1e-3 * force, moment / force]
}

#[track_caller]
fn assert_pressed(scene: &Scene, expected: [f64; 2]) {
    let found = pressed(scene);
    (0..2).for_each(|k| assert_close(found[k], expected[k], 1e-12));
}

/// Depths of 1.5 m and 0.5 m: 2 m2 of fill, with the centroid at `2 (1.5 + 2 x 0.5) / (3 x 2) = 5/6`. Up to 1.5 m there
/// is a triangle of 1 m by 0.5 m.
#[test]
fn the_column_above_a_slope() {
    for (level, area, place) in [(2.5, 2.0, 5.0 / 6.0), (1.5, 0.25, 1.0 / 3.0)] {
        let scene = on_ground([slope()]).load(Load::fill("fill", "slope", level, 18.0));
        let [force, at] = pressed(&scene);
        assert_close(force, 18.0 * area * 2.0, 1e-12);
        assert_close(at, place, 1e-12);
        // Block and fill together press on the ground.
        let outcome = solved(&scene);
        let reaction = outcome.reactions[0].fy;
        assert_close(1e-3 * reaction, 20.0 * 3.0 * 2.0 + force, 1e-9);
    }
    let low = on_ground([slope()]).load(Load::fill("fill", "slope", 1.0, 18.0));
    let error = Model::from_scene(&low).unwrap_err().to_string();
    assert!(error.contains("\"fill\""), "{error}");
}

/// Between a semicircle of radius `R` and a level `L` are `2 R L - pi R^2 / 2`.
#[test]
fn the_fill_over_a_semicircle() {
    let arch = Arch::semicircular("arch", "stone", 4.0, 0.5, 400).joint("bed").springing("bed");
    let mut scene = on_ground([]).arch(arch).load(Load::fill("fill", "arch", 3.0, 18.0));
    scene.supports.clear();
    let [force, at] = pressed(&scene);
    assert_close(force, 18.0 * 2.0 * (2.0 * 2.5 * 3.0 - 0.5 * PI * 2.5 * 2.5), 1e-4);
    assert_close(at, 2.0, 1e-9);
}

/// Fill has mass: in an earthquake its inertia acts on the edges.
#[test]
fn fill_has_mass() {
    let fill = Load::fill("fill", "slope", 2.5, 18.0).mass(1.0);
    let scene = on_ground([slope()]).load(fill).load(Load::acceleration("quake", [1.0, 0.0]));
    assert_close(-1e-3 * solved(&scene).reactions[0].fx, 0.1 * (120.0 + 72.0), 1e-9);
}

/// Two blocks side by side, 1 m high, below a fill of 1 m: at 1 to 2 an axle presses on 1 m.
#[test]
fn an_axle_above_two_blocks() {
    let halves = [("left", 0.0), ("right", 2.0)].map(|(name, x)| {
        Block::new(name, "stone", [[x, 0.0], [x + 2.0, 0.0], [x + 2.0, 1.0], [x, 1.0]])
    });
    let at = |x| {
        let left = Axle::new("left", x, 100.0).level(2.0);
        let right = Axle { over: "right".to_owned(), ..left.clone() };
        [left, right].map(|axle| on_ground(halves.clone()).load(Load::axle("axle", axle)))
    };
    // All on the left, and three quarters there, from 1.25 to 2 and from 2 to 2.25.
    let [left, right] = at(1.0);
    assert_pressed(&left, [100.0, 1.0]);
    assert!(Model::from_scene(&right).unwrap().blocks.iter().all(|block| block.loads.is_empty()));
    let warnings = solved(&right).judgement.warnings;
    assert!(warnings.iter().any(|it| it.contains("acts on nothing")), "{warnings:?}");
    let [left, right] = at(1.75);
    assert_pressed(&left, [75.0, 1.625]);
    assert_pressed(&right, [25.0, 2.125]);
}

/// A million rays, of which each meets the slope somewhere. Nothing lifts, on a steep slope either.
#[test]
fn rays_on_a_slope() {
    const RAYS: u32 = 1_000_000;
    let cases = [
        (0.5, 3.0, 1.0, 26.565_051_177_077_99),
        (0.5, 3.0, 0.4, 40.0),
        (0.5, 3.0, 1.9, 5.0),
        (2.0, 5.5, 1.2, 15.0),
        (2.0, 5.5, 1.0, 24.0),
    ];
    for (rise, level, x, angle) in cases {
        let block = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0 + 2.0 * rise], [0.0, 1.0]];
        let axle = Axle { angle_deg: angle, ..Axle::new("slope", x, 100.0).level(level) };
        let found = pressed(
            &on_ground([Block::new("slope", "stone", block)]).load(Load::axle("axle", axle)),
        );
        let slope = angle.to_radians().tan();
        // From (x, level) by u sideways for 1 m downwards to y = 1 + rise x.
        let rays = (0..RAYS).map(|k| slope * (2.0 * (f64::from(k) + 0.5) / f64::from(RAYS) - 1.0));
        let met = rays.map(|u| x + u * (level - 1.0 - rise * x) / (1.0 + rise * u));
        let met: Vec<f64> = met.filter(|x| (0.0..=2.0).contains(x)).collect();
        let expected = [
            100.0 * met.len() as f64 / f64::from(RAYS),
            met.iter().sum::<f64>() / met.len() as f64,
        ];
        for (found, expected) in found.into_iter().zip(expected) {
            assert_close(found, expected, 1e-5);
        }
    }
}

/// The lower step takes the rays that pass the upper one: of 45 degrees to both sides, half meet the upper step, and an eighth
/// the lower one between 1.5 and 2 m.
#[test]
fn rays_on_a_step() {
    let step = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let axle = Axle { angle_deg: 45.0, ..Axle::new("step", 0.5, 100.0).level(3.0) };
    let scene = on_ground([Block::new("step", "stone", step)]).load(Load::axle("axle", axle));
    assert_pressed(&scene, [62.5, (50.0 * 0.5 + 12.5 * 1.75) / 62.5]);
}

/// A sill lies below the course above the window: it carries no fill.
#[test]
fn fill_over_a_wall_with_a_window() {
    let brick = Brick { length: 1.0, height: 0.5 };
    let wall = Wall::running_bond("wall", "stone", brick, 4.0, 6)
        .opening(Opening::door(1.5, 1.0, 2).above(2));
    let scene = on_ground([]).wall(wall).load(Load::fill("fill", "wall", 4.0, 18.0));
    assert_pressed(&scene, [18.0 * 4.0 * 1.0 * 2.0, 2.0]);
}

/// Slots of head joints reach down to the course below, and the course above them covers them.
#[test]
fn fill_over_a_wall_in_mortar() {
    let brick = Brick { length: 0.5, height: 0.25 };
    let mut scene = on_ground([])
        .plane(Plane::Stress)
        .material("mortar", Material::elastic(1e9, 0.2))
        .wall(Wall::running_bond("wall", "stone", brick, 2.06, 6).origin([0.0, 0.02]))
        .load(Load::fill("fill", "wall", 3.0, 18.0));
    for class in ["bed", "head"] {
        scene = scene.joint(class, Joint::mu(0.7).mortar(0.02, "mortar"));
    }
    // The top lies at 6 courses of 0.25 m and as many bed joints. In its four head joints the fill reaches to the course below.
    let [force, at] = pressed(&scene);
    let depth = 3.0 - 6.0 * 0.27;
    assert_close(force, 18.0 * 2.0 * (depth * 2.06 + 0.27 * 4.0 * 0.02), 1e-9);
    assert_close(at, 1.03, 1e-9);
}

/// A slab on the wall takes the fill, and leaves none to the sill of the window below.
#[test]
fn fill_stays_on_what_covers_a_body() {
    let brick = Brick { length: 1.0, height: 0.5 };
    let wall = Wall::running_bond("wall", "stone", brick, 4.0, 6)
        .opening(Opening::door(1.5, 1.0, 2).above(2));
    let slab = [[0.0, 3.0], [4.0, 3.0], [4.0, 3.5], [0.0, 3.5]];
    let scene = on_ground([Block::new("slab", "stone", slab)]).wall(wall);
    let error = Model::from_scene(&scene.clone().load(Load::fill("fill", "wall", 4.0, 18.0)));
    assert!(error.unwrap_err().to_string().contains("no free edge of \"wall\""));
    assert_pressed(
        &scene.load(Load::fill("fill", "slab", 4.0, 18.0)),
        [18.0 * 4.0 * 0.5 * 2.0, 2.0],
    );
}

/// On an elastic block fill is the pressure of its depth.
#[test]
fn fill_on_an_elastic_beam_is_a_pressure() {
    let beam = [[0.0, 1.0], [4.0, 1.0], [4.0, 1.4], [0.0, 1.4]];
    let post = |name, x: f64| {
        Block::new(name, "stone", [[x, 0.0], [x + 0.2, 0.0], [x + 0.2, 1.0], [x, 1.0]])
    };
    let scene = on_ground([post("left", 0.0), post("right", 3.8)])
        .plane(Plane::Stress)
        .material("timber", Material::elastic(1e10, 0.2))
        .block(Block::new("beam", "timber", beam).mesh([20, 4]));
    let by_fill = solved(&scene.clone().load(Load::fill("fill", "beam", 3.4, 20.0)));
    let pressure = Load::pressure("pressure", [0.0, 1.4], [4.0, 1.4], 40.0);
    let by_pressure = solved(&scene.load(pressure));
    let sag = |outcome: &Outcome| {
        let moves = outcome.state.as_ref().unwrap().displacements.concat();
        moves.iter().fold(0.0_f64, |sag, it| sag.max(-it.y))
    };
    assert!(sag(&by_fill) > 0.0);
    assert_close(sag(&by_fill), sag(&by_pressure), 1e-9);
}

/// Without a fill, or where the edge is above it, an axle stands on the edge itself.
#[test]
fn an_axle_on_an_edge() {
    for axle in [Axle::new("slope", 1.5, 100.0), Axle::new("slope", 1.5, 100.0).level(1.7)] {
        assert_pressed(&on_ground([slope()]).load(Load::axle("axle", axle)), [100.0, 1.5]);
    }
}

/// A bridge of so many voussoirs, of 5 m span.
fn bridge(voussoirs: u32) -> Scene {
    let arch = Arch::segmental("arch", "stone", 5.0, 1.25, 0.4, voussoirs);
    let mut scene = on_ground([]).arch(arch.joint("bed").springing("bed"));
    scene.supports.clear();
    scene
}

/// The scene with forces of a train without a fill, placed by hand on the edges of voussoirs.
fn by_hand(scene: &Scene, axles: &[[f64; 2]], position: f64) -> Option<Scene> {
    let model = Model::from_scene(scene).unwrap();
    let place = |x: f64| {
        let edges = model.blocks.iter().flat_map(|block| {
            let next = block.corners.iter().cycle().skip(1);
            block.corners.iter().zip(next).map(|(from, to)| (block.name.as_str(), *from, *to))
        });
        // Edges of the extrados run from right to left.
        let above = edges.filter(|(_, from, to)| (to.x..=from.x).contains(&x) && to.x < from.x);
        let met = above.map(|(name, from, to): (_, Point2<f64>, Point2<f64>)| {
            (name, from.y + (to.y - from.y) * (x - from.x) / (to.x - from.x))
        });
        met.max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let mut loaded = scene.clone();
    for (k, [offset, force]) in axles.iter().enumerate() {
        let x = position + offset;
        if let Some((block, y)) = place(x) {
            let load = Load::force(&format!("axle {k}"), block, [x, y], [0.0, -force]);
            loaded = loaded.load(load.group("axles"));
        }
    }
    (!loaded.loads.is_empty()).then(|| loaded.limit_group("axles"))
}

/// The train has the limit loads of forces placed by hand, its least where theirs is, and none beside the bridge.
#[test]
fn a_train_is_its_axles_placed_by_hand() {
    let axles = [[0.0, 60.0], [1.2, 100.0]];
    let scene = bridge(20).train(Train::new("arch", axles, [-3.0, 6.0]).positions(19));
    let crossing =
        train_observed(&scene, Laws::Associative, &mut |_| std::ops::ControlFlow::Continue(()));
    let crossing = crossing.unwrap();
    assert_eq!(crossing.positions.len(), 19);
    let mut least = (f64::INFINITY, 0);
    for (k, found) in crossing.positions.iter().enumerate() {
        assert_close(found.at + 10.0, 7.0 + 0.5 * k as f64, 1e-12);
        let Some(loaded) = by_hand(&bridge(20), &axles, found.at) else {
            assert_eq!((found.answer, found.load_factor), (None, None), "{found:?}");
            continue;
        };
        let by_hand = limit_by(&loaded, Laws::Associative).unwrap().associative.unwrap();
        assert_eq!(found.answer, Some(by_hand.answer));
        // Blocks do not crush: at the crown every factor is carried.
        let Some(factor) = by_hand.load_factor else { continue };
        assert_close(found.load_factor.unwrap(), factor, 5e-5);
        if factor < least.0 {
            least = (factor, k);
        }
    }
    assert_eq!(crossing.critical, least.1);
    assert_close(crossing.limit.associative.unwrap().load_factor.unwrap(), least.0, 5e-5);
}

/// A bridge and one axle are the same from the left and from the right, with fill and without; fill makes it carry more.
#[test]
fn a_symmetric_bridge() {
    let factors = |fill: bool| {
        let mut train = Train::new("arch", [[0.0, 100.0]], [0.5, 4.5]).positions(9);
        let mut scene = bridge(20);
        if fill {
            train = train.level(2.2);
            scene = scene.load(Load::fill("fill", "arch", 2.2, 18.0));
        }
        let found = masonry::analysis::limit::train(&scene.train(train)).unwrap();
        assert!(found.limit.path.unwrap().decided);
        found.positions.into_iter().map(|it| it.load_factor).collect::<Vec<_>>()
    };
    let [bare, filled] = [false, true].map(factors);
    for list in [&bare, &filled] {
        for (left, right) in list.iter().zip(list.iter().rev()) {
            match (left, right) {
                (Some(left), Some(right)) => assert_close(*left, *right, 1e-4),
                _ => assert_eq!(left, right),
            }
        }
    }
    let gains = bare.iter().zip(&filled).filter_map(|(bare, filled)| Some(((*bare)?, (*filled)?)));
    let gains: Vec<f64> = gains.map(|(bare, filled)| filled / bare).collect();
    assert!(gains.len() >= 4 && gains.iter().all(|gain| *gain > 1.5), "{gains:?}");
}

/// By both laws the path is followed at the worst position by associated flow alone, and carries there what it carries if it
/// is followed everywhere. Associated flow is an upper bound at every position.
#[test]
fn the_path_at_every_position() {
    let train = Train::new("arch", [[0.0, 100.0]], [0.5, 2.5]).positions(9);
    let slippery = bridge(20).joint("bed", Joint::mu(0.35)).train(train);
    let by = |laws| {
        train_observed(&slippery, laws, &mut |_| std::ops::ControlFlow::Continue(())).unwrap()
    };
    let [by_path, both] = [Laws::Path, Laws::Both].map(by);
    assert!(by_path.by_path && !both.by_path);
    for (flow, path) in both.positions.iter().zip(&by_path.positions) {
        assert!(path.load_factor.unwrap() <= flow.bound.unwrap(), "{path:?} and {flow:?}");
    }
    let carried = by_path.positions.iter().map(|it| it.load_factor.unwrap());
    assert_close(by_path.limit.carried(), carried.fold(f64::INFINITY, f64::min), 1e-12);
    let there = by_path.positions[both.critical].load_factor.unwrap();
    assert_close(both.limit.carried(), there, 1e-12);
    let tells = |it: &String| it.contains("Coulomb's friction may carry less at another");
    assert!(both.limit.warnings.iter().any(tells));
    assert!(!by_path.limit.warnings.iter().any(tells));
}

/// Mistakes are told.
#[test]
fn trains_that_never_are_on_the_bridge() {
    assert!(matches!(train(&bridge(10)), Err(LimitError::NoTrain)));
    let beside = bridge(10).train(Train::new("arch", [[0.0, 1.0]], [20.0, 30.0]).positions(3));
    let error = train(&beside).unwrap_err();
    assert!(matches!(error, LimitError::NoAxle { .. }), "{error}");
    assert!(error.to_string().contains("stands on \"arch\""), "{error}");
}
