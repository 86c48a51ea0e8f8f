//! The page as one file with its solver, without a server.

use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;

use masonry_live::engine::Engine;
use serde_json::{Value, json};

use crate::common::say;
use crate::driver::Page;

/// What rounding errors change: times, residuals, and the work, since a step more or less follows from the last digit.
const ROUNDING: [&str; 7] =
    ["time", "seconds", "residual", "balance", "pivots", "iterations", "factorisations"];

/// All numbers of an answer with their places, except those that depend on rounding errors.
fn numbers(path: &str, value: &Value, list: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) => list.push((path.to_owned(), number.as_f64().unwrap())),
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                numbers(&format!("{path}[{index}]"), item, list);
            }
        }
        Value::Object(members) => {
            let is_kept = |key: &str| !ROUNDING.iter().any(|it| key.contains(it));
            let others = members.iter().filter(|(key, _)| is_kept(key));
            for (key, member) in others {
                numbers(&format!("{path}.{key}"), member, list);
            }
        }
        _ => {}
    }
}

fn results(answer: &Value) -> (Value, Vec<(String, f64)>) {
    let file: Value = serde_json::from_str(answer["file"].as_str().unwrap()).unwrap();
    let mut list = Vec::new();
    numbers("", &file, &mut list);
    (file["verdict"].clone(), list)
}

#[test]
fn the_single_file_has_the_digits_of_the_command() {
    let Ok(path) = std::env::var("MASONRY_LIVE_FILE") else {
        let missing = "not tested: MASONRY_LIVE_FILE names no page that `cargo run -p masonry-live-single` has written";
        say(missing);
        return;
    };
    let text = fs::read_to_string(&path).unwrap().replace("http://www.w3.org/2000/svg", "");
    for word in ["http:", "https:", "src=", "@import"] {
        assert!(!text.contains(word), "{word}");
    }
    let Some(page) = Page::open(&format!("file://{path}"), 1280) else { return };
    page.wait("document.querySelector('#picture svg[data-frame]')");
    for scene in ["panel_square", "ferris_wall_1", "arch_semicircular"] {
        let text = fs::read_to_string(format!("../../scenes/{scene}.toml")).unwrap();
        let question = json!({ "task": "export", "format": "json", "text": text });
        let native =
            Engine::default().answer(&question.to_string(), &mut |_| ControlFlow::Continue(()));
        let (verdict, native) = results(&serde_json::from_str(&native).unwrap());
        let (in_page, of_page) = results(&page.later(&format!("masonryLive.ask({question})")));
        assert_eq!(in_page, verdict, "{scene}");
        assert_eq!(of_page.len(), native.len(), "{scene}");
        // Each number is compared with the largest of its kind.
        let kind = |path: &str| path.replace(|c: char| c.is_ascii_digit(), "");
        let mut largest: BTreeMap<String, f64> = BTreeMap::new();
        for (path, value) in &native {
            let most = largest.entry(kind(path)).or_default();
            *most = most.max(value.abs());
        }
        for ((key, a), (_, b)) in native.iter().zip(&of_page) {
            assert!((a - b).abs() <= 1e-9 * largest[&kind(key)], "{scene}{key}: {a} and {b}");
        }
    }
}

#[test]
fn the_worker_of_the_single_file_is_stopped_and_goes_on() {
    let Ok(path) = std::env::var("MASONRY_LIVE_FILE") else { return };
    let Some(page) = Page::open(&format!("file://{path}"), 1280) else { return };
    page.wait("document.querySelector('#picture svg[data-frame]')");
    let stopped = page.later(
        "(async () => { const work = new AbortController(); setTimeout(() => work.abort(), 200); \
         const text = document.getElementById('scene').value; \
         try { await masonryLive.ask({ task: 'study', text }, { signal: work.signal }); return 'ended'; } \
         catch (error) { return error.name; } })()",
    );
    assert_eq!(stopped, "AbortError");
    let again = page.later("masonryLive.ask({ task: 'begin' })");
    assert_eq!(again[0]["name"], "wall");
}
