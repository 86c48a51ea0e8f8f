//! Joints that give way by a stiffness of their own, against answers in closed form, by every route.

use crate::common;

use common::routes::{answer_by, rounding, routes_for, solved_by};
use common::{
    GRAVITY, M_KN, all_displacements, assert_close, difference, displacements, rectangle, solved,
    stands, state,
};
use lcp::Status;
use masonry::analysis::limit;
use masonry::analysis::outcome::{Outcome, PointStatus};
use masonry::analysis::solve::solve;
use masonry::data::verdict::{Evidence, Verdict};
use masonry::model::{Model, Plane};
use masonry::scene::{
    Brick, Films, Form, Joint, Load, Material, Movement, PointRule, Route, RouteSetting, Scene,
    Stage, Support, Wall,
};
use masonry::units::{ForceUnit, LengthUnit, Units};
use masonry_report::{csv, json, table};

/// Width, height and thickness of a block \[m\], its weight \[kN\], and friction.
const B: f64 = 0.8;
const H: f64 = 0.5;
const T: f64 = 0.25;
const W: f64 = 2.0 * GRAVITY * B * H * T;
const MU: f64 = 0.6;
/// Stiffness across and along the joints \[kN/m3\], and a pressure \[kN/m2\].
const K_N: f64 = 4e6;
const K_T: f64 = 1.5e6;
const P: f64 = 200.0;
/// Young's modulus of elastic blocks \[kN/m2\].
const E: f64 = 5e6;

fn soft() -> Joint {
    Joint::mu(MU).stiffness([K_N, K_T])
}

fn scene(material: Material, joint: Joint) -> Scene {
    Scene::new("Joints that give way", M_KN)
        .plane(Plane::Stress)
        .thickness(T)
        .material("stone", material)
        .joint("bed", joint)
        .support(Support::new("floor", [-1.0, 0.0], [2.0, 0.0], "bed"))
}

/// So many blocks on each other and on a floor, all with this joint.
fn pile(count: u32, material: Material, joint: Joint) -> Scene {
    (0..count).map(f64::from).fold(scene(material, joint), |scene, k| {
        let block = rectangle(&format!("{k}"), "stone", [0.0, B], [k * H, (k + 1.0) * H]);
        scene.block(block.mesh([2, 2]))
    })
}

fn pressed(scene: Scene, top: f64) -> Scene {
    scene.load(Load::pressure("top", [0.0, top], [B, top], P))
}

#[test]
fn two_rigid_blocks_sink_by_the_pressure_of_two_joints() {
    let scene = pressed(pile(2, Material::rigid(), soft()), 2.0 * H);
    for route in routes_for(&scene) {
        let outcome = solved_by(&scene, route);
        for (name, joints) in [("0", 1.0), ("1", 2.0)] {
            for u in displacements(&outcome, name) {
                assert_close(u.y, -joints * P / K_N, rounding(route));
                assert!(u.x.abs() <= rounding(route) * P / K_N, "{route:?}: {u}");
            }
        }
        let work = 0.5 * P * B * T * 2.0 * P / K_N;
        assert_close(state(&outcome).strain_energy / 1e3, work, 10.0 * rounding(route));
        let is_closed = |it: &masonry::analysis::outcome::PointState| {
            it.status == PointStatus::Stick && it.y_n.abs() <= rounding(route) * P / K_N
        };
        assert!(state(&outcome).contacts.iter().all(is_closed), "{route:?}");
        assert_eq!(outcome.judgement.verdict, Verdict::Stands);
    }
}

/// In a joint the weight of all blocks above it.
#[test]
fn a_pile_settles_by_the_sum_of_its_joints() {
    let count = 7;
    let stone = Material::rigid().density(2000.0);
    let scene = pile(count, stone, soft()).gravity([0.0, -GRAVITY]);
    for route in routes_for(&scene) {
        let Some(outcome) = answer_by(&scene, route) else { continue };
        let (mut settled, mut energy) = (0.0, 0.0);
        for k in 0..count {
            let force = f64::from(count - k) * W;
            settled += force / (K_N * B * T);
            energy += 0.5 * force * force / (K_N * B * T);
            for u in displacements(&outcome, &k.to_string()) {
                assert_close(u.y, -settled, 10.0 * rounding(route));
            }
        }
        assert_close(state(&outcome).strain_energy / 1e3, energy, 10.0 * rounding(route));
    }
}

