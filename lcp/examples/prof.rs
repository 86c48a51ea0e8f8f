use faer::Mat; use lcp::*;
fn wave(k: usize) -> f64 { let x = (k as f64 * 12.9898).sin() * 43_758.545_3; x - x.floor() - 0.5 }
fn main(){ let n=1600; let c = Mat::from_fn(n, n, |i, j| wave(i * n + j));
 let m = &c * c.transpose() + Mat::<f64>::identity(n, n); let q = (0..n).map(|i| wave(n * n + i)).collect();
 let p: HorizontalLcp = Lcp::new(m, q).unwrap().into();
 for _ in 0..20 { let s=Lemke::default().solve(&p).unwrap(); println!("{} {}", s.info.pivots, s.info.seconds*1e3); } }
