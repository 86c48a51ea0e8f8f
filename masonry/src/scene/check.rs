//! Checks of the data of a scene that do not need the geometry of several blocks.

use std::collections::BTreeMap;

use nalgebra::Point2;

use super::rules::{
    Check, MAGNITUDES, at_least_one, at_most, each, finite, named, needed, not_negative, plain,
    point, positive, unwanted, value,
};
use super::{
    Block, Courses, Fault, Form, KeyPath, Material, Route, RouteSetting, Scene, SceneError,
    SceneErrorKind, SolverSettings, Support, Wall,
};
use crate::geometry::{self, PolygonError};
use crate::scene::bond::JointThickness;

mod arches;
mod joints;
mod limit;
mod loads;
mod openings;
mod stages;

/// Largest number of bricks and blocks of one scene.
const MOST_BLOCKS: u32 = 1_000_000;
/// Largest number of elements of one wall: a mesh that fits into no memory is refused before it is made.
const MOST_ELEMENTS_OF_WALL: u32 = 20_000_000;
/// Largest number of elements of one block. Chosen: the square of the largest number along an edge.
const MOST_ELEMENTS_OF_BLOCK: u32 = 1_000_000;
/// Largest number of elements along one edge. Chosen: more than a plane problem needs.
const MOST_ELEMENTS: u32 = 1_000;

impl Scene {
    /// Checks all data of the scene: names that refer to nothing, numbers out of their range, missing keys.
    ///
    /// Mistakes of the geometry as a whole (overlaps, supports and loads that touch nothing, loose blocks) are found
    /// by [`Model::from_scene`](crate::model::Model::from_scene).
    ///
    /// # Errors
    /// The first mistake, with line and column if the scene was read from text.
    pub fn check(&self) -> Result<(), SceneError> {
        self.check_data().map_err(|fault| fault.locate(self))
    }

    fn check_data(&self) -> Check {
        self.check_general()?;
        for (name, material) in &self.materials {
            let at = KeyPath::of("materials").key(name);
            plain(at.clone(), name)?;
            self.check_material(&at, material)?;
        }
        for (name, joint) in &self.joints {
            let at = KeyPath::of("joints").key(name);
            plain(at.clone(), name)?;
            joints::check_law(&at, joint)?;
            self.check_mortar(&at, joint)?;
        }
        if self.walls.is_empty() && self.blocks.is_empty() && self.arches.is_empty() {
            return Err(Fault::new(KeyPath::default(), SceneErrorKind::Empty));
        }
        self.check_names()?;
        each("walls", &self.walls, |at, wall| self.check_wall(at, wall))?;
        each("blocks", &self.blocks, |at, block| self.check_block(at, block))?;
        each("arches", &self.arches, |at, arch| self.check_arch(at, arch))?;
        if self.all_supports().is_empty() {
            return Err(Fault::new(KeyPath::default(), SceneErrorKind::NoSupport));
        }
        // The existence of the blocks is checked with the model.
        each("between", &self.between, |at, it| self.check_class(at.key("joint"), &it.joint))?;
        each("supports", &self.supports, |at, support| self.check_support(at, support))?;
        each("loads", &self.loads, |at, load| self.check_load(at, load))?;
        unique("stage", "stages", self.stages.iter().map(|stage| &stage.name))?;
        each("stages", &self.stages, |at, stage| self.check_stage(at, stage))?;
        let is_both = !self.stages.is_empty() && !self.combinations.is_empty();
        let because = "cannot stand beside `stages`, which are one set of loads";
        let otherwise = ", or remove `stages`";
        unwanted(is_both, &KeyPath::default(), "combinations", because, otherwise)?;
        unique("combination", "combinations", self.combinations.iter().map(|it| &it.name))?;
        each("combinations", &self.combinations, |at, it| self.check_combination(at, it))?;
        self.check_limit()?;
        self.check_options()
    }

    fn check_general(&self) -> Check {
        plain(KeyPath::of("title"), &self.title)?;
        if let Some(path) = &self.block_list {
            let message =
                "only reading a scene file takes it in: list its blocks in the scene".to_owned();
            let kind = SceneErrorKind::BlockList { path: path.clone(), message };
            return Err(Fault::new(KeyPath::of("block_list"), kind));
        }
        let because = "to turn tractions into forces";
        let top = KeyPath::default();
        let thickness = needed(self.thickness, &top, "thickness", because, "thickness = 1.0")?;
        positive(top.key("thickness"), thickness)?;
        self.gravity.map_or(Ok(()), |gravity| point(&top.key("gravity"), gravity))
    }

