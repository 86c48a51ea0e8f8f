//! What the last digits cost: the equations of the states of all contacts, solved from nothing else by one factorisation.

use lcp::refine::{Refined, Refinement};
use masonry::analysis::solve::solve;
use masonry::analysis::study::{Exact, Reference, Study, refined};
use masonry::scene::Scene;

/// How often each is solved; its time is the median.
const REPEATS: usize = 3;

/// What is left of an answer that is solved so far.
pub(crate) struct Refining {
    pub(crate) refinement: Refinement,
    /// Wall-clock time of the factorisation and all solves \[s\].
    pub(crate) seconds: f64,
    /// Solves with the factors.
    pub(crate) passes: usize,
    /// The largest residual of an equation, relative to the terms of its row \[-\].
    pub(crate) residual: f64,
    /// The error of the forces on the nodes against the reference, relative to the largest \[-\].
    pub(crate) error: Option<f64>,
}

/// The references of all meshes of a study once more, refined; `None` where that is no better.
pub(crate) fn references(scene: &Scene, study: &Study) -> Vec<Option<Exact>> {
    let again = |factor: u32, it: &Reference| {
        let scene = refined(scene, factor).route(it.route).tolerance(it.tolerance).stresses(true);
        Exact::of(&solve(&scene).ok()?).filter(|exact| exact.verified.is_better())
    };
    let meshes = study.meshes.iter();
    meshes.map(|mesh| again(mesh.factor, mesh.reference.as_ref()?)).collect()
}

/// One solve, one refinement, and compensated refinement.
pub(crate) fn refinings(exact: &Exact) -> Vec<Refining> {
    let all = [Refinement::Plain, Refinement::Single, Refinement::Extended];
    all.into_iter().filter_map(|refinement| one(exact, refinement)).collect()
}

fn one(exact: &Exact, refinement: Refinement) -> Option<Refining> {
    let runs: Option<Vec<Refined>> = (0..REPEATS).map(|_| solved_anew(exact, refinement)).collect();
    let mut runs = runs?;
    runs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let Refined { seconds, passes, residual, ref on_bodies, .. } = runs[REPEATS / 2];
    let error = exact.refined.distance(on_bodies);
    Some(Refining { refinement, seconds, passes, residual, error })
}

fn solved_anew(exact: &Exact, refinement: Refinement) -> Option<Refined> {
    let problem = &exact.sparse.problem;
    let zero = |len: usize| vec![0.0; len];
    let (n, m) = (problem.displacements(), problem.points());
    let rest = problem.state(zero(n), zero(m), zero(m));
    problem.refine(&rest, &exact.statuses, refinement).ok()
}
