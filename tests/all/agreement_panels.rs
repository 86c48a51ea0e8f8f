//! All methods agree on the scenes of the repository as sparse contact problems, to every tolerance that
//! is asked for.
//!
//! * With friction the square panels have one state known, the rectangular one two, of which all methods
//!   find the same: elastic forces, stresses, reactions and work are compared, and displacements where all
//!   bricks are held.
//! * Without friction the stresses and what the load does are unique; where the bricks are is not, and
//!   neither are the forces of contacts that share a load.
//! * The sweeps refuse all scenes, because bricks that float have no definite stiffness; with every brick
//!   bedded in springs they take part.
//! * Rigid blocks have unique resultants only.

use crate::common;

use common::{difference, panels};
use faer::sparse::{SparseColMat, Triplet};
use lcp::{
    Contact2d, ContactState, Error, InteriorPoint, InteriorPointSettings, Lemke, LemkeSettings,
    Method, ProjectedGaussSeidel, ProjectedGaussSeidelSettings, QuadraticProgram,
    QuadraticProgramSettings, Solver, Status,
};
use masonry::forms::Sparse;
use masonry::model::{Body, Model};
use masonry::recover::stresses;
use masonry::system::System;
use nalgebra::Vector2;

const TOLERANCES: [f64; 3] = [1e-4, 1e-8, 1e-12];
/// That a residual is summed up here in another order.
const ROUNDING: f64 = 1.01;

fn interior(tolerance: f64) -> InteriorPoint {
    InteriorPoint::new(InteriorPointSettings { tolerance, ..Default::default() })
}

fn program(tolerance: f64) -> QuadraticProgram {
    QuadraticProgram::new(QuadraticProgramSettings { tolerance, ..Default::default() })
}

fn sweeps(tolerance: f64) -> ProjectedGaussSeidel {
    let settings = ProjectedGaussSeidelSettings { tolerance, ..Default::default() };
    ProjectedGaussSeidel::new(settings)
}

fn lemke(tolerance: f64) -> Lemke {
    Lemke::new(LemkeSettings { tolerance, max_attempts: Some(2), ..Default::default() })
}

fn routes(tolerance: f64) -> [Box<dyn Solver<Contact2d>>; 3] {
    [Box::new(lemke(tolerance)), Box::new(interior(tolerance)), Box::new(program(tolerance))]
}

/// A scene as a sparse problem.
struct Case {
    model: Model,
    sparse: Sparse,
    problem: Contact2d,
}

/// What belongs to a state.
struct Answer {
    state: ContactState,
    stresses: Vec<f64>,
    reactions: Vec<f64>,
    elastic: Vec<f64>,
    work: f64,
}

fn columns(matrix: &SparseColMat<usize, f64>, j: usize) -> impl Iterator<Item = (usize, f64)> {
    let matrix = matrix.as_ref();
    matrix.row_idx_of_col_raw(j).iter().copied().zip(matrix.val_of_col(j).iter().copied())
}

fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |max, v| max.max(v.abs()))
}

impl Case {
    fn new(name: &str) -> Self {
        let model = Model::from_scene(&panels::scene(name)).unwrap();
        let sparse = Sparse::new(&System::new(&model).unwrap()).unwrap();
        let problem = sparse.problem.clone();
        Self { model, sparse, problem }
    }

    /// The same bodies and joints with other friction, and springs on all displacements, as stiff as this
    /// part of the bricks.
    fn changed(self, mu: Option<f64>, bedding: f64) -> Self {
        let Self { model, sparse, problem: old } = self;
        let n = old.displacements();
        let entries = (0..n).flat_map(|j| {
            let bedded =
                move |(i, v)| Triplet::new(i, j, if i == j { v * (1.0 + bedding) } else { v });
            columns(old.stiffness(), j).map(bedded)
        });
        let entries: Vec<_> = entries.collect();
        let problem = Contact2d::new(
            SparseColMat::try_new_from_triplets(n, n, &entries).unwrap(),
            old.loads().to_vec(),
            old.normal().clone(),
            old.tangent().clone(),
            old.initial_gaps().to_vec(),
            old.initial_slips().to_vec(),
            old.mu().iter().map(|given| mu.unwrap_or(*given)).collect::<Vec<f64>>(),
        );
        Self { model, sparse, problem: problem.unwrap() }
    }