#[test]
fn elastic_blocks_and_their_joints_are_in_series() {
    let count = 3;
    for points in [PointRule::Vertices, PointRule::NodalPairs, PointRule::Gauss] {
        let scene = pile(count, Material::elastic(E, 0.0), soft()).contact_points(points);
        let scene = pressed(scene, f64::from(count) * H);
        let expected = -f64::from(count) * P * (H / E + 1.0 / K_N);
        for route in routes_for(&scene) {
            let outcome = solved_by(&scene, route);
            for u in &displacements(&outcome, "2")[6..] {
                assert_close(u.y, expected, rounding(route));
            }
            let work = 0.5 * P * B * T * -expected;
            assert_close(state(&outcome).strain_energy / 1e3, work, 10.0 * rounding(route));
        }
    }
}

/// A block that is pressed and sheared without a moment: couples at its sides take that of the load on top.
fn sheared(material: Material, share: f64) -> Scene {
    let tau = share * MU * P;
    pressed(pile(1, material, soft()), H)
        .load(Load::traction("push", [0.0, H], [B, H], [tau, 0.0]))
        .load(Load::traction("left", [0.0, 0.0], [0.0, H], [0.0, -tau]))
        .load(Load::traction("right", [B, 0.0], [B, H], [0.0, tau]))
}

#[test]
fn a_joint_in_shear_is_a_spring_up_to_the_bound_of_friction() {
    for share in [0.5, -0.999] {
        let scene = sheared(Material::rigid(), share);
        for route in routes_for(&scene) {
            let Some(outcome) = answer_by(&scene, route) else { continue };
            for u in displacements(&outcome, "0") {
                assert_close(u.x, share * MU * P / K_T, 10.0 * rounding(route));
                assert_close(u.y, -P / K_N, 10.0 * rounding(route));
            }
            for it in &state(&outcome).contacts {
                assert!(it.y_t.abs() <= rounding(route) * P / K_T, "{route:?}: {it:?}");
            }
        }
        // Even shear and pressure, in which the sides of an elastic block turn.
        let outcome = solved(&sheared(Material::elastic(E, 0.0), share));
        for u in &displacements(&outcome, "0")[..3] {
            assert_close(u.x, share * MU * P / K_T, 1e-9);
        }
    }
    for share in [1.001, -1.001] {
        assert!(!stands(&sheared(Material::rigid(), share)));
    }
}

/// Whatever joints give way by, no forces balance loads beyond the cone, and that is proved.
#[test]
fn what_falls_falls_with_the_same_proof() {
    let outcome = solve(&sheared(Material::rigid(), 1.01)).unwrap();
    assert_eq!(outcome.judgement.verdict, Verdict::Falls);
    assert_eq!(outcome.judgement.evidence, Evidence::NoAdmissibleForces);
    let forces = solve(&sheared(Material::rigid(), 0.5).route(Route::Forces)).unwrap();
    assert_eq!(forces.solve.status, Status::Stalled, "forces do not tell displacements");
}

/// A pull that is less than the strength lifts a block by what its joint gives.
#[test]
fn a_joint_in_tension_is_a_spring_up_to_its_strength() {
    let (cohesion, tension) = (60.0, 50.0);
    let joint = soft().cohesion(cohesion).tension(tension);
    let pulled = |pull: f64| {
        let pull = Load::traction("pull", [0.0, H], [B, H], [0.0, pull]);
        pile(1, Material::rigid(), joint.clone()).load(pull)
    };
    let scene = pulled(0.9 * tension);
    for route in routes_for(&scene) {
        let Some(outcome) = answer_by(&scene, route) else { continue };
        for u in displacements(&outcome, "0") {
            assert_close(u.y, 0.9 * tension / K_N, 100.0 * rounding(route));
        }
        let it = &state(&outcome).contacts;
        assert!(it.iter().all(|it| it.status == PointStatus::Stick && it.t_n < 0.0));
    }
    assert!(!stands(&pulled(1.001 * tension)));
}

/// A block between two supports, of which one comes nearer: both joints take half of the way.
#[test]
fn a_wedged_block_is_pressed_by_what_supports_move() {
    let way = 1e-4;
    let scene = pile(1, Material::rigid(), soft())
        .support(Support::new("ceiling", [B, H], [0.0, H], "bed"))
        .stage(Stage::new("lift").moves("floor", Movement::by(0.0, way)));
    for route in routes_for(&scene) {
        let Some(outcome) = answer_by(&scene, route) else { continue };
        for u in displacements(&outcome, "0") {
            assert_close(u.y, 0.5 * way, 10.0 * rounding(route));
        }
        let ceiling = outcome.reactions.iter().find(|it| it.support == "ceiling").unwrap();
        assert_close(ceiling.fy / 1e3, -0.5 * way * K_N * B * T, 10.0 * rounding(route));
    }
}

