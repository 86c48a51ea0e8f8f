//! Arches: their generators, and published and closed forms of how thick they must be and what they carry.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use masonry::Model;
use masonry::scene::{Arch, Opening, Piers, Scene};
use serde_json::Value;

/// A scene with one arch, whose keys follow, under its own weight of 10 kN/m3.
fn scene(mu: f64, arch: &str, more: &str) -> String {
    format!(
        "title = \"Arch\"\nthickness = 1.0\ngravity = [0.0, -10.0]\n\
         units = {{ length = \"m\", force = \"kN\" }}\n\
         materials.stone.density = 1000.0\njoints.radial.mu = {mu}\n\
         [[arches]]\nname = \"arch\"\nmaterial = \"stone\"\njoint = \"radial\"\nspringing = \"radial\"\n\
         {arch}\n{more}"
    )
}

/// A semicircular arch with a mean radius of a metre.
fn semicircular(thickness: f64, voussoirs: u32) -> String {
    let span = 2.0 - thickness;
    format!(
        "shape = \"semicircular\"\nspan = {span}\nthickness = {thickness}\nvoussoirs = {voussoirs}"
    )
}

fn written(name: &str, scene: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("arches");
    fs::create_dir_all(&directory).unwrap();
    let path = directory.join(format!("{name}.toml"));
    fs::write(&path, scene).unwrap();
    path
}

/// What `masonry limit` prints with these flags.
#[track_caller]
fn limit(name: &str, scene: &str, flags: &[&str]) -> Value {
    let path = written(name, scene);
    let command = ["limit", path.to_str().unwrap(), "--json"];
    let output =
        Command::new(env!("CARGO_BIN_EXE_masonry")).args(command).args(flags).output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{name}: {errors}"))
}

/// The least thickness by the mean radius, with the intrados kept.
#[track_caller]
fn least_ratio(name: &str, scene: &str, inner_radius: f64) -> f64 {
    let found = limit(name, scene, &["--thickness", "arch"]);
    assert_eq!(found["proved"], true, "{name}: {found}");
    let thickness = found["stands"].as_f64().unwrap();
    thickness / (inner_radius + 0.5 * thickness)
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found}, expected {expected}");
}

/// Milankovitch's 0.1075 is that of infinitely many voussoirs; the others are of linear programs set up independently.
#[test]
fn a_semicircular_arch_needs_a_tenth_of_its_radius() {
    let ratios = [
        (5, 0.0950),
        (7, 0.0957),
        (9, 0.1015),
        (10, 0.1070),
        (11, 0.1046),
        (15, 0.1061),
        (20, 0.10735),
        (21, 0.1067),
        (30, 0.1074),
        (40, 0.10743),
        (101, 0.10745),
    ];
    for (voussoirs, ratio) in ratios {
        let arch = semicircular(0.2, voussoirs);
        let found = least_ratio(&format!("n_{voussoirs}"), &scene(1.0, &arch, ""), 0.9);
        assert_near(found, ratio, 6e-5, &format!("{voussoirs} voussoirs"));
    }
}

/// Below 0.395 joints slide before hinges form, and at 0.3 no arch stands. Values as above.
#[test]
fn friction_below_two_fifths_makes_arches_thicker() {
    let ratios = [
        (0.5, 0.10743),
        (0.4, 0.10743),
        (0.395, 0.1079),
        (0.39, 0.1124),
        (0.37, 0.1311),
        (0.35, 0.1521),
        (0.33, 0.1742),
        (0.31, 0.1976),
    ];
    for (mu, ratio) in ratios {
        let found = least_ratio(&format!("mu_{mu}"), &scene(mu, &semicircular(0.2, 40), ""), 0.9);
        assert_near(found, ratio, 6e-5, &format!("mu = {mu}"));
    }
    let found = limit("mu_0.3", &scene(0.3, &semicircular(0.2, 40), ""), &["--thickness", "arch"]);
    assert!(found["stands"].is_null() && found["falls"].is_number(), "{found}");
}

/// A load on the crown stays in its place, which a thinner arch does not reach.
#[test]
fn a_thinner_arch_that_does_not_fit_ends_the_search() {
    let load =
        "[[loads]]\nname = \"weight\"\nblock = \"arch/5\"\nat = [0.9, 1.05]\nforce = [0.0, -1.0]";
    let found = limit("unfit", &scene(1.0, &semicircular(0.2, 9), load), &["--thickness", "arch"]);
    assert!(found["proved"] == false && found["stands"] == 0.2, "{found}");
    let sentence = found["sentence"].as_str().unwrap();
    assert!(
        sentence.contains("A thickness of 0.100000 m does not fit into the scene: loads[0].at"),
        "{sentence}"
    );
}

