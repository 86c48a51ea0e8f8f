//! Questions and answers.

use std::fmt::Display;
use std::ops::ControlFlow;

use masonry_drawing::{Drawing, DrawingFormat};
use masonry_live::beginnings::BEGINNINGS;
use masonry_live::engine::Engine;
use serde_json::{Value, json};

use crate::common::{DOOR, PUSHED};

fn ask(question: &Value) -> Value {
    let answer =
        Engine::default().answer(&question.to_string(), &mut |_| ControlFlow::Continue(()));
    serde_json::from_str(&answer).unwrap()
}

fn solve(text: &str) -> Value {
    ask(&json!({ "task": "solve", "text": text, "show": "answer", "step": null }))
}

/// A piece of a text by its place in units of UTF-16.
fn piece(text: &str, place: &Value) -> String {
    let units: Vec<u16> = text.encode_utf16().collect();
    let [from, to] =
        ["from", "to"].map(|key| usize::try_from(place[key].as_u64().unwrap()).unwrap());
    String::from_utf16(&units[from..to]).unwrap()
}

#[test]
fn a_scene_is_answered_by_its_verdict_and_the_picture_that_explains_it() {
    let answer = solve(DOOR);
    assert_eq!(answer["error"], Value::Null);
    let shown = &answer["shown"];
    assert_eq!((&shown["verdict"], &shown["show"]), (&json!("stands"), &json!("forces")));
    assert!(shown["picture"].as_str().unwrap().starts_with("<svg "));

    let falls = solve(&DOOR.replace("mu = 0.65", "mu = 0.05"));
    assert_eq!(falls["shown"]["verdict"], "falls");
    assert_eq!(falls["shown"]["show"], "mechanism");
}

#[test]
fn every_beginning_stands() {
    for beginning in BEGINNINGS {
        let answer = solve(beginning.text);
        assert_eq!(answer["shown"]["verdict"], "stands", "{}: {answer}", beginning.name);
    }
}

#[test]
fn a_mistake_has_its_place_and_all_numbers_can_still_be_changed() {
    let text = DOOR
        .replace("title = ", "# μ, 𝜇 and a face: 🙂\ntitle = ")
        .replace("courses = 12", "curses = 12");
    let answer = solve(&text);
    let error = &answer["error"];
    assert!(error["message"].as_str().unwrap().contains("did you mean `courses`?"), "{error}");
    let line = 1 + text.lines().position(|it| it.starts_with("curses")).unwrap();
    assert_eq!((&error["line"], &error["column"]), (&json!(line), &json!(1)));
    let numbers: Vec<String> =
        answer["numbers"].as_array().unwrap().iter().map(|it| piece(&text, it)).collect();
    for number in ["0.25", "-9.81", "1800.0", "12", "0.981"] {
        assert!(numbers.iter().any(|it| it == number), "{number} in {numbers:?}");
    }
}

#[test]
fn counts_stay_whole_sizes_positive_and_coordinates_free() {
    let answer = solve(DOOR);
    let rule = |number: &str, nth: usize| {
        let numbers = answer["numbers"].as_array().unwrap().iter();
        let it = numbers.filter(|it| piece(DOOR, it) == number).nth(nth).unwrap();
        (it["whole"].as_bool().unwrap(), it["least"].as_f64())
    };
    assert_eq!(rule("12", 0), (true, Some(1.0)), "courses");
    assert_eq!(rule("0.65", 0), (false, Some(0.0)), "mu");
    assert_eq!(rule("-9.81", 0), (false, None), "gravity");
    assert_eq!(rule("0.0", 1), (false, None), "origin");
}

