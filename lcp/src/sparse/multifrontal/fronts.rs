//! The numerical part: frontal matrices from the leaves of the elimination tree to its roots, and the solves with their
//! factors.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use super::analysis::{Analysis, Supernode};
use crate::parallel::for_each;

/// The factors of a supernode.
pub(super) trait Factor: Send + Sync {
    /// Whether only the lower half of frontal matrices counts.
    const IS_SYMMETRIC: bool;

    /// The first row of a column that counts.
    fn first(column: usize) -> usize {
        if Self::IS_SYMMETRIC { column } else { 0 }
    }

    /// How many numbers of a matrix of an order count.
    fn size(order: usize) -> usize {
        if Self::IS_SYMMETRIC { order * (order + 1) / 2 } else { order * order }
    }

    /// Room for them.
    fn of(node: &Supernode) -> Self;

    /// Eliminates the columns of the supernode in its frontal matrix, and keeps their factors. What is left stands in the
    /// lower right corner. Gives the number of pivots that were replaced.
    fn eliminate(&mut self, node: &Supernode, front: &mut [f64]) -> usize;

    /// Solves with the lower factor: for the variables of the supernode, and what they change of those of its rows. `work`
    /// is memory.
    fn forward(&self, node: &Supernode, x: &mut [f64], work: &mut Vec<f64>);

    /// Solves with the upper factor.
    fn backward(&self, node: &Supernode, x: &mut [f64], work: &mut Vec<f64>);
}

/// The factors of all supernodes.
pub(super) struct Fronts<F> {
    /// Of the groups of the tree.
    groups: Vec<Group<F>>,
    above: Group<F>,
    /// Memory of earlier factorisations.
    spare: Mutex<Vec<Memory>>,
}

/// Supernodes whose fronts one thread eliminates one after the other.
struct Group<F> {
    nodes: Vec<usize>,
    factors: Vec<F>,
    /// Of its supernodes those whose parent is in no group, or in none at all.
    roots: Vec<usize>,
    /// Order of the largest front.
    largest: usize,
}

/// What the roots of a group leave for the supernodes above: the frontal matrices of the rows below them.
type Left = Vec<(usize, Vec<f64>)>;

/// The memory of a thread.
#[derive(Default)]
struct Memory {
    /// The frontal matrix in work.
    front: Vec<f64>,
    /// What supernodes have left that is not assembled yet, one after the other, and their numbers.
    stack: Vec<f64>,
    on_stack: Vec<usize>,
}

impl<F: Factor> Fronts<F> {
    pub(super) fn new(analysis: &Analysis) -> Self {
        let group = |nodes: &Vec<usize>| Group::of(analysis, nodes.clone());
        let groups = analysis.tree.groups.iter().map(group).collect();
        Self { groups, above: group(&analysis.tree.above), spare: Mutex::default() }
    }

    /// The factors of all supernodes, in no order.
    pub(super) fn factors(&self) -> impl Iterator<Item = &F> {
        self.groups.iter().chain([&self.above]).flat_map(|group| &group.factors)
    }

    pub(super) fn factorise(&mut self, analysis: &Analysis, values: &[f64]) -> usize {
        let Self { groups, above, .. } = self;
        let spare = &self.spare;
        let spare = || spare.lock().unwrap_or_else(PoisonError::into_inner);
        let replaced = AtomicUsize::new(0);
        let mut left: Vec<Left> = groups.iter().map(|_| Left::new()).collect();
        for_each(groups.iter_mut().zip(&mut left), |(group, left)| {
            let mut memory = spare().pop().unwrap_or_default();
            let count = group.factorise(analysis, values, Left::new(), &mut memory);
            *left = memory.left::<F>(analysis);
            spare().push(memory);
            replaced.fetch_add(count, Ordering::Relaxed);
        });
        let mut left: Left = left.into_iter().flatten().collect();
        left.sort_by_key(|it| it.0);
        let mut memory = spare().pop().unwrap_or_default();
        let of_above = above.factorise(analysis, values, left, &mut memory);
        spare().push(memory);
        replaced.into_inner() + of_above
    }

