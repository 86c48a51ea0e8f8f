//! Verdicts of random walls against a linear program of admissible forces that is set up here, from the geometry of the
//! contact points alone, and solved by another library.
//!
//! Every wall is tilted around the largest tilt for which that program has a solution. Rigid walls without gaps stand
//! below it and fall above, and elastic ones and those with gaps fall above it too. These may also fall a little below it,
//! since friction does not open joints: then a motion says so, never a proof.

mod program;
mod walls;

use masonry::analysis::solve::solve;
use masonry::data::verdict::{Evidence, Verdict};
use masonry::scene::{Brick, Joint, Material, Scene, Support, Wall};
use masonry::units::{ForceUnit, LengthUnit, Units};

use program::{Limit, largest_tilt};
use walls::{Kind, Random, Tiltable};

/// Of the largest tilt.
const AROUND: [f64; 5] = [0.5, 1.0 - 1e-3, 1.0 - 1e-5, 1.0 + 1e-5, 1.0 + 1e-3];

#[test]
fn verdicts_agree_with_a_linear_program() {
    let mut random = Random(20_261_122);
    let (scenes, open) = compared((0..48).map(|_| walls::any(&mut random)));
    assert!((180..300).contains(&scenes), "{scenes} scenes");
    // Loading need not lead to admissible forces, and near the limit an elastic wall may find no equilibrium with them.
    assert!(7 * open.len() <= scenes, "{} of {scenes}: {open:#?}", open.len());
}

/// Hexagons, octagons and a triangle, which are rigid.
#[test]
fn verdicts_on_polygons_agree_too() {
    let mut random = Random(20_261_123);
    let (scenes, open) = compared((0..12).map(|_| walls::polygons(&mut random)));
    assert!(scenes >= 36, "{scenes} scenes");
    assert_eq!(open, [""; 0]);
}

/// Rigid blocks with admissible forces do not fall, even if no method meets the tolerance.
#[test]
fn a_tolerance_that_nothing_meets_makes_no_wall_fall() {
    let brick = Brick { length: 0.25, height: 0.125 };
    for tilt in [0.1, 0.35, 0.39] {
        let scene = Scene::new("tilted", Units { length: LengthUnit::M, force: ForceUnit::Kn })
            .thickness(0.25)
            .gravity([9.81 * tilt, -9.81])
            .material("brick", Material::rigid().density(1800.0))
            .joint("bed", Joint::mu(0.4))
            .joint("head", Joint::mu(0.4))
            .wall(Wall::running_bond("wall", "brick", brick, 1.0, 4))
            .support(Support::new("floor", [0.0, 0.0], [1.0, 0.0], "bed"))
            .tolerance(1e-30);
        let judgement = solve(&scene).unwrap().judgement;
        assert_eq!(judgement.verdict, Verdict::Undecided, "{tilt}: {}", judgement.sentence);
        assert_eq!(judgement.evidence, Evidence::AdmissibleForces, "{tilt}");
    }
}

/// The number of scenes, and those without a verdict.
fn compared(walls: impl Iterator<Item = Tiltable>) -> (usize, Vec<String>) {
    let (mut scenes, mut open) = (0, Vec::new());
    for (number, wall) in walls.enumerate() {
        let limit = largest_tilt(&wall.model());
        let tilts: Vec<(f64, bool)> = match limit {
            Limit::None => vec![(0.0, false)],
            Limit::Unlimited => vec![(0.3, true), (3.0, true)],
            Limit::Tilt(limit) if limit > 1e-6 => {
                AROUND.iter().map(|part| (part * limit, *part < 1.0)).collect()
            }
            // Any tilt is too much.
            Limit::Tilt(_) => vec![(1e-3, false), (0.1, false)],
        };
        for (tilt, stands) in tilts {
            let name = format!("{number}: {} tilted by {tilt}, limit {limit:?}", wall.title());
            let outcome =
                solve(&wall.tilted(tilt)).unwrap_or_else(|error| panic!("{name}: {error}"));
            let (verdict, evidence) = (outcome.judgement.verdict, outcome.judgement.evidence);
            scenes += 1;
            if !stands {
                assert_eq!(verdict, Verdict::Falls, "{name}: {:#?}", outcome.solve.attempts);
                assert_eq!(evidence, Evidence::NoAdmissibleForces, "{name}");
                continue;
            }
            if verdict == Verdict::Falls {
                // Forces exist, and this loading does not lead to them.
                assert_eq!(evidence, Evidence::Motion, "{name}");
                open.push(format!("{name}: {}", outcome.judgement.sentence));
            } else if wall.kind == Kind::Rigid {
                assert_eq!(verdict, Verdict::Stands, "{name}: {:#?}", outcome.solve.attempts);
                assert_eq!(evidence, Evidence::AdmissibleForces, "{name}");
            } else if verdict == Verdict::Undecided {
                open.push(format!("{name}: {}", outcome.judgement.sentence));
            }
        }
    }
    (scenes, open)
}