    fn check_material(&self, at: &KeyPath, material: &Material) -> Check {
        let Material { young, poisson, density } = *material;
        if let Some(young) = young {
            let poisson = needed(poisson, at, "nu", "with `E`", "nu = 0.2")?;
            positive(at.key("E"), young)?;
            let wanted = "Poisson's ratio lies between -1 and 0.5, both excluded";
            value(at.key("nu"), poisson, poisson > -1.0 && poisson < 0.5, wanted)?;
            let (top, because) = (KeyPath::default(), "because a material is elastic");
            needed(self.plane, &top, "plane", because, "plane = \"stress\"")?;
        } else {
            let because = "has no meaning without `E`";
            unwanted(poisson.is_some(), at, "nu", because, ", or add `E`")?;
        }
        density.map_or(Ok(()), |density| positive(at.key("density"), density))
    }

    /// Checks that walls, arches, blocks, supports and loads have names, each unique among its kind.
    fn check_names(&self) -> Check {
        unique("wall", "walls", self.walls.iter().map(|wall| &wall.name))?;
        unique("arch", "arches", self.arches.iter().map(|arch| &arch.name))?;
        unique("block", "blocks", self.blocks.iter().map(|block| &block.name))?;
        unique("support", "supports", self.supports.iter().map(|support| &support.name))?;
        unique("load", "loads", self.loads.iter().map(|load| &load.name))
    }

    fn check_wall(&self, at: &KeyPath, wall: &Wall) -> Check {
        let material = self.material_of(at, &wall.material)?;
        point(&at.key("origin"), wall.origin)?;
        finite(at.key("turn_deg"), wall.turn_deg)?;
        if let Some(to) = wall.to {
            let at_to = at.key("to");
            point(&at_to, to)?;
            let because = "has no meaning beside `to`, towards which the bottom of the wall runs";
            unwanted(wall.turn_deg.abs() > 0.0, at, "turn_deg", because, "")?;
            let length = (to[0] - wall.origin[0]).hypot(to[1] - wall.origin[1]);
            let wanted = "the bottom of a wall runs from `origin` to another point";
            value(at_to, length, length > 0.0, wanted)?;
        }
        positive(at.key("brick").key("length"), wall.brick.length)?;
        positive(at.key("brick").key("height"), wall.brick.height)?;
        let joints = JointThickness::of(self, wall);
        let count = match &wall.courses {
            Courses::RunningBond(count) => check_running_bond(at, wall, *count, joints)?,
            Courses::List(courses) => check_courses(at, wall, courses)?,
        };
        for (key, class) in [("bed", &wall.joints.bed), ("head", &wall.joints.head)] {
            let Some(class) = class else { continue };
            self.check_class(at.key("joints").key(key), class)?;
        }
        for (k, opening) in wall.openings.iter().enumerate() {
            self.check_lintel(at, &at.key("openings").item(k), wall, opening)?;
        }
        joints::check_room(at, wall, joints)?;
        check_mesh(at, wall.mesh, material)?;
        let elements: f64 = wall.mesh.map_or(1.0, |mesh| mesh.map(f64::from).iter().product());
        at_most(at.key("mesh"), "elements of a wall", count * elements, MOST_ELEMENTS_OF_WALL)
    }

    fn check_block(&self, at: &KeyPath, block: &Block) -> Check {
        let material = self.material_of(at, &block.material)?;
        let corners = at.key("corners");
        for (k, corner) in block.corners.iter().enumerate() {
            point(&corners.item(k), *corner)?;
        }
        self.check_shape(&corners, block)?;
        check_mesh(at, block.mesh, material)?;
        match block.mesh.filter(|_| material.young.is_some()) {
            Some(mesh) => check_patches(at, block, mesh),
            None => Ok(()),
        }
    }

    fn check_shape(&self, at: &KeyPath, block: &Block) -> Check {
        let corners: Vec<_> = block.corners.iter().copied().map(Point2::from).collect();
        let Err(error) = geometry::check_simple(&corners) else { return Ok(()) };
        let (block, at) = (block.name.clone(), at.clone());
        Err(match error {
            PolygonError::Clockwise(area) => {
                let unit = self.units.length_name();
                Fault::new(at, SceneErrorKind::Clockwise { block, area, unit })
            }
            PolygonError::NoWidth(corner) | PolygonError::NotConvex(corner) => {
                let kind = SceneErrorKind::NoWidth { block, corner: corner + 1 };
                Fault::new(at.item(corner), kind)
            }
            PolygonError::TooFew(count) => {
                Fault::new(at, SceneErrorKind::TooFewCorners { block, count })
            }
            PolygonError::Crossing => Fault::new(at, SceneErrorKind::CrossingEdges(block)),
            PolygonError::NotFinite => return finite(at, f64::INFINITY),
        })
    }

