//! Drawings that a scene names as its list of blocks.

use std::path::Path;

use nalgebra::Point2;

use super::fit::Fitted;
use super::sheet::Sheet;
use super::stones::Piece;
use super::{ImportError, ImportOptions, Imported, Joints, build, supports};
use masonry::scene::{Block, Drawn, Scene, SceneError, Support};
use masonry_drawing::{Drawing, DrawingFormat, Place};

/// Reads a scene whose `block_list` may be a drawing in any supported format.
///
/// # Errors
/// The errors of [`Scene::read`], and mistakes of the drawing with the entity that has them.
pub fn read_scene(path: &Path) -> Result<Scene, SceneError> {
    Scene::read_with(path, &drawn)
}

/// Reads a scene from `text` as [`read_scene`] reads a file at `path`, which need not exist.
///
/// # Errors
/// As [`read_scene`].
pub fn scene_from_toml(text: &str, path: &Path) -> Result<Scene, SceneError> {
    Scene::from_toml_with(text, path, &drawn)
}

/// Returns the blocks, supports and marked joints of a drawing, in the units of a scene.
fn drawn(path: &Path, bytes: &[u8], scene: &Scene) -> Result<Drawn, String> {
    let ending = path.extension().map_or_else(String::new, |it| it.to_string_lossy().into_owned());
    let format = DrawingFormat::of_ending(&ending)
        .ok_or("a drawing must be a .dxf, .svg, .obj or .json file: save it as one of these")?;
    let drawing = Drawing::read(bytes, format).map_err(|error| error.to_string())?;
    let imported = imported(&drawing, scene).map_err(|error| {
        // The remedy of an overlap is an option of `import`, which a scene does not have.
        let error = error.to_string();
        let error = error.trim_end_matches([':', ' ']);
        format!(
            "{error}; in a scene the tolerance is `contact.tolerance`; other options need `masonry import`"
        )
    })?;
    Ok(imported.into_drawn(scene.units.length_to_si()))
}

/// Imports a drawing with the tolerance, the supports, and the mortar or open joints of a scene.
fn imported(drawing: &Drawing, scene: &Scene) -> Result<Imported, ImportError> {
    let metres = scene.units.length_to_si();
    let has_mortar = scene.joints.values().any(|joint| joint.mortar_thickness() > 0.0);
    let joints = if has_mortar { Some(Joints::Mortar) } else { None };
    let options = ImportOptions {
        // A drawing without a unit is in the unit of the scene.
        scale: if drawing.unit.or(unknown(drawing)).is_none() { metres } else { 1.0 },
        tolerance: scene.contact.tolerance.map(|it| it * metres),
        joints: joints.or((scene.contact.gap_limit > 0.0).then_some(Joints::Open)),
        ..ImportOptions::default()
    };
    let mut sheet = Sheet::of(drawing, &options, options.tolerance)?;
    sheet.supports.extend(scene.supports.iter().map(|it| Piece {
        name: it.name.clone(),
        ends: [it.from, it.to].map(|[x, y]| Point2::new(x * metres, y * metres)),
        place: Place::new(format!("support \"{}\" of the scene", it.name), None),
        is_of_scene: true,
    }));
    supports::without_overlaps(&mut sheet);
    let fitted = Fitted::of(&mut sheet, &options)?;
    build::scene(sheet, &fitted, &options)
}

/// Returns metres for a drawing whose unit number is unknown, as `import` does; `None` for other drawings.
fn unknown(drawing: &Drawing) -> Option<masonry_drawing::Unit> {
    drawing.unknown_unit.map(|_| masonry_drawing::Unit::Metre)
}

impl Imported {
    fn into_drawn(self, metres: f64) -> Drawn {
        let per_metre = metres.recip();
        let scaled = |point: [f64; 2]| point.map(|it| it * per_metre);
        let changes = self.told();
        let Scene { blocks, supports, between, .. } = self.scene;
        let block =
            |it: Block| Block { corners: it.corners.into_iter().map(scaled).collect(), ..it };
        let support = |it: Support| Support { from: scaled(it.from), to: scaled(it.to), ..it };
        let own = supports.len() - self.supports_of_scene;
        Drawn {
            blocks: blocks.into_iter().map(block).collect(),
            places: self.places.iter().map(Place::to_string).collect(),
            supports: supports.into_iter().take(own).map(support).collect(),
            between,
            changes,
        }
    }
}
