//! Closed contacts whose gaps are rounding errors, which contradict each other.

use std::ops::Range;

use lcp::{Contact2d, ContactPoint, Lemke, Solver, SplitMix, Status};

/// A step of one of boxes of mass and weight one, wide and high by one, one upon the other; each stands on its corners, and on the middle
/// between them.
fn pile(boxes: usize, mut gap: impl FnMut() -> f64) -> Contact2d {
    let n = 3 * boxes;
    let inertia = [1.0, 1.0, 1.0 / 6.0];
    let mass: Vec<_> = (0..n).map(|j| (j, j, inertia[j % 3])).collect();
    let mass = lcp::Matrix::from_triplets(n, n, &mass).unwrap();
    let weight: Vec<f64> = (0..n).map(|j| if j % 3 == 1 { -1.0 } else { 0.0 }).collect();
    let mut builder = Contact2d::builder(mass, weight);
    for above in 0..boxes {
        for arm in [-0.5, 0.0, 0.5] {
            let motion = |first: usize, sign: f64, height: f64| {
                let normal = [(first + 1, sign), (first + 2, sign * arm)];
                let tangent = [(first, sign), (first + 2, -sign * height)];
                (normal, tangent)
            };
            let (mut normal, mut tangent) = (Vec::new(), Vec::new());
            let (n_above, t_above) = motion(3 * above, 1.0, -0.5);
            normal.extend(n_above);
            tangent.extend(t_above);
            if above > 0 {
                let (n_below, t_below) = motion(3 * (above - 1), -1.0, 0.5);
                normal.extend(n_below);
                tangent.extend(t_below);
            }
            let (normal, tangent) = (&normal[..], &tangent[..]);
            let point = ContactPoint { normal, tangent, gap: gap(), mu: 0.5, ..Default::default() };
            builder.add_point(point);
        }
    }
    builder.build().unwrap()
}

fn assert_solved(boxes: Range<usize>, size: f64) {
    let mut random = SplitMix::new(5);
    for boxes in boxes {
        let problem = pile(boxes, || size * ((random.next_u64() % 200) as f64 / 100.0 - 1.0));
        let solution = Lemke::default().solve(&problem).unwrap();
        assert_eq!(solution.status, Status::Solved, "{boxes} boxes: {:?}", solution.residuals);
        let state = problem.variables(&solution);
        // The lowest box carries all.
        let carried: f64 = state.t_n[..3].iter().sum();
        assert!((carried - boxes as f64).abs() < 1e-9 * boxes as f64, "{carried}");
    }
}

#[test]
fn pivots_solve_piles_whose_gaps_are_rounding_errors() {
    assert_solved(2..24, 1e-14);
}

#[test]
fn pivots_solve_piles_without_gaps() {
    assert_solved(2..24, 0.0);
}
