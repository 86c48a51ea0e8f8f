//! Pictures: well-formed, complete, finite, in ordinary and in degenerate cases.

mod loads;
use crate::synthetic;

use std::fs;
use std::path::PathBuf;

use masonry::analysis::outcome::{Outcome, PointStatus};
use masonry::ids::LoadId;
use masonry::model::{EdgeLoad, Model, Movement, PlacedBlock, PlacedSupport};
use masonry::scene::{Brick, Scene, Support, Wall as SceneWall};
use masonry::units::{ForceUnit, LengthUnit, Units};
use masonry_report::svg::{self, ReferenceLines};
use nalgebra::{Point2, Vector2};
use roxmltree::{Document, Node};
use synthetic::Wall;

/// Keeps the picture for the eye, and hands it back.
fn kept(name: &str, picture: String) -> String {
    let dir = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("output").join("pictures");
    fs::create_dir_all(&dir).expect("the build directory is writable");
    fs::write(dir.join(name), &picture).expect("the build directory is writable");
    picture
}

/// Parses a picture and asserts that nothing in it is infinite or undefined, and that every text
/// stays on the sheet.
fn checked(picture: &str) -> Document<'_> {
    for word in ["NaN", "inf"] {
        let numbers = picture.split('"').skip(1).step_by(2);
        assert_eq!(numbers.filter(|value| value.contains(word)).count(), 0, "{word}");
    }
    let document = Document::parse(picture).expect("a well-formed file");
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "svg");
    let (width, height) = (number(root, "width"), number(root, "height"));
    assert_eq!(root.attribute("viewBox"), Some(&*format!("0 0 {width} {height}")));
    assert!(width > 0.0 && height > 0.0 && height < 1500.0, "{width} x {height}");
    for text in document.descendants().filter(|node| node.has_tag_name("text")) {
        let length = text.text().map_or(0, |it| it.chars().count()) as f64;
        let length = 0.5 * length * number(text, "font-size");
        let x = number(text, "x");
        let (left, right) = match text.attribute("text-anchor") {
            Some("start") => (x, x + length),
            Some("middle") => (x - 0.5 * length, x + 0.5 * length),
            _ => (x - length, x),
        };
        assert!(left >= 0.0 && right <= width, "{:?} is cut off", text.text());
        assert!((0.0..=height).contains(&number(text, "y")), "{:?} is cut off", text.text());
    }
    document
}

fn number(node: Node<'_, '_>, name: &str) -> f64 {
    let value = node.attribute(name).and_then(|value| value.parse().ok());
    value.unwrap_or_else(|| panic!("{name} of {node:?} is not a number"))
}

/// The points of a path.
fn points(path: Node<'_, '_>) -> Vec<[f64; 2]> {
    let data = path.attribute("d").expect("a path has data").trim_end_matches('Z');
    let point = |it: &str| {
        let (x, y) = it.split_once(' ').expect("a point");
        [x, y].map(|it| it.parse().expect("a number"))
    };
    data.split(['M', 'L', 'Z']).filter(|it| !it.is_empty()).map(point).collect()
}

fn groups<'a>(document: &'a Document<'a>, class: &str) -> Vec<Node<'a, 'a>> {
    let drawing = document.descendants().find(|node| node.attribute("class") == Some("drawing"));
    let all = drawing.expect("every sheet has a drawing").descendants();
    // Colours are classes of their own.
    let name = |node: &Node<'a, 'a>| node.attribute("class")?.split(" colour").next();
    all.filter(|node| name(node) == Some(class)).collect()
}

fn marks(document: &Document<'_>, class: &str) -> usize {
    groups(document, class)
        .iter()
        .map(|group| group.children().filter(Node::is_element).count())
        .sum()
}

fn texts(document: &Document<'_>) -> String {
    let texts: Vec<&str> = document
        .descendants()
        .filter(|node| node.has_tag_name("text"))
        .filter_map(|node| node.text())
        .collect();
    texts.join(" ").replace('\u{a0}', " ")
}

fn stresses(outcome: &Outcome, reference: Option<&ReferenceLines>) -> String {
    let state = outcome.state.as_ref().expect("solved");
    svg::principal_stresses(&outcome.title, &outcome.model, state, reference)
}

fn deformed(outcome: &Outcome) -> String {
    let state = outcome.state.as_ref().expect("solved");
    svg::deformed(&outcome.title, &outcome.model, state)
}