    /// Overwrites right-hand sides, one after the other, with the solutions.
    pub(super) fn solve(&self, analysis: &Analysis, x: &mut [f64]) {
        let n = analysis.order.len().max(1);
        let mut ordered = vec![0.0; x.len()];
        for (ordered, x) in ordered.chunks_exact_mut(n).zip(x.chunks_exact(n)) {
            ordered.iter_mut().zip(&analysis.order).for_each(|(v, &i)| *v = x[i]);
        }
        self.forward(analysis, &mut ordered);
        self.backward(analysis, &mut ordered);
        for (ordered, x) in ordered.chunks_exact(n).zip(x.chunks_exact_mut(n)) {
            ordered.iter().zip(&analysis.order).for_each(|(v, &i)| x[i] = *v);
        }
    }

    /// Every group works on variables of its own. What groups change of those above is added up in their order.
    fn forward(&self, analysis: &Analysis, x: &mut [f64]) {
        let n = analysis.order.len();
        let mut moved: Vec<Vec<f64>> = self.groups.iter().map(|_| Vec::new()).collect();
        for_each(self.groups.iter().zip(&mut moved), |(group, moved)| {
            *moved = vec![0.0; x.len()];
            group.copy(analysis, x, moved);
            group.forward(analysis, moved);
        });
        for (group, moved) in self.groups.iter().zip(&mut moved) {
            group.copy(analysis, moved, x);
            for row in group.roots.iter().flat_map(|&root| &analysis.supernodes[root].rows) {
                for start in (0..x.len()).step_by(n) {
                    let at = start + *row as usize;
                    x[at] += std::mem::take(&mut moved[at]);
                }
            }
        }
        self.above.forward(analysis, x);
    }

    fn backward(&self, analysis: &Analysis, x: &mut [f64]) {
        let n = analysis.order.len();
        self.above.backward(analysis, x);
        let mut solved: Vec<Vec<f64>> = self.groups.iter().map(|_| Vec::new()).collect();
        for_each(self.groups.iter().zip(&mut solved), |(group, solved)| {
            *solved = vec![0.0; x.len()];
            group.copy(analysis, x, solved);
            for row in group.roots.iter().flat_map(|&root| &analysis.supernodes[root].rows) {
                for at in (*row as usize..x.len()).step_by(n) {
                    solved[at] = x[at];
                }
            }
            group.backward(analysis, solved);
        });
        for (group, solved) in self.groups.iter().zip(&solved) {
            group.copy(analysis, solved, x);
        }
    }
}

impl<F: Factor> Group<F> {
    fn of(analysis: &Analysis, nodes: Vec<usize>) -> Self {
        let all = &analysis.supernodes;
        let is_root = |s: &usize| all[*s].parent.is_none_or(|it| nodes.binary_search(&it).is_err());
        Self {
            factors: nodes.iter().map(|&s| F::of(&all[s])).collect(),
            roots: nodes.iter().copied().filter(is_root).collect(),
            largest: nodes.iter().map(|&s| all[s].order()).max().unwrap_or(0),
            nodes,
        }
    }

