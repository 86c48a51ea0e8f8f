//! The scenes in `scenes/`: they read, and their models and plans have the documented sizes.

use std::path::{Path, PathBuf};

use masonry::model::{Model, Plane};
use masonry::plan::Plan;
use masonry::scene::{
    Brick, Form, Joint, Load, Material, Route, Scene, SceneErrorKind, Support, Wall,
};
use masonry::units::{ForceUnit, LengthUnit, Units};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

fn read(name: &str) -> (Scene, Model, Plan) {
    let scene = Scene::read(&scenes().join(name)).unwrap_or_else(|error| panic!("{error}"));
    let model = Model::from_scene(&scene).unwrap_or_else(|error| panic!("{error}"));
    let plan = Plan::of(&scene, &model);
    (scene, model, plan)
}

fn sizes(name: &str) -> [usize; 3] {
    let (_, _, plan) = read(name);
    [plan.blocks, plan.nodes, plan.contact_points]
}

#[test]
fn panels_have_the_published_sizes() {
    assert_eq!(sizes("panel_square_full_floor.toml"), [105, 915, 735]);
    assert_eq!(sizes("panel_square.toml"), [105, 915, 711]);
    assert_eq!(sizes("panel_rectangular.toml"), [55, 765, 475]);
    assert_eq!(sizes("panel_no_floor.toml"), [105, 915, 705]);
}

