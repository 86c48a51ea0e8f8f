//! Forces of contact that is reduced to the contacts. Velocities follow from them.

use faer::Mat;
use lcp::Friction2d;

use super::contact::Point;
use super::draw::Draw;
use super::planted::{Blocks, Planted, absolute, minus, plus, product, sizes, times};

/// Normal and tangential components of every contact alternate.
pub(crate) struct Reduced {
    blocks: Blocks,
    w: Mat<f64>,
    mu: Vec<f64>,
    points: Vec<Point>,
    force: Vec<f64>,
    velocity: Vec<f64>,
}

fn forces_and_velocities(points: &[Point]) -> Vec<f64> {
    let forces = points.iter().flat_map(|p| [p.t_n, p.t_t]);
    forces.chain(points.iter().flat_map(|p| [p.gap, p.slip])).collect()
}

impl Planted for Reduced {
    fn draw(draw: &mut Draw) -> Self {
        let blocks = Blocks::draw(draw, 2);
        let contacts = blocks.len();
        let w = Mat::from_fn(2 * contacts, 2 * contacts, |i, j| {
            let value = if i == j { draw.number(2, 4) } else { draw.number(-1, 1) };
            blocks.between(i / 2, j / 2) * value
        });
        let mu: Vec<f64> = (0..contacts).map(|_| draw.one_of(&[0.0, 0.5, 1.0, 2.0])).collect();
        let points = mu.iter().map(|mu| Point::draw(draw, *mu)).collect();
        let [force, velocity] = [0; 2].map(|_| {
            let units = blocks.units(draw);
            units.into_iter().flat_map(|unit| [unit; 2]).collect()
        });
        Self { blocks, w, mu, points, force, velocity }
    }

    fn is_loaded(&self, right_side: &[f64]) -> bool {
        let sums: Vec<f64> = right_side.chunks(2).map(|q| q[0].abs() + q[1].abs()).collect();
        self.blocks.are_loaded(&sums)
    }

    fn point(&self) -> Vec<f64> {
        forces_and_velocities(&self.points)
    }

    fn right_side(&self, point: &[f64]) -> Vec<f64> {
        let (forces, velocities) = point.split_at(self.w.nrows());
        minus(velocities, &product(&self.w, forces))
    }

    fn terms(&self, point: &[f64]) -> Vec<f64> {
        let (forces, _) = point.split_at(self.w.nrows());
        plus(&sizes(&self.w, forces), &absolute(&self.right_side(point)))
    }

    fn worst(&self, right_side: &[f64], point: &[f64]) -> f64 {
        let Self { w, mu, force, velocity, .. } = self;
        let n = w.nrows();
        let matrix = Mat::from_fn(n, n, |i, j| w[(i, j)] * (velocity[i] / force[j]));
        let friction = Friction2d::new(matrix, times(right_side, velocity), mu.clone()).unwrap();
        // The variables of the standard problem; sliding does not matter for the forces.
        let forces = times(&point[..n], force);
        let standard: Vec<f64> = (forces.chunks_exact(2).zip(mu))
            .flat_map(|(forces, mu)| [forces[0], forces[1] + mu * forces[0], 0.0])
            .collect();
        let mut found = friction.forces(&standard);
        found.tangential = forces.chunks_exact(2).map(|forces| forces[1]).collect();
        friction.residuals(&found).worst()
    }

    fn violations(&self) -> Vec<(String, Vec<f64>)> {
        let mut violations = Vec::new();
        for (i, (point, mu)) in self.points.iter().zip(&self.mu).enumerate() {
            for (what, violated) in point.violations(*mu) {
                // Without friction the tangential force of the standard problem is a force like others.
                let mut points = self.points.clone();
                points[i] = violated;
                violations.push((format!("contact {i}: {what}"), forces_and_velocities(&points)));
            }
        }
        violations
    }

    /// A force that acts on a closed contact moves it.
    fn fixed_components(&self) -> Vec<usize> {
        let forces = self.points.iter().flat_map(|p| [p.t_n, p.t_t]).enumerate();
        forces.filter(|(_, force)| *force != 0.0).map(|(i, _)| i).collect()
    }

    /// Closed contacts have no normal velocity, sticking ones no tangential velocity.
    fn fixed_rows(&self) -> Vec<usize> {
        let mut rows = Vec::new();
        for (i, (p, mu)) in self.points.iter().zip(&self.mu).enumerate() {
            rows.extend((p.t_n > 0.0).then_some(2 * i));
            rows.extend((p.t_t.abs() < mu * p.t_n).then_some(2 * i + 1));
        }
        rows
    }
}
