//! Factorisations of sparse matrices with a symmetric pattern, again and again for other values.

mod analysis;
mod dense;
mod fronts;
mod symmetric;
mod tree;
mod unsymmetric;

use faer::sparse::{FaerError, SymbolicSparseColMatRef};

use analysis::Analysis;
use fronts::Fronts;
use symmetric::Symmetric;
use unsymmetric::Unsymmetric;

/// LU factors of matrices with unsymmetric values: the multifrontal method (Duff and Reid 1983) on a fixed order by approximate minimum degree.
///
/// Pivots are exchanged within a supernode only, so that pattern, order and memory never change. A
/// pivot that vanishes against its column is replaced by a small one, which iterative refinement of the
/// caller has to make good. Costs what two sparse Cholesky factorisations of the pattern cost, nearly
/// all of it in dense matrix products. Independent parts of large matrices are factorised on all cores that the process may
/// use; which of them does what changes no bit of the result.
pub struct Multifrontal {
    analysis: Analysis,
    fronts: Fronts<Unsymmetric>,
}

impl Multifrontal {
    /// For the pattern of a square matrix, which must contain every diagonal entry and with every entry
    /// the mirrored one.
    ///
    /// # Errors
    /// That memory does not suffice.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let analysis = Analysis::of_whole(pattern)?;
        let fronts = Fronts::new(&analysis);
        Ok(Self { analysis, fronts })
    }

    /// Factorises for the values of the entries, in the order of the pattern. Gives the number of pivots
    /// that were replaced.
    pub fn factorise(&mut self, values: &[f64]) -> usize {
        self.fronts.factorise(&self.analysis, values)
    }

    /// Whether the determinant of the last factorised matrix is negative.
    pub(crate) fn is_negative(&self) -> bool {
        self.fronts.factors().fold(false, |negative, factor| negative ^ factor.is_negative())
    }

    /// Overwrites a right-hand side with the solution for the last factorisation.
    pub fn solve(&self, x: &mut [f64]) {
        self.fronts.solve(&self.analysis, x);
    }
}

/// The factors `L D L^T` of symmetric positive definite matrices with one pattern, by the same method.
pub(super) struct Cholesky {
    analysis: Analysis,
    fronts: Fronts<Symmetric>,
}

impl Cholesky {
    /// For the pattern of the lower triangle.
    pub(super) fn new(lower: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let analysis = Analysis::of_lower(lower)?;
        let fronts = Fronts::new(&analysis);
        Ok(Self { analysis, fronts })
    }

    /// Factorises for the values of the entries, in the order of the pattern: those of a matrix of finite numbers whose
    /// diagonal is of order one.
    pub(super) fn factorise(&mut self, values: &[f64]) {
        self.fronts.factorise(&self.analysis, values);
    }

    /// Overwrites right-hand sides, one after the other, with the solutions.
    pub(super) fn solve(&self, x: &mut [f64]) {
        self.fronts.solve(&self.analysis, x);
    }

    /// How many numbers the factors have.
    pub(super) fn stored(&self) -> usize {
        self.fronts.factors().map(Symmetric::stored).sum()
    }
}

#[cfg(test)]
mod tests {
    use faer::sparse::{SparseColMat, Triplet};

    use super::*;
    use crate::parallel::tests::on_cores;
    use crate::random::SplitMix;

    /// A grid of `side x side` nodes with random unsymmetric values and a weak diagonal.
    fn grid(side: usize, seed: u64) -> SparseColMat<usize, f64> {
        let mut random = SplitMix::new(seed);
        let mut uniform = || 2.0 * random.next_f64() - 1.0;
        let mut entries = Vec::new();
        for i in 0..side * side {
            entries.push(Triplet::new(i, i, 4.0 + uniform()));
            let right = (i % side + 1 < side).then_some(i + 1);
            let above = (i / side + 1 < side).then_some(i + side);
            for j in [right, above].into_iter().flatten() {
                entries.push(Triplet::new(i, j, 2.0 * uniform()));
                entries.push(Triplet::new(j, i, 2.0 * uniform()));
            }
        }
        let n = side * side;
        SparseColMat::try_new_from_triplets(n, n, &entries).expect("inside")
    }

    #[test]
    fn solves_unsymmetric_systems_again_and_again() {
        for side in [1, 2, 3, 7, 40] {
            let mut solver = Multifrontal::new(grid(side, 1).symbolic()).expect("memory");
            for seed in 1..4 {
                let matrix = grid(side, seed);
                assert_eq!(solver.factorise(matrix.val()), 0);
                let (mut x, exact) = product(&matrix);
                solver.solve(&mut x);
                assert!(error(&x, &exact) < 1e-11, "side {side}");
            }
        }
    }

    /// The product of a matrix with a vector of whole numbers, and that vector.
    fn product(matrix: &SparseColMat<usize, f64>) -> (Vec<f64>, Vec<f64>) {
        let exact: Vec<f64> = (0..matrix.ncols()).map(|i| (i % 7) as f64 - 3.0).collect();
        let mut image = vec![0.0; exact.len()];
        for (j, exact) in exact.iter().enumerate() {
            crate::problem::column_of(matrix, j).for_each(|(i, v)| image[i] += v * exact);
        }
        (image, exact)
    }

