//! Pictures of forces at places and of accelerations.

use masonry::model::Model;
use masonry::report::svg;
use masonry::scene::{Brick, Joint, Load, Material, Scene, Support, Wall};
use masonry::units::{ForceUnit, LengthUnit, Units};
use roxmltree::{Document, Node};

use super::{checked, groups, kept, number, texts};

fn wall(loads: &[Load]) -> Model {
    let brick = Brick { length: 0.5, height: 0.25 };
    let scene = Scene::new("Wall", Units { length: LengthUnit::M, force: ForceUnit::Kn })
        .thickness(0.25)
        .material("stone", Material::rigid().density(2000.0))
        .joint("bed", Joint::mu(0.6))
        .joint("head", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "stone", brick, 1.0, 4))
        .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"));
    let scene = loads.iter().cloned().fold(scene, Scene::load);
    Model::from_scene(&scene).expect("a good scene")
}

/// How many shapes and texts a group has.
fn leaves(document: &Document<'_>, class: &str) -> usize {
    let all = groups(document, class)[0].descendants().filter(Node::is_element);
    all.filter(|it| !it.has_tag_name("g")).count()
}

/// An arrow is a line and a head; a force has a dot at its place besides, and each label a rim of its own.
#[test]
fn forces_are_arrows_at_their_places_with_their_values() {
    let loads = [
        Load::force("beam", "wall/4/2", [0.5, 1.0], [0.0, -7.5]),
        Load::force("rope", "wall/3/2", [1.0, 0.625], [2.5, 0.0]),
        Load::force("inside", "wall/1/1", [0.125, 0.125], [-5.0, -5.0]).factor(0.5),
        Load::force("none", "wall/1/1", [0.125, 0.125], [0.0, 0.0]),
    ];
    let picture = kept("forces.svg", svg::scene("Forces & a rope", &wall(&loads)));
    let document = checked(&picture);
    assert_eq!(leaves(&document, "loads"), 3 * (3 + 2));
    // Two groups a load, of its arrow and of its label, with its number in the scene.
    let numbers: Vec<_> = groups(&document, "loads")[0]
        .children()
        .filter_map(|it| it.attribute("data-load"))
        .collect();
    assert_eq!(numbers, ["3", "2", "1", "3", "2", "1"]);
    let texts = texts(&document);
    for label in ["7.5 kN", "2.5 kN", "3.536 kN", "point loads, 2.5 to 7.5 kN"] {
        assert!(texts.contains(label), "no {label} in {texts}");
    }
    assert!(!texts.contains("edge load") && !texts.contains("acceleration"));
    // The rope pulls at the edge: its head lies beyond its place, on the right.
    let dots: Vec<_> = groups(&document, "loads")[0]
        .descendants()
        .filter(|it| it.has_tag_name("circle"))
        .collect();
    let lines: Vec<_> =
        groups(&document, "loads")[0].descendants().filter(|it| it.has_tag_name("line")).collect();
    let (dot, line) = (dots[1], lines[1]);
    let starts_at_dot = (number(line, "x1") - number(dot, "cx")).abs() < 0.02;
    assert!(starts_at_dot && number(line, "x2") > number(line, "x1"), "{picture}");
    // The beam presses: its head is at its place, on the top.
    let (dot, line) = (dots[2], lines[2]);
    assert!(number(line, "y1") < number(dot, "cy") - 20.0, "{picture}");
}

#[test]
fn accelerations_are_arrows_beside_the_structure() {
    let loads = [
        Load::acceleration("quake", [0.98, 0.0]),
        Load::acceleration("aftershock", [0.3, -0.4]),
        Load::acceleration("back", [-1.5, 0.0]),
        Load::acceleration("none", [0.0, 0.0]),
        Load::traction("wind", [0.0, 0.0], [0.0, 1.0], [2.0, 0.0]),
    ];
    let picture = kept("accelerations.svg", svg::scene("Accelerations", &wall(&loads)));
    let document = checked(&picture);
    assert_eq!(leaves(&document, "accelerations"), 3 * (2 + 2));
    let texts = texts(&document);
    for label in [
        "0.98 m/s²",
        "0.5 m/s²",
        "1.5 m/s²",
        "body accelerations, 0.5 to 1.5 m/s²",
        "edge load, 2 kPa",
    ] {
        assert!(texts.contains(label), "no {label} in {texts}");
    }
    // Each pushes from its side, outside of the arrows of the wind.
    let ends = |class| -> Vec<[f64; 2]> {
        let group = groups(&document, class)[0];
        let lines = group.descendants().filter(|it| it.has_tag_name("line"));
        lines.map(|line| ["x1", "x2"].map(|end| number(line, end))).collect()
    };
    let (shakes, winds) = (ends("accelerations"), ends("loads"));
    let leftmost = winds.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    let rightmost = winds.iter().flatten().copied().fold(0.0, f64::max);
    assert!(shakes[..2].iter().flatten().all(|x| *x < leftmost), "{shakes:?} {leftmost}");
    assert!(shakes[2][1] < shakes[2][0] && shakes[2][1] > rightmost, "{shakes:?} {rightmost}");
}
