//! Builds a scene from blocks that meet.

use std::collections::BTreeMap;

use nalgebra::Point2;

use super::fit::Fitted;
use super::outline::distance;
use super::report::metres;
use super::sheet::Sheet;
use super::stones::Piece;
use super::supports::{self, CLASS};
use super::{ImportError, ImportErrorKind, ImportOptions, Imported};
use masonry::model::{Body, Model};
use masonry::scene::{Block, Joint, Material, Plane, Scene, SceneError, Support};
use masonry::units::{ForceUnit, LengthUnit, Units};
use masonry_drawing::{Change, Place};

/// The name of the material of mortar in the scene.
const MORTAR: &str = "mortar";
/// Young's modulus \[kN/m2\] and Poisson's ratio of mortar. Chosen: lime mortar; the scene lists them as an assumption.
const OF_MORTAR: (f64, f64) = (1e6, 0.2);
/// The acceleration of gravity \[m/s2\].
const GRAVITY: f64 = 9.81;

/// Builds the scene of a sheet, with the report of all changes.
///
/// # Errors
/// Mistakes of the scene as a model: blocks that touch nothing, supports that run through blocks.
pub(crate) fn scene(
    mut sheet: Sheet,
    fitted: &Fitted,
    options: &ImportOptions,
) -> Result<Imported, ImportError> {
    let units = Units { length: LengthUnit::M, force: ForceUnit::Kn };
    let (thickness, assumed) = assumptions(&sheet, fitted, options);
    let mut scene = Scene::new(&options.title, units).thickness(thickness).gravity([0.0, -GRAVITY]);
    scene = classes(scene, fitted, options);
    scene.contact.gap_limit = fitted.grown.open;
    scene.blocks = blocks(&sheet);
    for block in &scene.blocks {
        let material = Material::rigid().density(options.density);
        scene.materials.entry(block.material.clone()).or_insert(material);
    }
    let (supports, pieces): (Vec<Support>, Vec<Piece>) =
        supports::used(&mut sheet, fitted).into_iter().unzip();
    scene.supports = supports;
    let places: Vec<Place> = sheet.stones.iter().map(|stone| stone.place.clone()).collect();
    let located = |error: SceneError| {
        let place = place(&error, &places, &pieces);
        ImportErrorKind::Scene(error).at(&place.into_iter().collect::<Vec<_>>())
    };
    let model = Model::from_scene(&scene).map_err(located)?;
    if !sheet.marks.is_empty() {
        mark(&mut scene, &model, &mut sheet, options);
        Model::from_scene(&scene).map_err(located)?;
    }
    let supports_of_scene = pieces.iter().filter(|piece| piece.is_of_scene).count();
    let Sheet { changes, tolerance, unit, drawn, .. } = sheet;
    Ok(Imported { scene, changes, tolerance, unit, drawn, places, supports_of_scene, assumed })
}

fn assumptions(sheet: &Sheet, fitted: &Fitted, options: &ImportOptions) -> (f64, Vec<String>) {
    let mut assumed = vec![
        format!("density {} kg/m3 of all blocks", options.density),
        format!("friction mu = {} in all joints", options.mu),
    ];
    let thickness = options.thickness.or(sheet.thickness).unwrap_or_else(|| {
        assumed.push("thickness 1 m out of the plane: give --thickness".to_owned());
        1.0
    });
    let mortar = [("bed", fitted.grown.bed), ("head", fitted.grown.head)];
    for (class, width) in mortar.into_iter().filter_map(|(class, width)| Some((class, width?))) {
        let (young, poisson) = OF_MORTAR;
        let width = metres(width);
        assumed.push(format!(
            "mortar of {width} m in {class} joints, E = {young} kN/m2, nu = {poisson}, in plane stress"
        ));
    }
    (thickness, assumed)
}

fn classes(mut scene: Scene, fitted: &Fitted, options: &ImportOptions) -> Scene {
    let dry = || Joint::mu(options.mu);
    for (name, width) in [("bed", fitted.grown.bed), ("head", fitted.grown.head)] {
        let joint = width.map_or_else(dry, |width| dry().mortar(width, MORTAR));
        scene = scene.joint(name, joint);
    }
    if fitted.grown.bed.or(fitted.grown.head).is_some() {
        let (young, poisson) = OF_MORTAR;
        scene = scene.plane(Plane::Stress).material(MORTAR, Material::elastic(young, poisson));
    }
    scene.joint(CLASS, dry())
}

/// Returns the blocks with names: the names of the file, or the material and a number.
fn blocks(sheet: &Sheet) -> Vec<Block> {
    let mut counts: BTreeMap<String, u32> = BTreeMap::new();
    let mut next = |name: &str| {
        let number = counts.entry(name.to_owned()).and_modify(|it| *it += 1).or_insert(1);
        *number
    };
    let named = sheet.stones.iter().map(|stone| {
        let name = match &stone.name {
            Some(name) if next(name) == 1 => name.clone(),
            Some(name) => format!("{name} (block {})", next("block of a name")),
            None => format!("{}/{}", stone.material, next(&format!("{}/", stone.material))),
        };
        let corners: Vec<[f64; 2]> = stone.corners.iter().map(|it| [it.x, it.y]).collect();
        Block::new(&name, &stone.material, corners)
    });
    named.collect()
}

/// Gives joints that lie on a mark the class of the mark.
fn mark(scene: &mut Scene, model: &Model, sheet: &mut Sheet, options: &ImportOptions) {
    let mut is_used = vec![false; sheet.marks.len()];
    for joint in &model.joints {
        let thickness = joint.film.map_or(0.0, |film| film.mortar.thickness);
        let reach = sheet.tolerance + thickness;
        let is_below = |mark: &Piece| {
            let ends = [joint.from, joint.to];
            // The shorter of the two lines lies on the longer one.
            let lies =
                |points: [Point2<f64>; 2], on| points.iter().all(|it| distance(*it, on) <= reach);
            lies(ends, mark.ends) || lies(mark.ends, ends)
        };
        let Some(k) = sheet.marks.iter().position(is_below) else { continue };
        is_used[k] = true;
        let (class, b) = (&sheet.marks[k].name, &model.blocks[joint.b.index()].name);
        scene.joints.entry(class.clone()).or_insert_with(|| Joint::mu(options.mu));
        match joint.a {
            Body::Block(a) => {
                let a = &model.blocks[a.index()].name;
                *scene = scene.clone().between(a, b, class);
            }
            Body::Support(a) => scene.supports[a.index()].joint.clone_from(class),
        }
    }
    let idle = sheet.marks.iter().zip(is_used).filter(|(_, is_used)| !is_used);
    let what = "lines of joints that lie on no joint were dropped";
    sheet.changes.extend(idle.map(|(mark, _)| Change::new(what, &mark.place)));
}

/// Returns the place of the block or support to which an error of the scene refers.
fn place<'a>(error: &SceneError, blocks: &'a [Place], supports: &'a [Piece]) -> Option<&'a Place> {
    let key = error.key();
    let (list, rest) = key.split_once('[')?;
    let index: usize = rest.split(']').next()?.parse().ok()?;
    match list {
        "blocks" => blocks.get(index),
        "supports" => supports.get(index).map(|piece| &piece.place),
        _ => None,
    }
}
