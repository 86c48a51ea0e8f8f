//! Bodies with mass: closed forms of sliding, falling, rocking and settling, and their energies.

use std::ops::ControlFlow;

use lcp::{Account, Contact2d, ContactPoint, Ending, Error, Evolution, EvolutionSettings, Status};

const MASS: f64 = 2.0;
const GRAVITY: f64 = 10.0;
const WEIGHT: f64 = MASS * GRAVITY;
const MU: f64 = 0.25;

/// A block at a height above a plane, pushed along it, with a spring behind it; supports have moved the plane by `shift`.
fn block(push: f64, spring: f64, height: f64, shift: f64) -> Contact2d {
    let mut builder = Contact2d::builder([[spring, 0.0], [0.0, 0.0]], vec![push, -WEIGHT]);
    builder.add_point(ContactPoint {
        normal: &[(1, 1.0)],
        tangent: &[(0, 1.0)],
        gap: height,
        slip: -shift,
        mu: MU,
        ..Default::default()
    });
    builder.build().unwrap()
}

const MASSES: [[f64; 2]; 2] = [[MASS, 0.0], [0.0, MASS]];

fn with_inertia() -> EvolutionSettings {
    EvolutionSettings { inertia: true, drag: 0.0, ..Default::default() }
}

/// The account of all steps is balanced, and friction has obeyed its law.
fn assert_balanced(account: &Account) {
    let Account { work, stored, kinetic, dissipation, capacity, dragged, lost, created, .. } =
        *account;
    let terms = [work, stored, kinetic, dissipation, dragged, lost];
    let size: f64 = terms.iter().map(|it| it.abs()).sum();
    let rest = work - stored - kinetic - dissipation - dragged - lost;
    assert!(rest.abs() <= 1e-10 * size, "{account:?}");
    assert!(created <= 1e-10 * size && lost >= -1e-10 * size, "{account:?}");
    assert!((dissipation - capacity).abs() <= 1e-10 * size, "{account:?}");
}

/// A block with the velocity `v` stops after `v^2 / (2 mu g)`. Implicit steps stop it after a multiple of `h`, at most
/// `v h` too early.
#[test]
fn a_block_slides_until_friction_has_taken_its_energy() {
    let speed = 1.0;
    let way = speed * speed / (2.0 * MU * GRAVITY);
    for h in [0.02, 0.01, 0.005] {
        let problem = block(0.0, 0.0, 0.0, 0.0);
        let moving = Evolution::new(&problem, MASSES, with_inertia()).unwrap();
        let mut moving = moving.moving(vec![speed, 0.0]).unwrap();
        for _ in 0..100 {
            assert_eq!(moving.step(&problem, h).unwrap(), Status::Solved);
        }
        let at = moving.state().u[0];
        assert!((way - at) > 0.0 && way - at <= 0.5001 * speed * h, "{h}: {at} of {way}");
        assert!(moving.velocity()[0].abs() < 1e-12);
        let account = moving.account();
        assert_balanced(account);
        let energy = 0.5 * MASS * speed * speed;
        assert!((account.kinetic + energy).abs() < 1e-12 * energy);
        assert_eq!(account.friction_power(), Some(account.dissipation / account.capacity));
    }
}

/// A block falls by `g t^2 / 2`, to the order of the step, and stays on the floor.
#[test]
fn a_block_falls_and_stays_on_the_floor() {
    let (height, h) = (0.2, 1e-3);
    let problem = block(0.0, 0.0, height, 0.0);
    let mut falling = Evolution::new(&problem, MASSES, with_inertia()).unwrap();
    for _ in 0..150 {
        assert_eq!(falling.step(&problem, h).unwrap(), Status::Solved);
    }
    let fallen = 0.5 * GRAVITY * 0.15 * 0.15;
    assert!((falling.state().u[1] + fallen).abs() <= 0.5001 * GRAVITY * 0.15 * h);
    for _ in 0..100 {
        assert_eq!(falling.step(&problem, h).unwrap(), Status::Solved);
    }
    assert!((falling.state().u[1] + height).abs() < 1e-12);
    assert!((falling.state().t_n[0] - WEIGHT).abs() < 1e-9 * WEIGHT);
    assert_balanced(falling.account());
}

