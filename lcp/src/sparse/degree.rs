//! An order of elimination for symmetric patterns.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::{FaerError, SymbolicSparseColMatRef};

/// No variable.
const NONE: u32 = u32::MAX;

/// The variable at every place of an order that fills in little, and the place of every variable, by approximate
/// minimum degree (Amestoy, Davis and Duff 1996), for a symmetric pattern of which the lower triangle is enough.
///
/// Variables with the same neighbours, as those of a body or a node, follow one another: they are ordered as one,
/// which takes a fraction of the time.
pub(super) fn minimum_degree(
    pattern: SymbolicSparseColMatRef<'_, usize>,
) -> Result<(Vec<usize>, Vec<usize>), FaerError> {
    let neighbours = Neighbours::of(pattern);
    let leaders = neighbours.leaders();
    let (members, number) = members(&leaders);
    let count = members.starts.len() - 1;
    let quotient = neighbours.quotient(&members, &number);
    let stored = quotient.others.len();
    let quotient = SymbolicSparseColMatRef::new_checked(
        count,
        count,
        &quotient.starts,
        None,
        &quotient.others,
    );
    let (mut order, mut inverse) = (vec![0_usize; count], vec![0_usize; count]);
    let scratch = amd::order_maybe_unsorted_scratch::<usize>(count, stored);
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
    let stack = MemStack::new(&mut memory);
    amd::order_maybe_unsorted(&mut order, &mut inverse, quotient, <_>::default(), stack)?;
    let order: Vec<usize> = order.iter().flat_map(|&k| members.of(k)).copied().collect();
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(at, &j)| place[j] = at);
    Ok((order, place))
}

/// Lists of numbers, one after the other.
struct Neighbours {
    starts: Vec<usize>,
    others: Vec<usize>,
}

impl Neighbours {
    /// The variables next to every variable, increasing.
    fn of(pattern: SymbolicSparseColMatRef<'_, usize>) -> Self {
        let n = pattern.ncols();
        let below = |j: usize| pattern.row_idx_of_col_raw(j).iter().filter(move |i| **i > j);
        let mut starts = vec![0; n + 1];
        for j in 0..n {
            for &i in below(j) {
                starts[i + 1] += 1;
                starts[j + 1] += 1;
            }
        }
        for j in 0..n {
            starts[j + 1] += starts[j];
        }
        let mut next = starts.clone();
        let mut others = vec![0; starts[n]];
        // Those before a variable come first, in their order; then those behind it.
        for j in 0..n {
            for &i in below(j) {
                others[next[i]] = j;
                next[i] += 1;
            }
        }
        for j in 0..n {
            for &i in below(j) {
                others[next[j]] = i;
                next[j] += 1;
            }
        }
        Self { starts, others }
    }

    fn of_one(&self, j: usize) -> &[usize] {
        &self.others[self.starts[j]..self.starts[j + 1]]
    }

    fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// For every variable the first of those that have the same neighbours, themselves included.
    fn leaders(&self) -> Vec<u32> {
        let n = self.len();
        let mixed = |j: usize| (j as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
        let sum =
            |j: usize| self.of_one(j).iter().fold(mixed(j), |sum, &i| sum.wrapping_add(mixed(i)));
        let sums: Vec<u64> = (0..n).map(sum).collect();
        let mut leaders = vec![NONE; n];
        for j in 0..n {
            if leaders[j] != NONE {
                continue;
            }
            leaders[j] = index(j);
            for &i in self.of_one(j).iter().filter(|i| **i > j) {
                if leaders[i] == NONE && sums[i] == sums[j] && self.is_twin(j, i) {
                    leaders[i] = index(j);
                }
            }
        }
        leaders
    }

    /// Whether two neighbours have all others in common.
    fn is_twin(&self, j: usize, i: usize) -> bool {
        let of_j = self.of_one(j).iter().filter(|k| **k != i);
        let of_i = self.of_one(i).iter().filter(|k| **k != j);
        self.of_one(j).len() == self.of_one(i).len() && of_j.eq(of_i)
    }

    /// The neighbours of groups, by the first of their members.
    fn quotient(&self, members: &Members, number: &[u32]) -> Self {
        let mut quotient = Self { starts: vec![0], others: Vec::new() };
        for k in 0..members.starts.len() - 1 {
            let first = members.of(k)[0];
            // Of every other group the first member stands for all.
            let others = self.of_one(first).iter().map(|&i| number[i] as usize);
            let begin = quotient.others.len();
            quotient.others.extend(others.filter(|&other| other != k));
            quotient.others[begin..].sort_unstable();
            let mut end = begin;
            for at in begin..quotient.others.len() {
                let other = quotient.others[at];
                if end == begin || quotient.others[end - 1] != other {
                    quotient.others[end] = other;
                    end += 1;
                }
            }
            quotient.others.truncate(end);
            quotient.starts.push(end);
        }
        quotient
    }
}

/// The members of groups of variables, one group after the other.
struct Members {
    starts: Vec<usize>,
    list: Vec<usize>,
}

impl Members {
    fn of(&self, group: usize) -> &[usize] {
        &self.list[self.starts[group]..self.starts[group + 1]]
    }
}

/// The members of every group, which its first member leads, and the group of every variable.
fn members(leaders: &[u32]) -> (Members, Vec<u32>) {
    let mut number = vec![NONE; leaders.len()];
    let mut starts = vec![0];
    for (j, &leader) in leaders.iter().enumerate() {
        if leader as usize == j {
            number[j] = index(starts.len() - 1);
            starts.push(0);
        } else {
            number[j] = number[leader as usize];
        }
        starts[number[j] as usize + 1] += 1;
    }
    for k in 1..starts.len() {
        starts[k] += starts[k - 1];
    }
    let mut next = starts.clone();
    let mut list = vec![0; leaders.len()];
    for (j, &group) in number.iter().enumerate() {
        list[next[group as usize]] = j;
        next[group as usize] += 1;
    }
    (Members { starts, list }, number)
}

fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or_else(|_| unreachable!("more than 2^32 rows do not fit in memory"))
}

#[cfg(test)]
mod tests {
    use faer::sparse::{SparseColMat, Triplet};

    use super::*;

    /// Of a star of bodies with three variables each the one in the middle comes last, and all variables of a body follow
    /// one another.
    #[test]
    fn variables_of_a_body_follow_one_another() {
        let arms = 9;
        let mut entries = Vec::new();
        for body in 0..=arms {
            for other in [0, body] {
                for (i, j) in (0..9).map(|k| (3 * body + k / 3, 3 * other + k % 3)) {
                    entries.push(Triplet::new(i.max(j), i.min(j), 1.0));
                }
            }
        }
        let n = 3 * (arms + 1);
        let pattern = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &entries)
            .expect("entries lie inside");
        let (order, place) = minimum_degree(pattern.symbolic()).expect("memory");
        for (at, &j) in order.iter().enumerate() {
            assert_eq!(place[j], at);
            assert_eq!(order[at - at % 3] / 3, j / 3);
        }
        // With one arm left it does not matter which of the two is the last.
        assert!(place[0] / 3 >= arms - 1, "{order:?}");
    }
}
