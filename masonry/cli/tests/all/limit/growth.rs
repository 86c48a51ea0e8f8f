//! The load that grows: its two directions, the weight, and how factors are printed.

use std::ops::ControlFlow;

use masonry::analysis::limit::{Bracket, Directions, Governs, Laws, limit};
use masonry::scene::Scene;
use serde_json::Value;

use super::{SIDEWAYS, blocks, masonry, object, stack, written};

/// A block that is steep on its left tips to the right at 0.55 of its weight, and to the left at 0.35.
#[test]
fn an_earthquake_comes_from_both_sides() {
    let steep = [[0.0, 0.0], [0.4, 0.0], [0.2, 1.0], [0.0, 1.0]];
    let path = written("both", &blocks(0.9, &[steep], SIDEWAYS));
    let (both, code) = object(&path, &["--both"]);
    assert_eq!((&both["governs"], code), (&"opposite".into(), 0));
    for (direction, expected) in [("given", 0.55), ("opposite", 0.35)] {
        let stands = both[direction]["path"]["load_factor"].as_f64().unwrap();
        assert!((stands / expected - 1.0).abs() < 1e-4, "{direction}: {stands}");
    }
    let output = masonry(&["limit", path.to_str().unwrap(), "--both"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("The opposite direction governs"), "{text}");
    // Who asks for one direction is told that there are two; a weight has one.
    let has_hint = |object: &Value| object["warnings"].to_string().contains("--both");
    assert!(has_hint(&object(&path, &[]).0));
    let down = SIDEWAYS.replace("[10.0, 0.0]", "[0.0, -10.0]");
    assert!(!has_hint(&object(&written("down", &blocks(0.9, &[steep], &down)), &[]).0));
}

/// A load that acts to both sides alike fails under the same factor on both. Which direction governs is not known if one is not
/// decided.
#[test]
fn directions_that_carry_the_same_are_said_to() {
    let path = written("alike", &blocks(0.9, &stack(1, 0.4, 1.0), SIDEWAYS));
    let (both, code) = object(&path, &["--both"]);
    assert_eq!((&both["governs"], code), (&"both".into(), 0));
    let output = masonry(&["limit", path.to_str().unwrap(), "--both"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("Both directions carry the same."), "{text}");

    let scene = Scene::read(&path).unwrap();
    let given = limit(&scene).unwrap();
    let ended = &mut |_: Bracket| ControlFlow::Break(());
    let opposite = Directions::opposite(&given, &scene, Laws::Both, ended).unwrap();
    let both = Directions::of(given, opposite);
    assert_eq!(both.governs, Governs::Unknown);
}

/// Blocks of breadths 0.1, 0.2 and 0.3 and of height one tip over at these parts of gravity. That the first one does is no
/// collapse of the others.
#[test]
fn the_rest_is_told_where_a_part_moves() {
    let corners =
        |x: f64, breadth: f64| [[x, 0.0], [x + breadth, 0.0], [x + breadth, 1.0], [x, 1.0]];
    let three = [corners(0.0, 0.1), corners(0.2, 0.2), corners(0.5, 0.3)];
    let path = written("part", &blocks(0.9, &three, SIDEWAYS));
    let (found, code) = object(&path, &["--law", "associative"]);
    assert_eq!(code, 0);
    let near = |value: &Value, exact: f64| (value.as_f64().unwrap() / exact - 1.0).abs() < 1e-4;
    let found = &found["associative"];
    assert!(near(&found["bound"], 0.1) && near(&found["rest"]["bound"], 0.2), "{found}");
    assert!(near(&found["rest"]["load_factor"], 0.2), "{found}");
    let output = masonry(&["limit", path.to_str().unwrap(), "--law", "associative"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("alone, of 3"), "{text}");
    assert!(
        text.contains("the rest") && text.contains("if the blocks that move are held"),
        "{text}"
    );
    // Where all blocks move there is no rest.
    let (found, _) = object(&written("whole", &blocks(0.9, &three[..1], SIDEWAYS)), &[]);
    assert!(found["associative"].get("rest").is_none(), "{found}");
}

/// Without other loads the weight grows: a block on a floor carries any multiple of it, and one that overhangs none.
#[test]
fn the_weight_alone_may_grow() {
    for (name, block, answer, stands) in [
        ("rests", [[0.0, 0.0], [0.4, 0.0], [0.4, 1.0], [0.0, 1.0]], "does not fail", true),
        ("overhangs", [[0.8, 0.0], [1.4, 0.0], [1.4, 1.0], [0.8, 1.0]], "fails", false),
    ] {
        let path = written(&format!("weight_{name}"), &blocks(0.9, &[block], ""));
        let (object, code) = object(&path, &[]);
        assert_eq!(
            (&object["group"], &object["associative"]["answer"]),
            (&"gravity".into(), &answer.into())
        );
        let falls = object["path"]["falls"].as_f64();
        assert_eq!(falls.is_none(), stands, "{name}: {object}");
        assert!(falls.is_none_or(|falls| falls < 1e-4), "{name}: {falls:?}");
        // A structure that falls by its weight is none that a load brings down.
        assert_eq!(code, i32::from(!stands), "{name}");
        let sentence = object["sentence"].as_str().unwrap();
        assert_eq!(
            sentence.starts_with("The structure falls by its own weight"),
            !stands,
            "{sentence}"
        );
        let limit = limit(&Scene::read(&path).unwrap()).unwrap();
        let page = masonry_report::page::limit(&limit, None);
        assert_eq!(page.contains("<header class=\"falls\">"), !stands, "{name}");
    }
}

/// Text of a bound is on the side of what is proved: a structure may stand below it, but never above.
#[test]
fn bounds_are_rounded_outwards() {
    for k in 0..20 {
        let height = 1.0 + 0.0137 * f64::from(k);
        let path = written("rounded", &blocks(0.9, &stack(1, 0.3, height), SIDEWAYS));
        let (object, _) = object(&path, &[]);
        let [stands, bound] = [("path", "load_factor"), ("associative", "bound")]
            .map(|(law, key)| object[law][key].as_f64().unwrap());
        let sentence = object["sentence"].as_str().unwrap();
        let after = |words: &str| -> f64 {
            let rest = sentence.split(words).nth(1).unwrap();
            rest.split(' ').next().unwrap().parse().unwrap()
        };
        assert!(after("stands up to ") <= stands, "{sentence} {stands}");
        assert!(after("cannot stand above ") >= bound, "{sentence} {bound}");
    }
}
