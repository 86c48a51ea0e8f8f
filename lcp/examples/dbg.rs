use lcp::*;
fn main() {
    let i = families::infeasible_semidefinite(5, 14786040548551135837);
    let p: HorizontalLcp = i.problem.into();
    println!("{:?} {:?} {:?}", p.a().to_dense(), p.c(), i.known);
    let s = Lemke::default().solve(&p).unwrap();
    println!("{:?}", s.status);
    eprintln!("=====");
    let i = families::horizontal_monotone(7, 6711840722944347227);
    let p = i.problem;
    let s = Lemke::new(LemkeSettings { max_attempts: 1, ..Default::default() }).solve(&p).unwrap();
    println!("{:?} {:?}", s.status, s.residuals);
}
