//! Pictures of what moves, of what a scene is made of, and of histories.

use std::ops::ControlFlow;
use std::path::Path;

use masonry::analysis::limit::{Laws, Limit, limit_by};
use masonry::analysis::solve::Run;
use masonry::model::{Model, Plane};
use masonry::scene::{Block, Brick, Joint, Load, Material, Movement, Scene, Stage, Support, Wall};
use masonry::units::Units;
use masonry_report::hinges::{Yield, yielding};
use masonry_report::svg;
use nalgebra::Point2;
use roxmltree::{Document, Node};

/// A block of 0.2 m by 1 m that is pushed by its mass.
fn pushed(mu: f64) -> Limit {
    let scene = Scene::new("Block", Units::SI)
        .thickness(1.0)
        .gravity([0.0, -10.0])
        .material("stone", Material::rigid().density(1000.0))
        .joint("floor", Joint::mu(mu))
        .block(Block::new("block", "stone", [[0.0, 0.0], [0.2, 0.0], [0.2, 1.0], [0.0, 1.0]]))
        .support(Support::new("ground", [-1.0, 0.0], [1.0, 0.0], "floor"))
        .load(Load::acceleration("quake", [10.0, 0.0]));
    limit_by(&scene, Laws::Associative).unwrap()
}

fn with_class<'a>(document: &'a Document<'a>, class: &str) -> Vec<Node<'a, 'a>> {
    let all = document.descendants();
    all.filter(|node| node.attribute("class") == Some(class)).collect()
}

/// How many marks of a class the drawing has, without its legend.
fn marks(document: &Document<'_>, class: &str) -> usize {
    let drawing = &with_class(document, "drawing")[0];
    let groups = drawing.children().filter(|node| node.attribute("class") == Some(class));
    groups.map(|group| group.children().filter(Node::is_element).count()).sum()
}

fn texts(document: &Document<'_>) -> Vec<String> {
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    texts.filter_map(|node| node.text()).map(|it| it.replace('\u{a0}', " ")).collect()
}

#[test]
fn a_block_tips_about_its_corner_or_slides() {
    let tips = pushed(0.7);
    let rates = tips.associative.unwrap().mechanism.unwrap();
    let [it] = yielding(&tips.model, &rates)[..] else { panic!("one joint") };
    assert_eq!(it.does, Yield::Hinge);
    assert!((it.at - Point2::new(0.2, 0.0)).norm() < 1e-9, "{}", it.at);
    assert!((it.opens - 1.0).abs() < 1e-9 && it.slides < 1e-6, "{it:?}");
    let picture = svg::mechanism("Block", &tips.model, &rates);
    let document = Document::parse(&picture).unwrap();
    assert_eq!(marks(&document, "hinge"), 1);
    assert!(texts(&document).contains(&"hinge: 1 joint".to_owned()));
    assert!(texts(&document).contains(&"1".to_owned()), "its number");

    let slides = pushed(0.1);
    let rates = slides.associative.unwrap().mechanism.unwrap();
    let [it] = yielding(&slides.model, &rates)[..] else { panic!("one joint") };
    // With associated flow it rises by a tenth of its way, and still it touches the floor.
    assert_eq!(it.does, Yield::Slides);
    assert!((it.opens - 0.1).abs() < 1e-6 && (it.slides - 1.0).abs() < 1e-9, "{it:?}");
    let picture = svg::mechanism("Block", &slides.model, &rates);
    let document = Document::parse(&picture).unwrap();
    assert_eq!(marks(&document, "slides"), 1);
    assert!(texts(&document).contains(&"sliding: 1 joint".to_owned()));
}

#[test]
fn nothing_yields_in_a_body_that_moves_as_one_or_not_at_all() {
    let limit = pushed(0.7);
    let still = vec![vec![nalgebra::Vector2::zeros(); 4]];
    assert!(yielding(&limit.model, &still).is_empty());
}

