//! Earth and water beside walls, against the closed forms of gravity walls.

use masonry::analysis::limit::{Laws, limit_by};
use masonry::analysis::solve::solve;
use masonry::data::verdict::Verdict;
use masonry::model::Model;
use masonry::scene::{Earth, Joint, Load, Material, Scene, Support};
use masonry_report::summary;

use super::common::{M_KN, assert_close, difference, rectangle};
use super::{GRAVITY, WEIGHT};

const WIDTH: f64 = 1.2;
const HEIGHT: f64 = 3.0;
const BACKFILL: Earth = Earth { gamma: 18.0, k: 0.3, level: HEIGHT };

/// A gravity wall of blocks one upon the other, with earth on its left side.
fn retaining_wall(blocks: u32, mu: f64, earth: Earth) -> Scene {
    let scene = Scene::new("Retaining wall", M_KN)
        .thickness(1.0)
        .gravity([0.0, -GRAVITY])
        .material("stone", Material::rigid().density(2000.0))
        .joint("bed", Joint::mu(mu))
        .support(Support::new("ground", [-1.0, 0.0], [3.0, 0.0], "bed"))
        .load(Load::earth("earth", [0.0, 0.0], [0.0, HEIGHT], earth))
        .limit_group("earth");
    let course = |k: u32| {
        let [low, high] = [k, k + 1].map(|it| HEIGHT * f64::from(it) / f64::from(blocks));
        rectangle(&k.to_string(), "stone", [0.0, WIDTH], [low, high])
    };
    (0..blocks).map(course).fold(scene, Scene::block)
}

fn limit(scene: &Scene) -> f64 {
    limit_by(scene, Laws::Associative).unwrap().associative.unwrap().load_factor.unwrap()
}

/// The weight turns the wall about its toe by `W b / 2`, and a triangle of earth by `K gamma h^3 / 6`.
#[test]
fn earth_overturns_a_gravity_wall() {
    let weight = WEIGHT * WIDTH * HEIGHT;
    let expected = weight * WIDTH / 2.0 / (0.3 * 18.0 * HEIGHT.powi(3) / 6.0);
    assert_close(expected, 1.7440, 1e-6);
    for blocks in [1, 6] {
        assert_close(limit(&retaining_wall(blocks, 0.8, BACKFILL)), expected, 1e-6);
    }
    for (part, verdict) in [(0.999, Verdict::Stands), (1.001, Verdict::Falls)] {
        let mut scene = retaining_wall(6, 0.8, BACKFILL);
        scene.loads[0].factor = part * expected;
        assert_eq!(solve(&scene).unwrap().judgement.verdict, verdict);
    }
}

/// Friction carries `mu W`, and the thrust is `K gamma h^2 / 2`.
#[test]
fn earth_pushes_a_gravity_wall_off() {
    let expected = 0.4 * WEIGHT * WIDTH * HEIGHT / (0.3 * 18.0 * HEIGHT * HEIGHT / 2.0);
    for blocks in [1, 6] {
        assert_close(limit(&retaining_wall(blocks, 0.4, BACKFILL)), expected, 1e-6);
    }
}

/// Water that stands lower than the wall has its thrust `gamma d^2 / 2` at a third of its depth `d`, also if its level is in
/// the middle of a block.
#[test]
fn water_below_the_top() {
    for (blocks, depth) in [(1, 2.0), (6, 2.0), (6, 1.7), (6, 0.3), (6, 3.4)] {
        let water = Earth { gamma: 9.81, k: 1.0, level: depth };
        let model = Model::from_scene(&retaining_wall(blocks, 0.8, water)).unwrap();
        let sum = summary::load_groups(&model)[0].sum;
        let above = (depth - HEIGHT).max(0.0);
        let thrust = 9.81e3 * (depth * depth - above * above) / 2.0;
        let moment =
            9.81e3 * (depth.powi(3) / 6.0 - above.powi(3) / 6.0 - above * above * HEIGHT / 2.0);
        assert!(
            difference(&[thrust, 0.0, -moment], &[sum.force.x, sum.force.y, sum.moment]) < 1e-12
        );
    }
}

/// Earth presses across a back that leans: `K gamma h^2 / 2` to the side, and its weight on the slope downwards. An
/// acceleration of all mass leaves it alone, without a question.
#[test]
fn earth_on_a_battered_back() {
    let mut scene = retaining_wall(1, 0.8, BACKFILL);
    scene.blocks[0].corners = vec![[0.0, 0.0], [WIDTH, 0.0], [WIDTH, HEIGHT], [0.5, HEIGHT]];
    scene.loads[0].to = Some([0.5, HEIGHT]);
    let scene = scene.load(Load::acceleration("quake", [0.5, 0.0]));
    let model = Model::from_scene(&scene).unwrap();
    let sum = summary::load_groups(&model)[0].sum;
    let across = 0.3 * 18e3 * HEIGHT / 2.0;
    let expected = [across * HEIGHT, -across * 0.5];
    assert!(difference(&expected, &[sum.force.x, sum.force.y]) < 1e-12, "{sum:?}");
    assert_eq!(model.unusual(), Vec::<String>::new());
}