    /// The answer of a method that must find one, with its residual and its balances checked.
    fn solved(&self, route: &dyn Solver<Contact2d>, tolerance: f64) -> Answer {
        let solution = route.solve(&self.problem).unwrap();
        let name = route.method();
        assert_eq!(
            solution.status,
            Status::Solved,
            "{name}, {tolerance:e}: {:?}",
            solution.residuals
        );
        let state = self.problem.recover(&solution.t, &solution.y);
        let worst = self.worst(&state);
        assert!(worst <= ROUNDING * tolerance, "{name}, {tolerance:e}: {worst:e}");
        let answer = self.answer(state);
        self.assert_balances(&answer, tolerance);
        answer
    }

    fn answer(&self, state: ContactState) -> Answer {
        let nodes = |u: &[f64]| u.chunks_exact(2).map(|u| Vector2::new(u[0], u[1])).collect();
        let displacements: Vec<Vec<Vector2<f64>>> = (0..self.model.blocks.len())
            .map(|block| match &self.model.blocks[block].mesh {
                Some(_) => nodes(self.sparse.of_block(block, &state.u)),
                None => Vec::new(),
            })
            .collect();
        let stresses = stresses(&self.model, &displacements);
        // Of all supports together, to the left and to the right: at a corner floor and wall share a node.
        let mut reactions = vec![0.0; 6];
        for (i, contact) in self.model.contacts.iter().enumerate() {
            let joint = &self.model.joints[contact.joint.index()];
            let Body::Support(_) = joint.a else { continue };
            let force = joint.normal * state.t_n[i] + joint.tangent() * state.t_t[i];
            let place = contact.position;
            let moment = place.x * force.y - place.y * force.x;
            for (k, v) in [force.x, force.y, moment].into_iter().enumerate() {
                reactions[3 * usize::from(place.x > 0.5 + 1e-9) + k] += v;
            }
        }
        let mut elastic = vec![0.0; state.u.len()];
        for (j, u) in state.u.iter().enumerate() {
            columns(self.problem.stiffness(), j).for_each(|(i, v)| elastic[i] += v * u);
        }
        let work = state.u.iter().zip(self.problem.loads()).map(|(u, f)| u * f).sum();
        let stresses = stresses.iter().flat_map(|it| it.sigma).collect();
        Answer { state, stresses, reactions, elastic, work }
    }

    /// The largest residual: rows of equilibrium relative to their terms or to a thousandth of the largest
    /// force, forces relative to the largest load or force, gaps and slips to the largest displacement that
    /// they have.
    fn worst(&self, state: &ContactState) -> f64 {
        let problem = &self.problem;
        let (n, m, mu) = (problem.displacements(), problem.points(), problem.mu());
        let force = largest(&state.t_n).max(largest(problem.loads()));
        let (mut gap, mut slip) = (problem.initial_gaps().to_vec(), vec![0.0; m]);
        let (mut sum, mut size) = (vec![0.0; n], vec![force / 1024.0; n]);
        let mut length = largest(&gap);
        for j in 0..n {
            let u = state.u[j];
            let mut add = |row: usize, v: f64| {
                sum[row] += v;
                size[row] += v.abs();
            };
            add(j, -problem.loads()[j]);
            columns(problem.stiffness(), j).for_each(|(i, v)| add(i, v * u));
            columns(problem.normal(), j).for_each(|(i, v)| {
                add(j, -v * state.t_n[i]);
                gap[i] += v * u;
                length = length.max((v * u).abs());
            });
            columns(problem.tangent(), j).filter(|(i, _)| mu[*i] > 0.0).for_each(|(i, v)| {
                add(j, -v * state.t_t[i]);
                slip[i] += v * u;
                length = length.max((v * u).abs());
            });
        }
        // Bodies that do not move are measured by what they are wide.
        let length = if length > 1e-9 { length } else { 1.0 };
        let pair = |t: f64, y: f64| (t / force).min(y / length).abs();
        let rows = sum.iter().zip(&size).map(|(sum, size)| sum.abs() / size);
        let pairs = (0..m).flat_map(|i| {
            let bound = mu[i] * state.t_n[i];
            let forwards = pair(bound + state.t_t[i], slip[i].max(0.0));
            let backwards = pair(bound - state.t_t[i], (-slip[i]).max(0.0));
            [pair(state.t_n[i], gap[i]), forwards, backwards]
        });
        rows.chain(pairs).fold(0.0, f64::max)
    }

