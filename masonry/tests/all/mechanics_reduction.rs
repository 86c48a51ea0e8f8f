//! The reduction to contact forces against the displacement method.

use crate::common;

use common::reference::{Told, by_displacements, by_reduction, difference};
use common::{block, model, model_with, rectangle, running_bond, support, traction};
use faer::Side;
use masonry::analysis::outcome::State;
use masonry::forms::reduction::Reduction;
use masonry::ids::BlockId;
use masonry::model::joints::{JointSearch, PointRule};
use masonry::model::{JointPoint, Model};
use masonry::recover::{reactions, recover};
use masonry::system::System;
use masonry::system::rigid::{FreeMotion, RigidError};
use masonry::verify::checks::Checks;
use nalgebra::{Point2, Vector2};

/// Three blocks on a floor: no normal sees a horizontal motion.
fn column() -> Model {
    let mut blocks: Vec<_> = (0..3_u8)
        .map(|k| {
            let y = [f64::from(k), f64::from(k + 1)].map(|y| 0.3 * y);
            rectangle(&format!("b{k}"), [0.0, 0.5], y, Some([2, 1]))
        })
        .collect();
    blocks[2].loads.push(traction(2, 700.0, -5000.0));
    blocks[1].loads.push(traction(1, -300.0, 0.0));
    model(blocks, vec![support("floor", [-1.0, 0.0], [1.0, 0.0])], 0.7)
}

/// Deformable and rigid blocks with slanted joints and different meshes.
fn mixed() -> Model {
    let p = |x: f64, y: f64| Point2::new(x, y);
    let base = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 0.6), p(0.0, 0.4)];
    let left = [p(0.0, 0.4), p(0.5, 0.5), p(0.4, 1.1), p(0.0, 1.0)];
    let right = [p(0.5, 0.5), p(1.0, 0.6), p(1.0, 1.2), p(0.4, 1.1)];
    let mut blocks = vec![
        block("base", base, Some([2, 1])),
        block("left", left, None),
        block("right", right, Some([3, 2])),
        rectangle("beside", [1.0, 1.7], [0.0, 0.9], None),
    ];
    blocks[1].loads.push(traction(2, 100.0, -4000.0));
    blocks[2].loads.push(traction(2, -500.0, -3000.0));
    blocks[3].loads.push(traction(2, 0.0, -1000.0));
    blocks[3].loads.push(traction(1, -800.0, 0.0));
    let floor = support("floor", [-1.0, 0.0], [3.0, 0.0]);
    model(blocks, vec![floor], 0.6)
}

fn wall() -> Model {
    let mut blocks = running_bond(2, 3, 2, 0.1);
    let top = blocks.len() - 2;
    blocks[top].loads.push(traction(2, 200.0, -8000.0));
    blocks[top + 1].loads.push(traction(2, -100.0, -2000.0));
    let floor = support("floor", [0.0, 0.0], [0.4, 0.0]);
    let left = support("left", [0.0, 0.0], [0.0, 0.3]);
    model(blocks, vec![floor, left], 0.5)
}

fn assemblies() -> [Model; 3] {
    [column(), mixed(), wall()]
}

fn reduce(model: &Model) -> (System, Reduction) {
    let system = System::new(model).unwrap();
    let reduction = Reduction::new(&system, None).unwrap();
    (system, reduction)
}

fn state_told(model: &Model, told: &[Told], weights: Option<&[f64]>) -> State {
    let system = System::new(model).unwrap();
    let reduction = Reduction::new(&system, weights).unwrap();
    let rows = by_reduction(&system, &reduction, told);
    recover(model, &system, &reduction, &rows, true)
}

/// All points stick, but for a few that slide either way or, where others remain, open.
fn variants(model: &Model) -> Vec<Vec<Told>> {
    let m = model.contacts.len();
    let with = |changes: &[(usize, Told)]| {
        let mut told = vec![Told::Stick; m];
        for (k, t) in changes {
            told[*k] = *t;
        }
        told
    };
    vec![
        with(&[]),
        with(&[(0, Told::Slide(-0.5)), (m - 1, Told::Slide(0.3))]),
        with(&[(1, Told::Open), (m - 2, Told::Slide(-0.4))]),
    ]
}

