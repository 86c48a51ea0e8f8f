//! Mistakes in the settings of limit loads.

use super::*;

#[track_caller]
fn assert_seismic_error(keys: &str, marked: &str, key: &str, words: &[&str]) {
    let solver = "[solver]\ntolerance = 1e-10\n";
    let replacement = format!("[limit.seismic]\n{keys}\n\n{solver}");
    assert_error(solver, &replacement, marked, key, words);
}

#[test]
fn numbers_of_a_seismic_check() {
    let at = |key| format!("limit.seismic{key}");
    let words = ["`S` is missing", "with `a_g`", "S = 1.0"];
    assert_seismic_error("a_g = 0.15", "[limit", &at(""), &words);
    let words = ["`a_g` is missing", "with `S`", "a_g = 0.15"];
    assert_seismic_error("S = 1.2", "[limit", &at(""), &words);
    assert_seismic_error("a_g = -0.15\nS = 1", "-0.15", &at(".a_g"), &["-0.15 is not allowed"]);
    assert_seismic_error("a_g = 0.15\nS = 0", "0\n", &at(".S"), &["0 is not allowed"]);
    assert_seismic_error("q = 0.5", "0.5", &at(".q"), &["0.5 is not allowed", "at least 1"]);
    assert_seismic_error("FC = nan", "nan", &at(".FC"), &["NaN is not allowed", "at least 1"]);
    let words = ["unknown field `s`", "`a_g`, `S`, `q`, `FC`"];
    assert_seismic_error("s = 1.0", "s = 1.0", "", &words);
}

#[track_caller]
fn assert_train_error(keys: &str, marked: &str, key: &str, words: &[&str]) {
    let solver = "[solver]\ntolerance = 1e-10\n";
    let replacement = format!("[limit.train]\n{keys}\n\n{solver}");
    assert_error(solver, &replacement, marked, &format!("limit.train{key}"), words);
}

#[test]
fn trains() {
    let with = |more: &str| format!("from = 0\nto = 1\n{more}");
    let over = "over = \"wall\"\naxles = [[0, 1]]\n";
    let words = ["no arch, wall or block \"wal\"", "did you mean \"wall\"?"];
    assert_train_error(&with("over = \"wal\"\naxles = [[0, 1]]"), "\"wal\"", ".over", &words);
    let none = with("over = \"wall\"\naxles = []");
    assert_train_error(&none, "[]", ".axles", &["at least one axle"]);
    let up = with("over = \"wall\"\naxles = [[0, -1]]");
    assert_train_error(&up, "-1", ".axles[0][1]", &["-1 is not allowed"]);
    let long = with(&format!("over = \"wall\"\naxles = [{}]", "[0, 1], ".repeat(1001)));
    let words = ["1001 axles of a train are too many: at most 1000"];
    assert_train_error(&long, "[[0, 1], ", ".axles", &words);
    let many = with(&format!("{over}positions = 0"));
    assert_train_error(&many, "0\n\n", ".positions", &["at least one position"]);
    let flat = with(&format!("{over}level = 2\nangle_deg = 90"));
    assert_train_error(&flat, "90", ".angle_deg", &["at most 80 degrees"]);
    let bare = with(&format!("{over}angle_deg = 30"));
    assert_train_error(&bare, "30", ".angle_deg", &["is for an axle on fill", "`level`"]);
}

/// A load of the name of the train, or of one of its axles, would grow with them.
#[test]
fn names_that_belong_to_a_train() {
    let solver = "[solver]\ntolerance = 1e-10\n";
    let train = "[limit.train]\nover = \"wall\"\naxles = [[0, 1]]\nfrom = 0\nto = 1\n";
    for (key, name) in [("group", "train"), ("group", "train axle 2"), ("name", "train")] {
        let name_too = if key == "group" { "name = \"ballast\"\n" } else { "" };
        let load = format!(
            "[[loads]]\n{name_too}{key} = \"{name}\"\nfrom = [0, 0.5]\nto = [1, 0.5]\npressure = 1\n"
        );
        let words = [&*format!("the name \"{name}\" belongs to the axles"), "another name"];
        let marked = format!("\"{name}\"");
        let at = format!("loads[1].{key}");
        assert_error(solver, &format!("{load}{train}{solver}"), &marked, &at, &words);
    }
}
