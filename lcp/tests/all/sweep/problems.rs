//! Problems of small integers with ties, zeros, dependent rows and columns.

use faer::Mat;
use lcp::{BoxedLcp, Contact2d, Error, Friction2d, HorizontalLcp, Lcp, MixedLcp, Solution};

use super::draw::Draw;
use super::methods::Treated;

/// The largest number of pairs of the general form.
pub(crate) const MOST_PAIRS: usize = 6;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    General,
    /// A general problem with rows and variables in units of their own.
    Scaled,
    Standard,
    Mixed,
    Boxed,
    Friction,
    Contact,
}

impl Kind {
    pub(crate) const ALL: [Self; 7] = [
        Self::General,
        Self::Scaled,
        Self::Standard,
        Self::Mixed,
        Self::Boxed,
        Self::Friction,
        Self::Contact,
    ];
}

pub(crate) enum Problem {
    General(HorizontalLcp),
    Standard(Lcp),
    Mixed(MixedLcp),
    Boxed(BoxedLcp),
    Friction(Friction2d),
    Contact(Contact2d),
}

impl Problem {
    /// The answers of all methods.
    pub(crate) fn answers(&self) -> Vec<(&'static str, Result<Solution, Error>)> {
        fn in_pairs<P: Treated>(problem: &P) -> Vec<(&'static str, Result<Solution, Error>)> {
            let answers = problem.answers().into_iter();
            answers.map(|(name, answer)| (name, answer.map(Solution::of_pairs))).collect()
        }
        match self {
            Self::General(problem) => in_pairs(problem),
            Self::Standard(problem) => in_pairs(problem),
            Self::Mixed(problem) => in_pairs(problem),
            Self::Boxed(problem) => in_pairs(problem),
            Self::Friction(problem) => in_pairs(problem),
            Self::Contact(problem) => in_pairs(problem),
        }
    }

    /// What the judge of the library says of an answer, in the variables of the problem.
    pub(crate) fn residual_of(&self, solution: &Solution) -> f64 {
        match (self, &solution.contact) {
            (Self::Contact(problem), Some(state)) => problem.residuals(state).worst(),
            _ => self.residual(&solution.t, &solution.y),
        }
    }

    /// The same of a point of the general form.
    pub(crate) fn residual(&self, t: &[f64], y: &[f64]) -> f64 {
        let residuals = match self {
            Self::General(problem) => problem.residuals(t, y),
            Self::Standard(problem) => problem.residuals(t, y),
            Self::Mixed(problem) => {
                let (z, w) = problem.recover(t, y);
                problem.residuals(&z, &w)
            }
            Self::Boxed(problem) => {
                let (z, w) = problem.recover(t, y);
                problem.residuals(&z, &w)
            }
            Self::Friction(problem) => problem.residuals(&problem.forces(t)),
            Self::Contact(problem) => problem.residuals(&problem.recover(t, y)),
        };
        residuals.worst()
    }
}

/// A problem, and the same in integers.
pub(crate) struct Case {
    pub(crate) problem: Problem,
    /// The general form of the problem.
    pub(crate) general: HorizontalLcp,
    /// The same before a change of units.
    pub(crate) integers: HorizontalLcp,
    /// The largest entry of the right-hand side, in integers.
    pub(crate) largest: f64,
    /// What `t` and `y` are multiplied by to be those of the integers.
    pub(crate) units: (Vec<f64>, Vec<f64>),
}

impl Case {
    pub(crate) fn new(problem: Problem) -> Self {
        let general: HorizontalLcp = match &problem {
            Problem::General(problem) => problem.clone(),
            Problem::Standard(problem) => problem.clone().into(),
            Problem::Mixed(problem) => problem.to_general(),
            Problem::Boxed(problem) => problem.to_general(),
            Problem::Friction(problem) => problem.standard().clone().into(),
            Problem::Contact(problem) => problem.to_general(),
        };
        let ones = vec![1.0; general.order()];
        let integers = general.clone();
        // The bounds of a boxed problem may cancel what it has.
        let vector = if let Problem::Boxed(boxed) = &problem { boxed.q() } else { general.c() };
        let largest = general.c().iter().chain(vector).fold(0.0, |max: f64, c| max.max(c.abs()));
        Self { problem, general, integers, largest, units: (ones.clone(), ones) }
    }

    /// The case of a kind that belongs to a seed.
    pub(crate) fn draw(kind: Kind, seed: u64) -> Self {
        let draw = &mut Draw::new(seed);
        let mut sketch = Sketch::new(draw);
        match kind {
            Kind::General => Self::new(Problem::General(sketch.general())),
            Kind::Scaled => {
                let integers = sketch.general();
                Self::in_units(integers, sketch.draw)
            }
            Kind::Standard => Self::new(Problem::Standard(sketch.standard())),
            Kind::Mixed => Self::new(Problem::Mixed(sketch.mixed())),
            Kind::Boxed => Self::new(Problem::Boxed(sketch.boxed())),
            Kind::Friction => Self::new(Problem::Friction(sketch.friction())),
            Kind::Contact => Self::new(Problem::Contact(sketch.contact())),
        }
    }