#[test]
fn flatter_arches_may_be_thinner() {
    for (embrace, ratio) in [(160.0, 0.0686), (140.0, 0.0412), (120.0, 0.0228), (100.0, 0.0113)] {
        let arch = format!(
            "shape = \"segmental\"\nspan = 2.0\nembrace_deg = {embrace:.1}\nthickness = 0.1\nvoussoirs = 60"
        );
        let radius = 1.0 / (0.5_f64 * embrace).to_radians().sin();
        let found = least_ratio(&format!("embrace_{embrace}"), &scene(1.0, &arch, ""), radius);
        assert_near(found, ratio, 6e-5, &format!("{embrace} degrees"));
    }
}

/// Thrusts and loads of an arch of 40 voussoirs relative to its weight, by independent linear programs.
#[test]
fn thrusts_and_loads_of_a_semicircular_arch() {
    let cases = [
        (0.15, [0.1760, 0.2272, 0.2551, 0.1293, 0.1446]),
        (0.20, [0.1540, 0.2548, 0.5190, 0.3665, 0.2844]),
    ];
    for (t, [least, largest, haunch, crown, sideways]) in cases {
        let arch = semicircular(t, 40);
        let outer = 1.0 + 0.5 * t;
        let range = limit(&format!("range_{t}"), &scene(1.0, &arch, ""), &["--range"]);
        let model = Model::from_scene(&Scene::from_toml(&scene(1.0, &arch, "")).unwrap()).unwrap();
        let area: f64 = model.blocks.iter().map(|it| masonry::geometry::area(&it.corners)).sum();
        let weight = 10.0 * area;
        let thrust = &range["range"]["arch/left"]["fx"];
        for (end, expected) in [("min", least), ("max", largest)] {
            let found = thrust[end]["value"].as_f64().unwrap() / weight;
            assert_near(found, expected, 6e-5, &format!("{end} thrust at t = {t}"));
        }
        // On the vertical through the circle of the extrados at an angle, which lies outside of the voussoir.
        let on = |voussoir: u32, degrees: f64| {
            let (x, y) = (outer * degrees.to_radians().cos(), outer * degrees.to_radians().sin());
            format!(
                "[[loads]]\nname = \"p\"\nblock = \"arch/{voussoir}\"\nat = [{}, {}]\nforce = [0.0, {}]",
                0.5 * (2.0 - t) - x,
                y - 0.05,
                -weight
            )
        };
        let pushed = "[[loads]]\nname = \"p\"\nacceleration = [10.0, 0.0]".to_owned();
        for (name, load, expected) in [
            ("haunch", on(14, 60.0), haunch),
            ("crown", on(20, 90.0), crown),
            ("sideways", pushed, sideways),
        ] {
            let found = limit(&format!("{name}_{t}"), &scene(1.0, &arch, &load), &[]);
            assert_eq!(found["associative"]["proved"], true);
            let factor = found["associative"]["load_factor"].as_f64().unwrap();
            assert_near(factor, expected, 1e-3 * expected, &format!("{name} at t = {t}"));
        }
    }
}

/// The thrusts of an arch by its weight, as its supports spread and close, and the least and the largest of the program.
fn thrusts(name: &str, text: &str) -> ([Vec<f64>; 2], [f64; 2]) {
    let range = limit(name, text, &["--range"]);
    let path = written(name, text);
    let command = ["solve", path.to_str().unwrap(), "--json"];
    let output = Command::new(env!("CARGO_BIN_EXE_masonry")).args(command).output().unwrap();
    let solved: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(solved["verdict"], "stands");
    let weight = -solved["weight"]["fy"].as_f64().unwrap();
    let ends = ["min", "max"]
        .map(|end| range["range"]["arch/left"]["fx"][end]["value"].as_f64().unwrap() / weight);
    let mut thrusts = [Vec::new(), Vec::new()];
    for record in solved["history"]["records"].as_array().unwrap() {
        let thrust = record["reactions"]["arch/left"]["fx"].as_f64().unwrap() / weight;
        let moved = record["moves"]["arch/right"]["x"].as_f64().unwrap();
        if moved.abs() > 1e-6 {
            thrusts[usize::from(moved < 0.0)].push(thrust);
        }
    }
    (thrusts, ends)
}

