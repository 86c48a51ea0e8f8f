//! What a loading leads to, where forces that balance the loads exist but only a prestress would bring them about; and thrusts
//! that joints which slide leave no choice.

use crate::common;

use common::M_KN;
use masonry::analysis::limit;
use masonry::data::verdict::Verdict;
use masonry::model::Plane;
use masonry::scene::{Block, Joint, Load, Material, Movement, Scene, Stage, Support};
use masonry::solve;

const GRAVITY: f64 = 9.81;

fn scene(material: Material, joint: &Joint) -> Scene {
    Scene::new("Loaded from nothing", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .gravity([0.0, -GRAVITY])
        .material("stone", material.density(2000.0))
        .joint("joint", joint.clone())
        .joint("bed", joint.clone())
        .joint("head", joint.clone())
}

/// A bar between two posts, whose distance is larger at the top by twice the `lean`.
fn bar_between_posts(material: Material, joint: &Joint, lean: f64) -> Scene {
    bar_with_gaps(material, joint, lean, 0.0)
}

/// The same with a gap between the bar and each post.
fn bar_with_gaps(material: Material, joint: &Joint, lean: f64, gap: f64) -> Scene {
    let (half, height) = (0.9, 0.8);
    let top = half + lean;
    let [foot, head] = [half, top].map(|it| it - gap);
    let bar = [[-foot, 0.0], [foot, 0.0], [head, height], [-head, height]];
    let block = Block::new("bar", "stone", bar);
    let block = if material == Material::rigid() { block } else { block.mesh([6, 3]) };
    scene(material, joint)
        .gap_limit(2.0 * gap)
        .block(block)
        .support(Support::new("left", [-half, 0.0], [-top, height], "joint"))
        .support(Support::new("right", [top, height], [half, 0.0], "joint"))
}

fn verdict(scene: &Scene) -> Verdict {
    solve(scene).unwrap().judgement.verdict
}

/// Stiffness of joints over five decades, none, elastic bars, and friction up to 1.5.
fn variants() -> Vec<(Material, Joint)> {
    let rigid = Material::rigid();
    let stiff =
        [1e3, 1e4, 1e5, 1e6, 1e7, 1e8].map(|k| (rigid, Joint::mu(0.84).stiffness([k, 0.5 * k])));
    let elastic =
        [1e4, 1e5, 1e6, 1e7, 1e8].map(|young| (Material::elastic(young, 0.2), Joint::mu(0.84)));
    let mut all = [&stiff[..], &elastic].concat();
    all.extend([0.3, 0.84, 1.5].map(|mu| (rigid, Joint::mu(mu))));
    all
}

/// Friction would hold a bar that is pressed between two posts, and nothing presses it.
#[test]
fn a_bar_between_posts_falls() {
    for (material, joint) in variants() {
        for lean in [0.0, -0.005, -0.014, -0.1] {
            let scene = bar_between_posts(material, &joint, lean);
            assert_eq!(verdict(&scene), Verdict::Falls, "{material:?} {joint:?} {lean}");
        }
    }
}

/// Gaps that are far below what a mason can see change nothing.
#[test]
fn a_bar_with_gaps_falls_and_stands_as_without() {
    for (material, joint) in variants() {
        for gap in [1e-9, 1e-7, 1e-6] {
            for (lean, expected) in [(-0.005, Verdict::Falls), (0.2, Verdict::Stands)] {
                let scene = bar_with_gaps(material, &joint, lean, gap);
                assert_eq!(verdict(&scene), expected, "{material:?} {joint:?} {lean} {gap}");
            }
        }
    }
}

/// Its weight presses it between posts that are further apart at the top.
#[test]
fn a_bar_between_posts_that_lean_out_stands() {
    for (material, joint) in variants() {
        let scene = bar_between_posts(material, &joint, 0.2);
        assert_eq!(verdict(&scene), Verdict::Stands, "{material:?} {joint:?}");
    }
}

/// No load on such a bar leads to rest, however small.
#[test]
fn a_bar_that_falls_has_no_load_factor() {
    for lean in [-0.05, -0.2, -0.46] {
        for (material, joint) in variants() {
            let scene = bar_between_posts(material, &joint, lean).load(Load::force(
                "extra",
                "bar",
                [0.0, 0.2],
                [0.0, -1.0],
            ));
            let path = limit::limit(&scene).unwrap().path.unwrap();
            assert!(path.load_factor.is_none(), "{lean} {material:?}: {:?}", path.load_factor);
            assert!(path.falls.is_some_and(|factor| factor <= 0.0), "{lean} {material:?}");
        }
    }
}

/// Sixteen blocks on a stepped base of 30 degrees, 4 to 40 m high: R. E. Goodman and J. W. Bray, Toppling of rock slopes
/// (1976). They stand if the friction angle is 38.15 degrees or more.
fn toppling(degrees: f64, joint: impl Fn(Joint) -> Joint, material: Material) -> Scene {
    let slope = 30_f64.to_radians();
    let (along, up) = ([slope.cos(), slope.sin()], [-slope.sin(), slope.cos()]);
    let at = |origin: [f64; 2], a: f64, b: f64| {
        [origin[0] + a * along[0] + b * up[0], origin[1] + a * along[1] + b * up[1]]
    };
    let mut all = scene(material, &joint(Joint::mu(degrees.to_radians().tan())));
    let mut origin = [0.0, 0.0];
    for number in 1..=16_u32 {
        let n = f64::from(number);
        let height = if number <= 10 { 4.0 * n } else { 40.0 - 6.2 * (n - 10.0) };
        let name = number.to_string();
        let corners =
            [origin, at(origin, 10.0, 0.0), at(origin, 10.0, height), at(origin, 0.0, height)];
        let block = Block::new(&name, "stone", corners);
        let block = if material == Material::rigid() { block } else { block.mesh([1, 1]) };
        all = all.block(block).support(Support::new(
            &format!("base {name}"),
            origin,
            at(origin, 10.0, 0.0),
            "joint",
        ));
        origin = at(origin, 10.0, 1.0);
    }
    all
}

#[test]
fn a_slope_topples_below_its_published_friction() {
    let found = |degrees: f64, k: Option<f64>| {
        let stiff = |joint: Joint| match k {
            Some(k) => joint.stiffness([k, 0.5 * k]),
            None => joint,
        };
        verdict(&toppling(degrees, stiff, Material::rigid()))
    };
    for k in [None, Some(1e5), Some(1e6), Some(1e7), Some(1e8)] {
        for (degrees, expected) in [
            (36.0, Verdict::Falls),
            (37.0, Verdict::Falls),
            // Within 1.5 % of the published 38.15.
            (37.6, Verdict::Falls),
            (38.7, Verdict::Stands),
            (40.0, Verdict::Stands),
        ] {
            assert_eq!(found(degrees, k), expected, "{degrees} {k:?}");
        }
    }
    for young in [1e5, 1e6, 1e7, 1e8, 1e9] {
        for (degrees, expected) in
            [(36.0, Verdict::Falls), (37.6, Verdict::Falls), (40.0, Verdict::Stands)]
        {
            let elastic = toppling(degrees, |joint| joint, Material::elastic(young, 0.2));
            assert_eq!(verdict(&elastic), expected, "{degrees} {young}");
        }
    }
}

/// A wedge of soil on a plane, which a wall of stone holds and then pushes, or leaves: friction turns
/// at once, and the thrust is `W sin(a + p) / cos(a + p + d)`, or with the signs of both angles of friction changed (Coulomb
/// 1776).
#[test]
fn a_wedge_has_the_thrust_of_coulomb() {
    let (height, wall) = (3.0, 1.0);
    for (slope, plane, face) in [
        (30.0, 20.0, 0.0),
        (30.0, 20.0, 10.0),
        (30.0, 15.0, 15.0),
        (40.0, 20.0, 5.0),
        (40.0, 10.0, 10.0),
        (45.0, 15.0, 10.0),
        (50.0, 10.0, 10.0),
        (55.0, 15.0, 5.0),
        (60.0, 10.0, 5.0),
        (60.0, 5.0, 10.0),
    ] {
        let [a, p, d] = [slope, plane, face].map(|degrees: f64| degrees.to_radians());
        let length = height / a.tan();
        let weight = 0.5 * length * height * 2000.0 * GRAVITY;
        for (push, sign) in [(0.01, 1.0), (-0.01, -1.0)] {
            let expected = weight * (a + sign * p).sin() / (a + sign * (p + d)).cos();
            let scene = scene(Material::rigid(), &Joint::mu(d.tan()))
                .joint("plane", Joint::mu(p.tan()))
                .joint("smooth", Joint::mu(0.0))
                .block(Block::new("wedge", "stone", [[0.0, 0.0], [length, height], [0.0, height]]))
                .block(Block::new(
                    "wall",
                    "stone",
                    [[-wall, -0.5], [0.0, -0.5], [0.0, height], [-wall, height]],
                ))
                .support(Support::new("plane", [0.0, 0.0], [1.2 * length, 1.2 * height], "plane"))
                .support(Support::new("ground", [-wall, -0.5], [0.0, -0.5], "smooth"))
                .support(Support::new("stop", [-wall, -0.5], [-wall, height], "smooth"))
                .stage(Stage::new("weight"))
                .stage(Stage::new("move").steps(2).moves("stop", Movement::by(push, 0.0)));
            let outcome = solve(&scene).unwrap();
            assert_eq!(outcome.judgement.verdict, Verdict::Stands, "{slope} {plane} {face}");
            let stop = outcome.reactions.iter().find(|it| it.support == "stop").unwrap();
            // The formula is for the inclined force.
            let thrust = expected * d.cos();
            assert!(
                (stop.fx - thrust).abs() < 1e-6 * weight,
                "{slope} {plane} {face} {push}: {} instead of {thrust}",
                stop.fx
            );
            assert_eq!(outcome.history.unwrap().steps_against_law(), 0);
        }
    }
}
