//! Drawings with the faults of real ones become scenes that answer as the exact geometry does.

#![allow(clippy::float_cmp, reason = "import rounds away what is no digit of the drawing")]

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use masonry::analysis::limit::{Laws, limit_by};
use masonry::scene::Load;
use masonry::{Model, Scene, Verdict, solve};
use masonry_import::{ImportOptions, Imported, Joints};

use crate::common::{BRICK, Dxf, Polygon, changes, mapped, rounded, turned, wall};

const BRICKS: usize = 4;
const COURSES: usize = 4;

/// The supports of a wall: a line below it, turned with it.
fn on_floor(dxf: Dxf, degrees: f64) -> Dxf {
    let turn = turned(degrees);
    let width = BRICKS as f64 * BRICK[0];
    dxf.line("support", turn([-1.0, 0.0]), turn([width + 1.0, 0.0]))
}

/// The factor of a push along the courses at which a wall fails, without dilatancy in doubt: joints open as they slide.
fn limit_of(scene: &Scene, degrees: f64) -> f64 {
    let push = turned(degrees)([1.0, 0.0]);
    let gravity = turned(degrees)([0.0, -9.81]);
    let scene = scene.clone().gravity(gravity).load(Load::acceleration("push", push));
    limit_by(&scene, Laws::Associative).unwrap().associative.unwrap().load_factor.unwrap()
}

fn exact() -> Vec<Polygon> {
    wall(BRICKS, COURSES, 0.0)
}

fn exact_limit() -> f64 {
    limit_of(&on_floor(Dxf::new(6).polygons("brick", &exact()), 0.0).import().scene, 0.0)
}

/// A wall that is drawn with faults stands, has the limit of the exact wall to a part, and the joints of it.
#[track_caller]
fn assert_like_exact(imported: &Imported, degrees: f64, part: f64) {
    let expected = on_floor(Dxf::new(6).polygons("brick", &exact()), 0.0).import();
    let [model, exact] = [imported, &expected].map(|it| Model::from_scene(&it.scene).unwrap());
    assert_eq!(model.joints.len(), exact.joints.len(), "{}", imported.report());
    assert!(model.healed.is_none(), "nothing is left to heal");
    assert_eq!(solve(&imported.scene).unwrap().judgement.verdict, Verdict::Stands);
    let (found, exact) = (limit_of(&imported.scene, degrees), exact_limit());
    assert!((found / exact - 1.0).abs() < part, "{found} against {exact}");
    // The file says what the scene is.
    let text = imported.to_toml().unwrap();
    assert_eq!(Scene::from_toml(&text).unwrap(), imported.scene);
}

#[test]
fn a_turned_wall_with_rounded_corners_is_the_wall() {
    for (step, part) in [(1e-6, 1e-4), (1e-3, 2e-2)] {
        let polygons = mapped(&mapped(&exact(), turned(5.0)), rounded(step));
        let imported = on_floor(Dxf::new(6).polygons("brick", &polygons), 5.0).import();
        assert_like_exact(&imported, 5.0, part);
        assert!(changes(&imported, "moved so that blocks meet") > 10, "{}", imported.report());
    }
}

#[test]
fn a_wall_in_millimetres_is_in_metres() {
    let polygons = mapped(&exact(), |point| point.map(|it| 1e3 * it));
    let line = |dxf: Dxf| dxf.line("support", [-1e3, 0.0], [2e3, 0.0]);
    let imported = line(Dxf::new(4).polygons("brick", &polygons)).import();
    assert_like_exact(&imported, 0.0, 1e-9);
    let options =
        ImportOptions { unit: Some(masonry_drawing::Unit::Millimetre), ..ImportOptions::default() };
    let imported = line(Dxf::new(0).polygons("brick", &polygons)).import_with(&options);
    assert_like_exact(&imported, 0.0, 1e-9);
}

#[test]
fn what_is_drawn_twice_or_is_no_block_is_dropped() {
    let polygons = exact();
    let mut again = mapped(&polygons[3..6], |[x, y]| [x + 2e-4, y]);
    again[1].rotate_left(2);
    let sliver = vec![vec![[0.0, 0.1], [1.0, 0.1], [1.0, 0.1005]]];
    let dxf = Dxf::new(6).polygons("brick", &polygons).polygons("brick", &again);
    let dxf = dxf.polygons("brick", &sliver).line("brick", [0.0, 0.0], [0.1, 0.02]);
    let imported = on_floor(dxf, 0.0).entity("TEXT", "brick", "1\nA\n").import();
    assert_like_exact(&imported, 0.0, 1e-6);
    let counts = ["drawn twice", "slivers", "end freely", "TEXT was left out"];
    assert_eq!(counts.map(|what| changes(&imported, what)), [3, 1, 1, 1], "{}", imported.report());
    assert!(imported.report().contains("drawn twice were dropped: LWPOLYLINE 13 (line "));
}