/// Where supports spread, the thrust is the least that friction allows; where they close, the largest. Rigid voussoirs
/// show it at the first movement, elastic ones where hinges have opened.
#[test]
fn the_thrust_is_least_as_supports_spread_and_largest_as_they_close() {
    let scene =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/arch_on_moving_supports.toml");
    let rigid = fs::read_to_string(scene).unwrap();
    let elastic = rigid
        .replace("density = 2000.0", "density = 2000.0\nE = 1e7\nnu = 0.2")
        .replace("voussoirs = 40", "voussoirs = 20\nmesh = [2, 3]")
        .replace("gravity", "plane = \"stress\"\ngravity");
    for (name, text) in [("moving", &rigid), ("moving_elastic", &elastic)] {
        let ([spread, close], [least, largest]) = thrusts(name, text);
        assert_eq!((spread.len(), close.len()), (3, 2), "{name}");
        for (thrusts, end) in [(&spread, least), (&close, largest)] {
            for thrust in thrusts {
                assert_near(thrust / end, 1.0, 1e-6, name);
            }
        }
        if name == "moving" {
            assert_near(spread[0], 0.1760, 6e-5, name);
            assert_near(close[0], 0.2272, 6e-5, name);
        }
    }
}

fn model(arch: &str) -> Model {
    Model::from_scene(&Scene::from_toml(&scene(0.7, arch, "")).unwrap()).unwrap()
}

/// The highest and the lowest corner, and the widths of all corners.
fn extent(model: &Model) -> [f64; 4] {
    let corners = || model.blocks.iter().flat_map(|block| &block.corners);
    let of = |f: fn(&nalgebra::Point2<f64>) -> f64| {
        corners().map(f).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
    };
    let ([left, right], [low, high]) = (of(|p| p.x), of(|p| p.y));
    [left, right, low, high]
}

#[track_caller]
fn assert_extent(arch: &str, blocks: usize, expected: [f64; 4]) {
    let model = model(arch);
    assert_eq!(model.blocks.len(), blocks);
    for (found, expected) in extent(&model).into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{arch}: {:?}", extent(&model));
    }
    // One joint between two neighbours each, and one with each support.
    assert_eq!(model.joints.len(), blocks + 1, "{arch}");
}

#[test]
fn arches_of_all_shapes_are_where_they_should_be() {
    let ring = "thickness = 0.5\nvoussoirs = 8\n";
    // 3, 4, 5: a span of 8 and a rise of 2 is an arc of radius 5.
    let (rise, embrace) = ("rise = 2.0", "embrace_deg = 106.26020470831196");
    for height in [rise, embrace] {
        let arch = format!("shape = \"segmental\"\nspan = 8.0\n{height}\n{ring}");
        assert_extent(&arch, 8, [-0.4, 8.4, 0.0, 2.5]);
    }
    let moved = format!("shape = \"semicircular\"\norigin = [1.0, 2.0]\nspan = 4.0\n{ring}");
    assert_extent(&moved, 8, [0.5, 5.5, 2.0, 4.5]);
    // Equilateral: both radii are the span.
    let high = (4.5_f64 * 4.5 - 4.0).sqrt();
    let pointed = format!("shape = \"pointed\"\nspan = 4.0\nrise = {}\n{ring}", 12.0_f64.sqrt());
    assert_extent(&pointed, 8, [-0.5, 4.5, 0.0, high]);
    let flat = format!("shape = \"flat\"\nspan = 2.0\nskew_deg = 45.0\n{ring}");
    assert_extent(&flat, 8, [-0.5, 2.5, 0.0, 0.5]);
    let lines = "shape = \"joints\"\nlines = [[[0.0, 0.0], [0.0, 1.0]], [[1.0, 0.2], [1.0, 1.0]], [[2.0, 0.0], [2.0, 1.0]]]";
    assert_extent(lines, 2, [0.0, 2.0, 0.0, 1.0]);
    // Two blocks and one with an inclined face on each side.
    let piers = "piers = { width = 1.0, height = 3.0, courses = 2 }";
    let arch = format!("shape = \"segmental\"\nspan = 8.0\n{rise}\n{ring}{piers}");
    assert_extent(&arch, 14, [-1.0, 9.0, -3.0, 2.5]);
    let arch = format!("shape = \"semicircular\"\nspan = 8.0\n{ring}{piers}");
    assert_extent(&arch, 12, [-1.0, 9.0, -3.0, 4.5]);
}

/// Piers of a semicircular arch turn over outwards when they are slender, and hold when they are buttresses.
#[test]
fn buttresses_hold_what_slender_piers_do_not() {
    let on = |width: f64| {
        let piers = format!("piers = {{ width = {width:?}, height = 3.0, courses = 1 }}");
        let arch = semicircular(0.3, 20);
        limit(&format!("piers_{width}"), &scene(0.7, &format!("{arch}\n{piers}"), ""), &["--range"])
    };
    assert!(on(0.3)["range"].is_null());
    assert!(on(1.0)["range"].is_object());
}

