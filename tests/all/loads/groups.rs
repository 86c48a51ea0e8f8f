//! Groups, factors and stages of loads.

use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::solve;
use masonry::model::Model;
use masonry::scene::{Load, Scene, Stage};
use masonry_report::{json, summary, svg, table};
use serde_json::Value;

use super::common::{GRAVITY, all_displacements, assert_close, difference, solved};
use super::{assert_same, block, loaded, materials, wall};

/// A load that has the name of its group beside others: the name means all of them.
#[test]
fn a_member_may_have_the_name_of_its_group() {
    let scene = block(materials()[0], [1.0, 1.0], 0.6)
        .gravity([0.0, -GRAVITY])
        .load(Load::acceleration("quake", [1.0, 0.0]))
        .load(Load::force("inertia", "block", [0.5, 1.0], [0.5, 0.0]).group("quake"));
    let all = Stage::new("quake").load("quake", 1.0);
    let pushed = solved(&scene.clone().stage(all)).reactions[0].fx;
    // A mass of 1000 kg, and half a kilonewton.
    assert_close(pushed, -1500.0, 1e-9);
    let apart = scene.load(Load::acceleration("inertia of others", [1.0, 0.0]).group("inertia"));
    let error = solve(&apart.stage(Stage::new("quake").load("inertia", 1.0))).unwrap_err();
    assert!(error.to_string().contains("of the group of"), "{error}");
}

/// The result as data, but for times.
fn data(outcome: &Outcome) -> Value {
    let mut value: Value = serde_json::from_str(&json::result(outcome, &[]).unwrap()).unwrap();
    let members = value.as_object_mut().unwrap();
    members.remove("time_s").unwrap();
    for route in members["routes"].as_array_mut().unwrap() {
        route.as_object_mut().unwrap().remove("seconds").unwrap();
    }
    value
}

/// The scene with every load changed.
fn with(scene: &Scene, change: impl Fn(Load) -> Load) -> Scene {
    let mut scene = scene.clone();
    scene.loads = scene.loads.into_iter().map(change).collect();
    scene
}

#[test]
fn a_factor_of_one_and_the_own_group_change_no_byte() {
    for material in materials() {
        let plain = loaded(wall(material));
        let keyed = with(&plain, |load| {
            let group = load.name.clone();
            load.group(&group).factor(1.0)
        });
        // Keys with their defaults, as a file has them.
        let text =
            keyed.to_toml().unwrap().replace("group = \"top\"", "group = \"top\"\nfactor = 1.0");
        let read = Scene::from_toml(&text).unwrap();
        assert_eq!(read, keyed);
        let [plain, keyed] = [solved(&plain), solved(&read)];
        assert_eq!(data(&plain).to_string(), data(&keyed).to_string());
        let pictures = [&plain, &keyed].map(|it| svg::scene(&it.title, &it.model));
        assert_eq!(pictures[0], pictures[1]);
        let numbers = [&plain, &keyed].map(all_displacements);
        let bits = numbers.map(|it| it.into_iter().map(f64::to_bits).collect::<Vec<_>>());
        assert_eq!(bits[0], bits[1]);
    }
}

#[test]
fn a_factor_of_two_is_twice_the_load() {
    for material in materials() {
        let plain = loaded(wall(material));
        let twice = with(&plain, |mut load| {
            load.pressure = load.pressure.map(|it| (2.0 * it.from).into());
            load.force = load.force.map(|it| it.map(|it| 2.0 * it));
            load.acceleration = load.acceleration.map(|it| it.map(|it| 2.0 * it));
            load
        });
        let factor = with(&plain, |load| load.factor(2.0));
        assert_same(&solved(&factor), &solved(&twice), 1e-12);
    }
}

/// A stage takes a group where it takes all of its loads, each by its own factor besides.
#[test]
fn a_stage_takes_all_loads_of_a_group() {
    for material in materials() {
        let plain =
            loaded(wall(material).load(Load::force("sign", "wall/2/1", [0.0, 0.15], [0.2, 0.0])));
        let grouped = with(&plain, |load| match load.name.as_str() {
            "top" => load,
            _ => load.group("later").factor(0.5),
        });
        let stage = |name: &str| Stage::new(name).steps(2);
        let by_group = grouped
            .clone()
            .stage(Stage::new("weight"))
            .stage(stage("push").load("later", 1.0))
            .stage(stage("back").load("later", 0.25));
        let by_name = |stage: Stage, factor| {
            ["sign", "beam", "quake"]
                .into_iter()
                .fold(stage, |stage, name| stage.load(name, factor))
        };
        let by_name = plain
            .clone()
            .stage(Stage::new("weight"))
            .stage(by_name(stage("push"), 0.5))
            .stage(by_name(stage("back"), 0.125));
        let [by_group, by_name] = [by_group, by_name].map(|scene| (solved(&scene), scene));
        assert_same(&by_group.0, &by_name.0, 1e-12);
        assert_every_step_is_balanced(&by_group.1, &by_group.0);
        let groups = summary::load_groups(&by_group.0.model);
        let factors: Vec<f64> =
            groups.iter().flat_map(|group| &group.loads).map(|(load, _)| load.factor).collect();
        assert_eq!(groups[0].name, "later");
        assert_eq!(factors, [0.125, 0.125, 0.125, 1.0]);
    }
}