    /// All loads arrive at the supports, unless springs carry a part, and the work of the loads is
    /// what is stored and what friction takes: `f u = u K u + sum mu t_n |s|`.
    fn assert_balances(&self, answer: &Answer, tolerance: f64) {
        let Answer { state, elastic, reactions, work, .. } = answer;
        let mut balance = [0.0, 0.0];
        let mut size = 0.0;
        for (j, (f, ku)) in self.problem.loads().iter().zip(elastic).enumerate() {
            // Two displacements a node, but three motions a rigid block.
            let axis = if self.model.blocks[0].mesh.is_some() { j % 2 } else { j % 3 };
            if axis < 2 {
                balance[axis] += f - ku;
            }
            size += f.abs() + ku.abs();
        }
        for (k, v) in reactions.iter().enumerate().filter(|(k, _)| k % 3 < 2) {
            balance[k % 3] += v;
            size += v.abs();
        }
        let bound = 10.0 * tolerance * size;
        assert!(largest(&balance) <= bound, "{balance:?} > {bound:e}");
        let stored: f64 = state.u.iter().zip(elastic).map(|(u, ku)| u * ku).sum();
        let pairs = state.t_n.iter().zip(self.problem.mu()).zip(&state.slip);
        let friction: f64 = pairs.map(|((t_n, mu), slip)| mu * t_n * slip.abs()).sum();
        let size = size * largest(&state.u);
        let lack = (work - stored - friction).abs();
        assert!(lack <= 10.0 * tolerance * size, "{lack:e} of {size:e}");
    }
}

fn assert_agree(what: &str, (found, expected): (&[f64], &[f64]), bound: f64) {
    let error = difference(expected, found);
    assert!(error <= bound, "{what}: {error:e} > {bound:e}");
}

/// By all methods to all tolerances. Contacts that share a force, as at the corners of bricks, make the single
/// forces ambiguous; what they do to the bricks is not. Bricks that are not held may lie anywhere.
fn assert_one_state(
    case: &Case,
    is_held: bool,
    routes: fn(f64) -> Vec<Box<dyn Solver<Contact2d>>>,
) -> Answer {
    let reference = case.solved(&lemke(1e-12), 1e-12);
    for tolerance in TOLERANCES {
        for route in routes(tolerance) {
            let found = case.solved(&*route, tolerance);
            let bound = 1e2 * tolerance;
            let what = |what: &str| format!("{what}, {}, {tolerance:e}", route.method());
            let (a, b) = (&found.state, &reference.state);
            assert_agree(&what("elastic forces"), (&found.elastic, &reference.elastic), bound);
            if is_held {
                assert_agree(&what("displacements"), (&a.u, &b.u), bound);
            }
            assert_agree(&what("stresses"), (&found.stresses, &reference.stresses), bound);
            assert_agree(&what("reactions"), (&found.reactions, &reference.reactions), bound);
            assert_agree(&what("work"), (&[found.work], &[reference.work]), bound);
        }
    }
    reference
}

fn all(tolerance: f64) -> Vec<Box<dyn Solver<Contact2d>>> {
    routes(tolerance).into()
}

/// Without pivoting, which gives the reference.
fn without_lemke(tolerance: f64) -> Vec<Box<dyn Solver<Contact2d>>> {
    vec![Box::new(interior(tolerance)), Box::new(program(tolerance))]
}

/// The bricks of the lowest course in the middle have room between their neighbours.
#[test]
fn the_square_panel_on_two_corners() {
    let answer = assert_one_state(&Case::new("panel_square"), false, without_lemke);
    assert!((largest(&answer.state.u) / 2.01471e-4 - 1.0).abs() < 1e-5);
}

#[test]
fn the_square_panel_on_a_full_floor() {
    let case = Case::new("panel_square_full_floor");
    let answer = assert_one_state(&case, true, without_lemke);
    assert!((largest(&answer.state.u) / 8.95566e-5 - 1.0).abs() < 1e-5);
}

/// Two states are known; all methods come to the one in which the middle bricks hang.
#[test]
fn the_rectangular_panel() {
    let answer = assert_one_state(&Case::new("panel_rectangular"), true, all);
    assert!((largest(&answer.state.u) / 1.27927e-4 - 1.0).abs() < 1e-5);
}

