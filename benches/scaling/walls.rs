//! The walls of the bench: bricks 2 : 1 in running bond, loaded and supported in the ways that are hardest to decide.

use std::fmt;
use std::ops::ControlFlow;

use masonry::data::statics::Statics;
use masonry::method::statics;
use masonry::model::{DRY_JOINT, Model};
use masonry::scene::{
    Brick, Joint, Load, Material, Movement, Plane, Scene, Stage, Support, Wall as Bond,
};
use masonry::system::System;
use masonry::units::{ForceUnit, LengthUnit, Units};

const BRICK: Brick = Brick { length: 0.25, height: 0.125 };
const GRAVITY: f64 = 9.81;
/// Stiffness of dry joints across and along them \[kN/m^3\], as the program takes it between rigid bricks.
pub(crate) const DRY: Option<[f64; 2]> = Some([1e-3 * DRY_JOINT[0], 1e-3 * DRY_JOINT[1]]);
/// Bisections of the largest tilt, between 0 and 2.
const HALVINGS: usize = 14;

/// What a wall has to bear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Case {
    /// Its weight and a load on top that leans by a tenth, on a full floor.
    Lean,
    /// Its weight, with the middle of its foot free.
    OpenBase,
    /// Its weight, on a floor that is tilted by this part of the tangent beyond which no forces hold it.
    Tilt(f64),
    /// The settlement and the turn of a part of its floor, in so many steps.
    Settlement(u32),
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lean => write!(f, "lean"),
            Self::OpenBase => write!(f, "open base"),
            Self::Tilt(share) => write!(f, "tilt {share}"),
            Self::Settlement(1) => write!(f, "settlement, 1 step"),
            Self::Settlement(steps) => write!(f, "settlement, {steps} steps"),
        }
    }
}

/// A wall of the bench.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wall {
    /// Bricks in a course, and courses.
    pub(crate) courses: u32,
    pub(crate) mu: f64,
    /// Elements of a brick; `None` for rigid ones.
    pub(crate) mesh: Option<[u32; 2]>,
    /// Stiffness of the joints across and along them \[kN/m^3\]; hard ones have none.
    pub(crate) joints: Option<[f64; 2]>,
}

impl Wall {
    /// The scene of a case; `limit` is the tangent of the tilt beyond which no forces hold the wall.
    pub(crate) fn scene(&self, case: Case, limit: f64) -> Scene {
        let width = BRICK.length * f64::from(self.courses);
        let height = BRICK.height * f64::from(self.courses);
        let tilt = if let Case::Tilt(share) = case { (share * limit).atan() } else { 0.0 };
        let material = match self.mesh {
            Some(_) => Material::elastic(5e6, 0.15),
            None => Material::rigid(),
        };
        let bond = Bond::running_bond("wall", "brick", BRICK, width, self.courses);
        let joint = || {
            let joint = Joint::mu(self.mu);
            match self.joints {
                Some(stiffness) => joint.stiffness(stiffness),
                None => joint,
            }
        };
        let units = Units { length: LengthUnit::M, force: ForceUnit::Kn };
        let scene = Scene::new(&case.to_string(), units)
            .plane(Plane::Stress)
            .thickness(0.25)
            .gravity([GRAVITY * tilt.sin(), -GRAVITY * tilt.cos()])
            .material("brick", material.density(1800.0))
            .joint("bed", joint())
            .joint("head", joint())
            .wall(match self.mesh {
                Some(mesh) => bond.mesh(mesh),
                None => bond,
            });
        let floor = |name: &str, from: f64, to: f64| {
            Support::new(name, [from * width, 0.0], [to * width, 0.0], "bed")
        };
        match case {
            Case::Lean => {
                let top = Load::traction("top", [0.0, height], [width, height], [1.0, -10.0]);
                scene.support(floor("floor", 0.0, 1.0)).load(top)
            }
            Case::OpenBase => {
                scene.support(floor("left", 0.0, 0.32)).support(floor("right", 0.68, 1.0))
            }
            Case::Tilt(_) => scene.support(floor("floor", 0.0, 1.0)),
            Case::Settlement(steps) => scene
                .support(floor("left", 0.0, 0.6))
                .support(floor("right", 0.6, 1.0))
                .stage(Stage::new("weight"))
                .stage(
                    Stage::new("settlement")
                        .steps(steps)
                        .moves("right", Movement { x: 0.0, y: -0.004, turn: -0.004 }),
                ),
        }
    }

    /// The tangent of the tilt beyond which no forces within friction hold the wall.
    pub(crate) fn largest_tilt(&self) -> f64 {
        let stands = |tangent: f64| {
            let model =
                Model::from_scene(&self.scene(Case::Tilt(1.0), tangent)).expect("a sound scene");
            let system = System::new(&model).expect("sound blocks");
            let decision = statics::decide(&model, &system, &mut |_| ControlFlow::Continue(()));
            matches!(decision.expect("finite data").statics, Statics::Admissible(_))
        };
        let halved = |(low, high): (f64, f64), _| {
            let middle = 0.5 * (low + high);
            if stands(middle) { (middle, high) } else { (low, middle) }
        };
        let (low, high) = (0..HALVINGS).fold((0.0, 2.0), halved);
        0.5 * (low + high)
    }
}
