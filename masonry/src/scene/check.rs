//! Checks of the data of a scene that need no geometry of several blocks.

use std::collections::BTreeMap;

use nalgebra::Point2;

use super::rules::{
    Check, MAGNITUDES, finite, missing, not_negative, plain, point, positive, too_many, unwanted,
    value,
};
use super::{
    Between, Block, Courses, Fault, Form, KeyPath, Known, Material, Route, RouteSetting, Scene,
    SceneError, SceneErrorKind, Solver, Support, Wall,
};
use crate::geometry::{self, PolygonError};
use crate::scene::bond::JointThickness;

mod arches;
mod joints;
mod loads;

mod openings;
mod stages;

/// Bricks and blocks of one scene, at most.
const MOST_BLOCKS: u32 = 1_000_000;
/// Elements of one wall, at most: a mesh that fits in no memory is told before it is made.
const MOST_ELEMENTS_OF_WALL: u32 = 20_000_000;
/// Elements of one block along one edge, at most.
const MOST_ELEMENTS: u32 = 1_000;

impl Scene {
    /// Checks all data: names that refer to nothing, numbers out of their range, missing keys.
    ///
    /// Mistakes of the whole geometry (overlaps, idle supports and loads, loose blocks) are found
    /// by [`Model::from_scene`](crate::model::Model::from_scene).
    ///
    /// # Errors
    /// The first mistake, with line and column when the scene was read from text.
    pub fn check(&self) -> Result<(), SceneError> {
        self.check_data().map_err(|fault| fault.locate(self))
    }

    fn check_data(&self) -> Check {
        self.check_general()?;
        for (name, material) in &self.materials {
            plain(KeyPath::of("materials").key(name), name)?;
            self.check_material(&KeyPath::of("materials").key(name), material)?;
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
        for (k, wall) in self.walls.iter().enumerate() {
            self.check_wall(&KeyPath::of("walls").item(k), wall)?;
        }
        for (k, block) in self.blocks.iter().enumerate() {
            self.check_block(&KeyPath::of("blocks").item(k), block)?;
        }
        self.check_arches()?;
        if self.all_supports().is_empty() {
            return Err(Fault::new(KeyPath::default(), SceneErrorKind::NoSupport));
        }
        for (k, between) in self.between.iter().enumerate() {
            self.check_between(&KeyPath::of("between").item(k), between)?;
        }
        for (k, support) in self.supports.iter().enumerate() {
            self.check_support(&KeyPath::of("supports").item(k), support)?;
        }
        self.check_loads()?;
        self.check_stages()?;
        self.check_limit()?;
        self.check_options()
    }

    fn check_general(&self) -> Check {
        plain(KeyPath::of("title"), &self.title)?;
        if let Some(path) = &self.block_list {
            let message = "only reading a scene file takes it in".to_owned();
            let kind = SceneErrorKind::BlockList { path: path.clone(), message };
            return Err(Fault::new(KeyPath::of("block_list"), kind));
        }
        let Some(thickness) = self.thickness else {
            let because = "to turn tractions into forces";
            return Err(missing(&KeyPath::default(), "thickness", because, "thickness = 1.0"));
        };
        positive(KeyPath::of("thickness"), thickness)?;
        self.gravity.map_or(Ok(()), |gravity| point(&KeyPath::of("gravity"), gravity))
    }

    fn check_material(&self, at: &KeyPath, material: &Material) -> Check {
        match (material.young, material.poisson) {
            (Some(young), Some(poisson)) => {
                positive(at.key("E"), young)?;
                let wanted = "Poisson's ratio lies between -1 and 0.5, both excluded";
                value(at.key("nu"), poisson, poisson > -1.0 && poisson < 0.5, wanted)?;
                if self.plane.is_none() {
                    let because = "because a material is elastic";
                    return Err(missing(
                        &KeyPath::default(),
                        "plane",
                        because,
                        "plane = \"stress\"",
                    ));
                }
            }
            (Some(_), None) => return Err(missing(at, "nu", "with `E`", "nu = 0.2")),
            (None, Some(_)) => {
                return Err(unwanted(at, "nu", "has no meaning without `E`", ", or add `E`"));
            }
            (None, None) => {}
        }
        material.density.map_or(Ok(()), |density| positive(at.key("density"), density))
    }

    /// Names of walls, blocks, supports and loads: given, and each once among its like.
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
        positive(at.key("brick").key("length"), wall.brick.length)?;
        positive(at.key("brick").key("height"), wall.brick.height)?;
        let count = match &wall.courses {
            Courses::RunningBond(count) => {
                check_running_bond(at, wall, *count, JointThickness::of(self, wall))?
            }
            Courses::List(courses) => check_courses(at, wall, courses)?,
        };
        if count > f64::from(MOST_BLOCKS) {
            return Err(too_many(at.key("courses"), "bricks", count, MOST_BLOCKS));
        }
        for (key, class) in [("bed", &wall.joints.bed), ("head", &wall.joints.head)] {
            let Some(class) = class else { continue };
            self.check_class(at.key("joints").key(key), class)?;
        }
        joints::check_room(at, wall, JointThickness::of(self, wall))?;
        check_mesh(at, wall.mesh, material)?;
        let elements = wall.mesh.map_or(1.0, |counts| counts.map(f64::from).iter().product());
        let most = MOST_ELEMENTS_OF_WALL;
        if count * elements > f64::from(most) {
            return Err(too_many(at.key("mesh"), "elements of a wall", count * elements, most));
        }
        Ok(())
    }

