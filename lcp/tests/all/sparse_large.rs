//! Sparse problems of orders that dense matrices do not reach, or reach slowly, with known answers.

use faer::sparse::{SparseColMat, Triplet};
use lcp::{
    Covering, HorizontalLcp, Lcp, Lemke, LemkeSettings, MixedLcp, Solution, Solver, Status,
    WarmStart,
};

type Sparse = SparseColMat<usize, f64>;

fn first_attempt() -> Lemke {
    Lemke::new(LemkeSettings { max_attempts: Some(1), ..LemkeSettings::default() })
}

fn close(a: &[f64], b: &[f64]) -> bool {
    let size = a.iter().chain(b).fold(1.0_f64, |max, v| max.max(v.abs()));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9 * size)
}

/// A string of tension one, held at height one at both ends, under the load `p`, over the ground at
/// zero. From each end to the first of the nodes on the ground, node `k`, it is a parabola.
struct StringOnGround {
    n: usize,
    load: f64,
}

impl StringOnGround {
    /// With `k` such that some hundreds of nodes are above the ground.
    fn touching_near(n: usize, k: f64) -> Self {
        let h = 1.0 / (n as f64 + 1.0);
        Self { n, load: 2.0 / (k * h).powi(2) }
    }

    fn problem(&self) -> HorizontalLcp {
        let n = self.n;
        let stiffness = (n as f64 + 1.0).powi(2);
        let mut entries = Vec::new();
        for i in 0..n {
            entries.push(Triplet::new(i, i, 2.0 * stiffness));
            if i + 1 < n {
                entries.push(Triplet::new(i, i + 1, -stiffness));
                entries.push(Triplet::new(i + 1, i, -stiffness));
            }
        }
        let mut q = vec![self.load; n];
        q[0] -= stiffness;
        q[n - 1] -= stiffness;
        Lcp::new(Sparse::try_new_from_triplets(n, n, &entries).unwrap(), q).unwrap().into()
    }

    /// Second differences are `p h^2` above the ground, and the last of them, at node `k`, is less.
    fn heights(&self) -> Vec<f64> {
        let drop = self.load / (self.n as f64 + 1.0).powi(2);
        let slope = |k: f64| (1.0 - drop * k * (k - 1.0) / 2.0) / k;
        let k = (1..=self.n).find(|&k| slope(k as f64) <= drop).unwrap();
        let from_end = |i: usize| {
            let j = (k as f64 - i as f64).max(0.0);
            slope(k as f64) * j + drop * j * (j - 1.0) / 2.0
        };
        (1..=self.n).map(|i| from_end(i).max(from_end(self.n + 1 - i))).collect()
    }

    fn assert_solved(&self, solution: &Solution) {
        assert_eq!(solution.status, Status::Solved);
        let expected = self.heights();
        for (i, (z, u)) in solution.t.iter().zip(&expected).enumerate() {
            assert!((z - u).abs() < 1e-9, "node {i}: {z} is not {u}");
        }
        let above = expected.iter().filter(|u| **u > 1e-9).count();
        assert!(above > 60 && solution.info.pivots <= above + 3, "{}", solution.info.pivots);
    }
}

#[test]
fn a_string_touches_the_ground_where_it_should() {
    let string = StringOnGround::touching_near(2000, 150.3);
    string.assert_solved(&first_attempt().solve(&string.problem()).unwrap());
}

/// A dense tableau of this order takes 3.2 GB.
#[test]
fn large_orders_need_little_memory() {
    let string = StringOnGround::touching_near(20_000, 50.6);
    let solution = first_attempt().solve(&string.problem()).unwrap();
    string.assert_solved(&solution);
}

/// Five-point Laplacian on a square of `m` by `m` nodes.
fn membrane(m: usize) -> Sparse {
    let mut entries = Vec::new();
    for (i, j) in (0..m).flat_map(|i| (0..m).map(move |j| (i, j))) {
        entries.push(Triplet::new(i * m + j, i * m + j, 4.0));
        let right = (j + 1 < m).then_some(i * m + j + 1);
        let below = (i + 1 < m).then_some(i * m + j + m);
        for other in right.into_iter().chain(below) {
            entries.push(Triplet::new(i * m + j, other, -1.0));
            entries.push(Triplet::new(other, i * m + j, -1.0));
        }
    }
    Sparse::try_new_from_triplets(m * m, m * m, &entries).unwrap()
}

/// A membrane under a load that pulls it up in the middle and presses it to the ground elsewhere.
#[test]
fn a_membrane_is_the_same_dense_and_sparse() {
    let m = 60;
    let matrix = membrane(m);
    let load = |k: usize| {
        let (x, y) = ((k / m) as f64 / m as f64 - 0.45, (k % m) as f64 / m as f64 - 0.5);
        if x * x + 2.0 * y * y < 0.04 { -1.0 - x } else { 0.3 + y }
    };
    let q: Vec<f64> = (0..m * m).map(load).collect();
    let dense = Lcp::new(matrix.to_dense(), q.clone()).unwrap();
    let sparse = Lcp::new(matrix, q).unwrap();
    let [dense, sparse] = [dense, sparse].map(|it| first_attempt().solve(&it).unwrap());
    assert_eq!((sparse.status, dense.status), (Status::Solved, Status::Solved));
    assert!(sparse.info.pivots > 500);
    assert_eq!(sparse.info.pivots, dense.info.pivots);
    assert_eq!(sparse.basis, dense.basis);
    assert!(close(&sparse.t, &dense.t));
}