#[test]
fn panels_without_friction() {
    for name in ["panel_square", "panel_square_full_floor", "panel_rectangular"] {
        let case = Case::new(name).changed(Some(0.0), 0.0);
        let reference = case.solved(&lemke(1e-12), 1e-12);
        for tolerance in TOLERANCES {
            for route in routes(tolerance) {
                let found = case.solved(&*route, tolerance);
                let bound = 1e2 * tolerance;
                let what =
                    |what: &str| format!("{name}: {what}, {}, {tolerance:e}", route.method());
                assert_agree(&what("elastic"), (&found.elastic, &reference.elastic), bound);
                assert_agree(&what("stresses"), (&found.stresses, &reference.stresses), bound);
                assert_agree(&what("work"), (&[found.work], &[reference.work]), bound);
            }
        }
    }
}

/// Floating bricks have no definite stiffness, which the sweeps say.
#[test]
fn sweeps_refuse_bricks_that_float() {
    for name in ["block_on_floor", "stack", "wedge", "panel_square", "panel_rectangular"] {
        match sweeps(1e-8).solve(&Case::new(name).problem) {
            Err(Error::NotTreated { method: Method::GaussSeidel, reason }) => {
                assert!(reason.contains("definite"));
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

#[test]
fn bedded_panels_by_sweeps_too() {
    let with_sweeps = |tolerance: f64| -> Vec<Box<dyn Solver<Contact2d>>> {
        let mut routes = without_lemke(tolerance);
        routes.push(Box::new(sweeps(tolerance)));
        routes
    };
    for mu in [0.0, 0.2] {
        let case = Case::new("panel_rectangular").changed(Some(mu), 0.05);
        assert_one_state(&case, true, with_sweeps);
    }
}

/// Nothing is elastic: displacements are zero, resultants are those of equilibrium.
#[test]
fn rigid_blocks() {
    for name in ["block_on_floor", "stack", "wedge"] {
        let case = Case::new(name);
        for tolerance in TOLERANCES {
            for route in routes(tolerance) {
                let found = case.solved(&*route, tolerance);
                assert!(largest(&found.state.u) <= 1e2 * tolerance, "{name}, {}", route.method());
            }
        }
    }
}

/// Without friction it can be proved.
#[test]
fn without_a_floor_and_friction_nothing_is_solved() {
    assert_unsolved(0.0, Status::Infeasible, &[Status::Infeasible]);
}

/// All attempts of dense pivots take seconds.
#[cfg(feature = "long-tests")]
#[test]
fn without_a_floor_nothing_is_solved() {
    // The sequence ends when programs bring nothing more, or with one that comes to its own limit on iterations.
    assert_unsolved(1.0, Status::RayTermination, &[Status::Stalled, Status::IterationLimit]);
}

/// Friction at the walls alone cannot carry the panel, and without friction nothing does: it falls without a bound,
/// and no method may take that for a solution.
#[track_caller]
fn assert_unsolved(mu: f64, by_lemke: Status, by_program: &[Status]) {
    let case = Case::new("panel_no_floor").changed(Some(mu), 0.0);
    let solution = Solver::<Contact2d>::solve(&lemke(1e-4), &case.problem).unwrap();
    assert_eq!(solution.status, by_lemke);
    for tolerance in TOLERANCES {
        let solution = program(tolerance).solve(&case.problem).unwrap();
        let status = solution.status;
        assert!(by_program.contains(&status), "{mu}, {tolerance:e}: {status}");
        assert_eq!(solution.certificate.is_some(), status == Status::Infeasible);
    }
}

/// Without a floor and friction no forces balance the loads, which is proved. With friction some do, but not together with the
/// displacements that they cause: nothing is claimed.
#[test]
fn without_a_floor_the_interior_point_claims_what_it_proves() {
    for (mu, expected) in [(1.0, Status::Stalled), (0.0, Status::Infeasible)] {
        let case = Case::new("panel_no_floor").changed(Some(mu), 0.0);
        for tolerance in TOLERANCES {
            let solution = Solver::<Contact2d>::solve(&interior(tolerance), &case.problem).unwrap();
            assert_eq!(solution.status, expected, "{mu}, {tolerance:e}");
            let certificate = solution.certificate;
            assert_eq!(certificate.is_some(), expected == Status::Infeasible);
            let general = case.problem.to_general();
            assert!(certificate.is_none_or(|certificate| certificate.holds(&general)));
        }
    }
}