    fn check_block(&self, at: &KeyPath, block: &Block) -> Check {
        let material = self.material_of(at, &block.material)?;
        for (k, corner) in block.corners.iter().enumerate() {
            point(&at.key("corners").item(k), *corner)?;
        }
        self.check_shape(at.key("corners"), block)?;
        let count = block.corners.len();
        if material.young.is_some() && count != 4 {
            let kind = SceneErrorKind::NoQuadrilateral { block: block.name.clone(), count };
            return Err(Fault::new(at.key("corners"), kind));
        }
        check_mesh(at, block.mesh, material)
    }

    fn check_shape(&self, at: KeyPath, block: &Block) -> Check {
        let corners: Vec<_> = block.corners.iter().map(|[x, y]| Point2::new(*x, *y)).collect();
        let name = block.name.clone();
        match geometry::check_convex(&corners) {
            Ok(()) => Ok(()),
            Err(PolygonError::Clockwise { area }) => {
                let unit = self.units.length_name();
                Err(Fault::new(at, SceneErrorKind::Clockwise { block: name, area, unit }))
            }
            Err(PolygonError::NotConvex { corner }) => {
                let kind = SceneErrorKind::NotConvex { block: name, corner: corner + 1 };
                Err(Fault::new(at.item(corner), kind))
            }
            Err(PolygonError::TooFew { count }) => {
                Err(Fault::new(at, SceneErrorKind::TooFewCorners { block: name, count }))
            }
            Err(PolygonError::Crossing) => {
                Err(Fault::new(at, SceneErrorKind::CrossingEdges { block: name }))
            }
            Err(PolygonError::NotFinite) => finite(at, f64::INFINITY),
        }
    }

    fn check_support(&self, at: &KeyPath, support: &Support) -> Check {
        segment(at, support.from, support.to)?;
        self.check_class(at.key("joint"), &support.joint)
    }

    /// The class; whether the blocks exist is known with the model.
    fn check_between(&self, at: &KeyPath, between: &Between) -> Check {
        self.check_class(at.key("joint"), &between.joint)
    }

    fn check_class(&self, at: KeyPath, class: &str) -> Check {
        if self.joints.contains_key(class) {
            return Ok(());
        }
        let known = self.joints.keys().cloned().collect();
        Err(unknown(at, "joint class", class, known, "joints"))
    }

