//! A rigid block on an elastic bed without tension, of mortar or of a joint with a stiffness, loaded off its middle: `p = N
//! / b (1 +- 6 e / b)` up to
//! `e = b / 6`; beyond, a contact of the length `a = 3 (b / 2 - e)` with `p_max = 2 N / a` at its edge.

use crate::common;

use common::routes::{answer_by, routes_for, solved_by, stands_by};
use common::{M_KN, displacements, rectangle, state};
use masonry::analysis::outcome::Outcome;
use masonry::model::Plane;
use masonry::model::joints::PointRule;
use masonry::scene::{Block, Joint, Load, Material, Route, Scene, Support};

/// Width of the block \[m\].
const B: f64 = 0.6;
/// Thickness of a bed of mortar \[m\].
const T: f64 = 0.02;
/// Young's modulus of it \[kN/m2\].
const MORTAR: f64 = 8e5;
/// Stiffness of a bed \[kN/m3\].
const STIFFNESS: f64 = MORTAR / T;
/// The load \[kN\].
const N: f64 = 90.0;
const FOOT: f64 = 0.1;

/// What gives way below the block.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Bed {
    Mortar,
    Stiffness,
}

const BEDS: [Bed; 2] = [Bed::Mortar, Bed::Stiffness];

/// The block on a bed that is cut into `count` equal parts, each with two points: below lie as many rigid
/// stones. The load is spread over a third of the width and has the eccentricity `e`. The top of the block
/// juts out to the right, so that the load can stand beyond its foot.
fn on_bed((bed, points): (Bed, PointRule), count: u32, e: f64) -> Scene {
    let (thickness, joint) = match bed {
        Bed::Mortar => (T, Joint::mu(0.5).mortar(T, "mortar")),
        Bed::Stiffness => (0.0, Joint::mu(0.5).stiffness([STIFFNESS, 0.4 * STIFFNESS])),
    };
    let (low, high) = (FOOT + thickness, FOOT + thickness + 0.5);
    let centre = 0.5 * B + e;
    let scene = Scene::new("Kern", M_KN)
        .plane(Plane::Stress)
        .thickness(1.0)
        .material("stone", Material::rigid())
        .material("mortar", Material::elastic(MORTAR, 0.0))
        .joint("bed", joint)
        .joint("head", Joint::mu(0.0))
        .joint("floor", Joint::mu(0.5))
        .block(Block::new("block", "stone", [[0.0, low], [B, low], [1.2 * B, high], [0.0, high]]))
        .support(Support::new("floor", [0.0, 0.0], [B, 0.0], "floor"))
        .load(Load::pressure(
            "top",
            [centre - B / 6.0, high],
            [centre + B / 6.0, high],
            3.0 * N / B,
        ))
        .contact_points(points);
    (0..count).map(f64::from).fold(scene, |scene, k| {
        let x = [k, k + 1.0].map(|k| B * k / f64::from(count));
        scene.block(rectangle(&format!("stone {k}"), "stone", x, [0.0, FOOT]))
    })
}

/// The pressures \[kN/m2\] at the lower corners of the block, by the compression of the bed; negative where
/// it gapes.
fn edges(outcome: &Outcome) -> [f64; 2] {
    let moved = displacements(outcome, "block");
    [0, 1].map(|corner: usize| -moved[corner].y * STIFFNESS)
}

/// Length of the contact and largest pressure, from the plane that the foot of the block stays.
fn contact(outcome: &Outcome) -> [f64; 2] {
    let [left, right] = edges(outcome);
    assert!(left < 0.0 && right > 0.0, "{left} and {right} kN/m2");
    [B * right / (right - left), right]
}

/// Errors, with parts of thirds of the size, fall as the square of it.
fn assert_second_order(errors: &[f64]) {
    for pair in errors.windows(2) {
        let rate = (pair[0] / pair[1]).ln() / 3_f64.ln();
        assert!((rate - 2.0).abs() < 0.1, "rate {rate} of {errors:?}");
    }
}

