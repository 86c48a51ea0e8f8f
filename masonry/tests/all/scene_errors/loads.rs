//! Mistakes in loads, and in the names by which stages call them.

use super::*;

/// The good scene with one more load, which has these keys.
fn assert_load_error(keys: &str, marked: &str, key: &str, message: &str) {
    let load = "pressure = 10.0\n\n[contact]";
    let replacement = format!("pressure = 10.0\n\n[[loads]]\nname = \"more\"\n{keys}\n\n[contact]");
    assert_error(load, &replacement, marked, key, &[&format!("{key}: {message}")]);
}

#[test]
fn keys_of_no_kind_and_of_two_kinds() {
    assert_load_error(
        "",
        "[[loads]]\nname = \"more\"",
        "loads[1]",
        "load \"more\" has no keys of any kind of load: add `from`, `to` and `pressure`, `traction` or `earth` (on edges), or \
         `block`, `at` and `force` or `moment` (at a place of a block), or `acceleration` (on all mass)",
    );
    assert_load_error(
        "from = [0.0, 0.5]\nto = [1.0, 0.5]\nforce = [0.5, -1.0]",
        "[0.5, -1.0]",
        "loads[1].force",
        "`from` is for a load on edges and `force` for one at a place of a block: keep the keys of one kind, or make \
         two loads",
    );
    assert_load_error(
        "at = [0.5, 0.4]\nacceleration = [0.98, 0.0]",
        "[0.98",
        "loads[1].acceleration",
        "`at` is for a load at a place of a block and `acceleration` for one on all mass: keep the keys of one kind, \
         or make two loads",
    );
    let marked = "[[loads]]\nname = \"more\"";
    for (keys, message) in [
        (
            "pressure = 1.0",
            "`from` is missing, but needed for the segment on which a load acts: add `from = [0.0, 0.0]`",
        ),
        (
            "from = [0.0, 0.5]",
            "`to` is missing, but needed for the segment on which a load acts: add `to = [1.0, 0.0]`",
        ),
        (
            "from = [0, 0.5]\nto = [1, 0.5]",
            "none of `pressure`, `traction` and `earth` is given: add one of them",
        ),
        (
            "force = [0.0, -1.0]",
            "`block` is missing, but needed with `force`: add `block = \"wall/1/1\"`",
        ),
        ("block = \"lintel\"", "`at` is missing, but needed with `block`: add `at = [0.0, 0.0]`"),
        (
            "block = \"lintel\"\nat = [0.5, 0.5]",
            "neither `force` nor `moment` is given: add one of them",
        ),
    ] {
        assert_load_error(keys, marked, "loads[1]", message);
    }
}

#[test]
fn numbers_and_names_of_loads() {
    let wanted = "inf is not allowed: give a finite number (of magnitude at most 1e100)";
    let acts = "block = \"lintel\"\nat = [0.5, 0.5]\nforce = [0.0, -1.0]\n";
    assert_load_error(&format!("{acts}factor = inf"), "inf", "loads[1].factor", wanted);
    for (key, keys) in [
        ("loads[1].force[0]", acts.replace("[0.0, -1.0]", "[inf, 1.0]")),
        ("loads[1].at[1]", acts.replace("[0.5, 0.5]", "[0.5, inf]")),
        ("loads[1].acceleration[0]", "acceleration = [inf, 0.0]".to_owned()),
    ] {
        assert_load_error(&keys, "inf", key, wanted);
    }
    let empty = "the name is empty: give a name by which messages and files can refer to it";
    assert_load_error(&format!("{acts}group = \" \""), "\" \"", "loads[1].group", empty);
    let three = error_of("pressure = 10.0", "acceleration = [1.0, 2.0, 3.0]").to_string();
    assert!(three.contains("length 3, expected a list of exactly 2 items"), "{three}");
}

#[test]
fn blocks_that_are_not_there_and_places_outside() {
    let force =
        |block: &str, at: &str| format!("block = \"{block}\"\nat = {at}\nforce = [0.0, -1.0]");
    assert_load_error(
        &force("lintle", "[0.5, 0.5]"),
        "\"lintle\"",
        "loads[1].block",
        "there is no block \"lintle\" in the scene; names near to it are \"lintel\", \"list/1/1\", \"list/1/2\": \
         correct the name; bricks are called WALL/COURSE/PLACE, counted from 1",
    );
    assert_load_error(
        &force("wall/3/9", "[0.5, 0.25]"),
        "\"wall/3/9\"",
        "loads[1].block",
        "there is no block \"wall/3/9\" in the scene; names near to it are \"wall/3/1\", \"wall/3/2\", \"wall/3/3\"",
    );
    assert_load_error(
        &force("lintel", "[0.25, 0.75]"),
        "[0.25, 0.75]",
        "loads[1].at",
        "the place [0.25, 0.75] lies 0.25 m outside of block \"lintel\": move it to [0.25, 0.5], or farther into the \
         block",
    );
    assert_load_error(
        &force("lintel", "[1.3, 0.9]"),
        "[1.3, 0.9]",
        "loads[1].at",
        "the place [1.3, 0.9] lies 0.5 m outside of block \"lintel\": move it to [1, 0.5], or farther into the block",
    );
    // On the edge, but for rounding, is inside.
    for at in
        ["[0.5, 0.5]", "[0.1, 0.30000000000000004]", "[0.1, 0.29999999999999993]", "[1.0, 0.5]"]
    {
        let keys = force("lintel", at);
        let text =
            GOOD.replace("[contact]", &format!("[[loads]]\nname = \"more\"\n{keys}\n[contact]"));
        Model::from_scene(&Scene::from_toml(&text).unwrap()).unwrap();
    }
}