#[test]
fn every_element_has_two_strokes_and_every_open_or_sliding_point_a_mark() {
    let outcome = synthetic::solved(Wall::PANEL);
    let reference = ReferenceLines {
        origins: [Point2::new(0.2, 0.0), Point2::new(0.8, 0.0)],
        angle: 45_f64.to_radians(),
        label: "arctan(l / 2h) = 45° & more".to_owned(),
    };
    let picture = kept("stresses.svg", stresses(&outcome, Some(&reference)));
    let document = checked(&picture);
    let state = outcome.state.unwrap();
    let tensile = |value: &f64| *value > 0.0;
    let values: Vec<f64> = state
        .stresses
        .iter()
        .flat_map(|stress| [stress.principal.sigma_1, stress.principal.sigma_2])
        .collect();
    let stretched = values.iter().filter(|it| tensile(it)).count();
    assert!(stretched > 0);
    assert_eq!(marks(&document, "tension"), stretched);
    assert_eq!(marks(&document, "compression"), values.len() - stretched);
    let count = |status| state.contacts.iter().filter(|contact| contact.status == status).count();
    assert_eq!(marks(&document, "open"), count(PointStatus::Open));
    assert_eq!(marks(&document, "slip"), count(PointStatus::Slip));
    assert_eq!(marks(&document, "bricks"), outcome.model.blocks.len());
    assert_eq!(marks(&document, "reference"), 2);
    let texts = texts(&document);
    for text in ["<open base>", "45° & more", "kPa", "17 contact points"] {
        assert!(texts.contains(text), "{text} is not in {texts}");
    }
}

#[test]
fn reference_lines_rise_at_their_angle_and_meet() {
    let outcome = synthetic::solved(Wall::PANEL);
    let angle = 0.5_f64.atan();
    let origins = [Point2::new(0.2, 0.0), Point2::new(0.8, 0.0)];
    let lines = ReferenceLines { origins, angle, label: "reference".to_owned() };
    let picture = stresses(&outcome, Some(&lines));
    let document = checked(&picture);
    let group = &groups(&document, "reference")[0];
    let mut tips = Vec::new();
    for (line, lean) in group.children().filter(Node::is_element).zip([1.0, -1.0]) {
        let [from, to] = points(line)[..] else { panic!("a line") };
        let (dx, dy) = (to[0] - from[0], from[1] - to[1]);
        assert!((dx / dy - lean * 0.5).abs() < 1e-3, "{dx} over {dy}");
        tips.push(to);
    }
    assert!([0, 1].iter().all(|k| (tips[0][*k] - tips[1][*k]).abs() < 0.02), "{tips:?}");
}

#[test]
fn the_largest_stroke_is_proportional_to_the_scale_bar() {
    let outcome = synthetic::solved(Wall::PANEL);
    let picture = stresses(&outcome, None);
    let document = checked(&picture);
    let length = |path: Node<'_, '_>| {
        let ends = points(path);
        (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1])
    };
    let compression = &groups(&document, "compression")[0];
    let longest = compression.children().filter(Node::is_element).map(length).fold(0.0, f64::max);
    let legend = texts(&document);
    let (_, after) = legend.split_once("stroke of ").unwrap();
    let value: f64 = after.split(' ').next().unwrap().parse().unwrap();
    let bar = document
        .descendants()
        .filter(|node| node.has_tag_name("g") && node.attribute("transform").is_some())
        .find(|node| {
            let text = node.next_sibling_element().and_then(|it| it.text());
            text.is_some_and(|text| text.starts_with("stroke of"))
        })
        .unwrap();
    let line = bar.descendants().find(|it| it.has_tag_name("path")).unwrap();
    let bar = length(line);
    let largest =
        outcome.state.unwrap().stresses.iter().map(|it| -it.principal.sigma_2).fold(0.0, f64::max);
    assert!((longest / bar - largest / 1e3 / value).abs() < 0.01, "{longest} {bar} {value}");
}

#[test]
fn the_deformed_structure_shows_every_block_and_its_factor() {
    let outcome = synthetic::solved(Wall::PANEL);
    let picture = kept("deformed.svg", deformed(&outcome));
    let document = checked(&picture);
    let blocks = outcome.model.blocks.len();
    assert_eq!(marks(&document, "deformed"), blocks);
    assert_eq!(marks(&document, "undeformed"), blocks);
    // 4 x 2 elements have 3 + 1 lines between them.
    assert_eq!(marks(&document, "mesh"), 4 * blocks);
    assert!(texts(&document).contains("magnified 500 times"), "{}", texts(&document));
}

#[test]
fn the_scene_names_blocks_and_loads() {
    let outcome = synthetic::solved(Wall::PANEL);
    let picture = kept("scene.svg", svg::scene(&outcome.title, &outcome.model));
    let document = checked(&picture);
    assert_eq!(marks(&document, "names"), outcome.model.blocks.len());
    assert_eq!(marks(&document, "joints"), outcome.model.joints.len());
    assert_eq!(marks(&document, "contacts"), outcome.model.contacts.len());
    assert!(texts(&document).contains("10 kPa"));
}

