//! The three forms of the contact problem have the same solutions.

use crate::common;

use common::enumerate::{solutions, violation};
use common::{model, model_with, rectangle, support, traction};
use masonry::analysis::outcome::{PointStatus, State};
use masonry::forms::reduction::Reduction;
use masonry::forms::{DenseForm, FormKind};
use masonry::model::joints::JointSearch;
use masonry::model::{Model, PlacedBlock};
use masonry::recover::{reactions, recover};
use masonry::system::System;
use masonry::verify::checks::Checks;

const FORMS: [FormKind; 3] = [FormKind::Coulomb, FormKind::StewartTrinkle, FormKind::Mixed];

fn one_block(mesh: Option<[usize; 2]>, shear: f64, mu: f64) -> Model {
    let mut block = rectangle("block", [0.0, 1.0], [0.0, 1.0], mesh);
    block.loads = vec![traction(2, shear, -1000.0)];
    model(vec![block], vec![support("floor", [-1.0, 0.0], [2.0, 0.0])], mu)
}

struct Solved {
    model: Model,
    system: System,
    reduction: Reduction,
}

impl Solved {
    fn new(model: Model) -> Self {
        let system = System::new(&model).unwrap();
        let reduction = Reduction::new(&system, None).unwrap();
        Self { model, system, reduction }
    }

    fn form(&self, kind: FormKind) -> DenseForm {
        DenseForm::new(kind, &self.system, &self.reduction).unwrap()
    }

    /// All states that enumeration finds.
    fn states(&self, kind: FormKind) -> Vec<State> {
        let form = self.form(kind);
        let rows = solutions(&form).into_iter().map(|(t, y)| form.rows(&t, &y));
        rows.map(|rows| recover(&self.model, &self.system, &self.reduction, &rows, true)).collect()
    }
}

#[test]
fn orders_are_as_documented() {
    let wall = Solved::new(one_block(Some([2, 1]), 100.0, 0.5));
    let (m, blocks) = (3, 1);
    let orders = FORMS.map(|kind| wall.form(kind).order());
    assert_eq!(orders, [3 * m, 4 * m, 4 * m + 6 * blocks]);
    let mut blocks = one_block(Some([2, 1]), 0.0, 0.5).blocks;
    blocks.push(rectangle("second", [1.0, 2.0], [0.0, 1.0], None));
    let supports =
        vec![support("floor", [0.0, 0.0], [3.0, 0.0]), support("wall", [2.0, 0.0], [2.0, 1.0])];
    let frictionless_heads = model_with(blocks, supports, [0.5, 0.0, 0.5], &JointSearch::default());
    let wall = Solved::new(frictionless_heads);
    let (m, m_f) = (3 + 2 + 2 + 2, 3 + 2 + 2);
    let orders = FORMS.map(|kind| wall.form(kind).order());
    assert_eq!(orders, [m + 2 * m_f, m + 3 * m_f, m + 3 * m_f + 12]);
}

/// Every solution of every form solves the two others.
#[test]
fn solutions_of_one_form_solve_the_others() {
    let cases = [
        one_block(None, 300.0, 0.5),
        one_block(Some([1, 1]), 300.0, 0.5),
        one_block(Some([1, 1]), -350.0, 0.4),
        one_block(Some([1, 1]), 0.0, 1.0),
    ];
    for model in cases {
        let case = Solved::new(model);
        for from in FORMS {
            let form = case.form(from);
            let found = solutions(&form);
            assert!(!found.is_empty(), "{from:?} has no solution");
            for (t, y) in found {
                assert!(violation(&form, &t, &y) < 1e-10);
                let rows = form.rows(&t, &y);
                let alpha = case.reduction.amplitudes(&rows.t, &rows.y);
                for to in FORMS {
                    let other = case.form(to);
                    let (t, y) = other.pairs(&rows, &alpha, &[]);
                    let error = violation(&other, &t, &y);
                    assert!(error < 1e-9, "{from:?} to {to:?}: {error:e}");
                    let back = other.rows(&t, &y);
                    let near = |a: &[f64], b: &[f64], unit: f64| {
                        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12 * unit)
                    };
                    assert!(near(&back.t, &rows.t, other.scale.force));
                    assert!(near(&back.y, &rows.y, other.scale.length));
                }
            }
        }
    }
}

/// A shear of 300 on a weight of 1000 with mu = 0.5: no sliding, reactions by statics.
#[test]
fn a_block_that_stands() {
    for mesh in [None, Some([1, 1])] {
        let case = Solved::new(one_block(mesh, 300.0, 0.5));
        for kind in FORMS {
            for state in case.states(kind) {
                let checks = Checks::of(&case.model, &state);
                assert!(checks.force_balance < 1e-10 && checks.moment_balance < 1e-10);
                assert!(checks.cone_violation < 1e-10 && checks.penetration < 1e-10);
                let floor = &reactions(&case.model, &state.contacts)[0];
                assert!((floor.fx + 300.0).abs() < 1e-7 && (floor.fy - 1000.0).abs() < 1e-7);
                // Loads: -1000 at x = 0.5 and 300 at y = 1, balanced about the origin.
                assert!((floor.m - (500.0 + 300.0)).abs() < 1e-7);
            }
        }
    }
}

