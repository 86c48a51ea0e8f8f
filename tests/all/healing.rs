//! Drawings whose corners are rounded: blocks that touch in them overlap, or stand apart, by the last decimal.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::analysis::solve::solve;
use masonry::data::verdict::Verdict;
use masonry::geometry;
use masonry::model::heal::heal;
use masonry::model::{Model, PlacedBlock};
use masonry::scene::{Block, Brick, Joint, Load, Material, Scene, Support, Wall};
use nalgebra::Point2;

use crate::common::M_KN;
use crate::random_walls::Random;

/// Corners with so many decimals.
fn rounded(corners: &[[f64; 2]], decimals: i32) -> Vec<[f64; 2]> {
    let unit = 10_f64.powi(decimals);
    corners.iter().map(|corner| corner.map(|x| (x * unit).round() / unit)).collect()
}

fn turned([x, y]: [f64; 2], degrees: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

fn scene(blocks: Vec<Vec<[f64; 2]>>, floor: [[f64; 2]; 2]) -> Scene {
    let scene = Scene::new("Drawing", M_KN)
        .thickness(0.3)
        .gravity([0.0, -9.81])
        .material("stone", Material::rigid().density(2000.0))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .support(Support::new("ground", floor[0], floor[1], "bed"));
    let named = blocks.into_iter().enumerate();
    named.fold(scene, |scene, (k, corners)| {
        scene.block(Block::new(&k.to_string(), "stone", corners))
    })
}

/// A wall of `courses` courses of eight bricks in running bond, turned and rounded.
fn wall(courses: usize, degrees: f64, decimals: i32) -> Scene {
    let mut blocks = Vec::new();
    for course in 0..courses {
        let y = 0.25 * course as f64;
        let shift = if course % 2 == 0 { 0.0 } else { 0.25 };
        let mut ends: Vec<f64> = (0..=8).map(|k| 0.5 * f64::from(k) - shift).collect();
        if course % 2 == 1 {
            ends[0] = 0.0;
            ends.push(4.0);
        }
        for pair in ends.windows(2) {
            let corners = [[pair[0], y], [pair[1], y], [pair[1], y + 0.25], [pair[0], y + 0.25]];
            let corners = corners.map(|corner| turned(corner, degrees));
            blocks.push(rounded(&corners, decimals));
        }
    }
    let floor = [[0.0, 0.0], [4.0, 0.0]].map(|end| turned(end, degrees));
    scene(blocks, [rounded(&floor, decimals)[0], rounded(&floor, decimals)[1]])
}

/// Every joint of the exact wall is there, closed to the last digits.
fn assert_exact(model: &Model, exact: &Model, moved: f64) {
    assert_eq!(model.joints.len(), exact.joints.len());
    assert_eq!(model.contacts.len(), exact.contacts.len());
    let widest = model.contacts.iter().map(|it| it.gap.abs()).fold(0.0, f64::max);
    assert!(widest <= 1e-13, "{widest}");
    let healed = model.healed.clone().unwrap();
    assert!(healed.largest <= moved, "{healed:?}");
    for (one, other) in model.blocks.iter().zip(&model.blocks[1..]) {
        assert!(geometry::overlap_area(&one.corners, &other.corners) <= 1e-13);
    }
}

#[test]
fn a_turned_wall_with_six_decimals_stands() {
    let exact = Model::from_scene(&wall(6, 0.0, 15)).unwrap();
    assert!(exact.healed.is_none());
    let scene = wall(6, 5.0, 6);
    assert_exact(&Model::from_scene(&scene).unwrap(), &exact, 2e-6);
    let outcome = solve(&scene).unwrap();
    assert_eq!(outcome.judgement.verdict, Verdict::Stands);
    let moved = outcome.model.healed.unwrap().corners;
    let told = format!("{moved} corners of single blocks moved by up to");
    assert!(outcome.judgement.warnings.iter().any(|it| it.starts_with(&told)), "{told}");
}

/// Millimetres are more than the default heals; the message says which key does.
#[test]
fn a_wall_in_millimetres_is_healed_by_its_own_tolerance() {
    let exact = Model::from_scene(&wall(6, 0.0, 15)).unwrap();
    let error = Model::from_scene(&wall(6, 5.0, 3)).unwrap_err().to_string();
    assert!(error.contains("`contact.tolerance`"), "{error}");
    let scene = wall(6, 5.0, 3).contact_tolerance(0.002);
    let model = Model::from_scene(&scene).unwrap();
    assert_exact(&model, &exact, 0.002);
}

/// The limit load of a healed wall is that of the exact one, up to what its corners were moved.
#[test]
fn a_healed_wall_carries_what_the_exact_one_does() {
    let factor = |scene: Scene| {
        let scene = scene.load(Load::acceleration("quake", [0.981, 0.0]));
        limit_by(&scene, Laws::Associative).unwrap().associative.unwrap().bound.unwrap()
    };
    let exact = factor(wall(6, 0.0, 15));
    let healed = factor(wall(6, 90.0 / 1e6, 6));
    assert!((healed / exact - 1.0).abs() < 1e-4, "{healed} and {exact}");
}

/// Tops that rounding tilts are loaded as they are drawn: the floor carries the whole pressure.
#[test]
fn loads_stay_on_edges_that_were_moved() {
    let corners = |[a, b]: [[f64; 2]; 2]| vec![[a[0], 0.0], [b[0], 0.0], b, a];
    let tops =
        [[[0.0, 1.0], [1.0, 1.000_001]], [[0.999_999, 1.0], [2.0, 1.0]], [[2.0, 1.0], [3.0, 1.0]]];
    let scene = scene(tops.map(corners).to_vec(), [[0.0, 0.0], [3.0, 0.0]]).load(Load::pressure(
        "top",
        [0.0, 1.0],
        [3.0, 1.0],
        10.0,
    ));
    let outcome = solve(&scene).unwrap();
    assert!(outcome.model.healed.is_some());
    let weight = 2.0 * 9.81 * 0.3 * 3.0;
    let carried = outcome.reactions[0].fy / 1e3;
    assert!((carried - weight - 10.0 * 0.3 * 3.0).abs() < 1e-4, "{carried}");
}

#[test]
fn a_wall_a_little_below_its_support_is_told_of_the_tolerance() {
    let mut below = wall(2, 0.0, 6);
    below.blocks.iter_mut().flat_map(|it| &mut it.corners).for_each(|[_, y]| *y -= 1e-6);
    let error = Model::from_scene(&below).unwrap_err().to_string();
    assert!(error.contains("support \"ground\" runs through the inside of block"), "{error}");
    assert!(error.contains("`contact.tolerance` to three times the error"), "{error}");
    let healed = Model::from_scene(&below.contact_tolerance(3e-6)).unwrap();
    assert_exact(&healed, &Model::from_scene(&wall(2, 0.0, 6)).unwrap(), 3e-6);
}

/// No edge vanishes, and no corner moves farther than a few tolerances.
#[test]
fn what_cannot_be_healed_is_told() {
    let lower = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    let tip = vec![[0.0, 1.0005], [2.0, 1.001], [2.0, 1.5], [0.0, 1.5]];
    let error = |tolerance: f64| {
        let scene = scene(vec![lower.clone(), tip.clone()], [[0.0, 0.0], [2.0, 0.0]]);
        Model::from_scene(&scene.contact_tolerance(tolerance)).unwrap_err().to_string()
    };
    assert!(error(0.3).contains("a quarter of the shortest edge"), "{}", error(0.3));
    // Two supports that meet at a hundredth far outside: the corner that is near both would have to move there.
    let between = vec![[0.0, 0.0002], [1.0, 0.0002], [1.0, 1.0], [0.0, 1.0]];
    let scene = scene(vec![between], [[0.0, 0.0], [2.0, 0.0]]).support(Support::new(
        "lean",
        [0.0, 0.0006],
        [2.0, 0.0206],
        "bed",
    ));
    let error = Model::from_scene(&scene.contact_tolerance(0.001)).unwrap_err().to_string();
    assert!(error.contains("can be put onto them"), "{error}");
}

/// Gaps are closed only if a tolerance says so, and not beyond it; overlaps of rounding are.
#[test]
fn gaps_beyond_the_tolerance_stay() {
    let corners = |x: f64| vec![[x, 0.0], [x + 0.4, 0.0], [x + 0.4, 0.3], [x, 0.3]];
    let apart = |gap: f64, tolerance: Option<f64>| {
        let scene = scene(vec![corners(0.0), corners(0.4 + gap)], [[-1.0, 0.0], [2.0, 0.0]]);
        let healed = tolerance.into_iter().fold(scene, Scene::contact_tolerance);
        let model = Model::from_scene(&healed).unwrap();
        (model.joints.len(), model.healed.is_some())
    };
    assert_eq!(apart(1e-6, None), (2, false));
    assert_eq!(apart(1e-6, Some(1e-5)), (3, true));
    assert_eq!(apart(1e-4, Some(1e-5)), (2, false));
    assert_eq!(apart(-1e-6, None), (3, true));
}

/// Courses of stones of these lengths, again and again, shifted from course to course.
fn bond(lengths: &[f64], shift: f64, courses: usize) -> Vec<Vec<[f64; 2]>> {
    const WIDTH: f64 = 4.0;
    let period: f64 = lengths.iter().sum();
    let mut blocks = Vec::new();
    for course in 0..courses {
        let (low, high) = (0.25 * course as f64, 0.25 * (course + 1) as f64);
        let start = -(shift * course as f64).rem_euclid(period);
        let joints = lengths.iter().cycle().scan(start, |at, length| {
            *at += length;
            Some(*at)
        });
        let inside = |it: &f64| *it < WIDTH - 1e-9;
        let mut ends: Vec<f64> = joints.take_while(inside).filter(|it| *it > 1e-9).collect();
        ends.insert(0, 0.0);
        ends.push(WIDTH);
        blocks.extend(
            ends.windows(2).map(|x| vec![[x[0], low], [x[1], low], [x[1], high], [x[0], high]]),
        );
    }
    blocks
}

/// Drawings with their exact corners: bonds that are turned, and rubble.
fn drawings() -> Vec<(&'static str, Scene)> {
    let bonds: [(&str, &[f64], f64); 5] = [
        ("half", &[0.5], 0.25),
        ("third", &[0.6], 0.2),
        ("stack", &[0.5], 0.0),
        ("Flemish", &[0.5, 0.25], 0.375),
        ("raked", &[0.5], 0.15),
    ];
    let floor = [[0.0, 0.0], [4.0, 0.0]].map(|end| turned(end, 5.0));
    let of_bond = |(name, lengths, shift): (&'static str, &[f64], f64)| {
        let mut blocks = bond(lengths, shift, 8);
        blocks.iter_mut().flatten().for_each(|corner| *corner = turned(*corner, 5.0));
        (name, scene(blocks, floor))
    };
    let mut drawings: Vec<(&str, Scene)> = bonds.into_iter().map(of_bond).collect();
    let rubble = concat!(env!("CARGO_MANIFEST_DIR"), "/masonry/live/scenes/rubble.toml");
    let mut rubble = Scene::read(rubble.as_ref()).unwrap();
    rubble.loads.clear();
    drawings.push(("rubble", rubble));
    drawings
}

/// Corners that are off by at random, each coordinate by up to so much.
fn shaken(scene: &Scene, by: f64, seed: u64) -> Scene {
    let mut random = Random(seed);
    let mut shaken = scene.clone();
    for value in shaken.blocks.iter_mut().flat_map(|it| &mut it.corners).flatten() {
        *value += by * (2.0 * random.part() - 1.0);
    }
    shaken
}

/// The factor of a push to the right, relative to the structure, at which a drawing fails.
fn push(drawing: &Scene) -> f64 {
    let push = Load::acceleration("push", turned([1.0, 0.0], 5.0));
    let pushed = drawing.clone().gravity(turned([0.0, -9.81], 5.0)).load(push);
    limit_by(&pushed, Laws::Associative).unwrap().associative.unwrap().bound.unwrap()
}

/// Corners move by 1.6 times the amplitude at most, of which the square root of two is that of both coordinates together.
#[test]
fn corners_move_by_little_more_than_they_are_off() {
    for (name, exact) in drawings() {
        let model = Model::from_scene(&exact).unwrap();
        let limit = push(&exact);
        let edges = model
            .blocks
            .iter()
            .flat_map(|it| (0..it.corners.len()).map(|k| geometry::edge(&it.corners, k)));
        let shortest = edges.map(|[a, b]| (b - a).norm()).fold(f64::INFINITY, f64::min);
        for (by, seed) in [1e-3, 3e-3].into_iter().flat_map(|by| (0..4).map(move |it| (by, it))) {
            // Two corners of one place are apart by up to the diagonal of twice the amplitude.
            let drawn = shaken(&exact, by, seed).contact_tolerance(3.0 * by);
            let healed = Model::from_scene(&drawn).unwrap();
            assert_exact(&healed, &model, 2.0 * by);

            let mut again = drawn.clone();
            for (block, of_model) in again.blocks.iter_mut().zip(&healed.blocks) {
                block.corners = of_model.corners.iter().map(|it| [it.x, it.y]).collect();
            }
            assert!(Model::from_scene(&again).unwrap().healed.is_none(), "{name}, {by}, {seed}");
            if seed == 0 {
                // To the amplitude relative to the shortest edge.
                let off = (push(&again) / limit - 1.0).abs() * shortest / by;
                assert!(off < 1.0, "{name}, {by}: {off}");
            }
        }
    }
}

/// Stones that share corners alone, without a support.
#[test]
fn corners_meet_in_the_middle() {
    let stone = |x: f64| PlacedBlock {
        name: String::new(),
        corners: [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]].map(Point2::from).to_vec(),
        elasticity: None,
        density: None,
        mesh: None,
        loads: Vec::new(),
    };
    let mut stones = [stone(0.0), stone(1.002)];
    let healed = heal(&mut stones, 2, &[], Some(0.003)).unwrap().unwrap();
    assert_eq!(healed.corners, 4);
    assert!((healed.largest - 0.001).abs() < 1e-15);
    assert_eq!(stones[0].corners[1..3], [stones[1].corners[0], stones[1].corners[3]]);
    assert_eq!(heal(&mut stones, 2, &[], Some(0.003)), Ok(None));
    // One that is far from all others.
    assert_eq!(heal(&mut [stone(0.0), stone(2.0)], 1, &[], Some(0.003)), Ok(None));
}

