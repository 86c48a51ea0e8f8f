//! Walls of one pattern from 2 to 2000 bricks, and one on a support that settles.

use masonry::scene::{Brick, Joint, Movement, Route, Scene, Stage, Support, Wall};

use super::case::Case;
use super::common::GRAVITY;
use super::scenes::{elastic, reactions_off, scene, wall};
use super::sweep::{Sweep, decades};

pub const TITLE: &str = "Growth";

pub fn cases() -> Vec<Case> {
    let mut list: Vec<Case> = SIZES.map(grown).into();
    list.push(grown([52, 39]));
    list.push(settled(0.004));
    list
}

pub fn sweeps() -> Vec<Sweep> {
    let lengths = [2_u32, 4, 6, 8, 12, 16, 20, 28, 40, 52];
    vec![
        Sweep::new(
            "wall that grows",
            "bricks in a course, on 3/4 as many courses",
            lengths.map(f64::from),
            move |length| {
                let length = lengths.into_iter().find(|it| f64::from(*it) >= length).unwrap();
                grown([length, 3 * length / 4])
            },
        ),
        Sweep::new(
            "wall on a support that settles",
            "settlement / length of the wall [-]",
            decades(-12, -2, 1),
            |share| settled(1.5 * share),
        ),
    ]
}

/// Bricks in a course, and courses.
const SIZES: [[u32; 2]; 5] = [[2, 1], [4, 2], [8, 5], [12, 8], [16, 12]];

fn grown([length, courses]: [u32; 2]) -> Case {
    let width = 0.2 * f64::from(length);
    let bricks = length * courses + courses / 2;
    let slow: &[Route] = match bricks {
        0..20 => &[],
        20..120 => &[Route::Pgs],
        120..300 => &[Route::Qp, Route::Pgs, Route::Alm],
        _ => &[Route::Lemke, Route::Qp, Route::Pgs, Route::Alm],
    };
    Case::new(
        &format!("wall of {bricks} bricks"),
        "Forces can circulate around the end of every head joint, and rounding errors accumulate from course to course.",
        wall(width, courses, 0.6, elastic()).stresses(false),
    )
    .slow_by(slow)
    .long_by(if bricks < 120 { &[] } else { &[Route::Lemke] })
    .parameters(&format!("courses x bricks: {courses} x {length}, mu = 0.6, weight inclined by 0.1"))
    .known("the sum of the reactions is the load", reactions_off)
}

/// `scenes/wall_settlement.toml`, shortened.
/// The right half of the base sinks by so much \[m\], and turns by as much.
fn settled(sinks: f64) -> Case {
    let brick = Brick { length: 0.25, height: 0.125 };
    let mut turned = Movement::by(0.0, -sinks);
    turned.turn = -sinks;
    let scene: Scene = scene("Settlement", 0.6)
        .thickness(0.25)
        .gravity([0.0, -GRAVITY])
        .material("brick", elastic())
        .joint("bed", Joint::mu(0.6))
        .wall(Wall::running_bond("wall", "brick", brick, 1.5, 6).mesh([2, 1]))
        .support(Support::new("left foundation", [0.0, 0.0], [0.75, 0.0], "bed"))
        .support(Support::new("right foundation", [0.75, 0.0], [1.5, 0.0], "bed"))
        .stage(Stage::new("weight"))
        .stage(Stage::new("settlement").steps(2).moves("right foundation", turned));
    Case::new(
        "wall on a support that settles",
        "Bricks that lose their support rotate far more than they deform.",
        scene,
    )
    .long_by(&[Route::Pgs])
    .parameters("six courses of six bricks 0.25 x 0.125 m in 2 x 1 elements, thickness 0.25 m, mu = 0.6, the right half of the base sinks by 4 mm and turns by 0.004 in two steps")
    .known("the sum of the reactions is the weight", reactions_off)
}
