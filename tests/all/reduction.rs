//! The answer does not depend on units, on the order of blocks, on the choice of isostatic rows or on
//! the form of the complementarity problem.

use crate::common;

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use common::{
    GRAVITY, M_KN, all_displacements, all_reactions, all_stresses, difference, solved, state,
};
use lcp::Status;
use masonry::analysis::outcome::{Outcome, State};
use masonry::analysis::solve::solve;
use masonry::forms::reduction::Reduction;
use masonry::ids::BlockId;
use masonry::method::Request;
use masonry::method::lemke::Pivots;
use masonry::model::{Model, Plane};
use masonry::recover::recover;
use masonry::scene::bond;
use masonry::scene::{Block, Brick, Form, Joint, Load, Material, Scene, Support, Wall};
use masonry::system::System;
use masonry::units::{ForceUnit, LengthUnit, Units};
use nalgebra::{DMatrix, Vector2};

/// Differences that rounding explains.
const SAME: f64 = 1e-9;

const MM_N: Units = Units { length: LengthUnit::Mm, force: ForceUnit::N };

/// A heavy wall in running bond, loaded on a part of its top and leaning to the side, against a wall
/// on its right.
fn leaning_wall(units: Units) -> Scene {
    let m = 1.0 / units.length_to_si();
    let kn_per_m2 = 1e3 / units.stress_to_si();
    let brick = Brick { length: 0.25 * m, height: 0.12 * m };
    Scene::new("Leaning wall", units)
        .plane(Plane::Stress)
        .thickness(0.1 * m)
        .gravity([0.3 * GRAVITY, -GRAVITY])
        .material("brick", Material::elastic(3e4 * kn_per_m2, 0.15).density(1800.0))
        .joint("bed", Joint::mu(0.55))
        .joint("head", Joint::mu(0.4))
        .joint("floor", Joint::mu(0.7))
        .wall(Wall::running_bond("wall", "brick", brick, 0.875 * m, 4).mesh([2, 1]))
        .support(Support::new("floor", [0.0; 2], [0.875 * m, 0.0], "floor"))
        .support(Support::new("right wall", [0.875 * m, 0.0], [0.875 * m, 0.12 * m], "head"))
        .load(Load::pressure("top", [0.1 * m, 0.48 * m], [0.4 * m, 0.48 * m], 8.0 * kn_per_m2))
}

fn displaced(outcome: &Outcome) -> bool {
    let checks = outcome.checks.as_ref().unwrap();
    checks.open > 0 && checks.slip > 0 && checks.stick > 0
}

/// The wall makes use of everything: points open, slide and stick.
#[test]
fn units_do_not_matter() {
    let (first, second) = (solved(&leaning_wall(M_KN)), solved(&leaning_wall(MM_N)));
    assert!(displaced(&first), "{:?}", first.checks);
    assert!(difference(&all_displacements(&first), &all_displacements(&second)) < SAME);
    assert!(difference(&all_stresses(&first), &all_stresses(&second)) < SAME);
    assert!(difference(&all_reactions(&first), &all_reactions(&second)) < SAME);
    assert!(difference(&[state(&first).strain_energy], &[state(&second).strain_energy]) < SAME);
    assert_eq!(first.solve.pivots, second.solve.pivots);
    let told = |outcome: &Outcome| -> Vec<String> {
        outcome.solve.attempts.iter().map(ToString::to_string).collect()
    };
    assert_eq!(told(&first), told(&second));
}

/// The scene with its wall given brick by brick, in the order in which `key` sorts them.
fn brick_by_brick<K: Ord>(mut scene: Scene, key: impl Fn(usize) -> K) -> Scene {
    let wall = scene.walls.remove(0);
    let bricks = bond::bricks(&wall);
    let mut order: Vec<usize> = (0..bricks.len()).collect();
    order.sort_by_key(|k| key(*k));
    for k in order {
        let [along, high] =
            bricks[k].mesh(wall.mesh.unwrap()).map(|count| u32::try_from(count).unwrap());
        let block = Block::new(&bricks[k].name(&wall), &wall.material, bricks[k].corners());
        scene = scene.block(block.mesh([along, high]));
    }
    scene
}

/// Displacements of the blocks by name.
fn by_name(outcome: &Outcome) -> BTreeMap<&str, &Vec<Vector2<f64>>> {
    let names = outcome.model.blocks.iter().map(|block| block.name.as_str());
    names.zip(&state(outcome).displacements).collect()
}

/// Displacements and stresses, the blocks in the order of their names.
fn sorted(outcome: &Outcome) -> (Vec<f64>, Vec<f64>) {
    let moved = by_name(outcome).values().copied().flatten().flat_map(|u| [u.x, u.y]).collect();
    let name = |block: BlockId| outcome.model.blocks[block.index()].name.as_str();
    let mut stresses: Vec<_> = state(outcome).stresses.iter().collect();
    stresses.sort_by_key(|it| (name(it.block), it.element));
    (moved, stresses.iter().flat_map(|it| it.sigma).collect())
}

