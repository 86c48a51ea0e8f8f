//! Forces of least size that balance loads, or a proof that there are none, as a mixed problem.

use faer::mat;

use lcp::{InteriorPoint, InteriorPointSettings, MixedLcp, Solution, Solver, Status};

/// The forces of least size along `edges` that balance a load on two bodies of one freedom each.
fn program(edges: [[f64; 2]; 3], load: [f64; 2]) -> MixedLcp {
    let [a, b, c] = edges;
    let m = mat![
        [0.0, 0.0, -a[0], -b[0], -c[0]],
        [0.0, 0.0, -a[1], -b[1], -c[1]],
        [a[0], a[1], 1.0, 0.0, 0.0],
        [b[0], b[1], 0.0, 1.0, 0.0],
        [c[0], c[1], 0.0, 0.0, 1.0],
    ];
    let q = vec![-load[0], -load[1], 0.0, 0.0, 0.0];
    MixedLcp::new(m, q, vec![true, true, false, false, false]).unwrap()
}

fn solved(problem: &MixedLcp) -> Solution<MixedLcp> {
    let settings = InteriorPointSettings { crossover: false, ..Default::default() };
    InteriorPoint::new(settings).solve(problem).unwrap()
}

/// Two equal forces that balance a load carry half each, whatever the units are.
#[test]
fn forces_of_least_size_are_found() {
    for unit in [1e-9, 1.0, 1e9] {
        let edges = [[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let problem = program(edges, [-2.0 * unit, -unit]);
        let solution = solved(&problem);
        assert_eq!(solution.status, Status::Solved);
        let (z, _) = problem.recover(&solution.t, &solution.y);
        for force in &z[2..] {
            assert!((force / unit - 1.0).abs() < 1e-9, "{z:?}");
        }
    }
}

/// Nothing pulls, so nothing balances a load that does.
#[test]
fn that_there_are_none_is_proved() {
    for unit in [1e-9, 1.0, 1e9] {
        let problem = program([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], [-unit, 0.5 * unit]);
        let solution = solved(&problem);
        assert_eq!(solution.status, Status::Infeasible);
        assert!(solution.certificate.unwrap().holds(&problem.to_general()));
    }
}