/// A belt with the speed `V` takes a block on a spring along until friction is used up, at `x = mu N / k`. From there the
/// block swings by `V / omega sin(omega t)`: it never gets ahead of the belt.
#[test]
fn a_belt_takes_a_block_along_until_it_swings_by_itself() {
    let (spring, speed) = (50.0, 0.2);
    let (omega, slips_at) = ((spring / MASS).sqrt(), MU * WEIGHT / spring);
    let errors = [1e-3, 5e-4].map(|h| {
        let start = block(0.0, spring, 0.0, 0.0);
        let moving = Evolution::new(&start, MASSES, with_inertia()).unwrap();
        let mut moving = moving.moving(vec![speed, 0.0]).unwrap();
        let (mut worst, mut time) = (0.0_f64, 0.0);
        let stuck = slips_at / speed;
        while time < stuck + 0.5 {
            time += h;
            let problem = block(0.0, spring, 0.0, speed * time);
            assert_eq!(moving.step(&problem, h).unwrap(), Status::Solved);
            let expected = if time <= stuck {
                speed * time
            } else {
                slips_at + speed / omega * (omega * (time - stuck)).sin()
            };
            worst = worst.max((moving.state().u[0] - expected).abs());
        }
        assert_balanced(moving.account());
        worst / (speed / omega)
    });
    assert!(errors[0] < 0.02 && errors[1] < 0.6 * errors[0], "{errors:?}");
}

/// A slender block that leans by the angle `a` falls back about its corner: `I a'' = -W b / 2`, so that it is upright after
/// `sqrt(4 I a / (W b))`, with small angles.
#[test]
fn a_block_rocks_back_about_its_corner() {
    let (half, centre, angle) = (0.1, 0.5, 1e-3);
    let about_centre = MASS * (4.0 * half * half + 4.0 * centre * centre) / 12.0;
    let about_corner = about_centre + MASS * (half * half + centre * centre);
    let upright = (4.0 * about_corner * angle / (WEIGHT * 2.0 * half)).sqrt();
    let mut builder = Contact2d::builder([[0.0; 3], [0.0; 3], [0.0; 3]], vec![0.0, -WEIGHT, 0.0]);
    // Displacements of the centre along both axes, and the angle, counter-clockwise.
    for x in [-half, half] {
        builder.add_point(ContactPoint {
            normal: &[(1, 1.0), (2, x)],
            tangent: &[(0, 1.0), (2, centre)],
            mu: 0.9,
            ..Default::default()
        });
    }
    let problem = builder.build().unwrap();
    let mass = [[MASS, 0.0, 0.0], [0.0, MASS, 0.0], [0.0, 0.0, about_centre]];
    // It leans to the right, on its right corner.
    let leaning = [centre * angle, half * angle, -angle].to_vec();
    let zero = || vec![0.0; 2];
    let errors = [2e-3, 1e-3].map(|part| {
        let h = part * upright;
        let state = problem.state(leaning.clone(), zero(), zero());
        let slips = state.slip.clone();
        let mut rocking = Evolution::new(&problem, mass, with_inertia()).unwrap();
        rocking = rocking.at(state, slips).unwrap();
        let mut steps = 0;
        while rocking.state().gap[0] > 1e-12 && steps < 3000 {
            assert_eq!(rocking.step(&problem, h).unwrap(), Status::Solved);
            steps += 1;
        }
        assert_balanced(rocking.account());
        (f64::from(steps) * part - 1.0).abs()
    });
    assert!(errors[0] < 0.01 && errors[1] < 0.01, "{errors:?}");
}

