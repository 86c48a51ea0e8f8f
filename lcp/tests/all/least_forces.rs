//! Forces of least size that balance loads: two struts that are nearly in line, whose forces are thousands of loads.

use std::ops::ControlFlow;

use faer::sparse::{SparseColMat, Triplet};
use lcp::{InteriorPoint, LeastForces, Status};

/// Two struts that rise at an angle from a load between them, and a support of another load beside them; they can push and
/// not pull.
fn carried_beside(angle: f64, light: f64) -> LeastForces {
    let (sin, cos) = angle.sin_cos();
    let entries = [(0, 0, cos), (1, 0, sin), (0, 1, -cos), (1, 1, sin), (2, 2, 1.0)];
    let entries = entries.map(|(row, column, value)| Triplet::new(row, column, value));
    let struts = SparseColMat::try_new_from_triplets(3, 3, &entries).expect("a sound matrix");
    InteriorPoint::default()
        .least_forces(&struts, &[0.0, -1.0, -light], &mut |_| ControlFlow::Continue(()))
        .expect("finite data")
}

#[test]
fn a_light_load_is_balanced_to_its_own_last_digits() {
    for angle in [1.0, 1e-2, 1e-4] {
        for light in [1e-2, 1e-4, 1e-6] {
            let found = carried_beside(angle, light);
            assert_eq!(found.status, Status::Solved, "{angle}, {light}");
            let error = (found.t[2] - light).abs() / light;
            assert!(error <= 1e-12, "{angle}, {light}: {error}");
        }
    }
}

/// Two struts that rise at an angle from a load between them; they can push and not pull.
fn carried(angle: f64, load: [f64; 2]) -> LeastForces {
    let (sin, cos) = angle.sin_cos();
    let entries = [(0, 0, cos), (1, 0, sin), (0, 1, -cos), (1, 1, sin)];
    let entries = entries.map(|(row, column, value)| Triplet::new(row, column, value));
    let struts = SparseColMat::try_new_from_triplets(2, 2, &entries).expect("a sound matrix");
    InteriorPoint::default()
        .least_forces(&struts, &load, &mut |_| ControlFlow::Continue(()))
        .expect("finite data")
}

#[test]
fn the_balance_is_measured_by_the_load_where_forces_are_far_larger() {
    for angle in [1.0, 1e-1, 1e-2, 1e-3, 1e-4] {
        for load in [1.0, 1e-9, 1e9] {
            let found = carried(angle, [0.0, -load]);
            assert_eq!(found.status, Status::Solved, "{angle}, {load}");
            let force = load / (2.0 * angle.sin());
            let along = (found.t[0] - found.t[1]) * angle.cos();
            let across = (found.t[0] + found.t[1]) * angle.sin() - load;
            // A hundred tolerances; rounding leaves some last digits of the forces.
            let lacks = along.abs().max(across.abs());
            assert!(lacks <= 1e-8 * load + 1e-14 * force, "{angle}, {load}: {lacks}");
            assert!(found.t.iter().all(|t| (t - force).abs() <= 1e-7 * force), "{:?}", found.t);
        }
    }
}

#[test]
fn struts_that_would_have_to_pull_are_proved_to_carry_nothing() {
    for angle in [1.0, 1e-2, 1e-4] {
        for load in [1.0, 1e-9, 1e9] {
            let found = carried(angle, [0.0, load]);
            assert_eq!(found.status, Status::Infeasible, "{angle}, {load}");
            // A motion against which no strut pushes, and on which the load does work.
            let [x, y] = [found.u[0], found.u[1]];
            let (sin, cos) = angle.sin_cos();
            assert!(y > 0.0 && sin * y - cos * x.abs() >= -1e-12, "{:?}", found.u);
        }
    }
}

/// A stack of blocks, one wide and half as high, of weight one, which a force on the top pushes aside: the resultants of the
/// loads, and in every joint the forces of two corners along the edges of their cones of friction.
fn stack(blocks: usize, push: f64) -> LeastForces {
    const MU: f64 = 1.5;
    let mut entries = Vec::new();
    let edges = [(-0.5, -MU), (-0.5, MU), (0.5, -MU), (0.5, MU)];
    for block in 0..blocks {
        for (edge, (x, along)) in edges.into_iter().enumerate() {
            let column = 4 * block + edge;
            // The block above the joint, and the one below it, each about its centre.
            let bodies = [(Some(block), 1.0, -0.25), (block.checked_sub(1), -1.0, 0.25)];
            for (body, sign, y) in bodies {
                let Some(body) = body else { continue };
                let acts = [sign * along, sign, sign * (x - y * along)];
                let rows = acts.into_iter().enumerate();
                entries.extend(rows.map(|(row, v)| Triplet::new(3 * body + row, column, v)));
            }
        }
    }
    let edges = SparseColMat::try_new_from_triplets(3 * blocks, 4 * blocks, &entries)
        .expect("a sound matrix");
    let mut loads = [0.0, -1.0, 0.0].repeat(blocks);
    let top = 3 * (blocks - 1);
    loads[top] = push;
    loads[top + 2] = -0.25 * push;
    InteriorPoint::default()
        .least_forces(&edges, &loads, &mut |_| ControlFlow::Continue(()))
        .expect("finite data")
}

/// The higher a stack, the larger its multipliers beside its forces: rounding errors of the former end no iteration.
#[test]
fn a_high_stack_is_balanced_within_a_few_steps() {
    for blocks in [10, 100, 1000] {
        // A push of the weight of one block tips the stack.
        let found = stack(blocks, 0.9);
        assert_eq!(found.status, Status::Solved, "{blocks}");
        assert!(found.info.factorisations <= 12, "{blocks}: {}", found.info.factorisations);
        for (joint, forces) in found.t.chunks(4).enumerate() {
            let above = (blocks - joint) as f64;
            let pressed: f64 = forces.iter().sum();
            assert!(
                (pressed - above).abs() <= 1e-9 * blocks as f64,
                "{blocks}, {joint}: {pressed}"
            );
        }
        assert_eq!(stack(blocks, 1.01).status, Status::Infeasible, "{blocks}");
    }
}
