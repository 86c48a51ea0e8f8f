//! Equivalent problems, with the way back of their solutions.

use lcp::HorizontalLcp;
use lcp::faer::Mat;

/// A point `(t, y)`.
pub type Point = (Vec<f64>, Vec<f64>);

/// A problem, and what makes solutions of the original one out of its solutions.
pub struct Equivalent {
    pub name: String,
    pub problem: HorizontalLcp,
    pub back: Box<dyn Fn(&Point) -> Point>,
    /// Rows are sums of several of the original ones.
    pub are_rows_mixed: bool,
}

impl Equivalent {
    /// The original problem itself.
    pub fn original(problem: HorizontalLcp) -> Self {
        Self {
            name: "as it stands".to_owned(),
            problem,
            back: Box::new(Point::clone),
            are_rows_mixed: false,
        }
    }

    /// Another transformation after those so far.
    pub fn then(self, transform: impl FnOnce(&HorizontalLcp) -> Self) -> Self {
        let next = transform(&self.problem);
        let (first, second) = (self.back, next.back);
        Self {
            name: format!("{}, {}", self.name, next.name),
            problem: next.problem,
            back: Box::new(move |point| first(&second(point))),
            are_rows_mixed: self.are_rows_mixed || next.are_rows_mixed,
        }
    }
}

/// `(M, q) -> (s M, r q)`: `t` becomes `r / s t` and `y` becomes `r y`.
///
/// The columns of a free variable, which are opposite, both belong to `M`.
pub fn scaled(problem: &HorizontalLcp, s: f64, r: f64) -> Equivalent {
    let n = problem.order();
    let (a, b) = (problem.a().to_dense(), problem.b().to_dense());
    let y_factor: Vec<f64> = (0..n)
        .map(|j| if (0..n).all(|i| b[(i, j)] + a[(i, j)] == 0.0) { s } else { 1.0 })
        .collect();
    let scaled = HorizontalLcp::new(
        Mat::from_fn(n, n, |i, j| s * a[(i, j)]),
        Mat::from_fn(n, n, |i, j| y_factor[j] * b[(i, j)]),
        problem.c().iter().map(|c| r * c).collect::<Vec<f64>>(),
    );
    Equivalent {
        are_rows_mixed: false,
        name: format!("M times {s:e}, q times {r:e}"),
        problem: scaled.unwrap(),
        back: Box::new(move |(t, y)| {
            let t = t.iter().map(|t| t * s / r).collect();
            (t, y.iter().zip(&y_factor).map(|(y, factor)| y * factor / r).collect())
        }),
    }
}

/// Every row and every variable in units of its own; the columns of a free variable, which are opposite, in the same.
pub fn rescaled(problem: &HorizontalLcp, rows: &[f64], t: Vec<f64>, mut y: Vec<f64>) -> Equivalent {
    let n = problem.order();
    let (a, b) = (problem.a().to_dense(), problem.b().to_dense());
    for j in 0..n {
        if (0..n).all(|i| b[(i, j)] + a[(i, j)] == 0.0) {
            y[j] = t[j];
        }
    }
    let rescaled = HorizontalLcp::new(
        Mat::from_fn(n, n, |i, j| rows[i] * a[(i, j)] * t[j]),
        Mat::from_fn(n, n, |i, j| rows[i] * b[(i, j)] * y[j]),
        problem.c().iter().zip(rows).map(|(c, row)| row * c).collect::<Vec<f64>>(),
    );
    let times = |v: &[f64], units: &[f64]| v.iter().zip(units).map(|(v, unit)| v * unit).collect();
    Equivalent {
        are_rows_mixed: false,
        name: "rows and variables in units of their own".to_owned(),
        problem: rescaled.unwrap(),
        back: Box::new(move |point| (times(&point.0, &t), times(&point.1, &y))),
    }
}

/// Rows and pairs in another order: the new pair `k` is the old pair `order[k]`.
pub fn permuted(problem: &HorizontalLcp, order: Vec<usize>) -> Equivalent {
    let n = problem.order();
    let (a, b) = (problem.a(), problem.b());
    let permuted = HorizontalLcp::new(
        Mat::from_fn(n, n, |i, j| a[(order[i], order[j])]),
        Mat::from_fn(n, n, |i, j| b[(order[i], order[j])]),
        order.iter().map(|&i| problem.c()[i]).collect::<Vec<f64>>(),
    );
    Equivalent {
        are_rows_mixed: false,
        name: "permuted".to_owned(),
        problem: permuted.unwrap(),
        back: Box::new(move |(t, y)| {
            let (mut t_back, mut y_back) = (vec![0.0; n], vec![0.0; n]);
            for (k, &pair) in order.iter().enumerate() {
                (t_back[pair], y_back[pair]) = (t[k], y[k]);
            }
            (t_back, y_back)
        }),
    }
}

/// The two variables of some pairs exchanged.
pub fn swapped(problem: &HorizontalLcp, swap: Vec<bool>) -> Equivalent {
    let n = problem.order();
    let (a, b) = (problem.a(), problem.b());
    let exchanged = HorizontalLcp::new(
        Mat::from_fn(n, n, |i, j| if swap[j] { b[(i, j)] } else { a[(i, j)] }),
        Mat::from_fn(n, n, |i, j| if swap[j] { a[(i, j)] } else { b[(i, j)] }),
        problem.c().to_vec(),
    );
    Equivalent {
        are_rows_mixed: false,
        name: format!("{} pairs swapped", swap.iter().filter(|swap| **swap).count()),
        problem: exchanged.unwrap(),
        back: Box::new(move |(t, y)| {
            let pairs = t.iter().zip(y).zip(&swap);
            pairs.map(|((&t, &y), &swap)| if swap { (y, t) } else { (t, y) }).unzip()
        }),
    }
}

/// The equations multiplied by a nonsingular matrix.
pub fn premultiplied(problem: &HorizontalLcp, matrix: &Mat<f64>) -> Equivalent {
    let n = problem.order();
    let c = Mat::from_fn(n, 1, |i, _| problem.c()[i]);
    let c = matrix * c;
    let multiplied = HorizontalLcp::new(
        matrix * problem.a().to_dense(),
        matrix * problem.b().to_dense(),
        (0..n).map(|i| c[(i, 0)]).collect::<Vec<f64>>(),
    );
    Equivalent {
        are_rows_mixed: true,
        name: "rows premultiplied".to_owned(),
        problem: multiplied.unwrap(),
        back: Box::new(Point::clone),
    }
}

/// One more pair, with `w = z - size`, that has nothing to do with the others.
pub fn extended(problem: &HorizontalLcp, size: f64) -> Equivalent {
    let n = problem.order();
    let corner = |matrix: Mat<f64>, value: f64| {
        Mat::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (true, true) => matrix[(i, j)],
            (false, false) => value,
            _ => 0.0,
        })
    };
    let c: Vec<f64> = problem.c().iter().copied().chain([-size]).collect();
    let (a, b) = (corner(problem.a().to_dense(), -1.0), corner(problem.b().to_dense(), 1.0));
    Equivalent {
        are_rows_mixed: false,
        name: "one pair more".to_owned(),
        problem: HorizontalLcp::new(a, b, c).unwrap(),
        back: Box::new(move |(t, y)| (t[..n].to_vec(), y[..n].to_vec())),
    }
}