#[test]
fn impossible_arches_name_the_key_the_value_and_what_would_fit() {
    let ring = "thickness = 0.5\nvoussoirs = 8\n";
    let cases = [
        (
            "shape = \"segmental\"\nspan = 4.0\nrise = 3.0",
            "arches[0].rise: a rise of 3 is more than that of half a circle of this span: give at most 2",
        ),
        ("shape = \"segmental\"\nspan = 4.0", "neither `rise` nor `embrace_deg`"),
        (
            "shape = \"segmental\"\nspan = 4.0\nrise = 1.0\nembrace_deg = 90.0",
            "both `rise` and `embrace_deg`",
        ),
        (
            "shape = \"segmental\"\nspan = 4.0\nembrace_deg = 200.0",
            "200 is not allowed: an arc of a circle embraces",
        ),
        ("shape = \"semicircular\"\nspan = 4.0\nrise = 2.0", "`rise` follows from the shape"),
        ("shape = \"semicircular\"\nspan = -4.0", "arches[0].span: -4 is not allowed"),
        ("shape = \"semicircular\"", "`span` is missing"),
        ("shape = \"pointed\"\nspan = 4.0\nrise = 2.0", "rises by more than 2"),
        ("shape = \"flat\"\nspan = 4.0\nskew_deg = 90.0", "at most 80 degrees"),
        ("shape = \"joints\"", "`span`"),
        ("shape = \"round\"\nspan = 4.0", "unknown variant `round`"),
        (
            "shape = \"semicircular\"\nspan = 4.0\npiers = { width = 0.4, height = 1.0, courses = 1 }",
            "arches[0].piers.width: a pier 0.4 wide does not reach below the springing: give more than 0.5",
        ),
    ];
    for (arch, message) in cases {
        let ring = if arch.contains("joints") { "span = 1.0\n" } else { ring };
        // Tables within the arch come last.
        let text = match arch.split_once("\npiers") {
            Some((first, piers)) => format!("{first}\n{ring}piers{piers}"),
            None => format!("{arch}\n{ring}"),
        };
        let error = Scene::from_toml(&scene(0.7, &text, "")).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
        assert!(error.contains("line "), "{error}");
    }
    let odd = "shape = \"pointed\"\nspan = 4.0\nrise = 3.0\nthickness = 0.5\nvoussoirs = 7\n";
    let error = Scene::from_toml(&scene(0.7, odd, "")).unwrap_err().to_string();
    assert!(error.contains("give an even number, such as 8"), "{error}");
    let found = masonry::analysis::limit::least_thickness(
        &Scene::from_toml(&scene(0.7, &semicircular(0.2, 9), "")).unwrap(),
        "arc",
    );
    assert!(
        found
            .unwrap_err()
            .to_string()
            .contains("there is no arch \"arc\" in the scene; did you mean \"arch\"?")
    );
}

#[test]
fn arches_and_openings_built_in_rust_are_those_of_a_file() {
    let read = |arch: &str| Scene::from_toml(&scene(1.0, arch, "")).unwrap().arches.remove(0);
    let named = |arch: Arch| arch.joint("radial").springing("radial");
    assert_eq!(
        read(
            "shape = \"pointed\"\nspan = 2.0\nrise = 1.5\nthickness = 0.3\nvoussoirs = 8\norigin = [1.0, 2.0]"
        ),
        named(Arch::pointed("arch", "stone", 2.0, 1.5, 0.3, 8)).origin([1.0, 2.0])
    );
    assert_eq!(
        read(
            "shape = \"flat\"\nspan = 2.0\nskew_deg = 20.0\nthickness = 0.3\nvoussoirs = 7\nmesh = [2, 2]\n\
             piers = { width = 0.5, height = 1.0, courses = 2 }"
        ),
        named(Arch::flat("arch", "stone", 2.0, 20.0, 0.3, 7)).mesh([2, 2]).piers(Piers {
            width: 0.5,
            height: 1.0,
            courses: 2
        })
    );
    let lines = vec![[[0.0, 0.0], [-0.5, 0.5]], [[1.0, 0.2], [1.0, 0.7]], [[2.0, 0.0], [2.5, 0.5]]];
    assert_eq!(
        read(
            "shape = \"joints\"\n\
             lines = [[[0, 0], [-0.5, 0.5]], [[1, 0.2], [1, 0.7]], [[2, 0], [2.5, 0.5]]]"
        ),
        named(Arch::between_joints("arch", "stone", lines))
    );
    let window: Opening = serde_json::from_str(
        r#"{"x": 1, "width": 0.8, "course": 4, "courses": 4, "bearing": 0.2}"#,
    )
    .unwrap();
    assert_eq!(window, Opening::door(1.0, 0.8, 4).above(3).bearing(0.2));
}
