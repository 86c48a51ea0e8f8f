//! Mistakes in the load history.

use super::*;

/// The good scene with a stage, of which nothing that is marked stands before it.
fn assert_stage_error(stage: &str, marked: &str, key: &str, words: &[&str]) {
    let solver = "[solver]\ntolerance = 1e-10\n";
    let replacement = format!("[[stages]]\n{stage}\n\n{solver}");
    assert_error(solver, &replacement, marked, key, words);
}

#[test]
fn stages_that_refer_to_nothing() {
    let load = "name = \"push\"\nloads = { side = 1.0 }";
    let words = ["no load \"side\"", "there is \"top\"", "correct the name"];
    assert_stage_error(load, "1.0", "stages[0].loads.side", &words);
    let support = "name = \"sink\"\nmoves = { flor = { y = -0.01 } }";
    let words = ["no support \"flor\"", "did you mean \"floor\"? there is \"floor\""];
    assert_stage_error(support, "{ y", "stages[0].moves.flor", &words);
}

#[test]
fn numbers_of_stages_out_of_range() {
    let none = "name = \"push\"\nsteps = 0";
    assert_stage_error(none, "0", "stages[0].steps", &["0 is not allowed", "at least one step"]);
    let many = "name = \"push\"\nsteps = 200000";
    assert_stage_error(many, "200000", "stages[0].steps", &["200000 steps", "at most 100000"]);
    let factor = "name = \"push\"\nloads = { top = inf }";
    assert_stage_error(factor, "inf", "stages[0].loads.top", &["inf is not allowed"]);
    let turn = "name = \"turn\"\nmoves = { floor = { turn = nan } }";
    assert_stage_error(turn, "nan", "stages[0].moves.floor.turn", &["NaN is not allowed"]);
    let far = "name = \"far\"\nmoves = { floor = { y = -20.0 } }";
    let words = ["-20 is not allowed", "less than the structure is large"];
    assert_stage_error(far, "-20", "stages[0].moves.floor.y", &words);
    let turn = "name = \"turn\"\nmoves = { floor = { turn = 0.2 } }";
    assert_stage_error(turn, "0.2", "stages[0].moves.floor.turn", &["at most 0.1 rad"]);
    let list = "name = \"turn\"\nmoves = { floor = [0.0, 1.0] }";
    assert_stage_error(list, "[0.0", "", &["expected a table"]);
    let unknown = "name = \"turn\"\nmoves = { floor = { z = 1.0 } }";
    assert_stage_error(unknown, "z", "", &["unknown field `z`, expected one of `x`, `y`, `turn`"]);
}

#[test]
fn a_factor_of_gravity_without_gravity_and_names_that_are_taken() {
    let stage = "pressure = 10.0\n\n[[stages]]\nname = \"weight\"\ngravity = 1.0\n";
    let text = GOOD.replace("gravity = [0.0, -9.81]\n", "").replace("pressure = 10.0\n", stage);
    let error = Scene::from_toml(&text).unwrap_err();
    assert_eq!(error.key(), "stages[0].gravity", "{error}");
    assert!(error.to_string().contains("add `gravity` to the scene"), "{error}");
    let twice = "name = \"push\"\n[[stages]]\nname = \"push\"";
    let solver = "[solver]\ntolerance = 1e-10\n";
    let error = error_of(solver, &format!("{solver}\n[[stages]]\n{twice}\n"));
    assert_eq!(error.key(), "stages[1].name", "{error}");
    assert!(error.to_string().contains("taken by stages[0]"), "{error}");
}
