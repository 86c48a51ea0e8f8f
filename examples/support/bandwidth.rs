//! What a band solver would store of a contact problem.

use lcp::Contact2d;

/// The semi-bandwidth of `K + C^T C`, in the order of the bricks.
pub(crate) fn semi_bandwidth(problem: &Contact2d) -> usize {
    let stiffness = problem.stiffness().triplet_iter();
    let stiffness = stiffness.filter(|e| *e.val != 0.0).map(|e| e.row.abs_diff(e.col));
    let mut ends = vec![(usize::MAX, 0_usize); problem.points()];
    for matrix in [problem.normal(), problem.tangent()] {
        for entry in matrix.triplet_iter() {
            let (first, last) = ends[entry.row];
            ends[entry.row] = (first.min(entry.col), last.max(entry.col));
        }
    }
    let contacts = ends.iter().map(|(first, last)| last.saturating_sub(*first));
    1 + stiffness.chain(contacts).max().unwrap_or(0)
}
