//! What is said to fall, and what only seems to.

use faer::Mat;
use lcp::{Contact2d, ContactState, Status};
use lcp_problems::exact::{Feasibility, feasibility};

use super::{assert_close, body, solve};

/// A wedge between faces that friction is steeper than stands if it is jammed. That is found, and not called a fall;
/// without friction the wedge comes out.
#[test]
fn a_jammed_body_is_no_body_that_falls() {
    let faces = [[0.8, 0.6], [-0.8, 0.6]];
    let rough = solve(&body([0.0, 0.0], [0.0, 1.0], &faces, 1.0));
    assert!(rough.is_solved(), "{:?}: {:?}", rough.status, rough.residuals);
    let ContactState { u, t_n, .. } = rough.contact.unwrap();
    assert_close(&u, &[0.0, 0.0]);
    // With all friction: `2 (0.8 - 0.6) t_n = 1`.
    assert!(t_n.iter().all(|t| *t > 2.5 - 1e-12), "{t_n:?}");
    let smooth = solve(&body([0.0, 0.0], [0.0, 1.0], &faces, 0.0));
    assert_eq!(smooth.status, Status::Infeasible);
}

/// Rigid bodies with friction on each other and on planes, in numbers that rational arithmetic decides: forces
/// inside their cones that balance the loads are an equilibrium, as nothing has to move.
#[test]
fn what_is_said_to_fall_cannot_be_held() {
    let mut random = Integers(1);
    let (mut falls, mut stands) = (0, 0);
    for _ in 0..300 {
        let problem = rigid(&mut random);
        let solution = solve(&problem);
        let is_held = matches!(feasibility(&problem.to_general()), Feasibility::Feasible(_));
        match solution.status {
            Status::Infeasible => {
                assert!(!is_held, "{problem:?}");
                assert!(solution.certificate.as_ref().unwrap().holds(&problem.to_general()));
            }
            Status::Solved => assert!(is_held, "{problem:?}"),
            _ => {}
        }
        falls += usize::from(solution.status == Status::Infeasible);
        stands += usize::from(solution.is_solved());
    }
    assert!(falls > 100 && stands > 20, "{falls}, {stands}");
}

/// Small integers.
struct Integers(u64);

impl Integers {
    fn below(&mut self, count: usize) -> usize {
        let factor = 6_364_136_223_846_793_005;
        self.0 = self.0.wrapping_mul(factor).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % count
    }

    /// From `low` on, so many of them.
    fn next(&mut self, low: f64, count: usize) -> f64 {
        low + self.below(count) as f64
    }
}

/// Two bodies with contacts of any direction with the ground, and every other one with each other.
fn rigid(random: &mut Integers) -> Contact2d {
    let m = 2 + random.below(5);
    let (mut c_n, mut c_t) = (Mat::zeros(m, 6), Mat::zeros(m, 6));
    for i in 0..m {
        let normal = [random.next(-3.0, 7), random.next(1.0, 3)];
        let tangent = [normal[1], -normal[0]];
        for (body, sign) in [(i % 2, 1.0), ((i + 1) % 2, -1.0)].into_iter().take(1 + i % 2) {
            let place = [random.next(-3.0, 7), random.next(-3.0, 7)];
            for (matrix, [x, y]) in [(&mut c_n, normal), (&mut c_t, tangent)] {
                let motions = [x, y, place[0] * y - place[1] * x];
                (0..3).for_each(|k| matrix[(i, 3 * body + k)] = sign * motions[k]);
            }
        }
    }
    let load: Vec<f64> = (0..6).map(|_| random.next(-3.0, 6)).collect();
    let mu = vec![[0.5, 1.0, 2.0][random.below(3)]; m];
    let zero = vec![0.0; m];
    Contact2d::new(Mat::zeros(6, 6), load, c_n, c_t, zero.clone(), zero, mu).unwrap()
}