/// Without inertia a block that friction does not hold flows with `(P - mu N) / (c M)`, and one that it holds rests at once.
#[test]
fn a_block_that_nothing_holds_flows_against_the_drag() {
    let push = 1.4 * MU * WEIGHT;
    let settings = EvolutionSettings { drag: 3.0, ..Default::default() };
    let problem = block(push, 0.0, 0.0, 0.0);
    let mut moving = Evolution::new(&problem, MASSES, settings.clone()).unwrap();
    assert_eq!(moving.settle(&problem, 0.1).unwrap(), Ending::Flows);
    let speed = (push - MU * WEIGHT) / (3.0 * MASS);
    assert!((moving.velocity()[0] - speed).abs() < 1e-9 * speed);
    assert_balanced(moving.account());

    let problem = block(0.9 * MU * WEIGHT, 0.0, 0.0, 0.0);
    let mut held = Evolution::new(&problem, MASSES, settings).unwrap();
    assert_eq!(held.settle(&problem, 0.1).unwrap(), Ending::Rests);
    assert!(held.state().u[0].abs() < 1e-12);
}

/// A soft spring lets a block go far, but it is not said to flow.
#[test]
fn a_block_on_a_soft_spring_comes_to_rest() {
    let push = 2.0 * MU * WEIGHT;
    for spring in [1e-6, 1e-3, 1.0, 1e6] {
        let problem = block(push, spring, 0.0, 0.0);
        let mut moving = Evolution::new(&problem, MASSES, EvolutionSettings::default()).unwrap();
        assert_eq!(moving.settle(&problem, 1.0).unwrap(), Ending::Rests, "{spring}");
        let place = (push - MU * WEIGHT) / spring;
        assert!((moving.state().u[0] - place).abs() < 1e-9 * place);
    }
}

/// Nor is it if the spring is invisible beside the stiffness of the body that it holds.
#[test]
fn a_stiff_body_on_a_soft_spring_comes_to_rest() {
    let push = 2.0 * MU * WEIGHT;
    for (body, spring) in [(1e6, 1.0), (1e10, 1e2), (1e10, 1e-1)] {
        let stiffness = [[body, -body, 0.0], [-body, body + spring, 0.0], [0.0; 3]];
        let mut builder = Contact2d::builder(stiffness, vec![push, 0.0, -WEIGHT]);
        builder.add_point(ContactPoint {
            normal: &[(2, 1.0)],
            tangent: &[(0, 1.0)],
            mu: MU,
            ..Default::default()
        });
        let problem = builder.build().unwrap();
        let settings = EvolutionSettings::default();
        let mut moving = Evolution::new(&problem, diagonal(&[MASS; 3]), settings).unwrap();
        assert_eq!(moving.settle(&problem, 1e-3).unwrap(), Ending::Rests, "{body} {spring}");
        let place = (push - MU * WEIGHT) / spring;
        // The rounding errors of what strains the body, beside the force of the spring.
        let rounded = 1e-9_f64.max(4.0 * f64::EPSILON * body / spring);
        assert!((moving.state().u[1] - place).abs() < rounded * place);
    }
}

/// Pushed and released a block on a spring remembers its way: it stays until the force has fallen by `2 mu N` (Jenkins'
/// element). However far the push goes at once, it arrives at the same places.
#[test]
fn a_block_on_a_spring_remembers_its_way() {
    let (spring, most) = (40.0, MU * WEIGHT);
    let mut moving =
        Evolution::new(&block(0.0, spring, 0.0, 0.0), MASSES, EvolutionSettings::default())
            .unwrap();
    for (push, force) in
        [(0.9, 0.0), (3.0, 2.0), (5.0, 4.0), (3.1, 4.0), (2.0, 3.0), (-1.0, 0.0), (1.5, 0.5)]
    {
        let problem = block(push * most, spring, 0.0, 0.0);
        let ending = moving.advance(&problem, 1.0).unwrap();
        assert_eq!(ending, Ending::Arrived);
        assert_eq!(moving.settle(&problem, 1.0).unwrap(), Ending::Rests);
        let place = force * most / spring;
        assert!((moving.state().u[0] - place).abs() < 1e-10, "{push}: {:?}", moving.state());
        // The state solves the problem with slips from where the last step began.
        let there = problem.slid(moving.slips_before()).unwrap();
        assert!(there.residuals(moving.state()).worst() <= 1e-10);
    }
    assert_balanced(moving.account());
}