#[test]
fn a_is_symmetric_and_positive_semidefinite() {
    for model in assemblies() {
        let (_, reduction) = reduce(&model);
        let a = &reduction.a;
        assert_eq!(a, &a.transpose().to_owned());
        let values = a.self_adjoint_eigenvalues(Side::Lower).unwrap();
        let (least, largest) = (values[0], values[values.len() - 1]);
        assert!(largest > 0.0 && least > -1e-13 * largest, "{least:e} of {largest:e}");
    }
}

#[test]
fn reduction_agrees_with_the_displacement_method() {
    for model in assemblies() {
        for told in variants(&model) {
            let (direct, forces) = by_displacements(&model, &told);
            let (system, reduction) = reduce(&model);
            let rows = by_reduction(&system, &reduction, &told);
            let state = recover(&model, &system, &reduction, &rows, false);
            let error = difference(&direct, &state.displacements);
            assert!(error < 1e-10, "{error:e}");
            // Redundant forces differ; the resultants on every support may not.
            let mut other = state.clone();
            let m = model.contacts.len();
            for (k, contact) in other.contacts.iter_mut().enumerate() {
                (contact.t_n, contact.t_t) = (forces.t[k], forces.t[m + k]);
            }
            let pairs = reactions(&model, &state.contacts);
            for (ours, theirs) in pairs.iter().zip(reactions(&model, &other.contacts)) {
                let size = ours.fx.hypot(ours.fy);
                assert!((ours.fx - theirs.fx).hypot(ours.fy - theirs.fy) < 1e-9 * size);
                assert!((ours.m - theirs.m).abs() < 1e-9 * size);
            }
        }
    }
}

#[test]
fn relative_displacements_are_those_of_the_displacements() {
    for model in assemblies() {
        let told = &variants(&model)[1];
        let (system, reduction) = reduce(&model);
        let rows = by_reduction(&system, &reduction, told);
        let state = recover(&model, &system, &reduction, &rows, false);
        let size = state.displacements.iter().flatten().map(Vector2::norm).fold(0.0, f64::max);
        for (contact, s) in model.contacts.iter().zip(&state.contacts) {
            let joint = &model.joints[contact.joint.index()];
            let relative =
                masonry::recover::relative_displacement(&model, &state.displacements, contact);
            assert!((relative.dot(&joint.normal) - s.y_n).abs() < 1e-10 * size);
            assert!((relative.dot(&joint.tangent()) - s.y_t).abs() < 1e-10 * size);
        }
    }
}

#[test]
fn every_block_balances() {
    for model in assemblies() {
        for told in variants(&model) {
            let state = state_told(&model, &told, None);
            let checks = Checks::of(&model, &state);
            assert!(checks.force_balance < 1e-12, "{:e}", checks.force_balance);
            assert!(checks.moment_balance < 1e-12, "{:e}", checks.moment_balance);
        }
    }
}

/// The sum of the sizes of all forces on a block.
fn forces_on(model: &Model, state: &State, block: BlockId) -> f64 {
    let touches = |contact: &JointPoint| {
        contact.b.block == block || contact.a.is_some_and(|a| a.block == block)
    };
    let both = model.contacts.iter().zip(&state.contacts);
    let contacts = both.filter(|(contact, _)| touches(contact)).map(|(_, it)| it.t_n.hypot(it.t_t));
    let loads = model.forces_on(&model.blocks[block.index()]).into_iter();
    contacts.sum::<f64>() + loads.map(|it| it.force.norm()).sum::<f64>()
}

