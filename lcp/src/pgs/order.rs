//! The order of a sweep.

use super::block::Block;
use super::{Rows, SweepOrder};

/// The numbers of the blocks in the order of a sweep.
pub(super) fn order<R: Rows + ?Sized>(rows: &R, blocks: &[Block], by: SweepOrder) -> Vec<usize> {
    let mut order: Vec<usize> = (0..blocks.len()).collect();
    if by == SweepOrder::Coloured
        && let Some(colours) = colours(rows, blocks)
    {
        order.sort_by_key(|&block| colours[block]);
    }
    order
}

/// The least colour that no coupled block before has, for every block; `None` where the couplings are
/// not known.
fn colours<R: Rows + ?Sized>(rows: &R, blocks: &[Block]) -> Option<Vec<usize>> {
    let of_row: Vec<usize> =
        blocks.iter().enumerate().flat_map(|(k, block)| block.rows().map(move |_| k)).collect();
    // A coupling counts whichever of the two rows has it.
    let mut coupled = vec![Vec::new(); blocks.len()];
    for (k, block) in blocks.iter().enumerate() {
        for row in block.rows() {
            for other in rows.neighbours(row)? {
                coupled[k].push(of_row[other]);
                coupled[of_row[other]].push(k);
            }
        }
    }
    let mut colours: Vec<usize> = Vec::with_capacity(blocks.len());
    // Which block a colour was last refused to.
    let mut refused: Vec<usize> = Vec::new();
    for (k, coupled) in coupled.iter().enumerate() {
        for colour in coupled.iter().filter_map(|&other| colours.get(other)) {
            refused[*colour] = k;
        }
        let free = refused.iter().position(|&by| by != k);
        let colour = free.unwrap_or_else(|| {
            refused.push(k);
            refused.len() - 1
        });
        colours.push(colour);
    }
    Some(colours)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::obstacle;
    use crate::pgs::{Constraint, MatrixRows};

    #[test]
    fn the_five_point_laplacian_is_red_and_black() {
        let (side, problem) = (5, obstacle(5).problem);
        let mut rows = MatrixRows::new(problem.m());
        let constraints = vec![Constraint::NONNEGATIVE; side * side];
        let blocks = Block::all(&mut rows, &constraints, crate::Method::GaussSeidel).unwrap();
        let colours = colours(&rows, &blocks).unwrap();
        let expected: Vec<usize> = (0..side * side).map(|i| (i / side + i % side) % 2).collect();
        assert_eq!(colours, expected);
    }
}
