use std::time::Instant;

use faer::Par;
use faer::Side;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use lcp::families::{Ground, Obstacle};
use lcp::{Lcp, Matrix, SemismoothNewton, SemismoothNewtonSettings, Solver, WarmStart};

fn main() {
    let args: Vec<String> = std::env::args().collect();
    if !args.iter().any(|a| a == "--bench") {
        return;
    }
    for ground in [Ground::Disc { radius: 0.6 }, Ground::Hills { count: 3 }] {
        for side in [100, 316, 1000] {
            let fine = Obstacle::new(side, side, ground);
            let problem = fine.problem();
            let (symbolic, numeric) = cholesky(&problem);
            println!("{ground:?} {side}: symbolic {symbolic:.3} numeric {numeric:.3}");
            let mut sides = vec![side];
            while sides[0] >= 40 {
                sides.insert(0, sides[0] / 2);
            }
            let began = Instant::now();
            let mut last: Option<(Obstacle, Vec<f64>)> = None;
            for s in sides {
                let t = Instant::now();
                let grid = Obstacle::new(s, s, ground);
                let problem = grid.problem();
                let t1 = t.elapsed().as_secs_f64();
                let start = match &last {
                    None => WarmStart::None,
                    Some((c, z)) => grid.refined_start(c, z).unwrap(),
                };
                let t2 = t.elapsed().as_secs_f64();
                let settings = SemismoothNewtonSettings { start, ..Default::default() };
                let sol = SemismoothNewton::new(settings).solve(&problem).unwrap();
                let free = sol.t.iter().filter(|z| **z > 0.0).count() as f64 / sol.t.len() as f64;
                println!(
                    "  {s}: {:?} it {} fac {} nat {:.1e} eq {:.1e} free {free:.2} make {t1:.3} start {:.3} solve {:.3} (inner {:.3}) {:?}",
                    sol.status,
                    sol.info.iterations,
                    sol.info.factorisations,
                    sol.residuals.natural,
                    sol.residuals.equation,
                    t2 - t1,
                    t.elapsed().as_secs_f64() - t2,
                    sol.info.seconds,
                    sol.info.history
                );
                last = Some((grid, sol.t));
            }
            let total = began.elapsed().as_secs_f64();
            println!("total {total:.3} ratio {:.2}", total / (symbolic + numeric));
            let status = std::fs::read_to_string("/proc/self/status").unwrap();
            println!("{}", status.lines().find(|l| l.starts_with("VmHWM")).unwrap());
        }
    }
}

fn cholesky(problem: &Lcp) -> (f64, f64) {
    let Matrix::Sparse(m) = problem.m() else { unreachable!() };
    let began = Instant::now();
    let s = factorize_symbolic_cholesky(
        m.symbolic(),
        Side::Lower,
        SymmetricOrdering::Amd,
        CholeskySymbolicParams::default(),
    )
    .unwrap();
    let symbolic = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let mut l = vec![0.0; s.len_val()];
    let mut mem =
        MemBuffer::new(s.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()));
    s.factorize_numeric_llt(
        &mut l,
        m.as_ref(),
        Side::Lower,
        Default::default(),
        Par::Seq,
        MemStack::new(&mut mem),
        Default::default(),
    )
    .unwrap();
    (symbolic, began.elapsed().as_secs_f64())
}
