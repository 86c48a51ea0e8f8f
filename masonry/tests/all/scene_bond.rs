//! Bonds, units and arbitrary input: what holds for every wall and every text.

use masonry::geometry;
use masonry::model::{BlockLoad, Model, PlacedBlock, Plane};
use masonry::scene::bond::{self, PlacedBrick};
use masonry::scene::{Brick, Joint, Load, Material, Scene, SceneErrorKind, Support, Wall};
use masonry::units::{ForceUnit, LengthUnit, Units};
use proptest::prelude::*;

/// Sum of the areas of bricks, relative to `area`.
fn relative_area(bricks: &[PlacedBrick], area: f64) -> f64 {
    let of = |b: &PlacedBrick| (b.high[0] - b.low[0]) * (b.high[1] - b.low[1]);
    bricks.iter().map(of).sum::<f64>() / area
}

/// A scene of one rigid wall on a floor.
fn on_floor(wall: Wall, width: f64) -> Scene {
    let [x, y] = wall.origin;
    Scene::new("wall", Units::SI)
        .thickness(1.0)
        .material("stone", Material::rigid())
        .joint("bed", Joint::mu(0.5))
        .joint("head", Joint::mu(0.5))
        .wall(wall)
        .support(Support::new("floor", [x, y], [x + width, y], "bed"))
}

fn block_area(block: &PlacedBlock) -> f64 {
    geometry::area(&block.corners)
}

fn lengths(wall: &Wall, course: usize) -> Vec<f64> {
    bond::bricks(wall).iter().filter(|b| b.course == course).map(|b| b.fraction).collect()
}

#[test]
fn even_courses_of_a_running_bond_begin_with_a_half_brick() {
    let brick = Brick { length: 0.2, height: 0.1 };
    let wall = Wall::running_bond("w", "stone", brick, 1.0, 2);
    assert_eq!(lengths(&wall, 1), [1.0; 5]);
    assert_eq!(lengths(&wall, 2), [0.5, 1.0, 1.0, 1.0, 1.0, 0.5]);
}

#[test]
fn the_last_brick_is_cut_to_the_width() {
    let brick = Brick { length: 1.0, height: 1.0 };
    let wall = Wall::running_bond("w", "stone", brick, 2.25, 2);
    assert_eq!(lengths(&wall, 1), [1.0, 1.0, 0.25]);
    assert_eq!(lengths(&wall, 2), [0.5, 1.0, 0.75]);
    let narrow = Wall::running_bond("w", "stone", brick, 0.25, 2);
    assert_eq!((lengths(&narrow, 1), lengths(&narrow, 2)), (vec![0.25], vec![0.25]));
}

#[test]
fn openings_are_left_out_and_not_counted() {
    let brick = Brick { length: 0.4, height: 0.175 };
    let courses = vec![vec![1.0, 0.5, -1.0, 0.5, 1.0]];
    let wall = Wall::from_courses("w", "stone", brick, courses).origin([1.0, 2.0]);
    let bricks = bond::bricks(&wall);
    let names: Vec<String> = bricks.iter().map(|b| b.name(&wall)).collect();
    assert_eq!(names, ["w/1/1", "w/1/2", "w/1/3", "w/1/4"]);
    assert!((bricks[2].low[0] - 2.0).abs() < 1e-15 && (bricks[2].low[1] - 2.0).abs() < 1e-15);
}

#[test]
fn a_cut_brick_gets_its_share_of_elements_rounded_up() {
    let brick = Brick { length: 1.0, height: 1.0 };
    let courses = vec![vec![1.0, 0.5, 0.25, 0.1, 0.75, 1.5]];
    let wall = Wall::from_courses("w", "stone", brick, courses);
    let along: Vec<usize> = bond::bricks(&wall).iter().map(|b| b.mesh([4, 3])[0]).collect();
    assert_eq!(along, [4, 2, 1, 1, 3, 6]);
    assert!(bond::bricks(&wall).iter().all(|b| b.mesh([4, 3])[1] == 3));
}

#[test]
fn the_published_walls_have_the_published_counts() {
    let brick = Brick { length: 0.4, height: 0.175 };
    let e = vec![0.5, 1.0, 1.0, 1.0, 1.0, 0.5];
    let u = vec![1.0; 5];
    let wall = |courses| Wall::from_courses("w", "stone", brick, courses);
    let alternating =
        |pairs| std::iter::repeat_n([e.clone(), u.clone()], pairs).flatten().collect();
    let [f, g] = [vec![1.0; 4], vec![0.5, 1.0, 1.0, 1.0, 0.5]];
    let [we, wu] = [vec![1.0, 0.5, -1.0, 0.5, 1.0], vec![0.5, 1.0, -1.0, 1.0, 0.5]];
    let window = [&f, &g, &f, &wu, &we, &wu, &we, &wu, &f, &g, &f].map(Clone::clone).to_vec();
    for (courses, width, blocks, joints) in
        [(alternating(3), 2.0, 33, 83), (alternating(5), 2.0, 55, 141), (window, 1.6, 46, 102)]
    {
        let model = Model::from_scene(&on_floor(wall(courses), width)).unwrap();
        assert_eq!((model.blocks.len(), model.joints.len()), (blocks, joints));
    }
}

