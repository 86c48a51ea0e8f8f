//! Obstacle problems on grids: closed forms, an independent iteration, nested grids.

use lcp::{
    Error, Lcp, Lemke, SemismoothNewton, SemismoothNewtonSettings, Solution, Solver, Status,
    WarmStart,
};
use lcp_problems::families::{Ground, Obstacle};

const GROUNDS: [Ground; 3] =
    [Ground::Disc { radius: 0.6 }, Ground::Hills { count: 1 }, Ground::Hills { count: 3 }];

fn solve(problem: &Lcp, start: WarmStart) -> Solution<Lcp> {
    let settings = SemismoothNewtonSettings { start, ..Default::default() };
    let solution = SemismoothNewton::new(settings).solve(problem).unwrap();
    assert_eq!(solution.status, Status::Solved);
    solution
}

/// On grids of these sizes, each from the solution on the one before.
fn nested(sides: &[(usize, usize)], ground: Ground) -> Vec<(Obstacle, Solution<Lcp>)> {
    let mut levels: Vec<(Obstacle, Solution<Lcp>)> = Vec::new();
    for &(columns, rows) in sides {
        let grid = Obstacle::new(columns, rows, ground);
        let start = levels.last().map_or(WarmStart::None, |(coarse, solution)| {
            grid.refined_start(coarse, &solution.t).unwrap()
        });
        levels.push((grid, solve(&grid.problem(), start)));
    }
    levels
}

/// Projected successive over-relaxation on the five-point pattern, until nothing moves.
fn relaxed(grid: &Obstacle, problem: &Lcp) -> Vec<f64> {
    let (columns, n) = (grid.columns(), grid.order());
    let rows: Vec<Vec<(usize, f64)>> = (0..n).map(|i| problem.m().column(i).collect()).collect();
    let factor = 2.0 / (1.0 + (std::f64::consts::PI / (columns as f64 + 1.0)).sin());
    let mut z = vec![0.0_f64; n];
    for _ in 0..20_000 {
        let (mut moved, mut size) = (0.0_f64, 0.0_f64);
        for i in 0..n {
            let (mut w, mut diagonal) = (problem.q()[i], 0.0);
            for &(j, v) in &rows[i] {
                w += v * z[j];
                diagonal += if i == j { v } else { 0.0 };
            }
            let next = (z[i] - factor * w / diagonal).max(0.0);
            moved = moved.max((next - z[i]).abs());
            size = size.max(next);
            z[i] = next;
        }
        if moved <= 1e-15 * size {
            return z;
        }
    }
    panic!("the relaxation does not converge");
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
    a.iter().zip(b).fold(0.0_f64, |max, (a, b)| max.max((a - b).abs())) / size
}

/// The gap of the grid comes near that of the membrane, by the square of the step.
#[test]
fn a_disc_in_contact() {
    for radius in [0.3, 0.6, 0.8] {
        let sides = [9, 19, 39, 79, 159, 319].map(|side| (side, side));
        let levels = nested(&sides, Ground::Disc { radius });
        let errors: Vec<f64> = levels
            .iter()
            .map(|(grid, solution)| difference(&solution.t, &grid.exact_gap().unwrap()))
            .collect();
        // The slope of a straight line through the logarithms, since the rim of the disc falls
        // differently into the cells of every grid.
        let middle = (errors.len() as f64 - 1.0) / 2.0;
        let level = |k: usize| k as f64 - middle;
        let moment =
            |f: &dyn Fn(usize) -> f64| (0..errors.len()).map(|k| level(k) * f(k)).sum::<f64>();
        let order = -moment(&|k| errors[k].log2()) / moment(&level);
        assert!(order > 1.7 && order < 2.3, "order {order} of {errors:?}");
        // The area of the disc, to the first order: cells on its rim are counted or not.
        let (grid, solution) = levels.last().unwrap();
        let contact = solution.t.iter().filter(|z| **z <= 0.0).count() as f64;
        let share = std::f64::consts::PI * radius * radius / 4.0;
        let step = 2.0 / (grid.columns() as f64 + 1.0);
        assert!((contact / grid.order() as f64 - share).abs() < 4.0 * step);
    }
}

#[test]
fn an_independent_iteration_agrees() {
    for ground in GROUNDS {
        let levels = nested(&[(25, 25), (50, 50), (100, 100)], ground);
        let (grid, solution) = levels.last().unwrap();
        assert_eq!(grid.order(), 10_000);
        let gap = relaxed(grid, &grid.problem());
        assert!(difference(&solution.t, &gap) < 1e-10, "{}", difference(&solution.t, &gap));
        assert!(solution.residuals.natural <= 1e-12);
        let contact = gap.iter().filter(|z| **z <= 0.0).count();
        assert!(contact > 1000 && contact < 9000, "{contact}");
    }
}

#[test]
fn lemke_agrees() {
    for ground in GROUNDS {
        let problem = Obstacle::new(14, 11, ground).problem();
        let solution = solve(&problem, WarmStart::None);
        let by_lemke = Lemke::default().solve(&problem).unwrap();
        assert!(by_lemke.is_solved());
        assert!(difference(&solution.t, &by_lemke.t) < 1e-12);
    }
}

/// The gap on a coarse grid tells nearly all of the contact region of the fine one.
#[test]
fn nested_grids_take_few_steps() {
    for ground in GROUNDS {
        let sizes = [(20, 15), (40, 30), (80, 60), (160, 120)];
        let levels = nested(&sizes, ground);
        for (grid, solution) in &levels[1..] {
            let steps = solution.info.iterations;
            assert!(steps <= 5, "{steps} steps at {} columns, {ground:?}", grid.columns());
        }
        let (grid, last) = levels.last().unwrap();
        let cold = solve(&grid.problem(), WarmStart::None);
        assert!(cold.info.iterations >= last.info.iterations + 5, "{}", cold.info.iterations);
        assert_eq!(cold.basis, last.basis);
        assert!(difference(&cold.t, &last.t) < 1e-13);
    }
}

/// After the first step of an M-matrix the free set only grows.
#[test]
fn membranes_rise_monotonically() {
    let problem = Obstacle::new(40, 40, GROUNDS[2]).problem();
    let limited = |max_iterations| {
        let settings = SemismoothNewtonSettings { max_iterations, ..Default::default() };
        SemismoothNewton::new(settings).solve(&problem).unwrap()
    };
    let steps = limited(1000).info.iterations;
    assert!(steps > 4);
    // The best point of a run that is cut short is that of the least residual: the last ones here.
    let gaps: Vec<Vec<f64>> = (steps - 2..=steps).map(|it| limited(it).t).collect();
    for pair in gaps.windows(2) {
        assert!(pair[0].iter().zip(&pair[1]).all(|(a, b)| *b >= a - 1e-12));
    }
}

#[test]
fn misuse_is_named() {
    let (coarse, fine) = (Obstacle::new(3, 4, GROUNDS[0]), Obstacle::new(6, 8, GROUNDS[0]));
    let short = fine.refined_start(&coarse, &[0.0; 11]);
    assert_eq!(short, Err(Error::Length { name: "z", len: 11, expected: 12 }));
    let mut z = [0.0; 12];
    z[5] = f64::INFINITY;
    assert!(matches!(fine.refined_start(&coarse, &z), Err(Error::NotFinite { row: 5, .. })));
}
