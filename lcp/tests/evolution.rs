//! Motions against viscosity: closed forms of bodies on springs with friction.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use std::ops::ControlFlow;

use lcp::faer::Mat;
use lcp::{Contact2d, ContactPoint, Evolution, EvolutionSettings, Evolved, Status, Way};

const STIFFNESS: f64 = 4.0;
const WEIGHT: f64 = 2.0;
const MU: f64 = 0.5;

/// Blocks in a row on a plane, each pushed, and held by a spring of a stiffness.
fn pushed(pushes: &[f64], stiffness: f64) -> Contact2d {
    let n = 2 * pushes.len();
    let k = Mat::from_fn(n, n, |i, j| if i == j && i % 2 == 0 { stiffness } else { 0.0 });
    let loads = pushes.iter().flat_map(|push| [*push, -WEIGHT]).collect();
    let mut builder = Contact2d::builder(k, loads);
    for block in 0..pushes.len() {
        builder.add_point(ContactPoint {
            normal: &[(2 * block + 1, 1.0)],
            tangent: &[(2 * block, 1.0)],
            mu: MU,
            ..Default::default()
        });
    }
    builder.build().unwrap()
}

fn at_rest(problem: &Contact2d, from: &[f64]) -> Evolved {
    let end = Evolution::default().advance(problem, from).unwrap();
    assert!(end.rests(), "{:?} {:?}", end.solution.status, end.motions);
    // What is called solved holds for the slips that it says.
    let there = end.from.as_ref().map_or_else(|| problem.clone(), |u| problem.after(u).unwrap());
    let residuals = there.residuals(end.state());
    assert!(residuals.worst() <= 1e-10, "{residuals:?}");
    end
}

/// Pushed up to a force a block slides to `(P - mu N) / k`; on the way back it stays there until the force has fallen by
/// `2 mu N`, and then follows at `(P + mu N) / k` (Jenkins' element).
#[test]
fn a_block_on_a_spring_remembers_its_way() {
    let most = MU * WEIGHT;
    let mut u = vec![0.0; 2];
    for (push, expected) in [
        (0.9, 0.0),
        (3.0, 2.0),
        (5.0, 4.0),
        (3.1, 4.0),
        (2.0, 3.0),
        (-1.0, 0.0),
        (0.5, 0.0),
        (1.5, 0.5),
    ] {
        let end = at_rest(&pushed(&[push], STIFFNESS).after(&u).unwrap(), &u);
        u.clone_from(&end.state().u);
        let place = expected / STIFFNESS;
        assert!((u[0] - place).abs() < 1e-5, "{push}: {} instead of {place}", u[0]);
        let balance = push + end.state().t_t[0] - STIFFNESS * u[0];
        assert!(balance.abs() < 1e-9 && end.state().t_t[0].abs() <= most * (1.0 + 1e-9));
    }
}

/// Without a spring nothing holds a block that is pushed beyond friction.
#[test]
fn a_block_that_nothing_holds_flows() {
    let problem = pushed(&[1.5, 0.5], 0.0);
    let end = Evolution::default().advance(&problem, &[0.0; 4]).unwrap();
    assert_eq!(end.solution.status, Status::NoEquilibrium, "{:?}", end.motions);
    let motion = &end.solution.springs().unwrap().motion;
    // The other block is at rest but for the slip over which friction turns.
    assert!(motion[0] > 0.0 && motion[2].abs() <= 1e-3 * motion[0], "{motion:?}");
    // What friction leaves of the push, of all loads.
    let share = (1.5 - MU * WEIGHT) / (1.5 + 0.5 + 2.0 * WEIGHT);
    let last = *end.motions.shares.last().unwrap();
    assert!((last / share - 1.0).abs() < 1e-2, "{last} instead of {share}");
}

