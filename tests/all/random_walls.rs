//! Random walls with openings, tilted at random: what `auto` says against pivots on the reduced problem.
//!
//! `WALLS=100 cargo test --test random_walls` tries as many, of up to 400 bricks.

use masonry::model::Model;
use masonry::plan::Plan;
use masonry::scene::{Brick, Joint, Material, Opening, Plane, Route, Scene, Support, Wall};
use masonry::units::Units;
use masonry::{Outcome, Verdict, solve};

const BRICK: Brick = Brick { length: 0.25, height: 0.125 };
/// Without the variable.
const WALLS: usize = 10;
/// Pivots take some seconds on dense matrices of this order.
const LARGEST_ORDER: usize = 3000;

/// Numbers that are the same in every run, by the generator `SplitMix64` (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Below one.
    pub fn part(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: u32, high: u32) -> u32 {
        low + u32::try_from(self.next() % u64::from(high + 1 - low)).expect("a small number")
    }
}

/// A wall of some bricks, with up to two openings, of rigid or elastic bricks, on a tilted floor.
fn wall(random: &mut Random, largest: u32) -> Scene {
    let (bricks, courses) = (random.between(5, largest), random.between(4, largest));
    let mut bond =
        Wall::running_bond("wall", "brick", BRICK, f64::from(bricks) * BRICK.length, courses);
    for _ in 0..random.between(0, 2) {
        bond = bond.opening(Opening {
            x: BRICK.length * (0.5 * f64::from(random.between(2, 2 * bricks - 4))),
            width: BRICK.length * (0.5 * f64::from(random.between(1, 4))),
            course: random.between(1, courses - 2),
            courses: random.between(1, 3),
            bearing: None,
            lintel: None,
        });
    }
    let is_elastic = random.between(0, 2) == 0;
    let material = if is_elastic { Material::elastic(5e9, 0.15) } else { Material::rigid() };
    let mesh = [random.between(1, 2), 1];
    let mu = 0.3 + 0.9 * random.part();
    let tilt = (0.6 * random.part()).atan();
    let width = f64::from(bricks) * BRICK.length;
    Scene::new("random", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.25)
        .gravity([9.81 * tilt.sin(), -9.81 * tilt.cos()])
        .material("brick", material.density(1800.0))
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(mu))
        .wall(if is_elastic { bond.mesh(mesh) } else { bond })
        .support(Support::new("floor", [0.0, 0.0], [width, 0.0], "bed"))
}

fn is_sound(outcome: &Outcome) -> bool {
    outcome.judgement.verdict != Verdict::Stands
        || outcome.checks.as_ref().is_none_or(|checks| checks.worst() <= 1e-9)
}

/// Verdicts agree wherever both have one, and states that stand are judged to 1e-9.
#[test]
fn verdicts_of_random_walls_agree() {
    let count = std::env::var("WALLS").map_or(WALLS, |it| it.parse().expect("a number of walls"));
    let largest = if count > WALLS { 20 } else { 7 };
    let mut random = Random(1);
    let (mut tried, mut compared) = (0, 0);
    while tried < count {
        let scene = wall(&mut random, largest);
        // Openings that overlap or leave no wall beside them.
        let Ok(outcome) = solve(&scene) else { continue };
        tried += 1;
        let (verdict, evidence) = (outcome.judgement.verdict, outcome.judgement.evidence);
        assert_ne!(verdict, Verdict::Undecided, "wall {tried}: {}", outcome.judgement.sentence);
        assert!(is_sound(&outcome), "wall {tried}: {:?}", outcome.checks);
        let pivots = scene.clone().route(Route::Lemke);
        let model = Model::from_scene(&pivots).expect("a sound scene");
        let order = Plan::of(&pivots, &model).routes[0].largest_order;
        if order > LARGEST_ORDER {
            continue;
        }
        let other = solve(&pivots).expect("a sound scene");
        assert!(is_sound(&other), "wall {tried} by pivots: {:?}", other.checks);
        let is_decided = other.judgement.verdict != Verdict::Undecided;
        compared += usize::from(is_decided);
        let agree = !is_decided || other.judgement.verdict == verdict;
        assert!(agree, "wall {tried}: {verdict} ({evidence:?}) and {}", other.judgement.verdict);
    }
    assert!(4 * compared > count, "only {compared} of {count} were decided by both");
}
