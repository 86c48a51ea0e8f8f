//! The elimination tree: subtrees that do not depend on one another, and what is above them.

use std::cmp::Reverse;

/// Below so many operations all is done on one thread. Chosen: they take a thousand times as long as a thread to start.
const LEAST_WORK: f64 = 1e9;
/// Groups of subtrees, each for one thread at a time. Results depend on it in their last digits, so it is not the number of
/// cores. Chosen.
const GROUPS: usize = 16;
/// No subtree has more than this part of the whole work. Measured on walls of 100 000 bricks: on two cores with 1/4 to
/// 1/32 all is as fast.
const PART: f64 = 1.0 / 8.0;

/// Supernodes by their numbers, increasing.
#[derive(Debug)]
pub(super) struct Tree {
    /// Groups of whole subtrees.
    pub(super) groups: Vec<Vec<usize>>,
    /// What is above them; all, where the work is small.
    pub(super) above: Vec<usize>,
}

impl Tree {
    /// For the parent of every supernode, which comes after it, and the operations of its elimination.
    pub(super) fn of(parents: &[Option<usize>], mut work: Vec<f64>) -> Self {
        let total: f64 = work.iter().sum();
        let count = parents.len();
        if total < LEAST_WORK {
            return Self { groups: Vec::new(), above: (0..count).collect() };
        }
        for (s, parent) in parents.iter().enumerate() {
            if let Some(parent) = *parent {
                work[parent] += work[s];
            }
        }
        let mut group_of = vec![None; count];
        let is_small = |s: usize| work[s] <= PART * total;
        let is_root =
            |s: &usize| is_small(*s) && parents[*s].is_none_or(|parent| !is_small(parent));
        let mut roots: Vec<usize> = (0..count).filter(is_root).collect();
        roots.sort_by(|a, b| work[*b].total_cmp(&work[*a]));
        let mut loads = [0.0_f64; GROUPS];
        for root in roots {
            let lightest = (0..GROUPS).min_by(|a, b| loads[*a].total_cmp(&loads[*b]));
            let group = lightest.unwrap_or(0);
            loads[group] += work[root];
            group_of[root] = Some(group);
        }
        for s in (0..count).rev() {
            if let Some(parent) = parents[s].filter(|_| group_of[s].is_none()) {
                group_of[s] = group_of[parent];
            }
        }
        let of_group = |group: Option<usize>| -> Vec<usize> {
            (0..count).filter(|&s| group_of[s] == group).collect()
        };
        let mut order: Vec<usize> = (0..GROUPS).filter(|&group| loads[group] > 0.0).collect();
        order.sort_by_key(|&group| Reverse(loads[group].to_bits()));
        let groups = order.into_iter().map(|group| of_group(Some(group))).collect();
        Self { groups, above: of_group(None) }
    }
}
