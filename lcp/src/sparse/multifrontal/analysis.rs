//! The order of elimination, the supernodes, and where every entry goes.

use faer::Side;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{FaerError, SymbolicSparseColMatRef};

/// Columns that are eliminated together, and the rows below them.
#[derive(Debug)]
pub(super) struct Supernode {
    /// The first column, and how many.
    pub(super) start: usize,
    pub(super) width: usize,
    /// Rows below the columns, increasing, by their place in the order.
    pub(super) rows: Vec<u32>,
    pub(super) parent: Option<usize>,
    /// Entries of the matrix that are assembled here.
    pub(super) entries: Vec<Entry>,
}

impl Supernode {
    /// Order of the frontal matrix.
    pub(super) fn order(&self) -> usize {
        self.width + self.rows.len()
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
}

impl Analysis {
    pub(super) fn new(pattern: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, FaerError> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic =
            factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Amd, params)?;
        let n = pattern.ncols();
        let (order, place) = match symbolic.perm() {
            Some(perm) => {
                let (order, place) = perm.arrays();
                (order.to_vec(), place.to_vec())
            }
            None => ((0..n).collect(), (0..n).collect()),
        };
        let mut supernodes = supernodes(symbolic.raw());
        let mut of_column = vec![0_usize; n];
        for (s, node) in supernodes.iter().enumerate() {
            of_column[node.start..node.start + node.width].fill(s);
        }
        for node in &mut supernodes {
            node.rows.sort_unstable();
            node.parent = node.rows.first().map(|row| of_column[*row as usize]);
        }
        let starts = pattern.col_ptr();
        for j in 0..n {
            for (k, &i) in pattern.row_idx_of_col_raw(j).iter().enumerate() {
                let (row, col) = (place[i], place[j]);
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
        Ok(Self { order, supernodes, places })
    }
}

fn supernodes(raw: &SymbolicCholeskyRaw<usize>) -> Vec<Supernode> {
    let node = |start, width, rows: &[usize]| {
        let rows = rows.iter().map(|row| index(*row)).collect();
        Supernode { start, width, rows, parent: None, entries: Vec::new() }
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
