//! Classes of matrices in the standard form, with random integers.

use faer::Mat;

use super::{Instance, Integers, KnownAnswer, Planting, planted, standard, with_solution};
use lcp::Lcp;

/// Positive definite and not symmetric: `M = C C^T + K - K^T + 1`, with its one solution planted.
pub fn positive_definite(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let m = gram(&random.matrix(n, n, -2, 2)) + random.skew(n) + Mat::<f64>::identity(n, n);
    planted(m, &mut random, Planting::Unique)
}

/// Positive semidefinite, not symmetric, `C C^T` of half the order, with a planted solution in which
/// half of the pairs are degenerate.
pub fn positive_semidefinite(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let m = gram(&random.matrix(n, n / 2, -2, 2)) + random.skew(n);
    planted(m, &mut random, Planting::Degenerate)
}

/// A P-matrix that is far from positive definite: rows in which the diagonal outweighs the rest, with
/// rows and columns multiplied by powers of two, and its one solution planted.
///
/// Row dominance with a positive diagonal makes all principal minors positive, and scaling keeps
/// their signs (Cottle, Pang and Stone 1992, section 3.3).
pub fn p_matrix(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let mut m = random.matrix(n, n, -3, 3);
    for i in 0..n {
        let others: f64 = (0..n).filter(|j| *j != i).map(|j| m[(i, j)].abs()).sum();
        m[(i, i)] = others + 1.0;
    }
    let rows = random.vector(n, -5, 5);
    let columns = random.vector(n, -5, 5);
    let m = Mat::from_fn(n, n, |i, j| (rows[i] + columns[j]).exp2() * m[(i, j)]);
    planted(m, &mut random, Planting::Unique)
}

/// Strictly copositive, neither symmetric nor semidefinite: nonnegative entries, positive on the
/// diagonal, plus a skew matrix. There is a solution for every `q`.
pub fn strictly_copositive(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let m = nonnegative(&mut random, n) + random.skew(n);
    let q = random.vector(n, -4, 1);
    Instance { problem: standard(m, q), known: KnownAnswer::Solvable }
}

/// Copositive-plus and not strictly so: a strictly copositive block and zeros, plus a semidefinite
/// matrix and a skew one, with a planted solution.
///
/// Sums of copositive-plus matrices are copositive-plus.
pub fn copositive_plus(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let block = nonnegative(&mut random, n / 2);
    let m = gram(&random.matrix(n, n / 4, -2, 2)) + random.skew(n);
    let m =
        Mat::from_fn(n, n, |i, j| m[(i, j)] + if i.max(j) < n / 2 { block[(i, j)] } else { 0.0 });
    planted(m, &mut random, Planting::Degenerate)
}

/// Of no class: random integers with a planted solution.
pub fn indefinite(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let m = random.matrix(n, n, -5, 5);
    planted(m, &mut random, Planting::Strict)
}

/// P0 and sparse: lower triangular with zeros and ones on its diagonal, with a planted solution. The diagonal does not
/// decide the side of a pair with a zero there, and paths of pivots end on rays.
pub fn triangular(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let mut m = random.matrix(n, n, -3, 3);
    for i in 0..n {
        for j in 0..n {
            if j > i || (j < i && random.index(n) >= 4) {
                m[(i, j)] = 0.0;
            }
        }
        m[(i, i)] = random.next(0, 1);
    }
    planted(m, &mut random, Planting::Strict)
}

/// Nothing but ties: the pairs form about `n / 3` groups, `m_ij = 1` within a group and 0 elsewhere, and the `z` of
/// every group must add up to the same number.
pub fn ties(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let groups: Vec<usize> = (0..n).map(|_| random.index(n / 3 + 1)).collect();
    let m = Mat::from_fn(n, n, |i, j| f64::from(u8::from(groups[i] == groups[j])));
    let is_first = |i: usize| !groups[..i].contains(&groups[i]);
    let t: Vec<f64> = (0..n).map(|i| f64::from(u8::from(is_first(i)))).collect();
    let y = vec![0.0; n];
    Instance { problem: with_solution(m, &t, &y), known: KnownAnswer::Solution { t, y } }
}

/// Positive definite of the kind of Harker and Pang (Lectures in Applied Mathematics 26, 1990):
/// `M = A^T A + S + D`, `A` and the skew `S` in (-5, 5), `D` diagonal in (0, 0.3), `q` in (-500, 500).
///
/// The answer is unique and not known in advance.
pub fn harker_pang(n: usize, seed: u64) -> Instance<Lcp> {
    let mut random = lcp::SplitMix::new(seed);
    let mut within = |size: f64| size * (2.0 * random.next_f64() - 1.0);
    let a = Mat::from_fn(n, n, |_, _| within(5.0));
    let s = Mat::from_fn(n, n, |_, _| within(5.0));
    let d: Vec<f64> = (0..n).map(|_| within(0.15) + 0.15).collect();
    let ata = a.transpose() * &a;
    let m = Mat::from_fn(n, n, |i, j| match i.cmp(&j) {
        std::cmp::Ordering::Less => ata[(i, j)] + s[(i, j)],
        std::cmp::Ordering::Equal => ata[(i, i)] + d[i],
        std::cmp::Ordering::Greater => ata[(i, j)] - s[(j, i)],
    });
    let q = (0..n).map(|_| within(500.0)).collect();
    Instance { problem: standard(m, q), known: KnownAnswer::Solvable }
}

/// The equilibria of a game of two players, each with one choice at least, with costs `P`, `Q` of 1
/// to 9 (Lemke and Howson 1964): `M = [0 P; Q^T 0]`, `q = -1`.
///
/// A solution exists, but `M` is not copositive-plus: a ray proves nothing.
pub fn bimatrix(rows: usize, columns: usize, seed: u64) -> Instance<Lcp> {
    let mut random = Integers::new(seed);
    let (rows, columns) = (rows.max(1), columns.max(1));
    let n = rows + columns;
    let costs = random.matrix(n, n, 1, 9);
    let m = Mat::from_fn(n, n, |i, j| if (i < rows) == (j < rows) { 0.0 } else { costs[(i, j)] });
    Instance { problem: standard(m, vec![-1.0; n]), known: KnownAnswer::Solvable }
}

/// A symmetric positive semidefinite problem, of order 2 at least, in which two rows of `M` add up to
/// zero and their `q` to less: Lemke's method proves that there is no solution.
pub fn infeasible_semidefinite(n: usize, seed: u64) -> Instance<Lcp> {
    let n = n.max(2);
    let mut random = Integers::new(seed);
    let first = random.index(n);
    let second = (first + 1 + random.index(n - 1)) % n;
    let mut c = random.matrix(n, n / 2 + 1, -2, 2);
    (0..c.ncols()).for_each(|k| c[(second, k)] = -c[(first, k)]);
    let mut q = random.vector(n, -3, 3);
    q[second] = -q[first] - 1.0;
    let mut farkas = vec![0.0; n];
    (farkas[first], farkas[second]) = (-1.0, -1.0);
    Instance { problem: standard(gram(&c), q), known: KnownAnswer::Infeasible { farkas } }
}

fn gram(c: &Mat<f64>) -> Mat<f64> {
    c * c.transpose()
}

/// Entries of 0 to 3, and 1 to 3 on the diagonal.
fn nonnegative(random: &mut Integers, n: usize) -> Mat<f64> {
    let entries = random.matrix(n, n, 0, 3);
    let diagonal = random.vector(n, 1, 3);
    Mat::from_fn(n, n, |i, j| if i == j { diagonal[i] } else { entries[(i, j)] })
}
