//! The pointwise law of films, and the part in contact with its printed updating.

use crate::common::updating::{Settling, UpdateHistory, Updating};
use masonry::data::state::PointStatus;
use masonry::model::{Elasticity, Plane};
use masonry::paper::film::law::{FilmLaw, FilmState};
use masonry::paper::film::pointwise::PointwiseFilm;
use masonry::paper::film::strip::Strip;
use masonry::paper::film::{FilmError, FilmMaterial, Vector8};
use nalgebra::{Matrix2, Point2, SMatrix, Vector2, Vector3};
use proptest::prelude::*;

const MORTAR: FilmMaterial =
    FilmMaterial { elasticity: Elasticity { young: 2.4, poisson: 0.2 }, plane: Plane::Stress };
/// Shear modulus of [`MORTAR`].
const G: f64 = 1.0;

#[test]
fn wrong_data_are_refused() {
    let strip = |l, t, w| Strip::new(l, t, w, &MORTAR).map(|_| ());
    assert!(matches!(strip(0.0, 1.0, 1.0), Err(FilmError::NotPositive { quantity: "length", .. })));
    assert!(matches!(strip(1.0, -1.0, 1.0), Err(FilmError::NotPositive { .. })));
    assert!(matches!(strip(1.0, 1.0, f64::NAN), Err(FilmError::NotPositive { .. })));
    for (young, poisson) in [(0.0, 0.2), (1.0, 0.5), (1.0, -1.0), (f64::NAN, 0.2)] {
        let mortar = FilmMaterial { elasticity: Elasticity { young, poisson }, ..MORTAR };
        assert!(matches!(Strip::new(1.0, 1.0, 1.0, &mortar), Err(FilmError::NotElastic { .. })));
    }
    for mu in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(FilmLaw::new(&MORTAR, 0.1, mu), Err(FilmError::Friction { .. })));
    }
    let strip = Strip::new(1.0, 0.1, 1.0, &MORTAR).unwrap();
    assert_eq!(PointwiseFilm::new(strip, 0.5, 0), Err(FilmError::NoParts));
}

#[test]
fn an_open_film_is_a_bar_along_the_joint() {
    for (plane, modulus) in [(Plane::Stress, 2.4), (Plane::Strain, 2.4 / 0.96)] {
        let law = FilmLaw::new(&FilmMaterial { plane, ..MORTAR }, 0.1, 0.5).unwrap();
        let open = law.respond(Vector3::new(1e-3, 1.0, 0.7), FilmState::default());
        assert_eq!(open.contact, PointStatus::Open);
        assert!((open.stress - Vector3::new(modulus * 1e-3, 0.0, 0.0)).amax() < 1e-15);
        // The upper face is above where the mortar, free to contract, would be; it has slid with the face.
        let contraction = -1e-3 * if plane == Plane::Stress { 0.2 } else { 0.25 };
        assert!((open.opening - 0.1 * (1.0 - contraction)).abs() < 1e-15);
        assert!((open.state.slip - 0.07).abs() < 1e-15);
    }
}

/// Closing again, the film sticks where it lands.
#[test]
fn a_film_that_opened_and_moved_closes_without_shear() {
    let law = FilmLaw::new(&MORTAR, 0.1, 0.5).unwrap();
    let open = law.respond(Vector3::new(0.0, 0.2, 0.3), FilmState::default());
    let closed = law.respond(Vector3::new(0.0, -0.2, 0.3), open.state);
    assert_eq!(closed.contact, PointStatus::Stick);
    assert!(closed.stress.z.abs() < 1e-15 && closed.stress.y < 0.0);
}

#[test]
fn without_friction_the_film_always_slides() {
    let law = FilmLaw::new(&MORTAR, 0.1, 0.0).unwrap();
    for gamma in [-0.3, 0.0, 0.3] {
        let answer = law.respond(Vector3::new(0.0, -0.2, gamma), FilmState::default());
        assert_eq!(answer.contact, PointStatus::Slip);
        assert!(answer.stress.z.abs() < 1e-15 && answer.dissipation.abs() < 1e-15);
        assert!(answer.tangent.row(2).amax() < 1e-15);
        assert!((answer.state.slip - 0.1 * gamma).abs() < 1e-15);
    }
}

