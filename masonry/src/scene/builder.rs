//! Methods that build scenes in Rust.

use std::collections::BTreeMap;

use super::setters::setters;
use super::source::Source;
use super::{
    Arch, Between, Block, Bond, Brick, Combination, Contact, Courses, Films, Form, Joint,
    LimitLoad, Load, Material, Opening, Output, Plane, PointRule, RouteSetting, Scene, Seismic,
    SolverSettings, Stage, Support, Train, Wall, WallJoints,
};
use crate::units::Units;

impl Scene {
    /// Returns the number of steps of all stages.
    pub(crate) fn steps(&self) -> usize {
        self.stages.iter().map(|stage| stage.steps as usize).sum()
    }
}

impl Scene {
    /// Makes a scene without any blocks.
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
            combinations: Vec::new(),
            limit: LimitLoad::default(),
            contact: Contact::default(),
            solver: SolverSettings::default(),
            output: Output::default(),
            source: Source::default(),
        }
    }

    setters! {
        /// Sets plane stress or plane strain.
        pub fn plane(mut self, plane: Plane) { self.plane = Some(plane) }
        /// Sets the thickness out of the plane \[length\].
        pub fn thickness(mut self, thickness: f64) { self.thickness = Some(thickness) }
        /// Sets gravity \[m/s^2\].
        pub fn gravity(mut self, gravity: [f64; 2]) { self.gravity = Some(gravity) }
        /// Adds a material, or replaces the one of the same name.
        pub fn material(mut self, name: &str, material: Material) {
            self.materials.insert(name.to_owned(), material);
        }
        /// Adds a joint class, or replaces the one of the same name.
        pub fn joint(mut self, name: &str, joint: Joint) {
            self.joints.insert(name.to_owned(), joint);
        }
        /// Sets the class of the joints between two bodies, each given by the name of a block or of a wall.
        pub fn between(mut self, first: &str, second: &str, joint: &str) {
            let blocks = [first, second].map(str::to_owned);
            self.between.push(Between { blocks, joint: joint.to_owned() });
        }
        /// Adds a wall.
        pub fn wall(mut self, wall: Wall) { self.walls.push(wall) }
        /// Adds an arch.
        pub fn arch(mut self, arch: Arch) { self.arches.push(arch) }
        /// Adds a block.
        pub fn block(mut self, block: Block) { self.blocks.push(block) }
        /// Adds a support.
        pub fn support(mut self, support: Support) { self.supports.push(support) }
        /// Adds a load.
        pub fn load(mut self, load: Load) { self.loads.push(load) }
        /// Adds a stage to the load history.
        pub fn stage(mut self, stage: Stage) { self.stages.push(stage) }
        /// Adds a combination of loads.
        pub fn combination(mut self, combination: Combination) {
            self.combinations.push(combination);
        }
        /// Names the load or group of loads that grows to its limit.
        pub fn limit_group(mut self, name: &str) { self.limit.group = Some(name.to_owned()) }
        /// Sets the data of the seismic check of a limit load.
        pub fn seismic(mut self, seismic: Seismic) { self.limit.seismic = Some(seismic) }
        /// Sets the train whose limit load is found at every position.
        pub fn train(mut self, train: Train) { self.limit.train = Some(train) }
        /// Sets the rule for the places on a joint at which the contact law is enforced.
        pub fn contact_points(mut self, points: PointRule) { self.contact.points = points }
        /// Sets which terms of mortar films are kept.
        pub fn films(mut self, films: Films) { self.contact.films = films }
        /// Sets the distance \[length\] below which bodies may come into contact.
        pub fn gap_limit(mut self, gap_limit: f64) { self.contact.gap_limit = gap_limit }
        /// Sets the distance \[length\] below which corners of single blocks are moved onto corners and edges of
        /// others.
        pub fn contact_tolerance(mut self, tolerance: f64) {
            self.contact.tolerance = Some(tolerance);
        }
        /// Sets the largest residual of a solution \[-\].
        pub fn tolerance(mut self, tolerance: f64) { self.solver.tolerance = tolerance }
        /// Sets the route to the solution; [`RouteSetting::Auto`] chooses it.
        pub fn route(mut self, route: impl Into<RouteSetting>) { self.solver.route = route.into() }
        /// Sets the stiffness of the springs on all displacements, relative to that of the blocks \[-\], for routes
        /// that have springs.
        pub fn soft(mut self, stiffness: f64) { self.solver.soft = Some(stiffness) }
        /// Sets the form of the complementarity problem.
        pub fn form(mut self, form: Form) { self.solver.form = form }
        /// Sets the largest number of pivots of one attempt.
        pub fn max_pivots(mut self, max_pivots: u32) { self.solver.max_pivots = Some(max_pivots) }
        /// Sets the largest number of steps of one attempt of the interior-point method.
        pub fn max_steps(mut self, max_steps: u32) { self.solver.max_steps = Some(max_steps) }
        /// Sets whether stresses are computed and written.
        pub fn stresses(mut self, stresses: bool) { self.output.stresses = stresses }
    }
}