#[test]
fn hinges_of_an_arch_are_numbered_in_their_order() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/arch_semicircular.toml");
    let scene = Scene::read(&path);
    let limit = limit_by(&scene.unwrap(), Laws::Associative).unwrap();
    let rates = limit.associative.unwrap().mechanism.unwrap();
    let joints = yielding(&limit.model, &rates);
    // Four, in turn at the inner and at the outer side.
    let hinges: Vec<f64> = joints.iter().map(|it| (it.at - Point2::new(0.9, 0.0)).norm()).collect();
    assert_eq!(hinges.len(), 4, "{joints:?}");
    assert!(joints.iter().all(|it| it.does == Yield::Hinge));
    let middle = hinges.iter().sum::<f64>() / 4.0;
    let outside: Vec<bool> = hinges.iter().map(|radius| *radius > middle).collect();
    assert!(outside.windows(2).all(|pair| pair[0] != pair[1]), "{hinges:?}");
    let picture = svg::mechanism("Arch", &limit.model, &rates);
    let document = Document::parse(&picture).unwrap();
    let numbers = ["1", "2", "3", "4"].map(str::to_owned);
    assert!(numbers.iter().all(|number| texts(&document).contains(number)));
}

/// A wall whose courses slide on each other, the higher the faster: more joints than can be numbered, most of them slow.
#[test]
fn slow_blocks_are_light_and_slow_joints_of_many_have_no_marks() {
    let scene = Scene::new("Wall", Units::SI)
        .thickness(0.1)
        .material("stone", Material::rigid().density(1000.0))
        .joint("bed", Joint::mu(0.5))
        .joint("head", Joint::mu(0.5))
        .wall(Wall::running_bond("wall", "stone", Brick { length: 0.2, height: 0.1 }, 1.6, 10))
        .support(Support::new("ground", [0.0, 0.0], [1.6, 0.0], "bed"));
    let model = Model::from_scene(&scene).unwrap();
    let rates: Vec<_> = model
        .blocks
        .iter()
        .map(|block| {
            let height = block.corners.iter().map(|corner| corner.y).sum::<f64>() / 4.0;
            vec![nalgebra::Vector2::new(height.powi(4), 0.0); 4]
        })
        .collect();
    let picture = svg::mechanism("Wall", &model, &rates);
    let document = Document::parse(&picture).unwrap();
    let joints = yielding(&model, &rates);
    let marked: Vec<_> = joints.iter().filter(|it| it.number.is_some()).collect();
    let fast = marked.iter().filter(|it| it.opens.max(it.slides) >= 0.05).count();
    assert!(marked.len() > 48 && fast > 0 && fast < marked.len());
    let marks = ["slides", "hinge"].map(|class| marks(&document, class));
    assert_eq!(marks.iter().sum::<usize>(), fast);
    let left_out = format!("no mark: {} joints, slower", marked.len() - fast);
    let texts = texts(&document);
    assert!(texts.iter().any(|text| text.starts_with(&left_out)), "{texts:?}");
    let speed = |rates: &Vec<nalgebra::Vector2<f64>>| {
        rates.iter().map(nalgebra::Vector2::norm).fold(0.0, f64::max)
    };
    let fastest = rates.iter().map(speed).fold(0.0, f64::max);
    let moving = rates.iter().filter(|it| speed(it) >= 0.05 * fastest).count();
    assert!(texts.contains(&format!("moving: {moving} blocks")), "{texts:?}");
}

#[test]
fn a_scene_shows_dimensions_and_what_blocks_are_made_of() {
    let scene = Scene::new("Two stones", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.4)
        .gravity([0.0, -10.0])
        .material("granite", Material::elastic(5e10, 0.2).density(2700.0))
        .material("tuff", Material::rigid().density(1500.0))
        .joint("bed", Joint::mu(0.6))
        .block(
            Block::new("low", "granite", [[0.0, 0.0], [1.5, 0.0], [1.5, 0.5], [0.0, 0.5]])
                .mesh([2, 1]),
        )
        .block(Block::new("high", "tuff", [[0.0, 0.5], [1.0, 0.5], [1.0, 0.8], [0.0, 0.8]]))
        .support(Support::new("ground", [0.0, 0.0], [1.5, 0.0], "bed"));
    let picture = svg::scene("Two stones", &Model::from_scene(&scene).unwrap());
    let document = Document::parse(&picture).unwrap();
    let all = texts(&document).join(" ");
    for text in [
        "1.5 m",
        "0.8 m",
        "thickness out of the plane 0.4 m",
        "1 block, E = 50 GPa, ν = 0.2, 2700 kg/m³",
        "1 block, rigid, 1500 kg/m³",
    ] {
        assert!(all.contains(text), "{text} is not in {all}");
    }
    // The blocks of each material, and its entry in the legend.
    for class in ["bricks material0", "bricks material1"] {
        assert_eq!(with_class(&document, class).len(), 2, "{class}");
    }
}