/// The loop of a spring with friction: `4 tau_max (d - tau_max t_y / G)` per area and cycle.
#[test]
fn sliding_to_and_fro_dissipates_the_area_of_the_loop() {
    let (thickness, mu, d) = (0.1, 0.5, 0.02);
    let law = FilmLaw::new(&MORTAR, thickness, mu).unwrap();
    // Displacement d of the upper face to and fro, in steps, under constant pressure.
    let most = |state: &mut FilmState, targets: [f64; 2]| -> f64 {
        let steps = 7;
        (1..=steps)
            .map(|k| {
                let way = f64::from(k) / f64::from(steps);
                let u = targets[0] + (targets[1] - targets[0]) * way;
                let answer = law.respond(Vector3::new(0.0, -0.1, u / thickness), *state);
                *state = answer.state;
                answer.dissipation
            })
            .sum()
    };
    let mut state = FilmState::default();
    most(&mut state, [0.0, d]);
    let cycle = most(&mut state, [d, -d]) + most(&mut state, [-d, d]);
    let bound = mu * 0.1 * law.respond(Vector3::new(0.0, -1.0, 0.0), state).tangent[(1, 1)];
    let area = 4.0 * bound * (d - bound * thickness / G);
    assert!(area > 0.0 && (cycle - area).abs() < 1e-14, "{cycle} against {area}");
}

fn strain() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.0..1.0_f64).prop_map(Vector3::from)
}

