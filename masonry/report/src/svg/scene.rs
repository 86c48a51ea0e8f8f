//! A scene before it is solved: blocks and their materials, supports, joints, contact points, loads.

use nalgebra::Point2;

use super::arrows::{Arrows, Displaced};
use super::canvas::{Anchor, Pixel, arrow, text_width};
use super::dimensions::Dimensions;
use super::labels::Labels;
use super::legend;
use super::motion::Motion;
use super::names;
use super::sheet::Sheet;
use super::structure::{self, counted};
use super::style::{COLOURS, CONTACT, LARGEST_BRICK, MATERIALS};
use crate::format::{InUnits, acceleration_text, significant, stress_text};
use masonry::geometry;
use masonry::ids::JointId;
use masonry::law::JointLaw;
use masonry::model::{Elasticity, Model, PlacedBlock};

/// The largest number of blocks whose names are drawn; more names would hide the blocks.
const NAMED: usize = 120;
/// Largest and smallest size of the letters of names.
const LARGEST: f64 = 12.0;
const READABLE: f64 = 7.0;

/// Draws the scene as it would be solved: bricks with their materials, and their names if there is room, dimensions,
/// hatched supports, joints in the colour of their class, contact points, and loads with values and units.
pub fn scene(title: &str, model: &Model) -> String {
    let units = InUnits(model.units);
    let loads = Arrows::of_loads(model, None);
    let dimensions = Dimensions::of(model, loads.margins());
    let bounds = structure::bounds(model);
    let mut sheet = Sheet::new(title.to_owned(), model, bounds, dimensions.margins());
    draw_materials(&mut sheet, model);
    structure::supports(&mut sheet, model, Motion::NONE);
    draw_joints(&mut sheet, model);
    let mut labels = Labels::within(sheet.room);
    loads.draw(&mut sheet, model, &mut labels, &Displaced::NOT);
    dimensions.draw(&mut sheet, units);
    draw_names(&mut sheet, model);
    explain_gravity(&mut sheet, model);
    sheet.finish()
}

/// The constants of a material.
#[derive(Clone, Copy, PartialEq)]
struct Constants {
    elasticity: Option<Elasticity>,
    density: Option<f64>,
}

impl Constants {
    fn of(block: &PlacedBlock) -> Self {
        Self { elasticity: block.elasticity, density: block.density }
    }

    fn text(self) -> String {
        let Self { elasticity, density } = self;
        let text = match elasticity {
            Some(Elasticity { young, poisson }) => {
                let (young, poisson) = (stress_text(young), significant(poisson, 3));
                format!("E\u{a0}=\u{a0}{young}, ν\u{a0}=\u{a0}{poisson}")
            }
            None => "rigid".to_owned(),
        };
        match density {
            Some(density) => format!("{text}, {}\u{a0}kg/m³", significant(density, 4)),
            None => text,
        }
    }
}

/// Draws all blocks, and a legend entry for every material; all blocks have the thickness of the structure.
fn draw_materials(sheet: &mut Sheet, model: &Model) {
    let mut materials: Vec<Constants> = Vec::new();
    for constants in model.blocks.iter().map(Constants::of) {
        if !materials.contains(&constants) {
            materials.push(constants);
        }
    }
    for (constants, index) in materials.into_iter().zip((0..MATERIALS).cycle()) {
        let class = &format!("bricks material{index}");
        let own = model.blocks.iter().filter(|block| Constants::of(block) == constants);
        let text = format!("{}, {}", counted(own.clone().count(), "block"), constants.text());
        structure::outlines(sheet, class, own);
        sheet.legend.add(&text, class, legend::block);
    }
    let thickness = InUnits(model.units).length_text(model.thickness);
    sheet.legend.note(&format!("thickness out of the plane {thickness}"));
}

fn draw_joints(sheet: &mut Sheet, model: &Model) {
    let radius = CONTACT * sheet.marks();
    for (index, class) in model.joint_classes.iter().enumerate() {
        let colour = format!("colour{}", index % COLOURS);
        let [lines, dots] = ["joints", "contacts"].map(|class| format!("{class} {colour}"));
        let is_own = |joint: &JointId| model.joints[joint.index()].class == index;
        let own = (0..model.joints.len()).map(JointId::new).filter(is_own);
        if own.clone().next().is_none() {
            continue;
        }
        structure::joints(sheet, &lines, model, own);
        sheet.layer(&dots, |canvas, frame| {
            for contact in model.contacts.iter().filter(|it| is_own(&it.joint)) {
                let name = names::number(contact.joint);
                canvas.circle(frame.at(contact.position), radius, &name);
            }
        });
        let text = format!("joints \"{}\", {}", class.name, law(&class.law));
        sheet.legend.add(&text, &lines, |symbol| {
            legend::line(symbol);
            for x in [-22.0, 22.0] {
                let radius = CONTACT * LARGEST_BRICK;
                symbol.circle(Pixel::new(x, 0.0), radius, "class=\"contacts\"");
            }
        });
    }
}