#[test]
fn sliders_change_the_text_where_it_has_a_number_or_room_for_one() {
    let text = DOOR.to_owned()
        + "\n[[loads]]\nname = \"roof\" # heavy\nfrom = [0.0, 1.5]\nto = [2.5, 1.5]\npressure = 2.0\ngroup = \"sideways\"\nfactor = 3\n";
    let answer = solve(&text);
    let controls = answer["controls"].as_array().unwrap();
    let labels: Vec<&str> = controls.iter().map(|it| it["label"].as_str().unwrap()).collect();
    assert_eq!(labels, ["μ of bed", "μ of head", "μ of all joints", "factor of sideways"]);
    let edits = controls[3]["edits"].as_array().unwrap();
    assert_eq!((&edits[0]["before"], &edits[1]["part"]), (&json!("\nfactor = "), &json!(3.0)));
    assert_eq!(piece(&text, &edits[1]), "3");
    // The changed text has the factors that were asked for.
    let mut units: Vec<u16> = text.encode_utf16().collect();
    for edit in edits.iter().rev() {
        let value = 2.0 * edit["part"].as_f64().unwrap();
        let new = format!("{}{value}", edit["before"].as_str().unwrap());
        let [from, to] =
            ["from", "to"].map(|key| usize::try_from(edit[key].as_u64().unwrap()).unwrap());
        units.splice(from..to, new.encode_utf16());
    }
    let scene = masonry::Scene::from_toml(&String::from_utf16(&units).unwrap()).unwrap();
    let factors: Vec<f64> = scene.loads.iter().map(|it| it.factor).collect();
    assert_eq!(factors, [2.0, 6.0]);
}

#[test]
fn a_slider_for_all_joints_keeps_their_ratios() {
    let all = |text: &str| -> Option<Value> {
        let answer = solve(text);
        let controls = answer["controls"].as_array().unwrap().clone();
        controls.into_iter().find(|it| it["label"] == "μ of all joints")
    };
    let two = DOOR.replace("[joints.head]\nmu = 0.65", "[joints.head]\nmu = 0.26");
    let control = all(&two).unwrap();
    assert_eq!(control["value"], 0.65);
    let parts: Vec<f64> = control["edits"]
        .as_array()
        .unwrap()
        .iter()
        .map(|it| it["part"].as_f64().unwrap())
        .collect();
    assert_eq!(parts, [1.0, 0.4]);
    let none = DOOR.replace("mu = 0.65", "mu = 0.0");
    assert_eq!(all(&none).unwrap()["edits"][1]["part"], 1.0);
    let one = DOOR.replace("[joints.head]\nmu = 0.65", "[joints.head]\nphi_deg = 33.0");
    assert_eq!(all(&one), None, "friction of two kinds has no one number");
}

#[test]
fn openings_and_supports_have_handles_in_the_scene_and_in_the_text() {
    let answer = solve(DOOR);
    let handles = answer["handles"].as_array().unwrap();
    let handle = |label: &str| handles.iter().find(|it| it["label"] == label).unwrap();
    let place = handle("place of wall, opening 1");
    assert_eq!((&place["low"], &place["high"]), (&json!([0.75, 0.0]), &json!([1.75, 0.875])));
    assert_eq!(piece(DOOR, &place["right"][0]), "0.75");
    let top = &handle("top of wall, opening 1")["up"][0];
    assert_eq!((piece(DOOR, top).as_str(), &top["per_length"]), ("7", &json!(8.0)));
    let end = handle("to of support floor");
    assert_eq!(end["low"], json!([2.5, 0.0]));
    assert_eq!(piece(DOOR, &end["right"][0]), "2.5");
}

