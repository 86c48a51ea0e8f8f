//! The wall: a panel of bricks between two side walls on a floor.

use masonry::model::Plane;
use masonry::scene::{
    Brick, Films, Joint, Load, Material, Movement, PointRule, Route, Scene, Stage, Support,
    Wall as Bricks,
};
use masonry::units::Units;

/// A whole brick, and the mortar between bricks \[m\].
const BRICK: Brick = Brick { length: 0.2, height: 0.1 };
const MORTAR: f64 = 0.01;
/// Stiffness of dry joints \[Pa/m\].
const STIFFNESS: [f64; 2] = [5e9, 2e9];
/// A slot across the wall, in bricks; bodies on both sides may meet where that is wanted.
const SLOT: f64 = 0.02;

/// The wall and what is switched on.
#[derive(Debug, Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "switches")]
pub(crate) struct Wall {
    pub(crate) bricks: u32,
    pub(crate) courses: u32,
    pub(crate) friction: bool,
    pub(crate) elastic: bool,
    /// Elements along a whole brick, and of its height.
    pub(crate) mesh: [u32; 2],
    /// Joints between bricks have a stiffness.
    pub(crate) stiffness: bool,
    pub(crate) mortar: bool,
    pub(crate) strips: bool,
    /// Contact points at Gauss points instead of vertices.
    pub(crate) gauss: bool,
    pub(crate) weight: bool,
    pub(crate) load: bool,
    pub(crate) stresses: bool,
    pub(crate) slot: bool,
    /// Bodies on both sides of the slot may meet.
    pub(crate) far_pairs: bool,
    pub(crate) steps: u32,
    /// A side wall gives way a little.
    pub(crate) moves: bool,
}

impl Wall {
    /// For pivots.
    pub(crate) fn small() -> Self {
        Self {
            bricks: 4,
            courses: 6,
            friction: true,
            elastic: true,
            mesh: [2, 1],
            stiffness: false,
            mortar: false,
            strips: false,
            gauss: false,
            weight: true,
            load: true,
            stresses: false,
            slot: false,
            far_pairs: false,
            steps: 1,
            moves: false,
        }
    }

    /// For sparse methods.
    pub(crate) fn large() -> Self {
        Self { bricks: 16, courses: 16, ..Self::small() }
    }

    pub(crate) fn title(&self, route: Route) -> String {
        let Self { bricks, courses, .. } = self;
        format!("`{}`: {courses} courses of {bricks} bricks", route.name())
    }

    pub(crate) fn scene(&self) -> Scene {
        let thickness = if self.mortar { MORTAR } else { 0.0 };
        let bricks = f64::from(self.bricks) + if self.slot { SLOT } else { 0.0 };
        let width = bricks * (BRICK.length + thickness) - thickness;
        let top = f64::from(self.courses) * (BRICK.height + thickness) - thickness;
        let [brick, mortar] = [Material::elastic(1e9, 0.15), Material::elastic(8e8, 0.2)];
        let brick = if self.elastic { brick } else { Material::rigid() };
        let joint = Joint::mu(if self.friction { 0.6 } else { 0.0 });
        let filled =
            if self.mortar { joint.clone().mortar(MORTAR, "mortar") } else { joint.clone() };
        let filled = if self.stiffness { filled.stiffness(STIFFNESS) } else { filled };
        let mut scene = Scene::new("A wall", Units::SI)
            .plane(Plane::Stress)
            .thickness(0.1)
            .material("brick", if self.weight { brick.density(2000.0) } else { brick })
            .material("mortar", mortar)
            .joint("bed", filled.clone())
            .joint("head", filled)
            .joint("side", joint)
            .wall(Bricks::from_courses("wall", "brick", BRICK, self.courses()).mesh(self.mesh))
            .support(Support::new("floor", [0.0, 0.0], [width, 0.0], "side"))
            .support(Support::new("left", [0.0, 0.0], [0.0, top], "side"))
            .support(Support::new("right", [width, 0.0], [width, top], "side"))
            .stresses(self.stresses);
        if self.weight {
            scene = scene.gravity([0.0, -9.81]);
        }
        if self.load {
            scene = scene.load(Load::pressure("top", [0.0, top], [width, top], 1e5));
        }
        if self.gauss {
            scene = scene.contact_points(PointRule::Gauss);
        }
        if self.strips {
            scene = scene.films(Films::Strips);
        }
        if self.far_pairs {
            scene = scene.gap_limit(2.0 * SLOT * BRICK.length);
        }
        if self.steps > 1 || self.moves {
            let stage = Stage::new("load").steps(self.steps).gravity(1.0).load("top", 1.0);
            let movement = Movement::by(if self.moves { 1e-5 } else { 0.0 }, 0.0);
            scene = scene.stage(stage.moves("right", movement));
        }
        scene
    }

    /// Running bond, with a slot in the middle of every course where one is wanted.
    fn courses(&self) -> Vec<Vec<f64>> {
        let whole = self.bricks as usize;
        let bond = |bricks: usize, course: u32| {
            if course.is_multiple_of(2) {
                return vec![1.0; bricks];
            }
            let mut lengths = vec![1.0; bricks + 1];
            lengths[0] = 0.5;
            lengths[bricks] = 0.5;
            lengths
        };
        let course = |course| {
            if self.slot {
                let half = bond(whole / 2, course);
                [half.clone(), vec![-SLOT], half].concat()
            } else {
                bond(whole, course)
            }
        };
        (0..self.courses).map(course).collect()
    }
}
