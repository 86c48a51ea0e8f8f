//! Second loadings of load histories, which tell how far the answer is unique.

use std::ops::ControlFlow;

use masonry::analysis::outcome::Outcome;
use masonry::analysis::solve::{Run, solve};
use masonry::history::SecondLoading;
use masonry::scene::{Block, Joint, Load, Material, Movement, Scene, Stage, Support};
use masonry::units::Units;

/// A block on a floor that is drawn away below it, against a stop.
fn drawn_away(stone: Material) -> Scene {
    Scene::new("Floor drawn away", Units::SI)
        .thickness(1.0)
        .gravity([0.0, -10.0])
        .material("stone", stone)
        .joint("floor", Joint::mu(0.5))
        .joint("stop", Joint::mu(0.0))
        .block(Block::new("block", "stone", [[0.0, 0.0], [1.0, 0.0], [1.0, 0.2], [0.0, 0.2]]))
        .load(Load::pressure("top", [0.0, 0.2], [1.0, 0.2], 100.0))
        .support(Support::new("ground", [-1.0, 0.0], [2.0, 0.0], "floor"))
        .support(Support::new("stop", [1.0, 0.0], [1.0, 0.2], "stop"))
        .stage(Stage::new("weight"))
        .stage(Stage::new("draw").steps(6).moves("ground", Movement::by(0.1, 0.0)))
}

fn settlement() -> Scene {
    Scene::from_toml(include_str!("../../scenes/wall_settlement.toml")).unwrap()
}

fn second(outcome: &Outcome) -> SecondLoading {
    outcome.history.as_ref().unwrap().second_loading.unwrap()
}

/// Friction is that of the weight, whatever the way.
#[test]
fn an_answer_that_is_unique_is_the_same_by_both_loadings() {
    let outcome = solve(&drawn_away(Material::rigid().density(1000.0))).unwrap();
    let SecondLoading::Ended(spread) = second(&outcome) else { panic!("{:?}", second(&outcome)) };
    // Two of one, and two of six.
    assert_eq!(spread.steps, 4);
    assert!(spread.is_unique() && spread.largest() < 1e-9, "{spread:?}");
    assert!(!outcome.judgement.sentence.contains("unique"), "{}", outcome.judgement.sentence);
}

#[test]
fn a_second_loading_that_stops_is_told() {
    let scene = settlement();
    let mut run = Run::new(&scene, &mut |_| ControlFlow::Continue(())).unwrap();
    while run.advance(&mut |_| ControlFlow::Continue(())).unwrap() {}
    run.compare(&scene, &mut |_| ControlFlow::Break(())).unwrap();
    let outcome = run.finish();
    assert_eq!(second(&outcome), SecondLoading::Stopped { solved: 0, steps: 4 });
    let sentence = &outcome.judgement.sentence;
    assert!(sentence.starts_with("The wall stands in all 11 steps"), "{sentence}");
    assert!(sentence.contains("a second loading stopped after 0 of 4 steps"), "{sentence}");
}

/// Blocks that move need a mass.
#[test]
fn blocks_without_a_density_are_named() {
    let named = |stone| {
        let outcome = solve(&drawn_away(stone)).unwrap();
        outcome.judgement.warnings.iter().any(|it| it.contains("Block \"block\" has no density"))
    };
    assert!(named(Material::rigid()));
    assert!(!named(Material::rigid().density(1000.0)));
}