/// A script finds every block, joint, support and load of a picture by its name or number, whatever the name.
#[test]
fn elements_know_what_they_are() {
    let mut outcome = synthetic::solved(Wall::PANEL);
    let model = &mut outcome.model;
    model.blocks[0].name = "a <\"stone\"> & mortar".to_owned();
    let model = &outcome.model;
    let state = outcome.state.as_ref().unwrap();
    let named = |picture: &str, name: &str| -> Vec<String> {
        let document = checked(picture);
        let values = document.descendants().filter_map(|it| it.attribute(name));
        let mut values: Vec<String> = values.map(str::to_owned).collect();
        values.sort();
        values.dedup();
        values
    };
    let mut blocks: Vec<String> = model.blocks.iter().map(|it| it.name.clone()).collect();
    let mut supports: Vec<String> = model.supports.iter().map(|it| it.name.clone()).collect();
    blocks.sort();
    supports.sort();
    let scene = svg::scene("", model);
    let pictures = [
        scene.clone(),
        svg::deformed("", model, state),
        svg::forces("", model, &state.contacts),
        svg::cracks("", model, &state.contacts).unwrap(),
    ];
    for picture in &pictures {
        assert_eq!(named(picture, "data-block"), blocks);
        assert_eq!(named(picture, "data-support"), supports);
    }
    assert_eq!(named(&scene, "data-joint").len(), model.joints.len());
    assert_eq!(named(&scene, "data-load"), ["1"]);
    let mut classes: Vec<usize> = model.joints.iter().map(|it| it.class).collect();
    classes.sort_unstable();
    classes.dedup();
    assert_eq!(named(&scene, "data-class").len(), classes.len());
}

#[test]
fn a_mechanism_shows_what_moves() {
    let outcome = synthetic::unsolved(Wall::PANEL);
    let rates = outcome.mechanism.as_ref().unwrap();
    let moving = rates.iter().filter(|rate| rate.iter().any(|v| v.norm() > 0.0)).count();
    let picture = kept("mechanism.svg", svg::mechanism(&outcome.title, &outcome.model, rates));
    let document = checked(&picture);
    assert!(moving > 0);
    assert_eq!(marks(&document, "moving"), moving);
    assert_eq!(marks(&document, "still"), rates.len() - moving);
}

#[test]
fn nothing_that_moves_and_no_stress_is_drawn_as_such() {
    let mut outcome = synthetic::solved(Wall::PANEL);
    let state = outcome.state.as_mut().unwrap();
    for u in state.displacements.iter_mut().flatten() {
        *u = Vector2::zeros();
    }
    for stress in &mut state.stresses {
        stress.sigma = [0.0; 3];
        (stress.principal.sigma_1, stress.principal.sigma_2) = (0.0, 0.0);
    }
    assert!(texts(&checked(&deformed(&outcome))).contains("no displacement"));
    let picture = stresses(&outcome, None);
    assert!(texts(&checked(&picture)).contains("no stress"));
    let still = vec![vec![Vector2::zeros(); 4]; outcome.model.blocks.len()];
    checked(&svg::mechanism("", &outcome.model, &still));
}

/// The lines are drawn where the bond carries them, and not into a doorway.
#[test]
fn the_lines_of_the_bond_stay_in_the_wall() {
    let brick = Brick { length: 0.25, height: 0.125 };
    let scene = |courses: Vec<Vec<f64>>| {
        Scene::new("", Units::SI)
            .wall(SceneWall::from_courses("wall", "brick", brick, courses))
            .support(Support::new("left", [0.0, 0.0], [0.5, 0.0], "bed"))
            .support(Support::new("right", [1.0, 0.0], [1.5, 0.0], "bed"))
    };
    let whole = |k: usize| {
        if k.is_multiple_of(2) { vec![1.0; 6] } else { vec![0.5, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5] }
    };
    let lines = ReferenceLines::of(&scene((0..8).map(whole).collect())).unwrap();
    assert_eq!(lines.origins, [Point2::new(0.5, 0.0), Point2::new(1.0, 0.0)]);
    let door = |k: usize| if k < 4 { vec![1.0, 1.0, -2.0, 1.0, 1.0] } else { whole(k) };
    assert!(ReferenceLines::of(&scene((0..8).map(door).collect())).is_none());
    // Joints above each other.
    assert!(ReferenceLines::of(&scene(vec![vec![1.0; 6]; 8])).is_none());
}

#[test]
fn one_rigid_block_has_a_picture() {
    let wall = Wall { bricks: 1, courses: 1, rigid: true, ..Wall::PANEL };
    let outcome = synthetic::solved(wall);
    checked(&kept("one_stresses.svg", stresses(&outcome, None)));
    checked(&kept("one_deformed.svg", deformed(&outcome)));
    checked(&kept("one_scene.svg", svg::scene("One block", &outcome.model)));
}

