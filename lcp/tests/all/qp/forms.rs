//! Programs with bounds and free variables, in every form that they can be written in.

use faer::{Mat, mat};
use lcp::{
    Auto, BoxedLcp, InteriorPoint, InteriorPointSettings, Lcp, Lemke, Matrix, MixedLcp,
    QuadraticProgram, Solver, Status, WarmStart,
};
use lcp_problems::families;

/// A problem with bounds at one for some variables as a mixed one: distances from lower bounds, and a row for every upper one.
fn with_rows(boxed: &BoxedLcp) -> MixedLcp {
    let n = boxed.order();
    let bounded: Vec<usize> = (0..n).filter(|&j| boxed.lower()[j].is_finite()).collect();
    let mut entries: Vec<(usize, usize, f64)> =
        (0..n).flat_map(|j| boxed.m().column(j).map(move |(i, v)| (i, j, v))).collect();
    let mut q = boxed.q().to_vec();
    for &j in &bounded {
        boxed.m().column(j).for_each(|(i, v)| q[i] += v * boxed.lower()[j]);
    }
    for (k, &j) in bounded.iter().enumerate() {
        entries.extend([(j, n + k, 1.0), (n + k, j, -1.0)]);
        q.push(boxed.upper()[j] - boxed.lower()[j]);
    }
    let free = (0..q.len()).map(|j| j < n && !bounded.contains(&j)).collect();
    MixedLcp::new(Matrix::from_triplets(q.len(), q.len(), &entries).unwrap(), q, free).unwrap()
}

/// The same problem with two variables for every free one.
fn in_standard_form(mixed: &MixedLcp) -> Lcp {
    let columns = (0..mixed.order()).flat_map(|j| {
        let negative = mixed.free()[j].then_some((j, -1.0));
        [(j, 1.0)].into_iter().chain(negative)
    });
    let columns: Vec<(usize, f64)> = columns.collect();
    let n = columns.len();
    let m = Mat::from_fn(n, n, |i, j| {
        columns[i].1 * mixed.m()[(columns[i].0, columns[j].0)] * columns[j].1
    });
    Lcp::new(m, columns.iter().map(|(j, sign)| sign * mixed.q()[*j]).collect::<Vec<f64>>()).unwrap()
}

/// Free states and multipliers, equations and bounds, in every form that they can be written in.
#[test]
fn programs_of_control_are_solved_in_every_form() {
    for (steps, seed) in [3, 10, 30].into_iter().flat_map(|n| (0..8).map(move |seed| (n, seed))) {
        let boxed = families::control(steps, seed).problem;
        let mixed = with_rows(&boxed);
        let standard = in_standard_form(&mixed);
        for method in [&QuadraticProgram::default() as &dyn Solver<BoxedLcp>, &Auto::default()] {
            let solution = method.solve(&boxed).unwrap();
            assert!(solution.is_solved(), "{steps} {seed} {}: {solution:?}", method.method());
            let (z, w) = boxed.variables(&solution);
            assert!(boxed.residuals(&z, &w).worst() <= 1e-10);
        }
        for method in [&QuadraticProgram::default() as &dyn Solver<MixedLcp>, &Auto::default()] {
            let solution = method.solve(&mixed).unwrap();
            assert!(solution.is_solved(), "{steps} {seed} {}: {solution:?}", method.method());
        }
        let solution = Auto::default().solve(&standard).unwrap();
        assert!(solution.is_solved(), "{steps} {seed}: {:?} {:?}", solution.status, solution.info);
    }
}

/// Variables with any bounds in one problem: free, from below, from above, between, and fixed.
#[test]
fn bounds_of_every_kind_are_kept() {
    let m = mat![
        [2.0, 1.0, 0.0, 0.0, 0.5],
        [1.0, 3.0, 1.0, 0.0, 0.0],
        [0.0, 1.0, 2.0, 0.5, 0.0],
        [0.0, 0.0, 0.5, 1.0, 0.0],
        [0.5, 0.0, 0.0, 0.0, 1.0],
    ];
    let infinite = f64::INFINITY;
    for shift in [0.0, 7.0, -7.0] {
        let lower = vec![-infinite, 1.0, -infinite, -1.0, 2.0].into_iter().map(|v| v + shift);
        let upper = vec![infinite, infinite, -1.0, 3.0, 2.0].into_iter().map(|v| v + shift);
        let (lower, upper): (Vec<f64>, Vec<f64>) = (lower.collect(), upper.collect());
        for q in [vec![-3.0, 1.0, -2.0, -9.0, 4.0], vec![30.0, -10.0, 50.0, 9.0, -4.0]] {
            let problem = BoxedLcp::new(m.clone(), q, lower.clone(), upper.clone()).unwrap();
            let lemke = Lemke::default().solve(&problem).unwrap();
            let (expected, _) = problem.variables(&lemke);
            let qp = QuadraticProgram::default();
            let interior = InteriorPoint::default();
            for method in [&qp as &dyn Solver<BoxedLcp>, &interior] {
                let solution = method.solve(&problem).unwrap();
                assert!(solution.is_solved(), "{}: {solution:?}", method.method());
                let (z, w) = problem.variables(&solution);
                assert!(problem.residuals(&z, &w).worst() <= 1e-12);
                for (z, expected) in z.iter().zip(&expected) {
                    assert!(
                        (z - expected).abs() <= 1e-11 * expected.abs().max(1.0),
                        "{z} {expected}"
                    );
                }
            }
            // From the basis of the solution, and from its point, nothing is left to do.
            let start = WarmStart::Point { t: lemke.t.clone(), y: lemke.y.clone() };
            let warm = InteriorPoint::new(InteriorPointSettings { start, ..Default::default() });
            let warm = warm.solve(&problem).unwrap();
            assert!(warm.is_solved() && warm.info.iterations == 0);
            let start = WarmStart::Basis(warm.basis.clone().unwrap());
            let again = InteriorPoint::new(InteriorPointSettings { start, ..Default::default() });
            let again = again.solve(&problem).unwrap();
            assert!(again.is_solved() && again.info.iterations == 0);
        }
    }
}

/// Bounds that contradict an equation are proved to do so, in the rows of the problem with bounds.
#[test]
fn bounds_that_contradict_equations_are_proved_to() {
    // x + u = 5 with x free below one, and u between two bounds.
    let m = mat![[1.0, 0.0, -1.0], [0.0, 1.0, -1.0], [1.0, 1.0, 0.0]];
    let infinite = f64::INFINITY;
    let (lower, upper) = (vec![-infinite, 2.0, -infinite], vec![1.0, 3.0, infinite]);
    let problem = BoxedLcp::new(m, vec![0.0, 0.0, -5.0], lower, upper).unwrap();
    let solution = QuadraticProgram::default().solve(&problem).unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.certificate.unwrap().holds(&problem.to_general()));
}
