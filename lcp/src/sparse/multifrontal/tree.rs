//! The elimination tree: subtrees that do not depend on one another, and what is above them.

use std::cmp::Reverse;

use super::analysis::Supernode;

/// Operations for which threads are not worth their start. Measured: a start takes as long as some 1e6.
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
    pub(super) fn of(supernodes: &[Supernode]) -> Self {
        let mut work: Vec<f64> = supernodes.iter().map(Supernode::work).collect();
        let total: f64 = work.iter().sum();
        let everything = || (0..supernodes.len()).collect();
        if total < LEAST_WORK {
            return Self { groups: Vec::new(), above: everything() };
        }
        for (s, node) in supernodes.iter().enumerate() {
            if let Some(parent) = node.parent {
                work[parent] += work[s];
            }
        }
        let mut group_of = vec![None; supernodes.len()];
        let is_small = |s: usize| work[s] <= PART * total;
        let is_root = |s: &usize| {
            is_small(*s) && supernodes[*s].parent.is_none_or(|parent| !is_small(parent))
        };
        let mut roots: Vec<usize> = (0..supernodes.len()).filter(is_root).collect();
        roots.sort_by(|a, b| work[*b].total_cmp(&work[*a]));
        let mut loads = [0.0_f64; GROUPS];
        for root in roots {
            let lightest = (0..GROUPS).min_by(|a, b| loads[*a].total_cmp(&loads[*b]));
            let group = lightest.unwrap_or(0);
            loads[group] += work[root];
            group_of[root] = Some(group);
        }
        // Parents come after their children.
        for s in (0..supernodes.len()).rev() {
            if let Some(parent) = supernodes[s].parent.filter(|_| group_of[s].is_none()) {
                group_of[s] = group_of[parent];
            }
        }
        let of_group = |group: Option<usize>| -> Vec<usize> {
            (0..supernodes.len()).filter(|&s| group_of[s] == group).collect()
        };
        let mut order: Vec<usize> = (0..GROUPS).filter(|&group| loads[group] > 0.0).collect();
        order.sort_by_key(|&group| Reverse(loads[group].to_bits()));
        let groups = order.into_iter().map(|group| of_group(Some(group))).collect();
        Self { groups, above: of_group(None) }
    }
}