#[test]
fn completion_knows_keys_words_and_names() {
    let offered = |text: &str| -> Vec<String> {
        let whole = format!("{text}\n{DOOR}");
        let answer =
            ask(&json!({ "task": "complete", "text": whole, "at": text.encode_utf16().count() }));
        let entries = answer["entries"].as_array().unwrap().iter();
        entries.map(|it| it["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(offered("th"), ["thickness"]);
    assert_eq!(offered("[[walls]]\nbo"), ["bond"]);
    assert_eq!(offered("[[walls]]\nbond = \"r"), ["\"running\""]);
    assert_eq!(offered("[[walls]]\nopenings = [{ x = 1.0, be"), ["bearing"]);
    assert_eq!(offered("[joints.bed]\nco"), ["cohesion"]);
    assert_eq!(offered("[[supports]]\njoint = "), ["\"bed\"", "\"head\""]);
    assert_eq!(offered("[limit]\ngroup = "), ["\"sideways\""]);
    assert_eq!(offered("# a wörd"), Vec::<String>::new());
    let after = |text: &str| {
        ask(&json!({ "task": "complete", "text": text, "at": text.len() }))["after"].clone()
    };
    assert_eq!(
        [after("[[walls]]\nbo"), after("th"), after("[[walls]]\nbond = \"r")],
        [" = ", "", ""]
    );
}

#[test]
fn cracks_of_a_wall_that_has_none_say_so() {
    let answer = ask(&json!({ "task": "solve", "text": DOOR, "show": "cracks" }));
    let picture = answer["shown"]["picture"].as_str().unwrap();
    assert!(picture.contains("no joint has opened or slid"), "{picture}");
}

#[test]
fn a_limit_is_found_told_on_the_way_and_stopped() {
    let engine = Engine::default();
    let question = json!({ "task": "limit", "law": "both", "text": DOOR }).to_string();
    let mut news = Vec::new();
    let mut listen = |it: &dyn Display| {
        news.push(it.to_string());
        ControlFlow::Continue(())
    };
    let found: Value = serde_json::from_str(&engine.answer(&question, &mut listen)).unwrap();
    assert!(found["sentence"].as_str().unwrap().contains("sideways"), "{found}");
    assert!(found["pictures"].as_array().unwrap().iter().any(|it| it["name"] == "Mechanism"));
    assert!(news.iter().any(|it| it.starts_with("stands at")), "{news:?}");
    let all = news.len();
    let mut asked = 0;
    let mut stop = |_: &dyn Display| {
        asked += 1;
        ControlFlow::Break(())
    };
    engine.answer(&question, &mut stop);
    assert!(asked < all);
}

/// The question for values of the number after some words, in a range.
fn change(words: &str, range: [f64; 2]) -> Value {
    let from = PUSHED.find(words).unwrap() + words.len();
    let to = from + PUSHED[from..].find([',', ' ']).unwrap();
    let value: f64 = PUSHED[from..to].parse().unwrap();
    let edits = [json!({ "from": from, "to": to, "before": "", "part": 1.0 })];
    json!({ "task": "change", "text": PUSHED, "label": "it", "edits": edits, "value": value, "range": range,
        "whole": false })
}

/// Values that were tried with what they come to.
fn tried(found: &Value) -> Vec<(f64, String)> {
    let lines = found["text"].as_str().unwrap().lines().skip(1);
    let line = |it: &str| {
        let (value, answer) = it.trim().split_once("  ").unwrap();
        (value.parse().unwrap(), answer.to_owned())
    };
    lines.map(line).collect()
}

#[test]
fn a_change_of_the_verdict_lies_between_values_that_were_tried() {
    // The block slides at friction below the push over the weight.
    let found = ask(&change("mu = ", [0.0, 1.2]));
    let list = tried(&found);
    let falls = list.iter().rfind(|(_, it)| it == "falls").unwrap().0;
    let stands = list.iter().find(|(_, it)| it == "stands").unwrap().0;
    assert!(falls < 0.5 && stands >= 0.5 && stands - falls < 0.0011, "{found}");
    assert!(list.contains(&(0.8, "stands".to_owned())), "its own value is tried: {found}");
    let sentence = found["sentence"].as_str().unwrap();
    let expected = format!("The verdict changes with it: falls at {falls}, stands at {stands}. ");
    assert!(sentence.starts_with(&expected), "{sentence}");
    assert!(sentence.ends_with("other changes between them are possible."), "{sentence}");
    let names: Vec<&str> = found["pictures"]
        .as_array()
        .unwrap()
        .iter()
        .map(|it| it["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, [format!("Falls at {falls}"), format!("Stands at {stands}")]);
}

#[test]
fn all_changes_that_were_seen_are_told_and_none_is_claimed() {
    let push = "acceleration = [";
    // The block slides to both sides from 8 m/s2 on.
    let both = ask(&change(push, [-20.0, 20.0]));
    let sentence = both["sentence"].as_str().unwrap();
    assert!(sentence.starts_with("The verdict changes 2 times with it: falls at -8"), "{sentence}");
    assert!(sentence.contains("; stands at 8, falls at 8.01."), "{sentence}");
    // A range without a change grows upwards until there is one.
    let wider = ask(&change(push, [-4.0, 6.0]));
    let sentence = wider["sentence"].as_str().unwrap();
    assert!(sentence.contains(": stands at 8, falls at 8.01. "), "{sentence}");
    assert!(sentence.contains(" values from -4 to 24 were tried; "), "{sentence}");
    let none = ask(&change("mu = ", [0.6, 1.2]));
    let sentence = none["sentence"].as_str().unwrap();
    assert!(sentence.contains(" values from 0.6 to 19.2 were tried; "), "{sentence}");
    assert!(
        sentence.starts_with("The scene stands at all values of it that were tried."),
        "{sentence}"
    );
    assert!(sentence.ends_with("; changes between them are possible."), "{sentence}");
}

#[test]
fn values_that_fit_into_no_scene_are_mistakes_with_their_reason() {
    let found = ask(&change("density = ", [-2000.0, 2000.0]));
    let list = tried(&found);
    let (_, answer) = &list[0];
    assert!(answer.starts_with("has a mistake: "), "{found}");
    assert!(
        found["sentence"].as_str().unwrap().contains("has a mistake at 0, stands at 1."),
        "{found}"
    );
    for range in [[1.0, 1.0], [1.0, 0.0], [0.0, 1e-320], [1e16, 1e16 + 4.0]] {
        assert!(ask(&change("mu = ", range))["error"]["message"].is_string(), "{range:?}");
    }
    let mut outside = change("mu = ", [0.0, 1.0]);
    outside["edits"][0]["to"] = json!(1_u64 << 40);
    assert!(ask(&outside)["error"]["message"].as_str().unwrap().contains("has no places"));
}

#[test]
fn a_search_for_a_change_says_how_far_it_was_when_it_is_stopped() {
    let question = change("mu = ", [0.0, 1.2]).to_string();
    let mut news = Vec::new();
    let mut stop = |it: &dyn Display| {
        news.push(it.to_string());
        if news.last().unwrap().contains("stands at") {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let found: Value =
        serde_json::from_str(&Engine::default().answer(&question, &mut stop)).unwrap();
    let sentence = found["sentence"].as_str().unwrap();
    assert!(sentence.starts_with("Stopped. The verdict changes with it: falls at "), "{sentence}");
    assert_eq!(found["pictures"].as_array().unwrap().len(), 0);
}

/// The block in two combinations: with the push of the scene from both sides, and with twice as much.
fn combined() -> String {
    format!(
        "{PUSHED}\n[[combinations]]\nname = \"calm\"\nloads = {{ push = 1.0 }}\n\n\
        [[combinations]]\nname = \"storm\"\nloads = {{ push = 2.0 }}\n"
    )
}

#[test]
fn of_combinations_the_one_that_governs_is_shown() {
    let shown = solve(&combined())["shown"].take();
    assert_eq!(shown["verdict"], "falls");
    assert!(shown["sentence"].as_str().unwrap().starts_with("\"storm\" governs: "), "{shown}");
    let ask_for = |format: &str| {
        let file = ask(&json!({ "task": "export", "text": combined(), "format": format }));
        file["file"].as_str().unwrap().to_owned()
    };
    let json: Value = serde_json::from_str(&ask_for("json")).unwrap();
    assert_eq!(json["governs"], "storm");
    assert_eq!(json["combinations"].as_array().unwrap().len(), 4);
    assert!(ask_for("text").contains("calm, opposite"));
    assert!(ask_for("page").contains("<td>calm, opposite</td>"));
    // The block slides at 8 m/s2.
    let limit = ask(&json!({ "task": "limit", "law": "both", "text": combined() }));
    let sentence = limit["sentence"].as_str().unwrap();
    assert!(sentence.starts_with("\"storm") && sentence.contains("0.8"), "{sentence}");
    assert!(limit["text"].as_str().unwrap().contains("1.6"), "{limit}");
    let range = ask(&json!({ "task": "range", "text": combined() }));
    assert!(
        range["error"]["message"].as_str().unwrap().contains("leave the loads of one"),
        "{range}"
    );
}

#[test]
fn a_train_is_asked_for_where_there_is_one() {
    // One axle over the arch; a quarter of the span governs, from either side.
    let text = r#"title = "A bridge"
thickness = 1.0
gravity = [0.0, -10.0]
units = { length = "m", force = "N" }
materials.stone = { density = 2000.0 }
joints.joint = { mu = 0.7 }

[[arches]]
name = "arch"
material = "stone"
shape = "segmental"
origin = [0.0, 0.0]
span = 4.0
rise = 1.0
thickness = 0.4
voussoirs = 11
joint = "joint"
springing = "joint"

[limit.train]
over = "arch"
axles = [[0.0, 1e4]]
from = 0.0
to = 4.0
positions = 5
"#;
    assert_eq!(solve(text)["has_train"], true);
    assert_eq!(solve(DOOR)["has_train"], false);
    let found = ask(&json!({ "task": "train", "law": "associative", "text": text }));
    let sentence = found["sentence"].as_str().unwrap();
    assert!(
        ["position 1\u{a0}m", "position 3\u{a0}m"].iter().any(|it| sentence.starts_with(it)),
        "{sentence}"
    );
    assert!(found["pictures"].as_array().unwrap().iter().any(|it| it["name"] == "Positions"));
    let none = ask(&json!({ "task": "train", "law": "both", "text": DOOR }));
    assert!(none["error"]["message"].is_string());
}

#[test]
fn an_engine_without_files_says_in_one_sentence_that_it_reads_none() {
    let answer = solve(&format!("block_list = \"blocks.json\"\n{DOOR}"));
    let message = answer["error"]["message"].as_str().unwrap();
    assert!(message.starts_with("block_list: this page cannot read files"), "{message}");
}

#[test]
fn ranges_and_thicknesses_have_a_sentence_and_a_report() {
    let text = BEGINNINGS.into_iter().find(|it| it.name == "arch").unwrap().text;
    let range = ask(&json!({ "task": "range", "text": text }));
    let thickness = ask(&json!({ "task": "thickness", "arch": "arch", "text": text }));
    for found in [&range, &thickness] {
        let sentence = found["sentence"].as_str().unwrap();
        assert!(sentence.ends_with('.') && !sentence.contains('\n'), "{sentence}");
    }
    assert!(range["text"].as_str().unwrap().contains("arch/left"));
    assert_eq!(thickness["pictures"].as_array().unwrap().len(), 2);
}

#[test]
fn an_exported_drawing_has_the_blocks_of_the_scene() {
    let file = ask(&json!({ "task": "export", "text": DOOR, "format": "dxf" }));
    let drawing =
        Drawing::read(file["file"].as_str().unwrap().as_bytes(), DrawingFormat::Dxf).unwrap();
    let scene = masonry::Scene::from_toml(DOOR).unwrap();
    let model = masonry::Model::from_scene(&scene).unwrap();
    let outlines = drawing.outlines.iter().filter(|it| it.layer == "blocks");
    assert_eq!(outlines.count(), model.blocks.len());
    let supports = drawing.lines.iter().filter(|it| it.layer.starts_with("support_"));
    assert_eq!(supports.count(), model.supports.len());
}

#[test]
fn text_in_a_scene_stays_text_in_the_picture() {
    let text = DOOR.replace("Wall with a door", "<img src=x onerror=alert(1)>");
    let shown = solve(&text)["shown"].clone();
    let picture = shown["picture"].as_str().unwrap();
    assert!(picture.contains("&lt;img src=x") && !picture.contains("<img"));
    let named = DOOR.replace("name = \"wall\"", "name = \"<img src=y>\"");
    let question = json!({ "task": "solve", "text": named, "show": "tables", "step": null });
    let tables = ask(&question)["shown"]["tables"].take();
    let tables = tables.as_str().unwrap();
    assert!(tables.contains("&lt;img src=y") && !tables.contains("<img"));
}
