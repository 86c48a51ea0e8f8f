//! What the bench `accuracy` measures beside a study: the last digits, soft springs, extrapolated errors.

#![allow(dead_code, reason = "modules of a bench, which uses all of them")]
#![allow(unreachable_pub, reason = "modules of a bench")]

#[path = "../../benches/accuracy/digits.rs"]
mod digits;
#[path = "../../benches/accuracy/extrapolated.rs"]
mod extrapolated;
#[path = "../../benches/accuracy/springs.rs"]
mod springs;

use std::ops::ControlFlow;
use std::time::Duration;

use lcp::refine::Refinement;
use masonry::analysis::study::{MeshErrors, Settings, Study, study};
use masonry::scene::Route;
use nalgebra::Vector2;

use crate::common::walls::leaning_wall;

fn studied() -> Study {
    let settings = Settings {
        routes: vec![Route::Interior],
        tolerances: vec![1e-8],
        meshes: vec![1, 2, 4],
        ..Settings::default()
    };
    study(&leaning_wall(), &settings, &mut |_| ControlFlow::Continue(())).unwrap()
}

#[test]
fn the_last_digits_come_with_refinement() {
    let references = digits::references(&leaning_wall(), &studied());
    assert_eq!(references.len(), 3);
    for exact in &references {
        let refinings = digits::refinings(exact.as_ref().unwrap());
        let kinds: Vec<Refinement> = refinings.iter().map(|it| it.refinement).collect();
        assert_eq!(kinds, [Refinement::Plain, Refinement::Single, Refinement::Extended]);
        let [plain, single, extended] = &refinings[..] else { panic!("three ways") };
        assert_eq!([plain.passes, single.passes], [1, 2]);
        assert!(extended.passes > 2);
        let [plain, single, extended] = [plain, single, extended].map(|it| it.error.unwrap());
        assert!(plain < 1e-3 && single < 1e-3 * plain, "{plain}, {single}");
        assert!(extended <= single && extended < 1e-14, "{single}, {extended}");
    }
}

#[test]
fn the_bias_of_springs_grows_with_their_stiffness_and_goes() {
    let references = digits::references(&leaning_wall(), &studied());
    let state = &references[0].as_ref().unwrap().state;
    let all = springs::springs(&leaning_wall(), Duration::from_secs(20), Some(state));
    let stiffnesses: Vec<f64> = all.iter().map(|it| it.stiffness).collect();
    assert!(stiffnesses.is_sorted() && stiffnesses.len() == 7);
    let bias: Vec<f64> = all.iter().map(|it| it.bias.unwrap()).collect();
    assert!(bias.is_sorted() && bias[0] > 0.0 && bias[6] > 100.0 * bias[0], "{bias:?}");
    for springs in &all {
        assert!(springs.end.is_solved() && springs.rounds.unwrap() > 0);
        let after = springs.errors.unwrap().worst().unwrap();
        assert!(after <= 1e3 * springs::TOLERANCE, "{}: {after}", springs.stiffness);
    }
}

#[test]
fn springs_stiffer_than_those_that_take_too_long_are_not_tried() {
    let all = springs::springs(&leaning_wall(), Duration::ZERO, None);
    assert_eq!(all[0].end.name(), "TimeLimit");
    for springs in &all[1..] {
        assert_eq!(springs.end.reason(), Some("the time ran out with springs of 1e-8"));
        assert!(springs.seconds.is_none() && springs.bias.is_none());
    }
}

/// The finest mesh has an error too.
#[test]
fn extrapolated_errors_are_larger() {
    let study = studied();
    let limits = extrapolated::errors(&study.meshes);
    let fine = study.meshes[1].errors.unwrap();
    for of in [|it: &MeshErrors| it.energy.unwrap(), |it: &MeshErrors| it.displacement.unwrap()] {
        let [first, second, last] = [&limits[0], &limits[1], &limits[2]].map(of);
        assert!(first > second && second > last && last > 0.0, "{limits:?}");
        assert!(second > of(&fine), "{limits:?}, {fine:?}");
    }
}

fn found(values: &[(u32, f64)]) -> Vec<Option<f64>> {
    let along = |(factor, value): &(u32, f64)| Some((*factor, *value * Vector2::new(3.0, -4.0)));
    extrapolated::relative(&values.iter().map(along).collect::<Vec<_>>())
}

#[test]
fn a_power_of_the_size_is_extrapolated_exactly() {
    for order in [0.75, 1.0, 2.0] {
        let at = |factor: u32| (factor, 3.0 - f64::from(factor).powf(-order));
        // In any order, and coarser ones do not count.
        let errors = found(&[at(4), (1, 100.0), at(2), at(8)]);
        for (factor, error) in [4, 1, 2, 8].into_iter().zip(errors) {
            let value = if factor == 1 { 100.0 } else { at(factor).1 };
            let expected = f64::abs(value - 3.0) / 3.0;
            assert!((error.unwrap() - expected).abs() < 1e-12 * expected.max(1.0), "{order}");
        }
    }
}

#[test]
fn what_does_not_converge_is_not_extrapolated() {
    for values in [
        [(1, 1.0), (2, 3.0), (4, 2.0)],
        [(1, 1.0), (2, 2.0), (4, 4.0)],
        [(1, 1.0), (2, 2.0), (4, 2.9)],
        [(1, 1.0), (2, 2.0), (4, 2.001)],
        [(1, 1.0), (2, 1.0), (4, 1.0)],
        [(1, 1.0), (2, 2.0), (3, 2.4)],
    ] {
        assert_eq!(found(&values), [None; 3], "{values:?}");
    }
    assert_eq!(found(&[(1, 1.0), (2, 2.0)]), [None; 2]);
}
