//! What joints carry and how far they open: values with closed forms, and their pictures.

use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::scene::{Block, Joint, Material, Scene, Support};
use masonry::units::Units;
use masonry_report::{joints, svg};
use nalgebra::Point2;
use roxmltree::Document;

/// A block of 0.2 m by 1 m and 2 kN on a floor, under a tenth of gravity to the right.
fn block() -> Outcome {
    let scene = Scene::new("Block", Units::SI)
        .thickness(1.0)
        .gravity([1.0, -10.0])
        .material("stone", Material::rigid().density(1000.0))
        .joint("floor", Joint::mu(0.7))
        .block(Block::new("block", "stone", [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]))
        .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "floor"));
    solve(&scene).unwrap()
}

fn texts(picture: &str) -> String {
    let document = Document::parse(picture).unwrap();
    let is_text = |node: &roxmltree::Node<'_, '_>| node.has_tag_name("text");
    let texts: Vec<_> =
        document.descendants().filter(is_text).filter_map(|node| node.text()).collect();
    texts.join(" ").replace('\u{a0}', " ")
}

#[test]
fn the_resultant_under_a_leaning_block_has_the_eccentricity_and_the_friction_of_statics() {
    let outcome = block();
    let contacts = &outcome.state.as_ref().unwrap().contacts;
    let forces = joints::forces(&outcome.model, contacts);
    let [it] = forces.as_slice() else { panic!("{forces:?}") };
    // The weight acts 0.5 m above the floor, and a tenth of it sideways: 0.05 m beside the middle of 0.2 m.
    assert!((it.eccentricity.abs() - 0.25).abs() < 1e-9, "{}", it.eccentricity);
    assert!((it.at - Point2::new(0.15, 0.0)).norm() < 1e-9, "{}", it.at);
    assert!((it.normal - 2000.0).abs() < 1e-6 && (it.force.x + 200.0).abs() < 1e-6);
    assert!((it.utilisation.unwrap() - 0.1 / 0.7).abs() < 1e-9);

    let reactions = joints::reactions(&outcome.model, &forces);
    assert_eq!(reactions.len(), 1);
    assert!((reactions[0].at - it.at).norm() < 1e-9);
    assert!((reactions[0].force - it.force).norm() < 1e-9);

    let picture = svg::forces("Block", &outcome.model, contacts);
    assert!(!picture.contains("NaN"));
    let texts = texts(&picture);
    for text in ["2010 N", "outside the middle third: 1 joint", "reaction of a support"] {
        assert!(texts.contains(text), "{text} is not in {texts}");
    }
    assert!(!texts.contains("friction used"), "{texts}");
}

#[test]
fn cracks_are_told_in_millimetres_from_the_widest_down() {
    let outcome = block();
    let mut contacts = outcome.state.as_ref().unwrap().contacts.clone();
    assert!(svg::cracks("Block", &outcome.model, &contacts).is_none(), "nothing is open");

    let left = outcome.model.contacts.iter().position(|it| it.position.x < 0.1).unwrap();
    contacts[left].y_n = 2.5e-3;
    let openings = joints::openings(&outcome.model, &contacts);
    assert_eq!(openings.len(), 1);
    assert!((openings[0].widest - 2.5e-3).abs() < 1e-15);

    let picture = svg::cracks("Block", &outcome.model, &contacts).unwrap();
    assert!(!picture.contains("NaN"));
    let texts = texts(&picture);
    for text in ["crack of 2 mm and more, widest 2.5 mm", "1 to 2 mm", "0.1 to 0.2 mm"] {
        assert!(texts.contains(text), "{text} is not in {texts}");
    }
    assert!(!texts.contains("slid"), "{texts}");
}

#[test]
fn rounding_errors_beside_a_slip_are_no_cracks() {
    let outcome = block();
    let mut contacts = outcome.state.as_ref().unwrap().contacts.clone();
    contacts[0].y_n = 7e-30;
    assert!(joints::openings(&outcome.model, &contacts).is_empty());
    contacts[1].y_t = -2e-3;
    let picture = svg::cracks("Block", &outcome.model, &contacts).unwrap();
    let texts = texts(&picture);
    assert!(texts.contains("1 joint slid, up to 2 mm") && !texts.contains("crack of"), "{texts}");
}