    fn error(x: &[f64], exact: &[f64]) -> f64 {
        x.iter().zip(exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max)
    }

    /// Large enough for several threads. How many there are, and which of them does what, changes no bit.
    #[test]
    fn large_systems_are_solved_the_same_way_on_any_cores() {
        let matrix = grid(600, 3);
        let mut solver = Multifrontal::new(matrix.symbolic()).expect("memory");
        assert!(!solver.analysis.tree.groups.is_empty());
        let (image, exact) = product(&matrix);
        let mut solve = || {
            assert_eq!(solver.factorise(matrix.val()), 0);
            let mut x = image.clone();
            solver.solve(&mut x);
            x
        };
        let x = on_cores(1, &mut solve);
        assert!(error(&x, &exact) < 1e-10);
        assert!([2, 2, 5].iter().all(|&cores| x == on_cores(cores, &mut solve)));
    }

    #[test]
    fn large_symmetric_systems_are_solved_for_several_right_hand_sides() {
        let upper = grid(600, 4);
        let mirrored = upper.triplet_iter().filter(|it| it.row >= it.col);
        let lower: Vec<_> = mirrored.map(|it| Triplet::new(it.row, it.col, *it.val)).collect();
        let n = upper.ncols();
        let off_diagonal = lower.iter().filter(|it| it.row > it.col);
        let both: Vec<_> = off_diagonal
            .map(|it| Triplet::new(it.col, it.row, it.val))
            .chain(lower.iter().copied())
            .map(|it| if it.row == it.col { Triplet { val: 9.0, ..it } } else { it })
            .collect();
        let whole = SparseColMat::try_new_from_triplets(n, n, &both).expect("inside");
        let lower = SparseColMat::try_new_from_triplets(n, n, &lower).expect("inside");
        let values: Vec<f64> =
            lower.triplet_iter().map(|it| if it.row == it.col { 9.0 } else { *it.val }).collect();
        let mut solver = Cholesky::new(lower.symbolic()).expect("memory");
        assert!(!solver.analysis.tree.groups.is_empty());
        let (image, exact) = product(&whole);
        let right = [image.clone(), image.iter().map(|v| 2.0 * v).collect()].concat();
        let mut solve = || {
            solver.factorise(&values);
            let mut x = right.clone();
            solver.solve(&mut x);
            x
        };
        let x = on_cores(1, &mut solve);
        assert!(error(&x[..n], &exact) < 1e-12);
        assert!(x[n..].iter().zip(&x[..n]).all(|(double, x)| (double - 2.0 * x).abs() < 1e-12));
        assert!([2, 2, 5].iter().all(|&cores| x == on_cores(cores, &mut solve)));
    }

    /// Every variable is there twice, so half of the pivots vanish: the others solve the equations. With 150 of them they
    /// are eliminated in several blocks.
    #[test]
    fn variables_with_vanishing_pivots_are_zero() {
        for half in [20, 150] {
            let entry = |i: usize, j: usize| match i.abs_diff(j) {
                0 => 1.0,
                _ => 0.5 / (1.0 + (i + j) as f64),
            };
            let twice = |i: usize, j: usize| entry(i % half, j % half);
            let n = 2 * half;
            let lower: Vec<_> =
                (0..n).flat_map(|j| (j..n).map(move |i| Triplet::new(i, j, twice(i, j)))).collect();
            let lower = SparseColMat::try_new_from_triplets(n, n, &lower).expect("inside");
            let mut factors = Cholesky::new(lower.symbolic()).expect("memory");
            factors.factorise(lower.val());
            let exact = |j: usize| (j % 7) as f64 - 3.0;
            let right = |i: usize| (0..half).map(|j| twice(i, j) * exact(j)).sum::<f64>();
            let mut x: Vec<f64> = (0..n).map(right).collect();
            factors.solve(&mut x);
            let error = |j: usize| (x[j] + x[j + half] - exact(j)).abs();
            assert!((0..half).all(|j| error(j) < 1e-9), "{x:?}");
            let least = |j: usize| x[j].abs().min(x[j + half].abs());
            assert!((0..half).all(|j| least(j) < 1e-9), "{x:?}");
        }
    }

    /// A zero on the diagonal is no obstacle where a pivot can be found in the block, and where none is
    /// the factorisation says so.
    #[test]
    fn vanishing_pivots_are_exchanged_or_counted() {
        let entries = |corner: f64| {
            [(0, 0, 0.0), (0, 1, 2.0), (1, 0, 3.0), (1, 1, corner)]
                .map(|(i, j, v)| Triplet::new(i, j, v))
        };
        let matrix = |corner| {
            SparseColMat::<usize, f64>::try_new_from_triplets(2, 2, &entries(corner))
                .expect("inside")
        };
        let mut solver = Multifrontal::new(matrix(0.0).symbolic()).expect("memory");
        assert_eq!(solver.factorise(matrix(0.0).val()), 0);
        assert!(solver.is_negative());
        let mut x = [2.0, 3.0];
        solver.solve(&mut x);
        assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15), "{x:?}");
        assert_eq!(solver.factorise(&[0.0, 0.0, 0.0, 1.0]), 1);
    }
}