    fn check_support(&self, at: &KeyPath, support: &Support) -> Check {
        segment(at, support.from, support.to)?;
        self.check_class(at.key("joint"), &support.joint)
    }

    fn check_class(&self, at: KeyPath, class: &str) -> Check {
        named(at, class, "joint class", "joints", &self.joints).map(|_| ())
    }

    fn material_of(&self, at: &KeyPath, name: &str) -> Result<&Material, Fault> {
        named(at.key("material"), name, "material", "materials", &self.materials)
    }

    fn check_options(&self) -> Check {
        let contact = KeyPath::of("contact");
        not_negative(contact.key("gap_limit"), self.contact.gap_limit)?;
        not_negative(contact.key("tolerance"), self.contact.tolerance.unwrap_or(0.0))?;
        self.check_films(&contact)?;
        let SolverSettings { tolerance, max_pivots, max_steps, soft, .. } = self.solver;
        let at = KeyPath::of("solver");
        let wanted = "the tolerance is a relative residual between 0 and 1, both excluded";
        value(at.key("tolerance"), tolerance, tolerance > 0.0 && tolerance < 1.0, wanted)?;
        let wanted = "at least one pivot; leave the key out for a limit by the order";
        at_least_one(at.key("max_pivots"), max_pivots.unwrap_or(1), wanted)?;
        let wanted = "at least one step; leave the key out for the usual limit";
        at_least_one(at.key("max_steps"), max_steps.unwrap_or(1), wanted)?;
        let wanted = "springs have a stiffness above 0 and at most 1, that of the blocks";
        value(
            at.key("soft"),
            soft.unwrap_or(1.0),
            soft.is_none_or(|it| it > 0.0 && it <= 1.0),
            wanted,
        )?;
        self.check_route(&at)
    }

    /// Refuses keys of the solver that the route does not use.
    fn check_route(&self, at: &KeyPath) -> Check {
        let SolverSettings { route, form, max_pivots, max_steps, soft, .. } = self.solver;
        let refuse = |given: bool, is_used: bool, key, because, otherwise| {
            unwanted(given && !is_used, at, key, because, otherwise)
        };
        let (pivots, steps) = (route.allows(Route::Lemke), route.allows(Route::Interior));
        let springs = [Route::Qp, Route::Pgs].map(RouteSetting::Only).contains(&route);
        let because = "is used by the routes `auto` and `lemke` only";
        let otherwise = ", or set route = \"lemke\"";
        refuse(form != Form::Auto, pivots, "form", because, otherwise)?;
        refuse(max_pivots.is_some(), pivots, "max_pivots", because, otherwise)?;
        let because = "is used by the routes `auto` and `interior` only";
        let otherwise = ", or set route = \"interior\"";
        refuse(max_steps.is_some(), steps, "max_steps", because, otherwise)?;
        let because = "is the stiffness of springs, which only the routes `qp` and `pgs` have";
        let otherwise = ", or set route = \"qp\" or route = \"pgs\"";
        refuse(soft.is_some(), springs, "soft", because, otherwise)
    }
}

/// Checks the keys of a wall in a bond; returns an upper bound of the number of its bricks.
fn check_running_bond(
    at: &KeyPath,
    wall: &Wall,
    count: u32,
    joints: JointThickness,
) -> Result<f64, Fault> {
    at_least_one(at.key("courses"), count, "a wall has at least one course")?;
    let because = "because `courses` is a number";
    let width = needed(wall.width_given(), at, "width", because, "width = 1.0")?;
    positive(at.key("width"), width)?;
    // An English bond has two headers a brick, and an opening divides two bricks.
    let in_course = 2.0 * width / wall.brick.length + 3.0 + 2.0 * wall.openings.len() as f64;
    let bricks = f64::from(count) * in_course.floor();
    at_most(at.key("courses"), "bricks", bricks, MOST_BLOCKS)?;
    openings::check(at, wall, joints, openings::WallSize { width, courses: count })?;
    Ok(bricks)
}