#[test]
fn reversed_and_knotted_outlines_are_rectangles() {
    let mut polygons = exact();
    polygons[2].reverse();
    let [[x, y], [u, _]] = [polygons[4][0], polygons[4][1]];
    polygons[4].insert(1, [0.5 * (x + u), y + 1e-4]);
    let last = polygons[5][3];
    polygons[5].push([last[0] + 1e-4, last[1]]);
    let imported = on_floor(Dxf::new(6).polygons("brick", &polygons), 0.0).import();
    assert_like_exact(&imported, 0.0, 1e-2);
    let counts = ["turned", "nearly straight", "near corners"];
    assert_eq!(counts.map(|what| changes(&imported, what)), [1; 3], "{}", imported.report());
    assert!(imported.scene.blocks.iter().all(|block| block.corners.len() == 4));
}

#[test]
fn overlaps_and_gaps_are_closed_from_both_sides() {
    // Each brick is 2 mm longer or shorter than its place.
    let mut polygons = exact();
    for (k, polygon) in polygons.iter_mut().enumerate() {
        let by = if k % 2 == 0 { 1e-3 } else { -1e-3 };
        let inside = |x: f64| x > 1e-9 && x < BRICKS as f64 * BRICK[0] - 1e-9;
        for (corner, side) in polygon.iter_mut().zip([-by, by, by, -by]) {
            corner[0] += if inside(corner[0]) { side } else { 0.0 };
        }
    }
    let imported = on_floor(Dxf::new(6).polygons("brick", &polygons), 0.0).import();
    assert_like_exact(&imported, 0.0, 2e-2);
}

/// Supports that are drawn twice hold once: the wall has the joints and the limit of the exact one.
#[test]
fn supports_that_lie_on_others_count_once() {
    let dxf = on_floor(on_floor(Dxf::new(6).polygons("brick", &exact()), 0.0), 0.0);
    let ground = vec![[0.3, -0.5], [0.7, -0.5], [0.7, 1e-4], [0.3, 1e-4]];
    let imported = dxf.polygons("support_ground", &[ground]).import();
    assert_like_exact(&imported, 0.0, 1e-9);
    assert_eq!(
        changes(&imported, "parts of supports that lie on other"),
        2,
        "{}",
        imported.report()
    );
    // Each part of a brick is held by one of two lines that overlap.
    let beside = Dxf::new(6).polygons("brick", &exact()).line("support", [-0.1, 0.0], [0.6, 0.0]);
    let imported = beside.line("support_right", [1.1, 0.0], [0.4, 0.0]).import();
    let [left, right] = &imported.scene.supports[..] else { panic!("{}", imported.report()) };
    assert_eq!((left.to, right.from), ([0.6, 0.0], [1.1, 0.0]));
    assert!((right.to[0] - 0.6).abs() < 1e-12);
}

#[test]
fn a_drawing_in_kilometres_is_in_metres() {
    let polygons = mapped(&exact(), |point| point.map(|it| 1e-3 * it));
    let imported =
        Dxf::new(7).polygons("brick", &polygons).line("support", [-1e-3, 0.0], [2e-3, 0.0]);
    assert_like_exact(&imported.import(), 0.0, 1e-6);
}

/// Gaps that stay keep the support below them; those that the tolerance closes are told.
#[test]
fn gaps_stay_above_supports_or_are_told() {
    let above = mapped(&wall(BRICKS, COURSES, 0.01), |[x, y]| [x, y + 0.01]);
    let dxf = on_floor(Dxf::new(6).polygons("brick", &above), 0.0);
    let open = ImportOptions { joints: Some(Joints::Open), ..ImportOptions::default() };
    let imported = dxf.import_with(&open);
    assert_eq!(imported.scene.supports.len(), 1, "{}", imported.report());
    assert_eq!(changes(&imported, "gaps were closed"), 0, "{}", imported.report());
    let wide = ImportOptions { tolerance: Some(0.012), ..open };
    let closed = dxf.import_with(&wide);
    assert!(changes(&closed, "gaps were closed") > 10, "{}", closed.report());
    assert_eq!(closed.scene.contact.gap_limit, 0.0);
}