    fn check_options(&self) -> Check {
        let contact = KeyPath::of("contact");
        not_negative(contact.key("gap_limit"), self.contact.gap_limit)?;
        not_negative(contact.key("tolerance"), self.contact.tolerance.unwrap_or(0.0))?;
        self.check_films(&contact)?;
        let (solver, tolerance) = (KeyPath::of("solver"), self.solver.tolerance);
        let wanted = "the tolerance is a relative residual between 0 and 1, both excluded";
        value(solver.key("tolerance"), tolerance, tolerance > 0.0 && tolerance < 1.0, wanted)?;
        let pivots = self.solver.max_pivots;
        let wanted = "at least one pivot; leave the key out for a limit by the order";
        value(solver.key("max_pivots"), 0.0, pivots != Some(0), wanted)?;
        let wanted = "at least one step; leave the key out for the usual limit";
        value(solver.key("max_steps"), 0.0, self.solver.max_steps != Some(0), wanted)?;
        if let Some(soft) = self.solver.soft {
            let wanted = "springs have a stiffness above 0 and at most 1, that of the blocks";
            value(solver.key("soft"), soft, soft > 0.0 && soft <= 1.0, wanted)?;
        }
        self.check_route(&solver)
    }

    /// Rejects keys of the solver that the route does not use.
    fn check_route(&self, at: &KeyPath) -> Check {
        let Solver { route, form, max_pivots, max_steps, soft, .. } = self.solver;
        let pivots = route.allows(Route::Lemke);
        let springs = [Route::Qp, Route::Pgs].map(RouteSetting::Only).contains(&route);
        let otherwise = ", or set route = \"lemke\"";
        if form != Form::Auto && !pivots {
            let because = "is used by the routes `auto` and `lemke` only";
            return Err(unwanted(at, "form", because, otherwise));
        }
        if max_pivots.is_some() && !pivots {
            let because = "is used by the routes `auto` and `lemke` only";
            return Err(unwanted(at, "max_pivots", because, otherwise));
        }
        if max_steps.is_some() && !route.allows(Route::Interior) {
            let because = "is used by the routes `auto` and `interior` only";
            return Err(unwanted(at, "max_steps", because, ", or set route = \"interior\""));
        }
        if soft.is_some() && !springs {
            let because = "is the stiffness of springs, which only the routes `qp` and `pgs` have";
            let otherwise = ", or set route = \"qp\" or route = \"pgs\"";
            return Err(unwanted(at, "soft", because, otherwise));
        }
        Ok(())
    }

    fn material_of(&self, at: &KeyPath, name: &str) -> Result<&Material, Fault> {
        self.materials.get(name).ok_or_else(|| {
            let known = self.materials.keys().cloned().collect();
            unknown(at.key("material"), "material", name, known, "materials")
        })
    }
}

/// Checks the keys of a wall in a bond; an upper bound of the number of its bricks.
fn check_running_bond(
    at: &KeyPath,
    wall: &Wall,
    count: u32,
    joints: JointThickness,
) -> Result<f64, Fault> {
    value(at.key("courses"), f64::from(count), count > 0, "a wall has at least one course")?;
    let Some(width) = wall.width else {
        return Err(missing(at, "width", "where `courses` is a number", "width = 1.0"));
    };
    positive(at.key("width"), width)?;
    let size = openings::WallSize { width, courses: count };
    openings::check(at, wall, joints, size)?;
    // An English bond has two headers a brick, and an opening divides two bricks.
    let in_course = 2.0 * width / wall.brick.length + 3.0 + 2.0 * wall.openings.len() as f64;
    Ok(f64::from(count) * in_course.floor())
}

