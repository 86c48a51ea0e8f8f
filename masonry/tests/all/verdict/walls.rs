//! Random walls, stacks, arches and honeycombs.

use masonry::model::{Model, Plane};
use masonry::scene::{Block, Brick, Joint, Load, Material, Scene, Support, Wall};
use masonry::units::Units;

pub(crate) const GRAVITY: f64 = 10.0;

/// What blocks are made of, and whether they touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Rigid,
    Elastic,
    /// Rigid, and the floor is a little below.
    Gap,
}

/// Numbers between 0 and 1 that are the same in every run (Knuth's linear congruential generator).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        let place = self.next() * list.len() as f64;
        // Below the length by construction.
        list[(0..list.len()).rev().find(|k| *k as f64 <= place).unwrap()]
    }
}

/// A scene but for its tilt.
pub(crate) struct Tiltable {
    scene: Scene,
    pub(crate) kind: Kind,
}

impl Tiltable {
    fn new((what, mut scene): (&str, Scene), kind: Kind, mu: f64) -> Self {
        scene.title = format!("{kind:?} {what}, mu = {mu}");
        Self { scene, kind }
    }

    pub(crate) fn model(&self) -> Model {
        Model::from_scene(&self.tilted(0.0)).unwrap()
    }

    pub(crate) fn title(&self) -> &str {
        &self.scene.title
    }

    /// With a horizontal acceleration of `tilt` times gravity.
    pub(crate) fn tilted(&self, tilt: f64) -> Scene {
        self.scene.clone().gravity([tilt * GRAVITY, -GRAVITY])
    }
}

pub(crate) fn any(random: &mut Random) -> Tiltable {
    let kind = random.one_of(&[Kind::Rigid, Kind::Rigid, Kind::Elastic, Kind::Gap]);
    let (scene, mu, floor) = bare(random, kind);
    let (what, scene) = match random.one_of(&[0, 1, 2, 3, 4]) {
        0 => ("stack", stack(random, scene, floor)),
        1 => ("wall on feet", wall(random, scene, floor, true)),
        2 => ("wall with a door", door(random, scene, floor)),
        3 => ("arch", arch(random, scene, floor)),
        _ => ("wall", wall(random, scene, floor, false)),
    };
    Tiltable::new((what, scene), kind, mu)
}

/// Blocks that are no quadrilaterals.
pub(crate) fn polygons(random: &mut Random) -> Tiltable {
    let kind = random.one_of(&[Kind::Rigid, Kind::Rigid, Kind::Gap]);
    let (scene, mu, floor) = bare(random, kind);
    let built = if random.next() < 0.5 {
        ("honeycomb", honeycomb(random, scene, floor))
    } else {
        ("stack of octagons", octagons(random, scene, floor))
    };
    Tiltable::new(built, kind, mu)
}

/// A scene without blocks, its friction, and how high the floor is.
fn bare(random: &mut Random, kind: Kind) -> (Scene, f64, f64) {
    // Some that are tangents of the geometry.
    let mu = random.one_of(&[0.0, 0.1, 0.3, 0.5, 0.65, 1.0, 1.5, 3.0]);
    let mu = if random.next() < 0.5 { mu } else { random.between(0.05, 3.0) };
    let material = match kind {
        Kind::Elastic => Material::elastic(1e9, 0.2),
        Kind::Rigid | Kind::Gap => Material::rigid(),
    };
    let floor = if kind == Kind::Gap { -1e-3 } else { 0.0 };
    let mut scene = Scene::new("", Units::SI)
        .plane(Plane::Stress)
        .thickness(0.2)
        .material("stone", material.density(2000.0))
        .joint("bed", Joint::mu(mu))
        .joint("head", Joint::mu(if random.next() < 0.7 { mu } else { 0.5 * mu }));
    if kind == Kind::Gap {
        scene.contact.gap_limit = 2e-3;
    }
    (scene, mu, floor)
}

/// Columns of regular hexagons on their sides: every other column starts half a hexagon higher and wedges its neighbours
/// apart.
fn honeycomb(random: &mut Random, scene: Scene, floor: f64) -> Scene {
    let (columns, rows) = (random.one_of(&[1_u32, 3, 5]), random.one_of(&[1_u32, 2, 3]));
    let half = 0.75_f64.sqrt();
    let scene = scene.support(Support::new("floor", [-2.0, floor], [10.0, floor], "bed"));
    (0..columns).fold(scene, |scene, column| {
        let raised = column % 2;
        (raised..rows).fold(scene, |scene, row| {
            let [x, y] = [1.5 * f64::from(column), half * f64::from(2 * row + 1 - raised)];
            let corners =
                [[1.0, 0.0], [0.5, half], [-0.5, half], [-1.0, 0.0], [-0.5, -half], [0.5, -half]];
            let corners = corners.map(|[dx, dy]| [x + dx, y + dy]);
            scene.block(Block::new(&format!("{column}/{row}"), "stone", corners))
        })
    })
}