#[test]
fn an_acceleration_without_mass() {
    let acceleration = "pressure = 10.0\n[[loads]]\nname = \"quake\"\nacceleration = [1.0, 0.0]\n";
    let massless =
        GOOD.replace("density = 1800.0\n", "").replace("pressure = 10.0\n", acceleration);
    // The density of a material that no block is made of moves nothing.
    for text in [
        massless.clone(),
        massless.replace("[joints.bed]", "[materials.lead]\ndensity = 1e4\n[joints.bed]"),
    ] {
        let error = Scene::from_toml(&text).unwrap_err();
        assert_eq!(error.key(), "loads[1].acceleration");
        let words = "load \"quake\" accelerates nothing, because no material of a block has a density: add `density` to \
                     a material, or remove the load";
        assert!(error.to_string().ends_with(words), "{error}");
        assert!(error.line().is_some());
    }
}

#[test]
fn pressures_at_two_ends_and_earth() {
    let on = |key: &str| format!("from = [0.0, 0.5]\nto = [1.0, 0.5]\n{key}");
    let load = |key: &str| GOOD.replace("pressure = 10.0", key);
    for (key, words) in [
        (
            "pressure = [1.0]",
            "length 1, expected a number, or a list of exactly 2 numbers, at `from` and at `to`",
        ),
        ("pressure = [1.0, 2.0, 3.0]", "length 3, expected a number, or a list of exactly 2"),
        ("pressure = true", "boolean `true`, expected a number, or a list of exactly 2"),
        ("earth = { gamma = 18.0, K = 0.3 }", "missing field `level`"),
        ("earth = [18.0, 0.3, 1.0]", "expected a table"),
    ] {
        let error = Scene::from_toml(&load(key)).unwrap_err();
        assert!(error.to_string().contains(words) && error.line().is_some(), "{error}");
    }
    let wanted = "inf is not allowed: give a finite number (of magnitude at most 1e100)";
    for (key, place) in [("pressure = [1, inf]", "pressure[1]"), ("pressure = inf", "pressure")] {
        assert_load_error(&on(key), "inf", &format!("loads[1].{place}"), wanted);
    }
    let positive = "give a finite number greater than zero (between 1e-100 and 1e100)";
    let earth =
        |gamma, k, level| on(&format!("earth = {{ gamma = {gamma}, K = {k}, level = {level} }}"));
    for (keys, marked, place, words) in [
        (earth("-7.5", "1.0", "2.0"), "-7.5", "gamma", format!("-7.5 is not allowed: {positive}")),
        (earth("18.0", "-7.5", "2.0"), "-7.5", "K", format!("-7.5 is not allowed: {positive}")),
        (
            earth("18.0", "1.0", "0.125"),
            "0.125",
            "level",
            "0.125 is not allowed: the level of earth or water is above the lower end of the segment".to_owned(),
        ),
    ] {
        assert_load_error(&keys, marked, &format!("loads[1].earth.{place}"), &words);
    }
    let two = format!("{}\npressure = 7.5", earth("18.0", "1.0", "2.0"));
    let words = "both `pressure` and `earth` are given";
    let error =
        error_of("pressure = 10.0", &format!("pressure = 10.0\n[[loads]]\nname = \"more\"\n{two}"));
    assert!(error.to_string().contains(words) && error.key() == "loads[1].earth", "{error}");
}