#[test]
fn a_brick_cut_to_next_to_nothing_is_refused() {
    let brick = Brick { length: 1.0, height: 1.0 };
    let wall = Wall::from_courses("w", "stone", brick, vec![vec![1.0, 1e-12]]);
    let error = Model::from_scene(&on_floor(wall, 1.0)).unwrap_err();
    assert!(matches!(error.kind(), SceneErrorKind::NoWidth { .. }), "{error}");
    assert_eq!(error.key(), "walls[0].courses");
}

/// A scene that exercises every quantity with a unit; `length` and `force` convert from m and kN.
fn with_units(units: Units, length: f64, force: f64) -> Scene {
    let stress = force / (length * length);
    let at = |x: f64, y: f64| [x * length, y * length];
    let brick = Brick { length: 0.25 * length, height: 0.1 * length };
    let wall = Wall::running_bond("wall", "brick", brick, length, 4);
    Scene::new("units", units)
        .plane(Plane::Stress)
        .thickness(0.3 * length)
        .gravity([0.0, -9.81])
        .gap_limit(0.01 * length)
        .material("brick", Material::elastic(1e6 * stress, 0.2).density(1800.0))
        .joint("bed", Joint::phi_deg(45.0))
        .joint("head", Joint::mu(0.0))
        .wall(wall.origin(at(0.5, 0.25)).mesh([2, 1]))
        .support(Support::new("floor", at(0.0, 0.245), at(2.0, 0.245), "bed"))
        .load(Load::pressure("top", at(0.6, 0.65), at(1.5, 0.65), 12.0 * stress))
        .load(Load::traction("side", at(0.5, 0.3), at(0.5, 0.6), [3.0 * stress, 0.0]))
}

#[test]
fn units_do_not_change_the_model() {
    let metres = Units { length: LengthUnit::M, force: ForceUnit::Kn };
    let millimetres = Units { length: LengthUnit::Mm, force: ForceUnit::N };
    let a = Model::from_scene(&with_units(metres, 1.0, 1.0)).unwrap();
    let b = Model::from_scene(&with_units(millimetres, 1e3, 1e3)).unwrap();
    let near = |x: f64, y: f64| (x - y).abs() <= 1e-12 * x.abs().max(1e-3);
    assert!(near(a.thickness, 0.3) && near(b.thickness, 0.3));
    assert_eq!((a.blocks.len(), a.joints.len()), (b.blocks.len(), b.joints.len()));
    assert_eq!((a.contacts.len(), a.gravity), (b.contacts.len(), b.gravity));
    for (a, b) in a.blocks.iter().zip(&b.blocks) {
        assert!(a.corners.iter().zip(&b.corners).all(|(p, q)| near(p.x, q.x) && near(p.y, q.y)));
        let (ea, eb) = (a.elasticity.unwrap(), b.elasticity.unwrap());
        assert!(near(ea.young, 1e9) && near(eb.young, 1e9) && near(ea.poisson, eb.poisson));
        assert_eq!((a.density, &a.name), (b.density, &b.name));
        assert_eq!(a.loads.len(), b.loads.len());
        for (a, b) in a.edge_loads().zip(b.edge_loads()) {
            assert!(near(a.from, b.from) && near(a.to, b.to) && a.edge == b.edge);
            assert!(
                near(a.traction[0].x, b.traction[0].x) && near(a.traction[0].y, b.traction[0].y)
            );
        }
    }
    for (a, b) in a.contacts.iter().zip(&b.contacts) {
        assert!(near(a.weight, b.weight) && near(a.gap, b.gap) && a.law == b.law);
    }
    // The load reaches five bricks of the top course, the first in part.
    let loads = || a.blocks.iter().flat_map(PlacedBlock::edge_loads);
    let on_top: Vec<_> = loads().filter(|load| load.edge == 2).collect();
    assert!(on_top.len() == 5 && on_top.iter().all(|load| near(load.traction[0].y, -12e3)));
    let floor = a.contacts.iter().filter(|point| point.a.is_none());
    assert!(floor.map(|point| point.gap).all(|gap| near(gap, 0.005)));
}

