//! Equilibria of games of two players as linear complementarity problems, with the crate `lcp` alone.
//!
//! The row player plays row `i` with probability `x_i` and gains `a_ij` on average, the column player
//! column `j` with `y_j` and gains `b_ij`. An equilibrium is a pair of strategies each of which is a best
//! response to the other one. With the positive costs `P = max a + 1 - A` and `Q = max b + 1 - B`, which
//! change nothing in the game, it is, up to its scale, a solution of (Lemke and Howson 1964)
//!
//! ```text
//! w = [0 P; Q^T 0] z - 1,    0 <= z  _|_  w >= 0,    x = z_1 / sum z_1,    y = z_2 / sum z_2:
//! ```
//!
//! where `x_i > 0` the cost `(P z_2)_i` is 1, and no other cost is lower. On such a problem Lemke's method
//! with a covering vector of ones may end on a ray, although there always is an equilibrium. Then the
//! solver tries other start bases, and in place of the covering vector the column of a pair, which is the
//! method of Lemke and Howson. Which of its attempts succeeds is in `solution.info.attempts`.

use std::error::Error;

use lcp::exact::{EnumerationSettings, Face, enumerate};
use lcp::faer::{Col, Mat, mat};
use lcp::{Attempt, HorizontalLcp, Lcp, Lemke};

/// What the players gain.
struct Game {
    name: &'static str,
    row: Mat<f64>,
    column: Mat<f64>,
}

struct Strategies {
    row: Col<f64>,
    column: Col<f64>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let games = [
        // Equilibria: both choose the first, both the second, or (2/3, 1/3) and (1/3, 2/3) at random.
        Game {
            name: "Battle of the sexes",
            row: mat![[2.0, 0.0], [0.0, 1.0]],
            column: mat![[1.0, 0.0], [0.0, 2.0]],
        },
        // Chapter 3 of Nisan, Roughgarden, Tardos, Vazirani: Algorithmic Game Theory (2007). Equilibria:
        // (1, 0, 0) and (1, 0); (4/5, 1/5, 0) and (2/3, 1/3); (0, 1/3, 2/3) and (1/3, 2/3).
        Game {
            name: "Three rows and two columns",
            row: mat![[3.0, 3.0], [2.0, 5.0], [0.0, 6.0]],
            column: mat![[3.0, 2.0], [2.0, 6.0], [3.0, 1.0]],
        },
        // No pure strategies: whatever the one shows, the other one has a better answer.
        Game {
            name: "Rock, paper, scissors",
            row: mat![[0.0, -1.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 1.0, 0.0]],
            column: mat![[0.0, 1.0, -1.0], [-1.0, 0.0, 1.0], [1.0, -1.0, 0.0]],
        },
    ];
    for game in &games {
        println!("{}", game.name);
        let problem = HorizontalLcp::from(game.problem()?);

        let solution = Lemke::default().solve(&problem)?;
        if !solution.is_solved() {
            return Err(format!("{}: {}", game.name, solution.status).into());
        }
        for attempt in &solution.info.attempts {
            let Attempt { start, covering, end, pivots, .. } = attempt;
            println!("  start {start}, covering vector {covering}: {end:?} after {pivots} pivots");
        }
        game.report(&game.strategies(&solution.t))?;

        let all = enumerate(&problem, &EnumerationSettings::default())?;
        println!("  all equilibria, in rational arithmetic");
        for Face { vertices, dimension, .. } in &all.faces {
            if *dimension > 0 {
                println!("  every mixture of the following {}", vertices.len());
            }
            for vertex in vertices {
                game.report(&game.strategies(&vertex.rounded().0))?;
            }
        }
    }
    Ok(())
}

impl Game {
    fn problem(&self) -> Result<Lcp, lcp::Error> {
        let (rows, n) = (self.row.nrows(), self.row.nrows() + self.row.ncols());
        let [p, q] = [&self.row, &self.column].map(costs);
        let m = Mat::from_fn(n, n, |i, j| match (i < rows, j < rows) {
            (true, false) => p[(i, j - rows)],
            (false, true) => q[(j, i - rows)],
            _ => 0.0,
        });
        Lcp::new(m, vec![-1.0; n])
    }

    fn strategies(&self, z: &[f64]) -> Strategies {
        let (row, column) = z.split_at(self.row.nrows());
        let [row, column] = [row, column].map(|part| {
            let sum: f64 = part.iter().sum();
            Col::from_fn(part.len(), |i| part[i] / sum)
        });
        Strategies { row, column }
    }

    /// Prints the strategies and what they gain, which must be the most that either player could.
    fn report(&self, Strategies { row, column }: &Strategies) -> Result<(), String> {
        let (of_rows, of_columns) = (&self.row * column, self.column.transpose() * row);
        let (gain, column_gain) = (row.transpose() * &of_rows, column.transpose() * &of_columns);
        let strategies = [row, column].map(|strategy| {
            let shares: Vec<String> = strategy.iter().map(|share| format!("{share:.4}")).collect();
            shares.join(", ")
        });
        let [row, column] = strategies;
        println!("    ({row}) gains {gain:.4}, ({column}) gains {column_gain:.4}");
        for (payoffs, gain, matrix) in
            [(of_rows, gain, &self.row), (of_columns, column_gain, &self.column)]
        {
            let best = payoffs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            if best - gain > 1e-12 * matrix.norm_max() {
                return Err(format!("not an equilibrium: {best} could be gained, not {gain}"));
            }
        }
        Ok(())
    }
}

/// Positive costs of the same game.
fn costs(payoffs: &Mat<f64>) -> Mat<f64> {
    let entries = payoffs.col_iter().flat_map(|column| column.iter().copied());
    let largest = entries.fold(f64::NEG_INFINITY, f64::max);
    Mat::from_fn(payoffs.nrows(), payoffs.ncols(), |i, j| largest + 1.0 - payoffs[(i, j)])
}