#[test]
fn open_joints_are_closed_or_filled() {
    let dxf = || on_floor(Dxf::new(6).polygons("brick", &wall(BRICKS, COURSES, 0.01)), 0.0);
    let with = |joints| {
        dxf().import_with(&ImportOptions { joints: Some(joints), ..ImportOptions::default() })
    };
    let closed = with(Joints::Close);
    assert_like_exact(&closed, 0.0, 1e-6);
    assert_eq!(closed.scene.blocks[0].corners[2], [0.25, 0.125]);

    let filled = with(Joints::Mortar);
    let model = Model::from_scene(&filled.scene).unwrap();
    let exact = Model::from_scene(&closed.scene).unwrap();
    assert_eq!(model.joints.len(), exact.joints.len());
    let films = model.joints.iter().filter_map(|joint| joint.film);
    assert!(films.clone().all(|film| (film.mortar.thickness - 0.01).abs() < 1e-12));
    assert_eq!(films.count(), exact.joints.len() - BRICKS);
    assert_eq!(filled.scene.blocks[0].corners[2], [0.245, 0.12]);
    assert_eq!(solve(&filled.scene).unwrap().judgement.verdict, Verdict::Stands);
    assert_eq!(Scene::from_toml(&filled.to_toml().unwrap()).unwrap(), filled.scene);

    let open = with(Joints::Open);
    assert_eq!(open.scene.blocks[0].corners[2], [0.245, 0.12]);
    assert!(open.scene.contact.gap_limit > 0.01);
}

#[test]
fn mortar_that_was_rounded_and_turned_is_one() {
    let polygons = mapped(&mapped(&wall(BRICKS, COURSES, 0.01), turned(5.0)), rounded(1e-4));
    let options = ImportOptions { joints: Some(Joints::Mortar), ..ImportOptions::default() };
    let imported = on_floor(Dxf::new(6).polygons("brick", &polygons), 5.0).import_with(&options);
    let thickness = |name: &str| imported.scene.joints[name].mortar_thickness();
    assert_eq!([thickness("bed"), thickness("head")], [0.01; 2]);
    assert!(Model::from_scene(&imported.scene).unwrap().healed.is_none());
}

#[test]
fn lines_and_open_polylines_make_blocks() {
    // Every line once for two bricks: beds in one piece, heads between them.
    let width = BRICKS as f64 * BRICK[0];
    let mut dxf = Dxf::new(6);
    for course in 0..=COURSES {
        let y = course as f64 * BRICK[1];
        dxf = dxf.line("brick", [width, y], [0.0, y + 2e-4]);
    }
    for polygon in exact() {
        let [from, to] = [polygon[0], polygon[3]];
        dxf = dxf.line("brick", from, to);
    }
    dxf = dxf.line("brick", [width, 0.0], [width, COURSES as f64 * BRICK[1]]);
    assert_like_exact(&on_floor(dxf, 0.0).import(), 0.0, 1e-2);

    // Polylines that are closed by their points alone.
    let mut dxf = Dxf::new(6);
    for polygon in exact() {
        let mut points: Vec<_> = polygon.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
        points.push(points[0]);
        dxf = dxf.polyline("brick", &points, false);
    }
    let imported = on_floor(dxf, 0.0).import();
    assert_like_exact(&imported, 0.0, 1e-6);
    assert_eq!(changes(&imported, "joined from lines"), exact().len());
}

/// Beds through the whole wall, and heads that end before, at and beyond them by millimetres: lines cross, and miss each other.
#[test]
fn lines_that_cross_are_divided() {
    let width = BRICKS as f64 * BRICK[0];
    let height = COURSES as f64 * BRICK[1];
    for degrees in [0.0, 5.0, 20.0] {
        let map = |point: [f64; 2]| rounded(1e-3)(turned(degrees)(point));
        let line = |dxf: Dxf, from: [f64; 2], to: [f64; 2]| dxf.line("brick", map(from), map(to));
        let mut dxf = Dxf::new(6);
        for course in 0..=COURSES {
            let y = course as f64 * BRICK[1];
            dxf = line(dxf, [-0.02, y], [width + 0.03, y]);
        }
        for (k, polygon) in exact().iter().enumerate().filter(|(_, it)| it[0][0] > 1e-9) {
            let beyond = 2e-3 * (k % 3) as f64 - 1e-3;
            let [[x, low], [_, high]] = [polygon[0], polygon[3]];
            dxf = line(dxf, [x, low - 20.0 * beyond.max(0.0)], [x, high + beyond]);
        }
        dxf = line(dxf, [0.0, -0.05], [0.0, height + 0.05]);
        dxf = line(dxf, [width, height], [width, 0.0]);
        let imported = on_floor(dxf, degrees).import();
        assert_like_exact(&imported, degrees, 2e-2);
        assert_eq!(changes(&imported, "joined from lines"), exact().len());
        assert!(changes(&imported, "end freely") > 5, "{}", imported.report());
    }
    // Closed polylines are blocks by themselves, whatever lines cross them.
    let crossed = on_floor(Dxf::new(6).polygons("brick", &exact()), 0.0);
    let crossed = crossed.line("brick", [-0.1, 0.3], [width + 0.1, 0.31]);
    assert_like_exact(&crossed.import(), 0.0, 1e-9);
}