#[test]
fn tractions_within_joints() {
    let on = |keys: &str| format!("from = [0.0, 0.1]\nto = [0.6, 0.1]\ninside = true\n{keys}");
    for keys in ["pressure = 1.0", "earth = { gamma = 18.0, K = 0.3, level = 3.0 }"] {
        assert_load_error(
            &on(keys),
            "true",
            "loads[1].inside",
            "`inside` is for a traction: a pressure within a joint could act on either of the blocks that meet there: \
             remove it, or give a `traction`",
        );
    }
    assert_load_error(
        &on("traction = [7.5, 0.0]"),
        "[7.5, 0.0]",
        "loads[1].traction",
        "the traction is zero or parallel to the segment, so that it presses no block",
    );
    let load = "[[loads]]\nname = \"idle\"\nfrom = [0.0, 0.07]\nto = [0.6, 0.07]\ntraction = [0.0, -1.0]\n";
    for (more, words) in [
        ("inside = true\n", "the traction presses on no block edge along the segment"),
        ("", "set `inside = true` for a traction within joints"),
    ] {
        let text = GOOD.replace("[contact]", &format!("{load}{more}[contact]"));
        let error = Model::from_scene(&Scene::from_toml(&text).unwrap()).unwrap_err();
        assert!(error.to_string().contains(words) && error.key() == "loads[1]", "{error}");
    }
    let error = "`block` is for a load at a place";
    let keys = "block = \"lintel\"\nat = [0.5, 0.5]\nforce = [0.0, -1.0]\ninside = true";
    let found = error_of(
        "pressure = 10.0",
        &format!("pressure = 10.0\n[[loads]]\nname = \"more\"\n{keys}"),
    );
    assert!(!found.to_string().contains(error) && found.key() == "loads[1].block", "{found}");
}

#[test]
fn moments_of_loads() {
    let at = "block = \"lintel\"\nat = [0.5, 0.5]\n";
    for (keys, marked, key, message) in [
        ("moment = inf", "inf", "moment", "inf is not allowed: give a finite number"),
        (
            "force = [0.0, -1.0]\nmoment = 7.5",
            "7.5",
            "moment",
            "both `force` and `moment` are given",
        ),
        (
            "moment = 2.0\nmass = 0.25",
            "0.25",
            "mass",
            "load \"more\" has a `mass`, but a moment is not a weight: leave `mass` out",
        ),
    ] {
        assert_load_error(&format!("{at}{keys}"), marked, &format!("loads[1].{key}"), message);
    }
}

/// The good scene with loads `wind` and `gust` in a group, and a stage that takes loads to these factors.
fn assert_name_error(groups: [&str; 2], factors: &str, marked: &str, key: &str, message: &str) {
    let load = |name: &str, group: &str| {
        format!("[[loads]]\nname = \"{name}\"\ngroup = \"{group}\"\nacceleration = [1.0, 0.0]\n")
    };
    let loads = load("wind", groups[0]) + &load("gust", groups[1]);
    let stage = format!("[[stages]]\nname = \"storm\"\nloads = {{ {factors} }}\n");
    let replacement = format!("{loads}{stage}[contact]");
    assert_error("[contact]", &replacement, marked, key, &[message]);
}

#[test]
fn names_of_loads_in_stages() {
    assert_name_error(
        ["side", "side"],
        "sid = 7.0",
        "7.0",
        "stages[0].loads.sid",
        "there is no load or group \"sid\" in the scene; did you mean \"side\"? there is \"top\", \"wind\", \"gust\", \"side\": correct the \
         name or add it under [[loads]]",
    );
    assert_name_error(
        ["side", "wind"],
        "wind = 7.0",
        "7.0",
        "stages[0].loads.wind",
        "\"wind\" is the name of a load, and of the group of \"gust\": give one of them another name; there are the \
         loads \"top\", \"wind\", \"gust\" and the groups \"top\", \"side\", \"wind\"",
    );
    assert_name_error(
        ["side", "side"],
        "side = 1.0, wind = 7.0",
        "7.0",
        "stages[0].loads.wind",
        "load \"wind\" is named twice, as \"side\" and as \"wind\": keep one of them",
    );
}

#[test]
fn fill_and_axles() {
    let not_there = "there is no arch, wall or block \"wal\"";
    for (keys, marked, key, message) in [
        ("fill = { over = \"wal\", level = 1, gamma = 20 }", "\"wal\"", "fill.over", not_there),
        (
            "fill = { over = \"wall\", level = 1, gamma = -20 }",
            "-20",
            "fill.gamma",
            "-20 is not allowed",
        ),
        (
            "axle = { over = \"wall\", x = 1, force = inf }",
            "inf",
            "axle.force",
            "inf is not allowed",
        ),
        (
            "axle = { over = \"wall\", x = 1, force = -60 }",
            "-60",
            "axle.force",
            "-60 is not allowed: give a finite number greater than zero",
        ),
        (
            "axle = { over = \"wall\", x = 1, force = 1, level = 2, angle_deg = 0.0 }",
            "0.0 }",
            "axle.angle_deg",
            "0 is not allowed: an angle of spread is above 0 and at most 80 degrees",
        ),
    ] {
        assert_load_error(keys, marked, &format!("loads[1].{key}"), message);
    }
}