proptest! {
    #[test]
    fn stress_lies_in_the_cone_and_dissipates(
        strain in strain(), slip in -0.1..0.1_f64, mu in 0.0..1.5_f64,
    ) {
        let law = FilmLaw::new(&MORTAR, 0.1, mu).unwrap();
        let before = FilmState { slip };
        let answer = law.respond(strain, before);
        prop_assert!(answer.stress.y <= 0.0);
        prop_assert!(answer.stress.z.abs() <= -mu * answer.stress.y * (1.0 + 1e-15));
        prop_assert!(answer.dissipation >= 0.0 && answer.opening >= 0.0);
        // Mortar and interface together make the movement of the faces.
        let shear = 0.1 * answer.stress.z / G + answer.state.slip;
        prop_assert!((shear - 0.1 * strain.z).abs() < 1e-14);
        // Friction opposes sliding.
        prop_assert!(answer.stress.z * (answer.state.slip - slip) >= 0.0);
        // What was reached stays when nothing moves.
        let again = law.respond(strain, answer.state);
        prop_assert!((again.stress - answer.stress).amax() < 1e-14);
        prop_assert!((again.state.slip - answer.state.slip).abs() < 1e-15);
        prop_assert!(again.dissipation.abs() < 1e-15);
    }

    #[test]
    fn stress_is_continuous(
        from in strain(), to in strain(), slip in -0.1..0.1_f64, mu in 0.0..1.5_f64,
    ) {
        let law = FilmLaw::new(&MORTAR, 0.1, mu).unwrap();
        let before = FilmState { slip };
        let steps = 1000;
        let path: Vec<Vector3<f64>> = (0..=steps)
            .map(|k| law.respond(from.lerp(&to, f64::from(k) / f64::from(steps)), before).stress)
            .collect();
        // No entry of a tangent exceeds (1 + mu) 2.5.
        let largest = 3.0 * (1.0 + mu) * 2.5 * (to - from).amax() / f64::from(steps);
        prop_assert!(path.windows(2).all(|w| (w[1] - w[0]).amax() <= largest));
    }

    /// Between changes of state the law is linear, so the tangent is exact for any step.
    #[test]
    fn the_tangent_is_consistent(
        u in prop::array::uniform8(-1.0..1.0_f64), step in prop::array::uniform8(-1e-2..1e-2_f64),
        slips in prop::array::uniform6(-0.1..0.1_f64), mu in 0.0..1.5_f64,
    ) {
        let strip = Strip::new(1.0, 0.1, 0.7, &MORTAR).unwrap();
        let film = PointwiseFilm::new(strip, mu, 3).unwrap();
        let before = slips.map(|slip| FilmState { slip });
        let (u, step) = (Vector8::from(u), Vector8::from(step));
        let here = film.respond(&u, &before);
        let there = film.respond(&(u + step), &before);
        let same = here.points.iter().zip(&there.points).all(|(a, b)| {
            a.contact == b.contact && a.stress.z * b.stress.z >= 0.0
        });
        prop_assume!(same);
        let tangent = film.tangent(here.points.iter().map(|point| point.tangent));
        let change = tangent * step;
        prop_assert!((there.force - here.force - change).amax() < 1e-11 * tangent.amax());
        prop_assert!(here.dissipation >= 0.0);
    }

    /// The ends of the part in contact separate points that press from open ones.
    #[test]
    fn the_part_in_contact_is_where_points_press(u in prop::array::uniform8(-1.0..1.0_f64)) {
        let strip = Strip::new(1.0, 0.1, 1.0, &MORTAR).unwrap();
        let film = PointwiseFilm::new(strip, 0.5, 20).unwrap();
        let u = Vector8::from(u);
        let answer = film.respond(&u, &film.initial());
        let part = Updating::Pointwise.contact_part(film.strip(), &u).unwrap_or([2.0, 2.0]);
        for (x, point) in film.places().zip(&answer.points) {
            let inside = part[0] <= x && x <= part[1];
            prop_assert_eq!(inside, point.contact != PointStatus::Open);
        }
    }

    /// A bonded film under pressure that does not reach the cone is the strip.
    #[test]
    fn a_film_that_sticks_is_the_strip(
        u in prop::array::uniform8(-1.0..1.0_f64), parts in 1..5_usize,
    ) {
        let strip = Strip::new(1.0, 0.1, 1.0, &MORTAR).unwrap();
        let press = Vector8::from([0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, -1.0]) * 10.0;
        let u = Vector8::from(u) + press;
        let k = strip.stiffness(strip.ends());
        let film = PointwiseFilm::new(strip, 1.0, parts).unwrap();
        let answer = film.respond(&u, &film.initial());
        prop_assert!(answer.points.iter().all(|p| p.contact == PointStatus::Stick));
        let tangent = film.tangent(answer.points.iter().map(|point| point.tangent));
        prop_assert!((tangent - k).amax() < 1e-13 * k.amax());
        prop_assert!((answer.force - k * u).amax() < 1e-13 * (k * u).amax());
    }

    /// Rigid motions carry no stress with the faces at their real distance.
    #[test]
    fn rigid_motions_are_free_of_stress(motion in prop::array::uniform3(-1.0..1.0_f64)) {
        let strip = Strip::new(1.0, 0.1, 1.0, &MORTAR).unwrap();
        let nodes = [[-0.5, -0.05], [0.5, -0.05], [-0.5, 0.05], [0.5, 0.05]].map(Point2::from);
        let u = Vector8::from_fn(|i, _| {
            let p = nodes[i / 2];
            let [a, b, turn] = motion;
            if i % 2 == 0 { a - turn * p.y } else { b + turn * p.x }
        });
        prop_assert!(strip.stress(0.3, &u).amax() < 1e-13);
        prop_assert!((strip.stiffness([-0.4, 0.2]) * u).amax() < 1e-13);
    }
}

// A block on a guide: it moves without turning on springs that couple its two directions, over a film.

/// Displacements of the film's nodes by those of the block above, the lower face being fixed.
fn guided() -> SMatrix<f64, 8, 2> {
    SMatrix::from_fn(|i, j| f64::from(u8::from(i >= 4 && i % 2 == j)))
}

struct Guided {
    strip: Strip,
    springs: Matrix2<f64>,
    load: Vector2<f64>,
}

impl Guided {
    /// Pulled up a little and along the film much, while the guide pushes a block that moves along down.
    fn new() -> Self {
        let strip = Strip::new(1.0, 0.1, 0.1, &MORTAR).unwrap();
        Self {
            strip,
            springs: Matrix2::new(1.0, 0.9, 0.9, 1.0) * 0.1,
            load: Vector2::new(1.0, 0.3),
        }
    }
}

