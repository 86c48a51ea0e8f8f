//! One problem after the other: states that stay or change, pairs that come and go, and memory.

#![allow(clippy::unwrap_used)] // a test may panic

use allocation_counter::measure;
use faer::Mat;
use lcp::refine::ContactStatus;
use lcp::{
    Auto, AutoSettings, Contact2d, ContactPoint, Error, Friction2d, InteriorPoint,
    InteriorPointSettings, Lcp, Sequence, Solver, SplitMix, Status,
};
use lcp_problems::families;

fn numbers(count: usize) -> Vec<usize> {
    (0..count).collect()
}

/// `B^T B` and as much on the diagonal: one solution for every right-hand side.
fn definite(n: usize, random: &mut SplitMix) -> Mat<f64> {
    let b = Mat::from_fn(n, n, |_, _| random.next_f64() - 0.5);
    b.transpose() * &b + Mat::<f64>::identity(n, n)
}

#[test]
fn every_step_has_the_solution_of_its_problem() {
    let mut random = SplitMix::new(3);
    for n in [1, 6, 40] {
        let m = definite(n, &mut random);
        let mut q: Vec<f64> = (0..n).map(|_| random.next_f64() - 0.5).collect();
        let lcp = Lcp::new(m, q.clone()).unwrap();
        let mut sequence = Sequence::new(lcp, &numbers(n), AutoSettings::default()).unwrap();
        for _ in 0..30 {
            for q in &mut q {
                *q += 0.2 * (random.next_f64() - 0.5);
            }
            let found = sequence.solve(&q).unwrap().clone();
            let lcp = sequence.problem();
            assert!(found.is_solved() && lcp.residuals(&found.t, &found.y).worst() <= 1e-10);
            let alone = Auto::default().solve(lcp).unwrap();
            let error = found.t.iter().zip(&alone.t).map(|(a, b)| (a - b).abs());
            assert!(error.fold(0.0, f64::max) <= 1e-12);
        }
    }
}

/// The exchange of all negative pairs has no end, or no matrix to solve with: the chain of methods solves these.
#[test]
fn what_exchanges_do_not_solve_is_solved_otherwise() {
    for seed in 0..20 {
        let problem = families::indefinite(12, seed).problem;
        let n = problem.order();
        let q = problem.q().to_vec();
        let mut sequence = Sequence::new(problem, &numbers(n), AutoSettings::default()).unwrap();
        assert!(sequence.solve(&q).unwrap().is_solved(), "{seed}");
    }
    let none = Lcp::new([[-1.0]], [-1.0]).unwrap();
    let mut sequence = Sequence::new(none, &["only"], AutoSettings::default()).unwrap();
    let infeasible = sequence.solve(&[-1.0]).unwrap();
    assert_eq!(infeasible.status, Status::Infeasible);
    assert!(infeasible.certificate.is_some());
    assert!(sequence.solve(&[1.0]).unwrap().certificate.is_none());
}

/// A point of mass one on a floor (mu = 0.5) slides or sticks, beside one that has left.
#[test]
fn pairs_that_stay_keep_their_states() {
    let contact = |points: usize, push: f64| {
        let w = Mat::<f64>::identity(2 * points, 2 * points);
        let q: Vec<f64> = (0..points).flat_map(|_| [-2.0, push]).collect();
        Friction2d::new(w, q, vec![0.5; points]).unwrap()
    };
    let keys = |points: &[usize]| -> Vec<(usize, u8)> {
        points.iter().flat_map(|&point| (0..3).map(move |k| (point, k))).collect()
    };
    let two = contact(2, -3.0);
    let lcp = two.standard().clone();
    let q = lcp.q().to_vec();
    let mut sequence = Sequence::new(lcp, &keys(&[7, 8]), AutoSettings::default()).unwrap();
    let forces = two.forces(&sequence.solve(&q).unwrap().t);
    assert_eq!((forces.normal, forces.tangential), (vec![2.0; 2], vec![1.0; 2]));
    // Contact 8 goes, 9 comes before 7: one exchange for the normal force of 9, one for its sliding.
    let other = contact(2, -3.0);
    sequence.renew(other.standard().clone(), &keys(&[9, 7])).unwrap();
    let found = sequence.solve(&q).unwrap();
    assert!(found.is_solved() && (1..=3).contains(&found.info.iterations), "{:?}", found.info);
    let one = contact(1, -3.0);
    sequence.renew(one.standard().clone(), &keys(&[7])).unwrap();
    assert_eq!(sequence.solve(&q[..3]).unwrap().info.iterations, 0);
}