/// Squares without their corners on top of each other, and a triangle on them.
fn octagons(random: &mut Random, scene: Scene, floor: f64) -> Scene {
    let count = random.one_of(&[1_u32, 2, 4]);
    let cut = random.between(0.05, 0.3);
    let scene = scene.support(Support::new("floor", [-5.0, floor], [5.0, floor], "bed"));
    let mut left = 0.0;
    let scene = (0..count).map(f64::from).fold(scene, |scene, low| {
        left += random.between(-0.1, 0.15);
        let (near, far) = (cut, 1.0 - cut);
        let corners = [
            [near, 0.0],
            [far, 0.0],
            [1.0, near],
            [1.0, far],
            [far, 1.0],
            [near, 1.0],
            [0.0, far],
            [0.0, near],
        ];
        let corners = corners.map(|[x, y]| [left + x, low + y]);
        scene.block(Block::new(&format!("{low}"), "stone", corners))
    });
    let top = f64::from(count);
    let corners = [[left + cut, top], [left + 1.0 - cut, top], [left + 0.5, top + 0.7]];
    scene.block(Block::new("roof", "stone", corners))
}

/// Blocks on top of each other, each a little beside the one below.
fn stack(random: &mut Random, scene: Scene, floor: f64) -> Scene {
    let count = random.one_of(&[1_u32, 2, 3, 5, 8]);
    let (width, height) = (1.0, random.between(0.3, 1.5));
    let scene = scene.support(Support::new("floor", [-5.0, floor], [5.0, floor], "bed"));
    let mut left = 0.0;
    (0..count).map(f64::from).fold(scene, |scene, k| {
        left += random.between(-0.25, 0.3) / f64::from(count);
        let (low, high) = (k * height, (k + 1.0) * height);
        let right = left + width;
        let corners = [[left, low], [right, low], [right, high], [left, high]];
        scene.block(Block::new(&format!("{k}"), "stone", corners).mesh([2, 2]))
    })
}

/// Voussoirs of one thickness on two springers, from flat segments to half a circle.
fn arch(random: &mut Random, scene: Scene, floor: f64) -> Scene {
    let count = random.one_of(&[3_u32, 5, 7, 11, 15]);
    let (inner, outer) = (1.0, 1.0 + random.between(0.08, 0.35));
    let half = random.between(0.25, 0.5) * std::f64::consts::PI;
    // The angle from the vertical at the end of voussoir `k`, from the left.
    let angle = |k: u32| (2.0 * f64::from(k) / f64::from(count) - 1.0) * half;
    let at = |radius: f64, k: u32| [radius * angle(k).sin(), radius * angle(k).cos()];
    let springer = |name: &str, k: u32, side: f64| {
        // Down along the arch, by the depth of the gap.
        let away = [side * angle(k).cos() * -floor, -side * angle(k).sin() * -floor];
        let end = |radius: f64| {
            let [x, y] = at(radius, k);
            [x + away[0], y + away[1]]
        };
        Support::new(name, end(0.9 * inner), end(1.1 * outer), "bed")
    };
    let scene = scene.support(springer("left springer", 0, -1.0)).support(springer(
        "right springer",
        count,
        1.0,
    ));
    (0..count).fold(scene, |scene, k| {
        let corners = [at(inner, k), at(inner, k + 1), at(outer, k + 1), at(outer, k)];
        scene.block(Block::new(&format!("{k}"), "stone", corners).mesh([2, 2]))
    })
}

fn brick(random: &mut Random) -> Brick {
    Brick { length: 0.25, height: random.one_of(&[0.0625, 0.125, 0.25]) }
}

/// A wall in running bond on a floor or on two feet, often with a load on top.
fn wall(random: &mut Random, scene: Scene, floor: f64, on_feet: bool) -> Scene {
    let brick = brick(random);
    let bricks = random.one_of(&[2.0, 3.0, 4.0, 6.0]);
    let courses = random.one_of(&[2_u32, 3, 5, 8]);
    let (width, top) = (bricks * brick.length, f64::from(courses) * brick.height);
    let wall = Wall::running_bond("wall", "stone", brick, width, courses).mesh([2, 1]);
    let scene = scene.wall(wall);
    let scene = if on_feet {
        let foot = brick.length * random.one_of(&[0.5, 1.0]);
        scene
            .support(Support::new("left", [0.0, floor], [foot, floor], "bed"))
            .support(Support::new("right", [width - foot, floor], [width, floor], "bed"))
    } else {
        scene.support(Support::new("floor", [0.0, floor], [width, floor], "bed"))
    };
    if random.next() < 0.4 {
        scene.load(Load::pressure("top", [0.0, top], [width, top], random.between(1e3, 1e5)))
    } else {
        scene
    }
}

/// Bricks 2 : 1 around a door with a lintel of two bricks' length.
fn door(random: &mut Random, scene: Scene, floor: f64) -> Scene {
    let brick = Brick { length: 0.25, height: 0.125 };
    let mut courses = Vec::new();
    for _ in 0..random.one_of(&[1_u32, 2]) {
        courses.push(vec![1.0, 1.0, -1.0, 1.0, 1.0]);
        courses.push(vec![0.5, 1.0, 0.5, -1.0, 0.5, 1.0, 0.5]);
    }
    courses.push(vec![1.0, 0.5, 2.0, 0.5, 1.0]);
    courses.push(vec![0.5, 1.0, 1.0, 1.0, 1.0, 0.5]);
    let wall = Wall::from_courses("wall", "stone", brick, courses).mesh([2, 1]);
    scene
        .wall(wall)
        .support(Support::new("left", [0.0, floor], [0.5, floor], "bed"))
        .support(Support::new("right", [0.75, floor], [1.25, floor], "bed"))
}