    /// Takes what the roots of other groups left, in their order. What its own leave stays on the stack.
    fn factorise(
        &mut self,
        analysis: &Analysis,
        values: &[f64],
        others: Left,
        memory: &mut Memory,
    ) -> usize {
        let mut others = others.into_iter().peekable();
        memory.front.resize(memory.front.len().max(self.largest * self.largest), 0.0);
        let Memory { front, stack, on_stack } = memory;
        let mut replaced = 0;
        for (&s, factor) in self.nodes.iter().zip(&mut self.factors) {
            while let Some((root, left)) = others.next_if(|it| it.0 < s) {
                on_stack.push(root);
                stack.extend(left);
            }
            let node = &analysis.supernodes[s];
            let order = node.order();
            let front = &mut front[..order * order];
            for (k, column) in front.chunks_exact_mut(order).enumerate() {
                column[F::first(k)..].fill(0.0);
            }
            for entry in &node.entries {
                front[entry.row as usize + order * entry.col as usize] +=
                    values[entry.position as usize];
            }
            // In this order of the tree the last ones are those of the children.
            let children = on_stack.split_off(on_stack.len() - node.children);
            let sizes = children.iter().map(|&child| F::size(analysis.places[child].len()));
            let begin = stack.len() - sizes.sum::<usize>();
            let mut updates = &stack[begin..];
            for child in children {
                let places = &analysis.places[child];
                let (update, rest) = updates.split_at(F::size(places.len()));
                extend_add::<F>(front, order, update, places);
                updates = rest;
            }
            stack.truncate(begin);
            replaced += factor.eliminate(node, front);
            if node.parent.is_some() {
                on_stack.push(s);
                let columns = front[order * node.width..].chunks_exact(order);
                columns.enumerate().for_each(|(k, column)| {
                    stack.extend_from_slice(&column[node.width + F::first(k)..]);
                });
            }
        }
        replaced
    }

    fn forward(&self, analysis: &Analysis, x: &mut [f64]) {
        let mut work = Vec::new();
        for (&s, factor) in self.nodes.iter().zip(&self.factors) {
            for x in x.chunks_exact_mut(analysis.order.len()) {
                factor.forward(&analysis.supernodes[s], x, &mut work);
            }
        }
    }

    fn backward(&self, analysis: &Analysis, x: &mut [f64]) {
        let mut work = Vec::new();
        for (&s, factor) in self.nodes.iter().zip(&self.factors).rev() {
            for x in x.chunks_exact_mut(analysis.order.len()) {
                factor.backward(&analysis.supernodes[s], x, &mut work);
            }
        }
    }

    /// Copies the variables of its supernodes.
    fn copy(&self, analysis: &Analysis, from: &[f64], to: &mut [f64]) {
        let n = analysis.order.len();
        for node in self.nodes.iter().map(|&s| &analysis.supernodes[s]) {
            for start in (node.start..to.len()).step_by(n) {
                let range = start..start + node.width;
                to[range.clone()].copy_from_slice(&from[range]);
            }
        }
    }
}

impl Memory {
    /// What is on the stack.
    fn left<F: Factor>(&mut self, analysis: &Analysis) -> Left {
        let mut stack = &self.stack[..];
        let pieces = self.on_stack.drain(..).map(|root| {
            let (left, rest) = stack.split_at(F::size(analysis.places[root].len()));
            stack = rest;
            (root, left.to_vec())
        });
        let left = pieces.collect();
        self.stack.clear();
        left
    }
}

/// Adds what a child left to the frontal matrix of its parent.
fn extend_add<F: Factor>(front: &mut [f64], order: usize, mut update: &[f64], places: &[u32]) {
    // Places that follow one another: where they begin, and up to which of them.
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (k, &place) in places.iter().enumerate() {
        match runs.last_mut() {
            Some((begin, end)) if *begin + k == place as usize => *end = k + 1,
            _ => runs.push((place as usize - k, k + 1)),
        }
    }
    for (k, &j) in places.iter().enumerate() {
        let target = &mut front[order * j as usize..][..order];
        let mut at = F::first(k);
        let (column, rest) = update.split_at(places.len() - at);
        let mut column = column;
        for &(begin, end) in &runs {
            if end > at {
                let (here, others) = column.split_at(end - at);
                let target = &mut target[begin + at..begin + end];
                target.iter_mut().zip(here).for_each(|(target, v)| *target += v);
                (column, at) = (others, end);
            }
        }
        update = rest;
    }
}
