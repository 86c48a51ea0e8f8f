//! Problems known by the products of their rows.

use faer::Mat;
use lcp::pgs::{Constraint, MatrixRows, Rows};
use lcp::{Error, Friction2d, ProjectedGaussSeidel, ProjectedGaussSeidelSettings, Solver, Status};

use super::{distance, settings, to};

/// `J M^-1 J^T` with the velocities as the state.
struct Impulses {
    j: Vec<Vec<(usize, f64)>>,
    inverse_mass: Vec<f64>,
    velocity: Vec<f64>,
}

impl Rows for Impulses {
    fn order(&self) -> usize {
        self.j.len()
    }

    fn product(&self, i: usize, _z: &[f64]) -> f64 {
        self.j[i].iter().map(|&(k, v)| v * self.velocity[k]).sum()
    }

    fn moved(&mut self, i: usize, change: f64) {
        for &(k, v) in &self.j[i] {
            self.velocity[k] += self.inverse_mass[k] * v * change;
        }
    }

    fn clear(&mut self) {
        self.velocity.fill(0.0);
    }
}

/// A pile of `count` blocks, pushed to the side at every block: contacts with friction, stated by J.
fn pile(count: usize) -> Impulses {
    let below = |k: usize, axis: usize| (k > 0).then(|| (2 * (k - 1) + axis, -1.0));
    let row =
        |k: usize, axis: usize| below(k, axis).into_iter().chain([(2 * k + axis, 1.0)]).collect();
    let j = (0..count).flat_map(|k| [row(k, 1), row(k, 0)]).collect();
    let inverse_mass = (0..2 * count).map(|k| 1.0 / (1.0 + (k / 2) as f64)).collect();
    Impulses { j, inverse_mass, velocity: vec![0.0; 2 * count] }
}

impl Impulses {
    fn assembled(&self) -> Mat<f64> {
        let dense = Mat::from_fn(self.j.len(), self.velocity.len(), |i, k| {
            self.j[i].iter().filter(|(at, _)| *at == k).map(|(_, v)| v).sum::<f64>()
        });
        let scaled =
            Mat::from_fn(dense.nrows(), dense.ncols(), |i, k| dense[(i, k)] * self.inverse_mass[k]);
        &scaled * dense.transpose()
    }
}

#[test]
fn rows_without_a_matrix_are_as_good() {
    let count = 6;
    let mut pile = pile(count);
    let w = pile.assembled();
    let q: Vec<f64> =
        (0..2 * count).map(|i| if i == 0 { -1.0 } else { 0.1 * (i % 2) as f64 }).collect();
    let constraints = vec![Constraint::Friction { mu: 0.3 }; count];
    let free = to(1e-11).solve_rows(&mut pile, &q, &constraints).unwrap();
    let mut rows = MatrixRows::new(&w.clone().into());
    let assembled = to(1e-11).solve_rows(&mut rows, &q, &constraints).unwrap();
    let friction = Friction2d::new(w.clone(), q.clone(), vec![0.3; count]).unwrap();
    let judged = to(1e-11).solve(&friction).unwrap();
    assert_eq!((free.status, assembled.status), (Status::Solved, Status::Solved));
    assert!(judged.is_solved() && free.residual <= 1e-11 && assembled.residual <= 1e-11);
    let forces = friction.forces(&judged.t);
    let by_contact =
        |z: &[f64], part: usize| -> Vec<f64> { z.iter().skip(part).step_by(2).copied().collect() };
    for z in [&free.z, &assembled.z] {
        assert!(distance(&by_contact(z, 0), &forces.normal) <= 1e-8);
        assert!(distance(&by_contact(z, 1), &forces.tangential) <= 1e-8);
    }
    for (i, w_i) in free.w.iter().enumerate() {
        let product: f64 = (0..2 * count).map(|k| w[(i, k)] * free.z[k]).sum();
        assert!((product + q[i] - w_i).abs() <= 1e-13);
    }
}

/// A state that drifts does not spoil the residual: it is set anew for it.
#[test]
fn a_state_that_drifts_is_found_out() {
    struct Drifting(f64);
    impl Rows for Drifting {
        fn order(&self) -> usize {
            1
        }
        fn product(&self, _i: usize, _z: &[f64]) -> f64 {
            self.0
        }
        fn moved(&mut self, _i: usize, change: f64) {
            // Small changes lose a tenth of themselves.
            self.0 += if change.abs() < 0.5 { 0.9 * change } else { change };
        }
        fn clear(&mut self) {
            self.0 = 0.0;
        }
    }
    let settings = ProjectedGaussSeidelSettings { relaxation: 0.75, ..settings() };
    let solver = ProjectedGaussSeidel::new(settings);
    let solution = solver.solve_rows(&mut Drifting(0.0), &[-1.0], &[Constraint::FREE]).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert!((solution.z[0] - 1.0).abs() <= 2e-8, "{solution:?}");
    assert_eq!(solution.w, [solution.z[0] - 1.0]);
}

#[test]
fn constraints_must_fit() {
    let mut rows = MatrixRows::new(&Mat::<f64>::identity(2, 2).into());
    let solver = to(1e-8);
    let mut with =
        |q: &[f64], constraints: &[Constraint]| solver.solve_rows(&mut rows, q, constraints);
    let two = [Constraint::NONNEGATIVE; 2];
    assert!(matches!(with(&[0.0], &two), Err(Error::Length { name: "q", len: 1, expected: 2 })));
    assert!(matches!(with(&[0.0, f64::NAN], &two), Err(Error::NotFinite { row: 1, .. })));
    assert!(matches!(with(&[0.0; 2], &two[..1]), Err(Error::Length { len: 1, expected: 2, .. })));
    let crossed = Constraint::Bounds { lower: 1.0, upper: 0.0 };
    let error = with(&[0.0; 2], &[Constraint::FREE, crossed]).unwrap_err();
    assert!(matches!(error, Error::Bounds { index: 1, .. }));
    let error = with(&[0.0; 2], &[Constraint::Friction { mu: -1.0 }]).unwrap_err();
    assert!(matches!(error, Error::Setting { name: "mu", .. }));
    assert!(with(&[0.0; 2], &[Constraint::Friction { mu: 0.0 }]).is_ok());
}