/// The corners of a voussoir between two angles, in the order of the intrados, then the extrados backwards.
fn voussoir(from: f64, to: f64) -> [[f64; 2]; 4] {
    let at = |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin()];
    [at(1.0, from), at(1.2, from), at(1.2, to), at(1.0, to)]
}

#[test]
fn arcs_become_chords() {
    const COUNT: usize = 9;
    let step = PI / COUNT as f64;
    let bulge = (step / 4.0).tan();
    let angles: Vec<f64> = (0..=COUNT).map(|k| k as f64 * step).collect();
    let mut bulged = Dxf::new(6);
    let mut loops = Dxf::new(6);
    for pair in angles.windows(2) {
        let [a, b, c, d] = voussoir(pair[0], pair[1]);
        let points = [[a, [0.0; 2]], [b, [bulge, 0.0]], [c, [0.0; 2]], [d, [-bulge, 0.0]]];
        let points = points.map(|[[x, y], [bulge, _]]| [x, y, bulge]);
        bulged = bulged.polyline("stone", &points, true);
        loops = loops.line("stone", a, b).line("stone", c, d);
        let [from, to] = [pair[0], pair[1]].map(f64::to_degrees);
        for radius in [1.0, 1.2] {
            let arc = format!("10\n0\n20\n0\n40\n{radius}\n50\n{from}\n51\n{to}\n");
            loops = loops.entity("ARC", "stone", &arc);
        }
    }
    let [bulged, loops] = [bulged, loops].map(|dxf| dxf.import());
    for imported in [&bulged, &loops] {
        assert_eq!(imported.scene.blocks.len(), COUNT);
        let model = Model::from_scene(&imported.scene).unwrap();
        assert_eq!(model.joints.len(), COUNT + 1, "two springings");
        assert_eq!(solve(&imported.scene).unwrap().judgement.verdict, Verdict::Stands);
    }
    assert_eq!(changes(&bulged, "arcs became chords"), COUNT);
    // Each arc is one chord, so that the voussoirs are those without arcs.
    let straight = angles.windows(2).map(|pair| voussoir(pair[0], pair[1]).to_vec());
    let straight = Dxf::new(6).polygons("stone", &straight.collect::<Vec<_>>()).import();
    let expected = limit_of(&straight.scene, 0.0);
    for imported in [&bulged, &loops] {
        let found = limit_of(&imported.scene, 0.0);
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} against {expected}");
    }
    let sagitta = 1.2 * (1.0 - (step / 2.0).cos());
    let largest = bulged.changes.iter().filter_map(|it| it.by).fold(0.0, f64::max);
    assert!((largest - sagitta).abs() < 1e-9, "{largest} against {sagitta}");
}

#[test]
fn blocks_are_inserted_turned_scaled_and_nested() {
    // A stone of a unit, two of them as a course, and a stack of courses, turned by 90 degrees and 0.25 m wide.
    let stone = vec![vec![[1.0, 1.0], [2.0, 1.0], [2.0, 1.5], [1.0, 1.5]]];
    let dxf = Dxf::new(6).polygons("0", &stone).into_block("stone", [1.0, 1.0]);
    let dxf = dxf.insert("stone", [0.0, 0.0], "").insert("stone", [2.0, 0.0], "41\n-1\n");
    let dxf = dxf.into_block("course", [0.0, 0.0]);
    let pile =
        dxf.insert("course", [0.0, 0.0], "41\n0.25\n42\n0.25\n50\n90\n70\n1\n71\n3\n45\n0.125\n");
    let imported = pile.import();
    let corners = |k: usize| imported.scene.blocks[k].corners.clone();
    assert_eq!(imported.scene.blocks.len(), 6);
    let expected = [[0.0, 0.0], [0.0, 0.25], [-0.125, 0.25], [-0.125, 0.0]];
    for (found, expected) in corners(0).iter().zip(expected) {
        let off = (found[0] - expected[0]).abs() + (found[1] - expected[1]).abs();
        assert!(off < 1e-12, "{found:?} against {expected:?}");
    }
    // The second stone of a course is mirrored, and turned again.
    assert_eq!(changes(&imported, "clockwise outlines were turned"), 3);
    let place = &imported.changes[0].place;
    assert!(place.to_string().contains("LWPOLYLINE 1 in block stone of INSERT 3"), "{place}");
    assert_eq!(Model::from_scene(&imported.scene).unwrap().joints.len(), 3 + 4 + 3);
}