/// Returns the law of a joint class in words: friction, and strength and stiffness if there are any.
fn law(law: &JointLaw) -> String {
    let strength = [("c", law.cohesion), ("f_t", law.tension)].into_iter();
    let strength = strength.filter(|(_, value)| *value > 0.0);
    let strength = strength.map(|(name, value)| (name, stress_text(value)));
    let stiffness = law.stiffness.iter().flat_map(|it| ["k_n", "k_t"].into_iter().zip(it));
    let stiffness = stiffness.map(|(name, value)| (name, stress_text(*value) + "/m"));
    let values = std::iter::once(("μ", significant(law.mu, 4))).chain(strength).chain(stiffness);
    let texts: Vec<String> =
        values.map(|(name, value)| format!("{name}\u{a0}=\u{a0}{value}")).collect();
    texts.join(", ")
}

/// Draws the names of all blocks in their middle, in one size that fits all blocks; draws no names if there is no such
/// size.
fn draw_names(sheet: &mut Sheet, model: &Model) {
    let fitting = |block: &PlacedBlock| {
        let [wide, high] = room(&block.corners).map(|it| it * sheet.frame.scale);
        let width = text_width(&block.name, 1.0).max(f64::MIN_POSITIVE);
        (0.8 * wide / width).min(0.6 * high)
    };
    let size = model.blocks.iter().map(fitting).fold(LARGEST, f64::min);
    if model.blocks.len() > NAMED || size < READABLE {
        return;
    }
    sheet.layer("names", |canvas, frame| {
        for block in &model.blocks {
            let at = frame.at(inner_place(&block.corners));
            let base = Pixel::new(at.x, at.y + 0.36 * size);
            canvas.text(base, Anchor::Middle, size, &names::block(block), &block.name);
        }
    });
}

/// Returns a point well inside a block: the centroid, or, if the block is not convex, the deepest of the centroids of
/// the block and of the triangles at its corners.
fn inner_place(corners: &[Point2<f64>]) -> Point2<f64> {
    let centre = geometry::centroid(corners);
    if geometry::check_convex(corners).is_ok() {
        return centre;
    }
    let count = corners.len();
    let at_corner = |k: usize| {
        let [before, after] = [(k + count - 1) % count, (k + 1) % count].map(|k| corners[k]);
        Point2::from((before.coords + corners[k].coords + after.coords) / 3.0)
    };
    let depth = |place: &Point2<f64>| -geometry::outside(corners, *place);
    let deepest = (0..count).map(at_corner).max_by(|a, b| depth(a).total_cmp(&depth(b)));
    deepest.filter(|it| depth(it) > depth(&centre)).unwrap_or(centre)
}

/// Returns the lengths of the horizontal and the vertical line through the place of the name of a block, from edge to
/// edge \[m\].
fn room(corners: &[Point2<f64>]) -> [f64; 2] {
    let centre = inner_place(corners);
    let chord = |along: usize, across: usize| {
        let crossings = (0..corners.len()).filter_map(|k| {
            let [p, q] = geometry::edge(corners, k);
            let at = (centre[across] - p[across]) / (q[across] - p[across]);
            (0.0..=1.0).contains(&at).then(|| p[along] + (q[along] - p[along]) * at)
        });
        let before = crossings.clone().filter(|it| *it < centre[along]).reduce(f64::max);
        let after = crossings.filter(|it| *it > centre[along]).reduce(f64::min);
        before.zip(after).map_or(0.0, |(low, high)| high - low)
    };
    [chord(0, 1), chord(1, 0)]
}

fn explain_gravity(sheet: &mut Sheet, model: &Model) {
    let pull = model.gravity;
    if pull.norm() > 0.0 && model.blocks.iter().any(|block| block.density.is_some()) {
        let text = format!("self weight, {}", acceleration_text(pull.norm()));
        let ends = [-9.0, 9.0].map(|it| Pixel::new(0.0, 0.0).along(pull, it));
        sheet.legend.add(&text, "weight", |symbol| symbol.path(&arrow(ends), ""));
    }
}