/// Blocks on springs in their joints sink by the sum of what lies above each of them over its stiffness.
#[test]
fn a_pile_settles_into_its_joints() {
    let (blocks, compliance) = (5_usize, 1e-3);
    let mut builder = Contact2d::builder(diagonal(&[0.0; 5]), vec![-WEIGHT; 5]);
    for i in 0..blocks {
        let own = [(i, 1.0)];
        let both = [(i, 1.0), (i.saturating_sub(1), -1.0)];
        let normal: &[(usize, f64)] = if i == 0 { &own } else { &both };
        builder.add_point(ContactPoint {
            normal,
            compliance: [compliance, 0.0],
            ..Default::default()
        });
    }
    let problem = builder.build().unwrap();
    let mass = diagonal(&[MASS; 5]);
    let mut pile = Evolution::new(&problem, mass, EvolutionSettings::default()).unwrap();
    assert_eq!(pile.settle(&problem, 0.1).unwrap(), Ending::Rests);
    let mut place = 0.0;
    for (i, u) in pile.state().u.iter().enumerate() {
        place -= (blocks - i) as f64 * WEIGHT * compliance;
        assert!((u - place).abs() < 1e-9 * place.abs(), "{i}: {u} instead of {place}");
    }
    assert_balanced(pile.account());
}

/// Nothing changes under the loads of an equilibrium.
#[test]
fn bodies_at_rest_stay_where_they_are() {
    let problem = block(2.0 * MU * WEIGHT, 40.0, 0.0, 0.0);
    let mut moving = Evolution::new(&problem, MASSES, EvolutionSettings::default()).unwrap();
    assert!(moving.settle(&problem, 1.0).unwrap().rests());
    let (u, account) = (moving.state().u.clone(), *moving.account());
    assert_eq!(moving.advance(&problem, 1.0).unwrap(), Ending::Arrived);
    assert!(moving.settle(&problem, 1.0).unwrap().rests());
    assert!(moving.state().u.iter().zip(&u).all(|(a, b)| (a - b).abs() < 1e-12));
    assert!(moving.account().since(&account).work.abs() < 1e-12);
}

/// Bodies that leave the range in which a problem means anything are not followed further: a spring would stop one two metres
/// away, a floor the other at a thousand million.
#[test]
fn bodies_that_leave_are_not_followed() {
    let push = 2.0 * MU * WEIGHT;
    let (pushed, falling) = (block(push, 0.25 * push, 0.0, 0.0), block(0.0, 0.0, 1e9, 0.0));
    for (problem, reach, ending) in [
        (&pushed, 1.0, Ending::Left),
        (&pushed, 3.0, Ending::Rests),
        (&falling, 1.0, Ending::Flows),
    ] {
        let settings = EvolutionSettings { reach, ..Default::default() };
        let mut body = Evolution::new(problem, MASSES, settings).unwrap();
        assert_eq!(body.settle(problem, 0.1).unwrap(), ending, "{reach}");
    }
}