/// With a shear of 600 on 1000 and mu = 0.5 nothing can balance: no form has a solution.
#[test]
fn a_block_that_slides_away_has_no_solution() {
    for mesh in [None, Some([1, 1])] {
        let case = Solved::new(one_block(mesh, 600.0, 0.5));
        for kind in FORMS {
            assert!(case.states(kind).is_empty(), "{kind:?}");
        }
    }
}

/// A shear of 600 tips a block on a floor with much friction: the limit is the ratio of width to height.
#[test]
fn a_block_that_tips_has_no_solution() {
    let case = Solved::new(one_block(Some([1, 1]), 600.0, 2.0));
    for kind in [FormKind::Coulomb, FormKind::StewartTrinkle] {
        assert!(case.states(kind).is_empty(), "{kind:?}");
    }
}

/// Poisson's effect drives the two feet of a pressed block apart: with little friction they slide
/// outwards, against friction. How much each of them slides is free, and one may just stay; the
/// forces and the sum of the slips are not.
#[test]
fn feet_slide_against_friction() {
    let mut model = one_block(Some([1, 1]), 0.0, 0.05);
    model.blocks[0].elasticity.as_mut().unwrap().poisson = 0.45;
    let case = Solved::new(model);
    for kind in FORMS {
        let states = case.states(kind);
        assert!(!states.is_empty());
        let mut spreads = Vec::new();
        for state in states {
            let mut spread = 0.0;
            for (contact, s) in case.model.contacts.iter().zip(&state.contacts) {
                let outwards = (contact.position.x - 0.5).signum();
                assert!((s.t_n - 500.0).abs() < 1e-7);
                assert!((s.t_t + 25.0 * outwards).abs() < 1e-7);
                assert!(s.y_t * outwards > -1e-18);
                assert_eq!(s.status == PointStatus::Slip, s.y_t * outwards > 1e-15);
                spread += s.y_t * outwards;
            }
            spreads.push(spread);
        }
        assert!(spreads[0] > 1e-8);
        assert!(spreads.iter().all(|s| (s - spreads[0]).abs() < 1e-9 * spreads[0]));
    }
}

/// The documented start bases are nonsingular here, with tangential isostatic rows too.
#[test]
fn start_bases_are_nonsingular() {
    let stack = |mesh: Option<[usize; 2]>| -> Vec<PlacedBlock> {
        let mut blocks = vec![
            rectangle("lower", [0.0, 1.0], [0.0, 0.5], mesh),
            rectangle("upper", [0.2, 1.2], [0.5, 1.0], Some([1, 1])),
        ];
        blocks[1].loads.push(traction(2, 50.0, -1000.0));
        blocks
    };
    for mesh in [None, Some([2, 2])] {
        let floor = support("floor", [-1.0, 0.0], [2.0, 0.0]);
        let case = Solved::new(model(stack(mesh), vec![floor], 0.35));
        assert!(case.reduction.isostatic.iter().any(|row| *row >= case.system.points()));
        for kind in [FormKind::Coulomb, FormKind::StewartTrinkle] {
            let form = case.form(kind);
            assert_eq!(form.starts.len(), 2);
            for start in &form.starts {
                let n = form.order();
                assert_eq!(start.t_basic.len(), n);
                let basis = nalgebra::DMatrix::from_fn(n, n, |i, j| {
                    if start.t_basic[j] {
                        form.problem.a()[(i, j)]
                    } else {
                        form.problem.b()[(i, j)]
                    }
                });
                let values = basis.singular_values();
                assert!(values.min() > 1e-6 * values.max(), "{kind:?} {}", start.name);
            }
        }
    }
}

/// `z.M z >= 0` for nonnegative `z`, which is what Lemke's method needs.
#[test]
fn the_mixed_form_is_copositive() {
    let case = Solved::new(one_block(Some([2, 1]), 100.0, 0.8));
    let form = case.form(FormKind::Mixed);
    let n = form.order();
    for seed in 1..200_usize {
        let z: Vec<f64> = (0..n).map(|k| ((k * 31 + seed * 17) % 13) as f64).collect();
        let row = |i: usize| {
            z.iter().enumerate().map(|(j, z)| -form.problem.a()[(i, j)] * z).sum::<f64>()
        };
        let value: f64 = z.iter().enumerate().map(|(i, z)| z * row(i)).sum();
        let size: f64 = z.iter().map(|z| z * z).sum();
        assert!(value >= -1e-12 * size, "{value:e}");
    }
}