/// A wrong force or an extra load must be seen by the checks.
#[test]
fn checks_notice_what_is_wrong() {
    let model = wall();
    let state = state_told(&model, &vec![Told::Stick; model.contacts.len()], None);
    let largest = state.contacts.iter().map(|c| c.t_n.hypot(c.t_t)).fold(0.0, f64::max);
    let mut wrong = state.clone();
    wrong.contacts[3].t_n += 0.01 * largest;
    assert!(Checks::of(&model, &wrong).force_balance > 1e-3);
    wrong.contacts[3].t_n = -2.0 * largest;
    // Relative to all forces on the lighter block: what pulls is beyond the law by itself, or by its friction.
    let (point, it) = (&model.contacts[3], &wrong.contacts[3]);
    let beyond = point.law.violation(it.t_n, it.t_t) / point.law.mu.max(1.0);
    let blocks = [Some(point.b), point.a].into_iter().flatten();
    let lightest =
        blocks.map(|anchor| forces_on(&model, &wrong, anchor.block)).fold(f64::MAX, f64::min);
    let expected = beyond.max(2.0 * largest) / lightest;
    let found = Checks::of(&model, &wrong).cone_violation;
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} instead of {expected}");
    assert!(expected > 0.1, "{expected}");
    wrong.contacts[3].t_n = f64::NAN;
    assert!(Checks::of(&model, &wrong).force_balance.is_infinite());
    let mut sunk = state;
    sunk.displacements[0].iter_mut().for_each(|u| u.y -= 1.0);
    assert!((Checks::of(&model, &sunk).penetration - 1.0).abs() < 1e-3);
}

/// Positive numbers without a pattern.
fn weights(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|k| 0.1 + 0.9 * ((k * 37 + seed * 101 + 11) % 97) as f64 / 97.0).collect()
}

#[test]
fn the_choice_of_isostatic_rows_does_not_matter() {
    for model in assemblies() {
        let (system, first) = reduce(&model);
        let told = &variants(&model)[1];
        let reference = state_told(&model, told, None);
        for seed in 1..4 {
            let weights = weights(system.rows.len(), seed);
            let second = Reduction::new(&system, Some(&weights)).unwrap();
            assert_ne!(first.isostatic, second.isostatic, "the weights change the choice");
            let state = state_told(&model, told, Some(&weights));
            assert!(difference(&reference.displacements, &state.displacements) < 1e-10);

            // Forces that balance no load in the first choice do so in the second, with equal energy.
            let t_e: Vec<f64> = (0..first.others.len()).map(|k| (k as f64).sin()).collect();
            let mut t = vec![0.0; system.rows.len()];
            first.others.iter().zip(&t_e).for_each(|(row, f)| t[*row] = *f);
            for (i, row) in first.isostatic.iter().enumerate() {
                t[*row] = t_e.iter().enumerate().map(|(j, f)| first.r[(i, j)] * f).sum();
            }
            let other: Vec<f64> = second.others.iter().map(|row| t[*row]).collect();
            let size = t.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
            for (i, row) in second.isostatic.iter().enumerate() {
                let sum: f64 = other.iter().enumerate().map(|(j, f)| second.r[(i, j)] * f).sum();
                assert!((sum - t[*row]).abs() < 1e-11 * size);
            }
            let energy = |a: &faer::Mat<f64>, t: &[f64]| -> f64 {
                let row = |i: usize| t.iter().enumerate().map(|(j, f)| a[(i, j)] * f).sum::<f64>();
                t.iter().enumerate().map(|(i, f)| f * row(i)).sum()
            };
            let (e1, e2) = (energy(&first.a, &t_e), energy(&second.a, &other));
            assert!((e1 - e2).abs() < 1e-10 * e1, "{e1:e} {e2:e}");
        }
    }
}

/// Millimetres and meganewtons give the same answer as metres and newtons.
#[test]
fn units_do_not_matter() {
    let (length, force) = (1e3, 1e-6);
    let stress = force / (length * length);
    for model in assemblies() {
        let mut blocks = model.blocks.clone();
        for block in &mut blocks {
            block.corners.iter_mut().for_each(|p| *p *= length);
            for node in block.mesh.iter_mut().flat_map(|mesh| mesh.nodes.iter_mut()) {
                *node *= length;
            }
            if let Some(e) = &mut block.elasticity {
                e.young *= stress;
            }
            block.loads.iter_mut().for_each(|load| load.scale(stress));
        }
        let mut supports = model.supports.clone();
        for support in &mut supports {
            support.from *= length;
            support.to *= length;
        }
        let mu = model.joint_classes[0].law.mu;
        let mut scaled = common::model(blocks, supports, mu);
        scaled.thickness = length;
        for told in variants(&model) {
            let (a, b) = (state_told(&model, &told, None), state_told(&scaled, &told, None));
            let back: Vec<Vec<Vector2<f64>>> = b
                .displacements
                .iter()
                .map(|block| block.iter().map(|u| u / length).collect())
                .collect();
            assert!(difference(&a.displacements, &back) < 1e-10);
            let energy = b.strain_energy / (force * length);
            assert!((a.strain_energy - energy).abs() < 1e-9 * energy);
        }
    }
}