/// Checks a list of courses; returns the number of its bricks.
fn check_courses(at: &KeyPath, wall: &Wall, courses: &[Vec<f64>]) -> Result<f64, Fault> {
    let otherwise = ", or give the number of courses";
    let because = "has no meaning if `courses` is a list";
    unwanted(wall.width.is_some(), at, "width", because, otherwise)?;
    let because = "is for walls whose `courses` is a number";
    unwanted(wall.bond.is_some(), at, "bond", because, otherwise)?;
    unwanted(!wall.openings.is_empty(), at, "openings", because, otherwise)?;
    let list = at.key("courses");
    if courses.is_empty() {
        let remedy = "give at least one course, such as [[1, 1]]";
        return Err(Fault::new(list, SceneErrorKind::EmptyList(remedy)));
    }
    for (k, course) in courses.iter().enumerate() {
        if course.is_empty() {
            let remedy = "give the bricks of the course; an opening is a negative length";
            return Err(Fault::new(list.item(k), SceneErrorKind::EmptyList(remedy)));
        }
        for (place, length) in course.iter().enumerate() {
            let at = list.item(k).item(place);
            let wanted =
                "lengths in a course are positive for a brick, negative for an opening, and finite";
            value(at.clone(), *length, MAGNITUDES.contains(&length.abs()), wanted)?;
            let elements = length * f64::from(wall.mesh.map_or(1, |[along, _]| along));
            at_most(at, "elements along an edge", elements, MOST_ELEMENTS)?;
        }
    }
    let bricks = courses.iter().map(Vec::len).sum::<usize>() as f64;
    at_most(list, "bricks", bricks, MOST_BLOCKS)?;
    Ok(bricks)
}

fn check_mesh(at: &KeyPath, mesh: Option<[u32; 2]>, material: &Material) -> Check {
    if material.young.is_some() {
        needed(mesh, at, "mesh", "because the material is elastic", "mesh = [1, 1]")?;
    }
    for (k, count) in mesh.into_iter().flatten().enumerate() {
        let at = at.key("mesh").item(k);
        at_most(at.clone(), "elements along an edge", f64::from(count), MOST_ELEMENTS)?;
        at_least_one(at, count, "a block has at least one element along each edge")?;
    }
    Ok(())
}

/// Refuses blocks that cannot be meshed, and numbers of elements that do not fit the shape of the block.
fn check_patches(at: &KeyPath, block: &Block, mesh: [u32; 2]) -> Check {
    let corners: Vec<_> = block.corners.iter().copied().map(Point2::from).collect();
    let name = || block.name.clone();
    let turns = geometry::without_straight(&corners);
    let (is_convex, count) = (geometry::check_convex(&turns).is_ok(), turns.len());
    if let (false, Some(edge)) = (is_convex, geometry::edge_behind_centroid(&corners)) {
        let kind = SceneErrorKind::NoMesh { block: name(), edge };
        return Err(Fault::new(at.key("corners").item(edge), kind));
    }
    let patches = match (is_convex, count) {
        (true, 4) => 1,
        (true, _) => count,
        (false, _) => 3 * count,
    };
    let [n, m] = mesh.map(f64::from);
    if patches > 1 && mesh[0] != mesh[1] {
        return Err(Fault::new(at.key("mesh"), SceneErrorKind::UnevenMesh { block: name(), mesh }));
    }
    let elements = patches as f64 * n * m;
    at_most(at.key("mesh"), "elements of a block", elements, MOST_ELEMENTS_OF_BLOCK)
}

fn segment(at: &KeyPath, from: [f64; 2], to: [f64; 2]) -> Check {
    point(&at.key("from"), from)?;
    point(&at.key("to"), to)?;
    if from.iter().zip(&to).any(|(a, b)| (a - b).abs() >= *MAGNITUDES.start()) {
        return Ok(());
    }
    Err(Fault::new(at.key("to"), SceneErrorKind::NoLength { x: to[0], y: to[1] }))
}

fn unique<'a>(
    what: &'static str,
    list: &'static str,
    names: impl Iterator<Item = &'a String>,
) -> Check {
    let mut taken = BTreeMap::new();
    for (k, name) in names.enumerate() {
        let (item, at) = (KeyPath::of(list).item(k), KeyPath::of(list).item(k).key("name"));
        if name.trim().is_empty() {
            return Err(Fault::new(at, SceneErrorKind::EmptyName));
        }
        plain(at.clone(), name)?;
        if let Some(first) = taken.insert(name, item) {
            return Err(Fault::duplicate(at, what, name, &first));
        }
    }
    Ok(())
}