/// An even load on an even membrane: at the start all rows tie, and later those that mirror each other.
#[test]
fn ties_of_all_rows_are_resolved() {
    let m = 24;
    for load in [-1.0, -1e-9] {
        let problem = Lcp::new(membrane(m), vec![load; m * m]).unwrap();
        let solution = first_attempt().solve(&problem).unwrap();
        assert_eq!(solution.status, Status::Solved);
        assert!(solution.t.iter().all(|&z| z > 0.0));
        let mirrored: Vec<f64> = solution.t.iter().rev().copied().collect();
        assert!(solution.t.iter().zip(&mirrored).all(|(a, b)| (a - b).abs() <= 1e-9 * a));
    }
}

/// In the last pair `w = -z - 1`, among many others that are sound.
#[test]
fn infeasible_problems_are_proved_so() {
    let n = 3000;
    let entries = (0..n - 1).map(|i| Triplet::new(i, i, 2.0));
    let entries: Vec<_> = entries.chain([Triplet::new(n - 1, n - 1, -1.0)]).collect();
    let m = Sparse::try_new_from_triplets(n, n, &entries).unwrap();
    let q: Vec<f64> = (0..n).map(|i| if i < n - 20 { 1.0 } else { -1.0 }).collect();
    let solution = Lemke::default().solve(&Lcp::new(m, q).unwrap()).unwrap();
    assert_eq!(solution.status, Status::Infeasible);
    let pi = solution.farkas().unwrap();
    assert!(pi[n - 1].abs() > 0.0);
}

/// The solution of a neighbouring problem, as a basis and as a point, saves pivots.
#[test]
fn warm_starts() {
    let string = StringOnGround::touching_near(2000, 150.3);
    let solution = Lemke::default().solve(&string.problem()).unwrap();
    let neighbour = StringOnGround { load: 0.9 * string.load, ..string };
    let Solution { t, y, basis, .. } = solution;
    for start in [WarmStart::Basis(basis.unwrap()), WarmStart::Point { t, y }] {
        let settings =
            LemkeSettings { start, covering: Covering::Ones, ..LemkeSettings::default() };
        let solution = Lemke::new(settings).solve(&neighbour.problem()).unwrap();
        neighbour.assert_solved(&solution);
        assert!(solution.info.pivots < 60, "{}", solution.info.pivots);
    }
}

/// Bodies of weight one in a chain of springs, each second one on the ground and carrying its neighbour
/// by a stiff rod. Heights and rod forces are free. Nothing but the ground keeps the chain from
/// falling, so that neither side of the pairs is a basis.
#[test]
fn large_mixed_problems_find_a_basis() {
    let n = 3000;
    let (half, order) = (n / 2, 2 * n);
    let mut entries = Vec::new();
    for i in 0..n - 1 {
        entries.extend([(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)]);
    }
    for k in 0..half {
        let (rod, contact) = (n + k, n + half + k);
        for (body, unknown, v) in
            [(2 * k, rod, 1.0), (2 * k + 1, rod, -1.0), (2 * k, contact, -1.0)]
        {
            entries.extend([(body, unknown, v), (unknown, body, -v)]);
        }
    }
    let entries: Vec<_> = entries.into_iter().map(|(i, j, v)| Triplet::new(i, j, v)).collect();
    let m = Sparse::try_new_from_triplets(order, order, &entries).unwrap();
    let q: Vec<f64> = (0..order).map(|i| if i < n { 1.0 } else { 0.0 }).collect();
    let free: Vec<bool> = (0..order).map(|i| i < n + half).collect();
    let problem = MixedLcp::new(m, q, free).unwrap();
    let solution = Lemke::default().solve(&problem.to_general()).unwrap();
    assert_eq!(solution.status, Status::Solved);
    let (z, _) = problem.recover(&solution.t, &solution.y);
    let expected = |i: usize| match i / half {
        0 | 1 => 0.0,
        2 => 1.0,
        _ => 2.0,
    };
    for (i, z) in z.iter().enumerate() {
        assert!((z - expected(i)).abs() < 1e-9, "unknown {i} is {z}");
    }
}

/// A pair with two empty columns has no place in a basis: without it the string is solved, and where its
/// row, which is empty too, asks for something there is no solution.
#[test]
fn empty_pairs_are_left_out() {
    let string = StringOnGround::touching_near(2500, 80.4);
    let n = string.n;
    let grown = |m: &lcp::Matrix| {
        let entries = (0..n).flat_map(|j| m.column(j).map(move |(i, v)| Triplet::new(i, j, v)));
        Sparse::try_new_from_triplets(n + 1, n + 1, &entries.collect::<Vec<_>>()).unwrap()
    };
    let problem = string.problem();
    for (last, status) in [(0.0, Status::Solved), (1.0, Status::Infeasible)] {
        let c: Vec<f64> = problem.c().iter().copied().chain([last]).collect();
        let grown = HorizontalLcp::new(grown(problem.a()), grown(problem.b()), c).unwrap();
        let solution = Lemke::default().solve(&grown).unwrap();
        assert_eq!(solution.status, status);
        if solution.is_solved() {
            let expected = string.heights();
            assert!(solution.t.iter().zip(&expected).all(|(z, u)| (z - u).abs() < 1e-9));
        }
    }
}