#[test]
fn the_order_of_blocks_does_not_matter() {
    for model in assemblies() {
        let mut blocks = model.blocks.clone();
        blocks.reverse();
        let mu = model.joint_classes[0].law.mu;
        let reversed = common::model(blocks, model.supports.clone(), mu);
        let told = vec![Told::Stick; model.contacts.len()];
        let (a, b) = (state_told(&model, &told, None), state_told(&reversed, &told, None));
        let mut back = b.displacements;
        back.reverse();
        assert!(difference(&a.displacements, &back) < 1e-10);
    }
}

/// A uniform pressure passes a joint between meshes that do not match, with every rule whose points
/// integrate the shape functions of both sides exactly.
#[test]
fn contact_patch_test() {
    for points in [PointRule::Vertices, PointRule::Gauss] {
        let mut blocks = vec![
            rectangle("lower", [0.0, 1.5], [0.0, 1.0], Some([3, 2])),
            rectangle("upper", [0.0, 1.5], [1.0, 2.0], Some([4, 3])),
        ];
        for e in blocks.iter_mut().flat_map(|b| b.elasticity.iter_mut()) {
            (e.young, e.poisson) = (2e6, 0.0);
        }
        blocks[1].loads.push(traction(2, 0.0, -1e5));
        let supports =
            vec![support("floor", [0.0, 0.0], [1.5, 0.0]), support("left", [0.0, 0.0], [0.0, 2.0])];
        let options = JointSearch { points, ..JointSearch::default() };
        let model = model_with(blocks, supports, [0.0; 3], &options);
        let told = vec![Told::Stick; model.contacts.len()];
        let state = state_told(&model, &told, None);
        for stress in &state.stresses {
            assert!((stress.sigma[1] + 1e5).abs() < 1e-5, "{:?}", stress.sigma);
            assert!(stress.sigma[0].abs() < 1e-5 && stress.sigma[2].abs() < 1e-5);
        }
        let interface = &state.displacements[1][0];
        assert!((interface.y + 0.05).abs() < 1e-12);
        let floor = &reactions(&model, &state.contacts)[0];
        assert!((floor.fy - 1.5e5).abs() < 1e-6 && floor.fx.abs() < 1e-6);
        assert!((floor.m - 0.75 * 1.5e5).abs() < 1e-6);
    }
}

#[test]
fn free_motions_are_named() {
    let column = |mu: f64| {
        let blocks = vec![
            rectangle("lower", [0.0, 1.0], [0.0, 1.0], None),
            rectangle("upper", [0.0, 1.0], [1.0, 2.0], Some([1, 1])),
        ];
        let floor = vec![support("floor", [0.0, 0.0], [1.0, 0.0])];
        model_with(blocks, floor, [mu, 0.0, 0.5], &JointSearch::default())
    };
    let system = System::new(&column(0.5)).unwrap();
    assert_eq!(Reduction::new(&system, None).unwrap().isostatic.len(), 6);
    let system = System::new(&column(0.0)).unwrap();
    let error = Reduction::new(&system, None).unwrap_err();
    let RigidError::Free { block, motion, free } = error;
    let FreeMotion::Translation { direction: [x, y] } = motion else { panic!("{motion}") };
    assert_eq!((block, free), (1, 1));
    assert!((x.abs() - 1.0).abs() < 1e-12 && y.abs() < 1e-12);
}

#[test]
fn a_floating_block_is_named() {
    let blocks = vec![
        rectangle("held", [0.0, 1.0], [0.0, 1.0], None),
        rectangle("floating", [3.0, 4.0], [5.0, 6.0], None),
    ];
    let model = model(blocks, vec![support("floor", [0.0, 0.0], [1.0, 0.0])], 0.5);
    let error = Reduction::new(&System::new(&model).unwrap(), None).unwrap_err();
    assert!(matches!(error, RigidError::Free { block: 1, free: 3, .. }), "{error}");
}
