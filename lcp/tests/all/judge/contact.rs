//! States of contact: displacements, forces, gaps and slips.

use faer::Mat;
use lcp::Contact2d;

use super::draw::Draw;
use super::planted::{Blocks, Planted, absolute, minus, plus, product, sizes, times, transposed};

/// Whether points have friction.
pub(crate) trait Friction {
    const MU: &'static [f64];
}

pub(crate) struct Rough;
pub(crate) struct Smooth;

impl Friction for Rough {
    const MU: &'static [f64] = &[0.0, 0.5, 1.0, 2.0];
}

impl Friction for Smooth {
    const MU: &'static [f64] = &[0.0];
}

/// A body for every block, elastic or rigid, with as many displacements as points.
pub(crate) struct Contact<F> {
    blocks: Blocks,
    k: Mat<f64>,
    c_n: Mat<f64>,
    c_t: Mat<f64>,
    mu: Vec<f64>,
    u: Vec<f64>,
    points: Vec<Point>,
    /// Units of forces and lengths, and of single displacements.
    force: Vec<f64>,
    length: Vec<f64>,
    displacement: Vec<f64>,
    friction: std::marker::PhantomData<F>,
}

/// The law at a point of contact, or at what violates it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point {
    pub(crate) t_n: f64,
    pub(crate) t_t: f64,
    pub(crate) gap: f64,
    pub(crate) slip: f64,
}

const SOME: f64 = 1.0 / 1024.0;

impl Point {
    /// Open, sticking, sliding, or about to slide.
    pub(crate) fn draw(draw: &mut Draw, mu: f64) -> Self {
        let (t_n, distance) = (draw.number(0, 3), draw.number(1, 3));
        let side = draw.one_of(&[1.0, -1.0]);
        match draw.integer(0, 3) {
            0 => Self { t_n: 0.0, t_t: 0.0, gap: distance, slip: draw.number(-3, 3) },
            1 => Self { t_n, t_t: -side * mu * t_n, gap: 0.0, slip: side * distance },
            2 => Self { t_n, t_t: 0.5 * side * mu * t_n, gap: 0.0, slip: 0.0 },
            _ => Self { t_n, t_t: side * mu * t_n, gap: 0.0, slip: 0.0 },
        }
    }

    /// What the law forbids, near the point.
    pub(crate) fn violations(self, mu: f64) -> Vec<(&'static str, Self)> {
        let Self { t_n, gap, slip, .. } = self;
        let mut violations = vec![
            ("penetration", Self { gap: -SOME, ..self }),
            ("tension", Self { t_n: -SOME, t_t: 0.0, ..self }),
        ];
        if t_n > 0.0 {
            violations.push(("a force across a gap", Self { gap: SOME, ..self }));
        }
        if gap > 0.0 {
            violations.push(("a gap under a force", Self { t_n: SOME, ..self }));
        }
        if mu == 0.0 {
            violations.push(("friction without friction", Self { t_t: SOME, ..self }));
        } else {
            let bound = mu * t_n;
            violations.push(("too much friction", Self { t_t: bound + SOME, ..self }));
            violations.push(("too much friction backwards", Self { t_t: -bound - SOME, ..self }));
        }
        if mu * t_n > 0.0 {
            let bound = mu * t_n;
            violations.extend([
                ("friction that pushes", Self { t_t: bound, slip: SOME, ..self }),
                ("friction that pushes backwards", Self { t_t: -bound, slip: -SOME, ..self }),
                (
                    "slip before the friction is used up",
                    Self { t_t: 0.5 * bound, slip: -SOME, ..self },
                ),
            ]);
        }
        if mu * t_n > 0.0 && slip != 0.0 {
            let t_t = self.t_t * (1.0 - SOME);
            violations.push(("slip at less than the friction", Self { t_t, ..self }));
        }
        violations
    }
}

fn part(points: &[Point], of: fn(&Point) -> f64) -> Vec<f64> {
    points.iter().map(of).collect()
}

fn with_points(u: &[f64], points: &[Point]) -> Vec<f64> {
    let parts = [|p: &Point| p.t_n, |p: &Point| p.t_t, |p: &Point| p.gap, |p: &Point| p.slip];
    [u.to_vec()].into_iter().chain(parts.map(|of| part(points, of))).flatten().collect()
}