#[test]
fn a_load_covers_parts_of_edges_and_free_ones_only() {
    // A brick on the left half of a wider one: the load runs along the bed joint and beyond.
    let brick = Brick { length: 2.0, height: 1.0 };
    let wall = Wall::from_courses("w", "stone", brick, vec![vec![1.0], vec![0.5]]);
    let scene = on_floor(wall, 2.0).load(Load::pressure("step", [1.75, 1.0], [-1.0, 1.0], 2.0));
    let model = Model::from_scene(&scene).unwrap();
    assert!(model.blocks[1].loads.is_empty());
    let [BlockLoad::Edge(load)] = model.blocks[0].loads[..] else { panic!("one load") };
    assert_eq!(load.edge, 2);
    // Edge 2 runs from right to left.
    assert!((load.from - 0.125).abs() < 1e-15 && (load.to - 0.5).abs() < 1e-15);
    assert!((load.traction[0].y + 2.0).abs() < 1e-15);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn a_running_bond_fills_its_rectangle(
        length in 0.05..3.0_f64, height in 0.05..2.0_f64, bricks in 0.3..9.0_f64,
        courses in 1..8_u32, x in -5.0..5.0_f64, y in -5.0..5.0_f64,
    ) {
        // A last brick thinner than this is refused.
        let halves = 2.0 * bricks;
        prop_assume!((halves - halves.round()).abs() > 1e-6);
        let width = bricks * length;
        let brick = Brick { length, height };
        let wall = Wall::running_bond("w", "stone", brick, width, courses).origin([x, y]);
        let placed = bond::bricks(&wall);
        let area = width * height * f64::from(courses);
        prop_assert!((relative_area(&placed, area) - 1.0).abs() < 1e-12);
        prop_assert_eq!(placed.iter().map(|b| b.course).max(), Some(courses as usize));
        prop_assert!(placed.iter().all(|b| b.fraction > 0.0 && b.fraction <= 1.0 + 1e-12));
        let model = Model::from_scene(&on_floor(wall, width));
        prop_assert!(model.is_ok(), "{}", model.unwrap_err());
        let sum: f64 = model.unwrap().blocks.iter().map(block_area).sum();
        prop_assert!((sum / area - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_list_of_courses_has_the_area_of_its_bricks(
        courses in prop::collection::vec(prop::collection::vec(
            prop_oneof![Just(0.5), Just(1.0), Just(-1.0), 0.1..2.0_f64], 1..7), 1..7),
        length in 0.05..3.0_f64,
    ) {
        let total: f64 = courses.iter().flatten().filter(|brick| **brick > 0.0).sum();
        let brick = Brick { length, height: 0.5 };
        let wall = Wall::from_courses("w", "stone", brick, courses);
        let placed = bond::bricks(&wall);
        let area = placed.iter().map(|b| (b.high[0] - b.low[0]) * 0.5).sum::<f64>();
        prop_assert!((area - total * length * 0.5).abs() <= 1e-12 * (1.0 + area));
        for pair in placed.windows(2).filter(|pair| pair[0].course == pair[1].course) {
            prop_assert!(pair[0].high[0] <= pair[1].low[0]);
        }
    }

    #[test]
    fn arbitrary_text_never_panics(text in "\\PC{0,200}") {
        if let Err(error) = Scene::from_toml(&text) {
            prop_assert!(!error.to_string().is_empty());
        }
    }

    #[test]
    fn a_scene_with_arbitrary_bytes_in_it_never_panics(
        at in 0..1000_usize, bytes in prop::collection::vec(any::<u8>(), 0..6), cut in 0..6_usize,
    ) {
        let mut text = GOOD.as_bytes().to_vec();
        let at = at % text.len();
        let end = (at + cut).min(text.len());
        text.splice(at..end, bytes);
        check_without_panic(&text);
    }

    #[test]
    fn a_scene_with_arbitrary_numbers_never_panics(
        which in 0..40_usize, number in prop_oneof![any::<f64>(), Just(0.0), -2.0..2.0_f64],
    ) {
        let starts: Vec<usize> = GOOD
            .match_indices(|c: char| c.is_ascii_digit())
            .map(|(at, _)| at)
            .filter(|at| !GOOD[..*at].ends_with(|c: char| c.is_ascii_digit() || c == '.'))
            .collect();
        let start = starts[which % starts.len()];
        let rest = &GOOD[start..];
        let length = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
        let text = format!("{}{number:?}{}", &GOOD[..start], &rest[length..]);
        check_without_panic(text.as_bytes());
    }
}

/// Whatever the bytes say: a model without NaN, or an error with a message.
fn check_without_panic(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match Scene::from_toml(&text).and_then(|scene| Model::from_scene(&scene)) {
        Ok(model) => {
            assert!(model.thickness.is_finite());
            assert!(model.contacts.iter().all(|point| point.weight.is_finite()));
            assert!(model.blocks.iter().all(|block| block_area(block) > 0.0));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

const GOOD: &str = r#"
title = "wall"
plane = "stress"
thickness = 1.0
gravity = [0.0, -9.81]
units = { length = "cm", force = "N" }
materials.brick = { E = 100.0, nu = 0.15, density = 1800.0 }
joints = { bed = { mu = 0.5 }, head = { phi_deg = 30.0 } }
[[walls]]
name = "panel"
material = "brick"
origin = [0.0, 0.0]
brick = { length = 20.0, height = 10.0 }
width = 70.0
courses = 3
mesh = [2, 1]
[[supports]]
name = "floor"
from = [0.0, 0.0]
to = [70.0, 0.0]
joint = "bed"
[[loads]]
name = "top"
from = [0.0, 30.0]
to = [70.0, 30.0]
pressure = 1.0
"#;

#[test]
fn the_scene_to_be_spoilt_is_good() {
    let scene = Scene::from_toml(GOOD).unwrap();
    assert_eq!(Model::from_scene(&scene).unwrap().blocks.len(), 12);
}