/// The floor is moved to the side: it takes along what rests on it as far as friction can stretch the spring.
#[test]
fn a_floor_that_moves_takes_along_what_rests_on_it() {
    let shift = 10.0;
    let mut builder = Contact2d::builder([[STIFFNESS, 0.0], [0.0, 0.0]], vec![0.0, -WEIGHT]);
    builder.add_point(ContactPoint {
        normal: &[(1, 1.0)],
        tangent: &[(0, 1.0)],
        slip: -shift,
        mu: MU,
        ..Default::default()
    });
    let end = at_rest(&builder.build().unwrap(), &[0.0; 2]);
    // The viscosity of the first motion holds back the last ten-thousandth.
    assert!((end.state().u[0] - MU * WEIGHT / STIFFNESS).abs() < 1e-4, "{:?}", end.state());
}

/// A block on a spring under a push beyond friction slides by `(P - mu N) / k`, which the law with less friction leads to. A
/// push that only the friction given holds leaves it where it is.
#[test]
fn reduced_friction_leads_to_the_law_with_the_friction_given() {
    let reduced = EvolutionSettings { reductions: vec![0.1], ..EvolutionSettings::default() };
    for (push, slid) in [(3.0, 2.0), (1.4, 0.4), (-2.0, -1.0), (0.95 * MU * WEIGHT, 0.0)] {
        let problem = pushed(&[push], STIFFNESS);
        let end = Evolution::new(reduced.clone()).advance(&problem, &[0.0; 2]).unwrap();
        assert_eq!((end.way, end.solution.status), (Way::Law, Status::Solved));
        let place = end.state().u[0];
        assert!((place - slid / STIFFNESS).abs() < 1e-12, "{push}: {place}");
    }
}

/// Flowing blocks take smooth and reduced friction, and motions; wherever the observer stops that, it is not asked again.
#[test]
fn who_is_stopped_once_does_not_go_on() {
    let problem = pushed(&[1.4, 0.3], 0.0);
    let reductions = vec![1e-3];
    let evolution = Evolution::new(EvolutionSettings { reductions, ..Default::default() });
    let mut calls = 0;
    let whole = evolution.advance_observed(&problem, &[0.0; 4], &mut |_| {
        calls += 1;
        ControlFlow::Continue(())
    });
    assert_eq!(whole.unwrap().solution.status, Status::NoEquilibrium);
    assert!(calls > 50, "{calls}");
    for last in 1..=calls {
        let mut asked = 0;
        let stopped = evolution.advance_observed(&problem, &[0.0; 4], &mut |_| {
            asked += 1;
            if asked == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!((stopped.unwrap().solution.status, asked), (Status::Cancelled, last));
    }
}

#[test]
fn limits_and_wrong_starts_are_told() {
    let problem = pushed(&[1.4], STIFFNESS);
    assert!(Evolution::default().advance(&problem, &[0.0]).is_err());
    assert!(Evolution::default().advance(&problem, &[f64::NAN, 0.0]).is_err());
    for slip in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let wrong = EvolutionSettings { slips: vec![1e-3, slip], ..EvolutionSettings::default() };
        let error = Evolution::new(wrong).advance(&problem, &[0.0; 2]).unwrap_err();
        assert!(matches!(error, lcp::Error::Setting { name: "slips", .. }), "{error}");
    }
    for part in [0.0, 1.0, -0.5, f64::NAN] {
        let wrong = EvolutionSettings { reductions: vec![part], ..EvolutionSettings::default() };
        let error = Evolution::new(wrong).advance(&problem, &[0.0; 2]).unwrap_err();
        assert!(matches!(error, lcp::Error::Setting { name: "reductions", .. }), "{error}");
    }
    let few = EvolutionSettings { max_iterations: 2, ..EvolutionSettings::default() };
    let end = Evolution::new(few).advance(&problem, &[0.0; 2]).unwrap();
    assert_eq!(end.solution.status, Status::IterationLimit);
    let stopped = Evolution::default()
        .advance_observed(&problem, &[0.0; 2], &mut |_| ControlFlow::Break(()))
        .unwrap();
    assert_eq!(stopped.solution.status, Status::Cancelled);
}