#[test]
fn the_order_of_blocks_does_not_matter() {
    let scene = leaning_wall(M_KN);
    let reference = solved(&scene);
    let (moved, stresses) = sorted(&reference);
    let as_laid = solved(&brick_by_brick(scene.clone(), |k| k));
    assert_eq!(sorted(&as_laid), (moved.clone(), stresses.clone()));

    let reversed = solved(&brick_by_brick(scene.clone(), std::cmp::Reverse));
    let shuffled = solved(&brick_by_brick(scene, |k| (7 * k + 3) % 16));
    for other in [reversed, shuffled] {
        let (other_moved, other_stresses) = sorted(&other);
        assert!(difference(&moved, &other_moved) < SAME);
        assert!(difference(&stresses, &other_stresses) < SAME);
        assert!(difference(&all_reactions(&reference), &all_reactions(&other)) < SAME);
    }
}

/// Numbers between 0.1 and 10, by their logarithm.
fn random_weights(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed;
    let mut next = || {
        // Knuth's MMIX generator; its upper bits are good enough here.
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1_u64 << 24) as f64
    };
    (0..count).map(|_| 10_f64.powf(2.0 * next() - 1.0)).collect()
}

/// The state that follows from a reduction with these weights, and the isostatic rows.
fn with_weights(model: &Model, weights: Option<&[f64]>) -> (State, Vec<usize>) {
    let system = System::new(model).unwrap();
    let reduction = Reduction::new(&system, weights).unwrap();
    let pivots = Pivots { system: &system, reduction: &reduction, start: None };
    let request = Request::new(1e-10);
    let answer = pivots.solve(&request, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(answer.info.status, Status::Solved, "{:#?}", answer.info.attempts);
    let state = recover(model, &system, &reduction, answer.rows.as_ref().unwrap(), true);
    (state, reduction.isostatic)
}

#[test]
fn the_choice_of_isostatic_rows_does_not_matter() {
    let model = Model::from_scene(&leaning_wall(M_KN)).unwrap();
    let rows = System::new(&model).unwrap().rows.len();
    let (reference, isostatic) = with_weights(&model, None);
    let moved = |state: &State| -> Vec<f64> {
        state.displacements.iter().flatten().flat_map(|u| [u.x, u.y]).collect()
    };
    let stresses =
        |state: &State| -> Vec<f64> { state.stresses.iter().flat_map(|it| it.sigma).collect() };
    for seed in 1..=4 {
        let weights = random_weights(rows, seed);
        let (other, other_isostatic) = with_weights(&model, Some(&weights));
        assert_ne!(isostatic, other_isostatic);
        assert!(difference(&moved(&reference), &moved(&other)) < SAME);
        assert!(difference(&stresses(&reference), &stresses(&other)) < SAME);
    }
}

/// `A` of (3.23) is symmetric and positive semidefinite, for any isostatic rows.
#[test]
fn the_reduced_compliance_is_positive_semidefinite() {
    let model = Model::from_scene(&leaning_wall(M_KN)).unwrap();
    let system = System::new(&model).unwrap();
    let weights = random_weights(system.rows.len(), 5);
    for weights in [None, Some(weights.as_slice())] {
        let a = Reduction::new(&system, weights).unwrap().a;
        let a = DMatrix::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)]);
        assert!((&a - a.transpose()).amax() <= 1e-15 * a.amax());
        let eigenvalues = a.symmetric_eigenvalues();
        let (least, largest) = (eigenvalues.min(), eigenvalues.max());
        assert!(largest > 0.0 && least > -1e-13 * largest, "{least:e} to {largest:e}");
    }
}

/// The forms have the same solutions; each may end on a ray, but for the mixed one.
#[test]
fn all_forms_agree() {
    let scenes = [
        leaning_wall(M_KN),
        leaning_wall(M_KN).gravity([-0.1 * GRAVITY, -GRAVITY]),
        leaning_wall(M_KN).gravity([0.0, -GRAVITY]).joint("bed", Joint::mu(1.0)),
        leaning_wall(M_KN).joint("head", Joint::mu(0.0)).joint("floor", Joint::mu(0.3)),
    ];
    let mut agreed = 0;
    for scene in scenes {
        let mixed = solved(&scene.clone().form(Form::Mixed));
        assert_eq!(mixed.solve.form, "mixed");
        for (form, name) in [(Form::Coulomb, "coulomb"), (Form::StewartTrinkle, "stewart-trinkle")]
        {
            let outcome = solve(&scene.clone().form(form)).unwrap();
            assert_eq!(outcome.solve.form, name);
            if outcome.solve.status == Status::RayTermination {
                continue;
            }
            assert_eq!(outcome.solve.status, Status::Solved);
            agreed += 1;
            assert!(difference(&all_displacements(&mixed), &all_displacements(&outcome)) < SAME);
            assert!(difference(&all_stresses(&mixed), &all_stresses(&outcome)) < SAME);
            let energies = [&mixed, &outcome].map(|it| state(it).strain_energy);
            assert!(difference(&energies[..1], &energies[1..]) < SAME);
        }
    }
    assert!(agreed >= 6, "the forms agreed in {agreed} of 8 cases");
}
