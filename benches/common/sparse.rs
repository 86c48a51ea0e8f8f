//! What the benches of sparse methods share: one factorisation, and memory.

use std::time::Instant;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Par, Side};
use lcp::Contact2d;

/// The fastest of several runs.
pub(crate) fn fastest<T>(runs: usize, seconds: impl Fn(&T) -> f64, run: impl Fn() -> T) -> T {
    let all = (0..runs).map(|_| run());
    all.min_by(|a, b| seconds(a).total_cmp(&seconds(b))).expect("at least one run")
}

/// Seconds of the symbolic and of the numeric factorisation.
pub(crate) fn cholesky(m: &SparseColMat<usize, f64>) -> (f64, f64) {
    let began = Instant::now();
    let params = CholeskySymbolicParams::default();
    let symbolic =
        factorize_symbolic_cholesky(m.symbolic(), Side::Lower, SymmetricOrdering::Amd, params)
            .expect("memory suffices");
    let seconds = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let mut values = vec![0.0; symbolic.len_val()];
    let requirement = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, <_>::default());
    let mut memory = MemBuffer::new(requirement);
    symbolic
        .factorize_numeric_llt(
            &mut values,
            m.as_ref(),
            Side::Lower,
            <_>::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            <_>::default(),
        )
        .expect("positive definite");
    (seconds, began.elapsed().as_secs_f64())
}

/// `K + k C^T C` with the mean diagonal entry of `K` for `k`, or one where bodies are rigid.
pub(crate) fn condensed(problem: &Contact2d) -> SparseColMat<usize, f64> {
    let n = problem.displacements();
    let k = problem.stiffness();
    let mean: f64 = (0..n).map(|j| k.get(j, j).copied().unwrap_or(0.0)).sum::<f64>() / n as f64;
    let mean = if mean > 0.0 { mean } else { 1.0 };
    let mut entries: Vec<Triplet<usize, usize, f64>> = Vec::new();
    for rows in [problem.normal(), problem.tangent()] {
        let transposed = rows.as_ref().transpose().to_col_major().expect("memory suffices");
        for i in 0..problem.points() {
            let columns = transposed.row_idx_of_col_raw(i).iter().zip(transposed.val_of_col(i));
            let columns: Vec<(usize, f64)> = columns.map(|(j, v)| (*j, *v)).collect();
            for &(i, v) in &columns {
                entries.extend(columns.iter().map(|&(j, w)| Triplet::new(i, j, mean * v * w)));
            }
        }
    }
    entries.extend(k.triplet_iter().map(|entry| Triplet::new(entry.row, entry.col, *entry.val)));
    SparseColMat::try_new_from_triplets(n, n, &entries).expect("memory suffices")
}

/// Largest resident memory since the last [`forget_peak`], where the system tells it.
pub(crate) fn peak() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes / 1024.0)
}

pub(crate) fn forget_peak() {
    // Where the system has no such thing the peak is that of all lines before.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}