    /// Rows and variables multiplied by powers of two.
    fn in_units(integers: HorizontalLcp, draw: &mut Draw) -> Self {
        let n = integers.order();
        let mut powers = || -> Vec<f64> { (0..n).map(|_| draw.power(20)).collect() };
        let (row, t, y) = (powers(), powers(), powers());
        let a = Mat::from_fn(n, n, |i, j| row[i] * integers.a()[(i, j)] * t[j]);
        let b = Mat::from_fn(n, n, |i, j| row[i] * integers.b()[(i, j)] * y[j]);
        let c: Vec<f64> = integers.c().iter().zip(&row).map(|(c, row)| c * row).collect();
        let general = HorizontalLcp::new(a, b, c).unwrap();
        let largest = integers.c().iter().fold(0.0, |max: f64, c| max.max(c.abs()));
        let problem = Problem::General(general.clone());
        Self { problem, general, integers, largest, units: (t, y) }
    }
}

/// How large the entries of a problem are and how many of them are zero.
struct Sketch<'a> {
    draw: &'a mut Draw,
    size: i32,
    /// Of ten entries so many are drawn, the others are zero.
    density: i32,
}

impl<'a> Sketch<'a> {
    fn new(draw: &'a mut Draw) -> Self {
        let size = draw.one_of(&[1, 2, 2, 3]);
        let density = draw.one_of(&[3, 5, 7, 10]);
        Self { draw, size, density }
    }

    fn entry(&mut self) -> f64 {
        let value = self.draw.number(-self.size, self.size);
        if self.draw.integer(1, 10) <= self.density { value } else { 0.0 }
    }

    fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.entry()).collect()
    }

    /// Of four matrices one has two opposite or equal rows, and one such columns.
    fn matrix(&mut self, rows: usize, columns: usize) -> Mat<f64> {
        let mut matrix = Mat::from_fn(rows, columns, |_, _| self.entry());
        let sign = self.draw.one_of(&[1.0, -1.0]);
        match self.draw.integer(0, 3) {
            0 if rows > 1 => {
                let (from, to) = (self.draw.index(rows), self.draw.index(rows));
                (0..columns).for_each(|j| matrix[(to, j)] = 0.0 + sign * matrix[(from, j)]);
            }
            1 if columns > 1 => {
                let (from, to) = (self.draw.index(columns), self.draw.index(columns));
                (0..rows).for_each(|i| matrix[(i, to)] = 0.0 + sign * matrix[(i, from)]);
            }
            _ => {}
        }
        matrix
    }

    /// Of positive semidefinite, skew, symmetric and other square matrices one.
    fn square(&mut self, n: usize) -> Mat<f64> {
        let m = self.matrix(n, n);
        match self.draw.integer(0, 5) {
            0 => self.gram(n),
            1 => &m - m.transpose(),
            2 => Mat::from_fn(n, n, |i, j| m[(i.min(j), i.max(j))]),
            _ => m,
        }
    }

    /// Positive semidefinite, of any rank.
    fn gram(&mut self, n: usize) -> Mat<f64> {
        let rank = self.draw.index(n + 1);
        let c = self.matrix(n, rank);
        &c * c.transpose()
    }

    /// Nonnegative and complementary, with pairs in which both vanish.
    fn pairs(&mut self, n: usize) -> (Vec<f64>, Vec<f64>) {
        let pair = |_| {
            let value = self.draw.number(0, 2);
            if self.draw.is_heads() { (value, 0.0) } else { (0.0, value) }
        };
        (0..n).map(pair).unzip()
    }

    fn order(&mut self) -> usize {
        1 + self.draw.index(MOST_PAIRS)
    }

    fn general(&mut self) -> HorizontalLcp {
        let n = self.order();
        let (a, b) = (self.square(n), self.square(n));
        let c = if self.draw.is_heads() {
            let (t, y) = self.pairs(n);
            sum(&product(&a, &t), &product(&b, &y))
        } else {
            self.vector(n)
        };
        HorizontalLcp::new(a, b, c).unwrap()
    }

    /// `w - M z` of a planted point, or anything.
    fn right_side(&mut self, m: &Mat<f64>, (z, w): (&[f64], &[f64])) -> Vec<f64> {
        if self.draw.is_heads() { difference(w, &product(m, z)) } else { self.vector(z.len()) }
    }

    fn standard(&mut self) -> Lcp {
        let n = self.order();
        let m = self.square(n);
        let (z, w) = self.pairs(n);
        let q = self.right_side(&m, (&z, &w));
        Lcp::new(m, q).unwrap()
    }

    fn mixed(&mut self) -> MixedLcp {
        let n = self.order();
        let m = self.square(n);
        let free: Vec<bool> = (0..n).map(|_| self.draw.integer(0, 2) == 0).collect();
        let (mut z, mut w) = self.pairs(n);
        for (i, _) in free.iter().enumerate().filter(|(_, free)| **free) {
            (z[i], w[i]) = (self.draw.number(-2, 2), 0.0);
        }
        let q = self.right_side(&m, (&z, &w));
        MixedLcp::new(m, q, free).unwrap()
    }

    /// Variables with all kinds of bounds; one with two takes two pairs.
    fn boxed(&mut self) -> BoxedLcp {
        let n = 1 + self.draw.index(4);
        let m = self.square(n);
        let (mut lower, mut upper) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
        let (mut z, mut w) = (vec![0.0; n], vec![0.0; n]);
        let mut spare = MOST_PAIRS - n;
        for i in 0..n {
            z[i] = self.draw.number(-2, 2);
            let (push, room) = (self.draw.number(0, 2), self.draw.number(1, 3));
            match self.draw.integer(0, 6) {
                0 => {}
                1 => (lower[i], w[i]) = (z[i], push),
                2 => (upper[i], w[i]) = (z[i], -push),
                3 => (lower[i], upper[i], w[i]) = (z[i], z[i], push - 1.0),
                _ if spare == 0 => lower[i] = z[i] - room,
                place => {
                    spare -= 1;
                    (lower[i], upper[i], w[i]) = match place {
                        4 => (z[i], z[i] + room, push),
                        5 => (z[i] - room, z[i], -push),
                        _ => (z[i] - 1.0, z[i] + room, 0.0),
                    };
                }
            }
        }
        let q = self.right_side(&m, (&z, &w));
        BoxedLcp::new(m, q, lower, upper).unwrap()
    }

    fn mu(&mut self, points: usize) -> Vec<f64> {
        (0..points).map(|_| self.draw.one_of(&[0.0, 0.5, 1.0, 2.0])).collect()
    }

    /// Force and velocity, or displacement, of a point in one of the states of Coulomb's law.
    fn point(&mut self, mu: f64) -> Point {
        let (force, distance) = (self.draw.number(0, 2), self.draw.number(0, 2));
        let side = self.draw.one_of(&[1.0, -1.0]);
        match self.draw.integer(0, 3) {
            0 => Point { force: (0.0, 0.0), motion: (distance, self.draw.number(-2, 2)) },
            1 => Point { force: (force, -side * mu * force), motion: (0.0, side * distance) },
            2 => Point { force: (force, 0.5 * side * mu * force), motion: (0.0, 0.0) },
            _ => Point { force: (force, -side * mu * force), motion: (0.0, 0.0) },
        }
    }

    fn friction(&mut self) -> Friction2d {
        let contacts = 1 + self.draw.index(MOST_PAIRS / 3);
        let (n, mu) = (2 * contacts, self.mu(contacts));
        let w = if self.draw.integer(0, 2) == 0 { self.matrix(n, n) } else { self.gram(n) };
        let points: Vec<Point> = mu.iter().map(|mu| self.point(*mu)).collect();
        let flat = |of: fn(&Point) -> (f64, f64)| -> Vec<f64> {
            points.iter().map(of).flat_map(|(normal, tangential)| [normal, tangential]).collect()
        };
        let q = self.right_side(&w, (&flat(|it| it.force), &flat(|it| it.motion)));
        Friction2d::new(w, q, mu).unwrap()
    }

    fn contact(&mut self) -> Contact2d {
        // A displacement takes a pair, a point one without and three with friction.
        let mut mu = self.mu(2);
        let pairs = |mu: &[f64]| mu.iter().map(|mu| if *mu > 0.0 { 3 } else { 1 }).sum::<usize>();
        if pairs(&mu) >= MOST_PAIRS || self.draw.is_heads() {
            mu.pop();
        }
        let (n, m) = (1 + self.draw.index(MOST_PAIRS - pairs(&mu)), mu.len());
        let k = self.gram(n);
        let (c_n, c_t) = (self.matrix(m, n), self.matrix(m, n));
        let (mut f, mut x_0, mut s_0) = (self.vector(n), self.vector(m), self.vector(m));
        if self.draw.is_heads() {
            let u: Vec<f64> = (0..n).map(|_| self.draw.number(-2, 2)).collect();
            let points: Vec<Point> = mu.iter().map(|mu| self.point(*mu)).collect();
            let part = |of: fn(&Point) -> f64| -> Vec<f64> { points.iter().map(of).collect() };
            let of_normal = product(&c_n.transpose().to_owned(), &part(|it| it.force.0));
            let of_tangent = product(&c_t.transpose().to_owned(), &part(|it| it.force.1));
            f = difference(&product(&k, &u), &sum(&of_normal, &of_tangent));
            x_0 = difference(&part(|it| it.motion.0), &product(&c_n, &u));
            s_0 = difference(&part(|it| it.motion.1), &product(&c_t, &u));
        }
        Contact2d::new(k, f, c_n, c_t, x_0, s_0, mu).unwrap()
    }
}

/// Normal and tangential, in this order.
struct Point {
    force: (f64, f64),
    motion: (f64, f64),
}

fn product(m: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    (0..m.nrows()).map(|i| x.iter().enumerate().map(|(j, x)| m[(i, j)] * x).sum()).collect()
}

fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
