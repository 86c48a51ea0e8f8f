//! Mistakes in combinations of loads.

use super::*;

#[track_caller]
fn assert_combination_error(keys: &str, marked: &str, key: &str, words: &[&str]) {
    let solver = "[solver]\ntolerance = 1e-10\n";
    let replacement = format!("[[combinations]]\n{keys}\n\n{solver}");
    assert_error(solver, &replacement, marked, key, words);
}

#[test]
fn names_and_numbers_of_combinations() {
    let at = |key| format!("combinations[0].{key}");
    let load = "name = \"storm\"\nloads = { side = 1.5 }";
    let words = ["no load \"side\"", "there is \"top\"", "correct the name"];
    assert_combination_error(load, "1.5", &at("loads.side"), &words);
    let factor = "name = \"storm\"\nloads = { top = nan }";
    assert_combination_error(factor, "nan", &at("loads.top"), &["NaN is not allowed"]);
    let up = "name = \"storm\"\ngravity = -1.0";
    assert_combination_error(up, "-1.0", &at("gravity"), &["-1 is not allowed", "give zero"]);
    let side = "name = \"storm, opposite\"";
    let words = ["ends in \", opposite\"", "give it another name"];
    assert_combination_error(side, "\"storm, opposite\"", &at("name"), &words);
    let twice = "name = \"storm\"\n[[combinations]]\nname = \"storm\"";
    let solver = "[solver]\ntolerance = 1e-10\n";
    let error = error_of(solver, &format!("{solver}\n[[combinations]]\n{twice}\n"));
    assert_eq!(error.key(), "combinations[1].name", "{error}");
    assert!(error.to_string().contains("taken by combinations[0]"), "{error}");
}

#[test]
fn combinations_are_at_most_a_thousand() {
    let scene = |count: usize| {
        let scene = Scene::from_toml(GOOD).unwrap();
        let combination = |k: usize| masonry::scene::Combination::new(&format!("number {k}"));
        (0..count).map(combination).fold(scene, Scene::combination)
    };
    scene(1000).check().unwrap();
    let error = scene(1001).check().unwrap_err();
    assert_eq!(error.key(), "combinations", "{error}");
    assert!(error.to_string().contains("1001 combinations are too many: at most 1000"), "{error}");
}
