//! What the benches of sparse methods share: one factorisation, and memory.

use std::time::Instant;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SparseColMat;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::{Par, Side};

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