/// Blocks one on the other, the lowest pushed: contacts of a new block are new, all others keep their states.
#[test]
fn states_of_contacts_are_kept_by_keys() {
    let pile = |blocks: usize| {
        let k = Mat::from_fn(2 * blocks, 2 * blocks, |i, j| f64::from(u8::from(i == j)));
        let mut f: Vec<f64> = (0..blocks).flat_map(|_| [0.0, -1.0]).collect();
        f[0] = 4.0;
        let mut builder = Contact2d::builder(k, f);
        for block in 0..blocks {
            let (x, y) = (2 * block, 2 * block + 1);
            let (mut normal, mut tangent) = (vec![(y, 1.0)], vec![(x, 1.0)]);
            if block > 0 {
                normal.push((y - 2, -1.0));
                tangent.push((x - 2, -1.0));
            }
            let (normal, tangent) = (&normal[..], &tangent[..]);
            builder.add_point(ContactPoint { normal, tangent, mu: 0.3, ..Default::default() });
        }
        builder.build().unwrap()
    };
    let before = pile(5);
    let first = InteriorPoint::default().solve(&before).unwrap();
    let mut statuses = before.statuses(&before.variables(&first));
    assert_eq!(statuses[0], ContactStatus::Forwards);
    statuses.push(ContactStatus::Stick);
    let next = pile(6);
    let start = next.start_of(&statuses);
    let settings = InteriorPointSettings { start, ..Default::default() };
    let (warm, cold) = (InteriorPoint::new(settings), InteriorPoint::default());
    let [warm, cold] = [warm, cold].map(|method| method.solve(&next).unwrap());
    assert!(warm.is_solved() && cold.is_solved());
    assert!(2 * warm.info.factorisations < cold.info.factorisations);
}

#[test]
fn solves_after_the_first_allocate_nothing() {
    let mut random = SplitMix::new(9);
    for n in [6, 24, 100] {
        let lcp = Lcp::new(definite(n, &mut random), vec![-1.0; n]).unwrap();
        let mut sequence = Sequence::new(lcp, &numbers(n), AutoSettings::default()).unwrap();
        let mut q = vec![-1.0; n];
        assert!(sequence.solve(&q).unwrap().is_solved());
        let mut exchanges = 0;
        for _ in 0..20 {
            for q in &mut q {
                *q = 2.0 * (random.next_f64() - 0.5);
            }
            let allocations = measure(|| exchanges += sequence.solve(&q).unwrap().info.iterations);
            assert_eq!(allocations.count_total, 0, "{n}");
        }
        assert!(exchanges > 0);
    }
}

/// Terms of 1e12 cancel in a row whose pair is not free: what rounding hides there is more than the tolerance.
#[test]
fn a_point_whose_rows_cancel_is_not_called_solved_by_its_rounded_sums() {
    let near = 1.0 + (-40_f64).exp2();
    let m = [[1.0, -1.0, 0.0], [-1.0, near, 0.0], [1.0 / 3.0, -1.0 / 3.0, 1.0]];
    let lcp = Lcp::new(m, [-1.0, 0.0, 1.0]).unwrap();
    let mut sequence = Sequence::new(lcp.clone(), &numbers(3), AutoSettings::default()).unwrap();
    let found = sequence.solve(&[-1.0, 0.0, 1.0]).unwrap();
    assert!(!found.is_solved() || lcp.residuals(&found.t, &found.y).worst() <= 1e-10);
}

#[test]
fn wrong_lengths_and_numbers_are_named() {
    let lcp = Lcp::new([[2.0]], [1.0]).unwrap();
    let error = Sequence::new(lcp.clone(), &numbers(2), AutoSettings::default()).err().unwrap();
    assert!(matches!(error, Error::Length { name: "keys", len: 2, expected: 1 }), "{error}");
    let mut sequence = Sequence::new(lcp.clone(), &[0], AutoSettings::default()).unwrap();
    assert!(matches!(sequence.solve(&[]), Err(Error::Length { name: "q", .. })));
    assert!(matches!(sequence.solve(&[f64::NAN]), Err(Error::NotFinite { .. })));
    assert!(matches!(sequence.renew(lcp, &[]), Err(Error::Length { name: "keys", .. })));
    assert!((sequence.solve(&[-2.0]).unwrap().t[0] - 1.0).abs() < 1e-15);
}

/// Once it has said so, the observer is not asked again.
#[test]
fn an_observer_stops_a_solve_and_the_next_goes_on() {
    let mut random = SplitMix::new(11);
    let n = 60;
    let m = definite(n, &mut random);
    let q: Vec<f64> = (0..n).map(|_| random.next_f64() - 0.5).collect();
    let expected = Auto::default().solve(&Lcp::new(m.clone(), q.clone()).unwrap()).unwrap();
    let lcp = Lcp::new(m, q.clone()).unwrap();
    let mut sequence = Sequence::new(lcp, &numbers(n), AutoSettings::default()).unwrap();
    let mut asked = 0;
    let stop = &mut |_: &lcp::Iteration| {
        asked += 1;
        std::ops::ControlFlow::Break(())
    };
    assert_eq!(sequence.solve_observed(&q, stop).unwrap().status, Status::Cancelled);
    assert_eq!(asked, 1);
    let found = sequence.solve(&q).unwrap();
    assert!(found.is_solved());
    let error = found.t.iter().zip(&expected.t).map(|(a, b)| (a - b).abs());
    assert!(error.fold(0.0, f64::max) <= 1e-12);
}