#[test]
fn the_printed_updating_cycles_with_period_two() {
    let Guided { strip, springs, load } = Guided::new();
    let p = guided();
    let mut history = UpdateHistory::new(vec![strip.length()], 1e-9);
    let mut part = Some(strip.ends());
    let mut seen = vec![history.record(&[part])];
    for _ in 0..3 {
        let film = part.map_or_else(SMatrix::zeros, |part| strip.stiffness(part));
        let block = (p.transpose() * film * p + springs).lu().solve(&load).unwrap();
        part = Updating::Printed.contact_part(&strip, &(p * block));
        seen.push(history.record(&[part]));
    }
    let cycle = Settling::Cycle { period: 2 };
    assert_eq!(seen, [Settling::Moving, Settling::Moving, cycle, cycle]);
}

/// Newton's method, its steps halved until less is unbalanced. Full steps would go from stick to open and
/// back here, for the law as well.
#[test]
fn the_law_settles_where_the_printed_updating_cycles() {
    let Guided { strip, springs, load } = Guided::new();
    let p = guided();
    let film = PointwiseFilm::new(strip, 0.6, 2).unwrap();
    let states = film.initial();
    let unbalanced = |block: &Vector2<f64>| {
        let answer = film.respond(&(p * block), &states);
        (load - springs * block - p.transpose() * answer.force, answer)
    };
    let in_contact =
        |block: &Vector2<f64>| [Updating::Pointwise.contact_part(film.strip(), &(p * block))];
    let mut history = UpdateHistory::new(vec![film.strip().length()], 1e-9);
    let mut block = Vector2::zeros();
    for _ in 0..6 {
        let (rest, answer) = unbalanced(&block);
        history.record(&in_contact(&block));
        let tangent = film.tangent(answer.points.iter().map(|point| point.tangent));
        let tangent = p.transpose() * tangent * p + springs;
        let step = tangent.lu().solve(&rest).unwrap();
        let less = |k: &i32| unbalanced(&(block + step * 0.5_f64.powi(*k))).0.norm() < rest.norm();
        block += (0..30).find(less).map_or_else(Vector2::zeros, |k| step * 0.5_f64.powi(k));
    }
    let (rest, answer) = unbalanced(&block);
    assert!(rest.amax() < 1e-14, "{rest}");
    assert!(answer.points.iter().all(|point| point.contact == PointStatus::Slip));
    assert_eq!(history.record(&in_contact(&block)), Settling::Settled);
    assert!(answer.dissipation > 0.0);
}

#[test]
fn printed_and_pointwise_parts_differ_by_the_lateral_strain() {
    // Stretched along the joint and not across it: the mortar wants to contract, and parts.
    let strip = Strip::new(1.0, 0.1, 0.1, &MORTAR).unwrap();
    let u = Vector8::from([0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.1, 0.0]);
    assert_eq!(Updating::Printed.contact_part(&strip, &u), Some([-0.5, 0.5]));
    assert_eq!(Updating::Pointwise.contact_part(&strip, &u), None);
}

#[test]
fn longer_cycles_settling_and_slow_motion_are_told_apart() {
    let part = |x: f64| [Some([-0.5, x]), None];
    let record = |ends: &[f64]| {
        let mut history = UpdateHistory::new(vec![1.0, 1.0], 1e-6);
        ends.iter().map(|x| history.record(&part(*x))).last().unwrap()
    };
    assert_eq!(record(&[0.1, 0.2, 0.3, 0.1]), Settling::Cycle { period: 3 });
    assert_eq!(record(&[0.1, 0.2, 0.2]), Settling::Settled);
    assert_eq!(record(&[0.1, 0.2, 0.15, 0.175]), Settling::Moving);
    // Ten updates ago is longer than what is kept.
    assert_eq!(
        record(&[0.0, 0.1, 0.2, 0.3, 0.4, 0.11, 0.21, 0.31, 0.41, 0.5, 0.0]),
        Settling::Moving
    );
}