/// What has not slid comes back, and all energy with it.
#[test]
fn a_joint_below_its_bound_springs_back() {
    let stage = |name: &str, push: f64| {
        let stage = Stage::new(name).steps(2).load("top", 1.0);
        stage.load("push", push).load("left", push).load("right", push)
    };
    let scene = sheared(Material::rigid(), 0.9);
    let back = scene.stage(stage("push", 1.0)).stage(stage("back", 0.0));
    let outcome = solved(&back);
    for u in displacements(&outcome, "0") {
        assert!(u.x.abs() <= 1e-10 * P / K_T && (u.y * K_N / P + 1.0).abs() < 1e-10, "{u}");
    }
    let dissipated = outcome.history.as_ref().unwrap().dissipation();
    assert_close(state(&outcome).strain_energy / 1e3, 0.5 * P * P / K_N * B * T, 1e-9);
    assert!(dissipated.abs() <= 1e-9 * state(&outcome).strain_energy, "{dissipated:e}");
}

/// Mortar of a thickness, and the faces that it touches: films have their stresses, and no unknown is new.
#[test]
fn mortar_and_the_stiffness_of_its_faces_are_in_series() {
    let (t, mortar) = (0.02, 8e5);
    for films in [Films::Compliance, Films::Strips] {
        let filled = |joint: Joint| {
            scene(Material::elastic(E, 0.0), joint.mortar(t, "mortar"))
                .material("mortar", Material::elastic(mortar, 0.0))
                .block(rectangle("0", "stone", [0.0, B], [t, t + H]).mesh([2, 2]))
                .load(Load::pressure("top", [0.0, t + H], [B, t + H], P))
                .contact_points(PointRule::Gauss)
                .films(films)
        };
        let (alone, both) = (filled(Joint::mu(MU)), filled(soft()));
        for route in routes_for(&both) {
            if route == Route::Alm && films == Films::Strips {
                let error = solve(&both.clone().route(route)).unwrap_err();
                assert!(error.is_refusal() && error.to_string().contains("stiffness"), "{error}");
                continue;
            }
            let [alone, both] = [&alone, &both].map(|scene| solved_by(scene, route));
            assert_eq!(alone.plan.order, both.plan.order);
            for u in &displacements(&both, "0")[6..] {
                let expected = -P * (t / mortar + 1.0 / K_N + H / E);
                assert_close(u.y, expected, rounding(route));
            }
            assert_eq!(state(&alone).films.len(), state(&both).films.len());
            for film in &state(&both).films {
                assert_close(film.sigma_y / 1e3, -P, 10.0 * rounding(route));
            }
        }
    }
}

/// Four courses of three bricks, pressed and pushed to the side.
fn wall(material: Material, joint: &Joint) -> Scene {
    let brick = Brick { length: 0.2, height: 0.1 };
    scene(material, joint.clone())
        .joint("head", joint.clone())
        .wall(Wall::running_bond("wall", "stone", brick, 0.6, 4).mesh([2, 1]))
        .load(Load::pressure("top", [0.0, 0.4], [0.6, 0.4], 100.0))
        .load(Load::traction("side", [0.0, 0.0], [0.0, 0.4], [30.0, 0.0]))
}

fn materials() -> [Material; 2] {
    [Material::rigid(), Material::elastic(E, 0.15)]
}

#[test]
fn all_routes_and_forms_have_the_same_answer() {
    for material in materials() {
        let scene = wall(material, &soft());
        let reference = solved(&scene);
        assert_eq!(reference.solve.route, Route::Interior, "{:?}", reference.solve.attempts);
        let forms = [Form::Coulomb, Form::StewartTrinkle, Form::Mixed];
        let by_pivots = forms.map(|form| scene.clone().form(form));
        let others = routes_for(&scene).into_iter().map(|route| scene.clone().route(route));
        for scene in by_pivots.into_iter().chain(others) {
            let route = match scene.solver.route {
                RouteSetting::Auto => Route::Lemke,
                RouteSetting::Only(route) => route,
            };
            let what = format!("{route:?} {:?}", scene.solver.form);
            let Some(other) = answer_by(&scene, route) else { continue };
            assert_eq!(other.solve.route, route);
            let moved = [&reference, &other].map(all_displacements);
            let apart = difference(&moved[0], &moved[1]);
            assert!(apart <= 1e-7, "{what}: {apart:e}");
            assert_close(state(&other).strain_energy, state(&reference).strain_energy, 1e-7);
        }
    }
}

/// With softer joints a wall moves more, and with ones that are stiffer and stiffer it comes near the one whose
/// joints do not give way, by the ratio.
#[test]
fn stiff_joints_come_near_rigid_ones() {
    let rigid = solved(&wall(Material::elastic(E, 0.15), &Joint::mu(MU)));
    let apart = [1e10, 1e11, 1e12, 1e13].map(|k| {
        let stiff =
            solved(&wall(Material::elastic(E, 0.15), &Joint::mu(MU).stiffness([k, 0.4 * k])));
        difference(&all_displacements(&rigid), &all_displacements(&stiff))
    });
    assert!(apart[0] < 0.1, "{apart:?}");
    for pair in apart.windows(2) {
        assert!((pair[0] / pair[1]).log10() > 0.9, "{apart:?}");
    }
}