/// The observer stops steps, and wrong input is refused with the name of what is wrong.
#[test]
fn limits_and_mistakes_are_named() {
    let problem = block(2.0 * MU * WEIGHT, 40.0, 0.0, 0.0);
    let mut moving = Evolution::new(&problem, MASSES, EvolutionSettings::default()).unwrap();
    let stop = &mut |_: &lcp::Iteration| ControlFlow::Break(());
    let ending = moving.settle_observed(&problem, 1.0, stop).unwrap();
    assert_eq!(ending, Ending::Open(Status::Cancelled));

    let no_drag = EvolutionSettings { drag: 0.0, ..Default::default() };
    let refused = Evolution::new(&problem, MASSES, no_drag).unwrap_err();
    assert!(matches!(refused, Error::Setting { name: "drag", .. }), "{refused}");
    let no_reach = EvolutionSettings { reach: 0.0, ..Default::default() };
    let refused = Evolution::new(&problem, MASSES, no_reach).unwrap_err();
    assert!(matches!(refused, Error::Setting { name: "reach", .. }), "{refused}");
    assert!(matches!(moving.step(&problem, 0.0), Err(Error::Setting { name: "step", .. })));
    assert!(matches!(moving.step(&problem, f64::NAN), Err(Error::Setting { name: "step", .. })));
    let mut swinging = Evolution::new(&problem, MASSES, with_inertia()).unwrap();
    let refused = swinging.settle(&problem, 1.0).unwrap_err();
    assert!(matches!(refused, Error::Setting { name: "inertia", .. }), "{refused}");
    let skew = Evolution::new(&problem, [[1.0, 2.0], [0.0, 1.0]], EvolutionSettings::default());
    assert!(matches!(skew.unwrap_err(), Error::NotSymmetric { .. }));
    let short = moving.clone().moving(vec![0.0]);
    assert!(matches!(short.unwrap_err(), Error::Length { .. }));
}

/// A diagonal matrix.
fn diagonal(entries: &[f64]) -> lcp::Matrix {
    let n = entries.len();
    let triplets: Vec<_> = entries.iter().enumerate().map(|(i, v)| (i, i, *v)).collect();
    lcp::Matrix::from_triplets(n, n, &triplets).unwrap()
}

fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |max, v| max.max(v.abs()))
}

/// Three corners that meet stick to each other, so that one of their three contacts is redundant. Loads that come and go many
/// times move them as one, and forces stay as large as the loads.
#[test]
fn redundant_contacts_do_not_drift() {
    let (stiffness, heavy) = ([9.0e4, 1.0e4, 1.9e4], 11.0);
    let springs: Vec<f64> = stiffness.iter().flat_map(|k| [*k, *k]).collect();
    let under = |push: [f64; 2]| {
        let load = vec![0.1 * push[0], push[1], push[0] - 2.0, -heavy, 2.0 - push[0], -heavy];
        let mut builder = Contact2d::builder(diagonal(&springs), load);
        let of = |one: usize, other: usize, along: usize| {
            [(2 * one + along, 1.0), (2 * other + along, -1.0)]
        };
        // Two corners on a third, and one beside the other.
        for [one, other, normal] in [[1, 0, 1], [2, 0, 1], [1, 2, 0]] {
            builder.add_point(ContactPoint {
                normal: &of(one, other, normal),
                tangent: &of(one, other, 1 - normal),
                mu: 0.9,
                ..Default::default()
            });
        }
        builder.build().unwrap()
    };
    let mass = [1.0, 1.3, 0.7].iter().flat_map(|m| [*m, *m]).collect::<Vec<_>>();
    let mut moving =
        Evolution::new(&under([0.0; 2]), diagonal(&mass), EvolutionSettings::default()).unwrap();
    for k in 0..200_u32 {
        let angle = f64::from(k);
        let push = [angle.sin(), (0.7 * angle).cos()];
        let problem = under(push);
        assert!(moving.lead(&problem, 1e-3).unwrap().rests(), "{k}");
        let all: f64 = stiffness.iter().sum();
        let expected =
            [0, 1].map(|along| problem.loads().iter().skip(along).step_by(2).sum::<f64>() / all);
        let u = &moving.state().u;
        for (j, u) in u.iter().enumerate() {
            let error = (u - expected[j % 2]).abs();
            assert!(error <= 1e-14 * largest(&expected), "{k}: {error:e}");
        }
        assert!(largest(&moving.state().t_n) <= 2.0 * heavy, "{k}: {:?}", moving.state());
    }
    assert!(moving.account().dissipation.abs() <= 1e-12 * moving.account().stored.abs());
}