/// Bricks in courses in a wall, each a block of the drawing that the next one inserts.
#[test]
fn a_wall_of_nested_blocks_is_the_wall() {
    let [length, height] = BRICK;
    let brick = vec![vec![[0.0, 0.0], [length, 0.0], [length, height], [0.0, height]]];
    let whole = |x: f64, dxf: Dxf| dxf.insert("brick", [x, 0.0], "");
    let half = |x: f64, dxf: Dxf| dxf.insert("brick", [x, 0.0], "41\n0.5\n");
    let dxf = Dxf::new(6).polygons("brick", &brick).into_block("brick", [0.0, 0.0]);
    let dxf = (0..BRICKS).fold(dxf, |dxf, k| whole(k as f64 * length, dxf));
    let dxf = half(0.0, dxf.into_block("even", [0.0, 0.0]));
    let dxf = (1..BRICKS).fold(dxf, |dxf, k| whole((k as f64 - 0.5) * length, dxf));
    let dxf = half((BRICKS as f64 - 0.5) * length, dxf).into_block("odd", [0.0, 0.0]);
    let rows = format!("71\n{}\n45\n{}\n", COURSES / 2, 2.0 * height);
    let dxf = dxf.insert("even", [0.0, 0.0], &rows).insert("odd", [0.0, height], &rows);
    assert_like_exact(&on_floor(dxf, 0.0).import(), 0.0, 1e-6);
}

#[test]
fn layers_name_materials_supports_and_joints() {
    let at = |x: f64, y: f64| vec![[x, y], [x + 1.0, y], [x + 1.0, y + 0.5], [x, y + 0.5]];
    let dxf =
        Dxf::new(6).polygons("Kalk stein", &[at(0.0, 0.0)]).polygons("brick", &[at(0.0, 0.5)]);
    let dxf =
        dxf.polygons("support_base", &[at(0.0, -0.5)]).line("JOINT-lead", [-1.0, 0.5], [2.0, 0.5]);
    let dxf = dxf.line("joint-idle", [0.0, 3.0], [1.0, 3.0]).polygons("frame", &[at(5.0, 5.0)]);
    let options = ImportOptions { ignore: vec!["Frame".to_owned()], ..ImportOptions::default() };
    let imported = dxf.import_with(&options);
    let scene = &imported.scene;
    let names: Vec<&str> = scene.blocks.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["Kalk_stein/1", "brick/1"]);
    let supports: Vec<_> = scene.supports.iter().map(|it| (it.name.as_str(), it.to)).collect();
    assert_eq!(supports, [("base", [0.0, 0.0])]);
    assert_eq!(scene.between.len(), 1);
    let model = Model::from_scene(scene).unwrap();
    let classes: Vec<&str> =
        model.joints.iter().map(|it| model.joint_classes[it.class].name.as_str()).collect();
    assert_eq!(classes, ["lead", "support"]);
    let dropped = ["touch no block", "lie on no joint", "ignored"];
    assert_eq!(dropped.map(|what| changes(&imported, what)), [3, 1, 1], "{}", imported.report());
}

#[test]
fn a_drawing_without_supports_stands_on_a_floor() {
    let imported = Dxf::new(6).polygons("brick", &exact()).import();
    let [x, y] = [imported.scene.supports[0].from[0], imported.scene.supports[0].to[0]];
    assert!((x + 0.05).abs() < 1e-12 && (y - 1.05).abs() < 1e-12, "{x} {y}");
    assert!(imported.report().contains("assumed: a floor from (-0.05, 0) to (1.05, 0) m"));
    // A tower stands on its narrow side.
    let tower = Dxf::new(6).polygons("brick", &wall(1, 12, 0.0)).import();
    assert_eq!(tower.scene.supports[0].to, [0.2625, 0.0]);
    // Rounding makes no steps of it.
    let polygons = mapped(&mapped(&exact(), turned(4.0)), rounded(1e-3));
    let imported = Dxf::new(6).polygons("brick", &polygons).import();
    let model = Model::from_scene(&imported.scene).unwrap();
    let on_floor =
        model.joints.iter().filter(|it| matches!(it.a, masonry::model::Body::Support(_)));
    assert_eq!(on_floor.count(), BRICKS);
}