impl<F: Friction> Planted for Contact<F> {
    fn draw(draw: &mut Draw) -> Self {
        // Gaps that are less than that of others of the same structure are rounding errors of positions.
        let blocks = Blocks::draw(draw, 3).within((20_f64).exp2());
        let n = blocks.len();
        let r = Mat::from_fn(n, n, |i, j| blocks.between(i, j).trunc() * draw.number(-1, 1));
        let is_rigid: Vec<bool> = (0..n).map(|_| draw.integer(0, 3) == 0).collect();
        let stiffness = &r * r.transpose() + Mat::<f64>::identity(n, n);
        let k = Mat::from_fn(n, n, |i, j| {
            let is_elastic = !is_rigid[i] && !is_rigid[j];
            if is_elastic { blocks.between(i, j) * stiffness[(i, j)] } else { 0.0 }
        });
        let [c_n, c_t] = [0; 2].map(|_| blocks.matrix(draw));
        let mu: Vec<f64> = (0..n).map(|_| draw.one_of(F::MU)).collect();
        let u = (0..n).map(|_| draw.number(-3, 3)).collect();
        let points = mu.iter().map(|mu| Point::draw(draw, *mu)).collect();
        let force = blocks.sizes();
        // Blocks that are coupled have the same unit of work.
        let length = if blocks.coupling > 0.0 {
            force.iter().map(|force| 1.0 / force).collect()
        } else {
            let of_block: Vec<f64> = blocks.size.iter().map(|_| draw.power(30)).collect();
            blocks.of.iter().map(|&block| of_block[block]).collect()
        };
        let displacement = blocks.factors(draw);
        let friction = std::marker::PhantomData;
        Self { blocks, k, c_n, c_t, mu, u, points, force, length, displacement, friction }
    }

    fn is_loaded(&self, right_side: &[f64]) -> bool {
        self.blocks.are_loaded(&right_side[..self.u.len()])
    }

    fn point(&self) -> Vec<f64> {
        with_points(&self.u, &self.points)
    }

    fn right_side(&self, point: &[f64]) -> Vec<f64> {
        let parts: Vec<&[f64]> = point.chunks(self.u.len()).collect();
        let [u, t_n, t_t, gap, slip] = parts[..] else { panic!("five parts") };
        let contact = plus(&transposed(&self.c_n, t_n), &transposed(&self.c_t, t_t));
        let f = minus(&product(&self.k, u), &contact);
        let (x_0, s_0) = (minus(gap, &product(&self.c_n, u)), minus(slip, &product(&self.c_t, u)));
        [f, x_0, s_0].concat()
    }

    fn terms(&self, point: &[f64]) -> Vec<f64> {
        let parts: Vec<&[f64]> = point.chunks(self.u.len()).collect();
        let [u, t_n, t_t, gap, slip] = parts[..] else { panic!("five parts") };
        let [normal, tangent] = [&self.c_n, &self.c_t].map(|c| c.transpose().to_owned());
        let contact = plus(&sizes(&normal, t_n), &sizes(&tangent, t_t));
        let f = plus(&sizes(&self.k, u), &contact);
        let x_0 = plus(&absolute(gap), &sizes(&self.c_n, u));
        let s_0 = plus(&absolute(slip), &sizes(&self.c_t, u));
        plus(&[f, x_0, s_0].concat(), &absolute(&self.right_side(point)))
    }

    fn worst(&self, right_side: &[f64], point: &[f64]) -> f64 {
        let Self { k, c_n, c_t, mu, force, length, displacement, .. } = self;
        let n = mu.len();
        let (f, x_0, s_0) = (&right_side[..n], &right_side[n..2 * n], &right_side[2 * n..]);
        let of_stiffness = |i: usize, j: usize| {
            let unit = displacement[i] * displacement[j] * (force[i] / length[j]);
            if k[(i, j)] == 0.0 { 0.0 } else { k[(i, j)] * unit }
        };
        let of_contact = |c: &Mat<f64>| {
            Mat::from_fn(n, n, |p, j| {
                let unit = displacement[j] * (length[p] / length[j]);
                if c[(p, j)] == 0.0 { 0.0 } else { c[(p, j)] * unit }
            })
        };
        let contact = Contact2d::new(
            Mat::from_fn(n, n, of_stiffness),
            times(&times(f, force), displacement),
            of_contact(c_n),
            of_contact(c_t),
            times(x_0, length),
            times(s_0, length),
            mu.clone(),
        );
        let contact = contact.unwrap();
        let parts: Vec<&[f64]> = point.chunks(n).collect();
        let [u, t_n, t_t, gap, slip] = parts[..] else { panic!("five parts") };
        let u = (0..n).map(|j| u[j] * length[j] / displacement[j]).collect();
        let mut state = contact.state(u, times(t_n, force), times(t_t, force));
        (state.gap, state.slip) = (times(gap, length), times(slip, length));
        contact.residuals(&state).worst()
    }

    fn violations(&self) -> Vec<(String, Vec<f64>)> {
        let mut violations = Vec::new();
        for (i, (point, mu)) in self.points.iter().zip(&self.mu).enumerate() {
            for (what, violated) in point.violations(*mu) {
                let mut points = self.points.clone();
                points[i] = violated;
                violations.push((format!("point {i}: {what}"), with_points(&self.u, &points)));
            }
        }
        violations
    }
}