/// Displacements in metres do not depend on the units of the scene.
#[test]
fn units_of_a_scene_do_not_matter() {
    let in_units = |length: LengthUnit, force: ForceUnit| -> Outcome {
        let units = Units { length, force };
        let (l, f) = (1.0 / units.length_to_si(), 1e3 / units.force_to_si());
        let (stress, stiffness) = (f / (l * l), f / (l * l * l));
        let joint = Joint::mu(MU).stiffness([K_N * stiffness, K_T * stiffness]);
        solved(
            &Scene::new("Units", units)
                .plane(Plane::Stress)
                .thickness(T * l)
                .material("stone", Material::elastic(E * stress, 0.2))
                .joint("bed", joint)
                .block(rectangle("0", "stone", [0.0, B * l], [0.0, H * l]).mesh([3, 2]))
                .support(Support::new("floor", [0.0, 0.0], [B * l, 0.0], "bed"))
                .load(Load::traction(
                    "top",
                    [0.0, H * l],
                    [B * l, H * l],
                    [30.0 * stress, -P * stress],
                )),
        )
    };
    let metres = in_units(LengthUnit::M, ForceUnit::Kn);
    for (length, force) in [(LengthUnit::Mm, ForceUnit::N), (LengthUnit::Km, ForceUnit::Mn)] {
        let other = in_units(length, force);
        let apart = difference(&all_displacements(&metres), &all_displacements(&other));
        assert!(apart < 1e-9, "{length:?} {force:?}: {apart:e}");
        assert_close(state(&other).strain_energy, state(&metres).strain_energy, 1e-9);
    }
    let law = metres.model.joint_classes[0].law;
    assert_eq!(law.stiffness.map(|k| k.map(f64::round)), Some([1e3 * K_N, 1e3 * K_T]));
}

/// Nothing that is told of films is told of joints without mortar.
#[test]
fn joints_without_mortar_have_no_films() {
    for material in materials() {
        let outcome = solved(&wall(material, &soft()));
        let model = &outcome.model;
        assert!(state(&outcome).films.is_empty());
        assert!(model.contacts.iter().all(|it| it.film.is_none() && it.gives()[0] > 0.0));
        assert!(model.joints.iter().all(|it| it.film.is_none()));
        let on = |name: &str| outcome.plan.effects.iter().find(|it| it.name == name).unwrap().on;
        assert!(on("joint stiffness") && !on("mortar films"));
        assert!(!csv::contacts(model, state(&outcome)).contains("film"));
        assert!(!table::report(&outcome).contains("film compression"));
        let json: serde_json::Value =
            serde_json::from_str(&json::result(&outcome, &[]).unwrap()).unwrap();
        assert!(json["films"].is_null(), "{}", json["films"]);
    }
}

/// A scene says so in its file, and is read as it was written.
#[test]
fn the_key_of_a_scene() {
    let scene = wall(Material::rigid(), &soft());
    let text = scene.to_toml().unwrap();
    assert!(text.contains("stiffness = ["), "{text}");
    let read = Scene::from_toml(&text).unwrap();
    assert_eq!(read.joints["bed"].stiffness, Some([K_N, K_T]));
    let model = Model::from_scene(&read).unwrap();
    for point in &model.contacts {
        for (k, stiffness) in [K_N, K_T].into_iter().enumerate() {
            assert_close(point.compliance[k], 1.0 / (1e3 * stiffness * point.weight), 1e-14);
        }
    }
}

/// How far joints give way before a structure fails does not matter to what forces can do; and joints that give way
/// by themselves get no springs.
#[test]
fn limits_do_not_depend_on_stiffness() {
    let limit_of = |joint: Joint| {
        let scene = sheared(Material::rigid(), 0.1).joint("bed", joint);
        let grows = ["push", "left", "right"].into_iter().fold(scene, |mut scene, name| {
            let load = scene.loads.iter_mut().find(|load| load.name == name).unwrap();
            load.group = Some("shear".to_owned());
            scene
        });
        limit::limit(&grows.limit_group("shear")).unwrap()
    };
    for joint in [Joint::mu(MU), soft()] {
        let is_soft = joint.stiffness.is_some();
        let found = limit_of(joint);
        let path = found.path.as_ref().unwrap();
        assert_close(path.load_factor.unwrap(), 10.0, 1e-4);
        assert_eq!(path.model.dry_joints(), usize::from(!is_soft));
    }
}