/// Rubble: quadrilaterals and triangles around shared corners, rounded to millimetres.
#[test]
fn rubble_that_is_rounded_meets_exactly() {
    let corner = |i: usize, j: usize| {
        let (x, y) = (i as f64, j as f64);
        let inside = (1..6).contains(&i) && (1..6).contains(&j);
        let by = if inside { 0.13 } else { 0.0 };
        let angle = FRAC_PI_4 * x + FRAC_PI_2 * y * y;
        [0.3 * (x + by * angle.sin()), 0.2 * (y + by * angle.cos())]
    };
    let cells = (0..6).flat_map(|j| (0..6).map(move |i| (i, j)));
    let polygons: Vec<Polygon> = cells
        .map(|(i, j)| vec![corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)])
        .collect();
    let mut drawn = mapped(&polygons, rounded(1e-3));
    for (k, polygon) in drawn.iter_mut().enumerate() {
        let by = if k % 3 == 0 { 1e-3 } else { 0.0 };
        polygon[2][0] -= if polygon[2][0] < 1.7 { by } else { 0.0 };
    }
    let imported = Dxf::new(6).polygons("stone", &drawn).import();
    let [drawn, exact] = [
        Model::from_scene(&imported.scene).unwrap(),
        Model::from_scene(&Dxf::new(6).polygons("stone", &polygons).import().scene).unwrap(),
    ];
    assert_eq!(drawn.joints.len(), exact.joints.len());
    assert_eq!(solve(&imported.scene).unwrap().judgement.verdict, Verdict::Stands);
}

/// A wall whose left end has L-shaped quoins of two courses each, turned and rounded.
#[test]
fn quoins_are_one_body_each() {
    let [length, height] = BRICK;
    let quoined = |map: &dyn Fn([f64; 2]) -> [f64; 2]| {
        let mut polygons = exact();
        polygons.retain(|polygon| polygon[0][0] > 1e-9);
        for course in [0, 2] {
            let y = f64::from(course) * height;
            polygons.push(vec![
                [0.0, y],
                [length, y],
                [length, y + height],
                [0.5 * length, y + height],
                [0.5 * length, y + 2.0 * height],
                [0.0, y + 2.0 * height],
            ]);
        }
        mapped(&polygons, map)
    };
    let plain = on_floor(Dxf::new(6).polygons("brick", &quoined(&|it| it)), 0.0).import();
    assert_eq!(changes(&plain, "corner that points inwards"), 2);
    assert_eq!(Model::from_scene(&plain.scene).unwrap().blocks.len(), exact().len() - 2);
    let expected = limit_of(&plain.scene, 0.0);
    assert!(expected > exact_limit());
    for (step, part) in [(1e-6, 1e-4), (1e-3, 2e-2)] {
        let drawn = quoined(&|it| rounded(step)(turned(5.0)(it)));
        let imported = on_floor(Dxf::new(6).polygons("brick", &drawn), 5.0).import();
        let [model, exact] = [&imported, &plain].map(|it| Model::from_scene(&it.scene).unwrap());
        assert_eq!(model.joints.len(), exact.joints.len(), "{}", imported.report());
        assert_eq!(solve(&imported.scene).unwrap().judgement.verdict, Verdict::Stands);
        let found = limit_of(&imported.scene, 5.0);
        assert!((found / expected - 1.0).abs() < part, "{found} against {expected}");
    }
}

#[test]
fn a_wall_of_1500_stones_meets_in_all_its_joints() {
    let polygons = mapped(&mapped(&wall(50, 30, 0.0), turned(3.0)), rounded(1e-4));
    let imported = Dxf::new(6).polygons("brick", &polygons).import();
    assert_eq!(imported.scene.blocks.len(), 1515);
    // Beds: each course meets the one below in 100 pieces, the lowest the floor in 50; heads: 49 or 50 a course.
    let model = Model::from_scene(&imported.scene).unwrap();
    assert_eq!(model.joints.len(), 29 * 100 + 50 + 15 * 49 + 15 * 50);
}