#[test]
fn every_scene_reads_and_survives_a_round_trip() {
    let mut count = 0;
    for entry in std::fs::read_dir(scenes()).unwrap() {
        let path = entry.unwrap().path();
        let scene = Scene::read(&path).unwrap_or_else(|error| panic!("{error}"));
        Model::from_scene(&scene).unwrap_or_else(|error| panic!("{error}"));
        let text = scene.to_toml().unwrap();
        let again = Scene::from_toml(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(again, scene, "{}", path.display());
        assert_eq!(again.to_toml().unwrap(), text);
        count += 1;
    }
    assert!(count >= 11);
}

#[test]
fn the_builder_makes_the_scene_of_the_file() {
    let (from_file, ..) = read("panel_square.toml");
    let brick = Brick { length: 0.1, height: 0.1 };
    let wall = Wall::running_bond("panel", "brick", brick, 1.0, 10).mesh([2, 2]);
    let units = Units { length: LengthUnit::M, force: ForceUnit::Kn };
    let built = Scene::new("Square panel, dry, open base", units)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("brick", Material::elastic(1e5, 0.15))
        .joint("bed", Joint::mu(1.0))
        .joint("head", Joint::mu(1.0))
        .joint("floor", Joint::mu(1.0))
        .joint("wall", Joint::mu(1.0))
        .wall(wall)
        .support(Support::new("left foot", [0.0, 0.0], [0.1, 0.0], "floor"))
        .support(Support::new("right foot", [0.9, 0.0], [1.0, 0.0], "floor"))
        .support(Support::new("left wall", [0.0, 0.0], [0.0, 1.0], "wall"))
        .support(Support::new("right wall", [1.0, 0.0], [1.0, 1.0], "wall"))
        .load(Load::pressure("top", [0.0, 1.0], [1.0, 1.0], 10.0));
    assert_eq!(built, from_file);
}

#[test]
fn the_load_covers_the_top_and_nothing_else() {
    for name in ["panel_square.toml", "panel_rectangular.toml"] {
        let (_, model, _) = read(name);
        let mut length = 0.0;
        for block in &model.blocks {
            for load in block.edge_loads() {
                assert_eq!(load.edge, 2, "{}", block.name);
                assert!(
                    load.traction.iter().all(|it| (it.y + 1e4).abs() < 1e-9 && it.x.abs() < 1e-9)
                );
                length += (load.to - load.from) * (block.corners[2] - block.corners[3]).norm();
            }
        }
        assert!((length - 1.0).abs() < 1e-12, "{name}: {length}");
    }
}

#[test]
fn the_plan_says_what_is_built_and_why() {
    let (scene, model, plan) = read("panel_square.toml");
    let routes = |plan: &Plan| plan.routes.iter().map(|it| it.route).collect::<Vec<_>>();
    assert_eq!(routes(&plan), [Route::Interior, Route::Forces], "pivots take seconds");
    assert_eq!(plan.order, 1830 + 3 * 711);
    let plan = Plan::of(&scene.route(Route::Lemke), &model);
    assert_eq!((plan.order, plan.rigid_modes, plan.frictional_points), (3 * 711, 315, 711));
    assert_eq!(plan.largest_order, 4 * 711 + 2 * 315);
    let effect = |name: &str| plan.effects.iter().find(|effect| effect.name == name).unwrap();
    assert!(effect("friction").on && effect("friction").unknowns == 2 * 711);
    let deformation = effect("deformation");
    assert!(deformation.on && deformation.unknowns == 0, "pivots eliminate displacements");
    assert!(deformation.cost.contains("1830 displacements"), "{}", deformation.cost);
    assert!(!effect("self weight").on && effect("edge loads").on && effect("stresses").on);
    let text = masonry_report::table::plan(&plan);
    // Columns are narrow: the words of a cell may stand in several lines.
    for words in ["mu > 0 in", "E given for brick", "expected cost", "1422", "2133", "869 MB"] {
        assert!(text.contains(words), "no `{words}` in\n{text}");
    }
    let friction = effect("friction");
    assert_eq!(friction.because, "mu > 0 in bed, floor, head, wall");
    assert!(friction.cost.contains("order 2133 instead of 711"), "{}", friction.cost);
}

#[test]
fn without_friction_the_order_is_the_number_of_points() {
    let (scene, model, plan) = read("wedge.toml");
    assert_eq!((plan.routes[0].route, plan.order), (Route::Forces, 3 + 4));
    let plan = Plan::of(&scene.route(Route::Lemke), &model);
    assert_eq!((plan.order, plan.contact_points, plan.frictional_points), (4, 4, 0));
    assert_eq!((plan.nodes, plan.blocks), (0, 1));
    assert!(plan.effects.iter().all(|effect| effect.name != "friction" || !effect.on));
    assert!(masonry_report::table::plan(&plan).contains("symmetric"));
}

#[test]
fn other_forms_have_more_unknowns() {
    let (scene, model, _) = read("stack.toml");
    let plan = Plan::of(&scene.clone().route(Route::Lemke), &model);
    assert_eq!((plan.contact_points, plan.order), (10, 30));
    let plan = Plan::of(&scene.clone().form(Form::Mixed), &model);
    assert_eq!(plan.order, 40 + 2 * 15);
    let plan = Plan::of(&scene.form(Form::StewartTrinkle), &model);
    assert_eq!(plan.order, 40);
    let friction = plan.effects.iter().find(|effect| effect.name == "friction").unwrap();
    assert_eq!(friction.unknowns, 30);
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let path = scenes().join("nothing_here.toml");
    let error = Scene::read(&path).unwrap_err();
    assert!(matches!(error.kind(), SceneErrorKind::Read { .. }));
    assert_eq!((error.file(), error.line()), (Some(path.as_path()), None));
    assert!(error.to_string().contains("nothing_here.toml"));
}

/// A mesh that fits in no memory is refused by its count, before it is made.
#[test]
fn a_wall_of_too_many_elements_is_refused() {
    let brick = Brick { length: 0.2, height: 0.1 };
    let scene = |mesh: [u32; 2]| {
        Scene::new("Fine", Units::SI)
            .plane(Plane::Stress)
            .thickness(0.1)
            .material("brick", Material::elastic(1e9, 0.2))
            .joint("bed", Joint::mu(0.6))
            .joint("head", Joint::mu(0.6))
            .wall(Wall::running_bond("wall", "brick", brick, 2.0, 100).mesh(mesh))
            .support(Support::new("floor", [0.0, 0.0], [2.0, 0.0], "bed"))
    };
    let error = scene([200, 200]).check().unwrap_err().to_string();
    assert!(error.contains("elements of a wall"), "{error}");
    scene([10, 10]).check().unwrap();
}