/// The floor below a block is drawn away: it follows until it is stopped, and then slides.
#[test]
fn a_history_has_curves_of_the_movement_and_of_the_reactions() {
    let scene = Scene::new("Floor drawn away", Units::SI)
        .thickness(1.0)
        .gravity([0.0, -10.0])
        .material("stone", Material::rigid().density(1000.0))
        .joint("floor", Joint::mu(0.5))
        .joint("stop", Joint::mu(0.0))
        .block(Block::new("block", "stone", [[0.0, 0.0], [1.0, 0.0], [1.0, 0.2], [0.0, 0.2]]))
        .support(Support::new("ground", [-1.0, 0.0], [2.0, 0.0], "floor"))
        .support(Support::new("stop", [1.0, 0.0], [1.0, 0.2], "stop"))
        .stage(Stage::new("weight"))
        .stage(Stage::new("draw").steps(3).moves("ground", Movement::by(0.1, 0.0)));
    let mut run = Run::new(&scene, &mut |_| ControlFlow::Continue(())).unwrap();
    let mut frames = Vec::new();
    while run.advance(&mut |_| ControlFlow::Continue(())).unwrap() {
        frames.extend(run.frame());
    }
    assert_eq!(frames.len(), 4);
    assert!(frames.iter().enumerate().all(|(k, frame)| frame.position == k));
    let outcome = run.finish();
    let history = outcome.history.as_ref().unwrap();
    let picture = svg::history("Floor", &outcome.model, history).unwrap();
    let document = Document::parse(&picture).unwrap();
    let all = texts(&document);
    for text in
        ["\"ground\" moves to the right by [m]", "reactions [N]", "weight", "draw", "stop fx"]
    {
        assert!(all.contains(&text.to_owned()), "{text} is not in {all:?}");
    }
    assert!(!picture.contains("NaN") && !picture.contains("data-steps"));
    // The pushing stop: no force in the first step, half the weight in the others, so its curve has two levels.
    let pixels = |it: &Node<'_, '_>| -> Vec<f64> {
        let points = it.attribute("d").unwrap().trim_start_matches('M').split('L');
        points.filter_map(|it| it.split(' ').nth(1)?.parse().ok()).collect()
    };
    let curves = document.descendants().filter(|it| {
        it.has_tag_name("path") && it.attribute("class").is_some_and(|it| it.starts_with("curve"))
    });
    let levels =
        curves.map(|it| pixels(&it)).find(|it| it.len() == 4 && (it[0] - it[1]).abs() > 1.0);
    let levels = levels.unwrap();
    assert!((levels[1] - levels[3]).abs() < 0.02, "{levels:?}");

    let page = masonry_report::page::solved(&outcome, &frames, None, None);
    assert_eq!(page.matches("data-name=\"draw 3/3\"").count(), 3, "forces, cracks, deformed");
}

#[test]
fn long_histories_have_pictures_of_at_most_forty_two_steps() {
    use masonry_report::page::is_framed;
    for steps in [1, 2, 40, 41, 79, 80, 1000] {
        let shown = (0..steps).filter(|k| is_framed(*k, steps)).count();
        assert!(shown <= 42 && (steps > 40 || shown == steps), "{steps}: {shown}");
        assert!(is_framed(0, steps) && is_framed(steps - 1, steps));
    }
}
