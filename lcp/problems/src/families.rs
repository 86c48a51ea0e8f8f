//! Generated problems with known solutions: for tests, benchmarks and examples.
//!
//! Every generator is a pure function of its arguments, on every machine. Planted solutions are exact: the data are
//! integers small enough that `q = w - M z` has no rounding errors.
//!
//! | family | class | Lemke's method in theory |
//! |---|---|---|
//! | [`positive_definite`], [`harker_pang`], [`obstacle()`], [`Obstacle`] | positive definite | solves, unique |
//! | [`p_matrix`], [`murty`], [`fathi`], [`kostreva_1`] | P | solves, unique |
//! | [`perpetual_option`] | M | solves, unique |
//! | [`positive_semidefinite`], [`ties`], [`horizontal_monotone`], [`mixed_monotone`], [`control`] | monotone | solves when feasible |
//! | [`strictly_copositive`] | strictly copositive | solves |
//! | [`copositive_plus`] | copositive-plus | solves when feasible |
//! | [`infeasible_semidefinite`], [`kostreva_2`], [`infeasible`] | infeasible | no solution |
//! | [`bimatrix`] | games | has a solution, may end on a ray |
//! | [`indefinite`], [`triangular`], [`horizontal_singular`], [`mixed_singular`] | none | may end on a ray |
//!
//! ```
//! use lcp::{Lemke, Solver};
//! use lcp_problems::families::{self, KnownAnswer};
//!
//! let instance = families::positive_definite(10, 1);
//! let solution = Lemke::default().solve(&instance.problem)?;
//! let KnownAnswer::Unique { t, .. } = instance.known else { panic!("positive definite") };
//! assert!(t.iter().zip(&solution.t).all(|(z, found)| (z - found).abs() < 1e-12));
//! # Ok::<(), lcp::Error>(())
//! ```

mod applied;
mod horizontal;
mod mixed;
mod obstacle;
mod standard;
mod textbook;

pub use applied::{control, perpetual_option};
pub use horizontal::{horizontal_monotone, horizontal_singular, infeasible};
pub use mixed::{mixed_monotone, mixed_singular};
pub use obstacle::{Ground, Obstacle};
pub use standard::{
    bimatrix, copositive_plus, harker_pang, indefinite, infeasible_semidefinite, p_matrix,
    positive_definite, positive_semidefinite, strictly_copositive, ties, triangular,
};
pub use textbook::{fathi, kostreva_1, kostreva_2, murty, obstacle};

use faer::Mat;

use lcp::SplitMix;
use lcp::{HorizontalLcp, Lcp, Matrix};

/// A problem and the known facts about it.
#[derive(Debug, Clone)]
pub struct Instance<P = HorizontalLcp> {
    /// The problem.
    pub problem: P,
    /// The known facts about its solutions.
    pub known: KnownAnswer,
}

/// The known facts about a problem. `t` is `z` and `y` is `w` in the standard and in the mixed form.
#[derive(Debug, Clone, PartialEq)]
pub enum KnownAnswer {
    /// The problem has exactly one solution.
    Unique {
        /// The first variable of every pair.
        t: Vec<f64>,
        /// The second variable of every pair.
        y: Vec<f64>,
    },
    /// The problem has this solution, and perhaps others.
    Solution {
        /// The first variable of every pair.
        t: Vec<f64>,
        /// The second variable of every pair.
        y: Vec<f64>,
    },
    /// The problem has a solution.
    Solvable,
    /// The linear conditions alone cannot be met.
    Infeasible {
        /// The proof: `A^T farkas <= 0`, `B^T farkas <= 0`, `c . farkas > 0`.
        farkas: Vec<f64>,
    },
}

/// The kind of a planted solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Planting {
    /// The only solution, without a degenerate pair.
    Unique,
    /// A solution without a degenerate pair.
    Strict,
    /// Both variables are zero in half of the pairs.
    Degenerate,
}

/// Random small integers, and matrices and vectors of them.
struct Integers(SplitMix);

impl Integers {
    fn new(seed: u64) -> Self {
        Self(SplitMix::new(seed))
    }

    fn next(&mut self, low: i8, high: i8) -> f64 {
        let width = f64::from(high) - f64::from(low) + 1.0;
        f64::from(low) + (width * self.0.next_f64()).floor()
    }

    fn index(&mut self, n: usize) -> usize {
        let n = n as u64;
        usize::try_from(self.0.next_u64() % n.max(1)).unwrap_or(0)
    }

    fn vector(&mut self, n: usize, low: i8, high: i8) -> Vec<f64> {
        (0..n).map(|_| self.next(low, high)).collect()
    }

    fn matrix(&mut self, rows: usize, columns: usize, low: i8, high: i8) -> Mat<f64> {
        Mat::from_fn(rows, columns, |_, _| self.next(low, high))
    }

    /// `K - K^T`.
    fn skew(&mut self, n: usize) -> Mat<f64> {
        let k = self.matrix(n, n, -1, 1);
        &k - k.transpose()
    }

    /// A complementary pair of nonnegative vectors.
    fn solution(&mut self, n: usize, planting: Planting) -> (Vec<f64>, Vec<f64>) {
        let states = if planting == Planting::Degenerate { 4 } else { 2 };
        let pair = |_| {
            let value = self.next(1, 3);
            match self.index(states) {
                0 => (value, 0.0),
                1 => (0.0, value),
                _ => (0.0, 0.0),
            }
        };
        (0..n).map(pair).unzip()
    }
}

fn planted(m: Mat<f64>, random: &mut Integers, planting: Planting) -> Instance<Lcp> {
    let (t, y) = random.solution(m.nrows(), planting);
    let problem = with_solution(m, &t, &y);
    let is_unique = planting == Planting::Unique;
    let known =
        if is_unique { KnownAnswer::Unique { t, y } } else { KnownAnswer::Solution { t, y } };
    Instance { problem, known }
}

/// `w = M z + q` with `q` such that `z` and `w` solve it.
fn with_solution(m: impl Into<Matrix>, z: &[f64], w: &[f64]) -> Lcp {
    let m = m.into();
    let q = product(&m, z).iter().zip(w).map(|(mz, w)| w - mz).collect();
    standard(m, q)
}

fn standard(m: impl Into<Matrix>, q: Vec<f64>) -> Lcp {
    Lcp::new(m, q).expect("finite and of one order")
}

fn product(m: &Matrix, x: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; m.nrows()];
    for (j, x) in x.iter().enumerate() {
        m.column(j).for_each(|(i, entry)| sum[i] += entry * x);
    }
    sum
}
