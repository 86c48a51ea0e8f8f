//! Walls that are hard to decide: tilts near the largest that any forces hold, open bases, settlements in one step, five and
//! twenty. The bench `scaling` has the same table for walls of a thousand bricks.

#[path = "../../benches/scaling/walls.rs"]
mod walls;

use masonry::scene::Route;
use masonry::{Evidence, Verdict, solve};
use walls::{Case, DRY, Wall};

/// Bricks in a course, and courses.
const COURSES: u32 = 6;
/// Elastic walls that stand may take no more factorisations, in any step of a history: with hard joints, and with dry ones.
const MOST_FACTORISATIONS: [usize; 2] = [1000, 400];

/// Histories of twenty steps may take no more on average: elastic bricks with hard joints, and all others.
const MEAN_FACTORISATIONS: [usize; 2] = [300, 100];

/// Verdict and evidence, within these factorisations.
fn verdict_of(wall: &Wall, case: Case, limit: f64) -> (Verdict, Evidence) {
    let (judgement, steps) = solved(wall, case, limit);
    if wall.mesh.is_some() && judgement.0 == Verdict::Stands {
        let most = steps.into_iter().max().unwrap_or(0);
        let limit = MOST_FACTORISATIONS[usize::from(wall.joints.is_some())];
        assert!(most <= limit, "{wall:?}: {case}: {most}");
    }
    judgement
}

/// Verdict and evidence, and the factorisations of all steps.
fn solved(wall: &Wall, case: Case, limit: f64) -> ((Verdict, Evidence), Vec<usize>) {
    let outcome = solve(&wall.scene(case, limit)).expect("a sound scene");
    let judgement = (outcome.judgement.verdict, outcome.judgement.evidence);
    let steps = match &outcome.history {
        Some(history) => history.records.iter().map(|record| record.factorisations).collect(),
        None => vec![outcome.solve.factorisations],
    };
    (judgement, steps)
}

/// Walls may slide and fall before the largest tilt that any forces hold, never after. Walls that settle come to rest.
fn check(mu: f64, mesh: [u32; 2]) {
    let rigid = Wall { courses: COURSES, mu, mesh: None, joints: None };
    let limit = rigid.largest_tilt();
    assert!(limit > 0.0 && limit <= mu + 1e-3, "mu {mu}: {limit}");
    let hard = Wall { mesh: Some(mesh), ..rigid };
    for wall in [rigid, hard, Wall { joints: DRY, ..hard }] {
        let verdict = |case| verdict_of(&wall, case, limit);
        for case in [Case::Lean, Case::Settlement(1), Case::Settlement(5)] {
            assert_eq!(verdict(case).0, Verdict::Stands, "{wall:?}: {case}");
        }
        for case in [Case::Tilt(0.5), Case::Tilt(0.9), Case::Tilt(0.99)] {
            let found = verdict(case);
            let flows = found == (Verdict::Falls, Evidence::Motion);
            assert!(found.0 == Verdict::Stands || flows, "{wall:?}: {case}: {found:?}");
        }
        for case in [Case::Tilt(1.01), Case::Tilt(1.3)] {
            let (falls, evidence) = verdict(case);
            assert_eq!(falls, Verdict::Falls, "{wall:?}: {case}");
            assert_ne!(evidence, Evidence::Motion, "{wall:?}: {case}");
        }
        let (open, evidence) = verdict(Case::OpenBase);
        assert_ne!(open, Verdict::Undecided, "{wall:?}: open base: {evidence:?}");
    }
}

/// Loading leads rigid bricks to rest here; elastic ones without anything soft between them slide apart first, although
/// forces exist that would hold them.
#[test]
fn small_walls_on_open_bases_stand_or_flow() {
    let found = |mesh| {
        let wall = Wall { courses: 10, mu: 0.7, mesh, joints: None };
        solved(&wall, Case::OpenBase, 0.0).0
    };
    assert_eq!(found(None), (Verdict::Stands, Evidence::AdmissibleForces));
    for mesh in [[1, 1], [2, 1]] {
        assert_eq!(found(Some(mesh)), (Verdict::Falls, Evidence::Motion), "{mesh:?}");
    }
}

/// The number of walls of each kind that settle in twenty steps.
const OF_EACH_KIND: usize = if cfg!(feature = "long-tests") { 2 } else { 1 };