/// Stones on a wall of bricks, which stay, and on a support that is shorter than the lowest one.
#[test]
fn stones_move_onto_what_stays() {
    let bricks = Brick { length: 0.25, height: 0.125 };
    let wall = Wall::running_bond("wall", "stone", bricks, 2.0, 3).turn_deg(5.0);
    let corner = |x: f64, y: f64| turned([x, 0.375 + y], 5.0);
    let stone = |x: [f64; 2], y: [f64; 2]| {
        vec![corner(x[0], y[0]), corner(x[1], y[0]), corner(x[1], y[1]), corner(x[0], y[1])]
    };
    let stones = vec![
        stone([0.1, 1.2], [0.0, 0.3]),
        stone([1.2, 1.9], [0.0, 0.3]),
        stone([0.1, 1.9], [0.3, 0.5]),
    ];
    let ends = [0.4, 0.9].map(|x| corner(x, 0.5));
    let exact = scene(stones, [[0.0, 0.0], turned([2.0, 0.0], 5.0)])
        .wall(wall)
        .support(Support::new("hold", ends[0], ends[1], "bed"));
    let model = Model::from_scene(&exact).unwrap();
    for seed in 0..8 {
        let drawn = shaken(&exact, 1e-3, seed).contact_tolerance(3e-3);
        let healed = Model::from_scene(&drawn).unwrap();
        assert_exact(&healed, &model, 2e-3);
        let corners = |it: &Model| -> Vec<_> {
            it.blocks
                .iter()
                .filter(|it| it.name.starts_with("wall"))
                .map(|it| it.corners.clone())
                .collect()
        };
        assert_eq!(corners(&healed), corners(&model));
    }
}