impl Material {
    /// Makes the material of rigid blocks.
    pub fn rigid() -> Self {
        Self::default()
    }

    /// Makes a linear elastic material with Young's modulus \[force/length^2\] and Poisson's ratio \[-\].
    pub fn elastic(young: f64, poisson: f64) -> Self {
        Self { young: Some(young), poisson: Some(poisson), density: None }
    }

    setters! {
        /// Sets the mass density of the material \[kg/m^3\].
        pub fn density(mut self, density: f64) { self.density = Some(density) }
    }
}

impl Joint {
    /// Makes a joint class with a coefficient of friction \[-\].
    pub fn mu(mu: f64) -> Self {
        Self { mu: Some(mu), ..Self::default() }
    }

    /// Makes a joint class with an angle of friction \[degrees\].
    pub fn phi_deg(phi_deg: f64) -> Self {
        Self { phi_deg: Some(phi_deg), ..Self::default() }
    }

    setters! {
        /// Sets the cohesion \[force/length^2\].
        pub fn cohesion(mut self, cohesion: f64) { self.cohesion = Some(cohesion) }
        /// Sets the tensile strength \[force/length^2\], which is at most the cohesion divided by `mu`.
        pub fn tension(mut self, tension: f64) { self.tension = Some(tension) }
        /// Sets the normal and the tangential stiffness of the joints \[force/length^3\].
        pub fn stiffness(mut self, stiffness: [f64; 2]) { self.stiffness = Some(stiffness) }
        /// Sets the rule for the places on the joints of the class at which the law is enforced.
        pub fn points(mut self, points: PointRule) { self.points = Some(points) }
        /// Fills the joints of the class with mortar of a thickness \[length\] and an elastic material.
        pub fn mortar(mut self, thickness: f64, material: &str) {
            self.thickness = Some(thickness);
            self.material = Some(material.to_owned());
        }
    }
}

impl Wall {
    /// Makes a wall of `courses` in running bond, cut to `width` \[length\].
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

    /// Makes a wall of given courses from bottom to top, each a list of brick lengths in units of one brick; a
    /// negative number is an opening of this length.
    pub fn from_courses(name: &str, material: &str, brick: Brick, courses: Vec<Vec<f64>>) -> Self {
        Self::new(name, material, brick, Courses::List(courses))
    }

    setters! {
        /// Sets the bond of the courses.
        pub fn bond(mut self, bond: Bond) { self.bond = Some(bond) }
        /// Adds an opening to the wall.
        pub fn opening(mut self, opening: Opening) { self.openings.push(opening) }
        /// Sets the classes of the bed and head joints within the wall.
        pub fn joints(mut self, bed: &str, head: &str) {
            self.joints = WallJoints { bed: Some(bed.to_owned()), head: Some(head.to_owned()) }
        }
        /// Puts the lower left corner of the wall at `origin` \[length\] instead of `[0, 0]`.
        pub fn origin(mut self, origin: [f64; 2]) { self.origin = origin }
        /// Turns the wall about its origin, counter-clockwise \[degrees\].
        pub fn turn_deg(mut self, degrees: f64) { self.turn_deg = degrees }
        /// Puts the other end of the bottom of the wall at this point \[length\]. The point determines the angle by
        /// which the wall is turned, and its width if no width is given.
        pub fn to(mut self, corner: [f64; 2]) { self.to = Some(corner) }
        /// Sets the numbers of elements along the length and the height of a whole brick.
        pub fn mesh(mut self, mesh: [u32; 2]) { self.mesh = Some(mesh) }
    }

    fn new(name: &str, material: &str, brick: Brick, courses: Courses) -> Self {
        Self {
            name: name.to_owned(),
            material: material.to_owned(),
            origin: [0.0; 2],
            turn_deg: 0.0,
            to: None,
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
    /// Makes a block with corners \[length\] in counter-clockwise order.
    pub fn new(name: &str, material: &str, corners: impl Into<Vec<[f64; 2]>>) -> Self {
        let (name, material) = (name.to_owned(), material.to_owned());
        Self { name, material, corners: corners.into(), mesh: None }
    }

    setters! {
        /// Sets the numbers of elements along edges 0 and 2, and along edges 1 and 3.
        pub fn mesh(mut self, mesh: [u32; 2]) { self.mesh = Some(mesh) }
    }
}

impl Support {
    /// Makes a support between two points \[length\], and sets the class of its joints.
    pub fn new(name: &str, from: [f64; 2], to: [f64; 2], joint: &str) -> Self {
        Self { name: name.to_owned(), from, to, joint: joint.to_owned() }
    }
}