#[test]
fn an_empty_model_has_a_picture() {
    let mut outcome = synthetic::solved(Wall::PANEL);
    let model = &mut outcome.model;
    model.blocks.clear();
    model.supports.clear();
    model.joints.clear();
    model.contacts.clear();
    let state = outcome.state.as_mut().unwrap();
    state.displacements.clear();
    state.contacts.clear();
    state.stresses.clear();
    checked(&stresses(&outcome, None));
    checked(&deformed(&outcome));
    checked(&svg::scene("", &outcome.model));
}

#[test]
fn two_thousand_bricks_have_a_picture() {
    let wall =
        Wall { length: 25.0, height: 6.5, bricks: 40, courses: 49, elements: (2, 1), rigid: false };
    let outcome = synthetic::solved(wall);
    assert!(outcome.model.blocks.len() > 1980);
    let picture = kept("many_stresses.svg", stresses(&outcome, None));
    assert_eq!(marks(&checked(&picture), "bricks"), outcome.model.blocks.len());
    checked(&kept("many_deformed.svg", deformed(&outcome)));
    let picture = kept("many_scene.svg", svg::scene(&outcome.title, &outcome.model));
    assert_eq!(marks(&checked(&picture), "names"), 0);
}

#[test]
fn tall_and_long_walls_fit_the_sheet() {
    let tall = Wall { bricks: 1, courses: 30, ..Wall::PANEL };
    let long = Wall { bricks: 30, courses: 4, ..Wall::PANEL };
    for (name, wall) in [("tall", tall), ("long", long)] {
        let outcome = synthetic::solved(wall);
        checked(&kept(&format!("{name}_stresses.svg"), stresses(&outcome, None)));
        checked(&kept(&format!("{name}_deformed.svg"), deformed(&outcome)));
        checked(&kept(&format!("{name}_scene.svg"), svg::scene(name, &outcome.model)));
    }
}

/// A ring of wedges under self weight, with loads in every direction and another unit.
fn arch() -> Model {
    let mut model = synthetic::model(Wall { bricks: 1, courses: 1, ..Wall::PANEL });
    let wedges = 9;
    let at = |radius: f64, k: usize| {
        let angle = std::f64::consts::PI * (1.0 - k as f64 / f64::from(wedges));
        Point2::new(radius * angle.cos(), radius * angle.sin())
    };
    model.blocks = (0..9)
        .map(|k| PlacedBlock {
            name: format!("V{}", k + 1),
            corners: vec![at(1.0, k + 1), at(1.25, k + 1), at(1.25, k), at(1.0, k)],
            elasticity: None,
            density: Some(2000.0),
            mesh: None,
            loads: Vec::new(),
        })
        .collect();
    let mut load = |block: usize, edge: usize, x: f64, y: f64| {
        let traction = Vector2::new(x, y);
        let load = EdgeLoad { edge, from: 0.1, to: 0.9, traction: [traction; 2], load: LoadId(0) };
        model.blocks[block].loads.push(load.into());
    };
    load(4, 1, 0.0, -12e3);
    load(0, 1, 5e3, 0.0);
    load(8, 1, 3e3, 0.0);
    load(4, 3, 4e3, 0.0);
    load(2, 1, 2e3, 2e3);
    model.supports = [("left", -1.3, -0.95), ("right", 0.95, 1.3)]
        .map(|(name, from, to)| PlacedSupport {
            name: name.to_owned(),
            from: Point2::new(from, 0.0),
            to: Point2::new(to, 0.0),
            movement: Movement::default(),
        })
        .to_vec();
    model.joints.clear();
    model.contacts.clear();
    model.units = Units { length: LengthUnit::Mm, force: ForceUnit::N };
    model
}

#[test]
fn loads_in_every_direction_are_drawn_with_their_values() {
    let model = arch();
    let picture = kept("arch_scene.svg", svg::scene("Arch", &model));
    let document = checked(&picture);
    let texts = texts(&document);
    for text in ["12 kPa", "5 kPa", "4 kPa", "self weight, 9.81 m/s²"] {
        assert!(texts.contains(text), "{text} is not in {texts}");
    }
}

#[test]
fn names_cannot_break_the_file() {
    let mut outcome = synthetic::solved(Wall::PANEL);
    outcome.title = "\u{1}a <b> & \"c\" ]]> 'd' \u{7f}".to_owned();
    outcome.model.blocks[0].name = "<&>".to_owned();
    outcome.model.joint_classes[0].name = "bed".repeat(30);
    let picture = svg::scene(&outcome.title, &outcome.model);
    let texts = texts(&checked(&picture));
    let long = "long".repeat(100);
    checked(&svg::scene(&long, &outcome.model));
    assert!(texts.contains("<&>") && texts.contains("a <b> & \"c\" ]]> 'd'"), "{texts}");
}
