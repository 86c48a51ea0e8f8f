//! Scenes built in Rust.

use std::collections::BTreeMap;

use super::source::Source;
use super::{
    Arch, Between, Block, Bond, Brick, Contact, Courses, Films, Form, Joint, Limit, Load, Material,
    Opening, Output, Plane, PointRule, RouteSetting, Scene, Solver, Stage, Support, Wall,
    WallJoints,
};
use crate::units::Units;

impl Scene {
    /// The steps of all stages.
    pub(crate) fn steps(&self) -> usize {
        self.stages.iter().map(|stage| stage.steps as usize).sum()
    }
}

impl Scene {
    /// A scene without anything in it.
    pub fn new(title: &str, units: Units) -> Self {
        Self {
            title: title.to_owned(),
            plane: None,
            thickness: None,
            gravity: None,
            block_list: None,
            units,
            materials: BTreeMap::new(),
            joints: BTreeMap::new(),
            between: Vec::new(),
            walls: Vec::new(),
            arches: Vec::new(),
            blocks: Vec::new(),
            supports: Vec::new(),
            loads: Vec::new(),
            stages: Vec::new(),
            limit: Limit::default(),
            contact: Contact::default(),
            solver: Solver::default(),
            output: Output::default(),
            source: Source::default(),
        }
    }

    /// Sets plane stress or plane strain.
    #[must_use]
    pub fn plane(mut self, plane: Plane) -> Self {
        self.plane = Some(plane);
        self
    }

    /// Sets the thickness out of the plane \[length\].
    #[must_use]
    pub fn thickness(mut self, thickness: f64) -> Self {
        self.thickness = Some(thickness);
        self
    }

    /// Sets gravity \[m/s^2\].
    #[must_use]
    pub fn gravity(mut self, gravity: [f64; 2]) -> Self {
        self.gravity = Some(gravity);
        self
    }

    /// Adds a material, or replaces that of the same name.
    #[must_use]
    pub fn material(mut self, name: &str, material: Material) -> Self {
        self.materials.insert(name.to_owned(), material);
        self
    }

    /// Adds a joint class, or replaces that of the same name.
    #[must_use]
    pub fn joint(mut self, name: &str, joint: Joint) -> Self {
        self.joints.insert(name.to_owned(), joint);
        self
    }

    /// Gives the joints between two bodies, each the name of a block or of a wall, a class of their own.
    #[must_use]
    pub fn between(mut self, first: &str, second: &str, joint: &str) -> Self {
        let blocks = [first, second].map(str::to_owned);
        self.between.push(Between { blocks, joint: joint.to_owned() });
        self
    }

    /// Adds a wall.
    #[must_use]
    pub fn wall(mut self, wall: Wall) -> Self {
        self.walls.push(wall);
        self
    }

    /// Adds an arch.
    #[must_use]
    pub fn arch(mut self, arch: Arch) -> Self {
        self.arches.push(arch);
        self
    }

    /// Adds a block.
    #[must_use]
    pub fn block(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// Adds a support.
    #[must_use]
    pub fn support(mut self, support: Support) -> Self {
        self.supports.push(support);
        self
    }

    /// Adds a load.
    #[must_use]
    pub fn load(mut self, load: Load) -> Self {
        self.loads.push(load);
        self
    }

    /// Adds a stage to the load history.
    #[must_use]
    pub fn stage(mut self, stage: Stage) -> Self {
        self.stages.push(stage);
        self
    }

    /// Names the load or group of loads that grows to its limit.
    #[must_use]
    pub fn limit_group(mut self, name: &str) -> Self {
        self.limit.group = Some(name.to_owned());
        self
    }

    /// Sets where on a joint the contact law is enforced.
    #[must_use]
    pub fn contact_points(mut self, points: PointRule) -> Self {
        self.contact.points = points;
        self
    }

    /// Sets which terms of mortar films are kept.
    #[must_use]
    pub fn films(mut self, films: Films) -> Self {
        self.contact.films = films;
        self
    }

    /// Sets the distance \[length\] below which bodies may meet.
    #[must_use]
    pub fn gap_limit(mut self, gap_limit: f64) -> Self {
        self.contact.gap_limit = gap_limit;
        self
    }

    /// Puts corners of single blocks that are nearer than this to others onto them \[length\].
    #[must_use]
    pub fn contact_tolerance(mut self, tolerance: f64) -> Self {
        self.contact.tolerance = Some(tolerance);
        self
    }

    /// Sets the requested residual of the solver \[-\].
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.solver.tolerance = tolerance;
        self
    }

    /// Sets the route to the solution: one of them, or [`RouteSetting::Auto`].
    #[must_use]
    pub fn route(mut self, route: impl Into<RouteSetting>) -> Self {
        self.solver.route = route.into();
        self
    }

    /// Sets the stiffness of the springs of the routes that have them, relative to that of the
    /// blocks \[-\].
    #[must_use]
    pub fn soft(mut self, stiffness: f64) -> Self {
        self.solver.soft = Some(stiffness);
        self
    }

    /// Sets the form of the complementarity problem.
    #[must_use]
    pub fn form(mut self, form: Form) -> Self {
        self.solver.form = form;
        self
    }

    /// Sets the largest number of pivots of one attempt.
    #[must_use]
    pub fn max_pivots(mut self, max_pivots: u32) -> Self {
        self.solver.max_pivots = Some(max_pivots);
        self
    }

