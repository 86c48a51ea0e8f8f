//! Equilibria of games of two players as linear complementarity problems, with the crate `lcp` alone.
//!
//! The row player plays row `i` with probability `x_i` and gains `a_ij` on average, the column player
//! column `j` with `y_j` and gains `b_ij`. With the positive costs `P = max a + 1 - A` and
//! `Q = max b + 1 - B`, which change nothing in the game, an equilibrium is, up to scale, a solution of
//! (Lemke and Howson 1964)
//!
//! ```text
//! w = [0 P; Q^T 0] z - 1,    0 <= z  _|_  w >= 0,    x = z_1 / sum z_1,    y = z_2 / sum z_2
//! ```
//!
//! Lemke's method with a covering vector of ones may end on a ray here. Then the solver tries other
//! covering vectors and start bases, and the column of a pair in place of the covering vector, which is the
//! method of Lemke and Howson, until it has one of the equilibria.

use std::error::Error;

use lcp::faer::{Col, Mat, mat};
use lcp::{HorizontalLcp, Lcp, Lemke, Solver};
use lcp_problems::exact::{EnumerationSettings, enumerate};

fn main() -> Result<(), Box<dyn Error>> {
    // Both choose the first, both the second, or (2/3, 1/3) and (1/3, 2/3) at random.
    let battle = (mat![[2.0, 0.0], [0.0, 1.0]], mat![[1.0, 0.0], [0.0, 2.0]]);
    // Nisan, Roughgarden, Tardos, Vazirani: Algorithmic Game Theory (2007), chapter 3. Equilibria:
    // (1, 0, 0) and (1, 0); (4/5, 1/5, 0) and (2/3, 1/3); (0, 1/3, 2/3) and (1/3, 2/3).
    let rows = (mat![[3.0, 3.0], [2.0, 5.0], [0.0, 6.0]], mat![[3.0, 2.0], [2.0, 6.0], [3.0, 1.0]]);
    for (name, (a, b)) in [("Battle of the sexes", battle), ("Three rows, two columns", rows)] {
        let problem = HorizontalLcp::from(game(&a, &b)?);
        let solution = Lemke::default().solve(&problem)?;
        println!("{name}: {}", solution.status);
        for attempt in &solution.info.attempts {
            println!("  covering vector {}: {:?}", attempt.covering, attempt.end);
        }
        report(&a, &b, &solution.t)?;
        println!("  all equilibria, in rational arithmetic");
        let all = enumerate(&problem, &EnumerationSettings::default())?;
        for vertex in all.faces.iter().flat_map(|face| &face.vertices) {
            report(&a, &b, &vertex.rounded().0)?;
        }
    }
    Ok(())
}

fn game(a: &Mat<f64>, b: &Mat<f64>) -> Result<Lcp, lcp::Error> {
    let largest = |gains: &Mat<f64>| {
        (0..gains.ncols()).flat_map(|j| gains.col_as_slice(j)).fold(0.0, |max: f64, g| max.max(*g))
    };
    let (rows, n) = (a.nrows(), a.nrows() + a.ncols());
    let (p, q) = (largest(a) + 1.0, largest(b) + 1.0);
    let m = Mat::from_fn(n, n, |i, j| match (i < rows, j < rows) {
        (true, false) => p - a[(i, j - rows)],
        (false, true) => q - b[(j, i - rows)],
        _ => 0.0,
    });
    Lcp::new(m, vec![-1.0; n])
}

/// Prints the strategies and what they gain, which must be the most that either player could.
fn report(a: &Mat<f64>, b: &Mat<f64>, z: &[f64]) -> Result<(), String> {
    let strategy = |part: &[f64]| Col::from_fn(part.len(), |i| part[i] / part.iter().sum::<f64>());
    let (x, y) = (strategy(&z[..a.nrows()]), strategy(&z[a.nrows()..]));
    let (of_rows, of_columns) = (a * &y, b.transpose() * &x);
    let (gain, column_gain) = (x.transpose() * &of_rows, y.transpose() * &of_columns);
    println!("    {x:.4?} gains {gain:.4}, {y:.4?} gains {column_gain:.4}");
    for (payoffs, gain) in [(of_rows, gain), (of_columns, column_gain)] {
        let best = payoffs.iter().fold(f64::NEG_INFINITY, |best, payoff| best.max(*payoff));
        if best - gain > 1e-12 * payoffs.norm_max() {
            return Err(format!("not an equilibrium: {best} could be gained, not {gain}"));
        }
    }
    Ok(())
}
