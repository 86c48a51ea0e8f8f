//! LU factorisation of sparse matrices with a symmetric pattern and unsymmetric values, again and
//! again for other values.

mod analysis;
mod fronts;

use faer::sparse::{FaerError, SymbolicSparseColMatRef};

use analysis::Analysis;
use fronts::Fronts;

/// The multifrontal method (Duff and Reid 1983) on a fixed order by approximate minimum degree.
///
/// Pivots are exchanged within a supernode only, so that pattern, order and memory never change. A
/// pivot that vanishes against its column is replaced by a small one, which iterative refinement of the
/// caller has to make good. Costs what two sparse Cholesky factorisations of the pattern cost, nearly
/// all of it in dense matrix products.
pub struct Multifrontal {
    analysis: Analysis,
    fronts: Fronts,
}

impl Multifrontal {
    /// For the pattern of a square matrix, which must contain every diagonal entry and with every entry
    /// the mirrored one.
    ///
    /// # Errors
    /// That memory does not suffice.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let analysis = Analysis::new(pattern)?;
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
        self.fronts.is_negative()
    }

    /// Overwrites a right-hand side with the solution for the last factorisation.
    pub fn solve(&self, x: &mut [f64]) {
        self.fronts.solve(&self.analysis, x);
    }
}

#[cfg(test)]
mod tests {
    use faer::sparse::{SparseColMat, Triplet};

    use super::*;
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
            let n = side * side;
            let mut solver = Multifrontal::new(grid(side, 1).symbolic()).expect("memory");
            for seed in 1..4 {
                let matrix = grid(side, seed);
                assert_eq!(solver.factorise(matrix.val()), 0);
                let exact: Vec<f64> = (0..n).map(|i| (i % 7) as f64 - 3.0).collect();
                let mut x = vec![0.0; n];
                for (j, exact) in exact.iter().enumerate() {
                    crate::problem::column_of(&matrix, j).for_each(|(i, v)| x[i] += v * exact);
                }
                solver.solve(&mut x);
                let error = x.iter().zip(&exact).map(|(x, e)| (x - e).abs()).fold(0.0, f64::max);
                assert!(error < 1e-11, "side {side}: {error}");
            }
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