/// Checks a list of courses; the number of its bricks.
fn check_courses(at: &KeyPath, wall: &Wall, courses: &[Vec<f64>]) -> Result<f64, Fault> {
    if wall.width.is_some() {
        let because = "has no meaning where `courses` is a list";
        return Err(unwanted(at, "width", because, ", or give the number of courses"));
    }
    for (key, given) in [("bond", wall.bond.is_some()), ("openings", !wall.openings.is_empty())] {
        if given {
            let because = "is for walls whose `courses` is a number";
            return Err(unwanted(at, key, because, ", or give the number of courses"));
        }
    }
    let list = at.key("courses");
    if courses.is_empty() {
        let remedy = "give at least one course, such as [[1, 1]]";
        return Err(Fault::new(list, SceneErrorKind::EmptyList { remedy }));
    }
    for (k, course) in courses.iter().enumerate() {
        if course.is_empty() {
            let remedy = "give the bricks of the course; an opening is a negative length";
            return Err(Fault::new(list.item(k), SceneErrorKind::EmptyList { remedy }));
        }
        for (place, length) in course.iter().enumerate() {
            let at = list.item(k).item(place);
            let wanted =
                "lengths in a course are positive for a brick, negative for an opening, and finite";
            value(at.clone(), *length, MAGNITUDES.contains(&length.abs()), wanted)?;
            let elements = length * f64::from(wall.mesh.map_or(1, |[along, _]| along));
            if elements > f64::from(MOST_ELEMENTS) {
                return Err(too_many(at, "elements along an edge", elements, MOST_ELEMENTS));
            }
        }
    }
    Ok(courses.iter().map(Vec::len).sum::<usize>() as f64)
}

fn check_mesh(at: &KeyPath, mesh: Option<[u32; 2]>, material: &Material) -> Check {
    let Some(counts) = mesh else {
        return match material.young {
            Some(_) => Err(missing(at, "mesh", "because the material is elastic", "mesh = [1, 1]")),
            None => Ok(()),
        };
    };
    for (k, count) in counts.into_iter().enumerate() {
        let at = at.key("mesh").item(k);
        if count > MOST_ELEMENTS {
            return Err(too_many(at, "elements along an edge", f64::from(count), MOST_ELEMENTS));
        }
        value(at, f64::from(count), count > 0, "a block has at least one element along each edge")?;
    }
    Ok(())
}

fn segment(at: &KeyPath, from: [f64; 2], to: [f64; 2]) -> Check {
    point(&at.key("from"), from)?;
    point(&at.key("to"), to)?;
    let apart = from.iter().zip(&to).any(|(a, b)| (a - b).abs() >= *MAGNITUDES.start());
    if apart {
        return Ok(());
    }
    Err(Fault::new(at.key("to"), SceneErrorKind::NoLength { x: to[0], y: to[1] }))
}

fn unique<'a>(
    what: &'static str,
    list: &'static str,
    names: impl Iterator<Item = &'a String>,
) -> Check {
    let mut first = BTreeMap::new();
    for (k, name) in names.enumerate() {
        let at = KeyPath::of(list).item(k);
        if name.trim().is_empty() {
            return Err(Fault::new(at.key("name"), SceneErrorKind::EmptyName));
        }
        plain(at.key("name"), name)?;
        if let Some(taken) = first.insert(name, at.clone()) {
            let kind =
                SceneErrorKind::Duplicate { what, name: name.clone(), first: taken.to_string() };
            return Err(Fault::new(at.key("name"), kind));
        }
    }
    Ok(())
}

fn unknown(
    at: KeyPath,
    what: &'static str,
    name: &str,
    known: Vec<String>,
    table: &'static str,
) -> Fault {
    let missing = match what {
        "load" | "load or group" | "support" => format!("it under [[{table}]]"),
        _ => format!("[{table}.{name}]"),
    };
    Fault::new(
        at,
        SceneErrorKind::Unknown {
            what,
            name: name.to_owned(),
            known: Known::near(name, known),
            missing,
        },
    )
}