/// The floor carries what acts in each step, and the scene that ends with a step stands by the checks of its state.
fn assert_every_step_is_balanced(scene: &Scene, outcome: &Outcome) {
    let history = outcome.history.as_ref().unwrap();
    assert_eq!(history.records.len(), history.steps);
    let model = Model::from_scene(scene).unwrap();
    let slips = vec![0.0; model.contacts.len()];
    for record in &history.records {
        let applied = summary::applied_load(&model.under(&record.step.actions, &slips));
        let floor = &record.reactions[0];
        let found = [-floor.fx, -floor.fy, -floor.m];
        let apart = difference(&found, &[applied.force.x, applied.force.y, applied.moment]);
        assert!(apart < 1e-9, "step {} of {}: {apart:e}", record.step.number, record.step.stage);
    }
    for stages in 1..=scene.stages.len() {
        for steps in 1..=scene.stages[stages - 1].steps {
            let mut part = scene.clone();
            part.stages.truncate(stages);
            // As many steps of the stage, and as much of it.
            let before = if stages == 3 { 1.0 } else { 0.0 };
            let last = &mut part.stages[stages - 1];
            let fraction = f64::from(steps) / f64::from(last.steps);
            last.loads.values_mut().for_each(|end| *end = before + (*end - before) * fraction);
            last.steps = steps;
            let checks = solved(&part).checks.unwrap();
            assert!(checks.hold(1e-9), "{stages}, {steps}: {checks:?}");
        }
    }
}

/// Where every contact sticks, all is linear: the work of forces at places and of accelerations is the energy that is
/// stored, to the last digits, in any number of steps.
#[test]
fn the_work_of_all_kinds_is_stored() {
    let scene = block(materials()[1], [1.2, 0.8], 2.0)
        .gravity([0.0, -GRAVITY])
        .load(Load::force("push", "block", [0.7, 0.5], [1.5, -2.0]).group("later"))
        .load(Load::acceleration("quake", [-0.15 * GRAVITY, 0.3]).group("later"))
        .stage(Stage::new("weight"))
        .stage(Stage::new("push").steps(3).load("later", 1.0))
        .stage(Stage::new("back").steps(2).load("later", -0.5));
    let history = solved(&scene).history.unwrap();
    let (mut spent, mut stored) = (0.0, Vec::new());
    for record in &history.records {
        assert_eq!(record.contacts[0] + record.contacts[2], 0, "all stick");
        spent += record.work;
        assert_close(spent, record.strain_energy, 1e-9);
        stored.push(record.strain_energy);
    }
    assert!(stored.len() == 6 && stored[3] > 1.01 * stored[0], "{stored:?}");
}

#[test]
fn reports_list_loads_by_group() {
    let scene = with(&loaded(wall(materials()[0])), |load| match load.name.as_str() {
        "top" => load.factor(1.35),
        _ => load.group("later"),
    });
    let outcome = solve(&scene).unwrap();
    let value = data(&outcome);
    let (groups, all) = (&value["load_groups"], &value["loads"]);
    let number = |value: &Value| value.as_f64().unwrap();
    assert_close(number(&groups["top"]["fy"]), -1.35 * 1.5, 1e-12);
    assert_close(number(&groups["top"]["loads"]["top"]["factor"]), 1.35, 1e-15);
    assert_close(number(&groups["later"]["loads"]["beam"]["fy"]), -1.5, 1e-12);
    let sum = number(&groups["later"]["loads"]["quake"]["fx"]) + 0.1;
    assert_close(number(&groups["later"]["fx"]), sum, 1e-12);
    assert_close(number(&all["fx"]), sum, 1e-12);
    let text = table::report(&outcome);
    let lines: Vec<Vec<&str>> =
        text.lines().map(|line| line.split_whitespace().collect()).collect();
    let heads = ["group", "load", "factor", "fx", "[kN]", "fy", "[kN]", "m", "[kNm]"];
    let at = lines.iter().position(|line| *line == heads).unwrap();
    assert_eq!(lines[at + 2][..3], ["top", "top", "1.35"]);
    assert_eq!(lines[at + 3][..3], ["later", "beam", "1"]);
    assert_eq!(lines[at + 4][..2], ["quake", "1"]);
    assert_eq!(lines[at + 5][0], "sum");
    let plan: Vec<(&str, bool)> =
        outcome.plan.effects.iter().map(|effect| (effect.name, effect.on)).collect();
    for name in ["edge loads", "point loads", "body acceleration"] {
        assert!(plan.contains(&(name, true)), "{plan:?}");
    }
    let plain = solve(&wall(materials()[0])).unwrap();
    assert!(!table::report(&plain).contains("\nLoads\n"), "there are no loads");
}
