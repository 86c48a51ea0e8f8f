//! The order of elimination, the supernodes, and where every entry goes.

use faer::Side;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SymbolicSparseColMatRef};

use super::tree::Tree;

/// Columns that are eliminated together, and the rows below them.
#[derive(Debug)]
pub(super) struct Supernode {
    /// The first column, and how many.
    pub(super) start: usize,
    pub(super) width: usize,
    /// Rows below the columns, increasing, by their place in the order.
    pub(super) rows: Vec<u32>,
    pub(super) parent: Option<usize>,
    /// How many supernodes it is the parent of.
    pub(super) children: usize,
    /// Entries of the matrix that are assembled here.
    pub(super) entries: Vec<Entry>,
}

impl Supernode {
    /// Order of the frontal matrix.
    pub(super) fn order(&self) -> usize {
        self.width + self.rows.len()
    }

    /// About how many operations its elimination takes.
    pub(super) fn work(&self) -> f64 {
        self.width as f64 * (self.order() * self.order()) as f64
    }

    /// The place of a variable in the frontal matrix.
    fn local(&self, variable: usize) -> usize {
        if variable < self.start + self.width {
            return variable - self.start;
        }
        let found = self.rows.binary_search_by(|row| (*row as usize).cmp(&variable));
        self.width + found.unwrap_or_else(|_| unreachable!("the pattern of a supernode is closed"))
    }
}

/// An entry of the matrix and its place in the frontal matrix.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) row: u32,
    pub(super) col: u32,
    pub(super) position: u32,
}

#[derive(Debug)]
pub(super) struct Analysis {
    /// The variable at every place of the order.
    pub(super) order: Vec<usize>,
    /// Children before their parents.
    pub(super) supernodes: Vec<Supernode>,
    /// For every supernode the places in the frontal matrix of its parent of the rows below it.
    pub(super) places: Vec<Vec<u32>>,
    pub(super) tree: Tree,
}

impl Analysis {
    /// For a symmetric pattern.
    pub(super) fn of_whole(pattern: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        Self::new(pattern, false)
    }

    /// For the lower triangle of one.
    pub(super) fn of_lower(pattern: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        Self::new(pattern, true)
    }

    fn new(pattern: SymbolicSparseColMatRef<'_, usize>, is_lower: bool) -> Result<Self, FaerError> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let order = SymmetricOrdering::Amd;
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, order, params)?;
        let n = pattern.ncols();
        let mut order =
            symbolic.perm().map_or_else(|| (0..n).collect(), |it| it.arrays().0.to_vec());
        let mut supernodes = postordered(&supernodes(symbolic.raw()), &mut order);
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(at, &i)| place[i] = at);
        let of_column = of_columns(&supernodes, n);
        let starts = pattern.col_ptr();
        for j in 0..n {
            for (k, &i) in pattern.row_idx_of_col_raw(j).iter().enumerate() {
                let (mut row, mut col) = (place[i], place[j]);
                if is_lower && row < col {
                    (row, col) = (col, row);
                }
                let node = &mut supernodes[of_column[row.min(col)]];
                let (row, col) = (index(node.local(row)), index(node.local(col)));
                node.entries.push(Entry { row, col, position: index(starts[j] + k) });
            }
        }
        let places = supernodes
            .iter()
            .map(|node| {
                let parent = node.parent.map(|parent| &supernodes[parent]);
                let local = |row: &u32| parent.map(|parent| index(parent.local(*row as usize)));
                node.rows.iter().filter_map(local).collect()
            })
            .collect();
        let parents: Vec<Option<usize>> = supernodes.iter().map(|node| node.parent).collect();
        let tree = Tree::of(&parents, supernodes.iter().map(Supernode::work).collect());
        Ok(Self { order, supernodes, places, tree })
    }
}

/// The supernode of every column.
fn of_columns(supernodes: &[Supernode], n: usize) -> Vec<usize> {
    let mut of_column = vec![0; n];
    for (s, node) in supernodes.iter().enumerate() {
        of_column[node.start..node.start + node.width].fill(s);
    }
    of_column
}

/// Supernodes with their parents, and sorted so that every subtree follows on another, its root at its end; the order of
/// the variables goes with them.
fn postordered(nodes: &[Supernode], order: &mut Vec<usize>) -> Vec<Supernode> {
    let count = nodes.len();
    let of_column = of_columns(nodes, order.len());
    let parent = |node: &Supernode| node.rows.iter().min().map(|row| of_column[*row as usize]);
    let parents: Vec<Option<usize>> = nodes.iter().map(parent).collect();
    let mut sizes = vec![1; count];
    for (s, parent) in parents.iter().enumerate() {
        if let Some(parent) = *parent {
            sizes[parent] += sizes[s];
        }
    }
    // Where the next subtree below a supernode ends, from the last one to the first; behind them, of the whole.
    let mut ends = vec![count; count + 1];
    let mut sorted = vec![0; count];
    for s in (0..count).rev() {
        let above = parents[s].unwrap_or(count);
        let at = ends[above] - 1;
        ends[above] -= sizes[s];
        (ends[s], sorted[at]) = (at, s);
    }
    let mut moved = vec![0; order.len()];
    let mut start = 0;
    for node in sorted.iter().map(|&s| &nodes[s]) {
        (0..node.width).for_each(|k| moved[node.start + k] = start + k);
        start += node.width;
    }
    let before = std::mem::replace(order, vec![0; moved.len()]);
    before.into_iter().zip(&moved).for_each(|(variable, &to)| order[to] = variable);
    let mut places = vec![0; count];
    sorted.iter().enumerate().for_each(|(at, &s)| places[s] = at);
    let mut children = vec![0; count];
    parents.iter().flatten().for_each(|&parent| children[parent] += 1);
    let new = |&s: &usize| {
        let node = &nodes[s];
        let mut rows: Vec<u32> = node.rows.iter().map(|row| index(moved[*row as usize])).collect();
        rows.sort_unstable();
        let parent = parents[s].map(|parent| places[parent]);
        let (start, children) = (moved[node.start], children[s]);
        Supernode { start, width: node.width, rows, parent, children, entries: Vec::new() }
    };
    sorted.iter().map(new).collect()
}

fn supernodes(raw: &SymbolicCholeskyRaw<usize>) -> Vec<Supernode> {
    let node = |start, width, rows: &[usize]| {
        let rows = rows.iter().map(|row| index(*row)).collect();
        Supernode { start, width, rows, parent: None, children: 0, entries: Vec::new() }
    };
    match raw {
        SymbolicCholeskyRaw::Supernodal(raw) => (0..raw.n_supernodes())
            .map(|s| {
                let (start, end) = (raw.supernode_begin()[s], raw.supernode_end()[s]);
                node(start, end - start, raw.supernode(s).pattern())
            })
            .collect(),
        // Where there is nothing to eliminate faer does not look for supernodes.
        SymbolicCholeskyRaw::Simplicial(raw) => raw
            .col_ptr()
            .windows(2)
            .enumerate()
            .map(|(j, range)| {
                let rows = &raw.row_idx()[range[0]..range[1]];
                let below: Vec<usize> = rows.iter().copied().filter(|&i| i != j).collect();
                node(j, 1, &below)
            })
            .collect(),
    }
}

fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or_else(|_| unreachable!("more than 2^32 entries do not fit in memory"))
}