    /// Sets the largest number of steps of one attempt of the interior points.
    #[must_use]
    pub fn max_steps(mut self, max_steps: u32) -> Self {
        self.solver.max_steps = Some(max_steps);
        self
    }

    /// Sets whether stresses are recovered and written.
    #[must_use]
    pub fn stresses(mut self, stresses: bool) -> Self {
        self.output.stresses = stresses;
        self
    }
}

impl Material {
    /// A material of rigid blocks.
    pub fn rigid() -> Self {
        Self::default()
    }

    /// A linear elastic material: Young's modulus \[force/length^2\] and Poisson's ratio \[-\].
    pub fn elastic(young: f64, poisson: f64) -> Self {
        Self { young: Some(young), poisson: Some(poisson), density: None }
    }

    /// Gives the material a mass density \[kg/m^3\].
    #[must_use]
    pub fn density(mut self, density: f64) -> Self {
        self.density = Some(density);
        self
    }
}

impl Joint {
    /// A class with a coefficient of friction \[-\].
    pub fn mu(mu: f64) -> Self {
        Self { mu: Some(mu), ..Self::default() }
    }

    /// A class with an angle of friction \[degrees\].
    pub fn phi_deg(phi_deg: f64) -> Self {
        Self { phi_deg: Some(phi_deg), ..Self::default() }
    }

    /// Sets the cohesion \[force/length^2\].
    #[must_use]
    pub fn cohesion(mut self, cohesion: f64) -> Self {
        self.cohesion = Some(cohesion);
        self
    }

    /// Sets the tensile strength \[force/length^2\], at most cohesion / mu.
    #[must_use]
    pub fn tension(mut self, tension: f64) -> Self {
        self.tension = Some(tension);
        self
    }

    /// Sets the normal and the tangential stiffness of the faces \[force/length^3\].
    #[must_use]
    pub fn stiffness(mut self, stiffness: [f64; 2]) -> Self {
        self.stiffness = Some(stiffness);
        self
    }

    /// Sets where on the joints of the class the law is enforced.
    #[must_use]
    pub fn points(mut self, points: PointRule) -> Self {
        self.points = Some(points);
        self
    }

    /// Fills the joints of the class with mortar of a thickness \[length\] and an elastic material.
    #[must_use]
    pub fn mortar(mut self, thickness: f64, material: &str) -> Self {
        self.thickness = Some(thickness);
        self.material = Some(material.to_owned());
        self
    }
}

impl Wall {
    /// A wall of so many courses in running bond, cut to `width` \[length\].
    pub fn running_bond(
        name: &str,
        material: &str,
        brick: Brick,
        width: f64,
        courses: u32,
    ) -> Self {
        let courses = Courses::RunningBond(courses);
        Self { width: Some(width), ..Self::new(name, material, brick, courses) }
    }

    /// A wall of given courses, bottom to top, each a list of brick lengths in units of one brick;
    /// a negative number is an opening of that length.
    pub fn from_courses(name: &str, material: &str, brick: Brick, courses: Vec<Vec<f64>>) -> Self {
        Self::new(name, material, brick, Courses::List(courses))
    }

    /// Sets how the bricks are laid.
    #[must_use]
    pub fn bond(mut self, bond: Bond) -> Self {
        self.bond = Some(bond);
        self
    }

    /// Adds an opening.
    #[must_use]
    pub fn opening(mut self, opening: Opening) -> Self {
        self.openings.push(opening);
        self
    }

    /// Sets the classes of the beds and heads within the wall.
    #[must_use]
    pub fn joints(mut self, bed: &str, head: &str) -> Self {
        self.joints = WallJoints { bed: Some(bed.to_owned()), head: Some(head.to_owned()) };
        self
    }

    /// Puts the lower left corner of the wall at `origin` \[length\] instead of `[0, 0]`.
    #[must_use]
    pub fn origin(mut self, origin: [f64; 2]) -> Self {
        self.origin = origin;
        self
    }

    /// Sets the elements along the length and height of a whole brick.
    #[must_use]
    pub fn mesh(mut self, mesh: [u32; 2]) -> Self {
        self.mesh = Some(mesh);
        self
    }

    fn new(name: &str, material: &str, brick: Brick, courses: Courses) -> Self {
        Self {
            name: name.to_owned(),
            material: material.to_owned(),
            origin: [0.0; 2],
            brick,
            width: None,
            courses,
            bond: None,
            openings: Vec::new(),
            joints: WallJoints::default(),
            mesh: None,
        }
    }
}

impl Block {
    /// A block with corners \[length\] in counter-clockwise order.
    pub fn new(name: &str, material: &str, corners: impl Into<Vec<[f64; 2]>>) -> Self {
        let (name, material) = (name.to_owned(), material.to_owned());
        Self { name, material, corners: corners.into(), mesh: None }
    }

    /// Sets the elements along edges 0 and 2, and along edges 1 and 3.
    #[must_use]
    pub fn mesh(mut self, mesh: [u32; 2]) -> Self {
        self.mesh = Some(mesh);
        self
    }
}

impl Support {
    /// A support between two points \[length\], with the class of its joints.
    pub fn new(name: &str, from: [f64; 2], to: [f64; 2], joint: &str) -> Self {
        Self { name: name.to_owned(), from, to, joint: joint.to_owned() }
    }
}