fn error(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

/// Two Gauss points integrate a pressure that falls in a line exactly, points at the ends with an error of
/// second order.
#[test]
fn within_the_kern_all_of_the_bed_is_pressed() {
    let eccentricities = [0.0, B / 12.0, -B / 8.0];
    for (bed, e) in BEDS.into_iter().flat_map(|bed| eccentricities.map(|e| (bed, e))) {
        let expected = [-1.0, 1.0].map(|side| N / B * (1.0 + side * 6.0 * e / B));
        let gauss = on_bed((bed, PointRule::Gauss), 3, e);
        for route in routes_for(&gauss) {
            let Some(outcome) = answer_by(&gauss, route) else { continue };
            for (found, expected) in edges(&outcome).into_iter().zip(expected) {
                assert!(error(found, expected) < 1e-9, "{bed:?} {route:?}: {found} of {expected}");
            }
        }
    }
    for bed in BEDS {
        let largest = |count| {
            let scene = on_bed((bed, PointRule::Vertices), count, B / 12.0);
            error(edges(&solved_by(&scene, Route::Interior))[1], N / B * 1.5)
        };
        assert_second_order(&[7, 21, 63].map(largest));
    }
}

/// The contact ends in the middle of a part, where the points see no end: second order for both rules.
#[test]
fn beyond_the_kern_a_part_of_the_bed_is_pressed() {
    let e = B / 3.0;
    let (length, pressure) = (3.0 * (0.5 * B - e), 4.0 * N / B);
    let rules = [PointRule::Gauss, PointRule::Vertices];
    for both in BEDS.into_iter().flat_map(|bed| rules.map(|points| (bed, points))) {
        let errors = |count| {
            let scene = on_bed(both, count, e);
            let outcome = solved_by(&scene, Route::Interior);
            let [found_length, found_pressure] = contact(&outcome);
            [error(found_length, length), error(found_pressure, pressure)]
        };
        let errors = [7, 21, 63].map(errors);
        assert!(errors[2].iter().all(|error| *error < 2e-3), "{both:?}: {errors:?}");
        for k in [0, 1] {
            assert_second_order(&errors.map(|errors| errors[k]));
        }
    }
    // Other routes on the same parts have the same answer.
    let scenes = BEDS.map(|bed| on_bed((bed, PointRule::Gauss), 9, e));
    let reference = contact(&solved_by(&scenes[0], Route::Lemke));
    let each =
        scenes.iter().flat_map(|scene| routes_for(scene).into_iter().map(move |it| (scene, it)));
    for (scene, route) in each {
        let Some(outcome) = answer_by(scene, route) else { continue };
        for (found, expected) in contact(&outcome).into_iter().zip(reference) {
            assert!(error(found, expected) < 1e-8, "{route:?}: {found} of {expected}");
        }
        let bed = outcome.model.contacts.iter().zip(&state(&outcome).contacts);
        for (point, it) in bed.filter(|(point, _)| point.gives()[0] > 0.0) {
            let is_beyond = point.position.x < B - length;
            assert_eq!(it.t_n.abs() < 1e-9 * 1e3 * N, is_beyond, "{}", point.position.x);
        }
    }
}

/// The nearer the load comes to the edge, the shorter the contact; beyond the edge nothing holds it.
#[test]
fn at_the_edge_the_block_overturns() {
    let fallen = BEDS.map(|bed| (bed, on_bed((bed, PointRule::Gauss), 9, 0.505 * B)));
    let each = fallen
        .iter()
        .flat_map(|(bed, it)| routes_for(it).into_iter().map(move |route| (*bed, it, route)));
    for (bed, fallen, route) in each {
        // Sweeps take seconds, and are left to the long tests.
        let is_tried = route != Route::Pgs || cfg!(feature = "long-tests");
        for share in [0.40, 0.45].into_iter().filter(|_| is_tried) {
            let scene = on_bed((bed, PointRule::Gauss), 45, share * B);
            let Some(outcome) = answer_by(&scene, route) else { continue };
            let [length, pressure] = contact(&outcome);
            let expected = 3.0 * (0.5 - share) * B;
            assert!(error(length, expected) < 0.01, "{route:?}: {length} m of {expected} m");
            assert!(error(pressure, 2.0 * N / expected) < 0.01, "{route:?}: {pressure} kN/m2");
        }
        assert!(!stands_by(fallen, route), "{bed:?} {route:?}");
    }
}
