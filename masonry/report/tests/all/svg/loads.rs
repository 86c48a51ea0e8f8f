//! Pictures of forces at places and of accelerations.

use masonry::model::Model;
use masonry::scene::{Brick, Joint, Load, Material, Scene, Support, Wall};
use masonry::units::{ForceUnit, LengthUnit, Units};
use masonry_report::svg;
use roxmltree::Node;

use super::{checked, groups, kept, marks, number, points, texts};

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
    assert_eq!(marks(&document, "loads"), 3);
    // Each with its number in the scene.
    let loads: Vec<_> = groups(&document, "loads")[0].children().filter(Node::is_element).collect();
    let numbers: Vec<_> = loads.iter().filter_map(|it| it.attribute("data-load")).collect();
    assert_eq!(numbers, ["3", "2", "1"]);
    let texts = texts(&document);
    for label in ["7.5 kN", "2.5 kN", "3.536 kN", "point loads, 2.5 kN to 7.5 kN"] {
        assert!(texts.contains(label), "no {label} in {texts}");
    }
    assert!(!texts.contains("edge load") && !texts.contains("acceleration"));
    // An arrow, whose first two points are its tail and its neck, and a dot at its place.
    let of = |load: &Node<'_, '_>| {
        let shape = |name: &str| load.children().find(|it| it.has_tag_name(name)).expect("a shape");
        let ends = points(shape("path"));
        ([ends[0], ends[1]], ["cx", "cy"].map(|name| number(shape("circle"), name)))
    };
    // The rope pulls at the edge: its head lies beyond its place, on the right.
    let ([tail, neck], place) = of(&loads[1]);
    assert!((tail[0] - place[0]).abs() < 0.02 && neck[0] > tail[0], "{picture}");
    // The beam presses: its head is at its place, on the top.
    let ([tail, _], place) = of(&loads[2]);
    assert!(tail[1] < place[1] - 20.0, "{picture}");
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
    assert_eq!(marks(&document, "accelerations"), 3);
    let texts = texts(&document);
    for label in [
        "0.98 m/s²",
        "0.5 m/s²",
        "1.5 m/s²",
        "body accelerations, 0.5 m/s² to 1.5 m/s²",
        "edge load, 2 kPa",
    ] {
        assert!(texts.contains(label), "no {label} in {texts}");
    }
    // Each pushes from its side, outside of the arrows of the wind.
    let ends = |class| -> Vec<[f64; 2]> {
        let paths = groups(&document, class).into_iter().flat_map(|it| it.descendants());
        let paths = paths.filter(|it| it.has_tag_name("path")).map(points);
        paths.map(|points| [points[0][0], points[1][0]]).collect()
    };
    let (shakes, winds) = (ends("accelerations"), ends("loads"));
    let leftmost = winds.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    let rightmost = winds.iter().flatten().copied().fold(0.0, f64::max);
    assert!(shakes[..2].iter().flatten().all(|x| *x < leftmost), "{shakes:?} {leftmost}");
    assert!(shakes[2][1] < shakes[2][0] && shakes[2][1] > rightmost, "{shakes:?} {rightmost}");
}

/// A linear pressure has arrows as long as it is large there, below one line, and one label.
#[test]
fn a_linear_pressure_is_a_row_of_growing_arrows() {
    let load = Load::pressure("earth", [0.0, 1.0], [0.0, 0.0], [0.0, 8.0]);
    let picture = kept("linear.svg", svg::scene("Earth", &wall(&[load])));
    let document = checked(&picture);
    let label = "edge load, up to 8 kPa";
    assert!(texts(&document).contains(label), "{}", texts(&document));
    let paths = groups(&document, "loads").into_iter().flat_map(|it| it.descendants());
    let paths: Vec<_> = paths.filter(|it| it.has_tag_name("path")).map(points).collect();
    assert_eq!(paths.len(), 4, "one for each block at the left");
    // Tail and neck of the first arrow of each, from the lowest block upwards.
    let lengths: Vec<f64> = paths.iter().map(|it| it[1][0] - it[0][0]).collect();
    assert!(lengths.windows(2).all(|pair| pair[0] > pair[1]) && lengths[3] > 0.0, "{lengths:?}");
}

#[test]
fn a_moment_is_an_arrow_around_its_place() {
    let loads = [
        Load::moment("left", "wall/4/2", [0.5, 1.0], 2.5),
        Load::moment("right", "wall/1/1", [0.25, 0.125], -1.25),
        Load::moment("none", "wall/1/1", [0.25, 0.125], 0.0),
    ];
    let picture = kept("moments.svg", svg::scene("Moments", &wall(&loads)));
    let document = checked(&picture);
    assert_eq!(marks(&document, "loads"), 2);
    let texts = texts(&document);
    for label in ["2.5 kNm", "1.25 kNm", "moments, 1.25 kNm to 2.5 kNm"] {
        assert!(texts.contains(label), "no {label} in {texts}");
    }
    // Each begins below its place, on the side from which it goes over the top.
    let group = groups(&document, "loads")[0];
    let sides: Vec<bool> = group
        .children()
        .filter(Node::is_element)
        .map(|load| {
            let shape =
                |name: &str| load.children().find(|it| it.has_tag_name(name)).expect("a shape");
            points(shape("path"))[0][0] > number(shape("circle"), "cx")
        })
        .collect();
    assert_eq!(sides, [false, true], "blocks from below: the one to the right begins at the left");
}
