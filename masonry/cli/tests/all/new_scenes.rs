//! `masonry new` and `masonry schema`: scenes that run at once, and a schema that fits all scenes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use masonry::Scene;
use serde_json::{Value, json};

const KINDS: [&str; 7] = ["wall", "arch", "panel", "door", "facade", "bridge", "rubble"];

fn masonry(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_masonry")).args(arguments).output().unwrap()
}

fn printed(arguments: &[&str]) -> String {
    let output = masonry(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

fn directory(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("new").join(name);
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    fs::create_dir_all(&path).unwrap();
    path
}

#[test]
fn new_scenes_stand_and_have_a_limit() {
    for kind in KINDS {
        let directory = directory(kind);
        let scene = directory.join("scene.toml");
        let scene = scene.to_str().unwrap();
        printed(&["new", kind, "--out", scene]);
        assert_eq!(fs::read_to_string(scene).unwrap(), printed(&["new", kind]));
        let out = directory.join("out");
        let solved: Value = serde_json::from_str(&printed(&[
            "solve",
            scene,
            "--out",
            out.to_str().unwrap(),
            "--json",
        ]))
        .unwrap();
        assert_eq!(solved["verdict"], "stands", "{kind}");
        if kind != "panel" {
            let limit: Value = serde_json::from_str(&printed(&["limit", scene, "--json"])).unwrap();
            assert_eq!(limit["associative"]["proved"], true, "{kind}");
            assert!(limit["associative"]["load_factor"].as_f64().unwrap() > 1.0, "{kind}");
        }
        if kind == "arch" {
            printed(&["limit", scene, "--range"]);
            printed(&["limit", scene, "--thickness", "arch"]);
        }
        // What somebody may have worked on is kept.
        let again = masonry(&["new", kind, "--out", scene]);
        assert_eq!(again.status.code(), Some(2));
        assert!(String::from_utf8(again.stderr).unwrap().contains("choose another name"));
    }
    assert_eq!(masonry(&["new", "castle"]).status.code(), Some(2));
}

/// Whether a value fits a schema, by the words of JSON Schema that the schema of scenes uses.
fn fits(root: &Value, schema: &Value, value: &Value) -> Result<(), String> {
    let Some(schema) = schema.as_object() else {
        return if schema == &json!(false) {
            Err(format!("{value} is not allowed"))
        } else {
            Ok(())
        };
    };
    for (word, wanted) in schema {
        match word.as_str() {
            "$ref" => {
                let place = wanted.as_str().unwrap().strip_prefix('#').unwrap();
                fits(root, root.pointer(place).unwrap(), value)?;
            }
            "type" => {
                let types: Vec<&str> = match wanted {
                    Value::Array(list) => list.iter().map(|it| it.as_str().unwrap()).collect(),
                    one => vec![one.as_str().unwrap()],
                };
                let is = |name: &&str| match *name {
                    "object" => value.is_object(),
                    "array" => value.is_array(),
                    "string" => value.is_string(),
                    "boolean" => value.is_boolean(),
                    "null" => value.is_null(),
                    "integer" => value.is_i64() || value.is_u64(),
                    "number" => value.is_number(),
                    other => panic!("type {other}"),
                };
                if !types.iter().any(is) {
                    return Err(format!("{value} is no {types:?}"));
                }
            }
            "anyOf" | "oneOf" => {
                let choices = wanted.as_array().unwrap();
                let fit = choices.iter().filter(|it| fits(root, it, value).is_ok()).count();
                if fit == 0 || (word == "oneOf" && fit > 1) {
                    return Err(format!("{value} fits {fit} of {wanted}"));
                }
            }
            "enum" if !wanted.as_array().unwrap().contains(value) => {
                return Err(format!("{value} is none of {wanted}"));
            }
            "const" if wanted != value => return Err(format!("{value} is not {wanted}")),
            "required" => {
                for key in wanted.as_array().unwrap() {
                    if value.get(key.as_str().unwrap()).is_none() {
                        return Err(format!("{key} is missing"));
                    }
                }
            }
            "properties" => {
                for (key, schema) in wanted.as_object().unwrap() {
                    value.get(key).map_or(Ok(()), |it| {
                        fits(root, schema, it).map_err(|error| format!("{key}: {error}"))
                    })?;
                }
            }
            "additionalProperties" => {
                let known = schema.get("properties").and_then(Value::as_object);
                for (key, it) in value.as_object().into_iter().flatten() {
                    if !known.is_some_and(|known| known.contains_key(key)) {
                        fits(root, wanted, it).map_err(|error| format!("{key}: {error}"))?;
                    }
                }
            }
            "items" => {
                for it in value.as_array().into_iter().flatten() {
                    fits(root, wanted, it)?;
                }
            }
            "minItems" | "maxItems" => {
                let length = value.as_array().map_or(0, Vec::len) as u64;
                let limit = wanted.as_u64().unwrap();
                if if word == "minItems" { length < limit } else { length > limit } {
                    return Err(format!("{value} has {length} items"));
                }
            }
            "minimum" if value.as_f64() < wanted.as_f64() => {
                return Err(format!("{value} < {wanted}"));
            }
            "enum" | "const" | "minimum" | "maximum" | "$schema" | "$defs" | "title"
            | "description" | "default" | "format" => {}
            other => panic!("the schema uses `{other}`, which this test does not know"),
        }
    }
    Ok(())
}

fn value_of(text: &str) -> Value {
    serde_json::to_value(toml::from_str::<toml::Table>(text).unwrap()).unwrap()
}

#[test]
fn the_schema_fits_all_scenes() {
    let schema: Value = serde_json::from_str(&printed(&["schema"])).unwrap();
    assert_eq!(serde_json::from_str::<Value>(Scene::schema()).unwrap(), schema);
    let mut texts: Vec<(String, String)> =
        KINDS.map(|kind| (kind.to_owned(), printed(&["new", kind]))).into();
    for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")).unwrap() {
        let path = entry.unwrap().path();
        texts.push((path.display().to_string(), fs::read_to_string(&path).unwrap()));
    }
    assert!(texts.len() > 15);
    for (name, text) in &texts {
        let scene = Scene::from_toml(text).unwrap();
        for text in [text, &scene.to_toml().unwrap()] {
            fits(&schema, &schema, &value_of(text))
                .unwrap_or_else(|error| panic!("{name}: {error}"));
        }
    }
    // What the reader refuses for its form, the schema refuses too.
    let wall = &texts[0].1;
    for (part, other) in [
        ("density", "densty"),
        ("length = \"m\"", "length = \"yd\""),
        ("origin = [0.0, 0.0]", "origin = [0.0, 0.0, 0.0]"),
        ("title = ", "titel = "),
        ("courses = 16", "courses = \"many\""),
        ("bond = \"running\"", "bond = \"dutch\""),
    ] {
        let wrong = wall.replacen(part, other, 1);
        assert_ne!(&wrong, wall);
        assert!(fits(&schema, &schema, &value_of(&wrong)).is_err(), "{other}");
        assert!(Scene::from_toml(&wrong).is_err(), "{other}");
    }
    // Every key says what it means.
    let keys = schema["properties"].as_object().unwrap();
    assert!(keys.values().all(|key| key["description"].is_string()), "{keys:?}");
}
