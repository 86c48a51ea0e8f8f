//! Mistakes in joints with mortar.

use super::*;

/// The head joints of the good scene with further keys.
fn assert_head_error(keys: &str, marked: &str, key: &str, words: &[&str]) {
    let replacement = format!("[joints.head]\nphi_deg = 30.0\n{keys}");
    assert_error("[joints.head]\nphi_deg = 30.0", &replacement, marked, key, words);
}

#[test]
fn mortar_without_a_material_or_with_a_wrong_one() {
    let at = "joints.head";
    let missing = ["`material` is missing", "material = \"mortar\""];
    assert_head_error("thickness = 0.01", "[joints.head]", at, &missing);
    let unwanted = ["no meaning without `thickness`", "add `thickness`"];
    assert_head_error("material = \"brick\"", "\"brick\"", "joints.head.material", &unwanted);
    let unknown = ["no material \"lime\"", "\"brick\", \"stone\"", "[materials.lime]"];
    let keys = "thickness = 0.01\nmaterial = \"lime\"";
    assert_head_error(keys, "\"lime\"", "joints.head.material", &unknown);
    let negative = "thickness = -0.01\nmaterial = \"brick\"";
    let words = ["-0.01 is not allowed"];
    assert_head_error(negative, "-0.01", "joints.head.thickness", &words);
    let error = error_of("phi_deg = 30.0", "mu = 0.5\nthickness = 0.01\nmaterial = \"stone\"");
    assert_eq!((error.key().as_str(), error.line()), ("materials.stone", Some(15)), "{error}");
    assert!(error.to_string().contains("`E` is missing"), "{error}");
    let error = error_of("nu = 0.2\ndensity = 1800.0\n", "density = 1800.0\n");
    assert!(error.to_string().contains("`nu` is missing"), "{error}");
}

#[test]
fn mortar_that_leaves_nothing_of_a_brick() {
    let list = "courses = [[1, 1], [0.5, 1, 0.5]]";
    let text = GOOD
        .replace("phi_deg = 30.0", "phi_deg = 30.0\nthickness = 0.02\nmaterial = \"brick\"")
        .replace(list, "courses = [[1, 1], [0.5, -1, 0.05]]");
    let error = Scene::from_toml(&text).unwrap_err();
    assert_eq!(error.key(), "walls[1].courses[1][2]", "{error}");
    assert!(error.to_string().contains("0.05 is not allowed"), "{error}");
    assert!(error.line().is_some());
    // Five bricks of 0.2 and five joints of 0.02, the last of them without a brick behind it.
    let text = text.replace("width = 1.0", "width = 1.1");
    let error = Scene::from_toml(&text).unwrap_err();
    assert_eq!(error.key(), "walls[0].width", "{error}");
    assert!(error.to_string().contains("n (length + t_y) - t_y"), "{error}");
}

#[test]
fn blocks_too_close_for_their_mortar() {
    let side = |x: f64| [[x, 0.0], [x + 0.2, 0.0], [x + 0.2, 0.1], [x, 0.1]];
    let scene = |apart: f64| {
        Scene::new("pair", Units::SI)
            .plane(masonry::model::Plane::Stress)
            .thickness(1.0)
            .material("stone", Material::rigid())
            .material("mortar", Material::elastic(1e9, 0.2))
            .joint("floor", Joint::mu(0.5))
            .joint("head", Joint::mu(0.5).mortar(0.01, "mortar"))
            .block(Block::new("left", "stone", side(0.0)))
            .block(Block::new("right", "stone", side(0.2 + apart)))
            .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "floor"))
    };
    for apart in [0.0, 0.004] {
        let error = Model::from_scene(&scene(apart)).unwrap_err();
        assert_eq!(error.key(), "joints.head.thickness", "{error}");
        let text = error.to_string();
        assert!(
            text.contains("left and right stand") && text.contains("mortar of 0.010000 m"),
            "{text}"
        );
    }
    let joints = |scene: &Scene| Model::from_scene(scene).unwrap().joints.len();
    assert_eq!((joints(&scene(0.01)), joints(&scene(0.015))), (3, 2));
    // Beyond the mortar the gap limit counts.
    let model = Model::from_scene(&scene(0.015).gap_limit(0.01)).unwrap();
    let film = model.joints.iter().position(|joint| joint.film.is_some()).unwrap();
    let points: Vec<_> = model.contacts.iter().filter(|it| it.joint.index() == film).collect();
    assert!(points.iter().all(|point| (point.gap - 0.005).abs() < 1e-15));
}

#[test]
fn strips_at_the_wrong_points_or_without_mortar() {
    let key = "contact.films";
    let elsewhere = ["Gauss points only", "or set points = \"gauss\""];
    assert_error("gap_limit = 0.0", "films = \"strips\"", "\"strips\"", key, &elsewhere);
    let dry = ["no joint class has a thickness", "`thickness` and `material`"];
    let strips = "points = \"gauss\"\nfilms = \"strips\"";
    assert_error("gap_limit = 0.0", strips, "\"strips\"", key, &dry);
    let unknown = "films = \"springs\"";
    let words = ["`compliance`", "`strips`"];
    assert_error("gap_limit = 0.0", unknown, "\"springs\"", "", &words);
    // A thickness of zero is a dry joint, and no mistake.
    let text = GOOD
        .replace("phi_deg = 30.0", "phi_deg = 30.0\nthickness = 0.0")
        .replace("gap_limit = 0.0", strips);
    Scene::from_toml(&text).unwrap();
}