#[test]
fn walls_that_settle_in_twenty_steps_come_to_rest() {
    let (coarse, fine) = (Some([1, 1]), Some([2, 1]));
    let rigid = [0.6, 1.3].map(|mu| Wall { courses: 10, mu, mesh: None, joints: None });
    let hard = [(0.5, coarse), (1.0, fine)].map(|(mu, mesh)| Wall { mu, mesh, ..rigid[0] });
    let dry = hard.map(|wall| Wall { joints: DRY, ..wall });
    let walls = [rigid, hard, dry].map(|walls| walls[..OF_EACH_KIND].to_vec()).concat();
    for wall in walls {
        let (found, steps) = solved(&wall, Case::Settlement(20), 0.0);
        assert_eq!(found, (Verdict::Stands, Evidence::Equilibrium), "{wall:?}");
        let mean = steps.iter().sum::<usize>() / steps.len();
        let limit = MEAN_FACTORISATIONS[usize::from(wall.mesh.is_none() || wall.joints.is_some())];
        assert!(steps.len() == 21 && mean <= limit, "{wall:?}: {steps:?}");
    }
}

/// Joints that do not give way make steps hard to solve, which somebody who has no answer should know.
#[test]
fn an_open_history_of_hard_joints_says_what_helps() {
    let hard = Wall { courses: 4, mu: 0.6, mesh: Some([1, 1]), joints: None };
    for (wall, is_told) in [(hard, true), (Wall { joints: DRY, ..hard }, false)] {
        let scene = wall.scene(Case::Settlement(2), 0.0).route(Route::Lemke).max_pivots(1);
        let judgement = solve(&scene).expect("a sound scene").judgement;
        assert_eq!(judgement.verdict, Verdict::Undecided, "{}", judgement.sentence);
        let mut told = judgement.warnings.iter().filter(|it| it.contains("do not give way"));
        assert_eq!(told.next().is_some(), is_told, "{:?}", judgement.warnings);
    }
}

#[test]
fn walls_with_little_friction_are_decided() {
    check(0.3, [2, 1]);
}

#[test]
fn walls_with_usual_friction_are_decided() {
    check(0.6, [1, 1]);
}

#[test]
fn walls_with_friction_at_its_critical_value_are_decided() {
    check(1.0, [2, 1]);
}

#[test]
fn walls_with_much_friction_are_decided() {
    check(1.3, [2, 1]);
}

#[cfg(feature = "long-tests")]
#[test]
fn walls_with_friction_in_between_are_decided() {
    for (mu, mesh) in [(0.5, [1, 1]), (0.7, [2, 1]), (0.9999, [1, 1]), (1.0001, [1, 1])] {
        check(mu, mesh);
    }
}

/// Walls of 1040 bricks, at a critical friction and near their limit, on which interior points jam from their first start:
/// loading is long, and leads to rest. A tilt of 0.99 of the limit is not decided within the factorisations of one loading if
/// the friction is 0.5 or 1.
#[cfg(feature = "long-tests")]
#[test]
fn walls_on_which_the_first_attempt_jams_stand() {
    let wall = |mu, mesh| Wall { courses: 32, mu, mesh: Some(mesh), joints: None };
    for (mu, mesh) in [(0.3, [2, 1]), (0.9999, [2, 1]), (1.0001, [2, 1]), (1.3, [1, 1])] {
        let (found, _) = solved(&wall(mu, mesh), Case::OpenBase, 0.0);
        assert_eq!(found, (Verdict::Stands, Evidence::Equilibrium), "mu {mu}, {mesh:?}");
    }
    for mu in [0.6, 0.7] {
        let limit = Wall { mesh: None, ..wall(mu, [2, 1]) }.largest_tilt();
        let (found, _) = solved(&wall(mu, [2, 1]), Case::Tilt(0.9), limit);
        assert_eq!(found, (Verdict::Stands, Evidence::Equilibrium), "mu {mu}");
    }
}

/// A wall of 1040 bricks near its limit, where forces are far larger than loads and single contacts come and go: neither hides
/// that the bricks flow.
#[cfg(feature = "long-tests")]
#[test]
fn a_wall_near_its_limit_flows() {
    let rigid = Wall { courses: 32, mu: 0.6, mesh: None, joints: None };
    let limit = rigid.largest_tilt();
    let wall = Wall { mesh: Some([2, 1]), ..rigid };
    assert_eq!(verdict_of(&wall, Case::Tilt(0.99), limit), (Verdict::Falls, Evidence::Motion));
}

/// Rigid walls of 2328 bricks, in which contacts near rest cannot all be closed at once.
#[cfg(feature = "long-tests")]
#[test]
fn large_rigid_walls_that_settle_come_to_rest() {
    for mu in [0.5, 1.0, 1.3] {
        let wall = Wall { courses: 48, mu, mesh: None, joints: None };
        let found = verdict_of(&wall, Case::Settlement(1), 0.0);
        assert_eq!(found, (Verdict::Stands, Evidence::Equilibrium), "mu {mu}");
    }
}
